//! A world with what is known of it, as one object of JavaScript.

use serde_json::json;
use tautline::{BodyHandle, Fault, GrabHandle, StepReport, Vec3, World};
use tautline_scene::document::{Settings, parse_part};
use tautline_scene::live::{LiveScene, Numbers};
use wasm_bindgen::prelude::*;

use crate::failure::Failure;
use crate::scenes::read;
use crate::shapes::Meshes;

#[wasm_bindgen]
extern "C" {
    /// In ms, from any start.
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// A scene that runs.
#[wasm_bindgen]
pub struct Session {
    pub(crate) scene: LiveScene,
    pub(crate) meshes: Meshes,
    pub(crate) grabs: Numbers<GrabHandle>,
    faults: Vec<Fault>,
    poses: Vec<f32>,
    flags: Vec<u8>,
}

#[wasm_bindgen]
impl Session {
    /// Builds a document.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str, format: &str) -> Result<Session, JsValue> {
        let scene = read(text, format).and_then(|scene| Ok(LiveScene::new(scene)?));
        let scene = scene.map_err(|failure| failure.located(text, format))?;
        let (meshes, grabs, faults) = (Meshes::default(), Numbers::default(), Vec::new());
        Ok(Session { scene, meshes, grabs, faults, poses: Vec::new(), flags: Vec::new() })
    }

    /// What the document says of the scene as a whole.
    pub fn about(&self) -> String {
        let scene = self.scene.document();
        json!({
            "name": scene.name, "description": scene.description, "seconds": scene.seconds, "dt": scene.dt,
            "camera": scene.camera, "bounds": scene.bounds,
        })
        .to_string()
    }

    pub fn time(&self) -> f64 {
        self.world().time()
    }

    pub fn steps(&self) -> f64 {
        self.scene.steps() as f64
    }

    /// Takes a step of `dt` seconds. Counts of the report, then times in ms: see the package's `report.ts`.
    pub fn step(&mut self, dt: f32) -> Result<Vec<f64>, JsValue> {
        let begin = now();
        let report = self.scene.step(dt, &mut || now() / 1000.0).map_err(Failure::from)?;
        let row = row_of(&report, now() - begin);
        self.faults = report.faults;
        Ok(row)
    }

    /// Bodies that the last step froze: their numbers and particles, in turn.
    pub fn faults(&self) -> Vec<u32> {
        self.faults.iter().flat_map(|fault| [self.number(fault.body), fault.particle]).collect()
    }

    pub fn reset(&mut self) -> Result<(), JsValue> {
        self.scene.reset().map_err(Failure::from)?;
        self.meshes = Meshes::default();
        self.grabs.forget_all();
        self.faults.clear();
        Ok(())
    }

    pub fn snapshot(&self) -> Vec<u8> {
        self.world().snapshot()
    }

    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), JsValue> {
        self.scene.restore(bytes).map_err(Failure::from)?;
        let Self { scene, grabs, .. } = self;
        scene.world().grabs().for_each(|(grab, _)| _ = grabs.push(grab));
        Ok(())
    }

    pub fn state_hash(&self) -> String {
        format!("{:016x}", self.world().state_hash())
    }

    /// Kinetic and potential energy in J, momentum in N s, mean and greatest strain, greatest and mean penetration in m,
    /// how many penetrate.
    pub fn measures(&self) -> Vec<f64> {
        let world = self.world();
        let (momentum, strain, penetration) = (world.momentum(), world.strain(), world.penetration());
        vec![
            world.kinetic_energy(),
            world.potential_energy(),
            momentum.x,
            momentum.y,
            momentum.z,
            f64::from(strain.mean),
            f64::from(strain.max),
            f64::from(penetration.max),
            f64::from(penetration.mean),
            penetration.count as f64,
        ]
    }

    /// Kinetic and potential energy, in J.
    pub fn energy(&self) -> Vec<f64> {
        vec![self.world().kinetic_energy(), self.world().potential_energy()]
    }

    /// The settings in force, every one of them.
    pub fn settings(&self) -> String {
        let solver = self.scene.document().settings.solver;
        serde_json::to_string(&Settings::in_force(self.world().settings(), solver)).unwrap_or_default()
    }

    /// Puts settings, complete and in JSON, in the place of those in force.
    pub fn set_settings(&mut self, text: &str) -> Result<(), JsValue> {
        let settings = parse_part(text).map_err(Failure::from)?;
        Ok(self.scene.set_settings(settings).map_err(Failure::from)?)
    }

    pub fn start_recording(&mut self) -> Result<(), JsValue> {
        Ok(self.scene.start_recording().map_err(Failure::from)?)
    }

    /// How many frames; −1 = it is not recorded.
    pub fn recorded_frames(&self) -> f64 {
        self.scene.recorded_frames().map_or(-1.0, |frames| frames as f64)
    }

    pub fn glb(&self) -> Result<Vec<u8>, JsValue> {
        Ok(self.scene.glb().map_err(Failure::from)?)
    }

    /// Where the positions of all particles begin in memory, and how many numbers they are.
    pub fn positions(&self) -> Vec<u32> {
        let positions = self.world().positions();
        vec![address(positions), 3 * positions.len() as u32]
    }

    /// The same for the poses of all bodies as they are now.
    pub fn poses(&mut self) -> Vec<u32> {
        self.poses.clear();
        let world = self.scene.world();
        for body in world.bodies() {
            let pose = world.body(body).ok().and_then(|body| body.pose());
            let (position, rotation) = pose.unwrap_or_default();
            self.poses.extend(position.to_array());
            self.poses.extend(rotation.to_array());
        }
        vec![address(&self.poses), self.poses.len() as u32]
    }

    /// The same for bits of all bodies: 1 = awake, 2 = never moves.
    pub fn flags(&mut self) -> Vec<u32> {
        let world = self.scene.world();
        let flags = |body: BodyHandle| {
            let body = world.body(body).ok();
            body.map_or(0, |body| u8::from(!body.is_asleep()) | u8::from(body.is_fixed()) << 1)
        };
        self.flags = world.bodies().map(flags).collect();
        vec![address(&self.flags), self.flags.len() as u32]
    }
}

