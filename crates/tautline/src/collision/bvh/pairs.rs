//! All pairs of boxes that overlap.

use super::{ALL, Bvh, Node, Place};
use crate::collision::Aabb;
use crate::parallel;
use crate::simd::{Instructions, Kernel, LANES, Lanes, run};

/// The tree of the last search is kept until it takes this many times as many tests as when it was built.
const WORN_OUT: f32 = 1.5;

/// Bit 8 i + i for all lanes i.
const DIAGONAL: u64 = 0x8040_2010_0804_0201;
/// Bits 8 i + j for all lanes i < j.
const ABOVE_DIAGONAL: u64 = 0x0080_c0e0_f0f8_fcfe;

/// What [`overlapping_pairs`] keeps from call to call, to be faster. No result depends on it.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairSearch {
    tree: Bvh,
    /// How many tests the tree took when it was built; 0 if it has to be built anew.
    tests_when_built: usize,
    /// Where each box is in the tree's order; empty until one is replaced.
    slots: Vec<u32>,
    /// How many boxes have been replaced since the tree was built.
    replaced: usize,
    /// For every node of the tree one bit for each child in which something is movable.
    movable: Vec<u8>,
    found: Vec<(u32, u32)>,
    sorted: Vec<(u32, u32)>,
    starts: Vec<u32>,
}

/// From so many boxes on it pays to search side by side, …
const WORTHWHILE: usize = 1024;
/// … from so many pairs of nodes at a time.
const CHUNK: usize = 16;

/// Writes the pairs (a, b), a < b, of boxes that overlap or touch, of which at least one is `movable` and which
/// `may_meet`, ascending.
///
/// There are as many flags as boxes.
pub(crate) fn overlapping_pairs(
    boxes: &[Aabb],
    movable: &[bool],
    may_meet: impl Fn(u32, u32) -> bool + Sync,
    instructions: Instructions,
    search: &mut PairSearch,
    pairs: &mut Vec<(u32, u32)>,
) {
    search.find(boxes, movable, may_meet, instructions);
    search.sort(boxes.len(), pairs);
}

impl PairSearch {
    /// Finds what [`overlapping_pairs`] does, and leaves it to be named and sorted.
    pub(crate) fn find(
        &mut self,
        boxes: &[Aabb],
        movable: &[bool],
        may_meet: impl Fn(u32, u32) -> bool + Sync,
        instructions: Instructions,
    ) {
        let is_kept = self.tests_when_built > 0 && self.tree.len() == boxes.len();
        if is_kept {
            self.tree.refit(boxes);
        } else {
            self.build(boxes);
        }
        self.mark(movable);
        let tests = self.descend(&may_meet, instructions);
        if !is_kept {
            self.tests_when_built = tests;
        } else if tests as f32 > WORN_OUT * self.tests_when_built as f32 {
            self.tests_when_built = 0;
        }
    }

    /// Has the boxes of the pairs that were found go by other names, no two by the same.
    pub(crate) fn name(&mut self, names: &[u32]) {
        for (a, b) in &mut self.found {
            let [first, second] = [*a, *b].map(|index| names[index as usize]);
            (*a, *b) = (first.min(second), first.max(second));
        }
    }

    /// Builds the tree of these boxes, to be asked and to have single boxes replaced.
    pub(crate) fn build(&mut self, boxes: &[Aabb]) {
        self.tree.build(boxes);
        self.slots.clear();
        (self.tests_when_built, self.replaced) = (0, 0);
    }

    /// Whether there is a tree of so many boxes, of which less have been replaced than it has.
    pub(crate) fn is_fresh(&self, count: usize) -> bool {
        self.tree.len() == count && self.replaced < count
    }

    /// Gives a box of the tree other bounds.
    pub(crate) fn replace(&mut self, index: u32, bounds: Aabb) {
        if self.slots.len() != self.tree.len() {
            self.slots.resize(self.tree.len(), 0);
            for (slot, &index) in (0..).zip(self.tree.order.indices()) {
                self.slots[index as usize] = slot;
            }
        }
        self.tree.replace(self.slots[index as usize], bounds);
        self.replaced += 1;
    }

