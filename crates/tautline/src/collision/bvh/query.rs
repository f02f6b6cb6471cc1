//! What a box overlaps, what a ray or a moving box may hit first, and what lies nearest to a point.

use glam::Vec3;

use super::{ALL, Bvh, Node, Place};
use crate::collision::Aabb;
use crate::simd::{Instructions, Kernel, Lanes, Row, Vec3x8, run};

/// How much later a ray may leave a box than computed, by rounding, as a factor: 1 + 2 γ₃ (Ize 2013, "Robust BVH
/// ray traversal", 3.1).
const LEAVES_LATE: f32 = 1.0 + 6.0 * f32::EPSILON;

impl Bvh {
    /// Calls `visit` for each box that overlaps or touches `bounds`.
    pub(crate) fn overlaps(&self, bounds: Aabb, instructions: Instructions, visit: impl FnMut(u32)) {
        run(instructions, Overlaps { tree: self, bounds, visit });
    }

    /// Calls `visit` for boxes that a ray may enter, with the t of origin + t · direction, 0 ≤ t ≤ `max`, from which
    /// on it is inside. `visit` returns the new `max`, such as where the ray hits what is in the box. Nearer boxes
    /// come earlier, mostly; of equal ones each is visited.
    pub(crate) fn ray(
        &self,
        origin: Vec3,
        direction: Vec3,
        max: f32,
        instructions: Instructions,
        visit: impl FnMut(u32, f32) -> f32,
    ) {
        let point = Aabb { low: origin, high: origin };
        self.sweep(point, direction, max, instructions, visit);
    }

    /// As [`Bvh::ray`], for a box that moves from `bounds` along `direction`.
    pub(crate) fn sweep(
        &self,
        bounds: Aabb,
        direction: Vec3,
        max: f32,
        instructions: Instructions,
        visit: impl FnMut(u32, f32) -> f32,
    ) {
        let bound = Sweep { bounds, direction };
        run(instructions, NearestFirst { tree: self, bound, max, visit });
    }

    /// Calls `visit` for boxes within the distance `max` (m) of a point, with their distance. `visit` returns the new
    /// `max`, such as the distance of what is in the box. Nearer boxes come earlier, mostly; of equal ones each is
    /// visited.
    pub(crate) fn nearest(
        &self,
        point: Vec3,
        max: f32,
        instructions: Instructions,
        visit: impl FnMut(u32, f32) -> f32,
    ) {
        run(instructions, NearestFirst { tree: self, bound: Distance { point }, max, visit });
    }
}

struct Overlaps<'a, F> {
    tree: &'a Bvh,
    bounds: Aabb,
    visit: F,
}

impl<F: FnMut(u32)> Kernel for Overlaps<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let bounds = [Vec3x8::<L>::splat(self.bounds.low), Vec3x8::splat(self.bounds.high)];
        let mut stack: Vec<Place> = self.tree.root().into_iter().collect();
        while let Some(place) = stack.pop() {
            let mut hits = self.tree.node(place).overlapping(bounds);
            while hits != 0 {
                let child = self.tree.child(place, hits.trailing_zeros());
                hits &= hits - 1;
                let Some(child) = child else { continue };
                if child.level == 0 {
                    (self.visit)(self.tree.item(child));
                } else {
                    stack.push(child);
                }
            }
        }
    }
}

/// Something that boxes have more or less of.
trait Bound {
    /// For each child of a node no more than anything in it can have; infinite if it cannot have it at all.
    fn at_least<L: Lanes>(&self, node: &Node) -> L;
}

/// The time when a moving box enters another.
struct Sweep {
    bounds: Aabb,
    /// Per unit of time.
    direction: Vec3,
}

impl Bound for Sweep {
    /// The slab test: between entering the last and leaving the first of three pairs of planes the ray is inside.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn at_least<L: Lanes>(&self, node: &Node) -> L {
        let mut enter = L::splat(0.0);
        let mut leave = L::splat(f32::MAX);
        for axis in 0..3 {
            // Relative to the moving box shrunk to a point, the other grown by its size.
            let low = L::load(&node.low[axis]) - L::splat(self.bounds.high[axis]);
            let high = L::load(&node.high[axis]) - L::splat(self.bounds.low[axis]);
            let inverse = 1.0 / self.direction[axis];
            let [near, far] = if inverse.is_sign_negative() { [high, low] } else { [low, high] };
            // Along a plane it never meets, 0 · ∞ = NaN says so, and `max` and `min` pass over it.
            enter = (near * L::splat(inverse)).max(enter);
            leave = (far * L::splat(inverse) * L::splat(LEAVES_LATE)).min(leave);
        }
        enter.greater(leave).select(L::splat(f32::INFINITY), enter)
    }
}

