//! Heavy strips and rods that are clamped at one end.

use tautline::{BodyHandle, Cloth, Error, Rope, Settings, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{G, run};

/// Of the free part, from the clamp on, in m.
const LENGTH: f64 = 3.0;
/// Motion dies out so fast, in 1/s, that they are at rest after so many seconds.
const DAMPING: f32 = 4.0;
const SECONDS: f64 = 6.0;
/// Rows of particles across a strip.
const ROWS: u32 = 3;

/// Something that lies along x with its first two particles held, so that it is clamped half way between them; its last
/// particle hangs free.
struct Clamped {
    world: World,
    body: BodyHandle,
    /// Of its last particle.
    end: u32,
}

/// Distance between particles, if so many edges are free: the clamp is half an edge before the first free one.
fn edge(cells: u32) -> f64 {
    LENGTH / (f64::from(cells) + 0.5)
}

fn world(conditions: &Conditions) -> Result<World, Error> {
    World::new(Settings { damping: DAMPING, ..conditions.settings.clone() })
}

/// A strip of 1 kg/m².
fn strip(conditions: &Conditions, cells: u32, stiffness: f64) -> Result<Clamped, Error> {
    let mut world = world(conditions)?;
    let (columns, edge) = (cells + 2, edge(cells));
    let length = f64::from(columns - 1) * edge;
    let cloth = Cloth::grid(columns, ROWS, length as f32, (f64::from(ROWS - 1) * edge) as f32).density(1.0);
    let cloth = cloth.bending_stiffness(stiffness as f32).position(Vec3::X * (0.5 * length - edge) as f32);
    let cloth = (0..ROWS).fold(cloth, |cloth, row| cloth.pin(row * columns).pin(row * columns + 1));
    let body = world.add(cloth)?;
    Ok(Clamped { world, body, end: (ROWS / 2 + 1) * columns - 1 })
}

/// A rod of 1 kg/m.
fn rod(conditions: &Conditions, cells: u32, stiffness: f64) -> Result<Clamped, Error> {
    let mut world = world(conditions)?;
    let (end, edge) = (cells + 1, edge(cells) as f32);
    let rod = Rope::straight(Vec3::NEG_X * edge, Vec3::X * (cells as f32 * edge), end);
    let body = world.add(rod.bending_stiffness(stiffness as f32).pin(0).pin(1))?;
    for particle in 0..=end {
        let share = if particle == end { 0.5 } else { 1.0 };
        world.set_particle_mass(body, particle, edge * share)?;
    }
    Ok(Clamped { world, body, end })
}

impl Clamped {
    /// How far down its end hangs over how far it reaches from the clamp.
    fn droop_over_reach(mut self, edge: f64) -> Result<f64, Error> {
        run(&mut self.world, SECONDS)?;
        let end = self.world.body(self.body)?.positions()[self.end as usize].as_dvec3();
        Ok(-end.y / (end.x + 0.5 * edge))
    }
}

pub(super) fn cases() -> Vec<Case> {
    type Make = fn(&Conditions, u32, f64) -> Result<Clamped, Error>;
    let trial = |(name, make, cells, [load, expected]): (&'static str, Make, u32, [f64; 2])| {
        Trial::one(move |conditions| {
            let stiffness = G * LENGTH * LENGTH * LENGTH / load;
            let measured = make(conditions, cells, stiffness)?.droop_over_reach(edge(cells))?;
            Ok(Part::relative(format!("{name}, {cells} edges, Γ = {load}"), [measured, expected], 0.02, ""))
        })
    };
    // By shooting, as the test below.
    let answers = [[1.0, 0.124562], [10.0, 1.06680], [100.0, 5.88810]];
    let strips = |cells: u32| answers.map(|answer| trial(("strip", strip, cells, answer)));
    // The softer, the finer: bends grow sharp; and what is fine and stiff is beyond a small step.
    let rods =
        [14, 20, 20].into_iter().zip(answers).map(|(cells, answer)| trial(("rod", rod, cells, answer)));
    vec![Case {
        id: 30,
        group: "Cloth and rope",
        name: "a heavy strip clamped level (elastica): droop over reach",
        formula: "θ″ = −Γ (1 − s) cos θ, Γ = ρ g A L³/E I",
        note: "3 m from clamp to end; 1 kg/m² or 1 kg/m, the stiffness following from Γ.",
        trials: [8, 14].into_iter().flat_map(strips).chain(rods).collect(),
    }]
}

#[cfg(test)]
mod tests {
    /// Droop over reach of the elastica: θ(0) = 0 and θ′(1) = 0.
    fn ratio(load: f64) -> f64 {
        const STEPS: usize = 4000;
        let h = 1.0 / STEPS as f64;
        let shoot = |curvature: f64| {
            let (mut angle, mut bend, mut x, mut y) = (0.0_f64, curvature, 0.0, 0.0);
            for k in 0..STEPS {
                let s = (k as f64 + 0.5) * h;
                let half = angle + 0.5 * h * bend;
                x += h * libm::cos(half);
                y += h * libm::sin(half);
                bend -= h * load * (1.0 - s) * libm::cos(half);
                angle = half + 0.5 * h * bend;
            }
            (bend, y / x)
        };
        let (mut low, mut high) = (0.0, load);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if shoot(middle).0 > 0.0 { high = middle } else { low = middle }
        }
        shoot(low).1
    }

    #[test]
    fn a_strip_droops_as_the_elastica() {
        for (load, expected) in [(1.0, 0.124562), (10.0, 1.06680), (100.0, 5.88810)] {
            let found = ratio(load);
            assert!((found / expected - 1.0).abs() < 1e-4, "{load}: {found}");
        }
    }
}
