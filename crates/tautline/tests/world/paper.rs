//! The paper's response to collisions (6), on contacts built by hand. With a tolerance of 50 % no stick is relaxed,
//! so that a step without gravity does nothing but separate.

use tautline::constraint::Stick;
use tautline::mesh::primitives;
use tautline::{BodyHandle, Ordering, Quat, Relaxation, Rope, Settings, Truss, TrussBody, Vec3, World};

use crate::{DT, cube, icosahedron, truss};

fn paper(relaxation: Relaxation) -> Settings {
    Settings { gravity: Vec3::ZERO, sleep: None, relaxation, ..Settings::paper() }
}

fn separation_only() -> Settings {
    paper(Relaxation { tolerance: 0.5, ..Settings::paper().relaxation })
}

fn positions(world: &World, body: BodyHandle) -> Vec<Vec3> {
    world.body(body).unwrap().positions().to_vec()
}

/// Particles of a body, and λᵢ of each.
type Weights = Vec<(usize, f32)>;

/// Σ λᵢ xᵢ
fn point(positions: &[Vec3], weights: &[(usize, f32)]) -> Vec3 {
    weights.iter().map(|&(i, weight)| positions[i] * weight).sum()
}

/// Adds both bodies, steps once, and checks that the given points of their features, pA and pB, have met at
/// q = (m_A p_A + m_B p_B)/(m_A + m_B), that each particle has moved by λᵢ/Σλⱼ² (q − p) (Eq 8, 9), and that nothing
/// else has moved. m is the mass that a feature presents at its point: that of a particle over Σλ².
fn check_separation(bodies: [TrussBody; 2], weights: [&[(usize, f32)]; 2], particle_masses: [f32; 2]) {
    let mut world = World::new(separation_only()).unwrap();
    let handles = bodies.map(|body| world.add(body).unwrap());
    let before = handles.map(|body| positions(&world, body));
    let report = world.step(DT).unwrap();
    assert_eq!((report.contacts, report.relaxations), (1, 0));
    let spread = weights.map(|weights| weights.iter().map(|(_, weight)| weight * weight).sum::<f32>());
    let [p_a, p_b] = [0, 1].map(|side| point(&before[side], weights[side]));
    let [m_a, m_b] = [0, 1].map(|side| particle_masses[side] / spread[side]);
    let q = (p_a * m_a + p_b * m_b) / (m_a + m_b);
    for (side, p) in [p_a, p_b].into_iter().enumerate() {
        let after = positions(&world, handles[side]);
        assert!(point(&after, weights[side]).distance(q) < 1e-6, "side {side} did not reach q");
        for (i, (x, old)) in after.iter().zip(&before[side]).enumerate() {
            let weight = weights[side].iter().find(|(particle, _)| *particle == i).map_or(0.0, |(_, w)| *w);
            let expected = *old + (q - p) * (weight / spread[side]);
            assert!(x.distance(expected) < 1e-6, "particle {i} of side {side}: {x}, expected {expected}");
        }
    }
}

fn particle_at(truss: &Truss, position: Vec3) -> usize {
    truss.rest_positions().iter().position(|x| x.distance(position) < 1e-5).unwrap()
}

/// An octahedron whose face towards (1, 1, 1) meets, at 0.5 λ and 3 cm deep, a vertex of another. In that face
/// λ are the weights of the vertices on x, y and z.
fn vertex_on_face() -> ([TrussBody; 2], Weights, Weights) {
    let shape = truss(primitives::octahedron(0.5).unwrap());
    let (lambda, outward) = (Vec3::new(0.5, 0.3, 0.2), Vec3::ONE.normalize());
    let vertex = |direction: Vec3| particle_at(&shape, direction * 0.5);
    let upper = TrussBody::new(&shape)
        .rotation(Quat::from_rotation_arc(Vec3::Y, outward))
        .position(lambda * 0.5 + outward * (0.5 - 0.03))
        .friction(0.0);
    let face = vec![(vertex(Vec3::X), lambda.x), (vertex(Vec3::Y), lambda.y), (vertex(Vec3::Z), lambda.z)];
    ([TrussBody::new(&shape).friction(0.0), upper], face, vec![(vertex(Vec3::NEG_Y), 1.0)])
}

#[test]
fn a_vertex_and_a_face_meet_at_the_projection_point() {
    let ([lower, upper], face, vertex) = vertex_on_face();
    let mass = 1.0 / 6.0;
    check_separation([lower.clone(), upper.clone()], [&face, &vertex], [mass; 2]);
    check_separation([upper.clone(), lower.clone()], [&vertex, &face], [mass; 2]);
    check_separation([upper.mass(60.0), lower], [&vertex, &face], [10.0, mass]);
}

