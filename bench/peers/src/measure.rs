//! One engine, one scene, once.

use cpu_time::ProcessTime;

use crate::Failure;
use crate::engine::Contender;
use crate::judge::{Verdict, judge};
use crate::scene::Scene;

/// Steps after which the states are judged; between them the time is taken.
pub(crate) const STOPS: [usize; 3] = [120, 300, 600];

/// What one run gave, stop by stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    /// CPU time of the whole process since the stop before, in ms.
    pub(crate) milliseconds: [f64; 3],
    /// At the stop.
    pub(crate) verdicts: [Verdict; 3],
}

/// Runs a scene to the last stop; `told` is called after every step, outside the time that counts.
pub(crate) fn measure(contender: Contender, scene: &Scene, told: &dyn Fn()) -> Result<Run, Failure> {
    let mut engine = contender.build(scene)?;
    let mut milliseconds = [0.0; 3];
    let mut verdicts = [judge(&scene.bodies, scene.side); 3];
    let mut step = 0;
    for (stop, end) in STOPS.into_iter().enumerate() {
        while step < end {
            let start = ProcessTime::try_now()?;
            engine.step()?;
            milliseconds[stop] += 1e3 * start.try_elapsed()?.as_secs_f64();
            step += 1;
            told();
        }
        verdicts[stop] = judge(&engine.states()?, scene.side);
    }
    Ok(Run { milliseconds, verdicts })
}
