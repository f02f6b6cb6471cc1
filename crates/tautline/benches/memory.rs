//! How much memory a world of rigid bodies holds: `cargo bench -p tautline --bench memory`. The bytes of `dealloc` are
//! what a settled pile gives back when it is dropped; over the number of bodies, that of one.

mod pile;

use divan::{AllocProfiler, Bencher};

#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

#[divan::bench(args = [1000, 4000], sample_count = 1, sample_size = 1)]
fn settled_pile(bencher: Bencher, count: usize) {
    let settled = || {
        let mut world = pile::thrown(count);
        for _ in 0..5 * pile::FLYING_STEPS {
            world.step(pile::STEP).expect("a step");
        }
        world
    };
    bencher.with_inputs(settled).bench_local_values(drop);
}
