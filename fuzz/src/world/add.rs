//! Bodies of the usual kinds.

use tautline::body::BodyDescription;
use tautline::{Cloth, Error, HalfSpace, RigidBody, Rope, SoftSolid, Vec3};

use super::input::Input;
use super::shapes;

pub(super) fn body(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let (kind, position, size) = (input.byte() % 8, input.vector(), input.number());
    Ok(match kind {
        0 => Cloth::grid(4, 4, size, size).position(position).mass(input.number()).into(),
        1 => Rope::straight(position, input.vector(), 4).radius(size).into(),
        2 => SoftSolid::cuboid(Vec3::splat(size), [1, 1, 1]).position(position).into(),
        3 => HalfSpace::new(position, size).into(),
        _ => rigid(input, position, size)?.into(),
    })
}

fn rigid(input: &mut Input<'_>, position: Vec3, size: f32) -> Result<RigidBody, Error> {
    let kind = input.byte() % 4;
    let length = if kind == 0 { 0.0 } else { input.number() };
    let shape = shapes::shape(kind, &[size, length])?;
    let body = RigidBody::new(&shape).position(position).rotation(input.rotation());
    let body = body.velocity(input.vector()).angular_velocity(input.vector()).mass(input.number());
    Ok(if input.byte().is_multiple_of(8) { body.fixed() } else { body })
}
