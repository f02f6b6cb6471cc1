//! What moves the particles.
