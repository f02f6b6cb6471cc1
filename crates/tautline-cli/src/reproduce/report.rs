//! The report: what was measured beside what the paper claims.

use std::collections::BTreeSet;

use super::charts::number;
use super::experiments::{ClothPoint, Results};
use super::study::{Row, UNTIL_WITHIN};

/// What is told of the machine and the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Circumstances {
    /// Processor cores of the machine.
    pub(super) cores: usize,
    /// Steps of each run.
    pub(super) steps: u16,
    /// Whether sizes and steps were cut.
    pub(super) quick: bool,
}

/// The report, in Markdown.
pub(super) fn report(results: &Results, study: &[Row], circumstances: Circumstances) -> String {
    let Circumstances { cores, steps, quick } = circumstances;
    let (system, processor) = (std::env::consts::OS, std::env::consts::ARCH);
    let version = env!("CARGO_PKG_VERSION");
    let mut text = format!(
        "# The paper's experiments\n\nMeasured by tautline {version} on a machine with {cores} cores ({system}, \
         {processor}); {steps} steps a run, of 1/60 s for the icosahedra and 1/240 s for the cloths, with the \
         paper's settings: one substep, at most 10 sweeps, a tolerance of 1 %.\n\n"
    );
    if quick {
        text += "**A quick run: few sizes, few steps. It shows that everything works; its \
                 figures are not to be compared with the paper's.**\n\n";
    }
    text += "## Claims\n\n";
    text += &claims(results, study);
    text += "\n## Charts\n\n![Steps per second over the number of icosahedra](chart-9a.png)\n\n\
             ![Steps per second over the resolution of the cloth](chart-9b.png)\n\n\
             ![Relaxations per step, ordered and unordered](chart-9c.png)\n\n## Figures\n\n";
    text += &rigid_table(results);
    text += "\nCloth on a cube and on a rope:\n\n";
    text += &cloth_table(results);
    text += "\n## Does ordering halve the relaxations?\n\n";
    text += &verdict(study);
    text += &study_tables(study);
    text + "\n" + DIFFERENCES
}

fn claims(results: &Results, study: &[Row]) -> String {
    let mut text = "| | the paper (Pentium 4, 1.8 GHz) | measured |\n|---|---|---|\n".to_owned();
    if let Some(last) = results.experiment1.last() {
        let fps = number(last.fps);
        text += &format!("| {} icosahedra | about 20 frames/s at 50 | {fps} steps/s |\n", last.n);
        let ratio = last.relaxations_ordered / last.relaxations_unordered;
        text +=
            &format!("| relaxations, ordered/unordered, {} icosahedra | about 0.5 | {ratio:.2} |\n", last.n);
    }
    text += &format!("| the same in all readings below | | {} |\n", range(&sorted_ratios(distinct(study))));
    for (place, points) in [("a cube", &results.experiment2), ("a rope", &results.experiment3)] {
        let [Some(coarse), Some(fine)] = [points.first(), points.last()] else { continue };
        let n = coarse.n;
        let fps = number(coarse.fps);
        text +=
            &format!("| cloth {n} × {n} on {place} | \"close to real time\" at 20 × 20 | {fps} steps/s |\n");
        let slower = coarse.fps / fine.fps;
        text +=
            &format!("| finer cloth: {n} to {} | \"a severe impact\" | {slower:.1} times slower |\n", fine.n);
    }
    text
}

fn rigid_table(results: &Results) -> String {
    let mut text =
        "| icosahedra | steps/s | relaxed per step, ordered | unordered | ratio | looked at, ordered | \
                    unordered | sticks off at the end, mean (max) % | deepest penetration mm |\n\
                    |--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
            .to_owned();
    for p in &results.experiment1 {
        let ratio = p.relaxations_ordered / p.relaxations_unordered;
        text += &format!(
            "| {} | {} | {:.1} | {:.1} | {ratio:.2} | {} | {} | {} | {:.1} |\n",
            p.n,
            number(p.fps),
            p.relaxations_ordered,
            p.relaxations_unordered,
            number(p.visits_ordered),
            number(p.visits_unordered),
            strain(p.mean_stick_strain, p.max_stick_strain),
            p.max_penetration_mm,
        );
    }
    text
}

