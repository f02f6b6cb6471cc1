//! What moves bodies: the paper's solver, for particles held by sticks, and that of rigid bodies in substeps.

pub(crate) mod paper;
pub(crate) mod soft;
pub(crate) mod substep;
