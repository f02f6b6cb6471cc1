//! Rectangles of planes, for drawing half-spaces and rooms.

use tautline::mesh::TriMesh;
use tautline::{Vec3, World};

use super::{Look, Part};
use crate::document::Room;

/// A rectangle about `center` that reaches as far as `right` and `up` each way, in m; it faces along
/// right × up.
pub(super) fn rectangle(center: Vec3, right: Vec3, up: Vec3) -> TriMesh {
    let positions = vec![center - right - up, center + right - up, center + right + up, center - right + up];
    TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

/// Gives half-spaces that have no surface yet one so large that no edge is near a body.
pub(super) fn draw_walls(world: &World, parts: &mut [Part]) {
    let places = world.positions();
    let (low, high) =
        places.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    let (center, size) =
        if places.is_empty() { (Vec3::ZERO, 0.0) } else { ((low + high) / 2.0, low.distance(high)) };
    for part in parts {
        let plane = world.body(part.body).ok().and_then(|body| body.plane());
        if let (Look::Wall(mesh), Some((normal, offset))) = (&mut part.look, plane)
            && mesh.positions.is_empty()
        {
            *mesh = square(normal, offset, center, 10.0_f32.max(10.0 * size));
        }
    }
}

/// A square of a plane around the foot of `near`, reaching `reach` m each way.
fn square(normal: Vec3, offset: f32, near: Vec3, reach: f32) -> TriMesh {
    let center = near + normal * (offset - normal.dot(near));
    let right = normal.any_orthonormal_vector() * reach;
    rectangle(center, right, normal.cross(right))
}

/// A side of a room.
pub(super) struct Side {
    pub(super) name: &'static str,
    /// Unit, into the room.
    pub(super) normal: Vec3,
    /// Of the plane along its normal, in m.
    pub(super) offset: f32,
    pub(super) mesh: TriMesh,
}

/// The six sides of a room, facing inwards.
pub(super) fn sides(room: &Room) -> [Side; 6] {
    let (min, max) = (Vec3::from(room.min), Vec3::from(room.max));
    let (center, half) = ((min + max) / 2.0, (max - min) / 2.0);
    let (x, y, z) = (half * Vec3::X, half * Vec3::Y, half * Vec3::Z);
    let side = |name, out: Vec3, right: Vec3, up: Vec3| {
        let normal = -out.normalize();
        let mesh = rectangle(center + out, right, up);
        Side { name, normal, offset: normal.dot(center + out), mesh }
    };
    [
        side("left", -x, y, z),
        side("right", x, z, y),
        side("floor", -y, z, x),
        side("ceiling", y, x, z),
        side("back", -z, x, y),
        side("front", z, y, x),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normal_of(mesh: &TriMesh) -> Vec3 {
        let [a, b, c] = mesh.triangles[0].map(|v| mesh.positions[v as usize]);
        (b - a).cross(c - a).normalize()
    }

    #[test]
    fn sides_of_a_room_face_inwards_and_lie_on_their_planes() {
        let room = Room { min: [-1.0, 0.0, 2.0], max: [3.0, 2.0, 5.0], ..Room::default() };
        let center = Vec3::new(1.0, 1.0, 3.5);
        for side in sides(&room) {
            assert_eq!(normal_of(&side.mesh), side.normal, "{}", side.name);
            assert!(side.normal.dot(center) > side.offset, "{}", side.name);
            for &corner in &side.mesh.positions {
                assert!((side.normal.dot(corner) - side.offset).abs() < 1e-6, "{}", side.name);
            }
        }
    }

    #[test]
    fn the_square_of_a_plane_lies_on_it_and_faces_out_of_the_solid() {
        let normal = Vec3::new(0.6, 0.8, 0.0);
        let square = square(normal, 2.0, Vec3::new(5.0, -3.0, 1.0), 10.0);
        assert!(normal_of(&square).abs_diff_eq(normal, 1e-6));
        assert!(square.positions.iter().all(|&corner| (normal.dot(corner) - 2.0).abs() < 1e-5));
    }
}
