//! The signed distance in whole numbers: no rounding until the last division.
//!
//! The signed distance of two hulls is the largest separation along any axis, and the axes that can attain it are finitely
//! many: cross products of edges, normals of faces, and what leads from a vertex to a vertex or to an edge. All of them are
//! tried, between any two points of a set, whether they are an edge of its hull or not: an axis too many does no harm.

use tautline::{DVec3, Vec3};

use crate::cases::Pair;

/// Of the extent of a pair, one cell of the lattice that its points are put on: coordinates have 28 bits then, and the
/// longest product below 117.
const CELLS: f64 = (1_u64 << 26) as f64;
/// Axes whose separation in f64 is this near to the largest, as part of the extent, are compared exactly.
const NEAR: f64 = 1e-12;

type Whole = [i128; 3];

/// A pair of point sets on a lattice, relative to the first point.
pub(crate) struct Lattice {
    /// The length of a cell, in m: a power of two.
    cell: f64,
    a: Vec<Whole>,
    b: Vec<Whole>,
}

impl Lattice {
    /// Moves every point to the nearest place of a lattice that is fine for its pair. No f32 becomes longer by that.
    pub(crate) fn snap((a, b): &mut Pair) -> Self {
        let first = a[0].as_dvec3();
        let all = || a.iter().chain(b.iter());
        let extent = all().map(|p| (p.as_dvec3() - first).abs().max_element()).fold(1e-30, f64::max);
        let cell = extent.log2().ceil().exp2() / CELLS;
        let number = |x: f32| (f64::from(x) / cell).round();
        let origin = first.to_array().map(|x| number(x as f32) as i128);
        let mut place = |point: &mut Vec3| {
            let numbers = point.to_array().map(number);
            *point = Vec3::from_array(numbers.map(|n| (n * cell) as f32));
            [0, 1, 2].map(|i| numbers[i] as i128 - origin[i])
        };
        let (a, b) = (a.iter_mut().map(&mut place).collect(), b.iter_mut().map(&mut place).collect());
        Self { cell, a, b }
    }

    /// Above 0 the gap, below 0 the depth, in m: right to the last bit but one of an f64.
    pub(crate) fn signed_distance(&self) -> f64 {
        let mut search = Search::new(self);
        for_each_axis(&self.a, &self.b, |axis| search.attempt(axis));
        search.exact() * self.cell
    }
}

/// The axes that have the largest separation so far.
struct Search<'a> {
    pair: &'a Lattice,
    a: Vec<DVec3>,
    b: Vec<DVec3>,
    largest: f64,
    slack: f64,
    candidates: Vec<(f64, Whole)>,
}

impl<'a> Search<'a> {
    fn new(pair: &'a Lattice) -> Self {
        let round =
            |points: &[Whole]| points.iter().map(|p| DVec3::from_array(p.map(|x| x as f64))).collect();
        let (a, b): (Vec<_>, Vec<_>) = (round(&pair.a), round(&pair.b));
        Self { pair, a, b, largest: f64::NEG_INFINITY, slack: NEAR * CELLS, candidates: Vec::new() }
    }

    fn attempt(&mut self, axis: Whole) {
        let direction = DVec3::from_array(axis.map(|x| x as f64));
        let length = direction.length();
        if length == 0.0 {
            return;
        }
        let (a, b) = (range(&self.a, direction), range(&self.b, direction));
        for (separation, axis) in [(b.0 - a.1, axis), (a.0 - b.1, axis.map(|x| -x))] {
            let separation = separation / length;
            if separation >= self.largest - self.slack {
                self.largest = self.largest.max(separation);
                self.candidates.push((separation, axis));
            }
        }
    }

    /// In cells.
    fn exact(self) -> f64 {
        let near = self.candidates.iter().filter(|(separation, _)| *separation >= self.largest - self.slack);
        near.map(|(_, axis)| self.pair.separation(*axis)).fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Lattice {
    fn separation(&self, axis: Whole) -> f64 {
        let highest = self.a.iter().map(|p| dot(*p, axis)).max().unwrap();
        let lowest = self.b.iter().map(|p| dot(*p, axis)).min().unwrap();
        (lowest - highest) as f64 / DVec3::from_array(axis.map(|x| x as f64)).length()
    }
}

fn for_each_axis(a: &[Whole], b: &[Whole], mut attempt: impl FnMut(Whole)) {
    let (edges_a, edges_b) = (edges(a), edges(b));
    for &p in &edges_a {
        edges_b.iter().for_each(|&q| attempt(cross(p, q)));
    }
    for (own, other) in [(a, b), (b, a)] {
        for i in 0..own.len() {
            for j in 0..i {
                let edge = minus(own[j], own[i]);
                // The normals of faces.
                (0..j).for_each(|k| attempt(cross(edge, minus(own[k], own[i]))));
                // From the edge to a vertex of the other.
                other.iter().for_each(|&vertex| attempt(cross(cross(edge, minus(vertex, own[i])), edge)));
                // Sets on one line have no normals of their own: any axis across will do.
                [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter().for_each(|unit| attempt(cross(edge, unit)));
            }
        }
    }
    for &p in a {
        b.iter().for_each(|&q| attempt(minus(q, p)));
    }
    [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter().for_each(attempt);
}

fn edges(points: &[Whole]) -> Vec<Whole> {
    let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| minus(points[j], points[i])).collect()
}

fn range(points: &[DVec3], axis: DVec3) -> (f64, f64) {
    let heights = points.iter().map(|p| p.dot(axis));
    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
}

fn minus(p: Whole, q: Whole) -> Whole {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

fn dot(p: Whole, q: Whole) -> i128 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: Whole, q: Whole) -> Whole {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

#[test]
fn whole_numbers_know_what_is_known() {
    let cube = crate::cases::block_of(Vec3::splat(0.5));
    let at = |x: f32, y: f32, z: f32| crate::cases::moved(cube.clone(), Vec3::new(x, y, z));
    for (other, expected) in [
        (at(0.0, 0.0, 0.0), -1.0),
        (at(1.0, 0.25, 0.0), 0.0),
        (at(0.75, 0.0, 0.125), -0.25),
        (at(1.0 + 2f32.powi(-20), 0.0, 0.0), 2f64.powi(-20)),
        (at(2.0, 2.0, 0.0), 2f64.sqrt()),
        (at(4.0, 4.0, 2.0), (9.0 + 9.0 + 1.0_f64).sqrt()),
    ] {
        let mut pair = (cube.clone(), other);
        let found = Lattice::snap(&mut pair).signed_distance();
        assert!((found - expected).abs() <= 4e-16 * expected.abs().max(1.0), "{found} is not {expected}");
    }
}
