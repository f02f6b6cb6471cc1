//! Restitution and rolling friction against closed forms.

use std::sync::Arc;

use tautline::{HalfSpace, RigidBody, Shape, Vec3, World};

use super::{DT, add, awake, center, weightless};

/// The heights of the first apexes of a ball dropped from `height` over its resting place.
fn apexes(restitution: f32, height: f32, count: usize) -> Vec<f32> {
    let mut world = World::new(awake()).unwrap();
    world.add(HalfSpace::floor(0.0).restitution(restitution)).unwrap();
    let ball = Arc::new(Shape::sphere(0.2).unwrap());
    let ball = add(&mut world, RigidBody::new(&ball).position(Vec3::Y * (0.2 + height)));
    let mut apexes = Vec::new();
    let mut previous: [f32; 2] = [height; 2];
    for _ in 0..6000 {
        world.step(DT).unwrap();
        let now = center(&world, ball).y - 0.2;
        let [before, middle] = previous;
        if middle > before && middle >= now {
            // The vertex of the parabola through three samples.
            let (slope, curve) = ((now - before) / 2.0, now - 2.0 * middle + before);
            apexes.push(middle - slope * slope / (2.0 * curve));
            if apexes.len() == count {
                return apexes;
            }
        }
        previous = [middle, now];
    }
    apexes
}

#[test]
fn a_perfect_ball_comes_back_to_its_height_ten_times() {
    for height in [0.3, 1.0, 2.7] {
        let apexes = apexes(1.0, height, 10);
        assert_eq!(apexes.len(), 10);
        assert!(apexes[0] / height >= 0.999, "{apexes:?}");
        assert!(apexes[9] / height >= 0.99, "{apexes:?}");
        assert!(apexes.iter().all(|apex| apex / height <= 1.0 + 1e-4), "{apexes:?}");
    }
}

#[test]
fn a_ball_comes_back_to_the_square_of_its_restitution() {
    for restitution in [0.5, 0.8] {
        let apex = apexes(restitution, 1.0, 1)[0];
        assert!((apex / (restitution * restitution) - 1.0).abs() < 5e-3, "{restitution}: {apex}");
    }
}

#[test]
fn two_balls_exchange_their_momentum() {
    for ratio in [1.0, 3.0, 100.0] {
        let mut world = World::new(weightless()).unwrap();
        let ball = Arc::new(Shape::sphere(0.2).unwrap());
        let body =
            |x: f32, mass: f32| RigidBody::new(&ball).position(Vec3::X * x).mass(mass).restitution(1.0);
        let first = add(&mut world, body(-1.0, ratio).velocity(Vec3::X * 2.0));
        let second = add(&mut world, body(0.0, 1.0));
        super::run(&mut world, 1.0);
        let speed = |body| world.body(body).unwrap().velocity().x;
        let expected = [2.0 * (ratio - 1.0) / (ratio + 1.0), 4.0 * ratio / (ratio + 1.0)];
        for (body, expected) in [first, second].into_iter().zip(expected) {
            assert!((speed(body) - expected).abs() < 2e-5, "{ratio}: {} for {expected}", speed(body));
        }
    }
}

#[test]
fn a_row_of_balls_passes_a_blow_on_to_the_last() {
    let mut world = World::new(weightless()).unwrap();
    let ball = Arc::new(Shape::sphere(0.1).unwrap());
    let balls: Vec<_> = (0..5)
        .map(|i| {
            let body = RigidBody::new(&ball).position(Vec3::X * (i as f32 * 0.201)).restitution(1.0);
            add(&mut world, if i == 0 { body.position(Vec3::X * -0.3).velocity(Vec3::X * 1.5) } else { body })
        })
        .collect();
    let energy = world.kinetic_energy();
    for _ in 0..60 {
        world.step(DT).unwrap();
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-5));
    }
    let speeds: Vec<f32> = balls.iter().map(|&ball| world.body(ball).unwrap().velocity().x).collect();
    assert!((speeds[4] / 1.5 - 1.0).abs() < 0.01, "{speeds:?}");
    assert!(speeds[..4].iter().all(|speed| speed.abs() < 0.015), "{speeds:?}");
}

/// Rolling with N = m g: m a = −F, I a/r = F r − μ N.
#[test]
fn rolling_friction_slows_a_ball_as_its_moment_says() {
    let mut world = World::new(awake()).unwrap();
    super::floor(&mut world);
    let (radius, length) = (0.25, 0.005);
    world.set_settings(awake()).unwrap();
    let ball = Arc::new(Shape::sphere(radius).unwrap());
    let surface = tautline::Surface {
        rolling_friction: length,
        friction_rule: tautline::Combine::Maximum,
        ..Default::default()
    };
    let body = RigidBody::new(&ball).position(Vec3::Y * radius).velocity(Vec3::X * 2.0);
    let ball = add(&mut world, body.angular_velocity(Vec3::Z * (-2.0 / radius)).surface(surface));
    super::run(&mut world, 3.0);
    let deceleration = 9.81 * length / radius / 1.4;
    let expected = 2.0 - deceleration * 3.0;
    let speed = world.body(ball).unwrap().velocity().x;
    assert!((speed / expected - 1.0).abs() < 0.01, "{speed} for {expected}");
}