impl Session {
    pub(crate) fn world(&self) -> &World {
        self.scene.world()
    }

    /// The number of a body that is there.
    pub(crate) fn number(&self, body: BodyHandle) -> u32 {
        self.scene.bodies().number(body).unwrap_or(u32::MAX)
    }

    pub(crate) fn body(&self, number: u32) -> Result<BodyHandle, Failure> {
        Ok(self.scene.bodies().handle(number)?)
    }

    /// The world and a body of it, to do something to.
    pub(crate) fn with_body<T>(
        &mut self,
        number: u32,
        change: impl FnOnce(&mut World, BodyHandle) -> Result<T, tautline::Error>,
    ) -> Result<T, JsValue> {
        let body = self.body(number)?;
        Ok(change(self.scene.world_mut(), body).map_err(Failure::from)?)
    }
}

/// In WebAssembly's memory, where addresses have 32 bits.
fn address<T>(list: &[T]) -> u32 {
    list.as_ptr().addr() as u32
}

/// Three numbers, of which there are always three: the package sees to it.
pub(crate) fn vec3(numbers: &[f32]) -> Vec3 {
    match *numbers {
        [x, y, z] => Vec3::new(x, y, z),
        _ => Vec3::NAN,
    }
}

fn row_of(report: &StepReport, total: f64) -> Vec<f64> {
    let seconds = &report.seconds;
    let times = [
        seconds.integrate,
        seconds.broad_phase,
        seconds.narrow_phase,
        seconds.separate,
        seconds.relax,
        seconds.solve,
        seconds.soft,
    ];
    let counts = [
        report.pairs as f64,
        report.contacts as f64,
        report.visits as f64,
        report.relaxations as f64,
        report.awake_bodies as f64,
        report.faults.len() as f64,
    ];
    counts.into_iter().chain(times.map(|time| 1000.0 * time)).chain([total]).collect()
}