/// The distance from a point.
struct Distance {
    point: Vec3,
}

impl Bound for Distance {
    #[inline(always)]
    fn at_least<L: Lanes>(&self, node: &Node) -> L {
        let point = Vec3x8::<L>::splat(self.point);
        let (below, above) = (Vec3x8::load(&node.low) - point, point - Vec3x8::load(&node.high));
        let outside = |below: L, above: L| below.max(above).max(L::splat(0.0));
        let gap = [(below.x, above.x), (below.y, above.y), (below.z, above.z)].map(|(b, a)| outside(b, a));
        Vec3x8::new(gap[0], gap[1], gap[2]).length()
    }
}

/// Visits what may have less than `max`, what may have least first.
struct NearestFirst<'a, B, F> {
    tree: &'a Bvh,
    bound: B,
    max: f32,
    visit: F,
}

impl<B: Bound, F: FnMut(u32, f32) -> f32> Kernel for NearestFirst<'_, B, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let mut stack: Vec<(f32, Place)> = self.tree.root().map(|root| (0.0, root)).into_iter().collect();
        while let Some((least, place)) = stack.pop() {
            if least > self.max {
                continue;
            }
            if place.level == 0 {
                self.max = (self.visit)(self.tree.item(place), least);
                continue;
            }
            let bounds = self.bound.at_least::<L>(self.tree.node(place));
            let mut row = Row::ZERO;
            bounds.store(&mut row);
            // Lanes without a child have an infinite bound.
            let limit = L::splat(if self.max < f32::MAX { self.max } else { f32::MAX });
            let mut hits = !bounds.greater(limit).bits() & ALL;
            let first = stack.len();
            while hits != 0 {
                let lane = hits.trailing_zeros();
                hits &= hits - 1;
                let child = self.tree.child(place, lane);
                stack.extend(child.map(|child| (row.0[lane as usize], child)));
            }
            stack[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::PairSearch;
    use super::super::tests::{SETS, boxes, pairs_of, pile};
    use super::*;

    fn vector(range: std::ops::Range<f32>) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(prop_oneof![3 => range, 1 => Just(0.0), 1 => Just(1.0)]).prop_map(Vec3::from)
    }

    /// When the ray enters the box, in f64.
    fn enters(bounds: &Aabb, origin: Vec3, direction: Vec3) -> Option<f64> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let [low, high, from, along] =
                [bounds.low[axis], bounds.high[axis], origin[axis], direction[axis]].map(f64::from);
            if along == 0.0 {
                if !(low..=high).contains(&from) {
                    return None;
                }
                continue;
            }
            let (s, t) = ((low - from) / along, (high - from) / along);
            (enter, leave) = (enter.max(s.min(t)), leave.min(s.max(t)));
        }
        (enter <= leave).then_some(enter)
    }

    /// Infinity less the infinity of an empty lane is no number, and was taken for an overlap: the number of a box that
    /// there is not.
    #[test]
    fn what_is_not_finite_does_not_meet_empty_lanes() {
        let extremes = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MAX, -f32::MAX, 0.0];
        let odd = || {
            extremes
                .into_iter()
                .flat_map(|low| extremes.map(|high| [low, high]))
                .map(|[low, high]| Aabb { low: Vec3::splat(low), high: Vec3::splat(high) })
        };
        for count in [1, 3, 9, 70] {
            let ordinary = || pile(count, 1).into_iter();
            for boxes in odd().map(|odd| ordinary().chain([odd]).collect::<Vec<_>>()) {
                let found = pairs_of(&boxes, &vec![true; boxes.len()], &mut PairSearch::default());
                let expected = |a: u32, b: u32| boxes[a as usize].overlaps(&boxes[b as usize]);
                let others = (0..count as u32).flat_map(|b| (0..b).map(move |a| (a, b)));
                assert!(
                    others.filter(|&(a, b)| expected(a, b)).all(|pair| found.binary_search(&pair).is_ok())
                );
                let tree = Bvh::new(&boxes);
                for asked in odd() {
                    tree.overlaps(asked, Instructions::Widest, |index| {
                        assert!((index as usize) < boxes.len())
                    });
                    tree.nearest(asked.low, f32::INFINITY, Instructions::Widest, |_, at_least| at_least);
                    tree.sweep(asked, asked.high, f32::INFINITY, Instructions::Widest, |_, enter| enter);
                }
            }
        }
    }

    proptest! {
        #[test]
        fn a_box_overlaps_what_it_overlaps_one_by_one(
            boxes in boxes(200),
            low in vector(-5.0..5.0),
            size in 0.0_f32..4.0,
        ) {
            let tree = Bvh::new(&boxes);
            let bounds = Aabb { low, high: low + size };
            let expected: Vec<u32> = (0..).zip(&boxes).filter(|(_, b)| b.overlaps(&bounds)).map(|(i, _)| i).collect();
            for instructions in SETS {
                let mut found = Vec::new();
                tree.overlaps(bounds, instructions, |index| found.push(index));
                found.sort_unstable();
                prop_assert_eq!(&found, &expected);
            }
        }

        #[test]
        fn a_ray_meets_every_box_in_its_way(
            boxes in boxes(200),
            origin in vector(-6.0..6.0),
            direction in vector(-1.0..1.0),
        ) {
            let tree = Bvh::new(&boxes);
            let mut found = Vec::new();
            tree.ray(origin, direction, 10.0, Instructions::Widest, |index, enter| {
                found.push((index, enter));
                10.0
            });
            for (index, bounds) in (0..).zip(&boxes) {
                let seen = found.iter().find(|&&(i, _)| i == index);
                match (enters(bounds, origin, direction), seen) {
                    (Some(exact), Some(&(_, enter))) => {
                        prop_assert!((f64::from(enter) - exact).abs() <= 1e-5 * exact.abs().max(1.0));
                    }
                    (Some(exact), None) => prop_assert!(exact > 10.0 - 1e-4, "missed {index} at {exact}"),
                    (None, Some(_)) => {
                        let grown = Aabb { low: bounds.low - 1e-4, high: bounds.high + 1e-4 };
                        prop_assert!(enters(&grown, origin, direction).is_some(), "no hit on {index}");
                    }
                    (None, None) => {}
                }
            }
        }

        #[test]
        fn a_ray_that_is_cut_short_ends_at_the_first_box(
            boxes in boxes(200),
            origin in vector(-6.0..6.0),
            direction in vector(-1.0..1.0),
        ) {
            let tree = Bvh::new(&boxes);
            let (mut first, mut visited) = (f32::INFINITY, 0);
            tree.ray(origin, direction, f32::INFINITY, Instructions::Widest, |_, enter| {
                visited += 1;
                first = first.min(enter);
                first
            });
            let exact = boxes.iter().filter_map(|b| enters(b, origin, direction)).fold(f64::INFINITY, f64::min);
            if exact.is_finite() {
                prop_assert!(f64::from(first) <= exact * (1.0 + 1e-5) + 1e-5);
            }
            prop_assert!(visited <= boxes.len());
        }

        #[test]
        fn a_sweep_is_a_ray_to_grown_boxes(
            boxes in boxes(100),
            origin in vector(-6.0..6.0),
            direction in vector(-1.0..1.0),
            half in 0.0_f32..2.0,
        ) {
            let tree = Bvh::new(&boxes);
            let mut found = vec![None; boxes.len()];
            let moving = Aabb { low: origin - half, high: origin + half };
            tree.sweep(moving, direction, 10.0, Instructions::Widest, |index, enter| {
                found[index as usize] = Some(enter);
                10.0
            });
            for (bounds, found) in boxes.iter().zip(found) {
                let grown = |by: f32| Aabb { low: bounds.low - half - by, high: bounds.high + half + by };
                match enters(&grown(-1e-4), origin, direction) {
                    Some(exact) if exact < 9.99 => prop_assert!(found.is_some()),
                    _ => {}
                }
                if found.is_some() {
                    prop_assert!(enters(&grown(1e-4), origin, direction).is_some());
                }
            }
        }

        #[test]
        fn the_nearest_boxes_come_with_their_distance(
            boxes in boxes(200),
            point in vector(-6.0..6.0),
        ) {
            let tree = Bvh::new(&boxes);
            let distance = |b: &Aabb| (b.low - point).max(point - b.high).max(Vec3::ZERO).length();
            let mut nearest = f32::INFINITY;
            let mut wrong = 0;
            tree.nearest(point, f32::INFINITY, Instructions::Widest, |index, at_least| {
                wrong += usize::from((at_least - distance(&boxes[index as usize])).abs() > 1e-5 * at_least.max(1.0));
                nearest = nearest.min(at_least);
                nearest
            });
            prop_assert_eq!(wrong, 0);
            let expected = boxes.iter().map(distance).fold(f32::INFINITY, f32::min);
            prop_assert!(nearest == expected || (nearest - expected).abs() <= 1e-6 * expected);
        }
    }
}
