//! The scenes that every engine is given: icosahedra in a cubical room.

use std::fs;
use std::path::Path;

use clap::ValueEnum;
use glam::{Quat, Vec3};

use crate::Failure;

/// Seconds of a step.
pub(crate) const STEP: f32 = 1.0 / 60.0;
/// Coulomb's coefficient of friction, of bodies and walls. Nothing bounces.
pub(crate) const FRICTION: f32 = 0.5;
/// In m/s², along Y.
pub(crate) const GRAVITY: f32 = -9.81;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

/// How much room the bodies have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Room {
    /// They end as a pile, many layers deep.
    Dense,
    /// Twice as wide: they end in one to three layers on the floor.
    Wide,
}

/// A body: where it is and how it moves, in world coordinates (m, m/s, rad/s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct State {
    /// Of the centre of mass.
    pub(crate) position: Vec3,
    pub(crate) rotation: Quat,
    pub(crate) velocity: Vec3,
    pub(crate) angular_velocity: Vec3,
}

/// Icosahedra of radius 0.5 m and mass 1 kg in the room [0, side]³.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scene {
    /// Of the room, in m.
    pub(crate) side: f32,
    pub(crate) bodies: Vec<State>,
}

/// A solid box in the axes of the room, in m.
pub(crate) struct Wall {
    pub(crate) center: Vec3,
    pub(crate) half_extents: Vec3,
}

impl Scene {
    /// The scene of `n` bodies.
    pub(crate) fn read(room: Room, n: usize) -> Result<Self, Failure> {
        let prefix = match room {
            Room::Dense => "e1d",
            Room::Wide => "e1",
        };
        let path = Path::new(FOLDER).join(format!("{prefix}_{n}.txt"));
        let text = fs::read_to_string(&path)
            .map_err(|error| format!("no scene of {n} bodies: {}: {error}", path.display()))?;
        Self::parse(&text).map_err(|problem| format!("{}: {problem}", path.display()).into())
    }

    fn parse(text: &str) -> Result<Self, Failure> {
        let mut lines = text.lines();
        let [n, side] = numbers(lines.next().unwrap_or_default())?;
        let bodies = lines.map(body).collect::<Result<Vec<_>, _>>()?;
        if bodies.len() as f32 != n {
            return Err(format!("{n} bodies are announced, {} are there", bodies.len()).into());
        }
        Ok(Self { side, bodies })
    }

    /// Six boxes around the room, 2 m thick, for engines that have no half-spaces or are slower with them.
    pub(crate) fn walls(&self) -> impl Iterator<Item = Wall> {
        let half = 0.5 * self.side;
        [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [-axis, axis]).map(move |outwards| Wall {
            center: Vec3::splat(half) + outwards * (half + 1.0),
            half_extents: Vec3::splat(half + 1.0) - outwards.abs() * half,
        })
    }
}

fn body(line: &str) -> Result<State, Failure> {
    let [px, py, pz, qx, qy, qz, qw, vx, vy, vz, wx, wy, wz] = numbers(line)?;
    Ok(State {
        position: Vec3::new(px, py, pz),
        rotation: Quat::from_xyzw(qx, qy, qz, qw).normalize(),
        velocity: Vec3::new(vx, vy, vz),
        angular_velocity: Vec3::new(wx, wy, wz),
    })
}

fn numbers<const COUNT: usize>(line: &str) -> Result<[f32; COUNT], Failure> {
    let numbers = line.split_whitespace().map(str::parse).collect::<Result<Vec<f32>, _>>()?;
    numbers.try_into().map_err(|_| format!("{line:?} is not {COUNT} numbers").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_can_be_read_and_starts_inside_its_room() {
        for (room, side_per_root) in [(Room::Dense, 1.25), (Room::Wide, 2.5)] {
            for n in [200, 1000, 4000] {
                let scene = Scene::read(room, n).unwrap();
                assert_eq!(scene.bodies.len(), n);
                assert!((scene.side - side_per_root * (n as f32).cbrt()).abs() < 1e-4);
                let inside = |body: &State| {
                    body.position.min_element() > 0.5 && body.position.max_element() < scene.side - 0.5
                };
                assert!(scene.bodies.iter().all(inside));
            }
        }
    }

    #[test]
    fn walls_enclose_the_room_and_leave_it_free() {
        let scene = Scene { side: 6.0, bodies: Vec::new() };
        let solid_at = |point: Vec3| {
            let holds = |wall: &Wall| ((point - wall.center).abs() - wall.half_extents).max_element() < 0.0;
            scene.walls().filter(holds).count()
        };
        assert_eq!(solid_at(Vec3::splat(3.0)), 0);
        assert_eq!(solid_at(Vec3::new(0.01, 5.99, 0.01)), 0);
        assert_eq!(solid_at(Vec3::new(-0.01, 3.0, 3.0)), 1);
        assert_eq!(solid_at(Vec3::new(3.0, 7.99, 0.1)), 1);
    }

    #[test]
    fn a_scene_that_is_cut_off_is_refused() {
        let body = "1 1 1 0 0 0 1 0 0 0 0 0 0";
        assert!(Scene::parse(&format!("1 3.0\n{body}\n")).is_ok());
        assert!(Scene::parse(&format!("2 3.0\n{body}\n")).is_err());
        assert!(Scene::parse("1 3.0\n1 1 1 0\n").is_err());
        assert!(Scene::parse("").is_err());
    }
}
