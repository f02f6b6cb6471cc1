//! A tree over boxes: which of them overlap each other, and which a box, a ray or a sweep may meet.
//!
//! Eight children to a node, so that one node is one test in lanes (Wald, Benthin & Boulos 2008, "Getting rid of
//! packets"). The boxes are put in an order in which neighbours in the list are neighbours in space; then eight in a
//! row share a node, eight such nodes in a row the node above, and so on up. Such a tree needs no links, and when
//! boxes move only its bounds change.

mod order;
mod pairs;
mod query;

pub(crate) use pairs::{PairSearch, overlapping_pairs};

use glam::Vec3;

use super::Aabb;
use crate::simd::{LANES, Lanes, Row, Vec3x8};
use order::SpatialOrder;

/// The bits of all lanes.
const ALL: u32 = (1 << LANES) - 1;

/// A tree over boxes. What it finds does not depend on when it was built, but the order in which it does.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bvh {
    order: SpatialOrder,
    /// The nodes level by level, those around boxes first, the root last.
    nodes: Vec<Node>,
    /// Where each level begins in `nodes`.
    levels: Vec<usize>,
}

/// The bounds of eight children. Lanes without a child hold a box that nothing overlaps.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: [Row; 3],
    high: [Row; 3],
}

/// Something in the tree: at level 0 a box, by its place in the order; above, a node, by its number in the level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    level: u32,
    number: u32,
}

impl Bvh {
    /// The tree of these boxes. Costs about 0.1 µs for each. What meets a box that is not finite is undefined, and no
    /// other's.
    pub(crate) fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self::default();
        tree.build(boxes);
        tree
    }

    /// [`Bvh::new`] into the memory of another tree.
    pub(crate) fn build(&mut self, boxes: &[Aabb]) {
        self.order.arrange(boxes);
        self.levels.clear();
        let mut node_count = 0;
        let mut children = boxes.len();
        while children > 1 || self.levels.is_empty() && children == 1 {
            children = children.div_ceil(LANES);
            self.levels.push(node_count);
            node_count += children;
        }
        self.nodes.resize(node_count, Node::EMPTY);
        self.refit(boxes);
    }

    /// Takes over the bounds of as many boxes as before, which may have moved. The farther they went, the slower
    /// is the search.
    pub(crate) fn refit(&mut self, boxes: &[Aabb]) {
        let on_boxes = self.levels.get(1).copied().unwrap_or(self.nodes.len());
        for (node, items) in self.nodes[..on_boxes].iter_mut().zip(self.order.indices().chunks(LANES)) {
            *node = Node::around(items.iter().map(|&item| boxes[item as usize]));
        }
        for level in self.levels.windows(2) {
            let (below, above) = self.nodes.split_at_mut(level[1]);
            for (node, children) in above.iter_mut().zip(below[level[0]..].chunks(LANES)) {
                *node = Node::around(children.iter().map(Node::bounds));
            }
        }
    }

    /// Gives the box in one place of the order other bounds; that also costs the search if it goes far.
    fn replace(&mut self, slot: u32, mut bounds: Aabb) {
        let mut number = slot as usize;
        for &start in &self.levels {
            let node = &mut self.nodes[start + number / LANES];
            node.set(number % LANES, bounds);
            bounds = node.bounds();
            number /= LANES;
        }
    }

    /// How many boxes it holds.
    pub(crate) fn len(&self) -> usize {
        self.order.indices().len()
    }

    fn root(&self) -> Option<Place> {
        (!self.levels.is_empty()).then_some(Place { level: self.levels.len() as u32, number: 0 })
    }

    /// How many boxes there are, or nodes on a higher level.
    #[inline(always)]
    fn count(&self, level: u32) -> usize {
        match level as usize {
            0 => self.len(),
            level => self.levels.get(level).unwrap_or(&self.nodes.len()) - self.levels[level - 1],
        }
    }

    /// What is in a lane of a node, if anything is: boxes or rays that are not finite also meet the box of an empty
    /// lane.
    #[inline(always)]
    fn child(&self, place: Place, lane: u32) -> Option<Place> {
        let child = Place { level: place.level - 1, number: place.number * LANES as u32 + lane };
        ((child.number as usize) < self.count(child.level)).then_some(child)
    }

    /// Where a node, not a box, lies in `nodes`.
    #[inline(always)]
    fn slot(&self, place: Place) -> usize {
        self.levels[place.level as usize - 1] + place.number as usize
    }

    #[inline(always)]
    fn node(&self, place: Place) -> &Node {
        &self.nodes[self.slot(place)]
    }

    /// Which of the boxes one at level 0 is.
    #[inline(always)]
    fn item(&self, place: Place) -> u32 {
        self.order.indices()[place.number as usize]
    }
}

