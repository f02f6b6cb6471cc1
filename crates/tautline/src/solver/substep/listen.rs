//! How hard bodies that report their contacts press on each other, summed up over the substeps of a step.
//!
//! At the end of a substep a multiplier divided by the substep is the impulse of that substep, with what was carried
//! over from the one before and what a blow added. Nothing is done here for pairs that nobody listens to.

use glam::{Mat3, Vec3};

use super::RigidSolver;
use super::batch::{Batch, HeaderRows, PointRows};
use super::block::{column, columns};
use super::crew::Crew;
use super::group::{Groups, Lane};
use super::lineup::Lineup;
use super::pairs::{Pair, Pairs};
use crate::body::Body;
use crate::norm::Norm;
use crate::order::PutInOrder;
use crate::simd::{LANES, Row};

/// Bodies that have touched and are no further apart than this still do, in m.
const NEAR: f32 = 1e-4;

/// How two bodies pressed on each other in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Press {
    /// Their indices, ascending.
    pub(crate) bodies: [u32; 2],
    /// The sum of normal impulses, in N s. 0: they were only close to it.
    pub(crate) impulse: f32,
    /// Unit, from the first to the second, and where they pressed, in m; means by impulse.
    pub(crate) normal: Vec3,
    pub(crate) point: Vec3,
    /// How fast they approached each other just before, in m/s.
    pub(crate) approach_speed: f32,
    /// Whether they were close to each other in the end.
    pub(crate) is_near: bool,
}

/// The pairs that somebody listens to.
#[derive(Debug, Clone, Default)]
pub(super) struct Listener {
    /// Whether any body reports its contacts.
    is_needed: bool,
    heard: Vec<Heard>,
    /// What was heard in the parts of the step that are over, by pairs of parts. Normal and point are sums.
    presses: Vec<Press>,
}

/// What is heard of one pair of parts.
#[derive(Debug, Clone)]
struct Heard {
    /// Where its rows are.
    at: Lane,
    pair: u32,
    /// Where the bodies' blocks are.
    places: [u32; 2],
    /// Over all points and substeps: impulses, and impulses times places.
    impulse: f32,
    moment: Vec3,
    approach_speed: f32,
}

impl Listener {
    pub(super) fn new(bodies: &[Body]) -> Self {
        Self { is_needed: bodies.iter().any(Body::reports_contacts), heard: Vec::new(), presses: Vec::new() }
    }

    pub(super) fn begin_step(&mut self) {
        self.presses.clear();
    }

    /// Finds the rows of the pairs to be listened to in this step.
    pub(super) fn begin(&mut self, groups: &Groups, pairs: &Pairs, bodies: &[Body], lineup: &Lineup) {
        self.heard.clear();
        if !self.is_needed {
            return;
        }
        // A half-space has no place.
        let place = |body: u32| lineup.moving_place(lineup.place_of[body as usize].min(lineup.ground()));
        groups.for_each_lane(Batch::occupied, |pair, at| {
            let Pair { a, b, .. } = pairs.pairs[pair as usize];
            if [a, b].iter().any(|&body| bodies[body as usize].reports_contacts()) {
                self.heard.push(Heard::new(at, pair, [a, b].map(place)));
            }
        });
    }

    /// Before a substep of `h` (s): how fast those approach each other that have not pressed yet.
    pub(super) fn approach(&mut self, groups: &Groups, velocities: &[Row], h: f32) {
        for heard in self.heard.iter_mut().filter(|heard| heard.impulse == 0.0) {
            let (header, points) = groups.rows(&heard.at);
            let both = groups.places(&heard.at).map(|place| &velocities[place as usize]);
            let opening = |rows: &PointRows| opening(header, rows, heard.at.lane(), both);
            heard.approach_speed = points.iter().map(|rows| -opening(rows) / h).fold(0.0, f32::max);
        }
    }

    /// After it: how hard they pressed, and where.
    pub(super) fn listen(&mut self, groups: &Groups, pairs: &Pairs, crew: &Crew, h: f32) {
        for heard in &mut self.heard {
            let (_, points) = groups.rows(&heard.at);
            let Some(held) = pairs.details[heard.pair as usize].held.as_ref() else { continue };
            let [a, b] = heard.places.map(|place| pose(crew, place));
            for (rows, point) in points.iter().zip(held.points()) {
                let impulse = rows.normal_impulse.0[heard.at.lane()] / h;
                let place = ((a.0 + a.1 * point.on_a()) + (b.0 + b.1 * point.on_b())) * 0.5;
                heard.impulse += impulse;
                heard.moment += place * impulse;
            }
        }
    }

