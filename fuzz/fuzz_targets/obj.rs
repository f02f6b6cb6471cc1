#![no_main]

use libfuzzer_sys::fuzz_target;
use tautline_scene::mesh_file::Format;

fuzz_target!(|bytes: &[u8]| tautline_fuzz::read_mesh(bytes, Format::Obj));