    /// Calls `visit` for each box that overlaps or touches `bounds`.
    pub(crate) fn overlaps(&self, bounds: Aabb, instructions: Instructions, visit: impl FnMut(u32)) {
        self.tree.overlaps(bounds, instructions, visit);
    }

    /// Marks what is movable in the tree.
    fn mark(&mut self, movable: &[bool]) {
        let Self { tree, movable: marks, .. } = self;
        marks.clear();
        for items in tree.order.indices().chunks(LANES) {
            marks.push(bits(items.iter().map(|&item| movable[item as usize])));
        }
        for level in tree.levels.windows(2) {
            for start in (level[0]..level[1]).step_by(LANES) {
                let end = level[1].min(start + LANES);
                let mark = bits(marks[start..end].iter().map(|&mark| mark != 0));
                marks.push(mark);
            }
        }
    }

    /// Fills `found`, in any order; returns how many times it tested two nodes.
    fn descend(
        &mut self,
        may_meet: &(impl Fn(u32, u32) -> bool + Sync),
        instructions: Instructions,
    ) -> usize {
        let Self { tree, movable, found, .. } = self;
        found.clear();
        let Some(root) = tree.root() else { return 0 };
        // Side by side, what lies two levels under the root.
        let worthwhile = parallel::is_worthwhile(tree.len(), WORTHWHILE);
        let floor = if worthwhile { root.level.saturating_sub(2) } else { 0 };
        let mut top = Descent::from(vec![(root, root)]);
        run(instructions, SelfOverlap { tree, movable, may_meet, descent: &mut top, floor });
        found.append(&mut top.found);
        let mut descents: Vec<Descent> =
            top.left.chunks(CHUNK).map(|stack| Descent::from(stack.to_vec())).collect();
        parallel::for_each(&mut descents, worthwhile, |descent| {
            run(instructions, SelfOverlap { tree, movable, may_meet, descent, floor: 0 });
        });
        descents.iter_mut().for_each(|descent| found.append(&mut descent.found));
        top.tests + descents.iter().map(|descent| descent.tests).sum::<usize>()
    }

    /// Gives back memory that the next search can do without.
    pub(crate) fn shrink(&mut self) {
        (self.found, self.sorted, self.starts) = (Vec::new(), Vec::new(), Vec::new());
        self.tree.order.shrink();
    }

    /// Writes the pairs that were found, ascending; all names are below `count`. By b, then by a without disturbing
    /// what is equal there, each time counting: several times faster than comparing.
    pub(crate) fn sort(&mut self, count: usize, pairs: &mut Vec<(u32, u32)>) {
        let Self { found, sorted, starts, .. } = self;
        count_sort(found, sorted, starts, count, |&(_, b)| b);
        count_sort(sorted, pairs, starts, count, |&(a, _)| a);
    }
}

fn bits(flags: impl Iterator<Item = bool>) -> u8 {
    (0..).zip(flags).fold(0, |bits, (lane, flag)| bits | u8::from(flag) << lane)
}

/// A way down the tree.
#[derive(Debug, Default)]
struct Descent {
    /// Pairs of nodes that are still to be tested.
    stack: Vec<(Place, Place)>,
    found: Vec<(u32, u32)>,
    /// Pairs of nodes that are left to others.
    left: Vec<(Place, Place)>,
    tests: usize,
}

impl From<Vec<(Place, Place)>> for Descent {
    fn from(stack: Vec<(Place, Place)>) -> Self {
        Self { stack, ..Self::default() }
    }
}

/// Descends the tree against itself, to boxes, or to nodes on the level `floor`.
struct SelfOverlap<'a, F> {
    tree: &'a Bvh,
    movable: &'a [u8],
    may_meet: &'a F,
    descent: &'a mut Descent,
    floor: u32,
}

