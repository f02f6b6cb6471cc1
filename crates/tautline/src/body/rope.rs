//! Rope: a polyline of particles with sticks along it (paper, 4).

use glam::Vec3;

use super::deformable::{BuiltDeformable, Deformable, Parts};
use super::fabric::{Fabric, Stretch};
use crate::constraint::{Angle, AngleLimit, Stick, angle_gradient};
use crate::error::{Error, all_coordinates, coordinates, positive, within};
use crate::geometry::sphere_tree::Feature;
use crate::norm::Norm;
use crate::order::PutInOrder;

/// A rope to be added to a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Rope {
    points: Vec<Vec3>,
    /// Between which points.
    segments: Vec<[u32; 2]>,
    length: Option<f32>,
    velocity: Vec3,
    mass: f32,
    radius: f32,
    friction: f32,
    self_collision: bool,
    bending_compliance: Option<f32>,
    bending_stiffness: Option<f32>,
    compliance: Option<f32>,
    least_angle: Option<f32>,
    pins: Vec<u32>,
}

impl Rope {
    /// A rope through these points, in m, with a particle at each. 1 kg, radius 2 cm, friction 0.5, without
    /// bending, passing through itself.
    pub fn through(points: Vec<Vec3>) -> Self {
        let segments = (1..points.len() as u32).map(|end| [end - 1, end]).collect();
        Self::network(points, segments)
    }

    /// A net, or any rope with branches: particles at these points, in m, and segments between them, by the numbers of
    /// their ends. Otherwise as [`Rope::through`]. What it says of a rope's inner particles holds at every point of a
    /// net, for each two segments that meet there.
    ///
    /// ```
    /// use tautline::{Rope, Settings, Vec3, World};
    ///
    /// let points = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.5, 0.0, 0.8), Vec3::new(1.5, 0.0, -0.8)];
    /// let fork = Rope::network(points, vec![[0, 1], [1, 2], [1, 3]]).pin(0);
    /// let mut world = World::new(Settings::default())?;
    /// let fork = world.add(fork)?;
    /// assert_eq!(world.body(fork)?.sticks().len(), 3);
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn network(points: Vec<Vec3>, segments: Vec<[u32; 2]>) -> Self {
        Self {
            points,
            segments,
            length: None,
            velocity: Vec3::ZERO,
            mass: 1.0,
            radius: 0.02,
            friction: 0.5,
            self_collision: false,
            bending_compliance: None,
            bending_stiffness: None,
            compliance: None,
            least_angle: None,
            pins: Vec::new(),
        }
    }

    /// A straight rope from `start` to `end`, in m, of `segments` equal parts. Otherwise as [`Rope::through`].
    pub fn straight(start: Vec3, end: Vec3, segments: u32) -> Self {
        let count = segments.min(MOST_SEGMENTS + 1);
        Self::through((0..=count).map(|i| start.lerp(end, i as f32 / count.max(1) as f32)).collect())
    }

    /// Its length at rest, in m, if it is not the length it is laid out at: all segments are scaled alike.
    pub fn length(self, length: f32) -> Self {
        Self { length: Some(length), ..self }
    }

    /// Velocity of all particles, in m/s.
    pub fn velocity(self, velocity: Vec3) -> Self {
        Self { velocity, ..self }
    }

    /// Mass, in kg, shared equally by its particles.
    pub fn mass(self, mass: f32) -> Self {
        Self { mass, ..self }
    }

    /// Radius, in m.
    pub fn radius(self, radius: f32) -> Self {
        Self { radius, ..self }
    }

    /// Coulomb's coefficient of friction; a contact uses the geometric mean of both bodies' own.
    pub fn friction(self, friction: f32) -> Self {
        Self { friction, ..self }
    }

    /// Whether it collides with itself.
    pub fn self_collision(self, self_collision: bool) -> Self {
        Self { self_collision, ..self }
    }

    /// Holds the angle at every inner particle as laid out, with this compliance in rad/(N·m); 0 = rigid.
    pub fn bending(self, compliance: f32) -> Self {
        Self { bending_compliance: Some(compliance), ..self }
    }

    /// Resists bending away from how it is laid out with this stiffness E I, in N·m²: the moment E I κ at the curvature κ.
    /// Exact as long as a small step can carry it; what is stiffer is as stiff as can be.
    pub fn bending_stiffness(self, stiffness: f32) -> Self {
        Self { bending_stiffness: Some(stiffness), ..self }
    }

