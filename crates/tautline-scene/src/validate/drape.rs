//! Cloth that hangs.

use tautline::body::Corner;
use tautline::{BodyHandle, Cloth, Error, Quat, Settings, Vec3, World};

use super::case::{Case, Conditions, Part, Trial};
use super::lab::{center, run};
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

/// Changes of less than this are none, in mm: 2 m in f32 are known to 0.0002 mm, and to rest is to move less.
const STILL: f64 = 0.05;

/// A cloth whose corners are held nearer than they are in the material, so that it sags: how high its middle of mass is, in
/// mm.
fn sagging(conditions: &Conditions, n: u32, substeps: u32) -> Result<f64, Error> {
    let substeps = conditions.settings.substeps * substeps;
    let mut world = World::new(Settings { damping: DAMPING, substeps, ..conditions.settings.clone() })?;
    let upright = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let cloth = Cloth::grid(n, n, 2.0, 2.0).rotation(upright).position(Vec3::NEG_Y);
    let cloth = world.add(cloth.pin_corner(Corner::First).pin_corner(Corner::RowEnd))?;
    // The upper corners are drawn together by a tenth.
    for (particle, x) in [(0, -0.9), (n - 1, 0.9)] {
        world.set_particle_position(cloth, particle, Vec3::new(x, 0.0, 0.0))?;
    }
    run(&mut world, 12.0)?;
    Ok(center(&world, cloth)?.y * 1e3)
}

fn refinement() -> Case {
    let halves = |what: &str, heights: [f64; 3]| {
        let [first, second] = [(heights[1] - heights[0]).abs(), (heights[2] - heights[1]).abs()];
        let allowed = (0.5 * first).max(STILL);
        Part::at_most(format!("{what}: second change, the first being {first:.3} mm"), second, allowed, "mm")
    };
    let substeps = Trial::one(move |conditions| {
        let at = |substeps| sagging(conditions, 21, substeps);
        Ok(halves("1, 2 and 4 times the substeps", [at(1)?, at(2)?, at(4)?]))
    });
    let particles = Trial::one(move |conditions| {
        let at = |n| sagging(conditions, n, 1);
        Ok(halves("11, 21 and 41 particles a side", [at(11)?, at(21)?, at(41)?]))
    });
    Case {
        id: 32,
        group: "Cloth and rope",
        name: "a hung cloth refined: its change",
        formula: "halves each time",
        note: "The height of the middle of a sheet of 2 m hung by two corners 1.8 m apart, 12 s after it was let go.",
        trials: vec![substeps, particles],
    }
}
