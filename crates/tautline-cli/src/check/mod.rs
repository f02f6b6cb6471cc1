//! `tautline check`: every problem of a scene or mesh file.

mod mesh;
mod scene;
mod table;

use tautline_scene::mesh_file::Format;

use crate::args::Check;
use crate::failure::Failure;

pub(crate) fn check(arguments: &Check) -> Result<(), Failure> {
    if Format::of(&arguments.file).is_some() {
        return mesh::check(arguments);
    }
    for (option, value) in [("--repair", &arguments.repair), ("--picture", &arguments.picture)] {
        if value.is_some() {
            let file = arguments.file.display();
            return Err(Failure::Usage(format!("{option} is for mesh files, which {file} is not")));
        }
    }
    scene::check(arguments)
}
