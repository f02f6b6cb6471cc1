//! The equations of a stack: (M + Jᵀ K J) Δv = Jᵀ K (t − J v), over the rows that are held.
//!
//! K is so stiff that what is left of t − J v does not matter; the multipliers change by K (t − J (v + Δv)).

use super::super::elimination::{Block, Matrix, Part, Plan, ZERO, transposed};
use super::contact::{Contact, Hold, Point};
use crate::order::PutInOrder;

#[derive(Debug, Clone)]
pub(super) struct System {
    plan: Plan,
    matrix: Matrix,
    /// By place, in 1/kg.
    inverse_masses: Vec<f64>,
    /// How many of the places are solved for.
    solved: usize,
    /// Of each contact the edge between its bodies, if it is between two that are solved for.
    edges: Vec<Option<u32>>,
    /// The rows for which the matrix is factored.
    factored: Option<Vec<Hold>>,
}

impl System {
    pub(super) fn new(inverse_masses: Vec<f64>, solved: usize, contacts: &[Contact]) -> Self {
        let inner = |contact: &Contact| {
            let [a, b] = contact.ends;
            ((a.max(b) as usize) < solved).then_some([a.min(b), a.max(b)])
        };
        let mut edges: Vec<[u32; 2]> = contacts.iter().filter_map(inner).collect();
        edges.put_in_order();
        edges.dedup();
        let edge = |contact: &Contact| {
            inner(contact).map(|ends| edges.partition_point(|other| *other < ends) as u32)
        };
        let of_contacts = contacts.iter().map(edge).collect();
        let plan = Plan::new(solved, solved, &edges);
        let matrix = Matrix::default();
        Self { plan, matrix, inverse_masses, solved, edges: of_contacts, factored: None }
    }

    pub(super) fn solved(&self) -> usize {
        self.solved
    }

    /// Of what is solved for, in kg.
    pub(super) fn masses(&self) -> impl Iterator<Item = f64> {
        self.inverse_masses[..self.solved].iter().map(|inverse_mass| 1.0 / inverse_mass)
    }

    /// 1/m, then 1 three times; nothing if it is not solved for.
    pub(super) fn inverse_mass(&self, place: u32) -> Part {
        let m = self.inverse_masses[place as usize];
        if (place as usize) < self.solved { [m, m, m, 1.0, 1.0, 1.0] } else { [0.0; 6] }
    }

    /// Makes the matrix for the rows that are held now, unless it is there.
    pub(super) fn factor(&mut self, contacts: &[Contact]) {
        let held = contacts.iter().flat_map(|contact| contact.points.iter().map(|point| point.hold));
        if self.factored.as_ref().is_some_and(|factored| factored.iter().copied().eq(held.clone())) {
            return;
        }
        self.factored = Some(held.collect());
        self.matrix.clear(&self.plan);
        for (diagonal, inverse_mass) in self.matrix.diagonal.iter_mut().zip(&self.inverse_masses) {
            for (k, row) in diagonal.iter_mut().enumerate() {
                row[k] = if k < 3 { 1.0 / inverse_mass } else { 1.0 };
            }
        }
        for (contact, edge) in contacts.iter().zip(&self.edges) {
            let [of_a, of_b, between] = blocks(contact);
            let [a, b] = contact.ends.map(|end| end as usize);
            for (end, block) in [(a, of_a), (b, of_b)] {
                if end < self.solved {
                    add(&mut self.matrix.diagonal[end], &block);
                }
            }
            if let Some(edge) = *edge {
                let (index, is_transposed) = self.plan.blocks[edge as usize];
                // The edge's column is the lower of both; `between` has b's rows.
                let is_turned = (a > b) != is_transposed;
                let block = if is_turned { transposed(&between) } else { between };
                add(&mut self.matrix.lower[index as usize], &block);
            }
        }
        self.matrix.factor(&self.plan);
    }

    /// Turns the right-hand side, by place, into the change of velocities.
    pub(super) fn solve(&self, vector: &mut [Part]) {
        self.matrix.solve(&self.plan, &mut vector[..self.solved]);
    }
}

fn add(block: &mut Block, other: &Block) {
    for (row, other) in block.iter_mut().zip(other) {
        row.iter_mut().zip(other).for_each(|(number, other)| *number += other);
    }
}

/// k a aᵀ, k b bᵀ and k b aᵀ, summed over the rows that are held.
fn blocks(contact: &Contact) -> [Block; 3] {
    let mut blocks = [ZERO; 3];
    for ([a, b], _) in contact.points.iter().flat_map(Point::held_rows) {
        for (block, (left, right)) in blocks.iter_mut().zip([(a, a), (b, b), (b, a)]) {
            for (row, factor) in block.iter_mut().zip(left) {
                let factor = factor * contact.stiffness;
                row.iter_mut().zip(right).for_each(|(number, other)| *number += factor * other);
            }
        }
    }
    blocks
}
