//! What holds bodies together: joints, attachments, and grabs.

use pyo3::prelude::*;
use tautline::{
    AttachmentHandle, BallJoint, BodyHandle, DistanceJoint, FixedJoint, GrabHandle, Grip, HingeJoint,
    JointDescription, JointHandle, JointKind, JointView, Motor, SliderJoint,
};

use crate::args::V3;
use crate::body::Body;
use crate::errors::{Failure, Outcome};
use crate::world::World;

type Base<'py> = Option<PyRef<'py, Body>>;

/// The handles of a joint's bodies, both of this world.
fn pair(
    world: &Bound<'_, World>,
    body: &PyRef<'_, Body>,
    base: &Base<'_>,
) -> Outcome<(BodyHandle, Option<BodyHandle>)> {
    let base = base.as_ref().map(|base| base.handle_in(world)).transpose()?;
    Ok((body.handle_in(world)?, base))
}

/// Tells a builder what all of them know.
macro_rules! common {
    ($joint:ident, $anchor:ident, $compliance:ident, $break_force:ident, $collide:ident) => {
        if let Some(anchor) = $anchor {
            $joint = $joint.anchor(anchor.0);
        }
        $joint = $joint.compliance($compliance);
        if let Some(force) = $break_force {
            $joint = $joint.break_force(force);
        }
        if $collide {
            $joint = $joint.collide_connected();
        }
    };
}

/// Tells a builder what those know that hold rotations.
macro_rules! angular {
    ($joint:ident, $compliance:ident, $break_torque:ident) => {
        $joint = $joint.angular_compliance($compliance);
        if let Some(torque) = $break_torque {
            $joint = $joint.break_torque(torque);
        }
    };
}

impl World {
    fn join(slf: &Bound<'_, Self>, joint: impl Into<JointDescription>) -> Outcome<Joint> {
        let joint = joint.into();
        let handle = slf.get().change(slf.py(), |world| world.add_joint(joint))?;
        Ok(Joint::new(slf, handle))
    }
}

