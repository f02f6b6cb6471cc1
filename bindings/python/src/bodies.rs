//! What is added to a world: builders, with everything they know as keyword arguments.

use std::sync::Arc;

use pyo3::prelude::*;
use tautline::body::BodyDescription;
use tautline::mesh::TriMesh;
use tautline::{CollisionGroups, Motion};
use tautline_scene::build::Look;

use crate::args::{self, Rotation, V3};
use crate::errors::{Failure, Outcome};
use crate::shape::Shape;

/// What to add, and how it is drawn.
pub(crate) struct Addition {
    pub(crate) body: BodyDescription,
    pub(crate) look: Look,
}

impl Addition {
    /// From any of the builders.
    pub(crate) fn of(builder: &Bound<'_, PyAny>) -> Outcome<Self> {
        if let Ok(body) = builder.cast::<RigidBody>() {
            let RigidBody { body, look } = body.get();
            return Ok(Self { body: body.clone().into(), look: look.clone() });
        }
        if let Ok(rope) = builder.cast::<Rope>() {
            let Rope { rope, radius } = rope.get();
            return Ok(Self { body: rope.clone().into(), look: Look::Tube { radius: *radius } });
        }
        if let Ok(cloth) = builder.cast::<Cloth>() {
            return Ok(Self { body: cloth.get().0.clone().into(), look: Look::Sheet });
        }
        if let Ok(solid) = builder.cast::<SoftSolid>() {
            return Ok(Self { body: solid.get().0.clone().into(), look: Look::Sheet });
        }
        if let Ok(wall) = builder.cast::<HalfSpace>() {
            return Ok(Self { body: wall.get().0.into(), look: Look::Wall(TriMesh::default()) });
        }
        let kind = builder.get_type();
        let expected = "RigidBody, Cloth, Rope, SoftSolid or HalfSpace";
        Err(Failure::invalid("body", format!("expected {expected}, not {kind}")))
    }
}

/// Everything behind a plane: a floor, unless told otherwise.
///
/// Args:
///     normal: Out of the solid; (0, 1, 0) if absent.
///     offset: Of the plane from the origin along the normal, in m.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct HalfSpace(tautline::HalfSpace);

#[pymethods]
impl HalfSpace {
    #[new]
    #[pyo3(signature = (normal=None, offset=0.0, *, friction=0.5, restitution=0.0))]
    fn new(normal: Option<V3>, offset: f32, friction: f32, restitution: f32) -> Self {
        let normal = normal.map_or(tautline::Vec3::Y, |normal| normal.0);
        Self(tautline::HalfSpace::new(normal, offset).friction(friction).restitution(restitution))
    }
}

/// A rigid body to be added to a world.
///
/// Args:
///     shape: What it is.
///     position: Of the origin of the shape's frame, in m.
///     rotation: From the shape's frame to the world: a quaternion x, y, z, w.
///     velocity: Of the centre of mass, in m/s.
///     angular_velocity: In rad/s, in the world's frame.
///     mass: In kg.
///     density: In kg/m³, instead of a mass; 1000 if both are absent.
///     friction: Coulomb's coefficient.
///     restitution: Speed apart over speed together of a collision, 0 to 1.
///     rolling_friction: How far, in m, the normal force acts in front of the contact when it rolls.
///     motion: What moves it: forces, its velocity alone, or nothing.
///     gravity_scale: How many times the world's gravity acts on it.
///     damping: Rates at which its motion and its rotation die out, in 1/s; (0, 0) if absent.
///     groups: Two bit masks, memberships and filter; all if absent.
///     can_sleep: Whether it is put to sleep when it rests.
///     report_contacts: Whether its contacts are in ``World.contact_events``.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct RigidBody {
    body: tautline::RigidBody,
    look: Look,
}

