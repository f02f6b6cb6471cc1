//! Picking: holding a body at a point of it and leading it about by a soft stick.

use std::f32::consts::TAU;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::World;
use crate::body::{Body, BodyKind, Motion};
use crate::error::{Error, coordinates, within};
use crate::settings::ClothSolver;
use crate::slots::{BodyHandle, Slots};

/// Names a grab of a world until it is released or its body removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct GrabHandle(u64);

/// How firmly something is held: a critically damped spring, which moves bodies alike whatever their mass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Grip {
    /// How fast it draws what it holds to the target, in Hz. Against gravity it gives by g/(2π f)².
    pub frequency: f32,
    /// The most that it pulls with: its force is at most the body's mass times this, in m/s².
    pub max_acceleration: f32,
}

impl Default for Grip {
    /// 8 Hz and 500 m/s².
    fn default() -> Self {
        Self { frequency: 8.0, max_acceleration: 500.0 }
    }
}

impl Grip {
    fn validate(&self) -> Result<(), Error> {
        within("grip.frequency", self.frequency, 1e-3, 1e4, "a frequency from 0.001 to 10000 (Hz)")?;
        let expected = "an acceleration from 1e-3 to 1e9 (m/s²)";
        within("grip.max_acceleration", self.max_acceleration, 1e-3, 1e9, expected)?;
        Ok(())
    }

    /// The change of a velocity (m/s) in a substep of `h` (s) by a spring that is `gap` (m) beyond its target, with
    /// damping ratio 1. It is the one implicit Euler's method takes, and so stable for any h and frequency:
    /// Δv = −(a₂ v + hω² gap)/(1 + a₂), a₂ = hω(2 + hω) (Catto 2011, "Soft constraints").
    fn velocity_change(&self, gap: Vec3, velocity: Vec3, h: f32) -> Vec3 {
        let h_omega = h * TAU * self.frequency;
        let a2 = h_omega * (2.0 + h_omega);
        -(velocity * a2 + gap * (h_omega * h_omega / h)) / (1.0 + a2)
    }
}

/// What is held in a world.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Grabs {
    /// In the order of their handles.
    held: Vec<Grab>,
    /// The handle of the next one.
    next: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Grab {
    handle: GrabHandle,
    body: BodyHandle,
    place: Place,
    /// Where it was drawn to at the end of the last step, and where it is to be at the end of the next, in m: in
    /// between it goes straight, so that it moves evenly and not by jerks.
    before: Vec3,
    target: Vec3,
    grip: Grip,
}

/// Where a body is held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Place {
    /// At a point in its principal frame, in m.
    Point(Vec3),
    /// At one of its particles.
    Particle(u32),
}

impl Grabs {
    fn index(&self, handle: GrabHandle) -> Result<usize, Error> {
        self.held.binary_search_by_key(&handle, |grab| grab.handle).map_err(|_| Error::StaleHandle)
    }

    /// Lets go of a body that is removed.
    pub(crate) fn remove_body(&mut self, body: BodyHandle) {
        self.held.retain(|grab| grab.body != body);
    }

    /// Checks grabs from untrusted bytes.
    pub(crate) fn is_valid(&self, slots: &Slots, bodies: &[Body]) -> bool {
        let is_sound = |grab: &Grab| {
            let body = slots.index(grab.body).ok().and_then(|index| bodies.get(index));
            let is_there = body.is_some_and(|body| match grab.place {
                Place::Point(point) => body.is_rigid() && point.is_finite(),
                Place::Particle(particle) => !body.is_rigid() && (particle as usize) < body.particles.len(),
            });
            is_there
                && grab.before.is_finite()
                && grab.target.is_finite()
                && grab.grip.validate().is_ok()
                && grab.handle.0 < self.next
        };
        self.held.iter().all(is_sound) && self.held.is_sorted_by(|a, b| a.handle < b.handle)
    }
}

impl World {
    /// Takes hold of a body at `point` (m): a rigid body at that very point of it, any other at its nearest particle
    /// that is not pinned. It is held where it is now; [`World::move_grab`] says where it is to go.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use tautline::{Grip, RigidBody, Settings, Shape, Vec3, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let ball = world.add(RigidBody::new(&Arc::new(Shape::sphere(0.1)?)))?;
    /// let grab = world.grab(ball, Vec3::ZERO, Grip::default())?;
    /// world.move_grab(grab, Vec3::X)?;
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// assert!(world.body(ball)?.center_of_mass().distance(Vec3::X) < 0.01);
    /// world.release(grab)?;
    /// # Ok::<(), tautline::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::StaleHandle`]; [`Error::OutOfRange`] if a coordinate or a field of the grip is; [`Error::Invalid`] if
    /// nothing of the body can be moved by a force.
    pub fn grab(&mut self, body: BodyHandle, point: Vec3, grip: Grip) -> Result<GrabHandle, Error> {
        let index = self.slots.index(body)?;
        coordinates("point", point)?;
        grip.validate()?;
        let Some((place, target)) = self.place_near(index, point) else {
            let problem = "nothing of it can be moved by a force".into();
            return Err(Error::Invalid { field: "body".into(), problem });
        };
        let handle = GrabHandle(self.grabs.next);
        self.grabs.next += 1;
        self.grabs.held.push(Grab { handle, body, place, before: target, target, grip });
        self.wake_body(index);
        Ok(handle)
    }

    /// Where what is held is drawn to from now on, in m.
    ///
    /// # Errors
    /// [`Error::StaleHandle`] if it has been released or its body removed; [`Error::OutOfRange`] if a coordinate is.
    pub fn move_grab(&mut self, handle: GrabHandle, target: Vec3) -> Result<(), Error> {
        let grab = self.grabs.index(handle)?;
        coordinates("target", target)?;
        self.grabs.held[grab].target = target;
        let index = self.slots.index(self.grabs.held[grab].body)?;
        self.wake_body(index);
        Ok(())
    }