fn cloth_table(results: &Results) -> String {
    let mut text =
        "| n × n | cube: steps/s | sticks off, mean (max) % | rope: steps/s | sticks off, mean (max) % |\n\
                    |--:|--:|--:|--:|--:|\n"
            .to_owned();
    let cells =
        |p: &ClothPoint| format!("{} | {}", number(p.fps), strain(p.mean_stick_strain, p.max_stick_strain));
    for (cube, rope) in results.experiment2.iter().zip(&results.experiment3) {
        text += &format!("| {} | {} | {} |\n", cube.n, cells(cube), cells(rope));
    }
    text
}

fn strain(mean: f32, max: f32) -> String {
    format!("{:.2} ({:.1})", f64::from(mean) * 100.0, f64::from(max) * 100.0)
}

/// Ratios of the readings in which anything was relaxed, least first.
fn sorted_ratios<'a>(study: impl IntoIterator<Item = &'a Row>) -> Vec<f64> {
    let mut ratios: Vec<f64> = study.into_iter().filter_map(Row::ratio).collect();
    ratios.sort_by(f64::total_cmp);
    ratios
}

/// "0.39 to 2.55, 0.94 in the median".
fn range(ratios: &[f64]) -> String {
    match (ratios.first(), ratios.last()) {
        (Some(least), Some(most)) => {
            format!("{least:.2} to {most:.2}, {:.2} in the median", ratios[ratios.len() / 2])
        }
        _ => "unknown, as nothing was relaxed".to_owned(),
    }
}

/// The readings without those that are the same run as an earlier one, such as more sweeps than are needed.
fn distinct(study: &[Row]) -> Vec<&Row> {
    let key = |row: &Row| {
        let counts = (row.relaxations_ordered.to_bits(), row.relaxations_unordered.to_bits());
        (row.situation.clone(), row.body, row.stick_order.clone(), row.tolerance.to_bits(), counts)
    };
    let mut seen = BTreeSet::new();
    study.iter().filter(|row| seen.insert(key(row))).collect()
}

/// The answer, from the figures: which readings come near one half.
fn verdict(study: &[Row]) -> String {
    const NEAR_HALF: f64 = 0.6;
    let study = distinct(study);
    let all = sorted_ratios(study.iter().copied());
    let fair = sorted_ratios(study.iter().copied().filter(|row| row.is_fair()));
    let near: Vec<&Row> =
        study.iter().copied().filter(|row| row.ratio().is_some_and(|ratio| ratio <= NEAR_HALF)).collect();
    let mut text = format!(
        "The paper says that ordered relaxation \"requires roughly half as many relaxations\". In {} different readings of it \
         the ratio ordered/unordered is {}. In {} of them both orders bring all sticks within tolerance in at least \
         95 % of the counted steps, so that the same result is paid for: there the ratio is {}. {} of all readings \
         are at {NEAR_HALF} or below{}\n\n",
        all.len(),
        range(&all),
        fair.len(),
        range(&fair),
        near.len(),
        if near.is_empty() { ": none gives the claim." } else { ":" },
    );
    near.iter().for_each(|row| text += &near_row(row));
    text + "\n" + EXPLANATION
}

fn near_row(row: &Row) -> String {
    let result = if row.is_fair() {
        "the same result".to_owned()
    } else {
        let [ordered, unordered] = unfinished(row);
        format!("but {ordered} % and {unordered} % of the steps end beyond the tolerance")
    };
    format!(
        "- **{:.2}**: {}, {} sticks, {}, a tolerance of {} %, sweeps {}; {result}\n",
        row.ratio().unwrap_or_default(),
        row.body,
        row.sticks,
        row.situation,
        percent(row.tolerance),
        sweeps(row.sweeps),
    )
}