    /// How far it gives when it is pulled, in 1/N: the strain per tension, 1/(E A). Absent, it does not stretch but for
    /// what small steps leave. Only [`ClothSolver::SmallSteps`](crate::ClothSolver::SmallSteps) knows it; under the paper's
    /// solver such a rope is refused.
    ///
    /// ```
    /// use tautline::{Rope, Settings, Vec3, World};
    ///
    /// let mut world = World::new(Settings { damping: 2.0, ..Settings::default() })?;
    /// let elastic = Rope::straight(Vec3::ZERO, Vec3::NEG_Y, 10).mass(0.1).compliance(0.02).pin(0);
    /// let elastic = world.add(elastic)?;
    /// world.set_particle_mass(elastic, 10, 1.0)?;
    /// for _ in 0..300 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// let end = world.body(elastic)?.positions()[10].y;
    /// assert!((end + 1.2).abs() < 0.02, "some 10 N stretch it by a fifth");
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn compliance(self, compliance: f32) -> Self {
        Self { compliance: Some(compliance), ..self }
    }

    /// Keeps the angle at every inner particle at or above this, in rad, 0 to π: π = straight. A rope that cannot
    /// fold sharply is thicker than its particles.
    pub fn bend_limit(self, least_angle: f32) -> Self {
        Self { least_angle: Some(least_angle), ..self }
    }

    /// Pins a particle where it starts.
    pub fn pin(mut self, particle: u32) -> Self {
        self.pins.push(particle);
        self
    }

    /// Pins both ends: the first point and the last.
    pub fn pin_ends(self) -> Self {
        let last = self.points.len().saturating_sub(1) as u32;
        self.pin(0).pin(last)
    }

    pub(crate) fn build(self) -> Result<BuiltDeformable, Error> {
        self.validate()?;
        let at_rest = |&[a, b]: &[u32; 2]| Stick::at_rest(a, b, &self.points);
        let mut sticks: Vec<Stick> = self.segments.iter().map(at_rest).collect();
        let scale = self.scale();
        sticks.iter_mut().for_each(|stick| stick.rest_length *= scale);
        Stick::check_all(&sticks, "length")?;
        let stretch = self.compliance.map(|compliance| Stretch {
            compliances: Some(sticks.iter().map(|stick| stick.rest_length * compliance).collect()),
            limit: None,
        });
        let parts = Parts {
            triangles: Vec::new(),
            sticks,
            angles: self.angles(),
            bendings: Vec::new(),
            grid: None,
            rigidity: None,
            flesh: None,
            leaves: self.segments.iter().map(|&ends| Feature::Segment(ends)).collect(),
            leaf_margin: self.radius,
            thickness: self.radius,
            self_collision: self.self_collision,
            fabric: Fabric {
                stretch,
                bends_by_stiffness: self.bending_stiffness.is_some(),
                ..Fabric::default()
            },
        };
        let body = Deformable::new(parts, &self.points)?;
        let Self { points, velocity, mass, friction, pins, .. } = self;
        let count = points.len();
        let masses = vec![mass / count as f32; count];
        Ok(BuiltDeformable {
            positions: points,
            body,
            velocities: vec![velocity; count],
            masses,
            friction,
            pins,
        })
    }

    /// Where segments meet, what holds each two of them as laid out and what keeps them from folding.
    fn angles(&self) -> Vec<Angle> {
        if self.bending_compliance.or(self.bending_stiffness).or(self.least_angle).is_none() {
            return Vec::new();
        }
        let mut meeting: Vec<Vec<u32>> = vec![Vec::new(); self.points.len()];
        for &[a, b] in &self.segments {
            meeting[a as usize].push(b);
            meeting[b as usize].push(a);
        }
        let mut angles = Vec::new();
        for (others, b) in meeting.iter().zip(0..) {
            for (rank, &a) in others.iter().enumerate() {
                for &c in &others[rank + 1..] {
                    angles.extend([self.stiff(a, b, c), self.limited(a, b, c)].into_iter().flatten());
                }
            }
        }
        angles
    }

    fn stiff(&self, a: u32, b: u32, c: u32) -> Option<Angle> {
        let compliance = self.bending_compliance_of(a, b, c)?;
        let (angle, _) = angle_gradient(self.point(a), self.point(b), self.point(c))?;
        Some(Angle { a, b, c, limit: AngleLimit::Target(angle), compliance })
    }

    fn limited(&self, a: u32, b: u32, c: u32) -> Option<Angle> {
        let limit = AngleLimit::Range(self.least_angle?, std::f32::consts::PI);
        Some(Angle { a, b, c, limit, compliance: 0.0 })
    }

