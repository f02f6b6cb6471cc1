//! Settings of a document to settings of the engine.

use crate::document::{BroadPhase, Ordering, Settings, Sleep, Solver, SquareRoot};

/// The solver's own settings, with those the document gives in their place.
pub(crate) fn of(document: &Settings) -> tautline::Settings {
    let mut settings = match document.solver {
        Solver::Paper => tautline::Settings::paper(),
        Solver::Default => tautline::Settings::default(),
    };
    settings.gravity = document.gravity.into();
    replace(&mut settings.substeps, document.substeps);
    replace(&mut settings.features_per_pair, document.features_per_pair);
    replace(&mut settings.separation_speed, document.separation_speed.map(Some));
    let relaxation = &mut settings.relaxation;
    replace(&mut relaxation.sweeps, document.sweeps);
    replace(&mut relaxation.tolerance, document.tolerance);
    replace(&mut relaxation.ordering, document.ordering.map(ordering));
    replace(&mut relaxation.square_root, document.square_root.map(square_root));
    replace(&mut settings.damping, document.damping);
    replace(&mut settings.wind, document.wind.map(Into::into));
    replace(&mut settings.air_density, document.air_density);
    replace(&mut settings.broad_phase, document.broad_phase.map(broad_phase));
    replace(&mut settings.sleep, document.sleep.map(sleep));
    settings
}

fn replace<T>(setting: &mut T, given: Option<T>) {
    if let Some(given) = given {
        *setting = given;
    }
}

fn ordering(ordering: Ordering) -> tautline::Ordering {
    match ordering {
        Ordering::ByDistance => tautline::Ordering::ByDistance,
        Ordering::AsBuilt => tautline::Ordering::AsBuilt,
    }
}

fn square_root(square_root: SquareRoot) -> tautline::SquareRoot {
    match square_root {
        SquareRoot::Exact => tautline::SquareRoot::Exact,
        SquareRoot::FirstOrder => tautline::SquareRoot::FirstOrder,
    }
}

fn broad_phase(broad_phase: BroadPhase) -> tautline::BroadPhase {
    match broad_phase {
        BroadPhase::SortAndSweep => tautline::BroadPhase::SortAndSweep,
        BroadPhase::AllPairs => tautline::BroadPhase::AllPairs,
    }
}

fn sleep(sleep: Sleep) -> Option<tautline::Sleep> {
    match sleep {
        Sleep::Never => None,
        Sleep::After { speed, seconds } => Some(tautline::Sleep { speed, seconds }),
    }
}

impl Settings {
    /// The settings of a world, with nothing left open.
    pub fn in_force(settings: &tautline::Settings, solver: Solver) -> Self {
        let relaxation = &settings.relaxation;
        Self {
            solver,
            gravity: settings.gravity.into(),
            substeps: Some(settings.substeps),
            features_per_pair: Some(settings.features_per_pair),
            separation_speed: settings.separation_speed,
            sweeps: Some(relaxation.sweeps),
            tolerance: Some(relaxation.tolerance),
            ordering: Some(match relaxation.ordering {
                tautline::Ordering::ByDistance => Ordering::ByDistance,
                tautline::Ordering::AsBuilt => Ordering::AsBuilt,
            }),
            square_root: Some(match relaxation.square_root {
                tautline::SquareRoot::Exact => SquareRoot::Exact,
                tautline::SquareRoot::FirstOrder => SquareRoot::FirstOrder,
            }),
            damping: Some(settings.damping),
            wind: Some(settings.wind.into()),
            air_density: Some(settings.air_density),
            broad_phase: Some(match settings.broad_phase {
                tautline::BroadPhase::SortAndSweep => BroadPhase::SortAndSweep,
                tautline::BroadPhase::AllPairs => BroadPhase::AllPairs,
            }),
            sleep: Some(
                settings.sleep.map_or(Sleep::Never, |tautline::Sleep { speed, seconds }| Sleep::After {
                    speed,
                    seconds,
                }),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_in_force_make_the_same_settings() {
        for solver in [Solver::Default, Solver::Paper] {
            let engine = of(&Settings {
                solver,
                damping: Some(0.5),
                sleep: Some(Sleep::Never),
                ..Settings::default()
            });
            assert_eq!(of(&Settings::in_force(&engine, solver)), engine);
        }
    }
}
