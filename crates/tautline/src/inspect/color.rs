//! What is solved side by side.

use crate::body::{Deformable, Substance};
use crate::error::Error;
use crate::settings::ClothSolver;
use crate::solver::soft::colors;
use crate::world::{BodyHandle, World};

impl World {
    /// For each stick of a body its colour, from 0: sticks of one colour share no particle and are relaxed side by side,
    /// colour after colour. Empty where sticks are relaxed one after another or solved otherwise: of trusses and ropes,
    /// and of all that the paper's solver moves.
    ///
    /// # Errors
    /// [`Error::StaleHandle`].
    pub fn stick_colors(&self, handle: BodyHandle) -> Result<Vec<u32>, Error> {
        let body = &self.bodies[self.slots.index(handle)?];
        match &body.substance {
            Substance::Deformable(deformable) if self.settings.cloth == ClothSolver::SmallSteps => {
                Ok(colors_of(deformable))
            }
            _ => Ok(Vec::new()),
        }
    }

    /// Pairs of rigid bodies in contact, each with a number: pairs of one number share no body that moves and are solved
    /// at once. Empty before the first step and after a body has been removed.
    pub fn contact_colors(&self) -> Vec<([BodyHandle; 2], u32)> {
        let count = self.bodies.len() as u32;
        let batches = self.rigid.batches();
        let known = batches.into_iter().filter(|(bodies, _)| bodies.iter().all(|&body| body < count));
        known.map(|(bodies, batch)| (bodies.map(|body| self.slots.handle(body as usize)), batch)).collect()
    }
}

fn colors_of(deformable: &Deformable) -> Vec<u32> {
    let ends = || deformable.sticks.iter().map(|stick| [stick.a, stick.b]);
    match &deformable.grid {
        // Along rows by the column they begin in, then down columns and across cells by the row.
        Some(grid) => ends()
            .map(|[a, b]| {
                let (first, second) = (a.min(b), a.max(b));
                let (column, row) = (first % grid.columns, first / grid.columns);
                match (second / grid.columns - row, second % grid.columns == column) {
                    (0, _) => column % 2,
                    (_, true) => 2 + row % 2,
                    (_, false) => 4 + row % 2,
                }
            })
            .collect(),
        None if deformable.is_chain() || deformable.flesh.is_some() => Vec::new(),
        None => colors(&ends().collect::<Vec<_>>()),
    }
}
