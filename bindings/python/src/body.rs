//! `Body`: one body of a world, by its handle.

use std::hash::{Hash, Hasher};

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use tautline::{BodyHandle, BodyKind, BodyView, Motion, Vec3};

use crate::args::{self, Rotation, V3};
use crate::arrays;
use crate::bodies::motion_of;
use crate::errors::{Failure, Outcome};
use crate::views;
use crate::world::World;

/// A body of a world. It goes on naming that body whatever else comes and goes; once removed, ``StaleHandleError``.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Body {
    pub(crate) world: Py<World>,
    pub(crate) handle: BodyHandle,
}

impl Body {
    pub(crate) fn new(world: &Bound<'_, World>, handle: BodyHandle) -> Self {
        Self { world: world.clone().unbind(), handle }
    }

    /// Its handle, if it is of this world: in another one the same handle may name another body.
    pub(crate) fn handle_in(&self, world: &Bound<'_, World>) -> Outcome<BodyHandle> {
        if self.world.is(world) {
            return Ok(self.handle);
        }
        Err(Failure::invalid("body", "it is a body of another world"))
    }

    fn view<T>(&self, py: Python<'_>, of: impl FnOnce(BodyView<'_>) -> T) -> Outcome<T> {
        let seen = self.world.get().look(py, |scene| scene.world.body(self.handle).map(of));
        Ok(seen?)
    }

    fn change(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut tautline::World, BodyHandle) -> Result<(), tautline::Error>,
    ) -> Outcome<()> {
        self.world.get().change(py, |world| change(world, self.handle))
    }

    /// Where it is and how it is turned, if it is rigid.
    fn pose(&self, py: Python<'_>) -> Outcome<(Vec3, tautline::Quat)> {
        let pose = self.view(py, |body| body.pose())?;
        pose.ok_or_else(|| Failure::invalid("body", "it is not rigid, and has no pose: see center_of_mass"))
    }
}

#[pymethods]
impl Body {
    #[getter]
    fn world(&self, py: Python<'_>) -> Py<World> {
        self.world.clone_ref(py)
    }

    #[getter]
    fn name(&self, py: Python<'_>) -> Outcome<String> {
        let part = self.world.get().look(py, |scene| {
            scene.parts.iter().find(|part| part.body == self.handle).map(|part| part.name.clone())
        });
        Ok(part.ok_or(tautline::Error::StaleHandle)?)
    }

