//! Finding the overlapping leaves of two sphere trees, or of one tree with itself (paper 5.2).

use crate::geometry::Sphere;

/// A binary sphere tree in the node numbering of [`Topology`](super::Topology), whose spheres may be computed
/// as they are asked for.
pub trait SphereHierarchy {
    /// How many leaves there are; at least 1.
    fn leaf_count(&self) -> usize;

    /// The sphere of a node below `2 * leaf_count - 1`; it contains those of its descendants' features.
    fn sphere(&mut self, node: usize) -> Sphere;
}

/// The pairs of nodes still to be visited: scratch memory to keep from one descent to the next, so that
/// descents allocate nothing once it has grown.
#[derive(Debug, Clone, Default)]
pub struct DescentStack {
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
    mut visit: impl FnMut(usize, usize),
) -> usize {
    let first_leaves = (a.leaf_count() - 1, b.leaf_count() - 1);
    let sphere = |in_a: bool, node| if in_a { a.sphere(node) } else { b.sphere(node) };
    descend((0, 0), first_leaves, sphere, stack, &mut visit)
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
    let mut visit_unless_excluded = |leaf, other| {
        if !exclude(leaf, other) {
            visit(leaf, other);
        }
    };
    let mut tests = 0;
    // Two leaves part ways at exactly one node, the lowest that contains both.
    for parting in 0..first_leaf {
        let children = (2 * parting as u32 + 1, 2 * parting as u32 + 2);
        let sphere = |_, node| tree.sphere(node);
        tests += descend(children, (first_leaf, first_leaf), sphere, stack, &mut visit_unless_excluded);
    }
    tests
}

/// Descends from one pair of nodes, always into the larger of two overlapping spheres. Only overlapping pairs
/// are put on the stack, which so never holds more than one pair per level of either tree.
#[inline(always)]
fn descend(
    start: (u32, u32),
    (first_leaf_a, first_leaf_b): (usize, usize),
    mut sphere: impl FnMut(bool, usize) -> Sphere,
    stack: &mut DescentStack,
    visit: &mut impl FnMut(usize, usize),
) -> usize {
    let mut tests = 1;
    stack.pairs.clear();
    if sphere(true, start.0 as usize).overlaps(&sphere(false, start.1 as usize)) {
        stack.pairs.push(start);
    }
    while let Some((a, b)) = stack.pairs.pop() {
        let (node_a, node_b) = (a as usize, b as usize);
        let (a_is_leaf, b_is_leaf) = (node_a >= first_leaf_a, node_b >= first_leaf_b);
        if a_is_leaf && b_is_leaf {
            visit(node_a - first_leaf_a, node_b - first_leaf_b);
            continue;
        }
        let (sphere_a, sphere_b) = (sphere(true, node_a), sphere(false, node_b));
        tests += 2;
        // The right child goes on the stack first, so that the left one is descended first.
        if b_is_leaf || (!a_is_leaf && sphere_a.radius >= sphere_b.radius) {
            for child in [2 * a + 2, 2 * a + 1] {
                if sphere(true, child as usize).overlaps(&sphere_b) {
                    stack.pairs.push((child, b));
                }
            }
        } else {
            for child in [2 * b + 2, 2 * b + 1] {
                if sphere(false, child as usize).overlaps(&sphere_a) {
                    stack.pairs.push((a, child));
                }
            }
        }
    }
    tests
}