    /// Lets go. The body flies on as it moves.
    ///
    /// # Errors
    /// [`Error::StaleHandle`] if it has been released before or its body removed.
    pub fn release(&mut self, handle: GrabHandle) -> Result<(), Error> {
        let grab = self.grabs.index(handle)?;
        let index = self.slots.index(self.grabs.held.remove(grab).body)?;
        self.wake_body(index);
        Ok(())
    }

    /// What is held, and by which grab, in the order in which it was taken hold of.
    pub fn grabs(&self) -> impl ExactSizeIterator<Item = (GrabHandle, BodyHandle)> + '_ {
        self.grabs.held.iter().map(|grab| (grab.handle, grab.body))
    }

    /// Both ends of the soft stick, in m: where the body is held, and where it is drawn to. To draw it.
    ///
    /// # Errors
    /// [`Error::StaleHandle`] if it has been released or its body removed.
    pub fn grab_ends(&self, handle: GrabHandle) -> Result<[Vec3; 2], Error> {
        let grab = &self.grabs.held[self.grabs.index(handle)?];
        let index = self.slots.index(grab.body)?;
        let held = match grab.place {
            Place::Point(point) => {
                let frame = self.rigid_frame(index);
                frame.center + frame.axes * point
            }
            Place::Particle(particle) => {
                self.particles.position[self.bodies[index].particles.start + particle as usize]
            }
        };
        Ok([held, grab.target])
    }

    /// Where a body is to be held near `point`, and where that is now.
    fn place_near(&self, index: usize, point: Vec3) -> Option<(Place, Vec3)> {
        let body = &self.bodies[index];
        match (body.kind(), body.rigid()) {
            (BodyKind::Rigid, Some(rigid)) => {
                let frame = self.rigid_frame(index);
                let local = frame.axes.transpose() * (point - frame.center);
                (rigid.traits.motion == Motion::Dynamic).then_some((Place::Point(local), point))
            }
            _ => {
                let free = body.particles.clone().filter(|&i| self.particles.inverse_mass[i] > 0.0);
                let far = |i: usize| self.particles.position[i].distance_squared(point);
                let nearest = free.min_by(|&i, &j| far(i).total_cmp(&far(j)))?;
                let particle = (nearest - body.particles.start) as u32;
                Some((Place::Particle(particle), self.particles.position[nearest]))
            }
        }
    }

    /// For a step, lets particles that are held weigh as much as their bodies: the spring moves one particle, and has
    /// to move them all. Returns the particles and their own inverse masses.
    pub(crate) fn lend_weight(&mut self) -> Vec<(usize, f32)> {
        let mut lent = Vec::new();
        for grab in &self.grabs.held {
            let (Place::Particle(particle), Ok(index)) = (grab.place, self.slots.index(grab.body)) else {
                continue;
            };
            let range = self.bodies[index].particles.clone();
            let (i, total) =
                (range.start + particle as usize, self.particles.mass[range].iter().sum::<f32>());
            if self.particles.inverse_mass[i] > 0.0 {
                lent.push((i, self.particles.inverse_mass[i]));
                self.particles.inverse_mass[i] = 1.0 / total;
            }
        }
        lent
    }

    /// Ends a step: targets are reached. Undoes [`World::lend_weight`], but for bodies that have been frozen since.
    pub(crate) fn rest_grabs(&mut self, lent: &[(usize, f32)]) {
        self.grabs.held.iter_mut().for_each(|grab| grab.before = grab.target);
        // In reverse, since one may be held twice.
        for &(i, inverse_mass) in lent.iter().rev() {
            if self.particles.inverse_mass[i] > 0.0 {
                self.particles.inverse_mass[i] = inverse_mass;
            }
        }
    }

    /// Draws everything that is held to its target, before a substep of `h` (s), after which the share `done` of the
    /// step is over.
    pub(crate) fn pull_grabs(&mut self, h: f32, done: f32) {
        for grab in &self.grabs.held {
            let Ok(index) = self.slots.index(grab.body) else { continue };
            let body = &self.bodies[index];
            // What gravity is about to do counts as done.
            let scale = body.rigid().map_or(1.0, |rigid| rigid.traits.gravity_scale);
            let fall = self.settings.gravity * (scale * h);
            let target = grab.before + (grab.target - grab.before) * done;
            let limit = grab.grip.max_acceleration * h;
            match grab.place {
                Place::Point(point) => self.rigid.pull(index, point, limit * h, |at| {
                    let velocity = at.displacement / h + fall;
                    grab.grip.velocity_change(at.position - target, velocity, h) * h
                }),
                Place::Particle(particle)
                    if body.is_soft() && self.settings.cloth == ClothSolver::SmallSteps =>
                {
                    if let Some((position, velocity)) = self.soft.particle(index, particle as usize, h) {
                        let change = grab.grip.velocity_change(position - target, velocity + fall, h);
                        self.soft.push(index, particle as usize, change.clamp_length_max(limit), h);
                    }
                }
                Place::Particle(particle) if body.is_awake() => {
                    let (i, time) = (body.particles.start + particle as usize, body.displacement_time());
                    if self.particles.inverse_mass[i] > 0.0 {
                        let velocity = self.particles.velocity(i, time) + fall;
                        let gap = self.particles.position[i] - target;
                        let change = grab.grip.velocity_change(gap, velocity, h).clamp_length_max(limit);
                        self.particles.displacement[i] += change * time;
                    }
                }
                Place::Particle(_) => {}
            }
        }
    }
}
