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

/// Of a string of 1 m and 1 kg, in N: about half a vibration a second.
const TENSION: f64 = 4.0;
/// By what share of its length a string between two pins is stretched.
const STRETCHED: f64 = 0.25;
/// How high a string vibrates, in m: so little that its tension stays.
const HEIGHT: f64 = 1e-3;

/// What keeps a string under tension.
#[derive(Clone, Copy)]
enum Drawn {
    /// It is elastic, and held at both ends.
    Elastic,
    /// It does not give, and forces draw both ends, which are free to move up and down and weigh half as much as a particle:
    /// its modes are those between two pins, with bellies at the ends.
    AtBoth,
    /// The same, but one end is held: half a string of twice as many links, in its odd modes.
    AtOne,
}

impl Drawn {
    /// Links of the whole string.
    fn whole(self, links: u32) -> u32 {
        match self {
            Self::Elastic | Self::AtBoth => links,
            Self::AtOne => 2 * links,
        }
    }

    /// A string of 1 m between its ends, in one of its modes.
    fn string(self, world: &mut World, links: u32, mode: u32) -> Result<BodyHandle, Error> {
        let phase = |i: u32| PI * f64::from(mode * i) / f64::from(self.whole(links));
        let shape = |i: u32| match self {
            Self::Elastic | Self::AtOne => libm::sin(phase(i)),
            Self::AtBoth => libm::cos(phase(i)),
        };
        let height = |i: u32| HEIGHT / f64::from(mode) * shape(i);
        let point = |i: u32| Vec3::new(i as f32 / links as f32, height(i) as f32, 0.0);
        let mass = 1.0 / f64::from(links);
        let rope = Rope::through((0..=links).map(point).collect()).radius(1e-3);
        let rope = rope.mass((mass * f64::from(links + 1)) as f32);
        if let Self::Elastic = self {
            let compliance = STRETCHED / TENSION;
            let length = 1.0 / (1.0 + STRETCHED);
            return world.add(rope.length(length as f32).compliance(compliance as f32).pin_ends());
        }
        let rope = world.add(if let Self::AtOne = self { rope.pin(0) } else { rope })?;
        for end in self.drawn_ends(links) {
            world.set_particle_mass(rope, end, (0.5 * mass) as f32)?;
        }
        Ok(rope)
    }

    fn drawn_ends(self, links: u32) -> Vec<u32> {
        match self {
            Self::Elastic => vec![],
            Self::AtBoth => vec![0, links],
            Self::AtOne => vec![links],
        }
    }
}

fn string() -> Case {
    let trial = |(drawn, links, mode): (Drawn, u32, u32)| {
        Trial::one(move |conditions| {
            let mut world = conditions.weightless()?;
            let rope = drawn.string(&mut world, links, mode)?;
            // A belly of the mode.
            let belly = match drawn {
                Drawn::Elastic => links / (2 * mode),
                Drawn::AtBoth | Drawn::AtOne => links,
            };
            let mut crossings = Crossings::default();
            for _ in 0..steps(8.0) {
                for end in drawn.drawn_ends(links) {
                    let way = if end == 0 { Vec3::NEG_X } else { Vec3::X };
                    world.apply_force_at(rope, end, way * TENSION as f32)?;
                }
                world.step(DT)?;
                crossings.add(world.time(), f64::from(world.body(rope)?.positions()[belly as usize].y));
            }
            let (edge, mass) = (1.0 / f64::from(links), 1.0 / f64::from(links));
            let turn = 0.5 * PI * f64::from(mode) / f64::from(drawn.whole(links));
            let expected = (TENSION / (mass * edge)).sqrt() / PI * libm::sin(turn);
            let how = match drawn {
                Drawn::Elastic => "elastic",
                Drawn::AtBoth => "drawn at both ends",
                Drawn::AtOne => "drawn at one end",
            };
            let name = format!("{how}, {links} links, mode {mode}");
            Ok(Part::relative(name, [1.0 / crossings.period(), expected], 5e-3, "Hz"))
        })
    };
    use Drawn::{AtBoth, AtOne, Elastic};
    let variants = [
        (Elastic, 20, 1),
        (Elastic, 20, 5),
        (Elastic, 60, 3),
        (AtBoth, 20, 1),
        (AtBoth, 20, 5),
        (AtBoth, 60, 3),
        (AtOne, 20, 1),
        (AtOne, 60, 5),
    ];
    Case {
        id: 26,
        group: "Cloth and rope",
        name: "a vibrating string",
        formula: "f_k = (1/π) √(T/(m a)) sin(kπ/2N)",
        note: "1 m, 1 kg, 4 N, 1 mm/k high. Elastic between two pins; or of fixed length, drawn at both ends, which are free \
               and weigh m/2; or held at one: half of a string of 2N links, by symmetry.",
        trials: variants.map(trial).into(),
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