impl<F: Fn(u32, u32) -> bool> Kernel for SelfOverlap<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { tree, movable, may_meet, descent, floor } = self;
        let Descent { stack, found, left, tests } = descent;
        while let Some((x, y)) = stack.pop() {
            *tests += 1;
            let marks = [x, y].map(|place| u64::from(movable[tree.slot(place)]));
            let mut hits = crossing::<L>(tree.node(x), tree.node(y)) & either(marks);
            if x == y {
                // Each pair once; a node also with itself.
                hits &= if x.level == 1 { ABOVE_DIAGONAL } else { ABOVE_DIAGONAL | DIAGONAL };
            }
            while hits != 0 {
                let bit = hits.trailing_zeros();
                hits &= hits - 1;
                let (Some(below_x), Some(below_y)) = (tree.child(x, bit / 8), tree.child(y, bit % 8)) else {
                    continue;
                };
                if x.level == 1 {
                    let (a, b) = (tree.item(below_x), tree.item(below_y));
                    if may_meet(a, b) {
                        found.push((a.min(b), a.max(b)));
                    }
                } else if below_x.level == floor {
                    left.push((below_x, below_y));
                } else {
                    stack.push((below_x, below_y));
                }
            }
        }
    }
}

/// Bit 8 i + j says whether child i of `x` overlaps child j of `y`.
///
/// All 64 tests, though a few could be spared: they cost less than a branch that cannot be foreseen.
#[inline(always)]
fn crossing<L: Lanes>(x: &Node, y: &Node) -> u64 {
    let mut hits = 0;
    for i in 0..LANES {
        hits |= u64::from(y.overlapping::<L>(x.splat(i))) << (LANES * i);
    }
    hits
}

/// Bit 8 i + j says whether bit i of `x` or bit j of `y` is set.
#[inline(always)]
fn either([x, y]: [u64; 2]) -> u64 {
    // Bit i of x to the lowest bit of byte i, and from there to the whole byte.
    let spread = (0..LANES).fold(0, |spread, i| spread | (x >> i & 1) << (LANES * i));
    (spread * u64::from(ALL)) | (y * 0x0101_0101_0101_0101)
}