#[pymethods]
#[allow(clippy::too_many_arguments)] // Keywords, in Python.
impl World {
    /// Keeps a point of a body together with one of another, or of the world.
    ///
    /// Args:
    ///     body: What is held.
    ///     base: What it is held to; the world if absent.
    ///     anchor: Where, in the world, in m; the body's centre of mass if absent.
    ///     axis: Of swing and twist, in the world.
    ///     cone: The most that the axis swings, in rad.
    ///     twist: Least and greatest turn about the axis, in rad.
    ///     compliance: In m/N.
    ///     break_force: In N.
    ///     collide_connected: Whether the two collide.
    #[pyo3(signature = (body, base=None, *, anchor=None, axis=None, cone=None, twist=None, compliance=0.0,
        break_force=None, collide_connected=false))]
    fn add_ball_joint(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        base: Base<'_>,
        anchor: Option<V3>,
        axis: Option<V3>,
        cone: Option<f32>,
        twist: Option<(f32, f32)>,
        compliance: f32,
        break_force: Option<f32>,
        collide_connected: bool,
    ) -> Outcome<Joint> {
        let (body, base) = pair(slf, &body, &base)?;
        let mut joint = BallJoint::new(body, base);
        common!(joint, anchor, compliance, break_force, collide_connected);
        if let Some(axis) = axis {
            joint = joint.axis(axis.0);
        }
        if let Some(angle) = cone {
            joint = joint.cone(angle);
        }
        if let Some((low, high)) = twist {
            joint = joint.twist(low, high);
        }
        Self::join(slf, joint)
    }

    /// Keeps two points and an axis together; limits in rad, the motor's speed (rad/s) and greatest torque (N m).
    #[pyo3(signature = (body, base=None, *, axis, anchor=None, limits=None, motor=None, compliance=0.0,
        angular_compliance=0.0, break_force=None, break_torque=None, collide_connected=false))]
    fn add_hinge_joint(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        base: Base<'_>,
        axis: V3,
        anchor: Option<V3>,
        limits: Option<(f32, f32)>,
        motor: Option<(f32, f32)>,
        compliance: f32,
        angular_compliance: f32,
        break_force: Option<f32>,
        break_torque: Option<f32>,
        collide_connected: bool,
    ) -> Outcome<Joint> {
        let (body, base) = pair(slf, &body, &base)?;
        let mut joint = HingeJoint::new(body, base).axis(axis.0);
        common!(joint, anchor, compliance, break_force, collide_connected);
        angular!(joint, angular_compliance, break_torque);
        if let Some((low, high)) = limits {
            joint = joint.limits(low, high);
        }
        if let Some((speed, max_torque)) = motor {
            joint = joint.motor(speed, max_torque);
        }
        Self::join(slf, joint)
    }

    /// Lets nothing move.
    #[pyo3(signature = (body, base=None, *, anchor=None, compliance=0.0, angular_compliance=0.0, break_force=None,
        break_torque=None, collide_connected=false))]
    fn add_fixed_joint(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        base: Base<'_>,
        anchor: Option<V3>,
        compliance: f32,
        angular_compliance: f32,
        break_force: Option<f32>,
        break_torque: Option<f32>,
        collide_connected: bool,
    ) -> Outcome<Joint> {
        let (body, base) = pair(slf, &body, &base)?;
        let mut joint = FixedJoint::new(body, base);
        common!(joint, anchor, compliance, break_force, collide_connected);
        angular!(joint, angular_compliance, break_torque);
        Self::join(slf, joint)
    }

    /// Leaves a shift along an axis free; limits in m, the motor's speed (m/s) and greatest force (N).
    #[pyo3(signature = (body, base=None, *, axis, anchor=None, limits=None, motor=None, compliance=0.0,
        angular_compliance=0.0, break_force=None, break_torque=None, collide_connected=false))]
    fn add_slider_joint(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        base: Base<'_>,
        axis: V3,
        anchor: Option<V3>,
        limits: Option<(f32, f32)>,
        motor: Option<(f32, f32)>,
        compliance: f32,
        angular_compliance: f32,
        break_force: Option<f32>,
        break_torque: Option<f32>,
        collide_connected: bool,
    ) -> Outcome<Joint> {
        let (body, base) = pair(slf, &body, &base)?;
        let mut joint = SliderJoint::new(body, base).axis(axis.0);
        common!(joint, anchor, compliance, break_force, collide_connected);
        angular!(joint, angular_compliance, break_torque);
        if let Some((low, high)) = limits {
            joint = joint.limits(low, high);
        }
        if let Some((speed, max_force)) = motor {
            joint = joint.motor(speed, max_force);
        }
        Self::join(slf, joint)
    }

    /// Keeps two points (in the world, m) at a length, or in a range of lengths (m), or near one by a spring of a frequency
    /// (Hz) and a damping ratio.
    #[pyo3(signature = (body, base=None, *, anchors=None, length=None, range=None, spring=None, compliance=0.0,
        break_force=None, collide_connected=false))]
    fn add_distance_joint(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        base: Base<'_>,
        anchors: Option<(V3, V3)>,
        length: Option<f32>,
        range: Option<(f32, f32)>,
        spring: Option<(f32, f32)>,
        compliance: f32,
        break_force: Option<f32>,
        collide_connected: bool,
    ) -> Outcome<Joint> {
        let (body, base) = pair(slf, &body, &base)?;
        let mut joint = DistanceJoint::new(body, base);
        let anchor: Option<V3> = None;
        common!(joint, anchor, compliance, break_force, collide_connected);
        if let Some((on_body, on_base)) = anchors {
            joint = joint.anchors(on_body.0, on_base.0);
        }
        if let Some(length) = length {
            joint = joint.length(length);
        }
        if let Some((low, high)) = range {
            joint = joint.range(low, high);
        }
        if let Some((frequency, damping_ratio)) = spring {
            joint = joint.spring(frequency, damping_ratio);
        }
        Self::join(slf, joint)
    }

    #[getter]
    fn joints(slf: &Bound<'_, Self>) -> Vec<Joint> {
        let handles: Vec<_> = slf.get().look(slf.py(), |scene| scene.world.joints().collect());
        handles.into_iter().map(|handle| Joint::new(slf, handle)).collect()
    }

    /// Keeps two points together, of which one at least is on cloth or rope.
    #[pyo3(signature = (a, b, *, compliance=0.0, break_force=None))]
    fn attach(
        slf: &Bound<'_, Self>,
        a: PyRef<'_, Anchor>,
        b: PyRef<'_, Anchor>,
        compliance: f32,
        break_force: Option<f32>,
    ) -> Outcome<Attachment> {
        let ends = [a.anchor_in(slf)?, b.anchor_in(slf)?];
        let mut strength = tautline::Attachment::default().compliance(compliance);
        if let Some(force) = break_force {
            strength = strength.break_force(force);
        }
        let handle = slf.get().change(slf.py(), |world| world.attach(ends[0], ends[1], strength))?;
        Ok(Attachment { world: slf.clone().unbind(), handle })
    }

    /// Picks a body up at a point (m), to lead it about by a soft stick.
    #[pyo3(signature = (body, point, *, frequency=8.0, max_acceleration=500.0))]
    fn grab(
        slf: &Bound<'_, Self>,
        body: PyRef<'_, Body>,
        point: V3,
        frequency: f32,
        max_acceleration: f32,
    ) -> Outcome<Grab> {
        let body = body.handle_in(slf)?;
        let grip = Grip { frequency, max_acceleration };
        let handle = slf.get().change(slf.py(), |world| world.grab(body, point.0, grip))?;
        Ok(Grab { world: slf.clone().unbind(), handle })
    }
}

