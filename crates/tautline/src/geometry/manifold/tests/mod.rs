//! The narrow phase against brute force.

mod distances;
mod faces;
mod meshes;
mod motion;
mod oracle;
mod planes;
mod round;
mod same_bits;
mod shapes;
mod surfaces;

use super::*;
use crate::shape::Face;
use crate::simd::{Instructions, Kernel, run};

/// `collide`, called as the engine does.
struct Collide<'a> {
    a: &'a Convex,
    b: &'a Convex,
    b_in_a: &'a Placement,
    memory: &'a mut Memory,
    margin: f32,
}

impl Kernel for Collide<'_> {
    type Output = Manifold;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Manifold {
        let scratch = &mut Scratch::default();
        collide::<L>(self.a, self.b, self.b_in_a, (self.memory, scratch), self.margin)
    }
}

fn collide_with(a: &Convex, b: &Convex, b_in_a: &Placement, memory: &mut Memory, margin: f32) -> Manifold {
    run(Instructions::Widest, Collide { a, b, b_in_a, memory, margin })
}

impl Manifold {
    fn used(&self) -> &[ManifoldPoint] {
        &self.points[..self.count]
    }

    fn deepest(&self) -> f32 {
        self.used().iter().fold(f32::INFINITY, |least, point| least.min(point.separation))
    }

    fn keys(&self) -> Vec<u32> {
        let mut keys: Vec<u32> = self.used().iter().map(|point| point.key).collect();
        keys.sort_unstable();
        keys
    }

    /// Of the convex hull of the points, projected along the normal, in m².
    fn area(&self) -> f32 {
        let p: Vec<Vec3> = self.used().iter().map(|point| point.on_a).collect();
        let twice = |[i, j, k]: [usize; 3]| self.normal.dot((p[j] - p[i]).cross(p[k] - p[i])).abs();
        match p.len() {
            4 => {
                // The hull is covered twice by the four triangles, also if one point is within the others.
                0.25 * [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].into_iter().map(twice).sum::<f32>()
            }
            3 => 0.5 * twice([0, 1, 2]),
            _ => 0.0,
        }
    }
}

fn collide_new(a: &Convex, b: &Convex, b_in_a: &Placement, margin: f32) -> Manifold {
    collide_with(a, b, b_in_a, &mut Memory::default(), margin)
}
