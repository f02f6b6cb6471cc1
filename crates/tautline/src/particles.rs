//! The particle store.
