//! One engine on one scene, once: time between stops, judgement at each.

use cpu_time::ProcessTime;

use crate::Failure;
use crate::engine::{Contender, Engine};
use crate::judge::{Verdict, judge};
use crate::scene::Scene;

/// Steps after which the states are judged; between them the time is taken.
pub(crate) const STOPS: [usize; 3] = [120, 300, 600];

/// What one run gave, stop by stop.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Run {
    /// CPU time of the whole process since the stop before, in ms.
    pub(crate) milliseconds: [f64; 3],
    /// At the stops reached so far.
    pub(crate) verdicts: Vec<Verdict>,
}

/// A run that can be interrupted after every step.
pub(crate) struct Running {
    engine: Box<dyn Engine>,
    /// In m.
    side: f32,
    step: usize,
    run: Run,
}

impl Running {
    /// A run that is to begin.
    pub(crate) fn new(contender: Contender, scene: &Scene) -> Result<Self, Failure> {
        Ok(Self { engine: contender.build(scene)?, side: scene.side, step: 0, run: Run::default() })
    }

    /// Simulates some steps and says whether there are more; `told` is called after each, outside the time that counts.
    pub(crate) fn advance(&mut self, steps: usize, told: &dyn Fn()) -> Result<bool, Failure> {
        for _ in 0..steps {
            let stop = self.run.verdicts.len();
            if stop == STOPS.len() {
                return Ok(false);
            }
            let start = ProcessTime::try_now()?;
            self.engine.step()?;
            self.run.milliseconds[stop] += 1e3 * start.try_elapsed()?.as_secs_f64();
            self.step += 1;
            if self.step == STOPS[stop] {
                self.run.verdicts.push(judge(&self.engine.states()?, self.side));
            }
            told();
        }
        Ok(self.run.verdicts.len() < STOPS.len())
    }

    /// What it gave.
    pub(crate) fn finish(self) -> Run {
        self.run
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::scene::Room;

    #[test]
    fn a_run_in_turns_ends_as_one_at_a_stretch() {
        let scene = Scene::read(Room::Dense, 200).unwrap();
        let told = Cell::new(0);
        let mut whole = Running::new(Contender::Rapier, &scene).unwrap();
        assert!(!whole.advance(1000, &|| told.set(told.get() + 1)).unwrap());
        assert_eq!(told.get(), 600);
        let mut turns = Running::new(Contender::Rapier, &scene).unwrap();
        while turns.advance(70, &|| ()).unwrap() {}
        let (whole, turns) = (whole.finish(), turns.finish());
        assert_eq!(whole.verdicts.len(), 3);
        assert_eq!(whole.verdicts, turns.verdicts);
        assert!(turns.milliseconds.iter().all(|&time| time > 0.0));
    }
}
