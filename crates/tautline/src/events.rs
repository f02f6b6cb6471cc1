//! Contact events: which bodies have come to touch, still do and have parted, for those that report it.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::body::{Body, Motion};
use crate::error::Error;
use crate::slots::{BodyHandle, Slots};
use crate::solver::substep::Press;
use crate::world::World;

/// How the contact of two bodies goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactEventKind {
    /// They did not touch in the step before.
    Began,
    /// They did.
    Persists,
    /// They touched in the step before and do not any more, or one of them has been removed or fixed.
    Ended,
}

/// How two bodies touched in the last step.
///
/// Bodies begin to touch when they press on each other, and do until they neither press nor are within a tenth of a
/// millimetre. Bodies of many parts have one contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactEvent {
    /// Whether they touch for the first time, still or no longer.
    pub kind: ContactEventKind,
    /// The bodies, A and B: the one that was added first comes first. The handle of a removed one is stale.
    pub bodies: [BodyHandle; 2],
    /// Unit, from A to B: the mean over all that was pressed. Where nothing was, as it was last.
    pub normal: Vec3,
    /// Where they pressed, in m: the mean over all places and substeps. Where they did not, as it was last.
    pub point: Vec3,
    /// The sum of all normal impulses of the step, in N s; 0 where they only still touch, or have parted.
    pub impulse: f32,
    /// How fast they came together along the normal, in m/s, just before they pressed; 0 unless they began to touch.
    pub approach_speed: f32,
}

/// Two bodies that touch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Touching {
    /// Their indices, ascending.
    bodies: [u32; 2],
    normal: Vec3,
    point: Vec3,
}

/// Two bodies that touched when one was removed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Parted {
    bodies: [BodyHandle; 2],
    normal: Vec3,
    point: Vec3,
}

/// Which bodies touch, out of those that report it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Contacts {
    /// Ascending by their bodies.
    touching: Vec<Touching>,
    /// Since the last step.
    parted: Vec<Parted>,
    #[serde(skip)]
    events: Vec<ContactEvent>,
}

impl Contacts {
    /// Ends the contacts of a body that is to be removed; the bodies behind it move down.
    pub(crate) fn remove_body(&mut self, body: usize, slots: &Slots) {
        let removed = body as u32;
        let (ending, mut going_on): (Vec<Touching>, _) =
            self.touching.iter().partition(|touching| touching.bodies.contains(&removed));
        self.parted.extend(ending.iter().map(|&Touching { bodies, normal, point }| Parted {
            bodies: bodies.map(|index| slots.handle(index as usize)),
            normal,
            point,
        }));
        for Touching { bodies, .. } in &mut going_on {
            *bodies = bodies.map(|index| index - u32::from(index > removed));
        }
        self.touching = going_on;
    }

    /// Checks contacts from untrusted bytes.
    pub(crate) fn is_valid(&self, body_count: usize) -> bool {
        let is_sound = |touching: &Touching| {
            let [a, b] = touching.bodies;
            a < b && (b as usize) < body_count && touching.normal.is_finite() && touching.point.is_finite()
        };
        self.touching.iter().all(is_sound)
            && self.touching.is_sorted_by(|one, other| one.bodies < other.bodies)
            && self.parted.iter().all(|parted| parted.normal.is_finite() && parted.point.is_finite())
    }

    /// Makes the events of a step from who pressed on whom in it, ascending by their bodies.
    pub(crate) fn finish(&mut self, presses: &[Press], bodies: &[Body], slots: &Slots) {
        self.events.clear();
        if presses.is_empty() && self.touching.is_empty() && self.parted.is_empty() {
            return;
        }
        self.events.extend(self.parted.drain(..).map(|Parted { bodies, normal, point }| ContactEvent {
            kind: ContactEventKind::Ended,
            bodies,
            normal,
            point,
            impulse: 0.0,
            approach_speed: 0.0,
        }));
        let mut before = std::mem::take(&mut self.touching).into_iter().peekable();
        for press in presses {
            while let Some(old) = before.next_if(|old| old.bodies < press.bodies) {
                self.carry_on(old, bodies, slots);
            }
            let old = before.next_if(|old| old.bodies == press.bodies);
            self.touch(old, press, slots);
        }
        before.for_each(|old| self.carry_on(old, bodies, slots));
    }

