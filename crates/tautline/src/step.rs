//! The step, phase by phase.
