//! One judge for all engines, in `f64`: how deep bodies are in each other and in the walls, and how they move.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use crate::icosahedron;
use crate::scene::State;

/// What is wrong with a state, and how much of it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Verdict {
    /// Of all pairs and walls, in m; 0 if nothing penetrates.
    pub(crate) max_depth: f64,
    /// Over the contacts that penetrate, in m; 0 if there are none.
    pub(crate) mean_depth: f64,
    /// Pairs that penetrate, and bodies that penetrate a wall.
    pub(crate) contacts: usize,
    /// Kinetic energy per mass, mean over the bodies, in J/kg.
    pub(crate) energy: f64,
    /// Bodies whose centre is outside the room.
    pub(crate) escaped: usize,
    /// Bodies with a number that is not finite; they count nowhere else.
    pub(crate) non_finite: usize,
}

/// Judges icosahedra in the room [0, side]³.
pub(crate) fn judge(states: &[State], side: f32) -> Verdict {
    let side = f64::from(side);
    let finite: Vec<&State> = states.iter().filter(|state| is_finite(state)).collect();
    let reference = Axes::new();
    let placed: Vec<Placed> = finite.iter().map(|state| Placed::new(state, &reference)).collect();
    let mut depths: Vec<f64> = placed.iter().map(|body| wall_depth(body, side)).collect();
    depths.extend(close_pairs(&placed).into_iter().map(|(a, b)| pair_depth(&placed[a], &placed[b])));
    depths.retain(|&depth| depth > 0.0);
    let outside = |body: &&Placed| body.center.min_element() < 0.0 || body.center.max_element() > side;
    Verdict {
        max_depth: depths.iter().copied().fold(0.0, f64::max),
        mean_depth: mean(&depths),
        contacts: depths.len(),
        energy: mean(&finite.iter().map(|state| energy(state)).collect::<Vec<_>>()),
        escaped: placed.iter().filter(outside).count(),
        non_finite: states.len() - finite.len(),
    }
}

fn is_finite(state: &State) -> bool {
    let vectors = [state.position, state.velocity, state.angular_velocity];
    vectors.iter().all(|vector| vector.is_finite()) && state.rotation.is_finite()
}

fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// ½ v² + ½ (I/m) ω², in J/kg.
fn energy(state: &State) -> f64 {
    let spin = state.angular_velocity.as_dvec3().length_squared();
    0.5 * (state.velocity.as_dvec3().length_squared() + icosahedron::INERTIA_PER_MASS * spin)
}

/// The directions that the separating axis theorem asks for, and what spans the shape.
struct Axes {
    half_vertices: [DVec3; 6],
    face_normals: Vec<DVec3>,
    edge_directions: Vec<DVec3>,
}

impl Axes {
    fn new() -> Self {
        Self {
            half_vertices: icosahedron::half_vertices(),
            face_normals: icosahedron::face_normals(),
            edge_directions: icosahedron::edge_directions(),
        }
    }
}

/// An icosahedron where it is.
struct Placed {
    center: DVec3,
    axes: Axes,
}

impl Placed {
    fn new(state: &State, reference: &Axes) -> Self {
        let [x, y, z, w] = state.rotation.to_array().map(f64::from);
        let rotation = DQuat::from_xyzw(x, y, z, w).normalize();
        let rotated = |vectors: &[DVec3]| vectors.iter().map(|&v| rotation * v).collect();
        let axes = Axes {
            half_vertices: reference.half_vertices.map(|v| rotation * v),
            face_normals: rotated(&reference.face_normals),
            edge_directions: rotated(&reference.edge_directions),
        };
        Self { center: state.position.as_dvec3(), axes }
    }

    /// How far the shape reaches from its centre along a unit vector, and as far against it, in m.
    fn reach(&self, direction: DVec3) -> f64 {
        self.axes.half_vertices.iter().map(|v| v.dot(direction).abs()).fold(0.0, f64::max)
    }
}

