//! What a run looked like: topology once, motion frame by frame. Pictures and animations are made from it
//! alone, so no exporter ever sees a world.

use std::borrow::Cow;

use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};

use crate::Error;

/// The motion of a scene, sampled at a fixed rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The scene's name.
    pub name: String,
    /// Frames per second.
    pub frame_rate: f32,
    /// One per thing to draw, in the scene's order.
    pub tracks: Vec<Track>,
}

/// One thing and its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// A name unique in the recording.
    pub name: String,
    /// Colour, sRGB.
    pub color: [u8; 3],
    /// How the surface is to be seen.
    pub surface: Surface,
    /// The surface; for a rigid motion in the body's frame, for a deforming one at the first frame.
    pub mesh: TriMesh,
    /// Where it is at each frame.
    pub motion: Motion,
}

/// How a surface is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// A solid: flat shaded, seen from outside.
    Solid,
    /// A sheet: smooth shaded, seen from both sides.
    Sheet,
    /// A tube or a ball: smooth shaded, seen from outside.
    Round,
    /// A wall of the surroundings: flat shaded, drawn only where it faces the camera, never casting shadows.
    Wall,
}

/// Where a thing is at each frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// It never moves; the mesh is in world coordinates.
    Still,
    /// Position (m) and rotation of the body's frame, per frame.
    Rigid(Vec<(Vec3, Quat)>),
    /// World positions (m) of the mesh's vertices, per frame.
    Deforming(Vec<Vec<Vec3>>),
}

impl Recording {
    /// How many frames there are: those of the longest motion, and 1 where nothing moves.
    pub fn frame_count(&self) -> usize {
        self.tracks.iter().map(|track| track.motion.frame_count()).max().unwrap_or(0).max(1)
    }

    /// The time of a frame, in s from the first.
    pub fn time_of(&self, frame: usize) -> f32 {
        frame as f32 / self.frame_rate
    }

    /// Makes sure that pictures and files can be made of it.
    ///
    /// # Errors
    /// [`Error::Recording`] names the first track whose motions or meshes do not fit together, or whose
    /// numbers are not finite; a frame rate that is not positive is reported with no track.
    pub fn check(&self) -> Result<(), Error> {
        let frames = self.frame_count();
        if !(self.frame_rate.is_finite() && self.frame_rate > 0.0) {
            let problem = format!("the frame rate {} is not a finite number above 0", self.frame_rate);
            return Err(Error::Recording { track: String::new(), problem });
        }
        for track in &self.tracks {
            track
                .defect(frames)
                .map_or(Ok(()), |problem| Err(Error::Recording { track: track.name.clone(), problem }))?;
        }
        Ok(())
    }
}

impl Track {
    /// World positions (m) of the mesh's vertices at a frame; after the last frame, those of the last.
    pub fn positions_at(&self, frame: usize) -> Cow<'_, [Vec3]> {
        match &self.motion {
            Motion::Still => Cow::Borrowed(&self.mesh.positions),
            Motion::Rigid(poses) => match poses.get(frame).or(poses.last()) {
                Some(&(position, rotation)) => {
                    Cow::Owned(self.mesh.positions.iter().map(|&p| position + rotation * p).collect())
                }
                None => Cow::Borrowed(&self.mesh.positions),
            },
            Motion::Deforming(frames) => {
                Cow::Borrowed(frames.get(frame).or(frames.last()).unwrap_or(&self.mesh.positions))
            }
        }
    }

    /// What is wrong with the track in a recording of that many frames.
    fn defect(&self, frames: usize) -> Option<String> {
        let vertices = self.mesh.positions.len();
        if self.mesh.triangles.is_empty() {
            return Some("its mesh has no triangles".into());
        }
        if self.mesh.triangles.iter().flatten().any(|&v| v as usize >= vertices) {
            return Some(format!("a triangle names a vertex beyond the {vertices} there are"));
        }
        let mut finite = self.mesh.positions.iter().all(|p| p.is_finite());
        match &self.motion {
            Motion::Still => {}
            Motion::Rigid(poses) => finite &= poses.iter().all(|(p, q)| p.is_finite() && q.is_finite()),
            Motion::Deforming(shapes) => {
                if let Some(shape) = shapes.iter().find(|shape| shape.len() != vertices) {
                    return Some(format!("a frame has {} positions for {vertices} vertices", shape.len()));
                }
                finite &= shapes.iter().flatten().all(|p| p.is_finite());
            }
        }
        if !finite {
            return Some("a position or rotation is not finite".into());
        }
        let own = self.motion.frame_count();
        (own != frames && !matches!(self.motion, Motion::Still))
            .then(|| format!("it has {own} frames and another track has {frames}"))
    }
}

impl Motion {
    fn frame_count(&self) -> usize {
        match self {
            Motion::Still => 1,
            Motion::Rigid(poses) => poses.len(),
            Motion::Deforming(shapes) => shapes.len(),
        }
    }
}