/// A joint of a world.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Joint {
    world: Py<World>,
    handle: JointHandle,
}

impl Joint {
    pub(crate) fn new(world: &Bound<'_, World>, handle: JointHandle) -> Self {
        Self { world: world.clone().unbind(), handle }
    }

    fn view<T>(&self, py: Python<'_>, of: impl FnOnce(JointView<'_>) -> T) -> Outcome<T> {
        let seen = self.world.get().look(py, |scene| scene.world.joint(self.handle).map(of));
        Ok(seen?)
    }
}

#[pymethods]
impl Joint {
    /// "ball", "hinge", "fixed", "slider" or "distance".
    #[getter]
    fn kind(&self, py: Python<'_>) -> Outcome<&'static str> {
        self.view(py, |joint| match joint.kind() {
            JointKind::Ball => "ball",
            JointKind::Hinge => "hinge",
            JointKind::Fixed => "fixed",
            JointKind::Slider => "slider",
            JointKind::Distance => "distance",
        })
    }

    /// Of a hinge, in rad.
    #[getter]
    fn angle(&self, py: Python<'_>) -> Outcome<Option<f32>> {
        self.view(py, |joint| joint.angle())
    }

    /// Of a slider, in m.
    #[getter]
    fn translation(&self, py: Python<'_>) -> Outcome<Option<f32>> {
        self.view(py, |joint| joint.translation())
    }

    /// On the body, mean of the last step, in N.
    #[getter]
    fn force(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        self.view(py, |joint| joint.force().to_array())
    }

    /// On the body, mean of the last step, in N m.
    #[getter]
    fn torque(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        self.view(py, |joint| joint.torque().to_array())
    }

    #[getter]
    fn is_broken(&self, py: Python<'_>) -> Outcome<bool> {
        self.view(py, |joint| joint.is_broken())
    }

    /// Speed (rad/s or m/s) and greatest torque (N m) or force (N); None: no motor.
    #[pyo3(signature = (motor))]
    fn set_motor(&self, py: Python<'_>, motor: Option<(f32, f32)>) -> Outcome<()> {
        let motor = motor.map(|(speed, strength)| Motor { speed, strength });
        self.world.get().change(py, |world| world.set_motor(self.handle, motor))
    }

    /// Least and greatest angle (rad) or shift (m); None: no limits.
    #[pyo3(signature = (limits))]
    fn set_limits(&self, py: Python<'_>, limits: Option<(f32, f32)>) -> Outcome<()> {
        let limits = limits.map(|(low, high)| [low, high]);
        self.world.get().change(py, |world| world.set_limits(self.handle, limits))
    }

    fn remove(&self, py: Python<'_>) -> Outcome<()> {
        self.world.get().change(py, |world| world.remove_joint(self.handle))
    }
}

/// A point of a body, or of the world, where an attachment holds it.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Anchor {
    anchor: tautline::Anchor,
    world: Option<Py<World>>,
}

