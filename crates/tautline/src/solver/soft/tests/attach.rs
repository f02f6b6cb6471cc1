//! Attachments alone: what they demand in f64, and what they leave of momentum.

use glam::{DVec3, Vec3};

use super::super::tests::noise3;
use super::*;
use crate::shape::Shape;

const MASSES: [f32; 3] = [4.0, 7.0, 5.0];
const WEIGHTS: [f32; 3] = [0.5, 0.3, 0.2];

/// Three particles that move.
fn three() -> Points {
    let mut points = Points::default();
    points.reset(8);
    for (place, mass) in MASSES.into_iter().enumerate() {
        points.put(place, Vec3::X * 1.2 + noise3(place) * 0.3, Vec3::ZERO);
        points.set_motion(place, noise3(place + 9) * 1e-4);
        points.inverse_mass[place] = mass;
    }
    points
}

fn tie(ends: [Hold; 2], compliance: f32) -> Tie {
    Tie { attachment: 0, ends, compliance, company: 1.0, multiplier: Vec3::ZERO, total: Vec3::ZERO }
}

const TRIANGLE: Hold = Hold::Places { places: [0, 1, 2], weights: WEIGHTS };
const MOMENT: Moment = Moment { left: 0.0, small: 1e-3, recovery: f32::INFINITY };

fn apart([a, b]: [Hold; 2], points: &Points, solids: &[Solid<'_>]) -> Vec3 {
    b.at(points, solids, 0.0).0 - a.at(points, solids, 0.0).0
}

/// Of three particles and a ball at the origin, in kg m and kg m² in a small step.
fn momenta(points: &Points, solid: &Solid<'_>, [inverse_mass, inverse_inertia]: [f32; 2]) -> [DVec3; 2] {
    let stance = solid.stance(0.0);
    let linear = stance.linear.as_dvec3() / f64::from(inverse_mass);
    let angular =
        stance.center.as_dvec3().cross(linear) + stance.angular.as_dvec3() / f64::from(inverse_inertia);
    (0..3).fold([linear, angular], |[linear, angular], place| {
        let of_one = points.motion(place).as_dvec3() / f64::from(points.inverse_mass[place]);
        [linear + of_one, angular + points.at(place).as_dvec3().cross(of_one)]
    })
}

#[test]
fn a_stiff_one_brings_a_triangle_to_a_point_of_a_ball() {
    let shape = Shape::sphere(1.0).unwrap();
    let inverses = [0.5, 0.8];
    let mut solids = [Solid::ball(&shape.parts()[0], inverses, [Vec3::ZERO; 2])];
    let mut points = three();
    let before = momenta(&points, &solids[0], inverses);
    let near = TRIANGLE.at(&points, &solids, 0.0).0 + Vec3::new(2e-3, -1e-3, 1e-3);
    let mut tie = tie([TRIANGLE, Hold::Solid { body: 0, point: near, number: 0 }], 0.0);
    let gap = apart(tie.ends, &points, &solids);
    tie.pull(&mut points, &mut solids, MOMENT);
    // To first order of the gap.
    let left = apart(tie.ends, &points, &solids);
    assert!(gap.length() > 2e-3 && left.length() < 5e-3 * gap.length(), "{gap} has become {left}");
    let [linear, angular] = momenta(&points, &solids[0], inverses);
    assert!((linear - before[0]).length() < 1e-6, "{linear} of {}", before[0]);
    // As far as what moved in the small step counts from where it was.
    assert!((angular - before[1]).length() < 1e-3 * f64::from(gap.length()), "{angular} of {}", before[1]);
}

#[test]
fn a_compliant_one_holds_with_the_force_of_its_length() {
    let mut points = three();
    let compliance = 1e-6;
    let target = Vec3::new(0.4, -0.3, 0.2);
    let mut tie = tie([TRIANGLE, Hold::Still(target)], compliance);
    for _ in 0..3 {
        tie.pull(&mut points, &mut [], MOMENT);
    }
    // In kg m in a small step: F h².
    let force = tie.total.as_dvec3() / f64::from(MOMENT.small * MOMENT.small);
    let gap = apart(tie.ends, &points, &[]).as_dvec3();
    assert!((force * f64::from(compliance) - gap).length() < 1e-3 * gap.length(), "{force} at {gap}");
    assert!(gap.length() > 1e-3);
}

#[test]
fn what_is_apart_is_drawn_together_no_faster_than_allowed() {
    let mut points = three();
    points.remainder.iter_mut().for_each(|numbers| numbers.fill(0.0));
    let mut tie = tie([TRIANGLE, Hold::Still(Vec3::ZERO)], 0.0);
    let moment = Moment { recovery: 1e-3, ..MOMENT };
    let gap = apart(tie.ends, &points, &[]);
    tie.pull(&mut points, &mut [], moment);
    assert!((apart(tie.ends, &points, &[]).length() - (gap.length() - 1e-3)).abs() < 1e-6);
}

#[test]
fn what_a_particle_carries_is_moved_with_it() {
    let shape = Shape::sphere(1.0).unwrap();
    let mut solids = [Solid::ball(&shape.parts()[0], [0.01, 0.02], [Vec3::ZERO; 2])];
    let mut points = three();
    let hook = Hold::Places { places: [0; 3], weights: [1.0, 0.0, 0.0] };
    let mut ties = Ties::default();
    ties.ties.push(tie([Hold::Solid { body: 0, point: Vec3::X, number: 0 }, hook], 0.0));
    let own = (points.inverse_mass[0], points.motion(0));
    ties.load(&mut points, &solids, 0.0);
    let heavy = points.inverse_mass[0];
    assert!(heavy < 0.1, "it weighs {} kg", 1.0 / heavy);
    let impulse = Vec3::new(1e-3, 2e-3, -1e-3);
    points.shift(0, impulse * heavy);
    ties.unload(&mut points, &mut solids, 0.0);
    assert_eq!(points.inverse_mass[0], own.0);
    let taken = (points.motion(0) - own.1) / own.0 + solids[0].stance(0.0).linear / 0.01;
    assert!(taken.distance(impulse) < 1e-7, "{taken} of {impulse}");
    assert!(ties.totals().all(|(_, total)| total.length() > 0.9 * impulse.length()));
}
