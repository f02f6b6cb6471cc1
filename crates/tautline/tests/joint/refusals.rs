//! Bad input is refused by the name of the field, and nothing has changed.

use tautline::{
    BallJoint, BodyHandle, Cloth, DistanceJoint, Error, FixedJoint, HalfSpace, HingeJoint, JointDescription,
    Motor, RigidBody, SliderJoint, Vec3, World,
};

use crate::{cuboid, run, sleepless};

fn world() -> (World, BodyHandle, BodyHandle) {
    let mut world = World::new(sleepless()).unwrap();
    let shape = cuboid(0.1, 0.1, 0.1);
    let a = world.add(RigidBody::new(&shape)).unwrap();
    let b = world.add(RigidBody::new(&shape).position(Vec3::X)).unwrap();
    (world, a, b)
}

fn field(error: &Error) -> &str {
    match error {
        Error::OutOfRange { field, .. } | Error::Invalid { field, .. } => field,
        _ => "",
    }
}

#[test]
fn wrong_numbers_are_refused_by_name() {
    let (mut world, a, b) = world();
    let nan = f32::NAN;
    let cases: Vec<(JointDescription, &str)> = vec![
        (BallJoint::new(a, b).anchor(Vec3::new(0.0, nan, 0.0)).into(), "anchor.y"),
        (BallJoint::new(a, b).local_anchors(Vec3::X, Vec3::splat(f32::INFINITY)).into(), "local_anchor.x"),
        (BallJoint::new(a, b).compliance(-1.0).into(), "compliance"),
        (BallJoint::new(a, b).compliance(nan).into(), "compliance"),
        (FixedJoint::new(a, b).angular_compliance(-1e-9).into(), "angular_compliance"),
        (FixedJoint::new(a, b).break_force(0.0).into(), "break_force"),
        (FixedJoint::new(a, b).break_torque(nan).into(), "break_torque"),
        (BallJoint::new(a, b).cone(4.0).into(), "cone"),
        (BallJoint::new(a, b).twist(0.5, -0.5).into(), "twist.high"),
        (HingeJoint::new(a, b).axis(Vec3::ZERO).into(), "axis"),
        (HingeJoint::new(a, b).axis(Vec3::splat(nan)).into(), "axis.x"),
        (HingeJoint::new(a, b).limits(1.0, -1.0).into(), "limits.high"),
        (HingeJoint::new(a, b).limits(nan, 1.0).into(), "limits.low"),
        (HingeJoint::new(a, b).motor(nan, 1.0).into(), "motor.speed"),
        (SliderJoint::new(a, b).motor(1.0, -1.0).into(), "motor.strength"),
        (SliderJoint::new(a, b).motor(f32::INFINITY, 1.0).into(), "motor.speed"),
        (SliderJoint::new(a, b).limits(-f32::INFINITY, 0.0).into(), "limits.low"),
        (SliderJoint::new(a, b).axis(Vec3::new(1.0, f32::INFINITY, 0.0)).into(), "axis.y"),
        (SliderJoint::new(a, b).anchors(Vec3::X * 2e9, Vec3::ZERO).into(), "anchor.x"),
        (BallJoint::new(a, b).cone(nan).into(), "cone"),
        (BallJoint::new(a, b).twist(-4.0, 0.0).into(), "twist.low"),
        (DistanceJoint::new(a, b).spring(nan, 1.0).into(), "spring.frequency"),
        (DistanceJoint::new(a, b).length(-1.0).into(), "length"),
        (DistanceJoint::new(a, b).range(2.0, 1.0).into(), "range.high"),
        (DistanceJoint::new(a, b).range(-1.0, 1.0).into(), "range.low"),
        (DistanceJoint::new(a, b).spring(0.0, 1.0).into(), "spring.frequency"),
        (DistanceJoint::new(a, b).spring(1.0, -1.0).into(), "spring.damping_ratio"),
    ];
    let before = world.snapshot();
    for (joint, name) in cases {
        let error = world.add_joint(joint.clone()).unwrap_err();
        assert_eq!(field(&error), name, "{joint:?}: {error}");
    }
    assert!(world.snapshot() == before);
}

#[test]
fn joints_hold_two_rigid_bodies_of_which_one_is_dynamic() {
    let (mut world, a, b) = world();
    let shape = cuboid(0.1, 0.1, 0.1);
    let fixed = world.add(RigidBody::new(&shape).fixed().position(Vec3::Y)).unwrap();
    let driven = world.add(RigidBody::new(&shape).kinematic().position(Vec3::Y * 2.0)).unwrap();
    let floor = world.add(HalfSpace::floor(-9.0)).unwrap();
    let cloth = world.add(Cloth::grid(2, 2, 1.0, 1.0).position(Vec3::Z * 3.0)).unwrap();
    for (joint, name) in [
        (BallJoint::new(a, a), "base"),
        (BallJoint::new(fixed, None), "joint"),
        (BallJoint::new(fixed, driven), "joint"),
        (BallJoint::new(floor, a), "joint"),
        (BallJoint::new(cloth, a), "body"),
        (BallJoint::new(a, cloth), "base"),
    ] {
        assert_eq!(field(&world.add_joint(joint).unwrap_err()), name);
    }
    world.add_joint(BallJoint::new(a, floor)).unwrap();
    world.add_joint(BallJoint::new(fixed, b).anchor(Vec3::X)).unwrap();
    world.remove(b).unwrap();
    assert_eq!(world.add_joint(BallJoint::new(a, b)), Err(Error::StaleHandle));
    run(&mut world, 10);
}

#[test]
fn what_a_joint_does_not_have_cannot_be_set() {
    let (mut world, a, b) = world();
    let ball = world.add_joint(BallJoint::new(a, b)).unwrap();
    let hinge = world.add_joint(HingeJoint::new(a, b)).unwrap();
    let motor = Some(Motor { speed: 1.0, strength: 1.0 });
    assert_eq!(field(&world.set_motor(ball, motor).unwrap_err()), "motor");
    assert_eq!(field(&world.set_limits(ball, Some([0.0, 1.0])).unwrap_err()), "limits");
    assert_eq!(field(&world.set_limits(hinge, Some([1.0, 0.0])).unwrap_err()), "limits.high");
    world.remove_joint(hinge).unwrap();
    assert_eq!(world.set_motor(hinge, motor), Err(Error::StaleHandle));
    assert_eq!(world.joint(hinge).map(|view| view.kind()), Err(Error::StaleHandle));
}
