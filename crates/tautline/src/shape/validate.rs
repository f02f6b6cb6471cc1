//! Whether a shape from untrusted bytes is one that the constructors could have made.

use glam::{DMat3, DVec3, Vec3};

use super::mass::Frame;
use super::polytope::{MAX_CORNERS, flatness};
use super::{Convex, Part, Shape};
use crate::error::Error;
use crate::mesh::TriMesh;
use crate::norm::Norm;
use crate::order::PutInOrder;

/// How many times the tolerance under which triangles become one face a face may be out of flatness.
const SLACK: f64 = 4.0;

impl Shape {
    /// Refuses numbers that do not fit together. Surfaces and the groups of eight are made anew when bytes are read, so
    /// only what is stored can be wrong.
    pub(crate) fn validate(&self) -> Result<(), Error> {
        if let Some(surface) = &self.surface {
            return ensure("surface", *self == Self::hollow(surface.clone()));
        }
        ensure("parts", !self.parts.is_empty())?;
        for (number, part) in self.parts.iter().enumerate() {
            ensure(&format!("parts[{number}]"), part.convex.is_sound())?;
        }
        let (reach, inner_radius) = Part::extent_of(&self.parts);
        ensure("volume", self.volume.is_finite() && self.volume > 0.0)?;
        ensure("second_moments", are_principal(self.second_moments))?;
        ensure("frame", self.frame.is_sound())?;
        ensure("reach", self.reach == reach)?;
        ensure("inner_radius", self.inner_radius == inner_radius)?;
        ensure("hull_excess", (0.0..=f32::MAX).contains(&self.hull_excess))?;
        ensure("hull_shortfall", (0.0..=f32::MAX).contains(&self.hull_shortfall))?;
        ensure("display", is_drawable(&self.display))
    }
}

fn ensure(part: &str, sound: bool) -> Result<(), Error> {
    if sound {
        return Ok(());
    }
    let problem = "it does not fit the rest of the shape".into();
    Err(Error::Invalid { field: format!("shape.{part}"), problem })
}

/// Positive and descending.
fn are_principal(moments: DVec3) -> bool {
    let [x, y, z] = moments.to_array();
    let descending = |a: f64, b: f64| b <= a * (1.0 + 1e-5);
    moments.is_finite() && z > 0.0 && descending(x, y) && descending(y, z)
}

fn is_drawable(mesh: &TriMesh) -> bool {
    let count = mesh.positions.len();
    mesh.positions.iter().all(|position| position.is_finite())
        && mesh.triangles.iter().flatten().all(|&vertex| (vertex as usize) < count)
}

impl Frame {
    /// Whether its axes are a rotation.
    fn is_sound(&self) -> bool {
        let product = self.axes.transpose() * self.axes;
        self.center.abs().cmple(DVec3::splat(4e9)).all()
            && product.abs_diff_eq(DMat3::IDENTITY, 1e-9)
            && self.axes.determinant() > 0.0
    }
}

/// A side of a face.
#[derive(Clone, Copy)]
struct Side {
    start: u16,
    end: u16,
    face: usize,
    /// The corner of the face after `end`.
    after: u16,
}

impl Convex {
    pub(super) fn is_sound(&self) -> bool {
        let finite = |point: &Vec3| point.abs().cmple(Vec3::splat(4e9)).all();
        let numbers = (0.0..=1e9).contains(&self.radius) && self.vertices.iter().all(finite);
        if self.faces.is_empty() {
            let round = matches!(self.vertices.len(), 1 | 2) && self.radius > 0.0;
            return numbers && round && self.loops.is_empty();
        }
        numbers
            && self.vertices.len() <= MAX_CORNERS
            && self.has_consecutive_loops()
            && self.faces_are_flat()
            && self.is_closed_and_convex()
    }

    /// Every face has three corners or more, they stand one face after the other, and name vertices.
    fn has_consecutive_loops(&self) -> bool {
        let mut next = 0;
        for face in &self.faces {
            if face.first as usize != next || face.count < 3 {
                return false;
            }
            next += face.count as usize;
        }
        next == self.loops.len() && self.loops.iter().all(|&vertex| (vertex as usize) < self.vertices.len())
    }

    fn tolerance(&self) -> f64 {
        SLACK * f64::from(flatness(&self.vertices))
    }

    fn height(&self, face: usize, vertex: u16) -> f64 {
        let normal = self.faces[face].normal.as_dvec3();
        normal.dot(self.vertices[vertex as usize].as_dvec3()) - f64::from(self.faces[face].offset)
    }

    fn faces_are_flat(&self) -> bool {
        let tolerance = self.tolerance();
        self.faces.iter().enumerate().all(|(number, face)| {
            (face.normal.norm() - 1.0).abs() < 1e-5
                && self.corners(*face).all(|(vertex, _)| self.height(number, vertex).abs() <= tolerance)
        })
    }

    fn sides(&self) -> Vec<Side> {
        let mut sides = Vec::with_capacity(self.loops.len());
        for (number, face) in self.faces.iter().enumerate() {
            let corners = &self.loops[face.first as usize..(face.first + face.count) as usize];
            let corner = |place: usize| corners[place % corners.len()];
            sides.extend((0..corners.len()).map(|place| Side {
                start: corner(place),
                end: corner(place + 1),
                face: number,
                after: corner(place + 2),
            }));
        }
        sides.put_in_order_by_key(|side| (side.start, side.end));
        sides
    }

