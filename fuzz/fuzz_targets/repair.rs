#![no_main]

#[path = "../src/repair.rs"]
mod repair;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| repair::run(bytes));
