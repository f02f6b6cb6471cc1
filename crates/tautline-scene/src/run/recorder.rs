//! What a world looks like, frame by frame.

use tautline::mesh::TriMesh;
use tautline::{BodyHandle, World};

use super::tears::Tears;
use super::tubes::Tubes;
use crate::build::{BuiltScene, Look, Part};
use crate::error::Error;
use crate::recording::{Motion, Recording, Surface, Track};

/// A recording in the making: of a [`Run`](super::Run), or of a scene that is stepped by other means.
#[derive(Debug, Clone)]
pub struct Recorder {
    recording: Recording,
    /// What moves in each track.
    sources: Vec<Source>,
}

#[derive(Debug, Clone)]
enum Source {
    Still,
    Rigid(BodyHandle),
    Sheet(BodyHandle, Tears),
    Rope(BodyHandle, Tubes),
}

impl Recorder {
    /// A recording without frames, of the scene's parts as they are now.
    ///
    /// # Errors
    /// [`Error::Engine`] if bodies of the scene have been removed.
    pub fn new(scene: &BuiltScene) -> Result<Self, Error> {
        let frame_rate = 1.0 / (scene.dt * scene.record_every as f32);
        let mut recording = Recording { name: scene.name.clone(), frame_rate, tracks: Vec::new() };
        let mut sources = Vec::new();
        for part in &scene.parts {
            let (track, source) = track_of(part, &scene.world)?;
            recording.tracks.push(track);
            sources.push(source);
        }
        Ok(Self { recording, sources })
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
    /// As [`Recorder::new`].
    pub fn record(&mut self, world: &World) -> Result<(), Error> {
        for (track, source) in self.recording.tracks.iter_mut().zip(&mut self.sources) {
            match (source, &mut track.motion) {
                (Source::Rigid(body), Motion::Rigid(poses)) => poses.extend(world.body(*body)?.pose()),
                (Source::Sheet(body, tears), Motion::Deforming(frames)) => {
                    let sheet = world.body(*body)?;
                    tears.note(sheet.triangles(), frames.len());
                    frames.push(sheet.positions().to_vec());
                }
                (Source::Rope(body, tubes), Motion::Deforming(frames)) => {
                    frames.push(tubes.positions(world.body(*body)?.positions()));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// What was recorded.
    pub fn finish(mut self) -> Recording {
        for (track, source) in self.recording.tracks.iter_mut().zip(self.sources) {
            if let Source::Sheet(_, tears) = source {
                tears.apply(track);
            }
        }
        self.recording
    }
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
        Look::Tube { radius } => {
            let mut tubes = Tubes::new(*radius, body.sticks());
            let mesh = tubes.mesh(body.positions());
            (Surface::Round, mesh, Motion::Deforming(Vec::new()), Source::Rope(part.body, tubes))
        }
    };
    Ok((Track { name: part.name.clone(), color: part.color, surface, mesh, motion }, source))
}
