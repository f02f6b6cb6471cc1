//! What an engine must be able to do to be compared, and how the engines are set.

use glam::Vec3;

use super::ours::Ours;
use super::rapier::Rapier;
use super::scene::Start;
use crate::Failure;
use crate::engine::locked_version;

/// A scene in an engine.
pub(super) trait Engine {
    /// Simulates one step.
    fn step(&mut self) -> Result<(), Failure>;

    /// Everything as it is now.
    fn state(&self) -> Result<State, Failure>;
}

/// Cloth and rope, in m and m/s.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct State {
    /// Of the cloth's particles, in rows.
    pub(super) positions: Vec<Vec3>,
    /// Of the same.
    pub(super) velocities: Vec<Vec3>,
    /// As the engine cuts the cells.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Positions of the rope's particles; empty without one.
    pub(super) rope: Vec<Vec3>,
}

/// An engine and how it is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Contender {
    pub(crate) make: Make,
    /// Whether the cloth collides with itself.
    pub(crate) self_collision: bool,
}

/// Which engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Make {
    Ours,
    Rapier,
}

impl Contender {
    /// A fresh world with the scene.
    pub(super) fn build(self, start: &Start) -> Result<Box<dyn Engine>, Failure> {
        Ok(match self.make {
            Make::Ours => Box::new(Ours::new(start, self.self_collision)?),
            Make::Rapier => Box::new(Rapier::new(start, self.self_collision)?),
        })
    }

    /// Its name, for people.
    pub(super) fn label(self) -> String {
        let plain = if self.self_collision { "" } else { ", without self-collision" };
        match self.make {
            Make::Ours => format!("tautline{plain}"),
            Make::Rapier => format!("rapier{plain}"),
        }
    }

    /// Its name, for programs.
    pub(super) fn key(self) -> &'static str {
        match (self.make, self.self_collision) {
            (Make::Ours, true) => "ours",
            (Make::Ours, false) => "ours_plain",
            (Make::Rapier, true) => "rapier",
            (Make::Rapier, false) => "rapier_plain",
        }
    }

    /// Its package and that one's version.
    pub(super) fn version(self) -> String {
        let package = match self.make {
            Make::Ours => "tautline",
            Make::Rapier => "rapier3d",
        };
        format!("{package} {}", locked_version(package))
    }

    /// How often it runs, where `asked` runs were asked for: rapier takes minutes for one above 60 × 60.
    pub(super) fn starts(self, n: u32, asked: u32) -> u32 {
        if self.make == Make::Rapier && n > 60 { 1 } else { asked }
    }
}

#[cfg(test)]
mod tests {
    use super::super::scene::Support;
    use super::*;

    const ALL: [Contender; 2] = [
        Contender { make: Make::Ours, self_collision: true },
        Contender { make: Make::Rapier, self_collision: true },
    ];

    #[test]
    fn every_engine_starts_with_the_scene_and_lets_it_fall() {
        for support in [Support::Cube, Support::Rope] {
            let start = Start { support, n: 8, seed: 3 };
            for contender in ALL {
                let mut engine = contender.build(&start).unwrap();
                let before = engine.state().unwrap();
                assert_alike(&before.positions, &start.positions(), 1e-6, contender);
                assert_alike(&before.rope, &start.rope(), 1e-6, contender);
                assert_eq!(before.triangles.len(), 2 * 7 * 7);
                for _ in 0..3 {
                    engine.step().unwrap();
                }
                let after = engine.state().unwrap();
                let fallen: Vec<Vec3> =
                    start.positions().iter().map(|p| *p - Vec3::Y * (0.5 * 9.81 * 0.05 * 0.05)).collect();
                assert_alike(&after.positions, &fallen, 0.01, contender);
                let velocity = vec![Vec3::NEG_Y * (9.81 * 0.05); 64];
                assert_alike(&after.velocities, &velocity, 0.05, contender);
                let ends = |rope: &[Vec3]| [rope.first().copied(), rope.last().copied()];
                assert_eq!(ends(&after.rope), ends(&before.rope), "{contender:?}");
            }
        }
    }

    fn assert_alike(found: &[Vec3], expected: &[Vec3], tolerance: f32, who: Contender) {
        assert_eq!(found.len(), expected.len(), "{who:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(found.distance(*expected) < tolerance, "{who:?}: {found} instead of {expected}");
        }
    }
}
