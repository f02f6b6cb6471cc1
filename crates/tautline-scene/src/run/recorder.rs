//! What a world looks like, frame by frame.

use std::sync::Arc;

use tautline::mesh::TriMesh;
use tautline::{BodyHandle, World};

use super::tears::Tears;
use super::tubes::Tubes;
use crate::build::{Look, Part, Skin};
use crate::error::Error;
use crate::recording::{Motion, Recording, Surface, Track};

/// A recording in the making. Bodies may come and go meanwhile: what comes is seen from the first frame on where it
/// begins, what goes stays where it was last.
#[derive(Debug, Clone)]
pub struct Recorder {
    recording: Recording,
    /// What moves in each track.
    sources: Vec<Source>,
    frames: u64,
}

#[derive(Debug, Clone)]
enum Source {
    Still,
    Rigid(BodyHandle),
    Sheet(BodyHandle, Tears),
    Skin(BodyHandle, Arc<Skin>),
    Rope(BodyHandle, Tubes),
}

impl Recorder {
    /// A recording without frames, of these parts of a world.
    ///
    /// # Errors
    /// [`Error::Engine`] for a part whose body is not in the world.
    pub fn new<'a>(
        name: &str,
        frame_rate: f32,
        parts: impl IntoIterator<Item = &'a Part>,
        world: &World,
    ) -> Result<Self, Error> {
        let recording = Recording { name: name.to_owned(), frame_rate, tracks: Vec::new() };
        let mut recorder = Self { recording, sources: Vec::new(), frames: 0 };
        parts.into_iter().try_for_each(|part| recorder.add(part, world))?;
        Ok(recorder)
    }

    /// Adds a part of the world.
    ///
    /// # Errors
    /// [`Error::Engine`] if its body is not in the world.
    pub fn add(&mut self, part: &Part, world: &World) -> Result<(), Error> {
        let (mut track, mut source) = track_of(part, world)?;
        for _ in 0..self.frames {
            record_part(&mut track, &mut source, world)?;
        }
        self.recording.tracks.push(track);
        self.sources.push(source);
        Ok(())
    }

    /// How many frames there are.
    pub fn frame_count(&self) -> u64 {
        self.frames
    }

    /// How much a frame takes, in positions: all vertices of what deforms, of which a rope drawn as a tube has more
    /// than particles, and about three for a pose.
    pub fn positions_per_frame(&self) -> u64 {
        let of = |track: &Track| match track.motion {
            Motion::Still => 0,
            Motion::Rigid(_) => 3,
            Motion::Deforming(_) => track.mesh.positions.len() as u64,
        };
        self.recording.tracks.iter().map(of).sum()
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// [`Error::Engine`] if the world is another one.
    pub fn record(&mut self, world: &World) -> Result<(), Error> {
        for (track, source) in self.recording.tracks.iter_mut().zip(&mut self.sources) {
            record_part(track, source, world)?;
        }
        self.frames += 1;
        Ok(())
    }

    /// The recording.
    pub fn finish(mut self) -> Recording {
        for (track, source) in self.recording.tracks.iter_mut().zip(self.sources) {
            if let Source::Sheet(_, tears) = source {
                tears.apply(track);
            }
        }
        self.recording
    }
}

/// Adds a frame to a track; the last one again if the body has been removed.
fn record_part(track: &mut Track, source: &mut Source, world: &World) -> Result<(), Error> {
    let body = match source {
        Source::Still => return Ok(()),
        Source::Rigid(body) | Source::Sheet(body, _) | Source::Skin(body, _) | Source::Rope(body, _) => {
            world.body(*body)
        }
    };
    match (source, &mut track.motion, body) {
        (_, Motion::Rigid(poses), Err(_)) if !poses.is_empty() => poses.extend_from_within(poses.len() - 1..),
        (_, Motion::Deforming(frames), Err(_)) if !frames.is_empty() => {
            frames.extend_from_within(frames.len() - 1..);
        }
        (Source::Rigid(_), Motion::Rigid(poses), body) => poses.extend(body?.pose()),
        (Source::Sheet(_, tears), Motion::Deforming(frames), body) => {
            let sheet = body?;
            tears.note(sheet.triangles(), frames.len());
            frames.push(sheet.positions().to_vec());
        }
        (Source::Skin(_, skin), Motion::Deforming(frames), body) => {
            frames.push(skin.embedding.positions(body?.positions()));
        }
        (Source::Rope(_, tubes), Motion::Deforming(frames), body) => {
            frames.push(tubes.positions(body?.positions()));
        }
        _ => {}
    }
    Ok(())
}

/// A part's track without frames, and what moves in it.
fn track_of(part: &Part, world: &World) -> Result<(Track, Source), Error> {
    let body = world.body(part.body)?;
    let (surface, mesh, motion, source) = match &part.look {
        Look::Wall(mesh) => (Surface::Wall, mesh.clone(), Motion::Still, Source::Still),
        Look::Solid(mesh) | Look::Round(mesh) => {
            let is_round = matches!(part.look, Look::Round(_));
            let surface = if is_round { Surface::Round } else { Surface::Solid };
            match body.pose() {
                Some((position, rotation)) if body.is_fixed() => {
                    let positions = mesh.positions.iter().map(|&p| position + rotation * p).collect();
                    let mesh = TriMesh { positions, triangles: mesh.triangles.clone() };
                    (surface, mesh, Motion::Still, Source::Still)
                }
                _ => (surface, TriMesh::clone(mesh), Motion::Rigid(Vec::new()), Source::Rigid(part.body)),
            }
        }
        Look::Sheet => {
            let mesh = TriMesh { positions: body.positions().to_vec(), triangles: body.triangles().to_vec() };
            let source = Source::Sheet(part.body, Tears::new(body.triangles()));
            (Surface::Sheet, mesh, Motion::Deforming(Vec::new()), source)
        }
        Look::Skin(skin) => {
            let positions = skin.embedding.positions(body.positions());
            let mesh = TriMesh { positions, triangles: skin.triangles.clone() };
            (Surface::Round, mesh, Motion::Deforming(Vec::new()), Source::Skin(part.body, Arc::clone(skin)))
        }
        Look::Tube { radius } => {
            let mut tubes = Tubes::new(*radius, body.sticks());
            let mesh = tubes.mesh(body.positions());
            (Surface::Round, mesh, Motion::Deforming(Vec::new()), Source::Rope(part.body, tubes))
        }
    };
    Ok((Track { name: part.name.clone(), color: part.color, surface, mesh, motion }, source))
}
