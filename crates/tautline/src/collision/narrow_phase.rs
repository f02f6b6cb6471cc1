//! From pairs of bodies to contacts (paper, 5): GJK where both are rigid, sphere trees where one deforms.

use glam::Vec3;

use super::contact::{Contact, Patch};
use super::pair::Pair;
use super::solid::{Plane, Solid, nearest_surface};
use crate::body::{Body, Deformable, HalfSpace, Substance, Truss};
use crate::geometry::distance;
use crate::geometry::epa::Epa;
use crate::geometry::sphere_tree::{DescentStack, WrappedSpheres, descend_pair, descend_self};
use crate::geometry::support::Points;
use crate::norm::Norm;
use crate::parallel;
use crate::particles::Particles;
use crate::settings::ClothSolver;

/// Finds contacts. It holds only scratch memory, so that a step allocates nothing once that has grown.
#[derive(Debug, Clone, Default)]
pub(crate) struct NarrowPhase {
    /// The spheres of each body's wrapped tree.
    spheres: Vec<WrappedSpheres>,
    stack: DescentStack,
    epa: Epa,
    /// Leaves of a deformable body that are near triangles of a rigid one: leaf · 2³² + triangle.
    near: Vec<u64>,
    planes: Vec<Plane>,
}

/// Bodies with their particles, as the narrow phase reads them.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) bodies: &'a [Body],
    pub(crate) particles: &'a Particles,
    pub(crate) cloth: ClothSolver,
}

impl<'a> Scene<'a> {
    fn positions(&self, body: u32) -> &'a [Vec3] {
        &self.particles.position[self.bodies[body as usize].particles.clone()]
    }

    fn first(&self, body: u32) -> usize {
        self.bodies[body as usize].particles.start
    }

    /// The geometric mean of both coefficients.
    fn friction(&self, a: u32, b: u32) -> f32 {
        self.bodies[a as usize].surface.against(&self.bodies[b as usize].surface).friction
    }
}

impl NarrowPhase {
    /// Writes all contacts: with half-spaces, between pairs, of deformable bodies with themselves. Layered trees
    /// have been refitted.
    pub(crate) fn find_contacts(
        &mut self,
        scene: Scene<'_>,
        pairs: &mut [Pair],
        contacts: &mut Vec<Contact>,
    ) {
        contacts.clear();
        self.spheres.resize_with(scene.bodies.len(), WrappedSpheres::default);
        self.spheres.iter_mut().for_each(WrappedSpheres::invalidate);
        half_space_contacts(scene, contacts);
        self.rigid_contacts(scene, pairs, contacts);
        for pair in pairs {
            self.pair_contacts(scene, pair, contacts);
        }
        for (index, body) in scene.bodies.iter().enumerate() {
            if let Substance::Deformable(deformable) = &body.substance
                && body.is_awake()
            {
                self.self_contacts(scene, index as u32, deformable, contacts);
            }
        }
    }

    /// Looks again at the pairs of rigid bodies that touched, now that their deepest features have been
    /// moved: each has one contact at most, at what is deepest now.
    pub(crate) fn find_rigid_contacts(
        &mut self,
        scene: Scene<'_>,
        pairs: &mut [Pair],
        contacts: &mut Vec<Contact>,
    ) {
        contacts.clear();
        self.rigid_contacts(scene, pairs, contacts);
    }

    /// One contact at most for each pair of rigid bodies that may touch.
    fn rigid_contacts(&mut self, scene: Scene<'_>, pairs: &mut [Pair], contacts: &mut Vec<Contact>) {
        let worthwhile = pairs.len() > WORTHWHILE;
        parallel::filter_map(pairs, worthwhile, &mut self.epa, contacts, |epa, pair| {
            let contact = if pair.may_touch { rigid_contact(scene, pair, epa) } else { None };
            pair.may_touch = contact.is_some();
            contact
        });
    }