    /// "rigid", "truss", "cloth", "rope", "soft_solid" or "half_space".
    #[getter]
    fn kind(&self, py: Python<'_>) -> Outcome<&'static str> {
        self.view(py, |body| match body.kind() {
            BodyKind::Rigid => "rigid",
            BodyKind::Truss => "truss",
            BodyKind::Cloth => "cloth",
            BodyKind::Rope => "rope",
            BodyKind::SoftSolid => "soft_solid",
            BodyKind::HalfSpace => "half_space",
        })
    }

    /// Whether it is in its world still.
    #[getter]
    fn is_there(&self, py: Python<'_>) -> bool {
        self.world.get().look(py, |scene| scene.world.body(self.handle).is_ok())
    }

    /// Where the origin of a rigid body's shape is, in m.
    #[getter]
    fn position(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        Ok(self.pose(py)?.0.to_array())
    }

    #[setter]
    fn set_position(&self, py: Python<'_>, position: V3) -> Outcome<()> {
        let (_, rotation) = self.pose(py)?;
        self.change(py, |world, body| world.set_pose(body, position.0, rotation))
    }

    /// From a rigid body's frame to the world: a quaternion x, y, z, w.
    #[getter]
    fn rotation(&self, py: Python<'_>) -> Outcome<[f32; 4]> {
        Ok(self.pose(py)?.1.to_array())
    }

    #[setter]
    fn set_rotation(&self, py: Python<'_>, rotation: Rotation) -> Outcome<()> {
        let (position, _) = self.pose(py)?;
        self.change(py, |world, body| world.set_pose(body, position, rotation.0))
    }

    fn set_pose(&self, py: Python<'_>, position: V3, rotation: Rotation) -> Outcome<()> {
        self.change(py, |world, body| world.set_pose(body, position.0, rotation.0))
    }

    /// Of the centre of mass, in m/s.
    #[getter]
    fn velocity(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        self.view(py, |body| body.velocity().to_array())
    }

    #[setter]
    fn set_velocity(&self, py: Python<'_>, velocity: V3) -> Outcome<()> {
        self.change(py, |world, body| world.set_velocity(body, velocity.0))
    }

    /// Of a rigid body, in rad/s, in the world's frame.
    #[getter]
    fn angular_velocity(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        self.view(py, |body| body.angular_velocity().to_array())
    }

    #[setter]
    fn set_angular_velocity(&self, py: Python<'_>, angular_velocity: V3) -> Outcome<()> {
        self.change(py, |world, body| world.set_angular_velocity(body, angular_velocity.0))
    }

    #[getter]
    fn center_of_mass(&self, py: Python<'_>) -> Outcome<[f32; 3]> {
        self.view(py, |body| body.center_of_mass().to_array())
    }

    /// In kg.
    #[getter]
    fn mass(&self, py: Python<'_>) -> Outcome<f32> {
        self.view(py, |body| body.mass())
    }

    /// Of a rigid body about its centre of mass, in the world's frame, in kg m²: three columns.
    #[getter]
    fn inertia(&self, py: Python<'_>) -> Outcome<[[f32; 3]; 3]> {
        self.view(py, |body| body.inertia().to_cols_array_2d())
    }

    /// The volume (m³) and the pressure (Pa over the surroundings) of a cloth with gas in it.
    #[getter]
    fn gas(&self, py: Python<'_>) -> Outcome<Option<(f32, f32)>> {
        self.view(py, |body| body.volume().zip(body.pressure()))
    }

    /// Positions of its particles, in m: a read-only view (n, 3), see ``World.positions``. Of a rigid body these are the four
    /// that it is made of: see ``surface_positions``.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f32>>> {
        let world = self.world.bind(py);
        let sight = world.get().sight(py, |world| world.body(self.handle).map(|body| body.positions()))?;
        Ok(views::of_vectors(world, &sight)?)
    }

