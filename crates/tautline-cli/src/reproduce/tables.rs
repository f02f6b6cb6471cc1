//! Results as comma-separated values and as charts.

use super::charts::{Chart, Line, Panel, Scale};
use super::experiments::{ClothPoint, Results, RigidPoint};
use super::study::Row;

/// The tables: file name and contents.
pub(super) fn csv_files(results: &Results, study: &[Row]) -> [(&'static str, String); 4] {
    [
        ("experiment1.csv", rigid_csv(&results.experiment1)),
        ("experiment2.csv", cloth_csv(&results.experiment2)),
        ("experiment3.csv", cloth_csv(&results.experiment3)),
        ("study.csv", study_csv(study)),
    ]
}

fn rigid_csv(points: &[RigidPoint]) -> String {
    let mut text = "n,fps,relaxations_ordered,relaxations_unordered,visits_ordered,visits_unordered,\
                    mean_stick_strain,max_stick_strain,max_penetration_mm\n"
        .to_owned();
    for p in points {
        text += &format!("{},{:.1},", p.n, p.fps);
        let counts = [p.relaxations_ordered, p.relaxations_unordered, p.visits_ordered, p.visits_unordered];
        counts.iter().for_each(|count| text += &format!("{count:.2},"));
        text += &format!("{},{},{:.3}\n", p.mean_stick_strain, p.max_stick_strain, p.max_penetration_mm);
    }
    text
}

fn cloth_csv(points: &[ClothPoint]) -> String {
    let mut text = "n,fps,mean_stick_strain,max_stick_strain\n".to_owned();
    for p in points {
        text += &format!("{},{:.1},{},{}\n", p.n, p.fps, p.mean_stick_strain, p.max_stick_strain);
    }
    text
}

fn study_csv(rows: &[Row]) -> String {
    let mut text = "group,situation,body,sticks,stick_order,tolerance,sweeps,relaxations_ordered,\
                    relaxations_unordered,ratio,visits_ordered,visits_unordered,mean_strain_ordered,\
                    mean_strain_unordered,unfinished_ordered,unfinished_unordered\n"
        .to_owned();
    for row in rows {
        let ratio = row.ratio().map_or_else(String::new, |ratio| format!("{ratio:.4}"));
        // Situations are the only texts with a comma.
        text += &format!("{},\"{}\",{},{},", row.group, row.situation, row.body, row.sticks);
        text += &format!("{},{},{},", row.stick_order, row.tolerance, row.sweeps);
        text += &format!("{:.2},{:.2},{ratio},", row.relaxations_ordered, row.relaxations_unordered);
        text += &format!("{:.2},{:.2},", row.visits_ordered, row.visits_unordered);
        text += &format!("{:.3e},{:.3e},", row.mean_strain_ordered, row.mean_strain_unordered);
        text += &format!("{:.3},{:.3}\n", row.unfinished_ordered, row.unfinished_unordered);
    }
    text
}

/// The charts of the paper's figure 9.
pub(super) fn charts(results: &Results) -> [Chart; 3] {
    let icosahedra = |y_label, lines| Panel { x_label: "icosahedra", y_label, scale: Scale::Linear, lines };
    let rigid = |name, y: fn(&RigidPoint) -> f64| Line {
        name,
        points: results.experiment1.iter().map(|p| (f64::from(p.n), y(p))).collect(),
    };
    let cloth = |name, points: &[ClothPoint]| Line {
        name,
        points: points.iter().map(|p| (f64::from(p.n), p.fps)).collect(),
    };
    let cloths = vec![cloth("on a cube", &results.experiment2), cloth("on a rope", &results.experiment3)];
    let resolution = "particles along a side of the cloth";
    let speeds = vec![
        rigid("measured", |p| p.fps),
        Line { name: "the paper, drawing included", points: vec![(50.0, 20.0)] },
    ];
    let relaxations =
        vec![rigid("ordered", |p| p.relaxations_ordered), rigid("unordered", |p| p.relaxations_unordered)];
    let visits = vec![rigid("ordered", |p| p.visits_ordered), rigid("unordered", |p| p.visits_unordered)];
    [
        Chart {
            file: "chart-9a",
            title: "9(a)  Icosahedra in a room: steps per second".into(),
            panels: vec![Panel { scale: Scale::Logarithmic, ..icosahedra("steps per second", speeds) }],
        },
        Chart {
            file: "chart-9b",
            title: "9(b)  Cloth with self-collision: steps per second".into(),
            panels: vec![Panel {
                x_label: resolution,
                y_label: "steps per second",
                scale: Scale::Linear,
                lines: cloths,
            }],
        },
        Chart {
            file: "chart-9c",
            title: "9(c)  Icosahedra in a room: relaxation, ordered and unordered".into(),
            panels: vec![
                icosahedra("sticks relaxed per step", relaxations),
                icosahedra("sticks looked at per step", visits),
            ],
        },
    ]
}
