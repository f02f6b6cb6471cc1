//! The paper's three experiments (section 7), over its ranges, with the settings of the paper.

use serde::Serialize;
use tautline_scene::document::{Ordering, Scene, Settings, Sleep, Solver};
use tautline_scene::registry;
use tautline_scene::run::{Run, RunOptions, RunSummary};

use crate::failure::Failure;

/// How much is run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plan {
    /// N of experiment 1.
    pub(super) icosahedra: Vec<u32>,
    /// n of experiments 2 and 3.
    pub(super) cloths: Vec<u32>,
    /// Steps of each run.
    pub(super) steps: u16,
}

impl Plan {
    /// The paper's ranges.
    pub(super) fn paper() -> Self {
        Self { icosahedra: (5..=50).step_by(5).collect(), cloths: (20..=40).step_by(5).collect(), steps: 600 }
    }

    /// The same quantities in seconds: too short to be compared with the paper.
    pub(super) fn quick() -> Self {
        Self { icosahedra: vec![5, 10], cloths: vec![10, 15], steps: 60 }
    }
}

/// A point of charts 9(a) and 9(c).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct RigidPoint {
    /// How many icosahedra.
    pub(super) n: u32,
    /// Steps a second, ordered.
    pub(super) fps: f64,
    /// Relaxations a step, by the paper's lists.
    pub(super) relaxations_ordered: f64,
    /// Relaxations a step, in one order for all.
    pub(super) relaxations_unordered: f64,
    /// Sticks looked at in a step, by the paper's lists.
    pub(super) visits_ordered: f64,
    /// Sticks looked at in a step, in one order for all.
    pub(super) visits_unordered: f64,
    /// At the end: mean |length/rest length − 1| of the sticks.
    pub(super) mean_stick_strain: f32,
    /// At the end: largest |length/rest length − 1| of a stick.
    pub(super) max_stick_strain: f32,
    /// At the end: deepest penetration, in mm.
    pub(super) max_penetration_mm: f64,
}

/// A point of chart 9(b).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ClothPoint {
    /// Particles along each side of the cloth.
    pub(super) n: u32,
    /// Steps a second.
    pub(super) fps: f64,
    /// At the end: mean |length/rest length − 1| of the sticks.
    pub(super) mean_stick_strain: f32,
    /// At the end: largest |length/rest length − 1| of a stick.
    pub(super) max_stick_strain: f32,
}

/// What the three experiments gave.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Results {
    /// Icosahedra in a room.
    pub(super) experiment1: Vec<RigidPoint>,
    /// Cloth on a cube.
    pub(super) experiment2: Vec<ClothPoint>,
    /// Cloth on a rope.
    pub(super) experiment3: Vec<ClothPoint>,
}

/// How many points there are.
pub(super) fn point_count(plan: &Plan) -> u64 {
    (plan.icosahedra.len() + 2 * plan.cloths.len()) as u64
}

/// Runs the three experiments; `tick` is told of each point that is done.
pub(super) fn run(plan: &Plan, tick: &mut dyn FnMut()) -> Result<Results, Failure> {
    let mut experiment1 = Vec::new();
    for &n in &plan.icosahedra {
        experiment1.push(rigid_point(n, plan.steps)?);
        tick();
    }
    let mut cloth = |scene: &str| -> Result<Vec<ClothPoint>, Failure> {
        let mut points = Vec::new();
        for &n in &plan.cloths {
            points.push(cloth_point(scene, n, plan.steps)?);
            tick();
        }
        Ok(points)
    };
    Ok(Results { experiment1, experiment2: cloth("cloth-on-cube")?, experiment3: cloth("cloth-on-rope")? })
}

fn rigid_point(n: u32, steps: u16) -> Result<RigidPoint, Failure> {
    let mut scene = as_in_the_paper("icosahedra", &[("n", n)])?;
    let ordered = median_run(&scene, steps)?;
    scene.settings.ordering = Some(Ordering::AsBuilt);
    let unordered = one_run(&scene, steps)?;
    Ok(RigidPoint {
        n,
        fps: 1e3 / ordered.ms_per_step,
        relaxations_ordered: ordered.relaxations_per_step,
        relaxations_unordered: unordered.relaxations_per_step,
        visits_ordered: ordered.visits_per_step,
        visits_unordered: unordered.visits_per_step,
        mean_stick_strain: ordered.mean_stick_strain,
        max_stick_strain: ordered.max_stick_strain,
        max_penetration_mm: ordered.max_penetration_mm,
    })
}

fn cloth_point(scene: &str, n: u32, steps: u16) -> Result<ClothPoint, Failure> {
    let run = median_run(&as_in_the_paper(scene, &[("n", n)])?, steps)?;
    Ok(ClothPoint {
        n,
        fps: 1e3 / run.ms_per_step,
        mean_stick_strain: run.mean_stick_strain,
        max_stick_strain: run.max_stick_strain,
    })
}

/// A named scene, solved as the paper does, and with nothing put to sleep: figures are of bodies that are moved.
pub(super) fn as_in_the_paper(scene: &str, values: &[(&str, u32)]) -> Result<Scene, Failure> {
    let named = registry::find(scene)?;
    let mut parameters = named.defaults();
    for &(name, value) in values {
        parameters.set(name, f64::from(value))?;
    }
    let settings = Settings { solver: Solver::Paper, sleep: Some(Sleep::Never), ..Settings::default() };
    Ok(Scene { settings, ..named.document(&parameters) })
}

fn one_run(scene: &Scene, steps: u16) -> Result<RunSummary, Failure> {
    let options = RunOptions { seconds: Some(f32::from(steps) * scene.dt), record: false };
    Ok(Run::new(scene.build()?, options)?.complete(&mut |_, _| ())?.summary)
}

/// The run of median speed out of three, where three are cheap; the figures other than times are the same in each.
fn median_run(scene: &Scene, steps: u16) -> Result<RunSummary, Failure> {
    const CHEAP_MS: f64 = 3000.0;
    let mut runs = vec![one_run(scene, steps)?];
    if runs[0].ms_per_step * f64::from(steps) < CHEAP_MS {
        runs.push(one_run(scene, steps)?);
        runs.push(one_run(scene, steps)?);
    }
    runs.sort_by(|a, b| a.ms_per_step.total_cmp(&b.ms_per_step));
    Ok(runs.swap_remove(runs.len() / 2))
}
