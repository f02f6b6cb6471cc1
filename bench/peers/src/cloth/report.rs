//! What is printed and written: a table for people, JSON for programs.

use serde_json::{Map, Number, Value};

use super::compare::{Series, Summary};
use super::engine::Make;
use super::measure::STEPS;
use super::scene::Support;
use crate::report::aligned;

const HEADER: [&str; 14] = [
    "cloth",
    "engine",
    "starts",
    "ms/step",
    "fastest",
    "× rapier",
    "max %",
    "mean %",
    "worst %",
    "crossings",
    "worst",
    "in mm",
    "m/s",
    "held",
];

/// One line per scene and engine.
pub(crate) fn table(all: &[Series]) -> String {
    let mut text = String::new();
    for scenes in all.chunk_by(|a, b| a.support == b.support) {
        let support = scenes[0].support;
        let mut header = HEADER;
        let title = match support {
            Support::Cube => "Cloth falls on a cube (E2)",
            Support::Rope => {
                header[11] = "pierces";
                "Cloth falls on a rope (E3)"
            }
        };
        let mut rows = vec![header.map(str::to_owned)];
        for scene in scenes.chunk_by(|a, b| a.n == b.n) {
            rows.extend(scene.iter().map(|series| cells(series, rapier_time(scene, series))));
        }
        text += &format!("\n{title}, {STEPS} steps\n{}", aligned(&rows));
    }
    let mut versions: Vec<String> = all.iter().map(|series| series.contender.version()).collect();
    versions.sort();
    versions.dedup();
    format!("{text}\n{}\n{LEGEND}", versions.join(", "))
}

const LEGEND: &str = "\
ms/step: CPU time, median of the starts; fastest: of the fastest run; × rapier: of its time with the same self-collision.
max, mean %: stretch of edges at the end, median of the starts; worst: at any tenth step of any start.
crossings: pairs of triangles that intersect, at the end and at worst; in mm: particles in the cube; pierces: rope through
triangles; m/s: mean speed at the end; held: up at the end of every start.
";

/// ms per step of rapier with the same self-collision.
fn rapier_time(scene: &[Series], of: &Series) -> Option<f64> {
    let alike = |series: &&Series| {
        series.contender.make == Make::Rapier
            && series.contender.self_collision == of.contender.self_collision
    };
    scene.iter().find(alike).map(|series| series.summary().milliseconds)
}

fn cells(series: &Series, rapier: Option<f64>) -> [String; 14] {
    let summary = series.summary();
    [
        format!("{0} × {0}", series.n),
        series.contender.label(),
        series.runs.len().to_string(),
        format!("{:.3}", summary.milliseconds),
        format!("{:.3}", summary.fastest),
        rapier.map_or_else(String::new, |rapier| format!("{:.4}", summary.milliseconds / rapier)),
        format!("{:.2}", summary.max_stretch),
        format!("{:.3}", summary.mean_stretch),
        format!("{:.1}", summary.worst_stretch),
        summary.intersections.to_string(),
        summary.worst_intersections.to_string(),
        match series.support {
            Support::Cube => format!("{:.1}", summary.depth_mm),
            Support::Rope => summary.rope_pierces.to_string(),
        },
        format!("{:.3}", summary.mean_speed),
        if summary.is_held { "yes" } else { "no" }.into(),
    ]
}

/// Rows of `e2` or `e3`: one per resolution, all engines beside each other.
pub(crate) fn json_rows(all: &[Series], support: Support) -> Vec<Value> {
    let of_support: Vec<&Series> = all.iter().filter(|series| series.support == support).collect();
    of_support.chunk_by(|a, b| a.n == b.n).map(|scene| Value::Object(row(scene, support))).collect()
}

fn row(scene: &[&Series], support: Support) -> Map<String, Value> {
    let mut row = Map::new();
    row.insert("n".into(), scene[0].n.into());
    row.insert("steps".into(), STEPS.into());
    for series in scene {
        let summary = series.summary();
        let key = series.contender.key();
        let fields = fields(&summary, support);
        row.extend(fields.into_iter().map(|(name, value)| (format!("{key}_{name}"), value)));
        row.insert(format!("{key}_starts"), series.runs.len().into());
        row.insert(format!("{key}_version"), series.contender.version().into());
        if support == Support::Rope && key == "ours" {
            row.insert("rope_pierces".into(), summary.rope_pierces.into());
            row.insert("on_rope".into(), summary.is_held.into());
        }
    }
    row
}

