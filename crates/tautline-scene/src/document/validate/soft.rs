//! Judges soft solids.

use super::shape::check_shape;
use super::{NOT_OF_TRUSSES, check_mass_or_density, check_rotation};
use crate::document::check::{COORDINATE, Checker, MODULUS, NOT_NEGATIVE, POISSON_RATIO, THICKNESS};
use crate::document::{Shape, SoftSolid};

/// Most cells along an axis.
const MOST_CELLS: u32 = 256;
/// Of a tetrahedron.
const LEAST_TRIANGLES: u32 = 4;

pub(super) fn check_soft_solid(c: &mut Checker, solid: &SoftSolid, has_trusses: bool) {
    c.require(!has_trusses, "shape", || NOT_OF_TRUSSES.to_owned());
    // As a truss it has one closed surface.
    c.within("shape", |c| check_shape(c, &solid.shape, true));
    if let Some(cells) = solid.cells {
        let is_box = matches!(solid.shape, Shape::Box { .. });
        c.require(is_box, "cells", || "only a box is divided in cells".to_owned());
        for (k, count) in cells.into_iter().enumerate() {
            c.count(format_args!("cells[{k}]"), count, 1, MOST_CELLS);
        }
    }
    if let Some(count) = solid.coarse_triangles {
        let is_box = matches!(solid.shape, Shape::Box { .. });
        c.require(!is_box, "coarse_triangles", || "a box is divided in cells".to_owned());
        c.count("coarse_triangles", count, LEAST_TRIANGLES, u32::MAX);
    }
    c.vector("position", &solid.position, COORDINATE);
    check_rotation(c, &solid.rotation);
    c.vector("velocity", &solid.velocity, COORDINATE);
    c.vector("angular_velocity", &solid.angular_velocity, COORDINATE);
    check_mass_or_density(c, solid.mass, solid.density);
    c.number("young_modulus", solid.young_modulus, MODULUS);
    c.number("poisson_ratio", solid.poisson_ratio, POISSON_RATIO);
    c.number("friction", solid.friction, NOT_NEGATIVE);
    c.optional("thickness", solid.thickness, THICKNESS);
}
