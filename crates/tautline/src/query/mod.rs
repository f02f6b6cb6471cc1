//! What is where in a world: rays, moving shapes, overlaps and closest points, over bodies of every kind.
//!
//! Rigid bodies and half-spaces are solid; the surfaces of trusses and cloth are sheets of triangles without
//! thickness, ropes are chains of capsules. Shapes meet trusses by the convex hull of their vertices.
//!
//! The tree that is searched is made when a world is asked for the first time since something in it moved, which
//! costs 0.2 to 0.4 µs for each convex part, triangle and segment; meshes have a tree of their own.

mod index;
mod piece;
mod point;
mod ray;
mod shape;

use crate::body::{Body, CollisionGroups, HalfSpace, Substance};
use crate::error::Error;
use crate::world::{BodyHandle, World};

pub(crate) use index::Index;
pub(crate) use piece::{Piece, solid_piece_count};
pub use point::PointHit;
pub use ray::RayHit;
pub use shape::CastHit;

/// Which bodies a query is about.
///
/// ```
/// use tautline::{HalfSpace, QueryFilter, Settings, Vec3, World};
///
/// let mut world = World::new(Settings::default())?;
/// let floor = world.add(HalfSpace::floor(1.0))?;
/// let down = |filter| world.ray_cast(Vec3::Y * 5.0, Vec3::NEG_Y, 100.0, filter);
/// let hit = down(QueryFilter::default())?.expect("the floor is there");
/// assert_eq!((hit.body, hit.distance), (floor, 4.0));
/// assert_eq!(down(QueryFilter { exclude: Some(floor), ..QueryFilter::default() })?, None);
/// # Ok::<(), tautline::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QueryFilter {
    /// Bodies that would collide with something of these groups.
    pub groups: CollisionGroups,
    /// But not this one.
    pub exclude: Option<BodyHandle>,
    /// Whether bodies that never move are found, half-spaces among them.
    pub fixed: bool,
    /// Whether bodies that can move are found.
    pub movable: bool,
}

impl Default for QueryFilter {
    /// Every body.
    fn default() -> Self {
        Self { groups: CollisionGroups::default(), exclude: None, fixed: true, movable: true }
    }
}

/// A filter whose handle has been looked up.
#[derive(Debug, Clone, Copy)]
struct Selection {
    filter: QueryFilter,
    exclude: Option<usize>,
}

impl Selection {
    fn includes(&self, index: usize, body: &Body) -> bool {
        let groups = body.rigid().map_or(CollisionGroups::default(), |rigid| rigid.traits.groups);
        let is_asked_for = if body.fixed { self.filter.fixed } else { self.filter.movable };
        is_asked_for && self.exclude != Some(index) && groups.collide_with(self.filter.groups)
    }
}

impl World {
    fn select(&self, filter: QueryFilter) -> Result<Selection, Error> {
        let exclude = filter.exclude.map(|handle| self.slots.index(handle)).transpose()?;
        Ok(Selection { filter, exclude })
    }

    fn query_index(&self) -> &Index {
        self.index.get_or_init(|| Index::new(&self.bodies, &self.particles.position))
    }

    /// The half-spaces that are selected, with their indices.
    fn selected_walls(&self, selection: Selection) -> impl Iterator<Item = (usize, &HalfSpace)> {
        let bodies = self.bodies.iter().enumerate();
        bodies.filter_map(move |(index, body)| match &body.substance {
            Substance::HalfSpace(wall) if selection.includes(index, body) => Some((index, wall.as_ref())),
            _ => None,
        })
    }

    /// A piece in the tree and its body's index, if it is selected.
    fn selected_piece(&self, item: u32, selection: Selection) -> Option<(usize, Piece<'_>)> {
        let item = self.query_index().item(item);
        if !selection.includes(item.body, &self.bodies[item.body]) {
            return None;
        }
        Some((item.body, item.piece(&self.bodies, &self.particles.position)?))
    }
}

/// As an upper bound in f32: no smaller, and with room for what rounds in the boxes.
fn at_most(bound: f64) -> f32 {
    (bound * (1.0 + 1e-6)) as f32
}
