//! How deep points are inside a convex solid.

use tautline::{DVec3, Quat, Vec3};

use super::Sheet;

/// A convex solid, as the planes of its faces. [`tautline::World::penetration`] measures solids in solids; this
/// measures the particles of a cloth or a rope in one.
#[derive(Debug, Clone, PartialEq)]
pub struct Polytope {
    faces: Vec<Face>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Face {
    /// Unit, outwards.
    normal: DVec3,
    /// Of the plane along the normal, in m.
    offset: f64,
}

impl Polytope {
    /// Inside a convex closed surface, counter-clockwise seen from outside. Triangles without area, or with a corner
    /// that is missing or not finite, bound nothing;
    /// without any face, every point is infinitely deep inside.
    pub fn inside(surface: Sheet<'_>) -> Self {
        let face = |&triangle: &[u32; 3]| {
            let [a, b, c] = surface.corners(triangle)?.map(Vec3::as_dvec3);
            let normal = (b - a).cross(c - a).try_normalize()?;
            Some(Face { normal, offset: normal.dot(a) })
        };
        Self { faces: surface.triangles.iter().filter_map(face).collect() }
    }

    /// A box: its middle and half extents, in m, and its rotation.
    pub fn cuboid(center: Vec3, half_extents: Vec3, rotation: Quat) -> Self {
        let faces = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]).map(|axis| {
            let normal = (rotation * axis).as_dvec3().normalize();
            let reach = f64::from(half_extents.dot(axis.abs()));
            Face { normal, offset: normal.dot(center.as_dvec3()) + reach }
        });
        Self { faces: faces.collect() }
    }

    /// How far a point (m) is from the nearest face, in m: above 0 inside. Outside it is at most the distance, negative.
    pub fn depth(&self, point: Vec3) -> f64 {
        let point = point.as_dvec3();
        self.faces.iter().map(|face| face.offset - face.normal.dot(point)).fold(f64::INFINITY, f64::min)
    }

    /// The depth of the deepest of some points (m), in m; 0 if none is inside. Points that are not finite are not.
    pub fn deepest(&self, points: &[Vec3]) -> f64 {
        points.iter().filter(|p| p.is_finite()).map(|&point| self.depth(point)).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use tautline::mesh::primitives;

    use super::*;

    #[test]
    fn a_box_and_its_mesh_agree_and_the_nearest_face_counts() {
        let mesh = primitives::cuboid(Vec3::new(0.5, 1.0, 1.5)).unwrap();
        let meshed = Polytope::inside(Sheet { positions: &mesh.positions, triangles: &mesh.triangles });
        let boxed = Polytope::cuboid(Vec3::ZERO, Vec3::new(0.5, 1.0, 1.5), Quat::IDENTITY);
        let points = [
            (Vec3::ZERO, 0.5),
            (Vec3::new(0.4, 0.0, 0.0), 0.1),
            (Vec3::new(0.0, -0.97, 1.4), 0.03),
            (Vec3::new(0.0, 1.25, 0.0), -0.25),
        ];
        for (point, depth) in points {
            assert!((meshed.depth(point) - depth).abs() < 1e-6, "{point}");
            assert!((boxed.depth(point) - depth).abs() < 1e-6, "{point}");
        }
        assert!((boxed.deepest(&points.map(|(point, _)| point)) - 0.5).abs() < 1e-6);
        assert_eq!(boxed.deepest(&[Vec3::Y * 2.0, Vec3::NAN]), 0.0);
    }

    #[test]
    fn a_turned_box_far_from_the_origin() {
        let center = Vec3::new(3.0, 0.5, -2.0);
        let turn = Quat::from_rotation_y(std::f32::consts::FRAC_PI_4);
        let solid = Polytope::cuboid(center, Vec3::splat(0.5), turn);
        // A corner of the box points along x.
        let corner = 0.5 * 2f32.sqrt();
        assert!(solid.depth(center + Vec3::X * corner).abs() < 1e-6);
        let expected = 0.1 * 0.5f64.sqrt();
        assert!((solid.depth(center + Vec3::X * (corner - 0.1)) - expected).abs() < 1e-6);
    }
}
