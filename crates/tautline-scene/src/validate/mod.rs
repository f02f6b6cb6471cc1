//! Cases with a known answer: scenes that are run and compared with a closed form, or with a computation of their
//! own in `f64`.
//!
//! Cubes have sides of 1 m and bodies masses of 1 kg where nothing else is said; a step is 1/60 s, and nothing is put
//! to sleep. What is measured is read from the world as it shows itself, and compared in `f64`.

mod bounce;
mod bullet;
mod case;
mod cloud;
mod collide;
mod depth;
mod drape;
mod elastica;
mod flight;
mod lab;
mod peers;
mod pulley;
mod reverse;
mod roll;
mod room;
mod rope;
mod slope;
mod spin;
mod stack;
mod swing;

use rayon::prelude::*;
use tautline::Error;

pub use case::{Case, Conditions, Figures, Outcome, Part};
pub use peers::{Figure, PEERS, Peer, figures};

/// All cases, by number.
pub fn cases() -> Vec<Case> {
    let mut cases = flight::cases();
    cases.extend(bounce::cases());
    cases.extend(collide::cases());
    cases.extend(slope::cases());
    cases.extend(roll::cases());
    cases.extend(stack::cases());
    cases.extend(swing::cases());
    cases.extend(spin::cases());
    cases.extend(bullet::cases());
    cases.extend(room::cases());
    cases.extend(cloud::cases());
    cases.extend(reverse::cases());
    cases.extend(rope::cases());
    cases.extend(pulley::cases());
    cases.extend(drape::cases());
    cases.extend(elastica::cases());
    cases.sort_by_key(|case| case.id);
    cases
}

/// How many trials the cases have: so often is [`run`]'s `tick` called.
pub fn trial_count(cases: &[Case]) -> usize {
    cases.iter().map(|case| case.trials.len()).sum()
}

/// Runs cases, their trials spread over the rayon pool that this is called from; the results do not depend on it.
///
/// # Errors
/// What the engine refuses, such as settings that are out of range.
pub fn run(cases: &[Case], conditions: &Conditions, tick: impl Fn() + Sync) -> Result<Vec<Outcome>, Error> {
    let trials: Vec<_> =
        cases.iter().enumerate().flat_map(|(c, case)| case.trials.iter().map(move |t| (c, t))).collect();
    let measured: Vec<(usize, Result<Vec<Part>, Error>)> = trials
        .into_par_iter()
        .with_max_len(1)
        .map(|(c, trial)| {
            let parts = (trial.0)(conditions);
            tick();
            (c, parts)
        })
        .collect();
    let mut parts: Vec<Vec<Part>> = cases.iter().map(|_| Vec::new()).collect();
    for (c, result) in measured {
        parts[c].extend(result?);
    }
    Ok(cases.iter().zip(parts).map(|(case, parts)| Outcome::new(case, parts)).collect())
}
