#![no_main]

#[path = "../src/distance.rs"]
mod distance;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| distance::run(bytes));