    /// Keeps what was heard in a part of the step, or all of it. What is not finite was not heard.
    pub(super) fn finish(&mut self, groups: &Groups, pairs: &Pairs) {
        let press = |heard: &Heard| {
            let (_, points) = groups.rows(&heard.at);
            let near = |rows: &PointRows| rows.separation.0[heard.at.lane()] <= NEAR;
            let pair = &pairs.pairs[heard.pair as usize];
            let normal = pairs.details[heard.pair as usize].held.as_ref()?.normal();
            let normal = if pair.a < pair.b { normal } else { -normal };
            let press = Press {
                bodies: [pair.a.min(pair.b), pair.a.max(pair.b)],
                impulse: heard.impulse,
                normal: normal * heard.impulse,
                point: heard.moment,
                approach_speed: if heard.impulse > 0.0 { heard.approach_speed } else { 0.0 },
                is_near: points.iter().any(near),
            };
            press.is_finite().then_some((heard.pair, press))
        };
        let mut presses: Vec<(u32, Press)> = self.heard.iter().filter_map(press).collect();
        presses.put_in_order_by_key(|(pair, press)| (press.bodies, *pair));
        self.presses.extend(presses.into_iter().map(|(_, press)| press));
    }

    /// What was heard in the step, ascending by bodies.
    fn presses(&self) -> Vec<Press> {
        let mut presses = self.presses.clone();
        // Stable: those of one pair of bodies stay in order.
        presses.put_in_order_by_key(|press| press.bodies);
        let mut sums: Vec<Press> = Vec::new();
        for press in presses {
            match sums.last_mut().filter(|sum| sum.bodies == press.bodies) {
                Some(sum) => sum.add(&press),
                None => sums.push(press),
            }
        }
        sums.iter_mut().for_each(Press::normalise);
        // Sums may be beyond all numbers, and so may means of what is far away.
        sums.retain(Press::is_finite);
        sums
    }
}

impl Heard {
    fn new(at: Lane, pair: u32, places: [u32; 2]) -> Self {
        Self { at, pair, places, impulse: 0.0, moment: Vec3::ZERO, approach_speed: 0.0 }
    }
}

impl Press {
    fn is_finite(&self) -> bool {
        let Self { impulse, normal, point, approach_speed, .. } = self;
        impulse.is_finite() && normal.is_finite() && point.is_finite() && approach_speed.is_finite()
    }

    /// Another pair of parts of the same bodies.
    fn add(&mut self, other: &Self) {
        self.impulse += other.impulse;
        self.normal += other.normal;
        self.point += other.point;
        self.approach_speed = self.approach_speed.max(other.approach_speed);
        self.is_near |= other.is_near;
    }

    /// Sums become means.
    fn normalise(&mut self) {
        self.normal = self.normal.unit_or(Vec3::Y);
        self.point /= self.impulse.max(f32::MIN_POSITIVE);
    }
}

/// How fast the surfaces of a point move apart along the normal, over a substep, in m.
fn opening(header: &HeaderRows, rows: &PointRows, lane: usize, [a, b]: [&Row; 2]) -> f32 {
    let part = |row: &Row, at: usize| Vec3::new(row.0[at], row.0[at + 1], row.0[at + 2]);
    let turning = column(&rows.normal_b, lane).dot(part(b, 4)) - column(&rows.normal_a, lane).dot(part(a, 4));
    column(&header.normal, lane).dot(part(b, 0) - part(a, 0)) + turning
}

/// Where a body is now: its centre and its axes.
fn pose(crew: &Crew, place: u32) -> (Vec3, Mat3) {
    let (block, lane) = (&crew.blocks[place as usize / LANES], place as usize % LANES);
    (column(&block.center, lane) + column(&block.shift, lane), columns(&block.axes, lane))
}

impl RigidSolver {
    /// How bodies that report it pressed on each other in the step, ascending by their bodies.
    pub(crate) fn presses(&self) -> Vec<Press> {
        self.listener.presses()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(bodies: [u32; 2], place: Vec3) -> Press {
        let (normal, point) = (Vec3::Y * 1e26, place * 1e26);
        Press { bodies, impulse: 1e26, normal, point, approach_speed: 0.0, is_near: true }
    }

    /// A world's own snapshot was refused for it.
    #[test]
    fn a_press_whose_sum_is_beyond_all_numbers_is_not_heard() {
        let near = [press([0, 1], Vec3::X), press([0, 1], Vec3::X * 3.0)];
        let far = [press([0, 2], Vec3::Z * -2e12), press([0, 2], Vec3::Z * -2e12)];
        assert!(far.iter().all(Press::is_finite));
        let listener =
            Listener { is_needed: true, heard: Vec::new(), presses: near.into_iter().chain(far).collect() };
        let heard = listener.presses();
        assert_eq!(heard.iter().map(|press| press.bodies).collect::<Vec<_>>(), [[0, 1]]);
        assert!((heard[0].point.x - 2.0).abs() < 1e-6, "{}", heard[0].point);
    }
}