#[pymethods]
impl RigidBody {
    #[new]
    #[pyo3(signature = (shape, *, position=None, rotation=None, velocity=None, angular_velocity=None, mass=None,
        density=None, friction=0.5, restitution=0.0, rolling_friction=0.0, motion="dynamic", gravity_scale=1.0,
        damping=(0.0, 0.0), groups=None, can_sleep=true, report_contacts=false))]
    #[allow(clippy::too_many_arguments)] // Keywords, in Python.
    fn new(
        shape: PyRef<'_, Shape>,
        position: Option<V3>,
        rotation: Option<Rotation>,
        velocity: Option<V3>,
        angular_velocity: Option<V3>,
        mass: Option<f32>,
        density: Option<f32>,
        friction: f32,
        restitution: f32,
        rolling_friction: f32,
        motion: &str,
        gravity_scale: f32,
        damping: (f32, f32),
        groups: Option<(u32, u32)>,
        can_sleep: bool,
        report_contacts: bool,
    ) -> Outcome<Self> {
        let mut body = tautline::RigidBody::new(&shape.shape)
            .position(vector(position))
            .velocity(vector(velocity))
            .angular_velocity(vector(angular_velocity))
            .friction(friction)
            .restitution(restitution)
            .rolling_friction(rolling_friction)
            .gravity_scale(gravity_scale)
            .damping(damping.0, damping.1);
        body = match (mass, density) {
            (Some(_), Some(_)) => return Err(Failure::invalid("mass", "give a mass or a density, not both")),
            (Some(mass), None) => body.mass(mass),
            (None, Some(density)) => body.density(density),
            (None, None) => body,
        };
        body = match motion_of(motion)? {
            Motion::Dynamic => body,
            Motion::Kinematic => body.kinematic(),
            Motion::Fixed => body.fixed(),
        };
        if let Some(rotation) = rotation {
            body = body.rotation(rotation.0);
        }
        if let Some((memberships, filter)) = groups {
            body = body.groups(CollisionGroups { memberships, filter });
        }
        if !can_sleep {
            body = body.never_sleep();
        }
        if report_contacts {
            body = body.report_contacts();
        }
        let mesh = TriMesh {
            positions: shape.shape.positions().to_vec(),
            triangles: shape.shape.triangles().to_vec(),
        };
        let look = if shape.is_round { Look::Round } else { Look::Solid };
        Ok(Self { body, look: look(Arc::new(mesh)) })
    }
}

/// What moves a body, by its name.
pub(crate) fn motion_of(name: &str) -> Outcome<Motion> {
    match name {
        "dynamic" => Ok(Motion::Dynamic),
        "kinematic" => Ok(Motion::Kinematic),
        "fixed" => Ok(Motion::Fixed),
        _ => Err(Failure::invalid(
            "motion",
            format!("{name:?} is not \"dynamic\", \"kinematic\" or \"fixed\""),
        )),
    }
}

/// A level rectangle about the origin, ``width`` along x and ``depth`` along z (m), of ``columns`` × ``rows`` particles;
/// particle ``row * columns + column``. For ``Cloth``.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Grid {
    #[pyo3(get)]
    columns: u32,
    #[pyo3(get)]
    rows: u32,
    /// Along x, in m.
    #[pyo3(get)]
    width: f32,
    /// Along z, in m.
    #[pyo3(get)]
    depth: f32,
}

#[pymethods]
impl Grid {
    #[new]
    fn new(columns: u32, rows: u32, width: f32, depth: f32) -> Self {
        Self { columns, rows, width, depth }
    }

    /// The particles at the corners: least x and z first, then along x.
    #[getter]
    fn corners(&self) -> [u32; 4] {
        let last_column = self.columns.saturating_sub(1);
        let last_row = self.rows.saturating_sub(1).saturating_mul(self.columns);
        [0, last_column, last_row, last_row.saturating_add(last_column)]
    }
}

/// A sheet to be added to a world.
///
/// Args:
///     surface: A ``Grid``, or a mesh as (positions (n, 3) in m, triangles (m, 3)).
///     position: Where the surface's origin is put, in m.
///     rotation: About the surface's origin: a quaternion x, y, z, w.
///     sag: How far the middle of a grid hangs below its corners where it is laid out, in m.
///     velocity: Of all particles, in m/s.
///     mass: In kg.
///     density: In kg/m², instead of a mass.
///     friction: Coulomb's coefficient.
///     thickness: How far from solids it is kept, in m.
///     self_collision: Whether it collides with itself.
///     bending_stiffness: Flexural rigidity, in N m.
///     compliance: Strain per tension, in m/N; it does not stretch if absent.
///     shear_compliance: Shear angle per force along a width, in m/N.
///     strain_limit: The most that it stretches, as a share.
///     drag: Coefficient of the air's resistance, about 1.2 for a plate.
///     lift: Coefficient of the air's lift.
///     pressure: Of the gas in a closed surface, over the surroundings, in Pa.
///     tear_at: The strain at which it tears.
///     creep: Strain beyond which it gets longer for good, and how fast, in 1/s.
///     pins: Particles that stay where they start.
///     seams: Pairs of particles that are sewn together.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Cloth(tautline::Cloth);