/// Steps that left a stick beyond the tolerance, ordered and unordered, in %.
fn unfinished(row: &Row) -> [String; 2] {
    [row.unfinished_ordered, row.unfinished_unordered].map(|share| format!("{:.0}", share * 100.0))
}

fn study_tables(study: &[Row]) -> String {
    let mut text = String::new();
    for rows in study.chunk_by(|a, b| a.group == b.group) {
        text += &format!("\n### {}\n\n", sentence_case(rows[0].group));
        text += "| body | sticks | situation | built | tolerance % | sweeps | relaxed, ordered | unordered | ratio | \
                 looked at, ratio | beyond tolerance after a step, ordered % | unordered % |\n\
                 |---|--:|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
        rows.iter().for_each(|row| text += &study_row(row));
    }
    text
}

fn study_row(row: &Row) -> String {
    let ratio = row.ratio().map_or_else(|| "–".to_owned(), |ratio| format!("**{ratio:.2}**"));
    let visits = row.visits_ordered / row.visits_unordered.max(1.0);
    let [ordered, unordered] = unfinished(row);
    format!(
        "| {} | {} | {} | {} | {} | {} | {:.1} | {:.1} | {ratio} | {visits:.2} | {ordered} | {unordered} |\n",
        row.body,
        row.sticks,
        row.situation,
        row.stick_order,
        percent(row.tolerance),
        sweeps(row.sweeps),
        row.relaxations_ordered,
        row.relaxations_unordered,
    )
}

fn percent(share: f32) -> String {
    format!("{:.1}", f64::from(share) * 100.0)
}

fn sweeps(sweeps: u32) -> String {
    if sweeps == UNTIL_WITHIN { "until within".to_owned() } else { format!("at most {sweeps}") }
}

fn sentence_case(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

const EXPLANATION: &str = "\
How to read the tables: *relaxed* are the sticks that were off by more than the tolerance and were set to their \
length, per counted step, which is what chart 9(c) plots; *looked at* counts the others too. An ordered list names \
near sticks several times, so that a sweep over it looks at more of them. *Beyond tolerance* are the steps that end \
with a stick still off: fewer relaxations are a saving only where that is as rare in both orders. *Until within* ends \
after 1000 sweeps: an impact may turn a body inside out, and then no number of sweeps brings it back. *Built* tells how \
the body's vertices were numbered: its sticks are sorted by vertex, main diagonals last; the unordered sweep follows \
that order, the ordered one only among sticks equally far away.
";

const DIFFERENCES: &str = "\
## What differs from the paper, and why

- A frame is a step here; nothing is drawn. The paper's frame rate includes drawing with OpenGL. Steps per second are \
the median of three runs, or of one where that takes more than 3 s; whatever else the machine does slows them.
- The time step, the room, speeds, friction and the size of the cloth are not in the paper: 1/60 s, a room that grows \
with the number of bodies, up to 5 m/s and 5 rad/s, 0.5, and 2 m on a cube of 1 m. The cloths take steps of 1/240 s, so \
that four steps are a frame of 1/60 s: at 1/60 s a fine cloth slides off the cube and falls through the rope, as the \
paper warns of thin objects.
- Pairs are found by sort and sweep; the paper tests all of them. The result is the same, bit for bit.
- Equation 10 is printed with the masses exchanged, which moves the heavier body further. It is used as momentum \
demands, with the mass that each feature presents at the contact rather than the whole body's. The infimum of \
equation 5 is taken over the points outside the obstacle.
- A stick that occurs several times in a list is not relaxed several times at once, which would do nothing: lists are \
laid out in rounds.
- Sweeps end early once no stick is off by more than the tolerance.
- The paper omits friction and how resting bodies are spared. Friction is Coulomb's in position form. Nothing \
sleeps here, so that resting bodies are counted, and paid for, as flying ones are.
- Cloth touches a solid as soon as the centre of a leaf sphere is nearer to it than the cloth's thickness (0.6 of the \
mean edge here), so that nothing pokes through between its particles; the paper's rule is a thickness of 0.
- Self-collision leaves out pairs of cells whose spheres overlap already at rest: they would push each other apart for \
ever.
";
