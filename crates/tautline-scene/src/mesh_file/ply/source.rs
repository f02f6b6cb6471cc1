//! Numbers one after another, as text or binary.

use super::super::Refusal;
use super::super::refusal::quoted;
use super::header::{Element, Kind};

/// Where the numbers of a file come from.
pub(super) trait Source {
    /// Refuses an element whose count the rest of the file cannot hold.
    fn check_room(&self, element: &Element) -> Result<(), Refusal>;

    /// The next number, which must be whole.
    fn integer(&mut self, kind: Kind) -> Result<i64, Refusal>;

    /// The next number, which must be finite.
    fn coordinate(&mut self, kind: Kind) -> Result<f32, Refusal>;

    /// Passes over numbers.
    fn skip(&mut self, kind: Kind, count: usize) -> Result<(), Refusal>;

    /// Refuses what was read last.
    fn refuse(&self, message: String) -> Refusal;

    /// How many entries a list has that the rest of the file can hold.
    fn length(&mut self, kind: Kind) -> Result<usize, Refusal> {
        let length = self.integer(kind)?;
        let most = self.remaining();
        let within = usize::try_from(length).ok().filter(|&length| length <= most);
        within
            .ok_or_else(|| self.refuse(format!("a list of {length} entries in the {most} bytes that remain")))
    }

    /// Bytes that remain, at most.
    fn remaining(&self) -> usize;
}

/// Refuses rows that take more than the bytes that remain.
pub(super) fn check_room(element: &Element, row: usize, remaining: usize) -> Result<(), String> {
    match element.repeats().checked_mul(row) {
        Some(needed) if needed <= remaining => Ok(()),
        _ => Err(format!(
            "it announces {} elements {}, which do not fit in the {remaining} bytes that remain",
            element.count,
            quoted(&element.name)
        )),
    }
}