#[pymethods]
impl Cloth {
    #[new]
    #[pyo3(signature = (surface, *, position=None, rotation=None, sag=None, velocity=None, mass=1.0, density=None,
        friction=0.5, thickness=None, self_collision=true, bending_stiffness=None, compliance=None, shear_compliance=None,
        strain_limit=None, drag=None, lift=None, pressure=None, tear_at=None, creep=None, pins=Vec::new(),
        seams=Vec::new()))]
    #[allow(clippy::too_many_arguments)] // Keywords, in Python.
    fn new(
        surface: &Bound<'_, PyAny>,
        position: Option<V3>,
        rotation: Option<Rotation>,
        sag: Option<f32>,
        velocity: Option<V3>,
        mass: f32,
        density: Option<f32>,
        friction: f32,
        thickness: Option<f32>,
        self_collision: bool,
        bending_stiffness: Option<f32>,
        compliance: Option<f32>,
        shear_compliance: Option<f32>,
        strain_limit: Option<f32>,
        drag: Option<f32>,
        lift: Option<f32>,
        pressure: Option<f32>,
        tear_at: Option<f32>,
        creep: Option<(f32, f32)>,
        pins: Vec<u32>,
        seams: Vec<(u32, u32)>,
    ) -> Outcome<Self> {
        type Change = fn(tautline::Cloth, f32) -> tautline::Cloth;
        let wishes: [(Option<f32>, Change); 11] = [
            (sag, tautline::Cloth::sag),
            (density, tautline::Cloth::density),
            (thickness, tautline::Cloth::thickness),
            (bending_stiffness, tautline::Cloth::bending_stiffness),
            (compliance, tautline::Cloth::compliance),
            (shear_compliance, tautline::Cloth::shear_compliance),
            (strain_limit, tautline::Cloth::strain_limit),
            (drag, tautline::Cloth::drag),
            (lift, tautline::Cloth::lift),
            (pressure, tautline::Cloth::pressure),
            (tear_at, tautline::Cloth::tear_at),
        ];
        let mut cloth = sheet(surface)?
            .position(vector(position))
            .velocity(vector(velocity))
            .mass(mass)
            .friction(friction)
            .self_collision(self_collision);
        for (value, change) in wishes {
            cloth = value.into_iter().fold(cloth, change);
        }
        if let Some(rotation) = rotation {
            cloth = cloth.rotation(rotation.0);
        }
        if let Some((strain, rate)) = creep {
            cloth = cloth.creep(strain, rate);
        }
        cloth = pins.into_iter().fold(cloth, tautline::Cloth::pin);
        cloth = seams.into_iter().fold(cloth, |cloth, (a, b)| cloth.seam(a, b));
        Ok(Self(cloth))
    }
}

/// From a grid, or from a mesh as (positions, triangles).
fn sheet(surface: &Bound<'_, PyAny>) -> Outcome<tautline::Cloth> {
    if let Ok(grid) = surface.cast::<Grid>() {
        let &Grid { columns, rows, width, depth } = grid.get();
        return Ok(tautline::Cloth::grid(columns, rows, width, depth));
    }
    Ok(tautline::Cloth::from_mesh(mesh_of("surface", surface, "a Grid")?))
}

fn mesh_of(field: &str, given: &Bound<'_, PyAny>, other: &str) -> Outcome<TriMesh> {
    let Ok((positions, triangles)) = given.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() else {
        let kind = given.get_type();
        let expected = format!("expected {other} or a mesh as (positions, triangles), not {kind}");
        return Err(Failure::invalid(field, expected));
    };
    args::mesh(&positions, &triangles)
}

/// A rope, or a net, to be added to a world.
///
/// Args:
///     points: Its particles (n, 3), in m.
///     segments: Of a net: between which points, (m, 2).
///     length: At rest, in m, if it is not the length it is laid out at.
///     velocity: Of all particles, in m/s.
///     mass: In kg.
///     radius: In m.
///     friction: Coulomb's coefficient.
///     self_collision: Whether it collides with itself.
///     bending_stiffness: E I, in N m².
///     compliance: Strain per tension, in 1/N; it does not stretch if absent.
///     least_angle: The least angle at any inner particle, in rad, 0 to π.
///     pins: Particles that stay where they start.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Rope {
    rope: tautline::Rope,
    radius: f32,
}

