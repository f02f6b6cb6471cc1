//! What an examination found.

use std::fmt;

use glam::Vec3;
use serde::Serialize;

use crate::mesh::TriMesh;

/// What is wrong with a mesh and what it consists of. Vertices and triangles count from 0, as in the mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// How many vertices there are.
    pub vertices: usize,
    /// How many triangles there are.
    pub triangles: usize,
    /// Everything that is wrong, by kind in the order of [`Defect`], each kind by place.
    pub defects: Vec<Defect>,
    /// Whether all crossings are among the defects. Of very many, the first thousand are named.
    pub has_all_crossings: bool,
    /// What hangs together by edges, by lowest triangle.
    pub components: Vec<Component>,
}

/// Triangles that hang together by edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Component {
    /// The lowest triangle.
    pub first_triangle: u32,
    /// How many triangles there are.
    pub triangles: usize,
    /// Whether every edge has two triangles, and these can be turned so that all agree.
    pub is_closed: bool,
    /// What a closed component encloses, in m³: below 0 if most of its triangles face inwards. 0 of an open one.
    pub volume: f64,
}

/// Something wrong with a mesh, and where.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Defect {
    /// There are no triangles.
    Empty,
    /// A vertex with a coordinate that is NaN or infinite.
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A triangle that names a vertex that is not there.
    MissingVertex {
        /// The triangle.
        triangle: u32,
        /// The number it names.
        vertex: u32,
    },
    /// A triangle whose corners lie on one line, or are not three.
    Degenerate {
        /// The triangle.
        triangle: u32,
    },
    /// A triangle with the corners of an earlier one, in any order.
    Duplicate {
        /// The later one.
        triangle: u32,
        /// The earlier one.
        first: u32,
    },
    /// A vertex that no triangle names.
    Isolated {
        /// The vertex.
        vertex: u32,
    },
    /// Vertices at the same place, at ends of open edges that lie on each other: the surface is torn there.
    Unwelded {
        /// The vertices.
        vertices: Vec<u32>,
    },
    /// An edge of three triangles or more.
    NonManifoldEdge {
        /// Its ends.
        edge: [u32; 2],
        /// The triangles.
        triangles: Vec<u32>,
    },
    /// A triangle that faces the other way than most of those it hangs together with.
    Flipped {
        /// The triangle.
        triangle: u32,
    },
    /// An edge where two triangles disagree however they are turned: a surface with one side, such as a Möbius strip.
    OneSided {
        /// The ends of the edge.
        edge: [u32; 2],
    },
    /// A vertex where fans of triangles meet that share no edge there.
    BowTie {
        /// The vertex.
        vertex: u32,
        /// How many fans.
        fans: usize,
    },
    /// Edges of one triangle each, one after another: the rim of a hole or of a sheet.
    Open {
        /// The vertices along them; of a loop, the first is not repeated.
        vertices: Vec<u32>,
        /// Whether they close.
        is_loop: bool,
    },
    /// Two triangles that cross or touch elsewhere than in a common corner or edge.
    Crossing {
        /// The triangles.
        triangles: [u32; 2],
    },
    /// A closed component that faces inwards and is no cavity in another, or outwards and lies inside another.
    InsideOut {
        /// Its lowest triangle.
        triangle: u32,
    },
}

impl Report {
    /// Whether nothing is wrong: a closed surface that bounds a solid.
    pub fn is_clean(&self) -> bool {
        self.defects.is_empty()
    }

    /// Whether nothing is wrong but that there are open edges: a surface that cloth can be made of.
    pub fn is_clean_but_open(&self) -> bool {
        self.defects.iter().all(|defect| matches!(defect, Defect::Open { .. }))
    }
}

