//! A tree of boxes over triangles that never move.

use glam::Vec3;

/// Most triangles of a leaf.
const LEAF: usize = 4;

/// Nodes in the order of a walk that visits the lower half first; a node that is passed over says where the walk
/// goes on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// The triangles of leaf after leaf.
    order: Vec<u32>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    low: Vec3,
    high: Vec3,
    /// The node after all those below this one.
    skip: u32,
    /// Where a leaf's triangles begin in `order`.
    first: u32,
    /// How many a leaf has; 0 for other nodes.
    count: u32,
}

impl Tree {
    /// Splits at the median of the longest side; O(n log n).
    pub(super) fn new(triangles: &[[Vec3; 3]]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..triangles.len() as u32).collect() };
        tree.add(triangles, 0, triangles.len());
        tree
    }

    /// The subtree over a range of `order`, which is sorted on the way. Its depth is the logarithm of the count.
    fn add(&mut self, triangles: &[[Vec3; 3]], start: usize, end: usize) {
        let range = &mut self.order[start..end];
        let (low, high) = range
            .iter()
            .map(|&t| bounds(&triangles[t as usize]))
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), (l, h)| (low.min(l), high.max(h)));
        let number = self.nodes.len();
        let is_leaf = range.len() <= LEAF;
        let count = if is_leaf { range.len() as u32 } else { 0 };
        self.nodes.push(Node { low, high, skip: 0, first: start as u32, count });
        if is_leaf {
            range.sort_unstable();
        } else {
            let size = high - low;
            let axis = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
            let middle = |t: u32| triangles[t as usize].iter().map(|corner| corner[axis]).sum::<f32>();
            let half = range.len() / 2;
            range.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
            self.add(triangles, start, start + half);
            self.add(triangles, start + half, end);
        }
        self.nodes[number].skip = self.nodes.len() as u32;
    }

    /// Its box: the lower and the upper corner.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        self.nodes.first().map_or((Vec3::ZERO, Vec3::ZERO), |root| (root.low, root.high))
    }

    /// Calls `found` with every triangle of the leaves whose box, and all boxes around it, `touches` accepts (given
    /// the lower and the upper corner).
    pub(super) fn search(&self, mut touches: impl FnMut(Vec3, Vec3) -> bool, mut found: impl FnMut(u32)) {
        let mut number = 0;
        while let Some(node) = self.nodes.get(number) {
            if touches(node.low, node.high) {
                let first = node.first as usize;
                self.order[first..first + node.count as usize].iter().for_each(|&triangle| found(triangle));
                number += 1;
            } else {
                number = node.skip as usize;
            }
        }
    }
}

/// The box around a triangle: its lower and its upper corner.
pub(super) fn bounds(&[a, b, c]: &[Vec3; 3]) -> (Vec3, Vec3) {
    (a.min(b).min(c), a.max(b).max(c))
}
