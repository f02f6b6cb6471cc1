//! Joints, attachments and grabs.

use tautline::{
    Anchor, Attachment, BallJoint, BodyHandle, DistanceJoint, FixedJoint, HingeJoint, JointDescription,
    Motor, SliderJoint, Vec3,
};

use super::{Calls, choose};

impl Calls<'_> {
    fn joined(&mut self) -> Option<(BodyHandle, Option<BodyHandle>)> {
        let (body, base) = (self.body(), self.body());
        let body = body?;
        Some((body, if self.input.flag() { None } else { base }))
    }

    pub(super) fn join(&mut self) {
        let Some((body, base)) = self.joined() else { return };
        let input = &mut self.input;
        let (anchor, kind) = (input.vector(), input.byte() % 5);
        let (number, axis) = (input.number(), input.vector());
        let joint: JointDescription = match kind {
            0 => BallJoint::new(body, base).anchor(anchor).cone(number).into(),
            1 => HingeJoint::new(body, base).anchor(anchor).axis(axis).into(),
            2 => SliderJoint::new(body, base).anchor(anchor).axis(axis).into(),
            3 => FixedJoint::new(body, base).anchor(anchor).compliance(number).into(),
            _ => DistanceJoint::new(body, base).anchor(anchor).length(number).into(),
        };
        self.add_joint(joint);
    }

    /// With everything that can be said of a joint.
    fn join_closely(&mut self) {
        let Some((body, base)) = self.joined() else { return };
        let input = &mut self.input;
        let (kind, axis, [low, high]) = (input.byte() % 5, input.vector(), input.numbers());
        let [on_body, on_base] = input.vectors();
        let joint: JointDescription = match kind {
            0 => {
                BallJoint::new(body, base).local_anchors(on_body, on_base).axis(axis).twist(low, high).into()
            }
            1 => HingeJoint::new(body, base).anchors(on_body, on_base).axis(axis).limits(low, high).into(),
            2 => {
                let slider = SliderJoint::new(body, base).anchors(on_body, on_base).axis(axis);
                slider.motor(low, high).break_force(input.number()).collide_connected().into()
            }
            3 => {
                let fixed = FixedJoint::new(body, base).anchors(on_body, on_base);
                fixed.angular_compliance(low).break_torque(high).into()
            }
            _ => {
                let distance = DistanceJoint::new(body, base).anchors(on_body, on_base).range(low, high);
                distance.spring(input.number(), input.number()).into()
            }
        };
        self.add_joint(joint);
    }

    fn add_joint(&mut self, joint: JointDescription) {
        let added = self.attempt(|world| world.add_joint(joint));
        self.joints.extend(added);
    }

    pub(super) fn attach(&mut self) {
        let (Some(a), Some(b)) = (self.body(), self.body()) else { return };
        let (particle, point) = (self.input.index(), self.input.vector());
        let other = match self.input.byte() % 3 {
            0 => Anchor::world(point),
            1 => Anchor::point(b, point),
            _ => Anchor::particle(b, particle / 2),
        };
        self.add_attachment(Anchor::particle(a, particle), other);
    }

    /// To the middle of triangles and segments.
    fn attach_between(&mut self) {
        let (Some(a), Some(b)) = (self.body(), self.body()) else { return };
        let input = &mut self.input;
        let triangle = Anchor::triangle(a, input.index(), input.numbers());
        let segment = |body, index, fraction| Anchor::segment(body, index, fraction);
        let (first, other) = match input.byte() % 3 {
            0 => (triangle, segment(b, input.index(), input.number())),
            1 => (triangle, Anchor::triangle(b, input.index(), [0.2, 0.3, 0.5])),
            _ => (segment(a, input.index(), input.number()), Anchor::point(b, Vec3::ZERO)),
        };
        self.add_attachment(first, other);
    }

    fn add_attachment(&mut self, a: Anchor, b: Anchor) {
        let strength = Attachment::default().compliance(self.input.number()).break_force(self.input.number());
        let added = self.attempt(|world| world.attach(a, b, strength));
        self.attachments.extend(added);
    }

    pub(super) fn change_tie(&mut self) {
        let (what, which) = (self.input.byte() % 9, self.input.byte());
        let joint = choose(&self.joints, which);
        let attachment = choose(&self.attachments, which);
        let grab = choose(&self.grabs, which);
        match (what, joint, attachment, grab) {
            (0 | 1, ..) => self.join_closely(),
            (2, ..) => self.attach_between(),
            (3, Some(joint), ..) => {
                self.attempt(|world| world.remove_joint(joint));
            }
            (4, Some(joint), ..) => {
                let motor = Motor { speed: self.input.number(), strength: self.input.number() };
                let motor = self.input.flag().then_some(motor);
                self.attempt(|world| world.set_motor(joint, motor));
            }
            (5, Some(joint), ..) => {
                let limits = self.input.numbers();
                let limits = self.input.flag().then_some(limits);
                self.attempt(|world| world.set_limits(joint, limits));
            }
            (6, _, Some(attachment), _) => {
                self.attempt(|world| world.detach(attachment));
            }
            (7, .., Some(grab)) => {
                let target = self.input.vector();
                self.attempt(|world| world.move_grab(grab, target));
            }
            (8, .., Some(grab)) => {
                self.attempt(|world| world.release(grab));
            }
            _ => {}
        }
    }
}
