//! The shapes of bodies, as a document describes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The shape of a rigid body, in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A box around the origin.
    Box {
        /// Lengths of its edges, in m.
        size: [f32; 3],
    },
    /// A regular tetrahedron around the origin.
    Tetrahedron {
        /// Distance of its vertices from the origin, in m.
        radius: f32,
    },
    /// A regular octahedron around the origin.
    Octahedron {
        /// Distance of its vertices from the origin, in m.
        radius: f32,
    },
    /// A regular dodecahedron around the origin.
    Dodecahedron {
        /// Distance of its vertices from the origin, in m.
        radius: f32,
    },
    /// A regular icosahedron around the origin.
    Icosahedron {
        /// Distance of its vertices from the origin, in m.
        radius: f32,
    },
    /// A ball of triangles of about equal size: an icosahedron, divided.
    Icosphere {
        /// Radius, in m.
        radius: f32,
        /// How often each triangle is divided into four.
        subdivisions: u32,
    },
    /// A ball of meridians and parallels.
    UvSphere {
        /// Radius, in m.
        radius: f32,
        /// Meridians.
        segments: u32,
        /// Bands between the poles.
        rings: u32,
    },
    /// A cylinder along Y with half balls for ends.
    Capsule {
        /// Radius, in m.
        radius: f32,
        /// Height of the cylinder without its ends, in m.
        height: f32,
        /// Corners around.
        segments: u32,
        /// Bands of each end.
        rings: u32,
    },
    /// A cylinder along Y.
    Cylinder {
        /// Radius, in m.
        radius: f32,
        /// Height, in m.
        height: f32,
        /// Corners around.
        segments: u32,
    },
    /// A ring around the Y axis.
    Torus {
        /// Distance of the tube's centre line from the axis, in m.
        radius: f32,
        /// Radius of the tube, in m.
        tube_radius: f32,
        /// Sections around the axis.
        segments: u32,
        /// Corners around the tube.
        tube_segments: u32,
    },
    /// The convex hull of points.
    Hull {
        /// The points, in m; at least four, not all in one plane.
        points: Vec<[f32; 3]>,
    },
    /// A closed surface of triangles.
    Mesh(MeshSource),
    /// A closed surface from an OBJ or STL file.
    File(MeshFile),
}

impl Default for Shape {
    /// A cube of 1 m.
    fn default() -> Self {
        Self::Box { size: [1.0; 3] }
    }
}

/// Triangles over shared vertices, counter-clockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSource {
    /// The vertices, in m.
    pub positions: Vec<[f32; 3]>,
    /// Three indices into `positions` per triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// A mesh file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Path from the scene's folder, with slashes; it must not lead out of that folder.
    pub path: String,
    /// Metres per unit of the file: 0.001 for one drawn in millimetres.
    #[serde(default = "metre")]
    pub scale: f32,
}

fn metre() -> f32 {
    1.0
}

/// The rest shape of a sheet, in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Surface {
    /// A rectangle in the plane y = 0 around the origin; vertex index is row × columns + column.
    Grid {
        /// Particles along X.
        columns: u32,
        /// Particles along Z.
        rows: u32,
        /// Length along X, in m.
        width: f32,
        /// Length along Z, in m.
        depth: f32,
    },
    /// A surface of triangles.
    Mesh(MeshSource),
    /// A surface from an OBJ or STL file.
    File(MeshFile),
}

impl Default for Surface {
    /// 20 × 20 particles over 1 m × 1 m.
    fn default() -> Self {
        Self::Grid { columns: 20, rows: 20, width: 1.0, depth: 1.0 }
    }
}

/// How a rope is laid out, in the world's frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Thread {
    /// A straight line.
    Line {
        /// Where it begins, in m.
        from: [f32; 3],
        /// Where it ends, in m.
        to: [f32; 3],
        /// How many sticks it is made of.
        segments: u32,
    },
    /// A line through points.
    Points(Vec<[f32; 3]>),
}

impl Default for Thread {
    /// 50 segments over 2 m, 1 m above the floor.
    fn default() -> Self {
        Self::Line { from: [-1.0, 1.0, 0.0], to: [1.0, 1.0, 0.0], segments: 50 }
    }
}

impl Shape {
    /// How many vertices it has at most; 0 for a file.
    pub fn vertex_count(&self) -> u64 {
        match *self {
            Self::Box { .. } => 8,
            Self::Tetrahedron { .. } => 4,
            Self::Octahedron { .. } => 6,
            Self::Dodecahedron { .. } => 20,
            Self::Icosahedron { .. } => 12,
            Self::Icosphere { subdivisions, .. } => {
                4u64.saturating_pow(subdivisions).saturating_mul(10).saturating_add(2)
            }
            Self::UvSphere { segments, rings, .. } => product(segments, rings),
            Self::Capsule { segments, rings, .. } => {
                product(segments, rings).saturating_mul(2).saturating_add(2)
            }
            Self::Cylinder { segments, .. } => 2 * u64::from(segments),
            Self::Torus { segments, tube_segments, .. } => product(segments, tube_segments),
            Self::Hull { ref points } => points.len() as u64,
            Self::Mesh(ref mesh) => mesh.positions.len() as u64,
            Self::File(_) => 0,
        }
    }
}

impl Surface {
    /// How many vertices it has; 0 for a file.
    pub fn vertex_count(&self) -> u64 {
        match self {
            Self::Grid { columns, rows, .. } => product(*columns, *rows),
            Self::Mesh(mesh) => mesh.positions.len() as u64,
            Self::File(_) => 0,
        }
    }
}

impl Thread {
    /// How many points it has.
    pub fn point_count(&self) -> u64 {
        match self {
            Self::Line { segments, .. } => u64::from(*segments) + 1,
            Self::Points(points) => points.len() as u64,
        }
    }
}

/// The product, which always fits.
fn product(a: u32, b: u32) -> u64 {
    u64::from(a) * u64::from(b)
}
