//! Which things touch. Moves nothing.