impl Node {
    const EMPTY: Self =
        Self { low: [Row([f32::INFINITY; LANES]); 3], high: [Row([f32::NEG_INFINITY; LANES]); 3] };

    fn around(children: impl Iterator<Item = Aabb>) -> Self {
        let mut node = Self::EMPTY;
        for (lane, bounds) in children.enumerate() {
            node.set(lane, bounds);
        }
        node
    }

    fn set(&mut self, lane: usize, bounds: Aabb) {
        for axis in 0..3 {
            self.low[axis].0[lane] = bounds.low[axis];
            self.high[axis].0[lane] = bounds.high[axis];
        }
    }

    fn bounds(&self) -> Aabb {
        let low = self.low.map(|row| row.0.into_iter().fold(f32::INFINITY, f32::min));
        let high = self.high.map(|row| row.0.into_iter().fold(f32::NEG_INFINITY, f32::max));
        Aabb { low: Vec3::from(low), high: Vec3::from(high) }
    }

    /// The box of one child in all lanes: its lowest and highest corner.
    #[inline(always)]
    fn splat<L: Lanes>(&self, lane: usize) -> [Vec3x8<L>; 2] {
        let ([x, y, z], [u, v, w]) = (&self.low, &self.high);
        let low = Vec3x8::new(L::splat(x.0[lane]), L::splat(y.0[lane]), L::splat(z.0[lane]));
        [low, Vec3x8::new(L::splat(u.0[lane]), L::splat(v.0[lane]), L::splat(w.0[lane]))]
    }

    /// One bit for each child that overlaps or touches the box in the same lane.
    #[inline(always)]
    fn overlapping<L: Lanes>(&self, [low, high]: [Vec3x8<L>; 2]) -> u32 {
        // Differences have the right sign even where they round or overflow.
        let below = Vec3x8::load(&self.low) - high;
        let above = low - Vec3x8::load(&self.high);
        let gap = below.x.max(below.y).max(below.z.max(above.x)).max(above.y.max(above.z));
        !gap.greater(L::splat(0.0)).bits() & ALL
    }
}

/// What the tests of pairs and of queries share.
#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::simd::Instructions;

    pub(super) const SETS: [Instructions; 3] =
        [Instructions::Widest, Instructions::Baseline, Instructions::Scalar];

    /// All pairs that overlap.
    pub(super) fn pairs_of(boxes: &[Aabb], movable: &[bool], search: &mut PairSearch) -> Vec<(u32, u32)> {
        let mut pairs = vec![(7, 7)];
        overlapping_pairs(boxes, movable, |_, _| true, Instructions::Widest, search, &mut pairs);
        pairs
    }

    pub(super) fn noise(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*seed >> 8) as f32 / 8_388_608.0 - 1.0
    }

    /// A jittered grid of boxes 1.08 wide, in the order of the grid.
    pub(super) fn pile(count: usize, mut seed: u32) -> Vec<Aabb> {
        let side = (1..).find(|side| side * side * side >= count).unwrap_or(1);
        let corner =
            |c: usize| Vec3::new((c % side) as f32, (c / side % side) as f32, (c / side / side) as f32);
        let mut jitter = || Vec3::new(noise(&mut seed), noise(&mut seed), noise(&mut seed)) * 0.25;
        (0..count).map(|cell| Aabb::around(&[corner(cell) + jitter()], 0.54)).collect()
    }

    /// Boxes as worlds have them: small ones, plates, rods, walls and hills, some of them on a lattice so that they
    /// touch or are the same.
    pub(super) fn boxes(most: usize) -> impl Strategy<Value = Vec<Aabb>> {
        let lattice = (prop::array::uniform3(-3_i8..3), prop::array::uniform3(0_i8..2))
            .prop_map(|(at, size)| (Vec3::from(at.map(f32::from)), Vec3::from(size.map(f32::from))));
        let size = prop_oneof![Just(0.01_f32), Just(0.0), 0.1_f32..2.0, Just(100.0)];
        let anywhere = (prop::array::uniform3(-5.0_f32..5.0), prop::array::uniform3(size))
            .prop_map(|(at, size)| (Vec3::from(at), Vec3::from(size)));
        let far = (prop::array::uniform3(-1e9_f32..1e9), 0.0_f32..10.0)
            .prop_map(|(at, s)| (at.into(), Vec3::splat(s)));
        let any = prop_oneof![8 => lattice, 8 => anywhere, 1 => far];
        prop::collection::vec(any.prop_map(|(low, size)| Aabb { low, high: low + size }), 0..most)
    }
}