impl Defect {
    /// What it is called, many of it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Empty => "no triangles",
            Self::NotFinite { .. } => "vertices that are not finite",
            Self::MissingVertex { .. } => "triangles of missing vertices",
            Self::Degenerate { .. } => "degenerate triangles",
            Self::Duplicate { .. } => "duplicate triangles",
            Self::Isolated { .. } => "isolated vertices",
            Self::Unwelded { .. } => "unwelded vertices",
            Self::NonManifoldEdge { .. } => "non-manifold edges",
            Self::Flipped { .. } => "flipped triangles",
            Self::OneSided { .. } => "one-sided edges",
            Self::BowTie { .. } => "bow-tie vertices",
            Self::Open { .. } => "open edges",
            Self::Crossing { .. } => "crossing triangles",
            Self::InsideOut { .. } => "inside-out components",
        }
    }

    /// What can be done about it, in a sentence: by [`repair`](super::repair), or by the mesh's author.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::Empty => "there is nothing to repair",
            Self::NotFinite { .. } | Self::MissingVertex { .. } => {
                "repair drops the triangles; look at what wrote the file"
            }
            Self::Degenerate { .. } => "repair drops them, or swaps an edge so that they have an area",
            Self::Duplicate { .. } => "repair keeps one of each, and none of those that divide a solid",
            Self::Isolated { .. } => "repair drops them",
            Self::Unwelded { .. } => {
                "repair makes them one, unless that makes a surface with one side or too many triangles at an edge"
            }
            Self::NonManifoldEdge { .. } | Self::BowTie { .. } => "repair parts the surfaces that meet there",
            Self::Flipped { .. } | Self::InsideOut { .. } => "repair turns them round",
            Self::OneSided { .. } => "repair cuts the surface open there; a solid cannot have such a surface",
            Self::Open { .. } => {
                "repair fills small holes; larger ones need a patch that only the mesh's author knows. A cloth may be open"
            }
            Self::Crossing { .. } => {
                "repair does not part them: unite the solids, or move them apart, where the mesh was made"
            }
        }
    }

    /// The vertices it is at, of those that are there.
    pub fn vertices(&self, mesh: &TriMesh) -> Vec<u32> {
        let corners = |triangles: &[u32]| {
            let known = triangles.iter().filter_map(|&triangle| mesh.triangles.get(triangle as usize));
            known.flatten().copied().collect()
        };
        let mut vertices: Vec<u32> = match self {
            Self::Empty => Vec::new(),
            Self::NotFinite { vertex } | Self::Isolated { vertex } | Self::BowTie { vertex, .. } => {
                vec![*vertex]
            }
            Self::MissingVertex { triangle, .. }
            | Self::Degenerate { triangle }
            | Self::Duplicate { triangle, .. }
            | Self::Flipped { triangle }
            | Self::InsideOut { triangle } => corners(&[*triangle]),
            Self::Crossing { triangles } => corners(triangles),
            Self::NonManifoldEdge { edge, .. } | Self::OneSided { edge } => edge.to_vec(),
            Self::Unwelded { vertices } | Self::Open { vertices, .. } => vertices.clone(),
        };
        vertices.retain(|&vertex| (vertex as usize) < mesh.positions.len());
        vertices
    }

    /// The middle of its vertices, in m; the origin where it has none.
    pub fn place(&self, mesh: &TriMesh) -> Vec3 {
        let vertices = self.vertices(mesh);
        let sum =
            vertices.iter().fold(glam::DVec3::ZERO, |sum, &v| sum + mesh.positions[v as usize].as_dvec3());
        (sum / vertices.len().max(1) as f64).as_vec3()
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "no triangles"),
            Self::NotFinite { vertex } => write!(f, "vertex {vertex} is not finite"),
            Self::MissingVertex { triangle, vertex } => {
                write!(f, "triangle {triangle} names vertex {vertex}, which is not there")
            }
            Self::Degenerate { triangle } => write!(f, "triangle {triangle} has no area"),
            Self::Duplicate { triangle, first } => {
                write!(f, "triangle {triangle} has the corners of {first}")
            }
            Self::Isolated { vertex } => write!(f, "vertex {vertex} is in no triangle"),
            Self::Unwelded { vertices } => write!(f, "vertices {} are at one place", list(vertices)),
            Self::NonManifoldEdge { edge: [a, b], triangles } => {
                write!(f, "edge {a}–{b} has {} triangles: {}", triangles.len(), list(triangles))
            }
            Self::Flipped { triangle } => {
                write!(f, "triangle {triangle} faces the other way than its neighbours")
            }
            Self::OneSided { edge: [a, b] } => write!(f, "at edge {a}–{b} the surface has one side"),
            Self::BowTie { vertex, fans } => write!(f, "at vertex {vertex} {fans} surfaces meet in a point"),
            Self::Open { vertices, is_loop: true } => {
                write!(f, "a rim of {} edges: {}", vertices.len(), list(vertices))
            }
            Self::Open { vertices, is_loop: false } => {
                let count = counted(vertices.len().saturating_sub(1), ["open edge", "open edges"]);
                write!(f, "{count}: {}", list(vertices))
            }
            Self::Crossing { triangles: [a, b] } => write!(f, "triangles {a} and {b} cross or touch"),
            Self::InsideOut { triangle } => write!(f, "the component of triangle {triangle} is inside out"),
        }
    }
}

/// So many of what has these names, alone and in numbers.
pub(super) fn counted(count: usize, [one, many]: [&str; 2]) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// The first of some numbers.
fn list(numbers: &[u32]) -> String {
    const MOST: usize = 6;
    let shown: Vec<String> = numbers.iter().take(MOST).map(u32::to_string).collect();
    let more = if numbers.len() > MOST { " …" } else { "" };
    shown.join(" ") + more
}
