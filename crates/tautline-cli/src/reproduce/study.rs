//! Does any reasonable reading of the paper give its claim that ordered relaxation "requires roughly half as many
//! relaxations" (section 7)? Both orders are counted, varying one thing after another.

use serde::Serialize;
use tautline::{StepReport, World};
use tautline_scene::document::{Body, Ordering, Room, Scene, Sleep};

use super::experiments::as_in_the_paper;
use super::solid::Solid;
use crate::failure::Failure;

/// How much is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Effort {
    /// Bodies of a crowd.
    pub(super) crowd: u32,
    /// Steps of each run.
    pub(super) steps: u32,
    /// Runs of a single body, each with another seed.
    pub(super) seeds: u32,
}

impl Effort {
    pub(super) const FULL: Self = Self { crowd: 20, steps: 300, seeds: 20 };
    pub(super) const QUICK: Self = Self { crowd: 3, steps: 20, seeds: 1 };
}

/// What is counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Situation {
    /// All steps of a crowd in a room; each order in a run of its own.
    Crowd,
    /// The same, but both orders begin every step in the same state: that of the ordered run.
    SameState,
    /// One body in a room, and of its steps only those in which it collided.
    CollidedOnly,
    /// One body thrown at a wall at this speed (m/s), without gravity: the steps in which it collides.
    Thrown(f32),
}

impl Situation {
    /// Whether there is one body only, and only its collisions count.
    fn is_alone(self) -> bool {
        matches!(self, Self::CollidedOnly | Self::Thrown(_))
    }
}

/// How the vertices of a body are numbered, and so in which order its sticks are built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StickOrder {
    /// Sorted by vertex, diagonals last: as built.
    Sorted,
    /// At random, from this seed.
    Shuffled(u64),
}

/// One reading of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Case {
    /// What is varied here.
    pub(super) group: &'static str,
    pub(super) situation: Situation,
    pub(super) solid: Solid,
    pub(super) stick_order: StickOrder,
    /// Share of its length by which a stick may be off.
    pub(super) tolerance: f32,
    /// The most sweeps in a step.
    pub(super) sweeps: u32,
}

/// So many sweeps stand for "until all sticks are within tolerance": what is off by then, such as a body that an
/// impact has turned inside out, stays off.
pub(super) const UNTIL_WITHIN: u32 = 1000;

/// What one order did in the steps that were counted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Tally {
    pub(super) steps: u64,
    pub(super) relaxations: u64,
    pub(super) visits: u64,
    /// Sum over the steps of the mean |length/rest length − 1| that was left after them.
    pub(super) strain: f64,
    /// Steps after which some stick was still off by more than the tolerance.
    pub(super) unfinished: u64,
}

impl Tally {
    fn add(&mut self, report: &StepReport, world: &World, tolerance: f32) {
        let strain = world.strain();
        self.steps += 1;
        self.relaxations += report.relaxations;
        self.visits += report.visits;
        self.strain += f64::from(strain.mean);
        // The step compares squares: what it takes to be at the tolerance may round to just beyond.
        self.unfinished += u64::from(strain.max > tolerance * 1.001);
    }

    /// Per step that was counted.
    fn per_step(&self, sum: f64) -> f64 {
        sum / self.steps.max(1) as f64
    }
}

/// A row of `study.csv`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) group: &'static str,
    pub(super) situation: String,
    pub(super) body: &'static str,
    pub(super) sticks: usize,
    pub(super) stick_order: String,
    pub(super) tolerance: f32,
    pub(super) sweeps: u32,
    pub(super) relaxations_ordered: f64,
    pub(super) relaxations_unordered: f64,
    pub(super) visits_ordered: f64,
    pub(super) visits_unordered: f64,
    pub(super) mean_strain_ordered: f64,
    pub(super) mean_strain_unordered: f64,
    pub(super) unfinished_ordered: f64,
    pub(super) unfinished_unordered: f64,
}

impl Row {
    /// Relaxations, ordered over unordered: the paper says about 0.5. `None` if nothing was relaxed.
    pub(super) fn ratio(&self) -> Option<f64> {
        (self.relaxations_unordered > 0.0).then(|| self.relaxations_ordered / self.relaxations_unordered)
    }

    /// Whether both orders brought all sticks within tolerance in nearly every step, so that their numbers of
    /// relaxations are the price of the same result.
    pub(super) fn is_fair(&self) -> bool {
        self.unfinished_ordered.max(self.unfinished_unordered) <= 0.05
    }
}

/// Every reading that is tried.
pub(super) fn cases() -> Vec<Case> {
    let base = Case {
        group: "tolerance and sweeps",
        situation: Situation::Crowd,
        solid: Solid::Icosahedron,
        stick_order: StickOrder::Sorted,
        tolerance: 0.01,
        sweeps: 10,
    };
    let mut cases = Vec::new();
    for tolerance in [0.001, 0.01, 0.03] {
        cases.extend([10, 50, UNTIL_WITHIN].map(|sweeps| Case { tolerance, sweeps, ..base }));
    }
    let shuffled = |seed| StickOrder::Shuffled(seed);
    cases.extend([1, 2, 3].map(|seed| Case { group: "stick order", stick_order: shuffled(seed), ..base }));
    let crowded = [
        Solid::Dodecahedron,
        Solid::Icosphere(1),
        Solid::Icosphere(2),
        Solid::Irregular(0),
        Solid::Irregular(1),
        Solid::Irregular(2),
    ];
    for solid in crowded {
        let group = "bodies with more sticks";
        cases.push(Case { group, solid, ..base });
        cases.push(Case { group, solid, sweeps: 50, ..base });
        cases.push(Case { group, solid, stick_order: shuffled(1), ..base });
    }
    for solid in [Solid::Icosahedron, Solid::Icosphere(1), Solid::Irregular(1)] {
        for situation in [Situation::SameState, Situation::CollidedOnly] {
            let group = "what is counted";
            cases.extend([10, UNTIL_WITHIN].map(|sweeps| Case { group, situation, solid, sweeps, ..base }));
        }
    }
    let thrown = [
        Solid::Icosahedron,
        Solid::Dodecahedron,
        Solid::Icosphere(1),
        Solid::Icosphere(2),
        Solid::Irregular(1),
    ];
    for solid in thrown {
        for speed in [5.0, 10.0, 20.0, 50.0] {
            let (group, situation) = ("impacts", Situation::Thrown(speed));
            cases.extend([10, UNTIL_WITHIN].map(|sweeps| Case { group, situation, solid, sweeps, ..base }));
        }
    }
    cases
}

