//! What is where: rays, moving shapes, overlaps and closest points in a world, and the distance of two hulls.

use pyo3::prelude::*;
use tautline::geometry::distance;
use tautline::{BodyHandle, CollisionGroups, QueryFilter};

use crate::args::{self, Rotation, V3};
use crate::body::Body;
use crate::errors::Outcome;
use crate::shape::Shape;
use crate::world::World;

/// Where a query met a body.
#[pyclass(frozen, get_all, module = "tautline")]
pub(crate) struct Hit {
    body: Py<Body>,
    /// On the body's surface, in m.
    point: [f32; 3],
    /// Unit, out of the body.
    normal: [f32; 3],
    /// In m; of a moving shape, how much of its way it has gone.
    distance: f32,
}

impl Hit {
    fn new(
        world: &Bound<'_, World>,
        body: BodyHandle,
        place: [tautline::Vec3; 2],
        distance: f32,
    ) -> PyResult<Self> {
        let [point, normal] = place.map(|vector| vector.to_array());
        Ok(Self { body: Py::new(world.py(), Body::new(world, body))?, point, normal, distance })
    }
}

fn filter(
    world: &Bound<'_, World>,
    exclude: Option<PyRef<'_, Body>>,
    fixed: bool,
    movable: bool,
    groups: Option<(u32, u32)>,
) -> Outcome<QueryFilter> {
    let exclude = exclude.map(|body| body.handle_in(world)).transpose()?;
    let groups = groups.map_or_else(CollisionGroups::default, |(memberships, filter)| CollisionGroups {
        memberships,
        filter,
    });
    Ok(QueryFilter { groups, exclude, fixed, movable })
}

#[pymethods]
#[allow(clippy::too_many_arguments)] // Keywords, in Python.
impl World {
    /// The first body that a ray enters, up to the distance ``max`` (m).
    #[pyo3(signature = (origin, direction, max=1e6, *, exclude=None, fixed=true, movable=true, groups=None))]
    fn ray_cast(
        slf: &Bound<'_, Self>,
        origin: V3,
        direction: V3,
        max: f32,
        exclude: Option<PyRef<'_, Body>>,
        fixed: bool,
        movable: bool,
        groups: Option<(u32, u32)>,
    ) -> Outcome<Option<Hit>> {
        let filter = filter(slf, exclude, fixed, movable, groups)?;
        let hit =
            slf.get().look(slf.py(), |scene| scene.world.ray_cast(origin.0, direction.0, max, filter))?;
        Ok(hit.map(|hit| Hit::new(slf, hit.body, [hit.point, hit.normal], hit.distance)).transpose()?)
    }

    /// All bodies that a ray enters, nearest first.
    #[pyo3(signature = (origin, direction, max=1e6, *, exclude=None, fixed=true, movable=true, groups=None))]
    fn ray_cast_all(
        slf: &Bound<'_, Self>,
        origin: V3,
        direction: V3,
        max: f32,
        exclude: Option<PyRef<'_, Body>>,
        fixed: bool,
        movable: bool,
        groups: Option<(u32, u32)>,
    ) -> Outcome<Vec<Hit>> {
        let filter = filter(slf, exclude, fixed, movable, groups)?;
        let hits =
            slf.get().look(slf.py(), |scene| scene.world.ray_cast_all(origin.0, direction.0, max, filter))?;
        let told = hits.iter().map(|hit| Hit::new(slf, hit.body, [hit.point, hit.normal], hit.distance));
        Ok(told.collect::<PyResult<_>>()?)
    }

    /// The first body that a shape touches which moves by ``translation`` (m) without turning; the hit's ``distance`` is how
    /// much of its way it has gone, 0 to 1.
    #[pyo3(signature = (shape, position, translation, *, rotation=None, exclude=None, fixed=true, movable=true,
        groups=None))]
    fn shape_cast(
        slf: &Bound<'_, Self>,
        shape: PyRef<'_, Shape>,
        position: V3,
        translation: V3,
        rotation: Option<Rotation>,
        exclude: Option<PyRef<'_, Body>>,
        fixed: bool,
        movable: bool,
        groups: Option<(u32, u32)>,
    ) -> Outcome<Option<Hit>> {
        let filter = filter(slf, exclude, fixed, movable, groups)?;
        let rotation = rotation.map_or(tautline::Quat::IDENTITY, |rotation| rotation.0);
        let hit = slf.get().look(slf.py(), |scene| {
            scene.world.shape_cast(&shape.shape, position.0, rotation, translation.0, filter)
        })?;
        Ok(hit.map(|hit| Hit::new(slf, hit.body, [hit.point, hit.normal], hit.fraction)).transpose()?)
    }

    /// The bodies that a shape overlaps or touches.
    #[pyo3(signature = (shape, position, *, rotation=None, exclude=None, fixed=true, movable=true, groups=None))]
    fn overlap(
        slf: &Bound<'_, Self>,
        shape: PyRef<'_, Shape>,
        position: V3,
        rotation: Option<Rotation>,
        exclude: Option<PyRef<'_, Body>>,
        fixed: bool,
        movable: bool,
        groups: Option<(u32, u32)>,
    ) -> Outcome<Vec<Body>> {
        let filter = filter(slf, exclude, fixed, movable, groups)?;
        let rotation = rotation.map_or(tautline::Quat::IDENTITY, |rotation| rotation.0);
        let found = slf
            .get()
            .look(slf.py(), |scene| scene.world.overlap(&shape.shape, position.0, rotation, filter))?;
        Ok(found.into_iter().map(|handle| Body::new(slf, handle)).collect())
    }

    /// The body whose surface is closest to a point (m); the hit's ``distance`` is below 0 in a body.
    #[pyo3(signature = (point, max=1e6, *, exclude=None, fixed=true, movable=true, groups=None))]
    fn closest_point(
        slf: &Bound<'_, Self>,
        point: V3,
        max: f32,
        exclude: Option<PyRef<'_, Body>>,
        fixed: bool,
        movable: bool,
        groups: Option<(u32, u32)>,
    ) -> Outcome<Option<Hit>> {
        let filter = filter(slf, exclude, fixed, movable, groups)?;
        let hit = slf.get().look(slf.py(), |scene| scene.world.closest_point(point.0, max, filter))?;
        Ok(hit.map(|hit| Hit::new(slf, hit.body, [hit.point, hit.normal], hit.distance)).transpose()?)
    }
}

/// The signed distance of two convex hulls, and where it is.
#[pyclass(frozen, get_all, module = "tautline")]
pub(crate) struct Distance {
    /// In m: above 0 the gap, below 0 the depth.
    distance: f32,
    /// Unit, from A to B.
    normal: [f32; 3],
    /// The witness point on A, in m.
    point_a: [f32; 3],
    /// The witness point on B, in m.
    point_b: [f32; 3],
    iterations: u32,
    /// Whether the answer is certain within rounding.
    converged: bool,
}

#[pymethods]
impl Distance {
    fn __repr__(&self) -> String {
        format!("Distance(distance={}, normal={:?})", self.distance, self.normal)
    }
}

/// The signed distance of the convex hulls of two sets of points, in m: (n, 3) and (m, 3).
#[pyfunction]
#[pyo3(name = "distance")]
pub(crate) fn hull_distance(a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>) -> Outcome<Distance> {
    let found = distance::distance(&args::points("a", a)?, &args::points("b", b)?)?;
    Ok(Distance {
        distance: found.distance,
        normal: found.normal.to_array(),
        point_a: found.point_a.to_array(),
        point_b: found.point_b.to_array(),
        iterations: found.iterations,
        converged: found.converged,
    })
}
