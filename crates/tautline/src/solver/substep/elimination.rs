//! Linear equations over a graph of bodies, or of bodies and joints, solved exactly by eliminating one after the other.
//!
//! The matrix has a block of 6 × 6 for each node, and for each edge. Symmetric elimination (LDLᵀ) is exact in any order
//! of the blocks if the matrix is definite, as that of bodies that lean on each other is. That of bodies and joints,
//! [M Jᵀ; J −σ] with M and σ positive, is quasi-definite (Vanderbei 1995): exact as long as a joint comes after one of
//! its bodies. The block with the fewest neighbours goes next (minimum degree), so that chains and trees cost as much as
//! they have bodies (Baraff 1996, Linear-time dynamics using Lagrange multipliers); loops fill in a few blocks more. f64,
//! since heavy on light is ill-conditioned.

use std::collections::{BTreeMap, BTreeSet};

use crate::order::PutInOrder;

/// A block, by rows.
pub(super) type Block = [[f64; 6]; 6];
/// A part of a vector.
pub(super) type Part = [f64; 6];

pub(super) const ZERO: Block = [[0.0; 6]; 6];

/// In which order blocks are eliminated, and what that changes.
#[derive(Debug, Clone, Default)]
pub(super) struct Plan {
    steps: Vec<Step>,
    /// Of each edge which block it is, and whether that is the transposed one: its rows are those of the first node.
    pub(super) blocks: Vec<(u32, bool)>,
    lower_count: usize,
}

#[derive(Debug, Clone)]
struct Step {
    node: u32,
    /// What is left and touches it: the node, and the block with its rows and this node's columns.
    neighbours: Vec<(u32, u32)>,
    /// For every two of the neighbours the block between them, row by row.
    targets: Vec<u32>,
}

/// The matrix; factored, the inverses of the pivots and L.
#[derive(Debug, Clone, Default)]
pub(super) struct Matrix {
    /// By node.
    pub(super) diagonal: Vec<Block>,
    pub(super) lower: Vec<Block>,
}

impl Plan {
    /// For a graph of so many nodes with these edges, each named as (column, row). Nodes from `eager` on are not
    /// eliminated before one of their neighbours is.
    pub(super) fn new(node_count: usize, eager: usize, edges: &[[u32; 2]]) -> Self {
        let order = order(node_count, eager, edges);
        let mut rank = vec![0; order.len()];
        for (position, (node, _)) in order.iter().enumerate() {
            rank[*node] = position;
        }
        let mut blocks = BTreeMap::new();
        let mut steps = Vec::with_capacity(order.len());
        for (node, mut neighbours) in order {
            neighbours.put_in_order_by_key(|&other| rank[other]);
            for &other in &neighbours {
                let next = blocks.len() as u32;
                blocks.insert((other, node), next);
            }
            steps.push((node, neighbours));
        }
        let step = |(node, neighbours): &(usize, Vec<usize>)| {
            let rows = neighbours.iter().enumerate();
            let pairs = rows.flat_map(|(i, &row)| neighbours[..i].iter().map(move |&column| (row, column)));
            let targets = pairs.map(|pair| blocks[&pair]).collect();
            let neighbours =
                neighbours.iter().map(|&other| (other as u32, blocks[&(other, *node)])).collect();
            Step { node: *node as u32, neighbours, targets }
        };
        let steps: Vec<Step> = steps.iter().map(step).collect();
        let block = |edge: &[u32; 2]| {
            let [column, row] = edge.map(|node| node as usize);
            let is_transposed = rank[row] < rank[column];
            let pair = if is_transposed { (column, row) } else { (row, column) };
            (blocks[&pair], is_transposed)
        };
        let edges = edges.iter().map(block).collect();
        Self { steps, blocks: edges, lower_count: blocks.len() }
    }
}

/// The nodes in the order of elimination, each with the neighbours it has by then.
fn order(node_count: usize, eager: usize, edges: &[[u32; 2]]) -> Vec<(usize, Vec<usize>)> {
    let mut adjacent = vec![BTreeSet::new(); node_count];
    for [a, b] in edges.iter().map(|edge| edge.map(|node| node as usize)) {
        adjacent[a].insert(b);
        adjacent[b].insert(a);
    }
    // The others join the queue with the first of their neighbours.
    let mut is_queued: Vec<bool> = (0..node_count).map(|node| node < eager).collect();
    let mut queue = BTreeSet::new();
    queue.extend((0..eager).map(|node| (adjacent[node].len(), node)));
    let mut order = Vec::with_capacity(node_count);
    while let Some((_, node)) = queue.pop_first() {
        let neighbours = std::mem::take(&mut adjacent[node]);
        for &other in &neighbours {
            queue.remove(&(adjacent[other].len(), other));
            adjacent[other].extend(neighbours.iter().filter(|&&third| third != other));
            adjacent[other].remove(&node);
            is_queued[other] |= node < eager;
            if is_queued[other] {
                queue.insert((adjacent[other].len(), other));
            }
        }
        order.push((node, neighbours.into_iter().collect()));
    }
    order
}

