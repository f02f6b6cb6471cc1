//! Joints of a document to joints of the engine.

use tautline::{
    BallJoint, BodyHandle, DistanceJoint, FixedJoint, HingeJoint, JointDescription, SliderJoint, Vec3,
};

use crate::document::{Joint, JointKind, Motor};

/// Tells a builder what all of them know.
macro_rules! common {
    ($builder:expr, $joint:expr, $anchors:expr) => {{
        let [on_body, on_base] = $anchors;
        let mut builder = $builder.anchors(on_body, on_base).compliance($joint.compliance);
        if let Some(force) = $joint.break_force {
            builder = builder.break_force(force);
        }
        if $joint.collide_connected {
            builder = builder.collide_connected();
        }
        builder
    }};
}

/// The same for one that holds rotations.
macro_rules! angular {
    ($builder:expr, $joint:expr, $anchors:expr) => {{
        let mut builder = common!($builder, $joint, $anchors);
        builder = builder.angular_compliance($joint.angular_compliance.unwrap_or(0.0));
        if let Some(torque) = $joint.break_torque {
            builder = builder.break_torque(torque);
        }
        builder
    }};
}

/// A joint between two bodies, on the world without the second; `center` is where the first has its centre of mass.
pub(super) fn joint(
    joint: &Joint,
    body: BodyHandle,
    base: Option<BodyHandle>,
    center: Vec3,
) -> JointDescription {
    let on_body = joint.anchor.map_or(center, Vec3::from);
    let anchors = [on_body, joint.base_anchor.map_or(on_body, Vec3::from)];
    match joint.kind {
        JointKind::Ball { axis, cone_degrees, twist_degrees } => {
            let mut ball = angular!(BallJoint::new(body, base).axis(axis.into()), joint, anchors);
            if let Some(cone) = cone_degrees {
                ball = ball.cone(cone.to_radians());
            }
            if let Some([low, high]) = twist_degrees {
                ball = ball.twist(low.to_radians(), high.to_radians());
            }
            ball.into()
        }
        JointKind::Hinge { axis, limits_degrees, motor } => {
            let mut hinge = angular!(HingeJoint::new(body, base).axis(axis.into()), joint, anchors);
            if let Some([low, high]) = limits_degrees {
                hinge = hinge.limits(low.to_radians(), high.to_radians());
            }
            if let Some(Motor { speed, strength }) = motor {
                hinge = hinge.motor(speed, strength);
            }
            hinge.into()
        }
        JointKind::Fixed {} => angular!(FixedJoint::new(body, base), joint, anchors).into(),
        JointKind::Slider { axis, limits, motor } => {
            let mut slider = angular!(SliderJoint::new(body, base).axis(axis.into()), joint, anchors);
            if let Some([low, high]) = limits {
                slider = slider.limits(low, high);
            }
            if let Some(Motor { speed, strength }) = motor {
                slider = slider.motor(speed, strength);
            }
            slider.into()
        }
        JointKind::Distance { length, range, spring } => {
            let mut distance = common!(DistanceJoint::new(body, base), joint, anchors);
            if let Some(length) = length {
                distance = distance.length(length);
            }
            if let Some([low, high]) = range {
                distance = distance.range(low, high);
            }
            if let Some(spring) = spring {
                distance = distance.spring(spring.frequency, spring.damping_ratio);
            }
            distance.into()
        }
    }
}
