//! The tautline command line.
fn main() {}
