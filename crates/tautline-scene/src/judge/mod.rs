//! What is wrong with a cloth or a rope, told from positions alone and in `f64`: triangles that pass through each
//! other, ropes that pierce cloth, edges that are too long, points inside solids.
//!
//! It knows no world and shares nothing with the engine's collision detection, so that any engine's state can be
//! judged, and by the same measure. Nothing in it panics: what has no corner or no finite place takes no part, and a
//! length that is not a number makes the stretch one.
//!
//! ```
//! use tautline::Vec3;
//! use tautline::mesh::primitives;
//! use tautline_scene::judge::{Sheet, grid_edges, intersections, rope_pierces, stretch};
//!
//! let cloth = primitives::grid(10, 10, 2.0, 2.0)?;
//! let sheet = Sheet { positions: &cloth.positions, triangles: &cloth.triangles };
//! assert!(intersections(&[sheet]).is_empty());
//! assert_eq!(rope_pierces(&[Vec3::new(0.1, 1.0, 0.05), Vec3::new(0.1, -1.0, 0.05)], &[sheet]).len(), 1);
//! assert!(stretch(&cloth.positions, &grid_edges(10, 10, 2.0, 2.0)).max < 1e-6);
//! # Ok::<(), tautline::Error>(())
//! ```

mod crossing;
mod depth;
mod intersection;
mod stretch;

pub use depth::Polytope;
pub use intersection::{Pierce, Sheet, TriangleId, intersections, rope_pierces};
pub use stretch::{Edge, Stretch, grid_edges, rope_edges, sheet_edges, stretch};