#[test]
fn two_edges_meet_at_the_projection_point() {
    let shape = cube(1.0);
    let quarter = std::f32::consts::FRAC_PI_4;
    // A has an edge on top along z, B one at the bottom along x; they cross away from their middles.
    let (depth, half_diagonal) = (0.04, 0.5f32.sqrt());
    let lower = TrussBody::new(&shape).rotation(Quat::from_rotation_z(quarter)).friction(0.0);
    let crossing = Vec3::new(0.2, 2.0 * half_diagonal - depth, -0.15);
    let upper =
        TrussBody::new(&shape).rotation(Quat::from_rotation_x(quarter)).position(crossing).friction(0.0);
    let rest = |x: f32, y: f32, z: f32| particle_at(&shape, Vec3::new(x, y, z));
    // Rotated about z by +45°, the corner (½, ½) goes to the top; about x, (−½, ½) of (y, z) to the bottom.
    let top = [(rest(0.5, 0.5, -0.5), 0.5 + 0.15), (rest(0.5, 0.5, 0.5), 0.5 - 0.15)];
    let bottom = [(rest(-0.5, -0.5, 0.5), 0.5 + 0.2), (rest(0.5, -0.5, 0.5), 0.5 - 0.2)];
    check_separation([lower.clone(), upper.clone()], [&top, &bottom], [1.0 / 8.0; 2]);
    check_separation([lower.mass(24.0), upper], [&top, &bottom], [3.0, 1.0 / 8.0]);
}

/// A fixed body has infinite mass: q = p_B, and only A moves.
#[test]
fn a_fixed_body_does_not_give_way() {
    let ([lower, upper], face, vertex) = vertex_on_face();
    let mut world = World::new(separation_only()).unwrap();
    let [fixed, body] = [lower.fixed(), upper].map(|body| world.add(body).unwrap());
    let before = positions(&world, fixed);
    world.step(DT).unwrap();
    assert_eq!(before, positions(&world, fixed));
    let tip = positions(&world, body)[vertex[0].0];
    assert!(tip.distance(point(&before, &face)) < 1e-6, "the tip is at {tip}");
}

/// Eq 11 for two ropes of one segment each: both particles of A move by −d/2, of B by +d/2, with
/// d = ((r_A + r_B)/|c_B − c_A| − 1)(c_B − c_A); r is half the segment and the rope's radius.
#[test]
fn leaf_spheres_are_moved_apart_as_in_equation_11() {
    let mut world = World::new(separation_only()).unwrap();
    let center_b = Vec3::new(0.05, 0.3, 0.02);
    let rope = |center: Vec3, half: Vec3| {
        Rope::straight(center - half, center + half, 1).radius(0.1).friction(0.0).mass(0.7)
    };
    let a = world.add(rope(Vec3::ZERO, Vec3::X * 0.2)).unwrap();
    let b = world.add(rope(center_b, Vec3::Z * 0.15)).unwrap();
    let before = [positions(&world, a), positions(&world, b)];
    world.step(DT).unwrap();
    let reach = (0.2 + 0.1) + (0.15 + 0.1);
    let d = center_b * (reach / center_b.length() - 1.0);
    for (body, old, shift) in [(a, &before[0], d * -0.5), (b, &before[1], d * 0.5)] {
        for (x, old) in positions(&world, body).iter().zip(old) {
            assert!(x.distance(*old + shift) < 1e-6, "{x}, expected {}", *old + shift);
        }
    }
}

/// Barycentric weights of `p` in the top face of `truss` (y greatest) that holds it.
fn weights_in_top_face(truss: &Truss, p: Vec3) -> Weights {
    let rest = truss.rest_positions();
    let mut found = None;
    for triangle in truss.triangles() {
        let [a, b, c] = triangle.map(|v| rest[v as usize]);
        let area = (b - a).cross(c - a);
        let part = |u: Vec3, v: Vec3| (u - p).cross(v - p).dot(area) / area.length_squared();
        let weights = [part(b, c), part(c, a), part(a, b)];
        if area.normalize().y > 0.99 && weights.iter().all(|&weight| weight > 0.0) {
            found = Some((0..3).map(|k| (triangle[k] as usize, weights[k])).collect());
        }
    }
    found.unwrap()
}

/// A segment's centre inside a cube: it leaves by the nearest face, up to its thickness, and both sides move in
/// inverse proportion to the mass they present.
#[test]
fn a_rope_leaves_a_rigid_body_by_its_nearest_face() {
    let mut world = World::new(separation_only()).unwrap();
    let shape = cube(1.0);
    let body = world.add(TrussBody::new(&shape).friction(0.0)).unwrap();
    let center = Vec3::new(0.1, 0.48, 0.3);
    let rope = Rope::straight(center - Vec3::Z * 0.05, center + Vec3::Z * 0.05, 1);
    let rope = world.add(rope.radius(0.03).friction(0.0).mass(0.5)).unwrap();
    let (momentum, before) = (world.momentum(), positions(&world, body));
    world.step(DT).unwrap();
    let weights = weights_in_top_face(&shape, Vec3::new(0.1, 0.5, 0.3));
    let height =
        positions(&world, rope).iter().sum::<Vec3>().y / 2.0 - point(&positions(&world, body), &weights).y;
    assert!((height - 0.03).abs() < 1e-5, "{height} m above the face, expected its radius");
    assert!((world.momentum() - momentum).length() < 1e-5);
    // The rope's point presents 0.25/(½² + ½²) kg, the face's 0.125/Σλ²; together they part by 0.05 m.
    let spread: f32 = weights.iter().map(|(_, weight)| weight * weight).sum();
    let (m_rope, m_face) = (0.5, 0.125 / spread);
    let sunk = point(&before, &weights).y - point(&positions(&world, body), &weights).y;
    assert!((sunk - 0.05 * m_rope / (m_rope + m_face)).abs() < 1e-5, "the face gave way by {sunk} m");
}