impl Anchor {
    fn on(body: &Body, py: Python<'_>, anchor: tautline::Anchor) -> Self {
        Self { anchor, world: Some(body.world.clone_ref(py)) }
    }

    fn anchor_in(&self, world: &Bound<'_, World>) -> Outcome<tautline::Anchor> {
        match &self.world {
            Some(own) if !own.is(world) => Err(Failure::invalid("anchor", "its body is of another world")),
            _ => Ok(self.anchor),
        }
    }
}

#[pymethods]
impl Anchor {
    #[staticmethod]
    fn particle(py: Python<'_>, body: PyRef<'_, Body>, particle: u32) -> Self {
        Self::on(&body, py, tautline::Anchor::particle(body.handle, particle))
    }

    /// A point of a triangle of a cloth, by its barycentric weights.
    #[staticmethod]
    fn triangle(py: Python<'_>, body: PyRef<'_, Body>, triangle: u32, weights: [f32; 3]) -> Self {
        Self::on(&body, py, tautline::Anchor::triangle(body.handle, triangle, weights))
    }

    /// A point of a segment of a rope: 0 where the segment begins, 1 where it ends.
    #[staticmethod]
    fn segment(py: Python<'_>, body: PyRef<'_, Body>, segment: u32, fraction: f32) -> Self {
        Self::on(&body, py, tautline::Anchor::segment(body.handle, segment, fraction))
    }

    /// A point of a rigid body, in its own frame, in m.
    #[staticmethod]
    fn point(py: Python<'_>, body: PyRef<'_, Body>, point: V3) -> Self {
        Self::on(&body, py, tautline::Anchor::point(body.handle, point.0))
    }

    /// A point of the world, in m.
    #[staticmethod]
    fn world(point: V3) -> Self {
        Self { anchor: tautline::Anchor::world(point.0), world: None }
    }
}

/// An attachment of a world.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Attachment {
    world: Py<World>,
    handle: AttachmentHandle,
}

#[pymethods]
impl Attachment {
    /// On the first end, mean of the last step, in N.
    #[getter]
    fn force(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        let view = |world: &tautline::World| Ok(world.attachment(self.handle)?.force().to_array());
        let force: Result<_, tautline::Error> = self.world.get().look(py, |scene| view(&scene.world));
        Ok(force?)
    }

    #[getter]
    fn is_broken(&self, py: Python<'_>) -> Outcome<bool> {
        let view = |world: &tautline::World| Ok(world.attachment(self.handle)?.is_broken());
        let broken: Result<_, tautline::Error> = self.world.get().look(py, |scene| view(&scene.world));
        Ok(broken?)
    }

    fn detach(&self, py: Python<'_>) -> Outcome<()> {
        self.world.get().change(py, |world| world.detach(self.handle))
    }
}

/// A body that is held at a point.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Grab {
    world: Py<World>,
    handle: GrabHandle,
}

#[pymethods]
impl Grab {
    /// Where what is held is drawn to, in m.
    fn move_to(&self, py: Python<'_>, target: V3) -> Outcome<()> {
        self.world.get().change(py, |world| world.move_grab(self.handle, target.0))
    }

    fn release(&self, py: Python<'_>) -> Outcome<()> {
        self.world.get().change(py, |world| world.release(self.handle))
    }
}
