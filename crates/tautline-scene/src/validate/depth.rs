//! How deep convex bodies are in each other, in `f64`: a judge of its own, which shares nothing with the engine's
//! collision detection.

use tautline::{BodyHandle, DVec3, Error, Shape, World};

use super::lab::{pose, turned};

/// A convex polytope, by what the separating axis theorem asks for.
#[derive(Debug, Clone)]
pub(super) struct Polytope {
    vertices: Vec<DVec3>,
    face_normals: Vec<DVec3>,
    edge_directions: Vec<DVec3>,
    radius: f64,
}

impl Polytope {
    /// Of a shape that is one polytope, in the shape's own frame.
    pub(super) fn new(shape: &Shape) -> Self {
        let vertices: Vec<DVec3> = shape.positions().iter().map(|p| p.as_dvec3()).collect();
        let (mut face_normals, mut edge_directions) = (Vec::new(), Vec::new());
        for triangle in shape.triangles() {
            let [a, b, c] = triangle.map(|vertex| vertices[vertex as usize]);
            let normal = (b - a).cross(c - a).normalize();
            if face_normals.iter().all(|known: &DVec3| known.dot(normal) < ALIKE) {
                face_normals.push(normal);
            }
            // A diagonal of a flat face adds an axis that is not needed, and does no harm.
            for edge in [b - a, c - b, a - c].map(DVec3::normalize) {
                if edge_directions.iter().all(|known: &DVec3| known.dot(edge).abs() < ALIKE) {
                    edge_directions.push(edge);
                }
            }
        }
        let radius = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
        Self { vertices, face_normals, edge_directions, radius }
    }

    /// Where a body is now.
    pub(super) fn placed(&self, world: &World, body: BodyHandle) -> Result<Placed, Error> {
        let (position, rotation) = pose(world, body)?;
        let turn = |vectors: &[DVec3]| vectors.iter().map(|&v| turned(rotation, v)).collect::<Vec<_>>();
        Ok(Placed {
            position,
            radius: self.radius,
            vertices: self.vertices.iter().map(|&v| position + turned(rotation, v)).collect(),
            face_normals: turn(&self.face_normals),
            edge_directions: turn(&self.edge_directions),
        })
    }
}

/// Cosines above this are of one direction.
const ALIKE: f64 = 1.0 - 1e-9;

/// A polytope in the world.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) position: DVec3,
    radius: f64,
    vertices: Vec<DVec3>,
    face_normals: Vec<DVec3>,
    edge_directions: Vec<DVec3>,
}

impl Placed {
    /// How deep its deepest point is below a plane (unit normal, offset along it), in m; negative above.
    pub(super) fn depth_below(&self, normal: DVec3, offset: f64) -> f64 {
        self.vertices.iter().map(|v| offset - v.dot(normal)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// How deep it is in another, in m: the least overlap along any face's normal or product of edges. Not above 0
    /// if they are apart.
    pub(super) fn depth_in(&self, other: &Self) -> f64 {
        let offset = other.position - self.position;
        let mut least = self.radius + other.radius - offset.length();
        if least <= 0.0 {
            return least;
        }
        let normals = self.face_normals.iter().chain(&other.face_normals).copied();
        let products =
            self.edge_directions.iter().flat_map(|a| other.edge_directions.iter().map(|b| a.cross(*b)));
        // Parallel edges: a face's normal is as good.
        let products = products.filter(|product| product.length_squared() > 1e-8).map(DVec3::normalize);
        for axis in normals.chain(products) {
            // The axis from this one to the other.
            let axis = if axis.dot(offset) < 0.0 { -axis } else { axis };
            let reach = |vertices: &[DVec3], axis: DVec3| {
                vertices.iter().map(|v| v.dot(axis)).fold(f64::NEG_INFINITY, f64::max)
            };
            least = least.min(reach(&self.vertices, axis) + reach(&other.vertices, -axis));
            // Most pairs are apart, and one axis shows it.
            if least <= 0.0 {
                break;
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use tautline::{Quat, RigidBody, Settings, Vec3};

    use super::*;
    use crate::validate::lab::cube;

    fn placed(position: Vec3, rotation: Quat) -> Placed {
        let shape = cube(1.0).unwrap();
        let mut world = World::new(Settings::default()).unwrap();
        let body = world.add(RigidBody::new(&shape).position(position).rotation(rotation)).unwrap();
        Polytope::new(&shape).placed(&world, body).unwrap()
    }

    #[test]
    fn cubes_face_to_face_corner_first_and_edge_on_edge() {
        let home = placed(Vec3::ZERO, Quat::IDENTITY);
        let depth = |other: &Placed| home.depth_in(other);
        assert!((depth(&placed(Vec3::Y * 0.99, Quat::IDENTITY)) - 0.01).abs() < 1e-6);
        assert!(depth(&placed(Vec3::Y * 1.01, Quat::IDENTITY)) < 0.0);
        let corner_down = Quat::from_rotation_arc(Vec3::ONE.normalize(), Vec3::NEG_Y);
        let half_diagonal = 0.75f32.sqrt();
        assert!((depth(&placed(Vec3::Y * (0.5 + half_diagonal - 0.02), corner_down)) - 0.02).abs() < 1e-6);
        // Two edges crossing at right angles, both √½ from their cubes' centres.
        let edge_up = placed(Vec3::ZERO, Quat::from_rotation_z(std::f32::consts::FRAC_PI_4));
        let edge_down = Quat::from_rotation_x(std::f32::consts::FRAC_PI_4);
        let other = placed(Vec3::Y * (2f32.sqrt() - 0.03), edge_down);
        assert!((edge_up.depth_in(&other) - 0.03).abs() < 1e-6);
    }

    #[test]
    fn a_turned_cube_below_a_plane() {
        let cube = placed(Vec3::Y * 0.7, Quat::from_rotation_z(std::f32::consts::FRAC_PI_4));
        assert!((cube.depth_below(DVec3::Y, 0.0) - (0.5f64.sqrt() - 0.7)).abs() < 1e-6);
    }
}