/// Relaxes sticks as the paper says, in f64: the oracle for the tests below. Returns visits and relaxations.
fn relax(x: &mut [Vec3], sticks: &[Stick], order: &[usize], tolerance: f64) -> (u64, u64) {
    let mut relaxed = 0;
    for &index in order {
        let Stick { a, b, rest_length } = sticks[index];
        let (a, b) = (a as usize, b as usize);
        let along = (x[b] - x[a]).as_dvec3();
        let stretch = along.length() / f64::from(rest_length) - 1.0;
        if stretch.abs() > tolerance {
            let shift = along * (0.5 * stretch / (1.0 + stretch));
            x[a] = (x[a].as_dvec3() + shift).as_vec3();
            x[b] = (x[b].as_dvec3() - shift).as_vec3();
            relaxed += 1;
        }
    }
    (order.len() as u64, relaxed)
}

/// A ball in a cube, before and after one step with `settings`; and the step's visits and relaxations.
fn collide(settings: Settings) -> (Vec<Vec3>, Vec<Vec3>, (u64, u64)) {
    let mut world = World::new(settings).unwrap();
    world.add(TrussBody::new(&cube(1.0)).fixed()).unwrap();
    let ball = TrussBody::new(&icosahedron(0.5)).position(Vec3::new(0.13, 0.87, 0.21)).friction(0.0);
    let ball = world.add(ball).unwrap();
    let before = positions(&world, ball);
    let report = world.step(DT).unwrap();
    (before, positions(&world, ball), (report.visits, report.relaxations))
}

#[test]
fn a_body_that_collided_is_relaxed_by_the_list_of_the_particle_moved_furthest() {
    let relaxation = Relaxation { sweeps: 1, tolerance: 0.01, ..Settings::paper().relaxation };
    let (before, separated, _) = collide(separation_only());
    let moved = |i: &usize| separated[*i].distance(before[*i]);
    let furthest = (0..before.len()).max_by(|a, b| moved(a).total_cmp(&moved(b))).unwrap();
    let shape = icosahedron(0.5);
    let by_list: Vec<usize> = shape.ordered_list(furthest).iter().map(|&i| i as usize).collect();
    let as_built: Vec<usize> = (0..shape.sticks().len()).collect();
    for (ordering, order) in [(Ordering::ByDistance, by_list), (Ordering::AsBuilt, as_built)] {
        let (_, after, counts) = collide(paper(Relaxation { ordering, ..relaxation }));
        let mut expected = separated.clone();
        let expected_counts = relax(&mut expected, shape.sticks(), &order, 0.01);
        assert_eq!(counts, expected_counts, "{ordering:?}");
        let worst = after.iter().zip(&expected).map(|(x, y)| x.distance(*y)).fold(0.0, f32::max);
        assert!(worst < 1e-6, "{ordering:?}: {worst} m from the oracle");
    }
}

#[test]
fn a_body_that_did_not_collide_is_relaxed_as_built() {
    let stretched = |ordering| {
        let relaxation = Relaxation { sweeps: 1, ordering, ..Settings::paper().relaxation };
        let mut world = World::new(paper(relaxation)).unwrap();
        let body = world.add(TrussBody::new(&icosahedron(0.5))).unwrap();
        world.set_particle_position(body, 3, Vec3::new(0.6, 0.1, -0.4)).unwrap();
        let mut expected = positions(&world, body);
        let report = world.step(DT).unwrap();
        let shape = icosahedron(0.5);
        let as_built: Vec<usize> = (0..shape.sticks().len()).collect();
        let counts = relax(&mut expected, shape.sticks(), &as_built, 0.01);
        assert_eq!((report.visits, report.relaxations), counts);
        let after = positions(&world, body);
        assert!(after.iter().zip(&expected).all(|(x, y)| x.distance(*y) < 1e-6));
        world.state_hash()
    };
    assert_eq!(stretched(Ordering::ByDistance), stretched(Ordering::AsBuilt));
}

/// A stick that is off by less than 1 % is visited and left alone, and sweeping ends after a sweep without work.
#[test]
fn sticks_within_one_per_cent_are_left_alone() {
    for (stretch, relaxations) in [(1.009f32, 0), (1.011, 1)] {
        let mut world = World::new(paper(Settings::paper().relaxation)).unwrap();
        let rope = world.add(Rope::straight(Vec3::ZERO, Vec3::X, 1)).unwrap();
        world.set_particle_position(rope, 1, Vec3::X * stretch).unwrap();
        let report = world.step(DT).unwrap();
        assert_eq!((report.visits, report.relaxations), (1 + relaxations, relaxations), "stretch {stretch}");
    }
}
