//! Finding the overlapping leaves of two sphere trees, or of one tree with itself (paper 5.2).
//!
//! The descent is depth-first by blocks of pairs. A step down depends on the outcome of a test that no processor
//! can predict; within a block the steps do not depend on each other, so that their tests overlap in time, and the
//! stack still stays shallow.

use std::ops::Range;

use crate::geometry::Sphere;

/// Pairs that are descended together.
const BLOCK: usize = 128;
/// Two overlapping spheres are both replaced by their children unless one's radius is more than so many
/// times the other's; then only the larger one is.
const SIMILAR: f32 = 2.0;

/// A binary sphere tree in the node numbering of [`Topology`](super::Topology), whose spheres may be computed
/// as they are asked for.
pub trait SphereHierarchy {
    /// How many leaves there are; at least 1 and at most 2³⁰.
    fn leaf_count(&self) -> usize;

    /// The sphere of a node below `2 * leaf_count - 1`; it contains those of its descendants' features.
    fn sphere(&mut self, node: usize) -> Sphere;
}

/// The pairs of nodes still to be visited: scratch memory to keep from one descent to the next, so that
/// descents allocate nothing once it has grown. It grows to the size of the trees, not to that of what they find.
#[derive(Debug, Clone, Default)]
pub struct DescentStack {
    /// Used up to a height that the descent keeps; what lies beyond is room.
    pairs: Vec<(u32, u32)>,
}

/// Calls `visit(leaf_a, leaf_b)` for every pair of leaves whose spheres overlap, each once, in an order that
/// depends on the spheres alone. Returns how many pairs of spheres were tested.
///
/// With a wrapped tree, whose inner spheres contain the geometry below them but not the spheres, overlapping
/// leaves are left out where an inner sphere already shows that their features are apart.
pub fn descend_pair(
    mut a: impl SphereHierarchy,
    mut b: impl SphereHierarchy,
    stack: &mut DescentStack,
    visit: impl FnMut(usize, usize),
) -> usize {
    let first_leaves = (a.leaf_count() - 1, b.leaf_count() - 1);
    let sphere = |in_a: bool, node| if in_a { a.sphere(node) } else { b.sphere(node) };
    descend(std::iter::once((0, 0)), first_leaves, sphere, stack, visit)
}

/// Calls `visit(leaf, other_leaf)` for every pair of different leaves whose spheres overlap and for which
/// `exclude(leaf, other_leaf)` is false (such as neighbours on a surface, which always overlap), each
/// once, in an order that depends on the spheres alone. Returns how many pairs of spheres were tested.
pub fn descend_self(
    mut tree: impl SphereHierarchy,
    stack: &mut DescentStack,
    mut exclude: impl FnMut(usize, usize) -> bool,
    mut visit: impl FnMut(usize, usize),
) -> usize {
    let first_leaf = tree.leaf_count() - 1;
    // Two leaves part ways at exactly one node, the lowest that contains both.
    let partings = (0..first_leaf as u32).map(|node| (2 * node + 1, 2 * node + 2));
    let sphere = |_, node| tree.sphere(node);
    descend(partings, (first_leaf, first_leaf), sphere, stack, |leaf, other| {
        if !exclude(leaf, other) {
            visit(leaf, other);
        }
    })
}

#[inline(always)]
fn descend(
    starts: impl ExactSizeIterator<Item = (u32, u32)>,
    (first_leaf_a, first_leaf_b): (usize, usize),
    mut sphere: impl FnMut(bool, usize) -> Sphere,
    stack: &mut DescentStack,
    mut visit: impl FnMut(usize, usize),
) -> usize {
    let pairs = &mut stack.pairs;
    let mut tests = starts.len();
    let mut height = 0;
    make_room(pairs, starts.len());
    for (a, b) in starts {
        // Always written, and kept by raising the height: arithmetic instead of a branch.
        pairs[height] = (a, b);
        height += usize::from(sphere(true, a as usize).overlaps(&sphere(false, b as usize)));
    }
    let mut block = [(0, 0); BLOCK];
    while height > 0 {
        let count = height.min(BLOCK);
        height -= count;
        block[..count].copy_from_slice(&pairs[height..height + count]);
        make_room(pairs, height + 4 * count);
        for &(a, b) in &block[..count] {
            let (node_a, node_b) = (a as usize, b as usize);
            let (a_is_leaf, b_is_leaf) = (node_a >= first_leaf_a, node_b >= first_leaf_b);
            if a_is_leaf && b_is_leaf {
                visit(node_a - first_leaf_a, node_b - first_leaf_b);
                continue;
            }
            let (radius_a, radius_b) = (sphere(true, node_a).radius, sphere(false, node_b).radius);
            let split_a = !a_is_leaf && (b_is_leaf || radius_a * SIMILAR >= radius_b);
            // Whatever the radii are, one of the two is split: the descent ends even on spheres that make no sense.
            let split_b = !b_is_leaf && (!split_a || radius_b * SIMILAR >= radius_a);
            for child_a in children(a, split_a) {
                let sphere_a = sphere(true, child_a as usize);
                for child_b in children(b, split_b) {
                    pairs[height] = (child_a, child_b);
                    height += usize::from(sphere_a.overlaps(&sphere(false, child_b as usize)));
                    tests += 1;
                }
            }
        }
    }
    tests
}

fn make_room(pairs: &mut Vec<(u32, u32)>, needed: usize) {
    if pairs.len() < needed {
        pairs.resize(needed, (0, 0));
    }
}

/// The children of a node that is split, otherwise the node itself.
#[inline]
fn children(node: u32, split: bool) -> Range<u32> {
    let first = if split { 2 * node + 1 } else { node };
    first..first + 1 + u32::from(split)
}
