//! What is printed and written: a table for people, JSON for programs.

use serde_json::{Map, Value};

use crate::compare::{EARLY, FLYING, LATE, Phase, SETTLED, Series};
use crate::engine::Contender;

const HEADER: [&str; 10] =
    ["bodies", "engine", "steps", "ms/step", "fastest", "× peer", "max mm", "mean mm", "J/kg", "lost"];

/// One line per scene, phase and engine.
pub(crate) fn table(all: &[Series]) -> String {
    let mut rows = vec![HEADER.map(str::to_owned)];
    for scene in all.chunk_by(|a, b| a.n == b.n) {
        for phase in [FLYING, EARLY, LATE, SETTLED] {
            rows.extend(scene.iter().map(|series| cells(series, phase, fastest_peer(scene, phase))));
        }
    }
    let mut versions: Vec<String> = all.iter().map(|series| series.contender.version()).collect();
    versions.sort();
    versions.dedup();
    format!("{}\n{}\n{LEGEND}", versions.join(", "), aligned(&rows))
}

const LEGEND: &str = "\
ms/step: CPU time, median; fastest: of the fastest run; × peer: of the fastest peer's time.
max, mean mm: depth of what penetrates at steps 120, 300 and 600, the worst of the phase.
J/kg: kinetic energy per mass at the phase's end. lost: bodies outside the room or not finite.
";

/// ms per step of the fastest engine that is not ours.
fn fastest_peer(scene: &[Series], phase: Phase) -> Option<f64> {
    let peers = scene.iter().filter(|series| series.contender.is_peer());
    peers.map(|series| series.summary(phase).milliseconds).min_by(f64::total_cmp)
}

fn cells(series: &Series, phase: Phase, fastest_peer: Option<f64>) -> [String; 10] {
    let summary = series.summary(phase);
    let [begin, end] = phase.steps();
    [
        series.n.to_string(),
        series.contender.label(),
        format!("{begin}–{end}"),
        format!("{:.3}", summary.milliseconds),
        format!("{:.3}", summary.fastest),
        fastest_peer.map_or_else(String::new, |peer| format!("{:.2}", summary.milliseconds / peer)),
        format!("{:.2}", summary.max_mm),
        format!("{:.3}", summary.mean_mm),
        format!("{:.2e}", summary.energy),
        summary.lost.to_string(),
    ]
}

/// Columns as wide as needed: the engine's name to the left, the others to the right.
pub(crate) fn aligned<const COLUMNS: usize>(rows: &[[String; COLUMNS]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; COLUMNS] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let padded = row.iter().zip(widths).enumerate().map(|(column, (cell, width))| match column {
            1 => format!("{cell:<width$}"),
            _ => format!("{cell:>width$}"),
        });
        text += &padded.collect::<Vec<_>>().join("  ");
        text.push('\n');
    }
    text
}

/// Rows of `e1`: one per scene, phase and number of substeps of ours, with the same peers beside each.
pub(crate) fn json_rows(all: &[Series]) -> Vec<Value> {
    let mut rows = Vec::new();
    for scene in all.chunk_by(|a, b| a.n == b.n) {
        for phase in [FLYING, SETTLED] {
            let ours = scene.iter().filter(|series| !series.contender.is_peer());
            rows.extend(ours.map(|ours| Value::Object(row(ours, scene, phase))));
        }
    }
    rows
}

fn row(ours: &Series, scene: &[Series], phase: Phase) -> Map<String, Value> {
    let mut row = Map::new();
    row.insert("n".into(), ours.n.into());
    row.insert("phase".into(), phase.name.into());
    if let Contender::Ours { substeps } = ours.contender {
        row.insert("substeps".into(), substeps.into());
    }
    let peers = scene.iter().filter(|series| series.contender.is_peer());
    let engines: Vec<&Series> = std::iter::once(ours).chain(peers).collect();
    let mut insert = |name: &str, value: fn(&Series, Phase) -> Value| {
        for series in &engines {
            row.insert(format!("{}_{name}", series.contender.key()), value(series, phase));
        }
    };
    insert("ms", |series, phase| series.summary(phase).milliseconds.into());
    insert("max_mm", |series, phase| series.summary(phase).max_mm.into());
    insert("mean_mm", |series, phase| series.summary(phase).mean_mm.into());
    insert("energy_j_per_kg", |series, phase| series.summary(phase).energy.into());
    insert("lost", |series, phase| series.summary(phase).lost.into());
    insert("version", |series, _| series.contender.version().into());
    row
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::judge::Verdict;
    use crate::measure::Run;

    fn series(contender: Contender, milliseconds: f64) -> Series {
        let verdict = Verdict {
            max_depth: 0.004,
            mean_depth: 0.001,
            contacts: 9,
            energy: 2.0,
            escaped: 1,
            non_finite: 0,
        };
        let run = Run {
            milliseconds: [120.0, 180.0, 300.0].map(|steps| steps * milliseconds),
            verdicts: vec![verdict; 3],
        };
        Series { n: 200, contender, runs: vec![run] }
    }

    fn all() -> Vec<Series> {
        let ours = [8, 4].map(|substeps| series(Contender::Ours { substeps }, 0.05 * f64::from(substeps)));
        ours.into_iter().chain([series(Contender::Rapier, 0.5), series(Contender::Box3d, 1.0)]).collect()
    }

    #[test]
    fn json_has_a_row_for_every_phase_and_setting_with_all_engines() {
        let rows = json_rows(&all());
        let kinds: Vec<_> = rows
            .iter()
            .map(|row| (row["phase"].as_str().unwrap(), row["substeps"].as_u64().unwrap()))
            .collect();
        assert_eq!(kinds, [("flying", 8), ("flying", 4), ("settled", 8), ("settled", 4)]);
        assert_eq!(rows[3]["ours_ms"], 0.2);
        for row in &rows {
            assert_eq!(
                (&row["n"], &row["rapier_ms"], &row["box3d_ms"]),
                (&json!(200), &json!(0.5), &json!(1.0))
            );
            for engine in ["ours", "rapier", "box3d"] {
                assert_eq!(row[format!("{engine}_max_mm")], 4.0);
                assert_eq!(row[format!("{engine}_mean_mm")], 1.0);
                assert_eq!(row[format!("{engine}_lost")], 1);
            }
        }
    }

    #[test]
    fn the_table_compares_with_the_fastest_peer() {
        let text = table(&all());
        let settled: Vec<&str> = text.lines().filter(|line| line.contains("120–600")).collect();
        let shares: Vec<_> = settled.iter().map(|line| line.split_whitespace().rev().nth(4)).collect();
        assert_eq!(shares, [Some("0.80"), Some("0.40"), Some("1.00"), Some("2.00")]);
    }
}
