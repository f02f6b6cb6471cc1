//! What moves the particles.

pub(crate) mod paper;
