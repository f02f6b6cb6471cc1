//! What a run looked like: topology once, motion frame by frame. Pictures and animations are made from it
//! alone, so no exporter ever sees a world.

use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};

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
    /// A tube: smooth shaded, seen from outside.
    Tube,
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
