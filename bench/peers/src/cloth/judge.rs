//! One judge for all engines.

use glam::{Quat, Vec3};
use tautline_scene::judge::{
    Edge, Polytope, Sheet, grid_edges, intersections, rope_edges, rope_pierces, stretch,
};

use super::engine::State;
use super::scene::{CUBE_HALF, ROPE_LENGTH, ROPE_SEGMENTS, SIDE, Start, Support};

/// What is wrong with a state, and how much of it moves.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Verdict {
    /// Length over rest length − 1 of the edges in rows and columns; not a number if a position is not.
    pub(super) max_stretch: f64,
    pub(super) mean_stretch: f64,
    /// Pairs of triangles.
    pub(super) intersections: usize,
    /// Of the particle deepest in the cube, in m.
    pub(super) depth: f64,
    /// Segments of the rope in triangles of the cloth.
    pub(super) rope_pierces: usize,
    /// Of the segment that is stretched most.
    pub(super) rope_stretch: f64,
    /// Over the cloth's particles, in m/s.
    pub(super) mean_speed: f64,
    /// Of the cloth's particles above the floor, in m.
    pub(super) mean_height: f64,
    /// Whether the cloth is still up: higher than half-way to where the rope is lowest, or to the top of the cube.
    pub(super) is_held: bool,
}

/// Judges the states of one scene.
pub(super) struct Judge {
    support: Support,
    edges: Vec<Edge>,
}

impl Judge {
    pub(super) fn new(start: &Start) -> Self {
        let side = f64::from(SIDE);
        Self { support: start.support, edges: grid_edges(start.n, start.n, side, side) }
    }

    pub(super) fn judge(&self, state: &State) -> Verdict {
        let sheet = Sheet { positions: &state.positions, triangles: &state.triangles };
        let stretched = stretch(&state.positions, &self.edges);
        let mean = |values: &[Vec3], of: fn(&Vec3) -> f64| {
            values.iter().map(of).sum::<f64>() / values.len().max(1) as f64
        };
        let mean_height = mean(&state.positions, |p| f64::from(p.y));
        let half_way = 0.5 * self.lowest_support(state);
        let is_on_cube = self.support == Support::Cube;
        let cube = Polytope::cuboid(Vec3::Y * CUBE_HALF, Vec3::splat(CUBE_HALF), Quat::IDENTITY);
        let rope_edges = rope_edges(if is_on_cube { 0 } else { ROPE_SEGMENTS }, ROPE_LENGTH);
        Verdict {
            max_stretch: stretched.max,
            mean_stretch: stretched.mean,
            intersections: intersections(&[sheet]).len(),
            depth: if is_on_cube { cube.deepest(&state.positions) } else { 0.0 },
            rope_pierces: rope_pierces(&state.rope, &[sheet]).len(),
            rope_stretch: stretch(&state.rope, &rope_edges).max,
            mean_speed: mean(&state.velocities, |v| v.as_dvec3().length()),
            mean_height,
            is_held: mean_height > half_way,
        }
    }

    /// The height, in m, of the cube's top or of the rope's lowest particle.
    fn lowest_support(&self, state: &State) -> f64 {
        match self.support {
            Support::Cube => 2.0 * f64::from(CUBE_HALF),
            Support::Rope => state.rope.iter().map(|p| f64::from(p.y)).fold(f64::INFINITY, f64::min),
        }
    }
}

#[cfg(test)]
mod tests {
    use tautline::mesh::primitives;

    use super::*;

    fn flat(start: &Start, height: f32) -> State {
        let grid = primitives::grid(start.n, start.n, SIDE, SIDE).unwrap();
        State {
            positions: grid.positions.iter().map(|&p| p + Vec3::Y * height).collect(),
            velocities: vec![Vec3::new(0.0, 3.0, 4.0); grid.positions.len()],
            triangles: grid.triangles,
            rope: start.rope(),
        }
    }

    #[test]
    fn a_level_cloth_in_the_cube_and_on_the_floor() {
        let start = Start { support: Support::Cube, n: 21, seed: 0 };
        let judge = Judge::new(&start);
        let within = judge.judge(&flat(&start, 0.98));
        assert!((within.depth - 0.02).abs() < 1e-6 && within.max_stretch.abs() < 1e-5, "{within:?}");
        assert_eq!((within.mean_speed, within.intersections, within.is_held), (5.0, 0, true));
        assert!(!judge.judge(&flat(&start, 0.1)).is_held);
    }

    #[test]
    fn a_level_cloth_through_the_rope_is_pierced_twice() {
        let start = Start { support: Support::Rope, n: 20, seed: 0 };
        let judge = Judge::new(&start);
        let verdict = judge.judge(&flat(&start, 2.2));
        assert_eq!((verdict.rope_pierces, verdict.is_held), (2, true), "down at one side, up at the other");
        assert!(verdict.rope_stretch.abs() < 1e-3, "{verdict:?}");
        let mut broken = flat(&start, 0.3);
        broken.positions[7].x = f32::NAN;
        let verdict = judge.judge(&broken);
        assert!(verdict.max_stretch.is_nan() && !verdict.is_held);
    }
}
