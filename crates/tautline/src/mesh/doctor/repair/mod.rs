//! The treatment: one step after another, each of which says what it did.

mod cut;
mod duplicate;
mod flat;
mod hole;
mod patient;
mod weld;

use serde::Serialize;

use super::report::counted;
use super::{Report, diagnose};
use crate::mesh::TriMesh;
use patient::Patient;

/// How far a repair may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RepairOptions {
    /// Vertices on open edges become one if they are at most so far apart, in m; `None` is a millionth of the mesh's
    /// diagonal, what writing numbers as text may cost.
    pub weld_distance: Option<f32>,
    /// The most edges of a hole that is filled.
    pub hole_edges: usize,
    /// The greatest area of a filling, as a share of the component's: what is larger is no hole but the rim of a sheet
    /// or a bowl.
    pub hole_share: f64,
}

impl Default for RepairOptions {
    fn default() -> Self {
        Self { weld_distance: None, hole_edges: 100, hole_share: 0.25 }
    }
}

/// A repaired mesh, and what was done to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Repaired {
    /// The mesh. What was sound in it is as it was: nothing is moved but what is welded.
    pub mesh: TriMesh,
    /// What was done, in order.
    pub actions: Vec<Action>,
    /// What remains: clean, or why not.
    pub report: Report,
}

/// Something that was done. Vertices and triangles are those of the mesh that was brought; what came up during the
/// repair itself is counted, but has no number there.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Action {
    /// Triangles were left out.
    DroppedTriangles {
        /// Why.
        why: Why,
        /// How many.
        count: usize,
        /// Which.
        triangles: Vec<u32>,
    },
    /// Vertices were left out, since no triangle uses them.
    DroppedVertices {
        /// Which.
        vertices: Vec<u32>,
    },
    /// Vertices became one: each first becomes the second.
    Welded {
        /// Which.
        pairs: Vec<[u32; 2]>,
    },
    /// Triangles without area got one, by swapping their longest edge for the other diagonal of the two triangles there.
    Swapped {
        /// How many.
        count: usize,
        /// Which.
        triangles: Vec<u32>,
    },
    /// Triangles were turned round.
    Turned {
        /// How many.
        count: usize,
        /// Which.
        triangles: Vec<u32>,
    },
    /// Vertices were doubled, so that surfaces that met there are parted; nothing moved.
    Parted {
        /// Which, once for every copy.
        vertices: Vec<u32>,
    },
    /// A hole was filled.
    Filled {
        /// Its rim.
        vertices: Vec<u32>,
        /// With how many triangles.
        triangles: usize,
    },
}

/// Why triangles were dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Why {
    /// A corner is not there, or not finite.
    NoPlace,
    /// They have no area.
    NoArea,
    /// The same corners as another.
    Duplicate,
    /// They divide a solid.
    Wall,
    /// They stood on a surface and bound nothing.
    Fin,
}

impl std::fmt::Display for Action {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let triangles = |count| counted(count, ["triangle", "triangles"]);
        let vertices_of = |count| counted(count, ["vertex", "vertices"]);
        match self {
            Self::DroppedTriangles { why, count, .. } => {
                let why = match why {
                    Why::NoPlace => "with a corner that is not there or not finite",
                    Why::NoArea => "without area",
                    Why::Duplicate => "with the corners of others",
                    Why::Wall => "that divided a solid",
                    Why::Fin => "of small fins on a surface",
                };
                write!(f, "dropped {} {why}", triangles(*count))
            }
            Self::DroppedVertices { vertices } => {
                write!(f, "dropped {} of no triangle", vertices_of(vertices.len()))
            }
            Self::Welded { pairs } => write!(f, "welded {} to others", vertices_of(pairs.len())),
            Self::Swapped { count, .. } => write!(f, "swapped an edge of {} without area", triangles(*count)),
            Self::Turned { count, .. } => write!(f, "turned {} round", triangles(*count)),
            Self::Parted { vertices } => {
                write!(f, "doubled {} to part surfaces", vertices_of(vertices.len()))
            }
            Self::Filled { vertices, triangles: count } => {
                write!(f, "filled a hole of {} edges with {}", vertices.len(), triangles(*count))
            }
        }
    }
}

/// Makes a mesh a manifold surface that faces outwards, as far as that is possible without guessing: vertices on open
/// edges are welded, what has no area or comes twice is dropped, triangles are turned to agree, surfaces that meet in
/// an edge or a point are parted, and small holes filled. Crossings remain. Repairing the result again changes nothing
/// more, except where a defect remains.
pub fn repair(mesh: &TriMesh, options: &RepairOptions) -> Repaired {
    let mut patient = Patient::admit(mesh);
    // Duplicates hide open edges, and welding makes duplicates.
    duplicate::drop_duplicates(&mut patient);
    weld::weld(&mut patient, options.weld_distance);
    duplicate::drop_duplicates(&mut patient);
    patient.turn_to_agree();
    cut::part(&mut patient);
    flat::give_area(&mut patient);
    hole::fill(&mut patient, options);
    patient.turn_outwards();
    patient.drop_unused_vertices();
    let (mesh, actions) = patient.discharge();
    let report = diagnose(&mesh);
    Repaired { mesh, actions, report }
}
