use super::*;
use crate::shape::{Part, Shape};
use crate::simd::Kernel;
use crate::solver::soft::tests::{noise3, on_all};
use crate::solver::soft::tile::tiles_of_run;

const THICKNESS: f32 = 0.05;
const PLACES: usize = 16;

/// Particles about a unit ball, up to 10 cm from it.
fn around() -> Points {
    let mut points = Points::default();
    points.reset(PLACES);
    for place in (0..PLACES).filter(|place| place % 8 != 7) {
        let at = noise3(place).normalize() * (1.0 + 0.1 * (place % 5) as f32 / 4.0);
        points.put(place, at, Vec3::ZERO);
        points.inverse_mass[place] = 2.0 + (place % 3) as f32;
        points.presence[place] = 1.0;
    }
    points
}

/// Finds what touches, and solves it in so many small steps, in which the solid moves on.
struct Steps<'a> {
    solid: Solid<'a>,
    points: Points,
    friction: f32,
    count: usize,
}

type Outcome = (Vec<Vec3>, (Vec3, Vec3));

impl Kernel for Steps<'_> {
    type Output = Outcome;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Outcome {
        let Self { mut solid, mut points, friction, count } = self;
        let tiles = tiles_of_run(0..PLACES);
        let boxes: Vec<Bounds> = tiles.iter().map(|tile| tile.bounds::<L>(&points)).collect();
        let skin = Skin { piece: 0, thickness: THICKNESS, margin: 0.1, friction };
        let stance = solid.stance(count as f32);
        let mut touches = Vec::new();
        find::<L>((&tiles, &boxes), &points, (0, &solid, &stance), skin, &mut touches);
        let push = Push { recovery: f32::INFINITY, left: 0.0 };
        for _ in 0..count {
            for touch in &mut touches {
                touch.solve::<L>(&mut points.slices(), &mut solid, push);
            }
            solid.advance();
        }
        let motions = (0..PLACES).map(|place| points.at(place)).collect();
        (motions, solid.astray())
    }
}

fn ball() -> Shape {
    Shape::sphere(1.0).unwrap()
}

fn steps(part: &Part, masses: [f32; 2], motion: [Vec3; 2], friction: f32, count: usize) -> Outcome {
    let solid = || Solid::ball(part, masses, motion);
    on_all(|| Steps { solid: solid(), points: around(), friction, count })
}

/// A ball that turns and moves on: in small steps in which it hardly turns, it pushes what is in its way to its
/// thickness and drags nothing along.
#[test]
fn what_a_moving_ball_meets_is_pushed_out_of_its_way() {
    let (shape, before) = (ball(), around());
    let motion = [Vec3::new(0.002, 0.001, 0.0), Vec3::new(0.0, 0.001, 0.0005)];
    let count = 6;
    let (after, _) = steps(&shape.parts()[0], [0.0; 2], motion, 0.0, count);
    let mut pushed = 0;
    // It ends at the origin.
    let start = -motion[0] * count as f32;
    for place in (0..PLACES).filter(|&place| before.presence[place] == 1.0) {
        let normal = (before.at(place) - start).normalize();
        // Along the normal it was found with.
        let gap = |at: Vec3, center: Vec3| (at - center).dot(normal) - 1.0 - THICKNESS;
        // As deep as it gets on the way.
        let depth_at = |step: usize| -gap(before.at(place), start + motion[0] * step as f32);
        let depth = (1..=count).map(depth_at).fold(f32::NEG_INFINITY, f32::max);
        let expected = before.at(place) + normal * depth.max(0.0);
        assert!(after[place].distance(expected) < 2e-5, "{place}: {} instead of {expected}", after[place]);
        pushed += usize::from(depth > 0.0);
    }
    assert!((4..13).contains(&pushed), "{pushed} are pushed");
    assert_eq!(after[7], before.at(7), "where no particle is");
}

/// With friction without bounds, what touches is carried with the surface: by v + ω × r, r to the place that is touched.
#[test]
fn what_sticks_to_a_moving_ball_is_carried_along() {
    let (shape, mut before) = (ball(), around());
    for place in (0..PLACES).filter(|place| place % 8 != 7) {
        let at = before.at(place).normalize() * (1.0 + THICKNESS - 1e-3);
        before.put(place, at, Vec3::ZERO);
    }
    let motion = [Vec3::ZERO, Vec3::new(0.0, 0.0, 1e-3)];
    let solid = || Solid::ball(&shape.parts()[0], [0.0; 2], motion);
    let (after, _) = on_all(|| Steps { solid: solid(), points: before.clone(), friction: 1e6, count: 1 });
    for place in (0..PLACES).filter(|&place| before.presence[place] == 1.0) {
        let normal = before.at(place).normalize();
        let carried = motion[1].cross(normal);
        let expected = before.at(place) + normal * 1e-3 + carried;
        assert!(after[place].distance(expected) < 2e-6, "{place}: {} instead of {expected}", after[place]);
    }
}

/// All that particles gain a free ball loses: momentum, and without friction angular momentum, too.
#[test]
fn momentum_is_shared_with_a_free_ball() {
    let (shape, before) = (ball(), around());
    for (friction, motion) in [(0.0, [Vec3::ZERO; 2]), (0.8, [Vec3::X * 1e-3, Vec3::Y * 2e-3])] {
        let (after, (shift, turn)) = steps(&shape.parts()[0], [0.25, 0.6], motion, friction, 1);
        let free = (0..PLACES).filter(|&place| before.presence[place] == 1.0);
        let (mut linear, mut angular, mut all) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for place in free {
            let moved = (after[place] - before.at(place)) / before.inverse_mass[place];
            linear += moved;
            angular += before.at(place).cross(moved);
            all += moved.length();
        }
        assert!(all > 0.02 && shift.length() > 1e-3, "{all} kg m, {shift} m: they hardly touch");
        // What the ball gains moves it at once and again when the small step ends.
        let (given, turned) = (shift / 2.0 / 0.25, turn / 2.0 / 0.6);
        assert!((linear + given).length() < 1e-6, "{linear} and {given}");
        assert!(friction > 0.0 || (angular + turned).length() < 1e-6, "{angular} and {turned}");
    }
}

/// Friction takes back of a particle's slip as much as μ times the depth.
#[test]
fn friction_follows_coulombs_law() {
    for (slip, friction, left) in [(0.01, 0.5, 0.005), (0.01, 2.0, 0.0), (0.004, 0.3, 0.001)] {
        let mut points = Points::default();
        points.reset(PLACES);
        let at = Vec3::Y * (1.0 + THICKNESS - 0.01);
        points.put(3, at, Vec3::ZERO);
        points.set_motion(3, Vec3::new(slip, -0.01, 0.0));
        (points.inverse_mass[3], points.presence[3]) = (1.0, 1.0);
        let shape = ball();
        let solid = || Solid::ball(&shape.parts()[0], [0.0; 2], [Vec3::ZERO; 2]);
        let (after, ..) = on_all(|| Steps { solid: solid(), points: points.clone(), friction, count: 1 });
        let expected = Vec3::new(left - slip, 1.0 + THICKNESS, 0.0);
        assert!(after[3].distance(expected) < 1e-6, "{} instead of {expected}", after[3]);
    }
}
