//! When a moving vertex meets a moving face, or an edge an edge, against exact arithmetic: none may be missed.

mod cases;
mod exact;
mod polynomial;
mod random;

use cases::{ON_EDGE, ON_FACE, Pair, RANDOM, through};
use exact::Truth;
use random::Random;
use tautline::Vec3;
use tautline::geometry::swept;

/// Unit of the lattice, in m, and where it lies. Exact in f32 all of them.
const PLACES: [(f32, Vec3); 3] =
    [(1.0, Vec3::ZERO), (1.0 / 1024.0, Vec3::ZERO), (1.0 / 64.0, Vec3::new(1000.0, -500.0, 250.0))];

/// What pairs of one kind came to.
#[derive(Default)]
struct Row {
    meet: usize,
    missed: usize,
    late: usize,
    pass: usize,
    false_alarms: usize,
    degenerate: usize,
    /// How much too early, at most, as a share of the motion.
    early: f64,
}

#[test]
fn never_misses() {
    print_and_judge(40);
}

/// Some minutes: `cargo test -p tautline --test swept hundred -- --ignored --nocapture`.
#[test]
#[ignore = "the same on 100 000 pairs"]
fn never_misses_on_a_hundred_thousand_pairs() {
    print_and_judge(1_500);
}

fn print_and_judge(pairs_each: usize) {
    let head = ["meet", "missed", "late", "early by", "pass", "false", "degenerate"]
        .map(|h| format!("{h:>10}"))
        .concat();
    println!("{:32}{head}", "pairs");
    let (mut sum, mut failed) = (0, Vec::new());
    let mut judge = |name: String, row: Row| {
        println!("{name:32}{}", row.text());
        sum += row.meet + row.pass + row.degenerate;
        if row.missed + row.late > 0 {
            failed.push(name);
        }
    };
    for is_face in [true, false] {
        let kind = if is_face { "vertex, face: " } else { "edge, edge: " };
        for (name, generate) in RANDOM {
            judge(format!("{kind}{name}"), Row::of_random(pairs_each, is_face, generate));
        }
        for (name, touch) in if is_face { ON_FACE } else { ON_EDGE } {
            judge(format!("{kind}{name}"), Row::of_contacts(pairs_each, is_face, touch));
        }
    }
    println!("{sum} pairs");
    assert!(failed.is_empty(), "{failed:?}");
}

impl Row {
    fn of_random(count: usize, is_face: bool, generate: fn(&mut Random) -> Pair) -> Self {
        let (mut row, mut random) = (Self::default(), Random(1));
        for _ in 0..count {
            let pair = generate(&mut random);
            let [p, q, r, s] = pair;
            let truth =
                if is_face { exact::vertex_face(p, [q, r, s]) } else { exact::edge_edge([p, q], [r, s]) };
            for place in PLACES {
                row.count(truth.clone(), time(&pair, is_face, place));
            }
        }
        row
    }

    fn count(&mut self, truth: Truth, found: Option<f32>) {
        match (truth, found) {
            (Truth::Meet(mut first), found) => {
                self.meet += 1;
                self.missed += usize::from(found.is_none());
                let found = found.unwrap_or(0.0);
                self.late += usize::from(first.is_before(found));
                self.early = self.early.max(first.rounded() - f64::from(found));
            }
            (Truth::Pass, found) => {
                self.pass += 1;
                self.false_alarms += usize::from(found.is_some());
            }
            (Truth::Degenerate, _) => self.degenerate += 1,
        }
    }

    /// They meet at a time that is known, but may have met before.
    fn of_contacts(count: usize, is_face: bool, contact: fn(&mut Random) -> [[i64; 3]; 4]) -> Self {
        let (mut row, mut random) = (Self::default(), Random(2));
        for _ in 0..count {
            let (pair, at) = through(contact(&mut random), &mut random);
            for place in PLACES {
                let found = time(&pair, is_face, place);
                row.meet += 1;
                row.missed += usize::from(found.is_none());
                row.late += usize::from(found.is_some_and(|time| time > at));
            }
        }
        row
    }

    fn text(&self) -> String {
        let Self { meet, missed, late, early, pass, false_alarms, degenerate } = self;
        format!("{meet:10}{missed:10}{late:10}{early:10.1e}{pass:10}{false_alarms:10}{degenerate:10}")
    }
}

fn time(pair: &Pair, is_face: bool, (unit, origin): (f32, Vec3)) -> Option<f32> {
    let [start, end] =
        [0, 1].map(|k| pair.map(|way| origin + Vec3::from_array(way[k].map(|x: i64| x as f32)) * unit));
    let found = if is_face {
        let [[p, a, b, c], [q, d, e, f]] = [start, end];
        swept::vertex_face([p, q], [[a, b, c], [d, e, f]], 0.0)
    } else {
        let [[p, q, r, s], [t, u, v, w]] = [start, end];
        swept::edge_edge([[p, q], [t, u]], [[r, s], [v, w]], 0.0)
    };
    found.unwrap()
}

/// With a margin no closed form is at hand: what moves is looked at a thousand times.
#[test]
fn a_margin_is_kept_until_the_time_found() {
    let mut random = Random(3);
    for _ in 0..300 {
        let pair = random.pair(|r| r.way(20));
        let (margin, place) = (random.index(8) as f32, |k: usize, t: f32| {
            let [start, end] = pair[k].map(|p| Vec3::from_array(p.map(|x| x as f32)));
            start.lerp(end, t)
        });
        let ends = [0.0, 1.0].map(|t| [0, 1, 2, 3].map(|k| place(k, t)));
        let face = ends.map(|[_, a, b, c]| [a, b, c]);
        let found = swept::vertex_face(ends.map(|[p, ..]| p), face, margin).unwrap();
        let until = found.unwrap_or(1.0);
        let distance = |t: f32| {
            let [p, a, b, c] = [0, 1, 2, 3].map(|k| place(k, t));
            tautline::geometry::distance::distance(&[p], &[a, b, c]).unwrap().distance
        };
        // At 0 they may begin nearer.
        let times = (0..=1000).map(|i| until * i as f32 / 1000.0).filter(|_| until > 0.0);
        let nearest = times.map(distance).fold(f32::INFINITY, f32::min);
        assert!(nearest > margin - 1e-4, "{nearest} is within {margin} before {until}");
        if found.is_some() {
            assert!(distance(until) < margin + 1e-3, "a false alarm at {until}, {}", distance(until));
        }
    }
}
