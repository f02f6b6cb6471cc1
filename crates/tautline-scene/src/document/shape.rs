//! The shapes of bodies, as a document describes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::value::Rotation;

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
    /// A ball. As a truss it is an icosphere of 162 vertices.
    Sphere {
        /// Radius, in m.
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
    /// A cylinder along Y with half balls for ends; round if neither `segments` nor `rings` is given.
    Capsule {
        /// Radius, in m.
        radius: f32,
        /// Height of the cylinder without its ends, in m.
        height: f32,
        /// Corners around; 16 of a truss, and where only `rings` is given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        segments: Option<u32>,
        /// Bands of each end; 4 of a truss, and where only `segments` is given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rings: Option<u32>,
    },
    /// A cylinder along Y; round if `segments` is not given.
    Cylinder {
        /// Radius, in m.
        radius: f32,
        /// Height, in m.
        height: f32,
        /// Corners around; 24 of a truss.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        segments: Option<u32>,
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
    /// A closed surface from an OBJ, STL, PLY or glTF file.
    File(MeshFile),
    /// Solids that move as one. Not for a truss.
    Compound {
        /// The solids; their masses are added, also where they overlap.
        parts: Vec<PartOfCompound>,
    },
    /// A surface without an inside, which may be open: ground and walls of a body that is fixed or kinematic, solid
    /// where its triangles run counter-clockwise. Not for a truss.
    Surface(Surface),
    /// A landscape around the origin, of a body that is fixed or kinematic. Not for a truss.
    HeightField {
        /// Heights along X.
        columns: u32,
        /// Heights along Z.
        rows: u32,
        /// Distance of neighbouring heights along X and along Z, in m.
        cell_size: f32,
        /// Heights (Y), in m, row after row.
        heights: Vec<f32>,
    },
}

/// A solid of a compound.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PartOfCompound {
    /// Its shape, in its own frame.
    pub shape: Shape,
    /// Where its frame is in that of the compound, in m.
    pub position: [f32; 3],
    /// How its frame is turned in that of the compound.
    pub rotation: Rotation,
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

/// The rest shape of a sheet, or ground and walls, in its own frame.
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
    /// A surface from an OBJ, STL, PLY or glTF file.
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
    /// A net, or any rope with branches.
    Network {
        /// Its points.
        points: Vec<[f32; 3]>,
        /// Between which points there are segments, by their indices.
        segments: Vec<[u32; 2]>,
    },
}

impl Default for Thread {
    /// 50 segments over 2 m, 1 m above the floor.
    fn default() -> Self {
        Self::Line { from: [-1.0, 1.0, 0.0], to: [1.0, 1.0, 0.0], segments: 50 }
    }
}

impl Shape {
    /// Corners around a capsule of which facets are asked, but not how many.
    pub(crate) const CAPSULE_SEGMENTS: u32 = 16;
    /// Bands of each of its ends.
    pub(crate) const CAPSULE_RINGS: u32 = 4;
    /// Corners around a cylinder of which facets are asked, but not how many.
    pub(crate) const CYLINDER_SEGMENTS: u32 = 24;
    /// How often the triangles of an icosahedron are divided for a ball of which facets are asked.
    pub(crate) const SPHERE_SUBDIVISIONS: u32 = 2;

    /// How many vertices it has at most, faceted; 0 for a file.
    pub fn vertex_count(&self) -> u64 {
        match *self {
            Self::Box { .. } => 8,
            Self::Tetrahedron { .. } => 4,
            Self::Octahedron { .. } => 6,
            Self::Dodecahedron { .. } => 20,
            Self::Icosahedron { .. } => 12,
            Self::Sphere { .. } => icosphere_vertices(Self::SPHERE_SUBDIVISIONS),
            Self::Icosphere { subdivisions, .. } => icosphere_vertices(subdivisions),
            Self::UvSphere { segments, rings, .. } => product(segments, rings),
            Self::Capsule { segments, rings, .. } => {
                let segments = segments.unwrap_or(Self::CAPSULE_SEGMENTS);
                product(segments, rings.unwrap_or(Self::CAPSULE_RINGS)).saturating_mul(2).saturating_add(2)
            }
            Self::Cylinder { segments, .. } => 2 * u64::from(segments.unwrap_or(Self::CYLINDER_SEGMENTS)),
            Self::Torus { segments, tube_segments, .. } => product(segments, tube_segments),
            Self::Hull { ref points } => points.len() as u64,
            Self::Mesh(ref mesh) => mesh.positions.len() as u64,
            Self::Surface(ref surface) => surface.vertex_count(),
            Self::HeightField { columns, rows, .. } => product(columns, rows),
            Self::Compound { ref parts } => total(parts, Self::vertex_count),
            Self::File(_) => 0,
        }
    }

    /// How many triangles it gives one by one.
    pub fn triangle_count(&self) -> u64 {
        match self {
            Self::Mesh(mesh) => mesh.triangles.len() as u64,
            Self::Surface(surface) => surface.triangle_count(),
            Self::Compound { parts } => total(parts, Self::triangle_count),
            _ => 0,
        }
    }

    /// Whether it has an inside.
    pub fn is_solid(&self) -> bool {
        !matches!(self, Self::Surface(_) | Self::HeightField { .. })
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

    /// How many triangles it gives one by one.
    pub fn triangle_count(&self) -> u64 {
        match self {
            Self::Mesh(mesh) => mesh.triangles.len() as u64,
            Self::Grid { .. } | Self::File(_) => 0,
        }
    }
}

/// Over the shapes of a compound.
fn total(parts: &[PartOfCompound], count: fn(&Shape) -> u64) -> u64 {
    parts.iter().map(|part| count(&part.shape)).fold(0, u64::saturating_add)
}

/// Of a divided icosahedron.
fn icosphere_vertices(subdivisions: u32) -> u64 {
    4u64.saturating_pow(subdivisions).saturating_mul(10).saturating_add(2)
}

impl Thread {
    /// How many points it has.
    pub fn point_count(&self) -> u64 {
        match self {
            Self::Line { segments, .. } => u64::from(*segments) + 1,
            Self::Points(points) | Self::Network { points, .. } => points.len() as u64,
        }
    }
}

/// The product, which always fits.
fn product(a: u32, b: u32) -> u64 {
    u64::from(a) * u64::from(b)
}
