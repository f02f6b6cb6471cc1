//! The paper's response to collisions (6): touching features are separated, then the sticks relaxed.

mod relax;
mod separate;

pub(crate) use relax::relax_bodies;
pub(crate) use separate::{Moved, separate};
