//! The narrow phase against brute force.

mod distances;
mod oracle;
mod shapes;

use super::*;
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

fn collide_new(a: &Convex, b: &Convex, b_in_a: &Placement, margin: f32) -> Manifold {
    collide_with(a, b, b_in_a, &mut Memory::default(), margin)
}
