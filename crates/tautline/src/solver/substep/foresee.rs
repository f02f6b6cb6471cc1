//! Where two parts will touch that fly towards each other from afar.
//!
//! A contact found long before it is made has the normal of the features that are nearest then, and a plane with that
//! normal also stops what would pass. So parts that are far apart and move by more than their size are moved to where
//! they first touch, if they do, and their contact is that of there.

use glam::{DMat3, DQuat, DVec3, Mat3, Vec3};

use super::detect::{Placed, Scene};
use super::lineup::NOBODY;
use super::pairs::Pair;
use crate::geometry::manifold::{Manifold, Placement};
use crate::geometry::query::{Motion, Rounded, first_touch};
use crate::norm::Norm;

/// Parts nearer than this touch, in m.
const APART: f32 = 2e-4;

impl Scene<'_> {
    /// Whether a contact is between bodies that have far to go before they touch, for their size.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn is_far_off(&self, manifold: &Manifold, approach: Vec3, pair: &Pair) -> bool {
        if !self.has_fast {
            return false;
        }
        let mut is_apart = manifold.count > 0;
        for point in &manifold.points[..manifold.count] {
            is_apart &= point.separation > APART;
        }
        is_apart && self.is_fast(approach, pair)
    }

    /// Whether two bodies approach each other by more than the inner radius of either; what has no inside has none.
    #[inline(never)]
    fn is_fast(&self, approach: Vec3, pair: &Pair) -> bool {
        let place = |body: u32| self.place_of[body as usize] as usize;
        let is_held =
            |body: u32| self.assembly_of.get(place(body)).is_some_and(|&assembly| assembly != NOBODY);
        if is_held(pair.a) || is_held(pair.b) {
            // It goes where what holds it lets it.
            return false;
        }
        let solid = [pair.a, pair.b].into_iter().filter_map(|body| self.shape(body));
        let solid = solid.filter(|shape| shape.is_solid());
        approach.norm() > solid.map(|shape| shape.inner_radius()).fold(f32::INFINITY, f32::min)
    }

    /// Where b is in the frame of a when they first touch in this step, if nothing turns them from their ways.
    #[inline(never)]
    pub(super) fn at_first_touch(
        &self,
        bodies: [u32; 2],
        [a, b]: [&Placed; 2],
        shapes: [Rounded<'_>; 2],
    ) -> Option<Placement> {
        let a = self.way(bodies[0], a, shapes[0]);
        let b = self.way(bodies[1], b, shapes[1]);
        if !(is_finite(&a) && is_finite(&b)) {
            return None;
        }
        let time = first_touch(&a, &b, 0.0)?.time;
        let turned = |way: &Motion| DQuat::from_scaled_axis(way.angular * time) * way.rotation;
        let to_a = turned(&a).inverse();
        let between = b.position + b.linear * time - (a.position + a.linear * time);
        Some(Placement {
            rotation: Mat3::from_quat((to_a * turned(&b)).as_quat()),
            translation: (to_a * between).as_vec3(),
        })
    }

    fn way<'a>(&self, body: u32, placed: &Placed, shape: Rounded<'a>) -> Motion<'a> {
        let axes = placed.axes;
        // A ball touches as one that does not turn: a contact in a frame that turns until then would stand aslant.
        let is_ball = shape.corners.len() == 1;
        let columns = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.as_dvec3());
        Motion {
            shape,
            position: placed.center.as_dvec3(),
            rotation: DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2])).normalize(),
            linear: (placed.motion + self.fall(body)).as_dvec3(),
            angular: if is_ball { DVec3::ZERO } else { self.turn(body, axes).as_dvec3() },
        }
    }

    /// How far gravity lets a body fall in the step, in m.
    fn fall(&self, body: u32) -> Vec3 {
        let place = self.place_of[body as usize] as usize;
        let is_free = self.poses[2 * place].0[3] > 0.0;
        let scale = self.bodies[body as usize].rigid().map_or(0.0, |rigid| rigid.traits.gravity_scale);
        if is_free { self.fall * scale } else { Vec3::ZERO }
    }

    /// How a body turns in the step, axis times angle, in the world.
    fn turn(&self, body: u32, axes: Mat3) -> Vec3 {
        let place = self.place_of[body as usize] as usize;
        let (pose, row) = (&self.poses[2 * place].0, &self.velocities[place].0);
        let local = Vec3::new(row[4] * pose[4], row[5] * pose[5], row[6] * pose[6]);
        axes * local * self.substeps
    }
}

fn is_finite(way: &Motion) -> bool {
    let vectors: [DVec3; 3] = [way.position, way.linear, way.angular];
    vectors.iter().all(|vector| vector.is_finite()) && way.rotation.is_finite()
}
