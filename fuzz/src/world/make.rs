//! Bodies with everything that can be said of them.

use std::f32::consts::PI;

use tautline::body::{BodyDescription, Corner};
use tautline::mesh::primitives;
use tautline::{
    Cloth, CollisionGroups, Combine, Error, HalfSpace, RigidBody, Rope, SoftSolid, Surface, TrussBody, Vec3,
};

use super::input::Input;
use super::shapes;

pub(super) fn body(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    match input.byte() % 8 {
        0 => cloth(input),
        1 => rope(input),
        2 => soft_solid(input),
        3 => truss(input),
        4 => half_space(input),
        _ => rigid(input),
    }
}

pub(super) fn surface(input: &mut Input<'_>) -> Surface {
    let [friction, restitution, rolling_friction] = input.numbers();
    let rules =
        [Combine::GeometricMean, Combine::Average, Combine::Minimum, Combine::Multiply, Combine::Maximum];
    let (friction_rule, restitution_rule) = (input.one_of(rules), input.one_of(rules));
    Surface { friction, restitution, rolling_friction, friction_rule, restitution_rule }
}

pub(super) fn groups(input: &mut Input<'_>) -> CollisionGroups {
    CollisionGroups { memberships: u32::from(input.byte()), filter: u32::from(input.byte()) }
}

fn rigid(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let kind = input.byte() % 10;
    let numbers: &[f32] = match kind {
        0 | 8 => &input.numbers::<1>(),
        1..=3 | 7 | 9 => &input.numbers::<2>(),
        4 => &input.numbers::<15>(),
        5 => &input.numbers::<7>(),
        _ => &input.numbers::<9>(),
    };
    let shape = shapes::shape(kind, numbers)?;
    let body = RigidBody::new(&shape).position(input.vector()).rotation(input.rotation());
    let body = match input.byte() % 4 {
        0 => body.fixed(),
        1 => body.kinematic().velocity(input.vector()).angular_velocity(input.vector()),
        2 => body.density(input.number()).velocity(input.vector()),
        _ => body.never_sleep(),
    };
    let body = if input.flag() { body.report_contacts() } else { body };
    Ok(match input.byte() % 4 {
        0 => body.gravity_scale(input.number()).damping(input.number(), input.number()),
        1 => body.surface(surface(input)),
        2 => body.groups(groups(input)),
        _ => body,
    }
    .into())
}

fn cloth(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let cloth = match input.byte() % 4 {
        0 => Cloth::from_mesh(primitives::octahedron(input.number())?).pressure(input.number()),
        1 => Cloth::from_mesh(primitives::tetrahedron(input.number())?).seam(input.index(), input.index()),
        2 => Cloth::grid(3, 2, 1.0, input.number()).pin_corner(Corner::First).sag(input.number()),
        _ => Cloth::grid(2, 2, input.number(), 1.0).pin(input.index()).masses(input.numbers::<9>().into()),
    };
    let cloth = cloth.position(input.vector()).rotation(input.rotation());
    let cloth = match input.byte() % 8 {
        0 => cloth.drag(input.number()).lift(input.number()),
        1 => cloth.bending(input.number()).thickness(input.number()),
        2 => cloth.bending_stiffness(input.number()).density(input.number()),
        3 => cloth.compliance(input.number()).shear_compliance(input.number()),
        4 => cloth.strain_limit(input.number()).friction(input.number()),
        5 => cloth.tear_at(input.number()).velocity(input.vector()),
        6 => cloth.creep(input.number(), input.number()),
        _ => cloth.self_collision(false),
    };
    Ok(cloth.into())
}

fn rope(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let rope = match input.byte() % 3 {
        0 => Rope::through(input.vectors::<4>().into()).pin(input.index()),
        1 => Rope::straight(input.vector(), input.vector(), 3).pin_ends(),
        _ => {
            let segments = vec![[0, 1], [1, 2], [1, 3], [3, input.index() % 5]];
            Rope::network(input.vectors::<4>().into(), segments)
        }
    };
    Ok(match input.byte() % 8 {
        0 => rope.length(input.number()),
        1 => rope.velocity(input.vector()).mass(input.number()),
        2 => rope.radius(input.number()).friction(input.number()),
        3 => rope.bending(input.number()),
        4 => rope.bending_stiffness(input.number()),
        5 => rope.compliance(input.number()),
        6 => rope.bend_limit(input.number() * PI),
        _ => rope.self_collision(false),
    }
    .into())
}

fn soft_solid(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let solid = match input.byte() % 2 {
        0 => SoftSolid::cuboid(input.vector(), [2, 1, 1]),
        _ => SoftSolid::from_mesh(primitives::tetrahedron(input.number())?),
    };
    let solid = solid.position(input.vector()).rotation(input.rotation());
    Ok(match input.byte() % 8 {
        0 => solid.velocity(input.vector()).angular_velocity(input.vector()),
        1 => solid.density(input.number()),
        2 => solid.mass(input.number()).friction(input.number()),
        3 => solid.young_modulus(input.number() * 1e5).poisson_ratio(input.number()),
        4 => solid.thickness(input.number()),
        5 => solid.pin(input.index()),
        6 => solid.self_collision(true),
        _ => solid,
    }
    .into())
}

fn truss(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let truss = shapes::truss(input.byte() % 2, input.number())?;
    let body = TrussBody::new(&truss).position(input.vector()).rotation(input.rotation());
    Ok(match input.byte() % 4 {
        0 => body.fixed(),
        1 => body.velocity(input.vector()).angular_velocity(input.vector()),
        2 => body.mass(input.number()).friction(input.number()),
        _ => body,
    }
    .into())
}

fn half_space(input: &mut Input<'_>) -> Result<BodyDescription, Error> {
    let ground = HalfSpace::new(Vec3::Y + 0.1 * input.vector(), input.number());
    Ok(ground.surface(surface(input)).into())
}
