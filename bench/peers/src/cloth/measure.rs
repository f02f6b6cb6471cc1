//! One engine on one scene, once: CPU time of every step, judgement at every tenth.

use cpu_time::ProcessTime;

use super::engine::{Contender, Engine};
use super::judge::{Judge, Verdict};
use super::scene::Start;
use crate::Failure;

/// Steps of a run, of 1/60 s.
pub(super) const STEPS: usize = 300;
/// Steps from one judgement to the next.
const JUDGED_EVERY: usize = 10;

/// What one run gave.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Run {
    /// CPU time of the whole process during all steps, in ms.
    pub(super) milliseconds: f64,
    /// After every tenth step; the last at the end.
    pub(super) verdicts: Vec<Verdict>,
}

/// A run that can be interrupted after every step.
pub(super) struct Running {
    engine: Box<dyn Engine>,
    judge: Judge,
    step: usize,
    run: Run,
}

impl Running {
    /// A run that is to begin.
    pub(super) fn new(contender: Contender, start: &Start) -> Result<Self, Failure> {
        Ok(Self { engine: contender.build(start)?, judge: Judge::new(start), step: 0, run: Run::default() })
    }

    /// Simulates some steps and says whether there are more; `told` is called after each, outside the time that counts.
    pub(super) fn advance(&mut self, steps: usize, told: &dyn Fn()) -> Result<bool, Failure> {
        for _ in self.step..STEPS.min(self.step + steps) {
            let start = ProcessTime::try_now()?;
            self.engine.step()?;
            self.run.milliseconds += 1e3 * start.try_elapsed()?.as_secs_f64();
            self.step += 1;
            if self.step.is_multiple_of(JUDGED_EVERY) {
                self.run.verdicts.push(self.judge.judge(&self.engine.state()?));
            }
            told();
        }
        Ok(self.step < STEPS)
    }

    /// What it gave.
    pub(super) fn finish(self) -> Run {
        self.run
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::super::engine::Make;
    use super::super::scene::Support;
    use super::*;

    #[test]
    fn a_run_in_turns_ends_as_one_at_a_stretch() {
        let start = Start { support: Support::Cube, n: 8, seed: 1 };
        let contender = Contender { make: Make::Rapier, self_collision: true };
        let told = Cell::new(0);
        let mut whole = Running::new(contender, &start).unwrap();
        assert!(!whole.advance(1000, &|| told.set(told.get() + 1)).unwrap());
        assert_eq!(told.get(), STEPS);
        let mut turns = Running::new(contender, &start).unwrap();
        while turns.advance(70, &|| ()).unwrap() {}
        let (whole, turns) = (whole.finish(), turns.finish());
        assert_eq!(whole.verdicts.len(), 30);
        assert_eq!(whole.verdicts, turns.verdicts);
        assert!(turns.milliseconds > 0.0 && turns.verdicts[29].is_held);
    }
}
