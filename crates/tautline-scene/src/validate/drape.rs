//! Cloth that hangs.

use tautline::body::Corner;
use tautline::{BodyHandle, Cloth, Error, Settings, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{DT, center, run, steps};
use super::rope::{DAMPING, stretch};

pub(super) fn cases() -> Vec<Case> {
    vec![strain(), refinement()]
}

/// A square of 2 m and 1 kg, of `n` × `n` particles, that has swung down about two of its corners and hung for a while.
fn hung(settings: Settings, n: u32, seconds: f64) -> Result<(World, BodyHandle), Error> {
    let mut world = World::new(Settings { damping: DAMPING, ..settings })?;
    let cloth = Cloth::grid(n, n, 2.0, 2.0).pin_corner(Corner::First).pin_corner(Corner::RowEnd);
    let cloth = world.add(cloth)?;
    run(&mut world, seconds)?;
    Ok((world, cloth))
}

fn strain() -> Case {
    let trial = |(n, demand): (u32, f64)| {
        Trial::one(move |conditions| {
            let (world, cloth) = hung(conditions.settings.clone(), n, 6.0)?;
            Ok(Part::at_most(format!("{n} × {n}"), 100.0 * stretch(&world, cloth)?, demand, "%"))
        })
    };
    Case {
        id: 31,
        group: "Cloth and rope",
        name: "a cloth hung by two corners: greatest strain",
        formula: "0",
        note: "2 m, 1 kg, 6 s after it was let go level; motion dies out at 2 s⁻¹.",
        trials: [(20, 0.5), (40, 1.0), (100, 5.0)].map(trial).into(),
    }
}

/// Small steps in a second, over those at the default number of substeps: the solver makes 1920 or more on its own, so that
/// only substeps that are one small step each refine them.
const SUBSTEPS: [u32; 3] = [1, 8, 16];
/// Of the sheet that is refined, in m.
const SIDE: f32 = 1.0;
/// How far apart its edges are held, over its side.
const SPAN: f32 = 0.9;

/// A sheet held along two edges, let go from a V, so that it hangs as a catenary: how high its centre of mass is, in mm, on
/// the mean over the last of six seconds. It has one shape of rest, and no folds; sheets that hang by their corners have
/// many.
fn sagging(conditions: &Conditions, n: u32, substeps: u32) -> Result<f64, Error> {
    let substeps = conditions.settings.substeps * substeps;
    let mut world = World::new(Settings { damping: DAMPING, substeps, ..conditions.settings.clone() })?;
    let cloth = (0..n).fold(Cloth::grid(n, n, SIDE, SIDE).density(1.0), |cloth, row| {
        cloth.pin(row * n).pin(row * n + n - 1)
    });
    let cloth = world.add(cloth)?;
    let flat = world.body(cloth)?.positions().to_vec();
    let drop = (1.0 - SPAN * SPAN).sqrt();
    for (at, particle) in flat.into_iter().zip(0..) {
        let place = Vec3::new(SPAN * at.x, drop * (at.x.abs() - 0.5 * SIDE), at.z);
        world.set_particle_position(cloth, particle, place)?;
    }
    run(&mut world, 5.0)?;
    let last = steps(1.0);
    let mut sum = 0.0;
    for _ in 0..last {
        world.step(DT)?;
        sum += center(&world, cloth)?.y;
    }
    Ok(sum / last as f64 * 1e3)
}

fn refinement() -> Case {
    let halves = |what: &str, heights: [f64; 3]| {
        let [first, second] = [(heights[1] - heights[0]).abs(), (heights[2] - heights[1]).abs()];
        Part::at_most(
            format!("{what}: second change, the first being {first:.4} mm"),
            second,
            0.5 * first,
            "mm",
        )
    };
    let time = Trial::one(move |conditions| {
        let [one, two, four] = SUBSTEPS.map(|substeps| sagging(conditions, 21, substeps));
        Ok(halves("1, 2 and 4 times the small steps", [one?, two?, four?]))
    });
    let space = Trial::one(move |conditions| {
        let at = |n| sagging(conditions, n, 1);
        Ok(halves("11, 21 and 41 particles a side", [at(11)?, at(21)?, at(41)?]))
    });
    Case {
        id: 32,
        group: "Cloth and rope",
        name: "a hung cloth refined: its change",
        formula: "halves each time",
        note: "Centre of mass of a sheet of 1 m held along two edges 90 cm apart, on the mean over the last of six seconds.",
        trials: vec![time, space],
    }
}
