//! Judges shapes and meshes.

use super::{NOT_OF_TRUSSES, check_rotation};
use crate::document::check::{COORDINATE, Checker, LENGTH};
use crate::document::{MeshFile, MeshSource, PartOfCompound, Shape, Surface, limits};

pub(super) fn check_shape(c: &mut Checker, shape: &Shape, is_truss: bool) {
    match shape {
        Shape::Box { size } => c.vector("box.size", size, LENGTH),
        Shape::Tetrahedron { radius } => c.number("tetrahedron.radius", *radius, LENGTH),
        Shape::Sphere { radius } => c.number("sphere.radius", *radius, LENGTH),
        Shape::Octahedron { radius } => c.number("octahedron.radius", *radius, LENGTH),
        Shape::Dodecahedron { radius } => c.number("dodecahedron.radius", *radius, LENGTH),
        Shape::Icosahedron { radius } => c.number("icosahedron.radius", *radius, LENGTH),
        Shape::Icosphere { radius, subdivisions } => c.within("icosphere", |c| {
            c.number("radius", *radius, LENGTH);
            c.count("subdivisions", *subdivisions, 0, 8);
        }),
        Shape::UvSphere { radius, segments, rings } => c.within("uv_sphere", |c| {
            c.number("radius", *radius, LENGTH);
            c.count("segments", *segments, 3, 1000);
            c.count("rings", *rings, 2, 1000);
        }),
        Shape::Capsule { radius, height, segments, rings } => c.within("capsule", |c| {
            c.number("radius", *radius, LENGTH);
            c.number("height", *height, LENGTH);
            c.optional_count("segments", *segments, 3, 1000);
            c.optional_count("rings", *rings, 1, 1000);
        }),
        Shape::Cylinder { radius, height, segments } => c.within("cylinder", |c| {
            c.number("radius", *radius, LENGTH);
            c.number("height", *height, LENGTH);
            c.optional_count("segments", *segments, 3, 1000);
        }),
        Shape::Torus { radius, tube_radius, segments, tube_segments } => c.within("torus", |c| {
            c.number("radius", *radius, LENGTH);
            c.number("tube_radius", *tube_radius, LENGTH);
            c.require(tube_radius < radius, "tube_radius", || {
                format!("{tube_radius} leaves no hole: it must be below the radius {radius}")
            });
            c.count("segments", *segments, 3, 1000);
            c.count("tube_segments", *tube_segments, 3, 1000);
        }),
        Shape::Hull { points } => {
            c.points("hull.points", points);
            c.require(points.len() >= 4, "hull.points", || {
                format!("{} points span no volume: at least 4, not all in one plane", points.len())
            });
        }
        Shape::Mesh(mesh) => check_mesh(c, mesh),
        Shape::File(file) => check_file(c, file),
        Shape::Compound { parts } => {
            refuse_of_truss(c, "compound", is_truss);
            check_parts(c, parts, is_truss);
        }
        Shape::Surface(surface) => {
            refuse_of_truss(c, "surface", is_truss);
            c.within("surface", |c| check_surface(c, surface));
        }
        Shape::HeightField { columns, rows, cell_size, heights } => {
            refuse_of_truss(c, "height_field", is_truss);
            c.within("height_field", |c| check_heights(c, (*columns, *rows), *cell_size, heights));
        }
    }
}

fn refuse_of_truss(c: &mut Checker, shape: &str, is_truss: bool) {
    c.require(!is_truss, shape, || NOT_OF_TRUSSES.to_owned());
}

fn check_parts(c: &mut Checker, parts: &[PartOfCompound], is_truss: bool) {
    c.require(!parts.is_empty(), "compound.parts", || "there are none".to_owned());
    for (k, part) in parts.iter().enumerate() {
        c.within(format_args!("compound.parts[{k}]"), |c| {
            c.within("shape", |c| check_shape(c, &part.shape, is_truss));
            c.require(part.shape.is_solid(), "shape", || "it has no inside, and so no mass".to_owned());
            c.vector("position", &part.position, COORDINATE);
            check_rotation(c, &part.rotation);
        });
    }
}

fn check_heights(c: &mut Checker, (columns, rows): (u32, u32), cell_size: f32, heights: &[f32]) {
    c.count("columns", columns, 2, 2049);
    c.count("rows", rows, 2, 2049);
    c.number("cell_size", cell_size, LENGTH);
    let count = u64::from(columns) * u64::from(rows);
    c.require(heights.len() as u64 == count, "heights", || {
        format!("there are {}, and {columns} columns of {rows} rows are {count}", heights.len())
    });
    c.vector("heights", heights, COORDINATE);
}

pub(super) fn check_surface(c: &mut Checker, surface: &Surface) {
    match surface {
        Surface::Grid { columns, rows, width, depth } => c.within("grid", |c| {
            c.count("columns", *columns, 2, limits::PARTICLES as u32 / 2);
            c.count("rows", *rows, 2, limits::PARTICLES as u32 / 2);
            c.number("width", *width, LENGTH);
            c.number("depth", *depth, LENGTH);
        }),
        Surface::Mesh(mesh) => check_mesh(c, mesh),
        Surface::File(file) => check_file(c, file),
    }
}

/// Numbers and indices only: what is wrong with the surface as a whole is found where it is built.
fn check_mesh(c: &mut Checker, mesh: &MeshSource) {
    let count = mesh.positions.len();
    c.within("mesh", |c| {
        c.points("positions", &mesh.positions);
        c.require(!mesh.triangles.is_empty(), "triangles", || "there are none".to_owned());
        for (i, triangle) in mesh.triangles.iter().enumerate() {
            for (k, &vertex) in triangle.iter().enumerate() {
                c.require((vertex as usize) < count, format_args!("triangles[{i}][{k}]"), || {
                    format!("{vertex} is the index of no position: there are {count}")
                });
            }
        }
    });
}

fn check_file(c: &mut Checker, file: &MeshFile) {
    c.within("file", |c| {
        c.number("scale", file.scale, LENGTH);
        c.require(!file.path.is_empty(), "path", || "it is empty".to_owned());
    });
}