/// Copies pairs in the order of their `key`, which is under `count`; those with the same keep their order.
fn count_sort(
    from: &[(u32, u32)],
    to: &mut Vec<(u32, u32)>,
    starts: &mut Vec<u32>,
    count: usize,
    key: impl Fn(&(u32, u32)) -> u32,
) {
    starts.clear();
    starts.resize(count, 0);
    for pair in from {
        starts[key(pair) as usize] += 1;
    }
    let mut start = 0;
    for entry in starts.iter_mut() {
        start += std::mem::replace(entry, start);
    }
    to.resize(from.len(), (0, 0));
    for pair in from {
        let place = &mut starts[key(pair) as usize];
        to[*place as usize] = *pair;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use proptest::prelude::*;

    use super::super::tests::{SETS, boxes, noise, pairs_of, pile};
    use super::*;

    fn all_pairs(boxes: &[Aabb], movable: &[bool]) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for b in 0..boxes.len() {
            let touches = |&a: &usize| (movable[a] || movable[b]) && boxes[a].overlaps(&boxes[b]);
            pairs.extend((0..b).filter(touches).map(|a| (a as u32, b as u32)));
        }
        pairs.sort_unstable();
        pairs
    }

    proptest! {
        #[test]
        fn the_pairs_are_those_of_all_pairs(
            boxes in boxes(200),
            seed in any::<u32>(),
            still in 0..4_u32,
        ) {
            let mut seed = seed;
            let movable: Vec<bool> = boxes.iter().map(|_| noise(&mut seed) * 2.0 + 2.0 >= still as f32).collect();
            for instructions in SETS {
                let (mut search, mut pairs) = (PairSearch::default(), vec![(7, 7)]);
                overlapping_pairs(&boxes, &movable, |_, _| true, instructions, &mut search, &mut pairs);
                prop_assert_eq!(&pairs, &all_pairs(&boxes, &movable));
            }
        }

        #[test]
        fn a_tree_that_is_kept_finds_the_same_pairs(
            scenes in prop::collection::vec(boxes(60), 1..6),
        ) {
            let mut search = PairSearch::default();
            let count = scenes.iter().map(Vec::len).min().unwrap_or(0);
            for scene in &scenes {
                // All of it in other places, or another number of boxes.
                for boxes in [&scene[..count], &scene[..]] {
                    let movable = vec![true; boxes.len()];
                    prop_assert_eq!(pairs_of(boxes, &movable, &mut search), all_pairs(boxes, &movable));
                }
            }
        }

        #[test]
        fn a_tree_with_other_boxes_in_it_is_that_of_all_boxes(
            boxes in boxes(80),
            others in boxes(80),
            every in 1..5_usize,
        ) {
            let mut search = PairSearch::default();
            search.build(&boxes);
            let mut now = boxes.clone();
            for (index, bounds) in others.iter().take(boxes.len()).enumerate().step_by(every) {
                now[index] = *bounds;
                search.replace(index as u32, *bounds);
            }
            for bounds in now.iter().chain(&others) {
                let mut found = Vec::new();
                search.overlaps(*bounds, Instructions::Widest, |index| found.push(index as usize));
                found.sort_unstable();
                let expected: Vec<usize> = (0..now.len()).filter(|&i| now[i].overlaps(bounds)).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn a_hundred_boxes_in_one_place_all_overlap() {
        let boxes = vec![Aabb::around(&[Vec3::ONE], 0.5); 100];
        let pairs = pairs_of(&boxes, &[true; 100], &mut PairSearch::default());
        assert_eq!(pairs, all_pairs(&boxes, &[true; 100]));
        assert_eq!(pairs.len(), 4950);
    }

    #[test]
    fn a_large_pile_has_the_pairs_of_all_pairs() {
        let boxes = pile(3000, 1);
        let movable: Vec<bool> = (0..boxes.len()).map(|i| i % 3 > 0).collect();
        assert_eq!(pairs_of(&boxes, &movable, &mut PairSearch::default()), all_pairs(&boxes, &movable));
    }

    /// Boxes that cannot move and overlap each other must not cost: they come in thousands, as tiles of a ground.
    #[test]
    fn still_boxes_are_not_searched() {
        let boxes = pile(4096, 3);
        let mut movable = vec![false; boxes.len()];
        movable[17] = true;
        let mut search = PairSearch::default();
        pairs_of(&boxes, &movable, &mut search);
        assert!(search.tests_when_built < 100, "{}", search.tests_when_built);
    }

    /// A few hills and walls among small boxes, and one box lost far away, do not spoil the tree for the others.
    #[test]
    fn huge_and_far_boxes_cost_their_own_pairs_only() {
        let mut boxes = pile(4096, 5);
        let mut search = PairSearch::default();
        let mut count_tests = |boxes: &[Aabb]| {
            search.tests_when_built = 0;
            let pairs = pairs_of(boxes, &vec![true; boxes.len()], &mut search);
            (search.tests_when_built, pairs.len())
        };
        let (alone, pairs_alone) = count_tests(&boxes);
        boxes.extend((0..4).map(|i| Aabb::around(&[Vec3::splat(8.0 * i as f32 - 8.0)], 50.0)));
        boxes.push(Aabb::around(&[Vec3::splat(1e9)], 1.0));
        let (together, pairs_together) = count_tests(&boxes);
        // With all other groups each group with a huge box has to be tested.
        assert_eq!(pairs_together, pairs_alone + 4 * 4096 + 6);
        assert!(together < alone + 4 * 4096 / 8 * 5 / 4, "{alone} {together}");
    }
}