/// Counts both orders for one reading.
pub(super) fn measure(case: &Case, effort: Effort) -> Result<Row, Failure> {
    let (mut ordered, mut unordered) = (Tally::default(), Tally::default());
    let mut sticks = 0;
    for seed in 1..=if case.situation.is_alone() { effort.seeds } else { 1 } {
        let scene = scene(case, effort, seed)?;
        let mut world = scene.build()?.world;
        sticks =
            world.bodies().filter_map(|b| world.body(b).ok()).map(|b| b.sticks().len()).max().unwrap_or(0);
        let mut twin = with_ordering(&scene, Ordering::AsBuilt).build()?.world;
        for _ in 0..effort.steps {
            if case.situation == Situation::SameState {
                let settings = twin.settings().clone();
                twin = world.clone();
                twin.set_settings(settings)?;
            }
            count_step(case, &mut world, scene.dt, &mut ordered)?;
            count_step(case, &mut twin, scene.dt, &mut unordered)?;
        }
    }
    Ok(row(case, sticks, &ordered, &unordered))
}

/// Steps the world, and counts the step if it belongs to the situation.
fn count_step(case: &Case, world: &mut World, dt: f32, tally: &mut Tally) -> Result<(), Failure> {
    let report = world.step(dt)?;
    if !case.situation.is_alone() || report.contacts > 0 {
        tally.add(&report, world, case.tolerance);
    }
    Ok(())
}

/// The icosahedra of experiment 1 with other bodies, awake all the time.
fn scene(case: &Case, effort: Effort, seed: u32) -> Result<Scene, Failure> {
    let n = if case.situation.is_alone() { 1 } else { effort.crowd };
    let mut scene = as_in_the_paper("icosahedra", &[("n", n), ("seed", seed)])?;
    scene.settings.tolerance = Some(case.tolerance);
    scene.settings.sweeps = Some(case.sweeps);
    scene.settings.sleep = Some(Sleep::Never);
    let shuffle = match case.stick_order {
        StickOrder::Sorted => None,
        StickOrder::Shuffled(seed) => Some(seed),
    };
    let shape = case.solid.shape(RADIUS, shuffle)?;
    for body in &mut scene.bodies {
        match body {
            Body::Rigid(rigid) => {
                rigid.shape = shape.clone();
                if let Situation::Thrown(speed) = case.situation {
                    rigid.velocity = [-speed, 0.0, 0.0];
                    rigid.angular_velocity = [0.0; 3];
                }
            }
            Body::Room(room) if matches!(case.situation, Situation::Thrown(_)) => move_walls_away(room),
            _ => {}
        }
    }
    if let Situation::Thrown(_) = case.situation {
        scene.settings.gravity = [0.0; 3];
    }
    Ok(scene)
}

/// As the radius of the named scene's icosahedra, in m.
const RADIUS: f32 = 0.5;

/// Leaves one wall near, 2 m off.
fn move_walls_away(room: &mut Room) {
    const FAR: f32 = 1e4;
    (room.min, room.max) = ([-2.0, -FAR, -FAR], [FAR; 3]);
}

fn with_ordering(scene: &Scene, ordering: Ordering) -> Scene {
    let mut scene = scene.clone();
    scene.settings.ordering = Some(ordering);
    scene
}

fn row(case: &Case, sticks: usize, ordered: &Tally, unordered: &Tally) -> Row {
    let per_step = |tally: &Tally, count: u64| tally.per_step(count as f64);
    Row {
        group: case.group,
        situation: match case.situation {
            Situation::Crowd => "crowd in a room".into(),
            Situation::SameState => "crowd, equal states".into(),
            Situation::CollidedOnly => "one body, collisions only".into(),
            Situation::Thrown(speed) => format!("thrown at a wall at {speed} m/s"),
        },
        body: case.solid.name(),
        sticks,
        stick_order: match case.stick_order {
            StickOrder::Sorted => "as built".into(),
            StickOrder::Shuffled(seed) => format!("shuffled {seed}"),
        },
        tolerance: case.tolerance,
        sweeps: case.sweeps,
        relaxations_ordered: per_step(ordered, ordered.relaxations),
        relaxations_unordered: per_step(unordered, unordered.relaxations),
        visits_ordered: per_step(ordered, ordered.visits),
        visits_unordered: per_step(unordered, unordered.visits),
        mean_strain_ordered: ordered.per_step(ordered.strain),
        mean_strain_unordered: unordered.per_step(unordered.strain),
        unfinished_ordered: per_step(ordered, ordered.unfinished),
        unfinished_unordered: per_step(unordered, unordered.unfinished),
    }
}
