use super::*;

impl<'a> Solid<'a> {
    /// A ball in the middle, of so much mass and the same inertia in all directions, which moves by so much in a small
    /// step.
    pub(in crate::solver::soft) fn ball(
        part: &'a Part,
        [inverse_mass, inverse_inertia]: [f32; 2],
        [linear, angular]: [Vec3; 2],
    ) -> Self {
        Self {
            body: 0,
            skin: Skin::with_friction(0.5),
            matter: Matter::Parts(vec![(part, Form::of(&part.convex))]),
            center: Vec3::ZERO,
            axes: Mat3::IDENTITY,
            linear,
            angular,
            inverse_mass,
            inverse_inertia: Mat3::from_diagonal(Vec3::splat(inverse_inertia)),
            change: Change::default(),
        }
    }
}

fn unit_ball() -> crate::shape::Shape {
    crate::shape::Shape::sphere(1.0).unwrap()
}

/// A substep of eight small steps with two pushes, by hand.
#[test]
fn what_is_pushed_is_moved_from_then_on() {
    let shape = unit_ball();
    let (linear, angular) = (Vec3::new(0.01, 0.0, 0.0), Vec3::new(0.0, 0.02, 0.0));
    let mut solid = Solid::ball(&shape.parts()[0], [0.5, 2.0], [linear, angular]);
    assert!(solid.outcome(8.0).is_none());
    let (impulse, arm) = (Vec3::new(0.0, 0.004, 0.0), Vec3::new(0.0, 0.0, 1.0));
    let gained = (impulse * 0.5, arm.cross(impulse) * 2.0);
    for step in 0..8 {
        solid.advance();
        let left = 7 - step;
        let stance = solid.stance(left as f32);
        // Pushed in steps 2 and 5: each moves it at once, and again in every later step.
        let pushes = [2, 5].into_iter().filter(|&k| k < step).map(|k| 1 + step - k).sum::<i32>() as f32;
        let expected = -linear * left as f32 + gained.0 * pushes;
        assert!(stance.center.distance(expected) < 1e-7, "step {step}: {}", stance.center);
        let count = [2, 5].into_iter().filter(|&k| k < step).count() as f32;
        assert!(stance.linear.distance(linear + gained.0 * count) < 1e-7);
        assert!(stance.angular.distance(angular + gained.1 * count) < 1e-7);
        let turn = -angular * left as f32 + gained.1 * pushes;
        // By Cayley's formula.
        let angle = 2.0 * (turn.length() / 2.0).atan();
        let expected = Mat3::from_quat(glam::Quat::from_axis_angle(turn.normalize_or(Vec3::Y), angle));
        assert!((0..3).all(|k| stance.axes.col(k).distance(expected.col(k)) < 2e-6), "step {step}");
        if step == 2 || step == 5 {
            solid.push(impulse, arm);
        }
        // Where it was is not changed by what is done to it since.
        assert!(solid.begun_at(left as f32).distance(stance.center - stance.linear) < 1e-7);
    }
    let outcome = solid.outcome(8.0).unwrap();
    assert!(
        outcome.linear.distance(gained.0 * 16.0) < 1e-7 && outcome.angular.distance(gained.1 * 16.0) < 1e-7
    );
    assert!(outcome.shift.distance(gained.0 * 9.0) < 1e-7 && outcome.turn.distance(gained.1 * 9.0) < 1e-6);
}

#[test]
fn what_nothing_moves_is_not_moved() {
    let shape = unit_ball();
    let mut solid = Solid::ball(&shape.parts()[0], [0.0, 0.0], [Vec3::ZERO; 2]);
    solid.push(Vec3::ONE, Vec3::X);
    solid.advance();
    assert!(solid.outcome(8.0).is_none());
    assert_eq!(solid.astray(), (Vec3::ZERO, Vec3::ZERO));
}

#[test]
fn the_box_around_a_turned_part_holds_it() {
    let shape = crate::shape::Shape::cuboid(Vec3::new(0.5, 0.2, 0.1)).unwrap();
    let part = &shape.parts()[0];
    let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let stance = Stance {
        center: Vec3::new(1.0, 2.0, 3.0),
        axes: Mat3::from_quat(turn),
        linear: Vec3::ZERO,
        angular: Vec3::ZERO,
    };
    let corners = part.convex.vertices.iter().map(|&corner| stance.center + turn * corner);
    let around = corners.fold(Bounds::EMPTY, |all, at| all.with(Bounds { low: at, high: at }));
    let found = part_bounds(part, &stance);
    assert!(found.low.distance(around.low) < 1e-6 && found.high.distance(around.high) < 1e-6);
    assert!(stance.to_local(stance.center + turn * Vec3::X).distance(Vec3::X) < 1e-6);
}
