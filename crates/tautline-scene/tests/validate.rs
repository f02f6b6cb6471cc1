//! Every case with a known answer, against its demand.

use tautline_scene::validate::{Conditions, Figures, Outcome, cases, figures, run};

fn report(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes.iter().filter(|outcome| !outcome.pass) {
        text += &format!("\n{} {}", outcome.id, outcome.name);
        for part in outcome.parts.iter().filter(|part| !part.pass) {
            let Figures { measured, expected, error, demand, unit, error_unit } = part.figures;
            text += &format!(
                "\n    {}: {measured} {unit}, expected {expected}; off by {error:.2e} {error_unit}, demanded {demand:e}",
                part.name
            );
        }
    }
    text
}

/// The cases that are as near their answer as demanded. The others are not yet; `tautline validate` tells how far
/// off each is.
const MET: [u32; 30] = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 25, 26, 27, 28, 29, 30,
    31, 32,
];

#[test]
fn cases_that_were_as_near_their_answer_as_demanded_still_are() {
    let outcomes = run(&cases(), &Conditions::default(), || ()).unwrap();
    let (met, others): (Vec<Outcome>, Vec<Outcome>) =
        outcomes.into_iter().partition(|outcome| MET.contains(&outcome.id));
    assert!(met.len() == MET.len() && met.iter().all(|outcome| outcome.pass), "{}", report(&met));
    // Who mends one adds it to the list.
    assert!(
        others.iter().all(|outcome| !outcome.pass),
        "{:?} pass too",
        others.iter().filter(|outcome| outcome.pass).map(|outcome| outcome.id).collect::<Vec<_>>()
    );
}

#[test]
fn results_do_not_depend_on_the_threads() {
    let mut some = cases();
    some.retain(|case| [9, 13, 24].contains(&case.id));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&some, &Conditions::default(), || ()).unwrap())
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn numbers_are_given_once_and_the_wrong_gravity_shows() {
    let all = cases();
    assert!(all.is_sorted_by(|a, b| a.id < b.id));
    assert!(figures().is_sorted_by(|a, b| a.id < b.id));
    let mut free_fall = cases();
    free_fall.retain(|case| case.id == 1);
    let mut conditions = Conditions::default();
    conditions.settings.gravity.y = -9.8;
    let outcome = run(&free_fall, &conditions, || ()).unwrap().remove(0);
    assert!(!outcome.pass && outcome.ratio() > 100.0, "{outcome:?}");
}

#[test]
fn settings_that_are_refused_are_an_error() {
    let mut conditions = Conditions::default();
    conditions.settings.substeps = 0;
    let error = run(&cases(), &conditions, || ()).unwrap_err();
    assert!(error.to_string().starts_with("settings.substeps: "), "{error}");
}
