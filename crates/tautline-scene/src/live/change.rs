//! Adding, removing, settings, and going back to a snapshot.

use tautline::World;

use super::LiveScene;
use crate::build::settings;
use crate::document::{Attachment, Body, HalfSpace, Joint, Scene, Settings};
use crate::error::{Error, Problem};

impl LiveScene {
    /// Adds a body and returns its number; of a room, which is six half-spaces, that of the first.
    ///
    /// # Errors
    /// [`Error::Invalid`] with every problem of the body, whose paths begin with its kind.
    pub fn add(&mut self, body: Body) -> Result<u32, Error> {
        self.judge(&body)?;
        let (first, number) = (self.builder.parts.len(), self.bodies.next());
        if let Err(refusal) = self.builder.add(self.scene.bodies.len(), number, &body) {
            return Err(Error::Invalid(vec![refusal.of(&body)]));
        }
        self.scene.bodies.push(body);
        self.builder.draw_walls();
        for index in first..self.builder.parts.len() {
            let part = &self.builder.parts[index];
            self.bodies.push_new(part.body);
            self.part_of.insert(part.body, index);
            if let Some(recorder) = &mut self.recorder {
                recorder.add(part, &self.builder.world)?;
            }
        }
        Ok(number)
    }

    /// Checks the values of a body as those of a document are, and that it is not one too many.
    fn judge(&self, body: &Body) -> Result<(), Error> {
        let solver = self.scene.settings.solver;
        let settings = Settings { solver, ..Settings::default() };
        let alone = Scene { settings, bodies: vec![body.clone()], ..Scene::default() };
        let mut problems: Vec<Problem> =
            alone.problems().into_iter().map(|problem| problem.without("bodies[0].")).collect();
        if self.scene.bodies.len() >= crate::document::limits::BODIES {
            let message = format!("there are {} bodies already, the most", self.scene.bodies.len());
            problems.push(Problem { path: "bodies".to_owned(), message });
        }
        if let Some(name) = body.name().filter(|name| self.builder.knows(name)) {
            let path = format!("{}.name", body.kind());
            problems.push(Problem { path, message: format!("{name:?} is the name of another body") });
        }
        if problems.is_empty() { Ok(()) } else { Err(Error::Invalid(problems)) }
    }

    /// Adds a joint, which calls bodies by their names or their numbers, and returns its number.
    ///
    /// # Errors
    /// [`Error::Engine`] with the field that is wrong.
    pub fn add_joint(&mut self, joint: &Joint) -> Result<u32, Error> {
        let handle = self.builder.join(joint)?;
        Ok(self.joints.push_new(handle))
    }

    /// Adds an attachment, which calls bodies by their names or their numbers, and returns its number.
    ///
    /// # Errors
    /// [`Error::Engine`] with the field that is wrong.
    pub fn attach(&mut self, attachment: &Attachment) -> Result<u32, Error> {
        let handle = self.builder.attach(attachment, &self.scene.bodies)?;
        Ok(self.attachments.push_new(handle))
    }

    /// Removes a body with its joints, attachments and cues.
    ///
    /// # Errors
    /// [`Error::Engine`] for a number that names no body.
    pub fn remove(&mut self, body: u32) -> Result<(), Error> {
        let handle = self.bodies.handle(body)?;
        self.builder.world.remove(handle)?;
        if let Some(index) = self.builder.forget(handle).filter(|&index| index >= self.own) {
            // What it was made of is not needed again, and may be a large mesh.
            self.scene.bodies[index] = Body::HalfSpace(HalfSpace::default());
        }
        self.cues.retain(|cue| cue.body != handle);
        Ok(())
    }

    /// Removes a joint.
    ///
    /// # Errors
    /// [`Error::Engine`] for a number that names no joint.
    pub fn remove_joint(&mut self, joint: u32) -> Result<(), Error> {
        Ok(self.builder.world.remove_joint(self.joints.handle(joint)?)?)
    }

    /// Removes an attachment.
    ///
    /// # Errors
    /// [`Error::Engine`] for a number that names no attachment.
    pub fn detach(&mut self, attachment: u32) -> Result<(), Error> {
        Ok(self.builder.world.detach(self.attachments.handle(attachment)?)?)
    }

    /// Simulates it otherwise from now on. What the settings leave open is the solver's own choice.
    ///
    /// # Errors
    /// [`Error::Invalid`] with every value that is wrong, or for another solver, for which rigid bodies are made
    /// otherwise: that takes another scene.
    pub fn set_settings(&mut self, changed: Settings) -> Result<(), Error> {
        if changed.solver != self.scene.settings.solver {
            let message =
                "cannot change while a scene runs: build the scene with the other solver".to_owned();
            return Err(Error::Invalid(vec![Problem { path: "settings.solver".to_owned(), message }]));
        }
        Scene { settings: changed.clone(), ..Scene::default() }.check()?;
        self.builder.world.set_settings(settings::of(&changed))?;
        self.scene.settings = changed;
        Ok(())
    }

    /// Goes back, or on, to a snapshot of this scene's world. Numbers of what is in both stay as they are; what only the
    /// snapshot has gets numbers of its own. A recording ends.
    ///
    /// # Errors
    /// [`Error::Engine`] for bytes that are no snapshot; nothing is changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.builder.world = World::restore(bytes)?;
        self.recorder = None;
        self.steps = (self.builder.world.time() / f64::from(self.scene.dt)).round() as u64;
        let world = &self.builder.world;
        world.joints().for_each(|joint| _ = self.joints.push(joint));
        world.attachments().for_each(|attachment| _ = self.attachments.push(attachment));
        for body in self.builder.world.bodies().collect::<Vec<_>>() {
            self.bodies.push(body);
            self.find_part(body)?;
        }
        self.builder.draw_walls();
        Ok(())
    }
}
