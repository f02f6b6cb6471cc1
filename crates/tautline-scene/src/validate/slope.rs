//! Boxes on slopes and floors: Coulomb's friction.

use tautline::{BodyHandle, DVec3, Error, HalfSpace, Mat3, Quat, RigidBody, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{G, center, cuboid, run, threshold};

pub(super) fn cases() -> Vec<Case> {
    vec![sticking(), creep(), sliding(), stopping()]
}

/// A slope through the origin.
#[derive(Clone, Copy)]
pub(super) struct Slope {
    /// tan θ.
    pub(super) steepness: f64,
    /// Where it leads down to: an angle about Y, in rad.
    pub(super) heading: f64,
}

impl Slope {
    pub(super) fn cos(self) -> f64 {
        1.0 / (1.0 + self.steepness * self.steepness).sqrt()
    }

    pub(super) fn sin(self) -> f64 {
        self.steepness * self.cos()
    }

    /// Out of the ground.
    pub(super) fn normal(self) -> DVec3 {
        let (sin, cos) = (libm::sin(self.heading), libm::cos(self.heading));
        DVec3::new(self.sin() * cos, self.cos(), self.sin() * sin)
    }

    /// The steepest way down.
    pub(super) fn downhill(self) -> DVec3 {
        let (sin, cos) = (libm::sin(self.heading), libm::cos(self.heading));
        DVec3::new(self.cos() * cos, -self.sin(), self.cos() * sin)
    }

    /// Turns X downhill and Y to the normal.
    pub(super) fn rotation(self) -> Quat {
        let (x, y) = (self.downhill(), self.normal());
        Quat::from_mat3(&Mat3::from_cols(x.as_vec3(), y.as_vec3(), x.cross(y).as_vec3()))
    }

    /// The ground, in a world of its own.
    pub(super) fn world(self, conditions: &Conditions, friction: f32) -> Result<World, Error> {
        let mut world = conditions.world()?;
        world.add(HalfSpace::new(self.normal().as_vec3(), 0.0).friction(friction))?;
        Ok(world)
    }
}

/// A box that lies on a slope.
#[derive(Clone, Copy)]
pub(super) struct Brick {
    pub(super) half_extents: Vec3,
    pub(super) mass: f32,
    pub(super) friction: f32,
    /// Turned about the slope's normal, in rad.
    pub(super) turn: f32,
}

const CUBE: Brick = Brick { half_extents: Vec3::splat(0.5), mass: 1.0, friction: 0.5, turn: 0.0 };
const TILE: Brick = Brick { half_extents: Vec3::new(0.3, 0.05, 0.2), mass: 7.0, friction: 0.5, turn: 0.4 };

impl Brick {
    pub(super) fn lie_on(self, slope: Slope, conditions: &Conditions) -> Result<(World, BodyHandle), Error> {
        self.move_on(slope, 0.0, conditions)
    }

    /// Moving downhill, in m/s.
    fn move_on(
        self,
        slope: Slope,
        speed: f32,
        conditions: &Conditions,
    ) -> Result<(World, BodyHandle), Error> {
        let mut world = slope.world(conditions, self.friction)?;
        let height = slope.normal() * f64::from(self.half_extents.y);
        let body = RigidBody::new(&cuboid(self.half_extents)?).mass(self.mass).friction(self.friction);
        let rotation = slope.rotation() * Quat::from_rotation_y(self.turn);
        let body = body.position(height.as_vec3()).rotation(rotation);
        let body = world.add(body.velocity(slope.downhill().as_vec3() * speed))?;
        Ok((world, body))
    }
}

/// How far a body has gone downhill since the world's start, in m: it began above the origin.
fn way(world: &World, slope: Slope, body: BodyHandle) -> Result<f64, Error> {
    Ok(center(world, body)?.dot(slope.downhill()))
}

const FRICTIONS: [f32; 3] = [0.2, 0.5, 0.8];

/// A slope that leads down to the side, and one that does so askew.
const HEADINGS: [f64; 2] = [0.0, 0.7];

fn sticking() -> Case {
    const SECONDS: f64 = 5.0;
    const SLID: f64 = 0.02;
    let trial = |(brick, heading, what): (Brick, f64, &'static str)| {
        Trial::one(move |conditions| {
            let mu = f64::from(brick.friction);
            let slides = |steepness: f64| {
                let slope = Slope { steepness, heading };
                let (mut world, body) = brick.lie_on(slope, conditions)?;
                run(&mut world, SECONDS)?;
                Ok(way(&world, slope, body)? > SLID)
            };
            let measured = threshold([0.97 * mu, 1.03 * mu], 2e-6, slides)?;
            // ½ g cos θ (tan θ − μ) t² = s, in which θ is known well enough.
            let needed = 2.0 * SLID / (G * SECONDS * SECONDS) * (1.0 + mu * mu).sqrt();
            let name = format!("{what}, μ = {}", brick.friction);
            Ok(Part::relative(name, [measured, mu + needed], 3e-4, ""))
        })
    };
    let cubes = FRICTIONS.map(|friction| (Brick { friction, ..CUBE }, HEADINGS[0], "cube"));
    let tiles = FRICTIONS.map(|friction| (Brick { friction, ..TILE }, HEADINGS[1], "tile askew"));
    Case {
        id: 7,
        group: "Friction",
        name: "a box on a slope begins to slide",
        formula: "tan θ = μ + 2s/(g t² cos θ)",
        note: "To slide is to move more than s = 2 cm in t = 5 s, for which a body needs to be a little steeper than μ.",
        trials: cubes.into_iter().chain(tiles).map(trial).collect(),
    }
}

fn creep() -> Case {
    let trial = |(brick, heading, what): (Brick, f64, &'static str)| {
        Trial::one(move |conditions| {
            let slope = Slope { steepness: 0.95 * f64::from(brick.friction), heading };
            let (mut world, body) = brick.lie_on(slope, conditions)?;
            let start = center(&world, body)?;
            run(&mut world, 30.0)?;
            let moved = (center(&world, body)? - start).reject_from_normalized(slope.normal()).length();
            let name = format!("{what}, μ = {}", brick.friction);
            Ok(Part::at_most(name, moved * 1e3, 0.05, "mm"))
        })
    };
    let cubes = FRICTIONS.map(|friction| (Brick { friction, ..CUBE }, HEADINGS[0], "cube"));
    let tiles = FRICTIONS.map(|friction| (Brick { friction, ..TILE }, HEADINGS[1], "tile askew"));
    Case {
        id: 8,
        group: "Friction",
        name: "creep at tan θ = 0.95 μ in 30 s",
        formula: "0",
        note: "From the very start, while the contact takes up its load, to the end.",
        trials: cubes.into_iter().chain(tiles).map(trial).collect(),
    }
}

fn sliding() -> Case {
    const SECONDS: f64 = 2.0;
    let trial = |(brick, degrees, heading, what): (Brick, f64, f64, &'static str)| {
        Trial::one(move |conditions| {
            let slope = Slope { steepness: libm::tan(degrees.to_radians()), heading };
            let (mut world, body) = brick.lie_on(slope, conditions)?;
            run(&mut world, SECONDS)?;
            let t = world.time();
            let acceleration = G * (slope.sin() - f64::from(brick.friction) * slope.cos());
            let name = format!("{what}, {degrees}°, μ = {}", brick.friction);
            Ok(Part::relative(name, [way(&world, slope, body)?, 0.5 * acceleration * t * t], 5e-4, "m"))
        })
    };
    let cube = |friction: f32| Brick { friction, ..CUBE };
    let tile = |friction: f32| Brick { friction, ..TILE };
    Case {
        id: 9,
        group: "Friction",
        name: "a box slides down for 2 s",
        formula: "½ g (sin θ − μ cos θ) t²",
        note: "",
        trials: vec![
            trial((cube(0.2), 20.0, 0.0, "cube")),
            trial((cube(0.3), 30.0, 0.0, "cube")),
            trial((cube(0.5), 35.0, 0.0, "cube")),
            trial((cube(0.0), 10.0, 0.0, "cube")),
            trial((tile(0.2), 30.0, 0.7, "tile askew")),
            trial((tile(0.6), 40.0, 2.0, "tile askew")),
        ],
    }
}

fn stopping() -> Case {
    let trial = |(brick, speed, heading, what): (Brick, f32, f64, &'static str)| {
        Trial::one(move |conditions| {
            let level = Slope { steepness: 0.0, heading };
            let (mut world, body) = brick.move_on(level, speed, conditions)?;
            let expected = f64::from(speed) * f64::from(speed) / (2.0 * f64::from(brick.friction) * G);
            run(&mut world, 2.0 + 2.0 * f64::from(speed) / (f64::from(brick.friction) * G))?;
            let name = format!("{what}, {speed} m/s, μ = {}", brick.friction);
            Ok(Part::relative(name, [way(&world, level, body)?, expected], 5e-4, "m"))
        })
    };
    let low = Brick { half_extents: Vec3::new(0.5, 0.1, 0.5), ..CUBE };
    let mut variants: Vec<_> = [2.0, 5.0, 10.0].map(|speed| (low, speed, 0.0, "slab")).into();
    variants.extend([2.0, 5.0, 10.0].map(|speed| (CUBE, speed, 0.0, "cube")));
    variants.push((Brick { friction: 0.3, ..TILE }, 4.0, 0.7, "tile askew"));
    Case {
        id: 10,
        group: "Friction",
        name: "stopping distance on a level floor",
        formula: "v²/2μg",
        note: "",
        trials: variants.into_iter().map(trial).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_a_frame() {
        let slope = Slope { steepness: 0.75, heading: 0.7 };
        assert!((slope.sin() - 0.6).abs() < 1e-12 && (slope.cos() - 0.8).abs() < 1e-12);
        assert!(slope.normal().dot(slope.downhill()).abs() < 1e-12);
        assert!((slope.downhill().y + 0.6).abs() < 1e-12);
        let turned = (slope.rotation() * Vec3::Y).as_dvec3();
        assert!((turned - slope.normal()).length() < 1e-6);
    }
}