    /// Two bodies that were near each other.
    fn touch(&mut self, old: Option<Touching>, press: &Press, slots: &Slots) {
        let Press { bodies, impulse, normal, point, approach_speed, is_near } = *press;
        let now = if impulse > 0.0 { Some(Touching { bodies, normal, point }) } else { old };
        let Some(now) = now else { return };
        let (kind, approach_speed) = match old {
            None => (ContactEventKind::Began, approach_speed),
            Some(_) if impulse > 0.0 || is_near => (ContactEventKind::Persists, 0.0),
            Some(_) => (ContactEventKind::Ended, 0.0),
        };
        if kind != ContactEventKind::Ended {
            self.touching.push(now);
        }
        self.push(kind, &now, [impulse, approach_speed], slots);
    }

    /// Two bodies that touched and that nothing was found out about in this step.
    fn carry_on(&mut self, old: Touching, bodies: &[Body], slots: &Slots) {
        let pair = old.bodies.map(|index| &bodies[index as usize]);
        let may_move = |body: &Body| body.is_awake() && is_dynamic(body);
        if !pair.into_iter().any(may_move) && pair.into_iter().any(|body| body.rest.asleep) {
            self.touching.push(old);
        } else if pair.into_iter().any(Body::reports_contacts) {
            self.push(ContactEventKind::Ended, &old, [0.0; 2], slots);
        }
    }

    fn push(
        &mut self,
        kind: ContactEventKind,
        touching: &Touching,
        [impulse, approach_speed]: [f32; 2],
        slots: &Slots,
    ) {
        let &Touching { bodies, normal, point } = touching;
        let bodies = bodies.map(|index| slots.handle(index as usize));
        self.events.push(ContactEvent { kind, bodies, normal, point, impulse, approach_speed });
    }
}

fn is_dynamic(body: &Body) -> bool {
    body.rigid().is_some_and(|rigid| rigid.traits.motion == Motion::Dynamic)
}

impl World {
    /// Which bodies came to touch, still touched and parted in the last step, out of the pairs of which one reports
    /// its contacts ([`RigidBody::report_contacts`](crate::RigidBody::report_contacts)). First come those parted by
    /// [`World::remove`], then all others in the order of their bodies; the same on any number of threads.
    ///
    /// Only contacts of rigid bodies with each other and with half-spaces are reported, not those of trusses, cloth
    /// and rope. Bodies that fall asleep while they touch go on touching without being reported until one wakes.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use tautline::{ContactEventKind, HalfSpace, RigidBody, Settings, Shape, Vec3, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let floor = world.add(HalfSpace::floor(0.0))?;
    /// let ball = Arc::new(Shape::sphere(0.1)?);
    /// let ball = world.add(RigidBody::new(&ball).mass(2.0).position(Vec3::Y).report_contacts())?;
    /// let mut sounds = Vec::new();
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    ///     for event in world.contact_events().iter().filter(|event| event.kind == ContactEventKind::Began) {
    ///         assert_eq!(event.bodies, [floor, ball]);
    ///         sounds.push((event.point, event.approach_speed));
    ///     }
    /// }
    /// assert_eq!(sounds.len(), 1);
    /// let (place, speed) = sounds[0];
    /// assert!(place.length() < 1e-3 && (speed - (2.0_f32 * 9.81 * 0.9).sqrt()).abs() < 0.05);
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn contact_events(&self) -> &[ContactEvent] {
        &self.contacts.events
    }

    /// Whether a rigid body reports its contacts from the next step on. What it touches then begins to touch; what
    /// stops being reported does not end.
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::Invalid`] if the body is not rigid.
    pub fn set_report_contacts(&mut self, handle: BodyHandle, report_contacts: bool) -> Result<(), Error> {
        self.change_traits(handle, |traits| traits.reports_contacts = report_contacts).map(|_| ())
    }
}
