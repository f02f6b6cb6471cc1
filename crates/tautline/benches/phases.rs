//! What a step of rigid bodies costs by phase, in µs for each body, on one thread and on two:
//! `cargo bench -p tautline --bench phases -- 1000 4000 16000`. Beside it, how many pairs are near each other for each
//! body: the more bodies, the fewer of them are at the walls, and the longer they fall, so it grows with their number.
//!
//! Every step is made three times, and the quickest counts: the same work each time, so the rest is other programs'.

mod pile;

use std::time::Instant;

use tautline::{PhaseSeconds, World};

const REPEATS: usize = 3;
const SETTLED_STEPS: usize = 360;

fn main() {
    let asked: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let counts = if asked.is_empty() { vec![1000, 4000, 16_000] } else { asked };
    println!(
        "µs for each body      | threads | pairs | contacts | read, solve, write |   all | pairs a body"
    );
    for count in counts {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            for (name, cost) in ["flying", "settled"].into_iter().zip(pool.install(|| costs(count))) {
                let [near, seconds @ ..] = cost.map(|sum| sum / count as f64);
                let [pairs, contacts, rest, all] = seconds.map(|seconds| seconds * 1e6);
                println!(
                    "{count:6} bodies {name:8} | {threads:7} | {pairs:5.2} | {contacts:8.2} | {rest:18.2} | \
                     {all:5.2} | {near:12.2}"
                );
            }
        }
    }
}

/// Pairs in a step, and seconds by phase and in all, while bodies fly and from then on.
fn costs(count: usize) -> [[f64; 5]; 2] {
    let mut least = vec![[f64::INFINITY; 5]; pile::FLYING_STEPS + SETTLED_STEPS];
    for _ in 0..REPEATS {
        let mut world = pile::thrown(count);
        for least in &mut least {
            let times = step(&mut world);
            least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
        }
    }
    let mean = |steps: &[[f64; 5]]| {
        std::array::from_fn(|phase| steps.iter().map(|step| step[phase]).sum::<f64>() / steps.len() as f64)
    };
    let (flying, settled) = least.split_at(pile::FLYING_STEPS);
    [mean(flying), mean(settled)]
}

fn step(world: &mut World) -> [f64; 5] {
    let start = Instant::now();
    let report = world.step_with_clock(pile::STEP, &mut || start.elapsed().as_secs_f64());
    let all = start.elapsed().as_secs_f64();
    let report = report.expect("a step");
    let PhaseSeconds { broad_phase, narrow_phase, .. } = report.seconds;
    [report.pairs as f64, broad_phase, narrow_phase, all - broad_phase - narrow_phase, all]
}