/// The deepest of the six walls, in m; negative in the open.
fn wall_depth(body: &Placed, side: f64) -> f64 {
    let reach = DVec3::new(body.reach(DVec3::X), body.reach(DVec3::Y), body.reach(DVec3::Z));
    let below = reach - body.center;
    let above = body.center + reach - DVec3::splat(side);
    below.max(above).max_element()
}

/// The least overlap along the normals of the faces and the products of the edges (separating axis theorem), in m; not
/// above 0 if the two are apart.
fn pair_depth(a: &Placed, b: &Placed) -> f64 {
    let offset = b.center - a.center;
    let normals = a.axes.face_normals.iter().chain(&b.axes.face_normals);
    let products = a.axes.edge_directions.iter().flat_map(|&edge_a| {
        b.axes.edge_directions.iter().filter_map(move |&edge_b| {
            let product = edge_a.cross(edge_b);
            // Parallel edges: a face's normal is as good.
            (product.length_squared() > 1e-8).then(|| product.normalize())
        })
    });
    let mut least = f64::INFINITY;
    for axis in normals.copied().chain(products) {
        least = least.min(a.reach(axis) + b.reach(axis) - axis.dot(offset).abs());
        // Most pairs are apart, and one axis shows it.
        if least <= 0.0 {
            break;
        }
    }
    least
}