    /// Every side is one of exactly two faces, Euler's formula is that of a sphere, faces turn left at every corner, and
    /// the surface bends inwards at no side: then it is convex as a whole.
    fn is_closed_and_convex(&self) -> bool {
        let sides = self.sides();
        let tolerance = self.tolerance();
        let ordered =
            sides.windows(2).all(|pair| (pair[0].start, pair[0].end) < (pair[1].start, pair[1].end));
        let bends_well = sides.iter().all(|side| {
            let twin = sides.binary_search_by_key(&(side.end, side.start), |other| (other.start, other.end));
            let twin = twin.map(|place| &sides[place]);
            twin.is_ok_and(|twin| self.height(side.face, twin.after) <= tolerance)
                && self.turns_left(side, tolerance)
        });
        let mut starts: Vec<u16> = sides.iter().map(|side| side.start).collect();
        starts.dedup();
        ordered
            && bends_well
            && starts.len() == self.vertices.len()
            && self.vertices.len() + self.faces.len() == sides.len() / 2 + 2
    }

    fn turns_left(&self, side: &Side, tolerance: f64) -> bool {
        let [a, b, c] =
            [side.start, side.end, side.after].map(|vertex| self.vertices[vertex as usize].as_dvec3());
        let normal = self.faces[side.face].normal.as_dvec3();
        (b - a).cross(c - b).dot(normal) >= -tolerance * a.distance_to(c)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use glam::Quat;
    use proptest::prelude::*;

    use super::*;
    use crate::mesh::primitives;

    fn samples() -> Vec<Shape> {
        let ball = Shape::sphere(0.5).unwrap();
        let turned = Quat::from_scaled_axis(Vec3::new(0.3, 0.5, 1.0));
        let gem = Shape::convex_hull(&primitives::dodecahedron(0.5).unwrap().positions).unwrap();
        vec![
            Shape::compound(&[(&ball, Vec3::X * 30.0, turned), (&gem, Vec3::Y * 50.0, turned)]).unwrap(),
            Shape::capsule(0.2, 1.0).unwrap(),
            Shape::cylinder(3.0, 0.1).unwrap(),
            Shape::cuboid(Vec3::new(1.0, 1e-4, 2.0)).unwrap(),
            Shape::from_mesh(&primitives::torus(1.0, 0.3, 16, 8).unwrap()).unwrap(),
            Shape::convex_hull(&primitives::icosphere(1.0, 4).unwrap().positions).unwrap(),
            ball,
            Shape::triangle_mesh(&primitives::grid(3, 4, 1.0, 1.0).unwrap()).unwrap(),
            gem,
        ]
    }

    #[test]
    fn shapes_survive_storage() {
        for shape in samples() {
            shape.validate().unwrap();
            let read: Shape = postcard::from_bytes(&postcard::to_stdvec(&shape).unwrap()).unwrap();
            assert_eq!(read, shape);
        }
    }

    #[test]
    fn changes_are_found_and_named() {
        type Change = (&'static str, fn(&mut Shape));
        let changes: [Change; 18] = [
            ("parts", |s| s.parts.clear()),
            ("parts[0]", |s| s.parts[0].convex.radius = f32::NAN),
            ("parts[0]", |s| s.parts[0].convex.vertices[3].x += 0.1),
            ("parts[0]", |s| s.parts[0].convex.vertices.push(Vec3::ZERO)),
            ("parts[0]", |s| s.parts[0].convex.loops.swap(0, 1)),
            ("parts[0]", |s| s.parts[0].convex.loops[0] = 99),
            ("parts[0]", |s| s.parts[0].convex.faces[2].normal *= 1.1),
            ("parts[0]", |s| s.parts[0].convex.faces[2].offset += 0.1),
            ("parts[0]", |s| s.parts[0].convex.faces[2].count += 1),
            ("parts[0]", |s| s.parts[0].convex.faces.truncate(5)),
            ("volume", |s| s.volume = -1.0),
            ("second_moments", |s| s.second_moments.y = 0.0),
            ("frame", |s| s.frame.axes.x_axis.x = -1.0),
            ("reach", |s| s.reach = 9.0),
            ("inner_radius", |s| s.inner_radius = f32::NAN),
            ("hull_excess", |s| s.hull_excess = f32::NAN),
            ("hull_shortfall", |s| s.hull_shortfall = -1.0),
            ("display", |s| s.display.triangles[0][0] = 20),
        ];
        let cube = Shape::cuboid(Vec3::new(0.5, 0.4, 0.3)).unwrap();
        for (place, (part, change)) in changes.into_iter().enumerate() {
            let mut changed = cube.clone();
            change(&mut changed);
            let found = matches!(changed.validate(), Err(Error::Invalid { field, .. }) if field == format!("shape.{part}"));
            assert!(found, "change {place}");
        }
        let mut ground = Shape::triangle_mesh(&primitives::grid(3, 4, 1.0, 1.0).unwrap()).unwrap();
        ground.volume = 1.0;
        assert!(ground.validate().is_err());
    }

    static STORED: LazyLock<Vec<Vec<u8>>> =
        LazyLock::new(|| samples().iter().map(|shape| postcard::to_stdvec(shape).unwrap()).collect());

    proptest! {
        #[test]
        fn garbage_is_survived(which in 0_usize..9, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
            let mut bytes = STORED[which].clone();
            for (place, value) in changes {
                let place = place.index(bytes.len());
                bytes[place] = value;
            }
            if let Ok(read) = postcard::from_bytes::<Shape>(&bytes) {
                let _ = read.validate();
            }
        }
    }
}
