//! From pieces to fewer.

use std::ops::Range;

use super::piece::{Piece, excess};
use crate::error::Error;

/// Joins the two pieces that add the least excess, again and again, while there are too many or it is allowed.
pub(super) fn join(pieces: Vec<Piece>, max_parts: usize, allowed: f64) -> Result<Vec<Piece>, Error> {
    // Two that are joined take the place of the first of them.
    let mut pieces: Vec<Option<Piece>> = pieces.into_iter().map(Some).collect();
    let mut added = Vec::new();
    for number in 0..pieces.len() {
        add_pairs(&pieces, number, 0..number, &mut added)?;
    }
    loop {
        let cheapest = added.iter().min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let Some(&([a, b], cost)) = cheapest else { break };
        let left = || pieces.iter().flatten();
        if left().count() <= max_parts && excess(left()) + cost > allowed {
            break;
        }
        if let (Some(lower), Some(higher)) = (pieces[a].take(), pieces[b].take()) {
            pieces[a] = Some(lower.joined(higher)?);
        }
        added.retain(|(pair, _)| !pair.contains(&a) && !pair.contains(&b));
        add_pairs(&pieces, a, 0..pieces.len(), &mut added)?;
    }
    Ok(pieces.into_iter().flatten().collect())
}

/// Lists what joining a piece with each of the others adds, by the lower number, then the higher.
fn add_pairs(
    pieces: &[Option<Piece>],
    number: usize,
    others: Range<usize>,
    added: &mut Vec<([usize; 2], f64)>,
) -> Result<(), Error> {
    let Some(piece) = &pieces[number] else { return Ok(()) };
    for other in others.filter(|&other| other != number) {
        let Some(partner) = &pieces[other] else { continue };
        let (_, joint) = piece.joint_hull(partner)?;
        added.push(([number.min(other), number.max(other)], joint - partner.excess - piece.excess));
    }
    Ok(())
}