    /// Contacts of a pair of which one body at least is deformable.
    fn pair_contacts(&mut self, scene: Scene<'_>, pair: &Pair, contacts: &mut Vec<Contact>) {
        let shape = |body: u32| &scene.bodies[body as usize].substance;
        match (shape(pair.a), shape(pair.b)) {
            (Substance::Deformable(a), Substance::Deformable(b)) => {
                self.deformable_contacts(scene, pair, [a, b], contacts);
            }
            (Substance::Deformable(a), Substance::Truss { truss: b }) => {
                self.mixed_contacts(scene, (pair.a, a), (pair.b, b), contacts);
            }
            (Substance::Truss { truss: a }, Substance::Deformable(b)) => {
                self.mixed_contacts(scene, (pair.b, b), (pair.a, a), contacts);
            }
            _ => {}
        }
    }

    /// Deformable against deformable: leaves whose spheres overlap (paper, Eq 11).
    fn deformable_contacts(
        &mut self,
        scene: Scene<'_>,
        pair: &Pair,
        [a, b]: [&Deformable; 2],
        contacts: &mut Vec<Contact>,
    ) {
        descend_pair(&a.tree, &b.tree, &mut self.stack, |leaf_a, leaf_b| {
            contacts.push(leaf_contact(scene, (pair.a, a, leaf_a), (pair.b, b, leaf_b)));
        });
    }

    fn self_contacts(
        &mut self,
        scene: Scene<'_>,
        body: u32,
        deformable: &Deformable,
        contacts: &mut Vec<Contact>,
    ) {
        let Some(neighbours) = &deformable.neighbours else { return };
        let excluded = |a: usize, b: usize| neighbours.contains(a, b);
        descend_self(&deformable.tree, &mut self.stack, excluded, |a, b| {
            contacts.push(leaf_contact(scene, (body, deformable, a), (body, deformable, b)));
        });
    }

    /// Deformable against rigid: both trees are descended to a leaf and a face; the leaf collides if its centre
    /// is inside the rigid body, or nearer to it than the deformable's thickness (the paper's rule is thickness
    /// 0, which lets edges and corners poke through between centres).
    fn mixed_contacts(
        &mut self,
        scene: Scene<'_>,
        (body_a, deformable): (u32, &Deformable),
        (body_b, truss): (u32, &Truss),
        contacts: &mut Vec<Contact>,
    ) {
        let positions = scene.positions(body_b);
        let Ok(pose) = truss.tree().pose(positions, &mut self.spheres[body_b as usize]) else { return };
        let Self { near, planes, .. } = self;
        near.clear();
        descend_pair(&deformable.tree, pose, &mut self.stack, |leaf, face| {
            near.push((leaf as u64) << 32 | face as u64);
        });
        near.sort_unstable();
        planes.clear();
        if truss.is_convex() && !near.is_empty() {
            let corners = |triangle: &[u32; 3]| triangle.map(|v| positions[v as usize]);
            planes.extend(truss.triangles().iter().map(|triangle| Plane::of(corners(triangle))));
        }
        let faces = truss.tree().topology().features();
        let solid = Solid { positions, triangles: truss.triangles(), planes };
        for group in near.chunk_by(|x, y| x >> 32 == y >> 32) {
            let leaf = (group[0] >> 32) as usize;
            let sphere = deformable.tree.leaf_spheres()[leaf];
            let thickness = deformable.thickness.min(sphere.radius);
            let candidates = group.iter().map(|&pair| faces[pair as u32 as usize].particles());
            let Some(hit) = nearest_surface(sphere.center, thickness, candidates, &solid) else { continue };
            let a = Patch::mean(scene.first(body_a), deformable.tree.topology().features()[leaf].particles());
            let b = Patch::feature(scene.first(body_b), &hit.point);
            let positions = &scene.particles.position;
            let normal = -hit.outward;
            contacts.push(Contact {
                body_a,
                body_b,
                a,
                b: Some(b),
                normal,
                offset: normal.dot(a.point(positions) - b.point(positions)) - (thickness - hit.distance),
                friction: scene.friction(body_a, body_b),
            });
        }
    }
}

/// From so many pairs on it pays to test them side by side.
const WORTHWHILE: usize = 256;

