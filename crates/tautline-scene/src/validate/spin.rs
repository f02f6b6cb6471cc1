//! Bodies that turn freely, against Euler's equations.

use tautline::{BodyHandle, DVec3, Error, RigidBody, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{Crossings, DT, cuboid, pose, steps, turned};

pub(super) fn cases() -> Vec<Case> {
    vec![tumbling(), flipping()]
}

/// A box that turns, in free space.
#[derive(Clone, Copy)]
struct Top {
    name: &'static str,
    half_extents: Vec3,
    angular_velocity: Vec3,
}

impl Top {
    fn spin(self, conditions: &Conditions) -> Result<(World, BodyHandle), Error> {
        let mut world = conditions.weightless()?;
        let body = RigidBody::new(&cuboid(self.half_extents)?).mass(1.0);
        let body = world.add(body.angular_velocity(self.angular_velocity))?;
        Ok((world, body))
    }

    /// Principal moments over the mass, in m².
    fn inertia(self) -> DVec3 {
        let squares = self.half_extents.as_dvec3() * self.half_extents.as_dvec3() / 3.0;
        DVec3::new(squares.y + squares.z, squares.z + squares.x, squares.x + squares.y)
    }

    fn start(self) -> DVec3 {
        self.angular_velocity.as_dvec3()
    }
}

/// The table's box.
const BOX: Top = Top {
    name: "1 × 2 × 3 m",
    half_extents: Vec3::new(0.5, 1.0, 1.5),
    angular_velocity: Vec3::new(2.0, 3.0, 1.0),
};

fn tumbling() -> Case {
    const SECONDS: f64 = 60.0;
    let trial = |top: Top| {
        Trial::new(move |conditions| {
            let (mut world, _) = top.spin(conditions)?;
            let (inertia, w) = (top.inertia(), top.start());
            let (energy, momentum) = (0.5 * w.dot(inertia * w), inertia * w);
            let (mut energy_error, mut momentum_error): (f64, f64) = (0.0, 0.0);
            for _ in 0..steps(SECONDS) {
                world.step(DT)?;
                energy_error = energy_error.max((world.kinetic_energy() / energy - 1.0).abs());
                let off = (world.angular_momentum() - momentum).length() / momentum.length();
                momentum_error = momentum_error.max(off);
            }
            Ok(vec![
                Part::at_most(format!("{}: energy", top.name), energy_error, 1e-3, ""),
                Part::at_most(format!("{}: angular momentum", top.name), momentum_error, 1e-5, ""),
            ])
        })
    };
    let plate = Top {
        name: "1 × 0.05 × 0.6 m, faster",
        half_extents: Vec3::new(0.5, 0.025, 0.3),
        angular_velocity: Vec3::new(-4.0, 1.0, 6.0),
    };
    let rod = Top {
        name: "0.02 × 1 × 0.04 m",
        half_extents: Vec3::new(0.01, 0.5, 0.02),
        angular_velocity: Vec3::new(3.0, 8.0, 0.5),
    };
    Case {
        id: 18,
        group: "Free rotation",
        name: "torque-free tumbling for 60 s",
        formula: "E and L (as a vector) stay",
        note: "The greatest change at any step.",
        trials: [BOX, plate, rod].map(trial).into(),
    }
}

fn flipping() -> Case {
    const SECONDS: f64 = 60.0;
    let trial = |top: Top| {
        Trial::new(move |conditions| {
            let (mut world, body) = top.spin(conditions)?;
            let momentum = top.inertia() * top.start();
            let mut crossings = Crossings::default();
            for _ in 0..steps(SECONDS) {
                world.step(DT)?;
                let (_, rotation) = pose(&world, body)?;
                crossings.add(world.time(), turned(rotation, DVec3::Y).dot(momentum));
            }
            let intervals = crossings.intervals();
            let expected = flip_interval(top.inertia(), top.start());
            let mean = intervals.iter().sum::<f64>() / intervals.len() as f64;
            let furthest = |a: f64, b: f64| if (b - expected).abs() > (a - expected).abs() { b } else { a };
            let worst = intervals.iter().copied().fold(expected, furthest);
            Ok(vec![
                Part::relative(format!("{}: mean", top.name), [mean, expected], 3e-3, "s"),
                Part::relative(format!("{}: furthest off", top.name), [worst, expected], 3e-3, "s"),
            ])
        })
    };
    let table = Top {
        name: "2 × 1 × 0.2 m",
        half_extents: Vec3::new(1.0, 0.5, 0.1),
        angular_velocity: Vec3::new(0.05, 5.0, 0.0),
    };
    let book = Top {
        name: "book, 0.3 × 0.2 × 0.04 m",
        half_extents: Vec3::new(0.15, 0.1, 0.02),
        angular_velocity: Vec3::new(0.3, 7.0, 0.2),
    };
    let wingnut = Top {
        name: "0.4 × 0.3 × 0.2 m",
        half_extents: Vec3::new(0.2, 0.15, 0.1),
        angular_velocity: Vec3::new(0.0, 9.0, 0.5),
    };
    Case {
        id: 19,
        group: "Free rotation",
        name: "Dzhanibekov: time between flips",
        formula: "Euler's equations, by Runge and Kutta in f64",
        note: "Half a period of the component of ω along the middle axis. It depends on the logarithm of how far the start \
               is from turning about that axis for ever, of which f32 rounds off some when the body is made, and no more \
               while it flies. What is left is the substep's error: 9e-5 with 8, a quarter of that with 16.",
        trials: [table, book, wingnut].map(trial).into(),
    }
}

/// Time between two flips of a body that turns about its middle axis, in s: I ω' = I ω × ω.
fn flip_interval(inertia: DVec3, start: DVec3) -> f64 {
    const H: f64 = 1e-4;
    let slope = |w: DVec3| (inertia * w).cross(w) / inertia;
    let mut crossings = Crossings::default();
    let mut w = start;
    let mut step = 0;
    while crossings.times().len() < 2 && step < 1_000_000 {
        let k1 = slope(w);
        let k2 = slope(w + k1 * (0.5 * H));
        let k3 = slope(w + k2 * (0.5 * H));
        let k4 = slope(w + k3 * H);
        w += (k1 + (k2 + k3) * 2.0 + k4) * (H / 6.0);
        step += 1;
        crossings.add(f64::from(step) * H, w.y);
    }
    crossings.intervals().first().copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half the period of the Jacobi elliptic functions that solve the equations, by the arithmetic-geometric mean.
    #[test]
    fn flips_are_as_far_apart_as_elliptic_functions_say() {
        let inertia = DVec3::new(0.26, 1.01, 1.25) / 3.0;
        let w = DVec3::new(0.05, 5.0, 0.0);
        let (energy, momentum) = (w.dot(inertia * w), (inertia * w).length_squared());
        let DVec3 { x: a, y: b, z: c } = inertia;
        // Landau & Lifshitz, Mechanics, § 37, with L² > 2E·I₂ or else the first and the third axis exchanged.
        let (a, c) = if momentum > energy * b { (a, c) } else { (c, a) };
        let rate = ((c - b) * (momentum - energy * a) / (a * b * c)).abs().sqrt();
        let modulus = ((b - a) * (energy * c - momentum)) / ((c - b) * (momentum - energy * a));
        let (mut x, mut y) = (1.0, (1.0 - modulus).sqrt());
        for _ in 0..40 {
            (x, y) = (0.5 * (x + y), (x * y).sqrt());
        }
        let half_period = std::f64::consts::PI / (x * rate);
        let found = flip_interval(inertia, w);
        assert!((found / half_period - 1.0).abs() < 1e-6, "{found} and {half_period}");
        assert!((found - 3.204109).abs() < 1e-6, "{found}");
    }
}
