//! What bodies are made of, seen by queries: convex parts, meshes, hulls, triangles and segments.

use std::cell::Cell;

use glam::{DQuat, DVec3, Mat3, Vec3};

use crate::body::{Body, Frame, Substance};
use crate::collision::Aabb;
use crate::geometry::query::{
    Closest, Motion, Ray, RayHit, Rounded, closest_to_convex, closest_to_triangle, ray_to_convex,
    ray_to_triangle,
};
use crate::norm::Norm;
use crate::shape::{Convex, Part, Shape, Surface};

/// A box that was rounded is larger by this share of its coordinates.
const ROUNDING: f32 = 1e-6;

/// Where something is: its origin and the rotation from its frame to the world's.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pose {
    pub(crate) position: DVec3,
    pub(crate) rotation: DQuat,
}

/// Something that a query may find.
#[derive(Debug, Clone)]
pub(crate) enum Piece<'a> {
    /// Of a rigid body.
    Part(&'a Part, Pose),
    /// Of a rigid body without an inside.
    Surface(&'a Surface, Pose),
    /// The convex hull of the vertices of a truss, for what meets shapes.
    Hull(&'a [Vec3]),
    /// Of a truss or cloth, for rays and points.
    Triangle([Vec3; 3]),
    /// Of a rope, with its radius.
    Segment([Vec3; 2], f32),
}

impl Pose {
    const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// The principal frame of a rigid body with these particles.
    pub(crate) fn of_particles(particles: &[Vec3]) -> Self {
        let frame = Frame::of_particles(particles);
        // Normalised in f64, so that it is a rotation also far from the body.
        let rotation = DQuat::from_mat3(&frame.axes.as_dmat3()).normalize();
        Self { position: frame.center.as_dvec3(), rotation }
    }

    /// The principal frame of a shape whose own frame is there.
    pub(crate) fn of_shape(shape: &Shape, position: Vec3, rotation: glam::Quat) -> Self {
        let own = rotation.as_dquat().normalize();
        let position = position.as_dvec3() + own * shape.center_of_mass().as_dvec3();
        Self { position, rotation: (own * shape.principal_rotation().as_dquat()).normalize() }
    }

    fn to_local(self, point: DVec3) -> DVec3 {
        self.rotation.inverse() * (point - self.position)
    }

    fn ray_to_local(self, ray: &Ray) -> Ray {
        Ray {
            origin: self.to_local(ray.origin),
            direction: self.rotation.inverse() * ray.direction,
            max: ray.max,
        }
    }

    /// The box around a box in this frame.
    pub(crate) fn bounds(self, low: Vec3, high: Vec3) -> Aabb {
        let axes = Mat3::from_quat(self.rotation.as_quat());
        let bounds = Aabb::around_turned(self.position.as_vec3(), &axes, low, high);
        bounds.grown(ROUNDING * bounds.low.abs().max(bounds.high.abs()).max_element())
    }
}

/// How many pieces there are of a body.
pub(crate) fn piece_count(body: &Body) -> usize {
    match &body.substance {
        Substance::Rigid(_) | Substance::HalfSpace(_) => solid_piece_count(body),
        Substance::Truss { truss } => 1 + truss.triangles().len(),
        Substance::Deformable(deformable) if deformable.is_rope() => deformable.sticks.len(),
        Substance::Deformable(deformable) => deformable.triangles.len(),
    }
}

/// How many of them, which come first, are those of a solid, or of a mesh that stands for one.
pub(crate) fn solid_piece_count(body: &Body) -> usize {
    match &body.substance {
        Substance::Rigid(rigid) => rigid.shape.parts().len() + usize::from(rigid.shape.surface().is_some()),
        Substance::Truss { .. } => 1,
        Substance::Deformable(_) | Substance::HalfSpace(_) => 0,
    }
}

impl<'a> Piece<'a> {
    /// A piece of a body, out of all particles of the world. Nothing for a number that is not below
    /// [`piece_count`].
    pub(crate) fn of(body: &'a Body, positions: &'a [Vec3], number: usize) -> Option<Self> {
        let particles = &positions[body.particles.clone()];
        let triangle = |triangles: &[[u32; 3]], number: usize| {
            triangles.get(number).map(|corners| Self::Triangle(corners.map(|v| particles[v as usize])))
        };
        match &body.substance {
            Substance::Rigid(rigid) => {
                let pose = Pose::of_particles(particles);
                let part = rigid.shape.parts().get(number).map(|part| Self::Part(part, pose));
                part.or_else(|| rigid.shape.surface().map(|surface| Self::Surface(surface, pose)))
            }
            Substance::Truss { truss } => match number.checked_sub(1) {
                None => Some(Self::Hull(&particles[..truss.surface().vertex_count()])),
                Some(number) => triangle(truss.triangles(), number),
            },
            Substance::Deformable(deformable) if deformable.is_rope() => {
                let stick = deformable.sticks.get(number)?;
                let ends = [stick.a, stick.b].map(|end| particles[end as usize]);
                Some(Self::Segment(ends, deformable.thickness))
            }
            Substance::Deformable(deformable) => triangle(&deformable.triangles, number),
            Substance::HalfSpace(_) => None,
        }
    }

    pub(crate) fn bounds(&self) -> Aabb {
        match self {
            Self::Part(part, pose) => pose.bounds(part.low, part.high),
            Self::Surface(surface, pose) => {
                let (low, high) = surface.bounds();
                pose.bounds(low, high)
            }
            Self::Hull(points) => Aabb::around(points, 0.0),
            Self::Triangle(corners) => Aabb::around(corners, 0.0),
            Self::Segment(ends, radius) => Aabb::around(ends, radius * (1.0 + ROUNDING)),
        }
    }

    /// Where a ray enters it. Triangles are hit from both sides.
    pub(super) fn ray(&self, ray: &Ray) -> Option<RayHit> {
        match self {
            Self::Part(part, pose) => {
                let hit = ray_to_convex(&pose.ray_to_local(ray), &part.convex)?;
                Some(RayHit { normal: pose.rotation * hit.normal, ..hit })
            }
            Self::Surface(surface, pose) => {
                let hit = ray_to_surface(&pose.ray_to_local(ray), surface)?;
                Some(RayHit { normal: pose.rotation * hit.normal, ..hit })
            }
            Self::Hull(_) => None,
            Self::Triangle(corners) => ray_to_triangle(ray, *corners),
            Self::Segment(ends, radius) => ray_to_convex(ray, &capsule(*ends, *radius)),
        }
    }

    /// The place of its surface closest to a point.
    pub(super) fn closest(&self, point: DVec3) -> Option<Closest> {
        let back = |pose: &Pose, found: Closest| Closest {
            point: pose.position + pose.rotation * found.point,
            normal: pose.rotation * found.normal,
            ..found
        };
        match self {
            Self::Part(part, pose) => Some(back(pose, closest_to_convex(pose.to_local(point), &part.convex))),
            Self::Surface(surface, pose) => {
                closest_on_surface(pose.to_local(point), surface).map(|found| back(pose, found))
            }
            Self::Hull(_) => None,
            Self::Triangle(corners) => Some(closest_to_triangle(point, *corners)),
            Self::Segment(ends, radius) => Some(closest_to_convex(point, &capsule(*ends, *radius))),
        }
    }

    /// Calls `visit` with every convex set that it is made of and that may reach into a box, at rest.
    pub(crate) fn convex_sets(&self, near: &Aabb, mut visit: impl FnMut(&Motion<'_>)) {
        let mut visit = |corners: &[Vec3], radius: f32, pose: Pose| {
            let shape = Rounded { corners, radius };
            visit(&Motion::translation(shape, pose.position, pose.rotation, DVec3::ZERO));
        };
        match self {
            Self::Part(part, pose) => visit(&part.convex.vertices, part.convex.radius, *pose),
            Self::Surface(surface, pose) => {
                let rotation = pose.rotation.inverse();
                let inverse = Pose { position: rotation * -pose.position, rotation };
                let near = inverse.bounds(near.low, near.high);
                let mut numbers = Vec::new();
                surface.triangles_in(near.low, near.high, &mut numbers);
                numbers.iter().for_each(|&number| visit(&surface.triangle(number).corners, 0.0, *pose));
            }
            Self::Hull(points) => visit(points, 0.0, Pose::IDENTITY),
            Self::Triangle(corners) => visit(corners, 0.0, Pose::IDENTITY),
            Self::Segment(ends, radius) => visit(ends, *radius, Pose::IDENTITY),
        }
    }
}

fn capsule(ends: [Vec3; 2], radius: f32) -> Convex {
    Convex::new(ends.to_vec(), Vec::new(), Vec::new(), radius)
}

/// Of triangles equally far away that of the lowest number counts.
fn ray_to_surface(ray: &Ray, surface: &Surface) -> Option<RayHit> {
    let first: Cell<Option<(u32, RayHit)>> = Cell::new(None);
    let max = || first.get().map_or(ray.max, |(_, hit)| hit.t);
    let enters = |low: Vec3, high: Vec3| enters_box(ray, low.as_dvec3(), high.as_dvec3(), max());
    surface.search(enters, |number| {
        let hit = ray_to_triangle(ray, surface.triangle(number).corners);
        let is_before = |hit: &RayHit| first.get().is_none_or(|(other, at)| (hit.t, number) < (at.t, other));
        if let Some(hit) = hit.filter(is_before) {
            first.set(Some((number, hit)));
        }
    });
    first.get().map(|(_, hit)| hit)
}

/// The slab test, with boxes enlarged so that a ray through the edge between two meets one of them.
fn enters_box(ray: &Ray, low: DVec3, high: DVec3, max: f64) -> bool {
    let margin = f64::from(ROUNDING) * low.abs().max(high.abs()).max_element();
    let (mut enter, mut leave) = (0.0_f64, max);
    for axis in 0..3 {
        let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
        let [below, above] = [low[axis] - margin - origin, high[axis] + margin - origin];
        if direction == 0.0 {
            if below > 0.0 || above < 0.0 {
                return false;
            }
            continue;
        }
        let (a, b) = (below / direction, above / direction);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    enter <= leave
}

/// Of triangles equally close that of the lowest number counts.
fn closest_on_surface(point: DVec3, surface: &Surface) -> Option<Closest> {
    let first: Cell<Option<(u32, Closest)>> = Cell::new(None);
    let is_near = |low: Vec3, high: Vec3| {
        let gap = (low.as_dvec3() - point).max(point - high.as_dvec3()).max(DVec3::ZERO);
        first.get().is_none_or(|(_, found)| gap.norm() <= found.distance)
    };
    surface.search(is_near, |number| {
        let found = closest_to_triangle(point, surface.triangle(number).corners);
        if first.get().is_none_or(|(other, best)| (found.distance, number) < (best.distance, other)) {
            first.set(Some((number, found)));
        }
    });
    first.get().map(|(_, found)| found)
}
