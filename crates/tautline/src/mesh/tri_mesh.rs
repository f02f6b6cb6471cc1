//! Triangle soup: what files and primitives produce and builders consume.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Triangles over shared vertices, counter-clockwise seen from outside. Nothing is checked; a
/// half-edge mesh is built from it and names its first defect.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TriMesh {
    /// Corners, in m.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` per triangle.
    pub triangles: Vec<[u32; 3]>,
}