#[pymethods]
impl Rope {
    #[new]
    #[pyo3(signature = (points, *, segments=None, length=None, velocity=None, mass=1.0, radius=0.02, friction=0.5,
        self_collision=false, bending_stiffness=None, compliance=None, least_angle=None, pins=Vec::new()))]
    #[allow(clippy::too_many_arguments)] // Keywords, in Python.
    fn new(
        points: &Bound<'_, PyAny>,
        segments: Option<Bound<'_, PyAny>>,
        length: Option<f32>,
        velocity: Option<V3>,
        mass: f32,
        radius: f32,
        friction: f32,
        self_collision: bool,
        bending_stiffness: Option<f32>,
        compliance: Option<f32>,
        least_angle: Option<f32>,
        pins: Vec<u32>,
    ) -> Outcome<Self> {
        let points = args::points("points", points)?;
        let mut rope = match segments {
            Some(segments) => tautline::Rope::network(points, args::indices("segments", &segments)?),
            None => tautline::Rope::through(points),
        };
        rope = rope
            .velocity(vector(velocity))
            .mass(mass)
            .radius(radius)
            .friction(friction)
            .self_collision(self_collision);
        rope = length.into_iter().fold(rope, tautline::Rope::length);
        rope = bending_stiffness.into_iter().fold(rope, tautline::Rope::bending_stiffness);
        rope = compliance.into_iter().fold(rope, tautline::Rope::compliance);
        rope = least_angle.into_iter().fold(rope, tautline::Rope::bend_limit);
        rope = pins.into_iter().fold(rope, tautline::Rope::pin);
        Ok(Self { rope, radius })
    }
}

/// A box from ``-half_extents`` to ``half_extents`` (m) of so many cells along each axis. For ``SoftSolid``.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct Lattice {
    half_extents: V3,
    cells: [u32; 3],
}

#[pymethods]
impl Lattice {
    #[new]
    fn new(half_extents: V3, cells: [u32; 3]) -> Self {
        Self { half_extents, cells }
    }
}

/// A soft solid to be added to a world: a jelly, a tyre, a sponge.
///
/// Args:
///     volume: A ``Lattice``, or a closed mesh as (positions (n, 3) in m, triangles (m, 3)).
///     position: Where the origin of its shape is put, in m.
///     rotation: About that: a quaternion x, y, z, w.
///     velocity: In m/s.
///     angular_velocity: In rad/s.
///     density: In kg/m³.
///     mass: In kg, instead of a density.
///     young_modulus: In Pa.
///     poisson_ratio: 0 to 0.49.
///     friction: Coulomb's coefficient.
///     thickness: How far from solids its particles are kept, in m.
///     self_collision: Whether it collides with itself.
///     pins: Particles that stay where they start.
#[pyclass(frozen, module = "tautline")]
pub(crate) struct SoftSolid(tautline::SoftSolid);

#[pymethods]
impl SoftSolid {
    #[new]
    #[pyo3(signature = (volume, *, position=None, rotation=None, velocity=None, angular_velocity=None, density=1000.0,
        mass=None, young_modulus=1e5, poisson_ratio=0.45, friction=0.5, thickness=None, self_collision=true,
        pins=Vec::new()))]
    #[allow(clippy::too_many_arguments)] // Keywords, in Python.
    fn new(
        volume: &Bound<'_, PyAny>,
        position: Option<V3>,
        rotation: Option<Rotation>,
        velocity: Option<V3>,
        angular_velocity: Option<V3>,
        density: f32,
        mass: Option<f32>,
        young_modulus: f32,
        poisson_ratio: f32,
        friction: f32,
        thickness: Option<f32>,
        self_collision: bool,
        pins: Vec<u32>,
    ) -> Outcome<Self> {
        let mut solid = match volume.cast::<Lattice>() {
            Ok(lattice) => tautline::SoftSolid::cuboid(lattice.get().half_extents.0, lattice.get().cells),
            Err(_) => tautline::SoftSolid::from_mesh(mesh_of("volume", volume, "a Lattice")?),
        };
        solid = solid
            .position(vector(position))
            .velocity(vector(velocity))
            .angular_velocity(vector(angular_velocity))
            .density(density)
            .young_modulus(young_modulus)
            .poisson_ratio(poisson_ratio)
            .friction(friction)
            .self_collision(self_collision);
        solid = mass.into_iter().fold(solid, tautline::SoftSolid::mass);
        solid = thickness.into_iter().fold(solid, tautline::SoftSolid::thickness);
        if let Some(rotation) = rotation {
            solid = solid.rotation(rotation.0);
        }
        Ok(Self(pins.into_iter().fold(solid, tautline::SoftSolid::pin)))
    }
}

fn vector(given: Option<V3>) -> tautline::Vec3 {
    given.map_or(tautline::Vec3::ZERO, |vector| vector.0)
}
