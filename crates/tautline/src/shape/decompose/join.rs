//! From pieces to fewer.

use std::collections::BTreeMap;

use super::piece::{Piece, excess};
use crate::error::Error;

/// Joins the two pieces that add the least excess, again and again, while there are too many or it is allowed.
pub(super) fn join(pieces: Vec<Piece>, max_parts: usize, allowed: f64) -> Result<Vec<Piece>, Error> {
    let mut pieces: BTreeMap<usize, Piece> = pieces.into_iter().enumerate().collect();
    // What joining a pair adds, by the lower number, then the higher.
    let mut added = BTreeMap::new();
    let mut changed: Vec<usize> = pieces.keys().copied().collect();
    loop {
        for &number in &changed {
            for (&other, piece) in pieces.iter().filter(|&(&other, _)| other != number) {
                let (_, joint) = pieces[&number].joint_hull(piece)?;
                let cost = joint - piece.excess - pieces[&number].excess;
                added.insert([number.min(other), number.max(other)], cost);
            }
        }
        let cheapest = added.iter().min_by(|a, b| a.1.total_cmp(b.1).then(a.0.cmp(b.0)));
        let Some((&[a, b], &cost)) = cheapest else { break };
        if pieces.len() <= max_parts && excess(pieces.values()) + cost > allowed {
            break;
        }
        if let (Some(lower), Some(higher)) = (pieces.remove(&a), pieces.remove(&b)) {
            pieces.insert(a, lower.joined(higher)?);
        }
        added.retain(|pair, _| !pair.contains(&b));
        changed = vec![a];
    }
    Ok(pieces.into_values().collect())
}