    /// What the angle at a particle is held with, in rad/(N·m): for E I, half the length of both segments over it.
    fn bending_compliance_of(&self, a: u32, b: u32, c: u32) -> Option<f32> {
        let mean = |stiffness: f32| {
            let lengths = self.point(a).distance_to(self.point(b)) + self.point(b).distance_to(self.point(c));
            0.5 * lengths * self.scale() / stiffness
        };
        self.bending_compliance.or(self.bending_stiffness.map(mean))
    }

    /// Its length at rest over that it is laid out at.
    fn scale(&self) -> f32 {
        let length = |&[a, b]: &[u32; 2]| self.point(a).distance_to(self.point(b));
        let laid_out: f32 = self.segments.iter().map(length).sum();
        self.length.map_or(1.0, |length| length / laid_out)
    }

    fn point(&self, index: u32) -> Vec3 {
        self.points[index as usize]
    }

    fn validate(&self) -> Result<(), Error> {
        let count = self.points.len();
        if !(2..=MOST_SEGMENTS as usize + 1).contains(&count) {
            let problem = format!("{count} points; a rope needs 2 to {}", MOST_SEGMENTS + 1);
            return Err(Error::Invalid { field: "points".into(), problem });
        }
        all_coordinates("points", &self.points)?;
        self.validate_segments()?;
        if let Some(pin) = self.pins.iter().find(|&&pin| pin as usize >= count) {
            let (field, value) = ("pins".into(), f64::from(*pin));
            return Err(Error::OutOfRange { field, value, expected: "the number of one of its particles" });
        }
        coordinates("velocity", self.velocity)?;
        positive("mass", self.mass)?;
        within("radius", self.radius, f32::MIN_POSITIVE, 1e9, "a length above 0, at most 1e9 (m)")?;
        within("friction", self.friction, 0.0, 1e6, "a number from 0 to 1e6")?;
        if let Some(angle) = self.least_angle {
            within("least_angle", angle, 0.0, std::f32::consts::PI, "an angle from 0 to π (rad)")?;
        }
        if let Some(length) = self.length {
            within("length", length, f32::MIN_POSITIVE, 1e9, "a length above 0, at most 1e9 (m)")?;
        }
        if let Some(stiffness) = self.bending_stiffness {
            within("bending_stiffness", stiffness, 1e-20, 1e12, "a stiffness from 1e-20 to 1e12 (N·m²)")?;
            if self.bending_compliance.is_some() {
                let problem = "comes with a compliance of bending: give one of the two".into();
                return Err(Error::Invalid { field: "bending_stiffness".into(), problem });
            }
        }
        if let Some(compliance) = self.compliance {
            within("compliance", compliance, 0.0, 1e12, "a compliance from 0 to 1e12 (1/N)")?;
        }
        if let Some(compliance) = self.bending_compliance {
            within("bending_compliance", compliance, 0.0, 1e12, "a number from 0 to 1e12 (rad/(N·m))")?;
        }
        Ok(())
    }

    fn validate_segments(&self) -> Result<(), Error> {
        let count = self.segments.len();
        let refuse = |field: String, problem: String| Err(Error::Invalid { field, problem });
        if !(1..=MOST_SEGMENTS as usize).contains(&count) {
            let problem = format!("{count} segments; a rope needs 1 to {MOST_SEGMENTS}");
            return refuse("segments".into(), problem);
        }
        let mut is_held = vec![false; self.points.len()];
        for (number, &[a, b]) in self.segments.iter().enumerate() {
            let (Some(_), Some(end)) = (self.points.get(a as usize), self.points.get(b as usize)) else {
                let problem =
                    format!("is between points that are not there: there are {}", self.points.len());
                return refuse(format!("segments[{number}]"), problem);
            };
            if self.point(a).distance_squared(*end) < f32::MIN_POSITIVE {
                let problem = format!("is where points[{a}] is; a segment needs a length");
                return refuse(format!("points[{b}]"), problem);
            }
            (is_held[a as usize], is_held[b as usize]) = (true, true);
        }
        if let Some(loose) = is_held.iter().position(|held| !held) {
            return refuse(format!("points[{loose}]"), "is at the end of no segment".into());
        }
        let mut pairs: Vec<[u32; 2]> = self.segments.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        pairs.put_in_order();
        match pairs.windows(2).find(|two| two[0] == two[1]) {
            Some(two) => {
                refuse("segments".into(), format!("two are between {} and {}", two[0][0], two[0][1]))
            }
            None => Ok(()),
        }
    }
}

const MOST_SEGMENTS: u32 = 1_000_000;
