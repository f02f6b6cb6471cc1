//! Ropes that hang, carry and vibrate.

use std::f64::consts::PI;

use tautline::{BodyHandle, Error, Rope, Settings, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{Crossings, DT, run, steps};

pub(super) fn cases() -> Vec<Case> {
    vec![catenary(), tip_mass(), string()]
}

/// What would swing on comes to rest, in 1/s.
pub(super) const DAMPING: f32 = 2.0;

/// A world on Earth in which motion dies out.
pub(super) fn damped(conditions: &Conditions) -> Result<World, Error> {
    World::new(Settings { damping: DAMPING, ..conditions.settings.clone() })
}

/// By what share the longest stick of a body is too long.
pub(super) fn stretch(world: &World, body: BodyHandle) -> Result<f64, Error> {
    let body = world.body(body)?;
    let at = |particle: u32| body.positions()[particle as usize].as_dvec3();
    let strains = body
        .sticks()
        .iter()
        .map(|stick| at(stick.a).distance(at(stick.b)) / f64::from(stick.rest_length) - 1.0);
    Ok(strains.fold(0.0, f64::max))
}

/// The lowest node of a hung chain of `segments` (even) equal links, in m below its ends. Link k carries the horizontal
/// tension H, found by bisection from the span, and the vertical one (k − (n − 1)/2) m g.
fn sag(segments: usize, length: f64, span: f64) -> f64 {
    let link = length / segments as f64;
    let vertical = |k: usize| k as f64 - (segments as f64 - 1.0) / 2.0;
    let width = |h: f64| (0..segments).map(|k| link * h / h.hypot(vertical(k))).sum::<f64>();
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if width(middle) < span { low = middle } else { high = middle }
    }
    (0..segments / 2).map(|k| -link * vertical(k) / low.hypot(vertical(k))).sum()
}

fn catenary() -> Case {
    let trial = |segments: u32| {
        Trial::new(move |conditions| {
            let mut world = damped(conditions)?;
            // From a V: half of 3 m down from each end.
            let drop = 1.25f32.sqrt();
            let point = |i: u32| {
                let x = 2.0 * i as f32 / segments as f32 - 1.0;
                Vec3::new(x, drop * (x.abs() - 1.0), 0.0)
            };
            let rope = Rope::through((0..=segments).map(point).collect()).length(3.0).pin_ends();
            let rope = world.add(rope)?;
            run(&mut world, 20.0)?;
            let lowest = -f64::from(world.body(rope)?.positions()[segments as usize / 2].y);
            let name = |what: &str| format!("{segments} links: {what}");
            let expected = sag(segments as usize, 3.0, 2.0);
            Ok(vec![
                Part::absolute(name("sag"), [lowest, expected], 2e-4, "m"),
                Part::at_most(name("strain"), stretch(&world, rope)?, 1e-4, ""),
            ])
        })
    };
    Case {
        id: 20,
        group: "Cloth and rope",
        name: "catenary",
        formula: "link k bears H and (k − (n − 1)/2) m g",
        note: "A rope of 3 m held at two points 2 m apart, 20 s after it was let go from a V; motion dies out at 2 s⁻¹.",
        trials: [50, 20, 100].map(trial).into(),
    }
}

/// Of the rope that carries a mass.
const LINKS: u32 = 40;

fn tip_mass() -> Case {
    let trial = |(ratio, direction, what, demand): (f32, Vec3, &'static str, f64)| {
        Trial::one(move |conditions| {
            let mut world = conditions.world()?;
            let rope = world.add(Rope::straight(Vec3::ZERO, direction * 2.0, LINKS).pin(0))?;
            world.set_particle_mass(rope, LINKS, ratio / (LINKS + 1) as f32)?;
            let mut worst = 0.0f64;
            for _ in 0..steps(5.0) {
                world.step(DT)?;
                worst = worst.max(stretch(&world, rope)?);
            }
            Ok(Part::at_most(format!("{ratio} × a particle, {what}"), worst, demand, ""))
        })
    };
    Case {
        id: 21,
        group: "Cloth and rope",
        name: "a rope with a heavy tip: strain",
        formula: "0",
        note: "2 m, 40 links, 1 kg. The greatest at any time in 5 s.",
        trials: vec![
            trial((10.0, Vec3::NEG_Y, "hanging", 1e-3)),
            trial((100.0, Vec3::NEG_Y, "hanging", 5e-3)),
            trial((10.0, Vec3::X, "swinging", 1e-3)),
            trial((100.0, Vec3::X, "swinging", 5e-3)),
        ],
    }
}

/// A string of 1 m and 1 kg under this tension, in N: about 1 Hz.
const TENSION: f64 = 4.0;
/// So many times as heavy as the string is what draws it.
const HEAVY: f64 = 200.0;

fn string() -> Case {
    let trial = |(links, mode): (u32, u32)| {
        Trial::one(move |conditions| {
            let mut world = conditions.weightless()?;
            let phase = |i: u32| PI * f64::from(mode * i) / f64::from(links);
            // So little that the length does not change in f32.
            let point = |i: u32| Vec3::new(i as f32 / links as f32, (1e-4 * libm::sin(phase(i))) as f32, 0.0);
            let mass = 1.0 / f64::from(links);
            let rope = Rope::through((0..=links).map(point).collect()).radius(1e-3).pin(0);
            let rope = world.add(rope.mass((mass * f64::from(links + 1)) as f32))?;
            world.set_particle_mass(rope, links, HEAVY as f32)?;
            // A belly of the mode.
            let belly = (links / (2 * mode)) as usize;
            let mut crossings = Crossings::default();
            for _ in 0..steps(8.0) {
                world.apply_force_at(rope, links, Vec3::X * TENSION as f32)?;
                world.step(DT)?;
                crossings.add(world.time(), f64::from(world.body(rope)?.positions()[belly].y));
            }
            let edge = 1.0 / f64::from(links);
            let expected =
                (TENSION / (mass * edge)).sqrt() / PI * libm::sin(0.5 * PI * f64::from(mode) * edge);
            let name = format!("{links} links, mode {mode}");
            Ok(Part::relative(name, [1.0 / crossings.period(), expected], 5e-3, "Hz"))
        })
    };
    Case {
        id: 26,
        group: "Cloth and rope",
        name: "a vibrating string",
        formula: "f_k = (1/π) √(T/(m a)) sin(kπ/2N)",
        note: "1 m, 1 kg, held at one end and drawn with 4 N at a particle of 200 kg at the other; 0.1 mm high.",
        trials: [(20, 1), (20, 2), (20, 5), (60, 1), (60, 3)].map(trial).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_of_many_links_sags_as_the_catenary() {
        // 3 = 2 a sinh(1/a), sag = a (cosh(1/a) − 1).
        assert!((sag(50, 3.0, 2.0) - 1.005_525_6).abs() < 1e-6);
        assert!((sag(5000, 3.0, 2.0) - 1.005_266_5).abs() < 1e-6);
    }
}
