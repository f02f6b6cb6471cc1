use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise3, on_all};

const COUNT: usize = 24;

/// Particles here and there, which move as one body turning by `turn` (rad) in a small step, and shake.
fn cloud(turn: Vec3, shake: f32) -> Points {
    let mut points = Points::default();
    points.reset(COUNT);
    for place in 0..COUNT {
        let at = Vec3::new(5.0, -2.0, 1.0) + noise3(place) * Vec3::new(1.0, 0.5, 0.2);
        let motion = turn.cross(at) + Vec3::new(1e-3, 2e-3, 0.0) + noise3(place + COUNT) * shake;
        points.put(place, at + motion, motion);
        points.inverse_mass[place] = 1.0 + 0.1 * place as f32;
    }
    points
}

/// Σ m d and Σ m x × d.
fn momenta(points: &Points) -> [DVec3; 2] {
    let of = |place: usize| {
        let motion = points.motion(place).as_dvec3() / f64::from(points.inverse_mass[place]);
        [motion, points.begun_at(place).as_dvec3().cross(motion)]
    };
    (0..COUNT).map(of).fold([DVec3::ZERO; 2], |[p, l], [more_p, more_l]| [p + more_p, l + more_l])
}

struct Sketch<'a>(&'a Points);

impl Kernel for Sketch<'_> {
    type Output = Spin;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Spin {
        Spin::sketched::<L>(self.0, 0..COUNT)
    }
}

struct Give(Points, DVec3);

impl Kernel for Give {
    type Output = Points;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> Points {
        Spin::of(&self.0, 0..COUNT).give::<L>(&mut self.0, 0..COUNT, self.1);
        self.0
    }
}

#[test]
fn what_turns_as_one_body_is_seen_to_also_as_two() {
    let turn = Vec3::new(1e-3, 4e-3, -2e-3);
    let points = cloud(turn, 0.0);
    let whole = Spin::of(&points, 0..COUNT);
    let parts = Spin::of(&points, 0..8).with(&Spin::of(&points, 8..COUNT));
    let sketched = on_all(|| Sketch(&points));
    for spin in [whole, parts, sketched] {
        assert!(spin.turn_by(spin.momentum).distance(turn.as_dvec3()) < 1e-7);
        assert!(spin.center.distance(whole.center) < 1e-6 && spin.motion.distance(whole.motion) < 1e-9);
    }
}

#[test]
fn what_is_given_is_gained_and_nothing_else() {
    let mut points = cloud(Vec3::Y * 1e-3, 1e-3);
    let [linear, angular] = momenta(&points);
    let given = DVec3::new(2e-4, -1e-4, 3e-4);
    points = on_all(|| Give(points.clone(), given));
    let [now, turned] = momenta(&points);
    assert!((now - linear).length() < 1e-8);
    assert!((turned - angular - given).length() < 1e-5 * given.length());
}

/// A line cannot turn about itself.
#[test]
fn a_line_takes_up_little_along_itself() {
    let mut points = cloud(Vec3::ZERO, 0.0);
    for place in 0..COUNT {
        points.put(place, Vec3::X * (0.1 * place as f32) + noise3(place) * 1e-4, Vec3::ZERO);
    }
    let spin = Spin::of(&points, 0..COUNT);
    let turn = spin.turn_by(DVec3::new(1e-4, 1e-4, 0.0));
    assert!(turn.x.abs() < 300.0 * turn.y.abs(), "{turn}");
}