impl Matrix {
    /// Zero, of the size of a plan.
    pub(super) fn clear(&mut self, plan: &Plan) {
        self.diagonal.clear();
        self.diagonal.resize(plan.steps.len(), ZERO);
        self.lower.clear();
        self.lower.resize(plan.lower_count, ZERO);
    }

    pub(super) fn factor(&mut self, plan: &Plan) {
        for step in &plan.steps {
            let inverse = inverse(self.diagonal[step.node as usize]);
            self.diagonal[step.node as usize] = inverse;
            let mut targets = step.targets.iter();
            for (i, &(row, block)) in step.neighbours.iter().enumerate() {
                let factor = product(&self.lower[block as usize], &inverse);
                for (&(_, column), &target) in step.neighbours[..i].iter().zip(targets.by_ref()) {
                    // The columns before are factored already: A = L D, and L A'ᵀ = A L'ᵀ.
                    let (lower, other) = (&self.lower[block as usize], &self.lower[column as usize]);
                    let change = product_transposed(lower, other);
                    subtract(&mut self.lower[target as usize], &change);
                }
                let change = product_transposed(&self.lower[block as usize], &factor);
                subtract(&mut self.diagonal[row as usize], &change);
                self.lower[block as usize] = factor;
            }
        }
    }

    /// Turns the right-hand side, by node, into the solution.
    pub(super) fn solve(&self, plan: &Plan, vector: &mut [Part]) {
        for step in &plan.steps {
            let part = vector[step.node as usize];
            for &(row, block) in &step.neighbours {
                let change = applied(&self.lower[block as usize], &part);
                subtract_part(&mut vector[row as usize], &change);
            }
            vector[step.node as usize] = applied(&self.diagonal[step.node as usize], &part);
        }
        for step in plan.steps.iter().rev() {
            let mut part = vector[step.node as usize];
            for &(row, block) in &step.neighbours {
                let change = applied_transposed(&self.lower[block as usize], &vector[row as usize]);
                subtract_part(&mut part, &change);
            }
            vector[step.node as usize] = part;
        }
    }
}

fn subtract(block: &mut Block, change: &Block) {
    for (row, change) in block.iter_mut().zip(change) {
        subtract_part(row, change);
    }
}

fn subtract_part(part: &mut Part, change: &Part) {
    for (number, change) in part.iter_mut().zip(change) {
        *number -= change;
    }
}

fn product(a: &Block, b: &Block) -> Block {
    let mut out = ZERO;
    for (out, a) in out.iter_mut().zip(a) {
        for (factor, row) in a.iter().zip(b) {
            for (out, number) in out.iter_mut().zip(row) {
                *out += factor * number;
            }
        }
    }
    out
}

/// a bᵀ.
fn product_transposed(a: &Block, b: &Block) -> Block {
    product(a, &transposed(b))
}

pub(super) fn transposed(a: &Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

pub(super) fn applied(a: &Block, part: &Part) -> Part {
    a.map(|row| dot(&row, part))
}

pub(super) fn applied_transposed(a: &Block, part: &Part) -> Part {
    let mut out = [0.0; 6];
    for (row, factor) in a.iter().zip(part) {
        for (out, number) in out.iter_mut().zip(row) {
            *out += number * factor;
        }
    }
    out
}

fn dot(a: &Part, b: &Part) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

/// By Gauss and Jordan, which needs no pivoting for a definite block.
fn inverse(mut a: Block) -> Block {
    for k in 0..6 {
        let pivot = 1.0 / a[k][k];
        a[k][k] = 1.0;
        a[k] = a[k].map(|number| number * pivot);
        let row = a[k];
        for (_, other) in a.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = std::mem::replace(&mut other[k], 0.0);
            for (number, own) in other.iter_mut().zip(&row) {
                *number -= factor * own;
            }
        }
    }
    a
}
