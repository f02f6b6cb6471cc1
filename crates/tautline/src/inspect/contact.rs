//! Contacts as the last step left them.

use glam::{Mat3, Vec3};

use crate::body::Frame;
use crate::collision::Patch;
use crate::world::{BodyHandle, World};

/// A place where two bodies touch.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactPoint {
    /// The two bodies.
    pub bodies: [BodyHandle; 2],
    /// On the surface of either, in m.
    pub points: [Vec3; 2],
    /// Unit, from the first to the second.
    pub normal: Vec3,
    /// How deep the first is in the second there, in m; below 0 they are apart.
    pub depth: f32,
    /// Along the normal in the last substep, in N s; 0 where particles are moved apart instead.
    pub impulse: f32,
    /// What of either body touches, where particles are moved apart: for a half-space nothing.
    pub features: [Option<FeatureOfBody>; 2],
}

/// A vertex, edge or face of a body, or a part of a sheet, with a point of it.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureOfBody {
    /// Its particles where they are now, in m.
    pub positions: Vec<Vec3>,
    /// Their shares in the point, 1 together.
    pub weights: Vec<f32>,
}

impl World {
    /// Where bodies touch: of rigid bodies of four particles all points of their contacts; of trusses, and of cloth and
    /// rope that the paper's solver moves, what was separated in the last substep. Contacts of cloth and rope in small
    /// steps are not among them.
    pub fn contact_points(&self) -> Vec<ContactPoint> {
        self.rigid_points().chain(self.particle_points()).collect()
    }

    fn rigid_points(&self) -> impl Iterator<Item = ContactPoint> + '_ {
        let frame = |body: u32| {
            let body = self.bodies.get(body as usize)?;
            let is_wall = !body.is_rigid();
            // Half-spaces are at rest in the world's frame.
            let positions = &self.particles.position[body.particles.clone()];
            let at_rest = Frame { center: Vec3::ZERO, axes: Mat3::IDENTITY };
            Some(if is_wall { at_rest } else { Frame::of_particles(positions) })
        };
        self.rigid.contact_points().filter_map(move |touch| {
            let frames = [frame(touch.bodies[0])?, frame(touch.bodies[1])?];
            let points = [0, 1].map(|side| frames[side].center + frames[side].axes * touch.anchors[side]);
            let h = touch.bodies.map(|body| self.bodies[body as usize].displacement_time());
            Some(ContactPoint {
                bodies: touch.bodies.map(|body| self.slots.handle(body as usize)),
                points,
                normal: touch.normal,
                depth: (points[0] - points[1]).dot(touch.normal),
                impulse: touch.multiplier / h[0].min(h[1]),
                features: [None, None],
            })
        })
    }

    fn particle_points(&self) -> impl Iterator<Item = ContactPoint> + '_ {
        let feature = |patch: &Patch| {
            let used = (0..4).filter(|&k| k == 0 || patch.weights[k] > 0.0);
            let place = |k: usize| self.particles.position.get(patch.particles[k] as usize).copied();
            let (positions, weights) = used.filter_map(|k| Some((place(k)?, patch.weights[k]))).unzip();
            FeatureOfBody { positions, weights }
        };
        let count = self.bodies.len() as u32;
        let known = self.scratch.contacts.iter().filter(move |c| c.body_a < count && c.body_b < count);
        known.map(move |contact| {
            let (a, b) = (feature(&contact.a), contact.b.as_ref().map(feature));
            let on_a = a.point();
            let gap = contact.normal.dot(on_a) - contact.offset;
            let on_b = b.as_ref().map_or_else(|| on_a - contact.normal * gap, FeatureOfBody::point);
            ContactPoint {
                bodies: [contact.body_a, contact.body_b].map(|body| self.slots.handle(body as usize)),
                points: [on_a, on_b],
                normal: contact.normal,
                depth: (on_a - on_b).dot(contact.normal),
                impulse: 0.0,
                features: [Some(a), b],
            }
        })
    }
}

impl FeatureOfBody {
    fn point(&self) -> Vec3 {
        self.positions.iter().zip(&self.weights).map(|(&position, &weight)| position * weight).sum()
    }
}