/// Pairs whose spheres overlap: a grid whose cells are as wide as a body.
fn close_pairs(bodies: &[Placed]) -> Vec<(usize, usize)> {
    let reach = 2.0 * icosahedron::RADIUS;
    // Clamped, so that what flew away has neighbours too.
    let cell = |body: &Placed| (body.center / reach).to_array().map(|c| c.floor().clamp(-1e15, 1e15) as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (b, body) in bodies.iter().enumerate() {
        let home = cell(body);
        for neighbour in around(home) {
            let found = cells.get(&neighbour).into_iter().flatten();
            pairs.extend(found.filter(|&&a| bodies[a].center.distance(body.center) < reach).map(|&a| (a, b)));
        }
        cells.entry(home).or_default().push(b);
    }
    pairs
}

/// A cell and its 26 neighbours.
fn around(cell: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let near = |coordinate: i64| [coordinate - 1, coordinate, coordinate + 1];
    let [x, y, z] = cell.map(near);
    x.into_iter().flat_map(move |x| y.into_iter().flat_map(move |y| z.into_iter().map(move |z| [x, y, z])))
}

#[cfg(test)]
mod tests {
    use glam::{Quat, Vec3};

    use super::*;
    use crate::scene::{Room, Scene};

    const SIDE: f32 = 10.0;
    const TOLERANCE: f64 = 1e-6;

    fn at(position: Vec3) -> State {
        State { position, rotation: Quat::IDENTITY, velocity: Vec3::ZERO, angular_velocity: Vec3::ZERO }
    }

    fn middle() -> State {
        at(Vec3::splat(0.5 * SIDE))
    }

    /// Distance of a face from the centre: φ² a / (2 √3).
    fn inner_radius() -> f64 {
        let phi = 0.5 * (1.0 + 5f64.sqrt());
        let edge = 1.0 / (1.0 + phi * phi).sqrt();
        phi * phi * edge / (2.0 * 3f64.sqrt())
    }

    #[test]
    fn face_to_face_the_depth_is_twice_the_inner_radius_less_the_distance() {
        let normal = icosahedron::face_normals()[3];
        for overlap in [0.001, 0.02, 0.1] {
            let other = at(middle().position + (normal * (2.0 * inner_radius() - overlap)).as_vec3());
            let verdict = judge(&[middle(), other], SIDE);
            assert_eq!(verdict.contacts, 1);
            assert!((verdict.max_depth - overlap).abs() < TOLERANCE, "{overlap}: {}", verdict.max_depth);
            assert_eq!(verdict.mean_depth, verdict.max_depth);
        }
        let apart = at(middle().position + (normal * (2.0 * inner_radius() + 0.001)).as_vec3());
        assert_eq!(judge(&[middle(), apart], SIDE).contacts, 0);
    }

    /// Turned by 90° about the line of centres, opposite edges cross at right angles: no face's normal separates them.
    #[test]
    fn crossed_edges_are_judged_along_the_product_of_the_edges() {
        // The middle of an edge lies on each coordinate axis, φ/√(1 + φ²) R from the centre.
        let half = icosahedron::half_vertices().iter().map(|v| v.x.abs()).fold(0.0, f64::max);
        for overlap in [-0.001, 0.001, 0.01] {
            let other = State {
                position: middle().position + Vec3::X * (2.0 * half - overlap) as f32,
                rotation: Quat::from_rotation_x(std::f32::consts::FRAC_PI_2),
                ..middle()
            };
            let verdict = judge(&[middle(), other], SIDE);
            assert!((verdict.max_depth - overlap.max(0.0)).abs() < TOLERANCE, "{overlap}: {verdict:?}");
        }
    }

    #[test]
    fn a_vertex_and_a_face_in_a_wall() {
        let vertex = icosahedron::half_vertices()[0].normalize().as_vec3();
        let face = icosahedron::face_normals()[0].as_vec3();
        for (down, reach) in [(vertex, icosahedron::RADIUS), (face, inner_radius())] {
            let depth = 0.003;
            let rotation = Quat::from_rotation_arc(down, Vec3::NEG_Y);
            let floor = State { position: Vec3::new(5.0, (reach - depth) as f32, 5.0), rotation, ..middle() };
            let verdict = judge(&[floor], SIDE);
            assert_eq!((verdict.contacts, verdict.escaped), (1, 0));
            assert!((verdict.max_depth - depth).abs() < TOLERANCE, "{verdict:?}");
            let wall = State {
                position: Vec3::new(5.0, 5.0, SIDE - (reach - depth) as f32),
                rotation: Quat::from_rotation_arc(down, Vec3::Z),
                ..middle()
            };
            let both = judge(&[floor, wall], SIDE);
            assert_eq!(both.contacts, 2);
            assert!((both.mean_depth - depth).abs() < TOLERANCE, "{both:?}");
        }
    }

    #[test]
    fn energy_is_that_of_translation_and_spin() {
        let moving =
            State { velocity: Vec3::X * 2.0, angular_velocity: Vec3::new(0.0, 3.0, 4.0), ..middle() };
        let expected = 0.5 * 4.0 + 0.5 * icosahedron::INERTIA_PER_MASS * 25.0;
        assert!((judge(&[moving], SIDE).energy - expected).abs() < 1e-9);
        let far = at(Vec3::ONE);
        assert!((judge(&[moving, far], SIDE).energy - 0.5 * expected).abs() < 1e-9);
    }

    #[test]
    fn what_left_and_what_is_no_number_is_counted() {
        let lost = at(Vec3::new(5.0, -3.0, 5.0));
        let far = at(Vec3::splat(1e30));
        let broken = State { velocity: Vec3::NAN, ..middle() };
        let verdict = judge(&[middle(), lost, far, broken], SIDE);
        assert_eq!((verdict.escaped, verdict.non_finite), (2, 1));
        assert!(verdict.max_depth.is_finite() && verdict.energy == 0.0);
    }

    #[test]
    fn the_grid_finds_every_close_pair_once() {
        let mut bodies = Scene::read(Room::Dense, 200).unwrap().bodies;
        // Drawn together, so that most cells hold several.
        bodies.iter_mut().for_each(|body| body.position *= 0.6);
        let reference = Axes::new();
        let placed: Vec<Placed> = bodies.iter().map(|body| Placed::new(body, &reference)).collect();
        let mut expected = Vec::new();
        for b in 0..placed.len() {
            let close = |&a: &usize| placed[a].center.distance(placed[b].center) < 1.0;
            expected.extend((0..b).filter(close).map(|a| (a, b)));
        }
        let mut found = close_pairs(&placed);
        found.sort_unstable();
        expected.sort_unstable();
        assert!(expected.len() > 500);
        assert_eq!(found, expected);
    }
}
