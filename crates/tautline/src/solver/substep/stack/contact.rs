//! One contact of a stack: its lane of a batch of contacts, taken out.

use glam::DVec3;

use crate::simd::Row;

use super::super::batch::PointRows;
use super::super::block::{Rows3, column};
use super::super::elimination::Part;
use super::super::group::{Groups, Lane};
use super::super::held::MOST_POINTS;

/// By how much contacts give way, as a share of how much their bodies do. It decides between points that bear the
/// same load; the speed that it leaves is as small as this share of what the load would give a body in a substep.
const GIVE: f64 = 1e-4;

/// Distances up to this are none, in m: far from the origin positions are no better known, and a stack would be shaken
/// by what is corrected of them.
const SLOP: f64 = 1e-5;

/// What bears and is further apart than this is to close within the substep, in m.
const LOOSE: f64 = 1e-4;

/// Which rows a point has in the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Hold {
    /// None: it is apart, or lets go.
    #[default]
    Off,
    /// The normal: friction slides and stays as it is.
    Slides,
    /// All three.
    Sticks,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Contact {
    at: Lane,
    /// Indices of a and b in the stack.
    pub(super) ends: [u32; 2],
    pub(super) friction: f64,
    /// What its rows are multiplied by, in kg.
    pub(super) stiffness: f64,
    pub(super) points: Vec<Point>,
    /// Combination of the points' distances that no motion of two rigid bodies changes, if there are four.
    redundancy: Option<[f64; MOST_POINTS]>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Point {
    /// Jacobians of the normal and the tangents, for a and b.
    pub(super) lines: [[Part; 2]; 3],
    /// In m.
    separation: f64,
    drift: [f64; 2],
    /// How far its anchors have followed what slides in this step, in m.
    slid: [f64; 2],
    /// Of the normal and the tangents, for the passes.
    masses: [f32; 2],
    /// In kg m.
    pub(super) multipliers: [f64; 3],
    /// What the rows are to lead to, in m a substep.
    pub(super) targets: [f64; 3],
    pub(super) hold: Hold,
    /// Whether it has let go in this solution.
    pub(super) has_let_go: bool,
    /// Where friction points to if it slides, along the tangents: a unit vector.
    pub(super) slides: Option<[f64; 2]>,
}

/// The Jacobian of the distance along a direction, for a and b: how their turns change it is told.
fn line(direction: DVec3, [on_a, on_b]: [DVec3; 2]) -> [Part; 2] {
    let part = |v: DVec3, w: DVec3| [v.x, v.y, v.z, w.x, w.y, w.z];
    [part(-direction, -on_a), part(direction, on_b)]
}

pub(super) fn dot(a: &Part, b: &Part) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

impl Contact {
    /// The contact in a lane.
    pub(super) fn new(at: Lane, groups: &Groups) -> Self {
        let (header, rows) = groups.rows(&at);
        let vector = |rows: &Rows3| column(rows, at.lane()).as_dvec3();
        let number = |row: &Row| f64::from(row.0[at.lane()]);
        let [first, second] = &header.tangents;
        let point = |rows: &PointRows| Point {
            lines: [
                line(vector(&header.normal), [vector(&rows.normal_a), vector(&rows.normal_b)]),
                line(vector(first), [vector(&rows.tangents_a[0]), vector(&rows.tangents_b[0])]),
                line(vector(second), [vector(&rows.tangents_a[1]), vector(&rows.tangents_b[1])]),
            ],
            separation: number(&rows.separation),
            drift: rows.drift.each_ref().map(number),
            masses: [&rows.normal_mass, &rows.tangent_mass].map(|row| row.0[at.lane()]),
            ..Point::default()
        };
        let points: Vec<Point> = rows.iter().map(point).collect();
        let redundancy = redundancy(&points);
        Self { at, friction: number(&header.friction), points, redundancy, ..Self::default() }
    }

    /// Where the velocities of a and b are.
    pub(super) fn places(&self, groups: &Groups) -> [u32; 2] {
        groups.places(&self.at)
    }

    /// Finds how stiff its rows have to be for bodies of these masses (1/kg).
    pub(super) fn weigh(&mut self, inverse_masses: &[f64]) {
        let [a, b] = self.ends.map(|end| inverse_masses[end as usize]);
        self.stiffness = 1.0 / (GIVE * (a + b));
    }

    /// Begins a solution with the multipliers that there are.
    pub(super) fn read(&mut self, groups: &Groups) {
        let (_, rows) = groups.rows(&self.at);
        for (point, rows) in self.points.iter_mut().zip(rows) {
            let [first, second] = &rows.tangent_impulses;
            let number = |row: &Row| f64::from(row.0[self.at.lane()]);
            point.multipliers = [&rows.normal_impulse, first, second].map(number);
            (point.has_let_go, point.slides) = (false, None);
        }
    }

    /// Hands a solution to the passes, so that these do nothing with it. The anchors of what slides follow it.
    pub(super) fn write(&mut self, groups: &mut Groups) {
        for point in self.points.iter_mut().filter(|point| point.slides.is_some()) {
            for (slid, drift) in point.slid.iter_mut().zip(&mut point.drift) {
                *slid += std::mem::take(drift);
            }
        }
        self.write_points(groups);
        self.hand_over(groups, true);
    }

    /// Leaves it to the passes as it was before the last solution. After bodies have moved the rows are still from
    /// before: the relaxing pass moves surfaces too.
    pub(super) fn give_up(&self, groups: &mut Groups, has_moved: bool) {
        if !has_moved {
            self.write_points(groups);
        }
        self.hand_over(groups, false);
    }

    fn write_points(&self, groups: &mut Groups) {
        let lane = self.at.lane();
        for (point, rows) in self.points.iter().zip(groups.rows_mut(&self.at).1) {
            let [normal, first, second] = point.multipliers;
            rows.normal_impulse.0[lane] = normal as f32;
            rows.separation.0[lane] = point.separation as f32;
            let tangents = [
                (&mut rows.tangent_impulses, [first, second]),
                (&mut rows.drift, point.drift),
                (&mut rows.slid, point.slid),
            ];
            for (rows, numbers) in tangents {
                rows.iter_mut().zip(numbers).for_each(|(row, number)| row.0[lane] = number as f32);
            }
        }
    }

    /// What is solved has no mass for the passes, and is not soft.
    fn hand_over(&self, groups: &mut Groups, is_solved: bool) {
        let lane = self.at.lane();
        let (header, rows) = groups.rows_mut(&self.at);
        header.is_soft.0[lane] = if is_solved { 0.0 } else { 1.0 };
        for (point, rows) in self.points.iter().zip(rows) {
            let [normal_mass, tangent_mass] = if is_solved { [0.0; 2] } else { point.masses };
            (rows.normal_mass.0[lane], rows.tangent_mass.0[lane]) = (normal_mass, tangent_mass);
        }
    }

    /// How fast a row moves apart.
    pub(super) fn speed(&self, line: &[Part; 2], velocities: &[Part]) -> f64 {
        let [a, b] = self.ends.map(|end| &velocities[end as usize]);
        dot(&line[0], a) + dot(&line[1], b)
    }

    /// Moves the surfaces by a substep.
    pub(super) fn advance(&mut self, velocities: &[Part]) {
        for k in 0..self.points.len() {
            let [opening, p, q] = [0, 1, 2].map(|j| self.speed(&self.points[k].lines[j], velocities));
            let point = &mut self.points[k];
            point.separation += opening;
            point.drift = [point.drift[0] + p, point.drift[1] + q];
        }
    }

    /// Sets what its rows are to lead to: what bears is led back to a distance of 0 slowly, from both sides, and what
    /// has drifted is pulled back as a whole. Points of rigid bodies cannot do else: noise in single ones would be
    /// answered with forces that only strain.
    pub(super) fn aim(&mut self, [bias, drift_rate]: [f64; 2], limit: f64) {
        let bears = |point: &&Point| point.multipliers[0] > 0.0;
        let bearing = self.points.iter().filter(bears).count().max(1) as f64;
        let sum = |axis: usize| self.points.iter().filter(bears).map(|point| point.drift[axis]).sum::<f64>();
        let slide = [sum(0), sum(1)].map(|sum| -drift_rate * beyond_slop(sum / bearing));
        for point in &mut self.points {
            let separation = point.separation;
            let is_loose = separation > 0.0 && (point.multipliers[0] == 0.0 || separation > LOOSE);
            let back = (-bias * beyond_slop(separation)).min(limit);
            point.targets = [if is_loose { -separation } else { back }, slide[0], slide[1]];
        }
    }

    /// Takes out of the targets what no motion could lead to, if all four points are held.
    pub(super) fn reconcile(&mut self) {
        let Some(redundancy) = self.redundancy else { return };
        if self.points.iter().any(|point| point.hold == Hold::Off) {
            return;
        }
        let excess: f64 = self.points.iter().zip(redundancy).map(|(point, r)| r * point.targets[0]).sum();
        for (point, share) in self.points.iter_mut().zip(redundancy) {
            point.targets[0] -= share * excess;
        }
    }
}

impl Point {
    /// In m.
    pub(super) fn depth(&self) -> f64 {
        -self.separation
    }

    /// The Jacobians of the rows that are held, and what they are to lead to.
    pub(super) fn held_rows(&self) -> impl Iterator<Item = (&[Part; 2], f64)> {
        let count = match self.hold {
            Hold::Off => 0,
            Hold::Slides => 1,
            Hold::Sticks => 3,
        };
        self.lines.iter().zip(self.targets).take(count)
    }
}

fn beyond_slop(distance: f64) -> f64 {
    distance - distance.clamp(-SLOP, SLOP)
}

/// The combination of four points' rows, of length 1, that is zero: by Cramer's rule, from the turns of one body in the
/// plane that they span. `None` if there are not four, or they are in a line.
fn redundancy(points: &[Point]) -> Option<[f64; MOST_POINTS]> {
    if points.len() != MOST_POINTS {
        return None;
    }
    // Of the two bodies the one whose turns tell points apart.
    let turns = |side: usize| [0, 1, 2, 3].map(|k| points[k].lines[0][side]);
    let spread =
        |rows: &[Part; 4]| rows.iter().map(|row| row[3..].iter().map(|x| x * x).sum::<f64>()).sum::<f64>();
    let (a, b) = (turns(0), turns(1));
    let rows = if spread(&a) > spread(&b) { a } else { b }.map(|[.., p, q, r]| DVec3::new(p, q, r));
    let normal = (rows[1] - rows[0]).cross(rows[2] - rows[0]) + (rows[2] - rows[0]).cross(rows[3] - rows[0]);
    let area = |i: usize, j: usize, k: usize| normal.dot((rows[j] - rows[i]).cross(rows[k] - rows[i]));
    let out = [area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2)];
    let length = out.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| out.map(|x| x / length))
}
