//! What an engine must be able to do to be compared.

use crate::Failure;
use crate::box3d::Box3d;
use crate::ours::Ours;
use crate::rapier::Rapier;
use crate::scene::{Scene, State};

/// A scene in an engine.
pub(crate) trait Engine {
    /// Simulates one step.
    fn step(&mut self) -> Result<(), Failure>;

    /// The bodies as they are now, in the order of the scene.
    fn states(&self) -> Result<Vec<State>, Failure>;
}

/// An engine and how it is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Contender {
    Ours { substeps: u32 },
    Rapier,
    Box3d,
}

impl Contender {
    /// A fresh world with the scene.
    pub(crate) fn build(self, scene: &Scene) -> Result<Box<dyn Engine>, Failure> {
        Ok(match self {
            Self::Ours { substeps } => Box::new(Ours::new(scene, substeps)?),
            Self::Rapier => Box::new(Rapier::new(scene)?),
            Self::Box3d => Box::new(Box3d::new(scene)?),
        })
    }

    /// Its name, for people.
    pub(crate) fn label(self) -> String {
        match self {
            Self::Ours { substeps } => format!("tautline, {substeps} substeps"),
            Self::Rapier => "rapier".into(),
            Self::Box3d => "Box3D".into(),
        }
    }

    /// Its name, for programs.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Ours { .. } => "ours",
            Self::Rapier => "rapier",
            Self::Box3d => "box3d",
        }
    }

    /// Whether it is one of those that tautline is compared with.
    pub(crate) fn is_peer(self) -> bool {
        !matches!(self, Self::Ours { .. })
    }

    /// Its package and that one's version, as the lock file of this comparison has it.
    pub(crate) fn version(self) -> String {
        let package = match self {
            Self::Ours { .. } => "tautline",
            Self::Rapier => "rapier3d",
            Self::Box3d => "boxddd",
        };
        format!("{package} {}", locked_version(package))
    }
}

pub(crate) fn locked_version(package: &str) -> &'static str {
    let name = format!("name = \"{package}\"");
    let mut lines = include_str!("../Cargo.lock").lines().skip_while(|&line| line != name);
    let version = lines.nth(1).and_then(|line| line.strip_prefix("version = "));
    version.map_or("unknown", |version| version.trim_matches('"'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Room;

    #[test]
    fn versions_are_known() {
        for package in ["tautline", "rapier3d", "boxddd"] {
            assert!(locked_version(package).starts_with(|c: char| c.is_ascii_digit()), "{package}");
        }
    }

    /// Until anything touches, all engines must agree: gravity, spin, units, axes, order of quaternions.
    #[test]
    fn all_engines_start_alike_and_fall_alike() {
        let mut scene = Scene::read(Room::Wide, 200).unwrap();
        let highest = scene.bodies.iter().copied().max_by(|a, b| a.position.y.total_cmp(&b.position.y));
        scene.bodies = highest.into_iter().collect();
        let start = State { position: scene.bodies[0].position.with_y(0.5 * scene.side), ..scene.bodies[0] };
        scene.bodies[0] = start;
        for contender in [Contender::Ours { substeps: 8 }, Contender::Rapier, Contender::Box3d] {
            let mut engine = contender.build(&scene).unwrap();
            assert_alike(&start, &engine.states().unwrap()[0], 1e-5, &contender.label());
            for _ in 0..6 {
                engine.step().unwrap();
            }
            let time = 0.1;
            let gravity = glam::Vec3::Y * crate::scene::GRAVITY;
            let turn = glam::Quat::from_scaled_axis(start.angular_velocity * time);
            let expected = State {
                position: start.position + start.velocity * time + gravity * (0.5 * time * time),
                rotation: turn * start.rotation,
                velocity: start.velocity + gravity * time,
                ..start
            };
            // Integrators of first order are off by g t dt / 2 after 0.1 s.
            assert_alike(&expected, &engine.states().unwrap()[0], 0.02, &contender.label());
        }
    }

    fn assert_alike(expected: &State, found: &State, tolerance: f32, who: &str) {
        assert!(expected.position.distance(found.position) < tolerance, "{who}: {expected:?} {found:?}");
        assert!(expected.velocity.distance(found.velocity) < tolerance, "{who}: {expected:?} {found:?}");
        let spin = expected.angular_velocity.distance(found.angular_velocity);
        assert!(spin < tolerance, "{who}: {expected:?} {found:?}");
        assert!(
            expected.rotation.dot(found.rotation).abs() > 1.0 - tolerance * tolerance,
            "{who}: {found:?}"
        );
    }
}
