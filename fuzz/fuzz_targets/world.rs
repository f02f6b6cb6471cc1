#![no_main]

#[path = "../src/world/mod.rs"]
mod world;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| world::run(bytes, bytes.len().is_multiple_of(4)));