    /// Puts the particles of a cloth, rope or soft solid somewhere (m), without a velocity: float32, C-contiguous, (n, 3).
    fn set_positions(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> Outcome<()> {
        let count = self.view(py, |body| body.positions().len())?;
        let positions = args::exact_points("positions", positions, count)?;
        self.change(py, |world, body| world.set_particle_positions(body, &positions))
    }

    /// Of its particles, in 1/kg, 0 = pinned: a read-only view (n,), see ``World.positions``.
    #[getter]
    fn inverse_masses<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray1<f32>>> {
        let world = self.world.bind(py);
        let sight =
            world.get().sight(py, |world| world.body(self.handle).map(|body| body.inverse_masses()))?;
        Ok(views::of_numbers(world, &sight)?)
    }

    /// Of its particles, in m/s: (n, 3).
    #[getter]
    fn particle_velocities<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f32>>> {
        let velocities = self.view(py, |body| {
            (0..body.positions().len() as u32).map(|i| body.particle_velocity(i)).collect::<Vec<_>>()
        })?;
        arrays::vectors(py, &velocities)
    }

    /// Sets the velocities of the particles of a cloth, rope or soft solid, in m/s: float32, C-contiguous, (n, 3). Nothing
    /// happens to pinned ones.
    fn set_particle_velocities(&self, py: Python<'_>, velocities: &Bound<'_, PyAny>) -> Outcome<()> {
        let count = self.view(py, |body| body.positions().len())?;
        let velocities = args::exact_points("velocities", velocities, count)?;
        self.change(py, |world, body| world.set_particle_velocities(body, &velocities))
    }

    /// The vertices of its surface, in m: (v, 3).
    #[getter]
    fn surface_positions<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f32>>> {
        let positions = self.view(py, |body| body.surface_positions().into_owned())?;
        arrays::vectors(py, &positions)
    }

    /// The triangles of its surface: (t, 3).
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<u32>>> {
        let triangles = self.view(py, |body| body.triangles().to_vec())?;
        arrays::corners(py, &triangles)
    }

    /// Pins a particle of a cloth, rope or soft solid where it is.
    fn pin(&self, py: Python<'_>, particle: u32) -> Outcome<()> {
        self.change(py, |world, body| world.pin(body, particle))
    }

    fn unpin(&self, py: Python<'_>, particle: u32) -> Outcome<()> {
        self.change(py, |world, body| world.unpin(body, particle))
    }

    /// During the next step, in N: at the centre of mass, at a point of a rigid body (m), or on one particle.
    #[pyo3(signature = (force, *, point=None, particle=None))]
    fn apply_force(
        &self,
        py: Python<'_>,
        force: V3,
        point: Option<V3>,
        particle: Option<u32>,
    ) -> Outcome<()> {
        self.change(py, |world, body| match (point, particle) {
            (None, None) => world.apply_force(body, force.0),
            (Some(point), None) => world.apply_force_at_point(body, force.0, point.0),
            (None, Some(particle)) => world.apply_force_at(body, particle, force.0),
            (Some(_), Some(_)) => {
                let problem = "give a point or a particle, not both".into();
                Err(tautline::Error::Invalid { field: "point".into(), problem })
            }
        })
    }

    /// On a rigid body during the next step, in N m, in the world's frame.
    fn apply_torque(&self, py: Python<'_>, torque: V3) -> Outcome<()> {
        self.change(py, |world, body| world.apply_torque(body, torque.0))
    }

    /// At once, in N s: at the centre of mass, or at a point of a rigid body (m).
    #[pyo3(signature = (impulse, *, point=None))]
    fn apply_impulse(&self, py: Python<'_>, impulse: V3, point: Option<V3>) -> Outcome<()> {
        self.change(py, |world, body| match point {
            None => world.apply_impulse(body, impulse.0),
            Some(point) => world.apply_impulse_at_point(body, impulse.0, point.0),
        })
    }

    /// "dynamic", "kinematic" or "fixed".
    #[getter]
    fn motion(&self, py: Python<'_>) -> Outcome<&'static str> {
        self.view(py, |body| match body.motion() {
            Motion::Dynamic => "dynamic",
            Motion::Kinematic => "kinematic",
            Motion::Fixed => "fixed",
        })
    }

    #[setter]
    fn set_motion(&self, py: Python<'_>, motion: &str) -> Outcome<()> {
        let motion = motion_of(motion)?;
        self.change(py, |world, body| world.set_motion(body, motion))
    }

    /// Coulomb's coefficient.
    #[getter]
    fn friction(&self, py: Python<'_>) -> Outcome<f32> {
        self.view(py, |body| body.friction())
    }

    #[getter]
    fn is_asleep(&self, py: Python<'_>) -> Outcome<bool> {
        self.view(py, |body| body.is_asleep())
    }

    fn wake(&self, py: Python<'_>) -> Outcome<()> {
        self.change(py, |world, body| world.wake(body))
    }

    /// Of all segments of a rope together, at rest, in m; set, it is wound in or out.
    #[getter]
    fn rope_length(&self, py: Python<'_>) -> Outcome<f32> {
        let length = self.world.get().look(py, |scene| scene.world.rope_length(self.handle));
        Ok(length?)
    }

    #[setter]
    fn set_rope_length(&self, py: Python<'_>, length: f32) -> Outcome<()> {
        self.change(py, |world, body| world.set_rope_length(body, length))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.world.is(&other.world) && self.handle == other.handle
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = std::hash::DefaultHasher::new();
        self.handle.hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        match (self.kind(py), self.name(py)) {
            (Ok(kind), Ok(name)) => format!("<tautline.Body {name:?}: {kind}>"),
            _ => "<tautline.Body: removed>".to_owned(),
        }
    }
}
