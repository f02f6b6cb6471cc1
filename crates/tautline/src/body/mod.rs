//! Builders of bodies: each turns a description into particles, constraints and geometry.
