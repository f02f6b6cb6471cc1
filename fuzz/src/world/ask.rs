//! Questions: they change nothing, as their types say.

use tautline::{Quat, QueryFilter};

use super::{Calls, make, shapes};

impl Calls<'_> {
    pub(super) fn ask(&mut self) {
        let (from, to, max) = (self.input.vector(), self.input.vector(), self.input.number());
        let filter = QueryFilter::default();
        let _ = match self.input.byte() % 3 {
            0 => self.world.ray_cast(from, to, max, filter).map(|_| ()),
            1 => self.world.closest_point(from, max, filter).map(|_| ()),
            _ => shapes::shape(0, &[max])
                .and_then(|ball| self.world.shape_cast(&ball, from, Quat::IDENTITY, to, filter).map(|_| ())),
        };
    }

    pub(super) fn look(&mut self) {
        match self.input.byte() % 6 {
            0 => self.ask_of_some(),
            1 => self.overlap(),
            2 => self.look_at_bodies(),
            3 => self.look_at_ties(),
            4 => self.measure(),
            _ => {
                if let (Some(a), Some(b)) = (self.body(), self.body()) {
                    // A refusal is an answer too.
                    let _ = self.world.trace_gjk(a, b).map(|trace| (trace.points(), trace.distance()));
                }
            }
        }
    }

    fn ask_of_some(&mut self) {
        let (groups, exclude) = (make::groups(&mut self.input), self.body());
        let filter = QueryFilter { groups, exclude, fixed: self.input.flag(), movable: self.input.flag() };
        let ([from, to], max) = (self.input.vectors(), self.input.number());
        let _ = self.world.ray_cast_all(from, to, max, filter);
        let _ = self.world.closest_point(from, max, filter);
    }

    fn overlap(&mut self) {
        let (kind, numbers) = (self.input.byte() % 10, self.input.numbers::<7>());
        let (position, rotation, way) = (self.input.vector(), self.input.rotation(), self.input.vector());
        if let Ok(shape) = shapes::shape(kind, &numbers) {
            let _ = self.world.overlap(&shape, position, rotation, QueryFilter::default());
            let _ = self.world.shape_cast(&shape, position, rotation, way, QueryFilter::default());
        }
    }

    fn look_at_bodies(&mut self) {
        let [point] = self.input.vectors();
        for body in &self.bodies {
            let _ = self.world.rope_length(*body);
            let _ = self.world.stick_colors(*body);
            let Ok(view) = self.world.body(*body) else { continue };
            let _ = (view.kind(), view.volume(), view.pressure(), view.surface_positions(), view.triangles());
            let _ = (view.sticks(), view.tetrahedra(), view.plane(), view.pose(), view.velocity_at(point));
            let _ = (view.angular_velocity(), view.principal_moments(), view.inertia(), view.velocity());
            let _ = (view.center_of_mass(), view.mass(), view.is_asleep(), view.spheres(), view.bounds());
            let _ = (view.particle_velocity(0), view.shape(), view.truss(), view.surface(), view.motion());
            let _ = (view.gravity_scale(), view.damping(), view.groups(), view.friction(), view.is_fixed());
        }
    }

    fn look_at_ties(&mut self) {
        let world = &self.world;
        assert!(world.joints().all(|joint| self.joints.contains(&joint)));
        assert!(world.attachments().all(|attachment| self.attachments.contains(&attachment)));
        for joint in &self.joints {
            let Ok(view) = world.joint(*joint) else { continue };
            let _ = (view.anchors(), view.axes(), view.angle(), view.translation(), view.swing_and_twist());
            let _ = (view.kind(), view.base(), view.force(), view.torque(), view.is_broken());
        }
        for attachment in &self.attachments {
            let Ok(view) = world.attachment(*attachment) else { continue };
            let _ = (view.bodies(), view.ends(), view.force(), view.is_broken());
        }
        for (grab, _) in world.grabs() {
            assert!(world.grab_ends(grab).is_ok());
        }
    }

    fn measure(&mut self) {
        let world = &self.world;
        let _ = (world.kinetic_energy(), world.potential_energy(), world.momentum());
        let _ = (world.angular_momentum(), world.strain(), world.penetration(), world.contact_points());
        let _ = (world.contact_events(), world.joint_events(), world.contact_colors(), world.time());
    }
}