fn fields(summary: &Summary, support: Support) -> Vec<(&'static str, Value)> {
    let mut fields = vec![
        ("ms", number(summary.milliseconds)),
        ("stretch_pct", number(summary.max_stretch)),
        ("mean_stretch_pct", number(summary.mean_stretch)),
        ("worst_stretch_pct", number(summary.worst_stretch)),
        ("intersections", summary.intersections.into()),
        ("worst_intersections", summary.worst_intersections.into()),
        ("speed_m_per_s", number(summary.mean_speed)),
        ("height_m", number(summary.mean_height)),
    ];
    match support {
        Support::Cube => {
            fields.extend([("depth_mm", number(summary.depth_mm)), ("on_cube", summary.is_held.into())])
        }
        Support::Rope => fields.extend([
            ("rope_stretch_pct", number(summary.rope_stretch)),
            ("rope_pierces", summary.rope_pierces.into()),
            ("on_rope", summary.is_held.into()),
        ]),
    }
    fields
}

/// JSON has no word for what is no number: `null`.
fn number(value: f64) -> Value {
    Number::from_f64(value).map_or(Value::Null, Value::Number)
}

#[cfg(test)]
mod tests {
    use super::super::engine::Contender;
    use super::super::judge::Verdict;
    use super::super::measure::Run;
    use super::*;

    fn all() -> Vec<Series> {
        let mut all = Vec::new();
        for support in [Support::Cube, Support::Rope] {
            for n in [20, 40] {
                for (make, time) in [(Make::Ours, 0.1), (Make::Rapier, 2.0)] {
                    for self_collision in [true, false] {
                        let verdict = Verdict {
                            max_stretch: 0.02,
                            intersections: 7,
                            depth: 0.003,
                            rope_pierces: 4,
                            is_held: true,
                            ..Verdict::default()
                        };
                        let milliseconds = STEPS as f64 * time * if self_collision { 1.0 } else { 0.5 };
                        let runs = vec![Run { milliseconds, verdicts: vec![verdict] }; 3];
                        all.push(Series { support, n, contender: Contender { make, self_collision }, runs });
                    }
                }
            }
        }
        all
    }

    #[test]
    fn json_has_a_row_for_every_resolution_with_all_engines() {
        for support in [Support::Cube, Support::Rope] {
            let rows = json_rows(&all(), support);
            assert_eq!(rows.iter().map(|row| row["n"].as_u64()).collect::<Vec<_>>(), [Some(20), Some(40)]);
            for row in &rows {
                assert_eq!((&row["ours_ms"], &row["rapier_ms"]), (&0.1.into(), &2.0.into()));
                assert_eq!((&row["ours_plain_ms"], &row["rapier_plain_ms"]), (&0.05.into(), &1.0.into()));
                for engine in ["ours", "ours_plain", "rapier", "rapier_plain"] {
                    assert_eq!(row[format!("{engine}_stretch_pct")], 2.0);
                    assert_eq!(row[format!("{engine}_intersections")], 7);
                    assert_eq!(row[format!("{engine}_starts")], 3);
                }
                let on_rope = support == Support::Rope;
                assert_eq!(row["on_rope"].as_bool(), on_rope.then_some(true));
                assert_eq!(row["rope_pierces"].as_u64(), on_rope.then_some(4));
                assert_eq!(row["rapier_depth_mm"].as_f64(), (!on_rope).then_some(3.0));
            }
        }
    }

    #[test]
    fn what_is_no_number_is_null() {
        assert_eq!(number(f64::NAN), Value::Null);
    }

    #[test]
    fn the_table_compares_with_rapier_of_the_same_self_collision() {
        let text = table(&all());
        let ours = text.lines().filter(|line| line.contains("tautline") && line.contains("40 × 40"));
        let shares: Vec<bool> = ours.map(|line| line.contains("0.0500")).collect();
        assert_eq!(shares, [true; 4]);
        assert_eq!(text.matches("pierces  ").count(), 1, "{text}");
    }
}
