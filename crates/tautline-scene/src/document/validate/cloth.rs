//! Judges cloth.

use super::shape::check_surface;
use super::{check_bending_stiffness, check_beyond_paper, check_pin, check_rotation};
use crate::document::check::{
    COEFFICIENT, COORDINATE, Checker, MASS, NOT_NEGATIVE, RATE, SOME_STRAIN, STRAIN, THICKNESS, UP_TO_LARGE,
};
use crate::document::{Cloth, Creep, Pin, SheetPlace, Surface};

pub(super) fn check_cloth(c: &mut Checker, cloth: &Cloth, has_trusses: bool) {
    c.within("surface", |c| check_surface(c, &cloth.surface));
    c.vector("position", &cloth.position, COORDINATE);
    check_rotation(c, &cloth.rotation);
    c.optional("sag", cloth.sag, THICKNESS);
    c.require(cloth.sag.is_none() || matches!(cloth.surface, Surface::Grid { .. }), "sag", || {
        "only a grid is laid out so: give the surface its shape".to_owned()
    });
    c.vector("velocity", &cloth.velocity, COORDINATE);
    let count = match cloth.surface {
        Surface::File(_) => None,
        _ => Some(cloth.surface.vertex_count()),
    };
    check_masses(c, cloth, count);
    check_places(c, cloth, count.unwrap_or(u64::MAX));
    c.number("friction", cloth.friction, NOT_NEGATIVE);
    c.optional("thickness", cloth.thickness, THICKNESS);
    c.optional("bending", cloth.bending, NOT_NEGATIVE);
    check_fabric(c, cloth, count.unwrap_or(u64::MAX), has_trusses);
}

/// `count` is how many particles there are, if that is known.
fn check_masses(c: &mut Checker, cloth: &Cloth, count: Option<u64>) {
    c.number("mass", cloth.mass, MASS);
    c.optional("density", cloth.density, MASS);
    for (k, &mass) in cloth.masses.iter().enumerate() {
        c.number(format_args!("masses[{k}]"), mass, MASS);
    }
    let given = cloth.masses.len() as u64;
    c.require(given == 0 || count.is_none_or(|count| given == count), "masses", || {
        format!("{given} masses are not one for each of {} particles", count.unwrap_or(0))
    });
    c.require(given == 0 || cloth.density.is_none(), "masses", || {
        "there is a density already: give one of the two".to_owned()
    });
}

fn check_places(c: &mut Checker, cloth: &Cloth, count: u64) {
    let is_grid = matches!(cloth.surface, Surface::Grid { .. });
    let check_place = |c: &mut Checker, field: &str, pin: &Pin<SheetPlace>| {
        check_pin(c, field, pin, count);
        if let Pin::Place(place) = pin {
            c.require(is_grid, field, || {
                format!("{} is a place of a grid, and this surface is none: use indices", place_name(place))
            });
        }
    };
    for (k, pin) in cloth.pins.iter().enumerate() {
        check_place(c, &format!("pins[{k}]"), pin);
    }
    for (k, weight) in cloth.weights.iter().enumerate() {
        check_place(c, &format!("weights[{k}].at"), &weight.at);
        c.number(format_args!("weights[{k}].mass"), weight.mass, MASS);
    }
}

/// What it is made of, as only small steps know it.
fn check_fabric(c: &mut Checker, cloth: &Cloth, count: u64, has_trusses: bool) {
    check_bending_stiffness(c, cloth.bending_stiffness, cloth.bending);
    c.optional("compliance", cloth.compliance, UP_TO_LARGE);
    c.optional("shear_compliance", cloth.shear_compliance, UP_TO_LARGE);
    c.require(cloth.shear_compliance.is_none() || cloth.compliance.is_some(), "shear_compliance", || {
        "it is of no use without a compliance".to_owned()
    });
    c.optional("strain_limit", cloth.strain_limit, STRAIN);
    check_wear(c, cloth);
    c.optional("drag", cloth.drag, COEFFICIENT);
    c.optional("lift", cloth.lift, COEFFICIENT);
    c.optional("pressure", cloth.pressure, UP_TO_LARGE);
    for (k, seam) in cloth.seams.iter().enumerate() {
        for (side, &end) in seam.iter().enumerate() {
            check_pin(c, format_args!("seams[{k}][{side}]"), &Pin::<SheetPlace>::Index(end), count);
        }
        c.require(seam[0] != seam[1], format_args!("seams[{k}]"), || {
            "it sews a particle to itself".to_owned()
        });
    }
    let fields = [
        ("bending_stiffness", cloth.bending_stiffness.is_some()),
        ("compliance", cloth.compliance.is_some()),
        ("shear_compliance", cloth.shear_compliance.is_some()),
        ("strain_limit", cloth.strain_limit.is_some()),
        ("tear_at", cloth.tear_at.is_some()),
        ("creep", cloth.creep.is_some()),
        ("drag", cloth.drag.is_some()),
        ("lift", cloth.lift.is_some()),
        ("pressure", cloth.pressure.is_some()),
        ("seams", !cloth.seams.is_empty()),
    ];
    check_beyond_paper(c, &fields, has_trusses);
}

/// What being stretched does to it for good.
fn check_wear(c: &mut Checker, cloth: &Cloth) {
    c.optional("tear_at", cloth.tear_at, SOME_STRAIN);
    if let Some(Creep { yield_strain, rate }) = cloth.creep {
        c.number("creep.yield_strain", yield_strain, STRAIN);
        c.number("creep.rate", rate, RATE);
    }
    let stretches = cloth.compliance.is_some_and(|compliance| compliance > 0.0);
    for (field, is_given) in [("tear_at", cloth.tear_at.is_some()), ("creep", cloth.creep.is_some())] {
        c.require(stretches || !is_given, field, || {
            "it is of no use without a compliance above 0".to_owned()
        });
    }
    let is_reached = cloth.strain_limit.zip(cloth.tear_at).is_none_or(|(limit, strain)| limit > strain);
    c.require(is_reached, "tear_at", || "it is never reached: the strain limit must be greater".to_owned());
}

fn place_name(place: &SheetPlace) -> String {
    serde_json::to_string(place).unwrap_or_default()
}