/// Rigid against rigid: the outermost spheres, then GJK and the hit face.
fn rigid_contact(scene: Scene<'_>, pair: &mut Pair, epa: &mut Epa) -> Option<Contact> {
    let bodies = [pair.a, pair.b];
    let [Substance::Truss { truss: truss_a }, Substance::Truss { truss: truss_b }] =
        bodies.map(|body| &scene.bodies[body as usize].substance)
    else {
        return None;
    };
    let [x_a, x_b] = bodies.map(|body| scene.positions(body));
    if !truss_a.tree().sphere(0, x_a).overlaps(&truss_b.tree().sphere(0, x_b)) {
        return None;
    }
    let hull_a = Points(&x_a[..truss_a.surface().vertex_count()]);
    let hull_b = Points(&x_b[..truss_b.surface().vertex_count()]);
    let found = distance::contact(&hull_a, &hull_b, &mut pair.axis, epa);
    let features = found.features.filter(|features| features.depth > 0.0)?;
    Some(Contact {
        body_a: pair.a,
        body_b: pair.b,
        a: Patch::feature(scene.first(pair.a), &features.a),
        b: Some(Patch::feature(scene.first(pair.b), &features.b)),
        normal: features.normal,
        offset: features.normal.dot(features.point_a - features.point_b) - features.depth,
        friction: scene.friction(pair.a, pair.b),
    })
}

/// A contact of two leaves, which are moved apart along the line through their centres until their spheres
/// touch. Coincident centres are moved apart along y.
fn leaf_contact(
    scene: Scene<'_>,
    (body_a, a, leaf_a): (u32, &Deformable, usize),
    (body_b, b, leaf_b): (u32, &Deformable, usize),
) -> Contact {
    let (sphere_a, sphere_b) = (a.tree.leaf_spheres()[leaf_a], b.tree.leaf_spheres()[leaf_b]);
    let between = sphere_b.center - sphere_a.center;
    let distance = between.norm();
    let normal = if distance > 0.0 { between / distance } else { Vec3::Y };
    let patch = |body: u32, deformable: &Deformable, leaf: usize| {
        Patch::mean(scene.first(body), deformable.tree.topology().features()[leaf].particles())
    };
    let (patch_a, patch_b) = (patch(body_a, a, leaf_a), patch(body_b, b, leaf_b));
    let positions = &scene.particles.position;
    let depth = sphere_a.radius + sphere_b.radius - distance;
    Contact {
        body_a,
        body_b,
        a: patch_a,
        b: Some(patch_b),
        normal,
        offset: normal.dot(patch_a.point(positions) - patch_b.point(positions)) - depth,
        friction: scene.friction(body_a, body_b),
    }
}

/// Every particle behind a plane is a contact: a vertex on a face of infinite mass.
fn half_space_contacts(scene: Scene<'_>, contacts: &mut Vec<Contact>) {
    let walls = || {
        scene.bodies.iter().enumerate().filter_map(|(index, body)| match &body.substance {
            Substance::HalfSpace(wall) => Some((index as u32, wall)),
            _ => None,
        })
    };
    for (index, body) in scene.bodies.iter().enumerate().filter(|(_, body)| body.is_relaxed(scene.cloth)) {
        let thickness = match &body.substance {
            Substance::Deformable(deformable) => deformable.thickness,
            _ => 0.0,
        };
        for (wall_index, wall) in walls() {
            let friction = scene.friction(index as u32, wall_index);
            wall_contacts(scene, (index as u32, thickness), (wall_index, wall), friction, contacts);
        }
    }
}

fn wall_contacts(
    scene: Scene<'_>,
    (body, thickness): (u32, f32),
    (wall_body, wall): (u32, &HalfSpace),
    friction: f32,
    contacts: &mut Vec<Contact>,
) {
    let offset = wall.offset + thickness;
    for (index, position) in scene.positions(body).iter().enumerate() {
        if wall.normal.dot(*position) < offset {
            contacts.push(Contact {
                body_a: body,
                body_b: wall_body,
                a: Patch::vertex(scene.first(body) + index),
                b: None,
                normal: -wall.normal,
                offset: -offset,
                friction,
            });
        }
    }
}
