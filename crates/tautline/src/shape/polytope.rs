//! From points to a polytope with flat faces: the convex hull, its triangles merged where they lie in one plane.

use glam::{DVec3, Vec3};

use super::{Convex, Face};
use crate::error::Error;
use crate::mesh::{HalfEdgeMesh, TriMesh, convex_hull};
use crate::norm::Norm;
use crate::order::PutInOrder;

/// Most corners of a polytope: faces name them by 16 bits.
pub(super) const MAX_CORNERS: usize = u16::MAX as usize;

impl Convex {
    /// All within `radius` of the convex hull of some points: of one, of two, or of points that span a volume.
    ///
    /// Faces are flat, and every corner of the points at most [`flatness`] outside: neighbouring triangles become one
    /// face if they differ from a plane by no more, as rounding and files make them.
    pub(super) fn around(points: &[Vec3], radius: f32) -> Result<Self, Error> {
        if points.len() < 3 {
            return Ok(Self::new(points.to_vec(), Vec::new(), Vec::new(), radius));
        }
        let mesh = convex_hull(points)?.mesh;
        if mesh.positions.len() > MAX_CORNERS {
            let problem = format!("{} corners: a hull has at most {MAX_CORNERS}", mesh.positions.len());
            return Err(Error::Invalid { field: "points".into(), problem });
        }
        let mut polygons = merge(&mesh)?;
        remove_straight_corners(&mut polygons, mesh.positions.len());
        Ok(Self::from_polygons(&mesh.positions, &polygons, radius))
    }

    /// Of the positions only those that are a corner of a polygon.
    fn from_polygons(positions: &[Vec3], polygons: &[Vec<u32>], radius: f32) -> Self {
        let mut used: Vec<u32> = polygons.concat();
        used.sort_unstable();
        used.dedup();
        let vertices: Vec<Vec3> = used.iter().map(|&vertex| positions[vertex as usize]).collect();
        let (mut faces, mut loops) = (Vec::new(), Vec::new());
        for polygon in polygons {
            let first = loops.len() as u32;
            loops.extend(polygon.iter().map(|&corner| used.partition_point(|&v| v < corner) as u16));
            let corners = || polygon.iter().map(|&corner| positions[corner as usize]);
            let normal = area_vector(corners()).unit_or_zero();
            // The outermost corner's, so that none is outside.
            let offset = corners().map(|p| normal.dot(p.as_dvec3())).fold(f64::NEG_INFINITY, f64::max);
            let count = polygon.len() as u32;
            faces.push(Face { normal: normal.as_vec3(), offset: offset as f32, first, count });
        }
        Self::new(vertices, faces, loops, radius)
    }
}

/// How far points that count as in one plane may be out of it, in m: a part of their extent, and what rounding does
/// to them at that distance from the origin.
pub(super) fn flatness(points: &[Vec3]) -> f32 {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
    2e-6 * (high - low).max_element() + 5e-7 * low.abs().max(high.abs()).max_element()
}

/// Twice the area of a polygon, along its normal.
fn area_vector(mut corners: impl Iterator<Item = Vec3>) -> DVec3 {
    let Some(start) = corners.next().map(|corner| corner.as_dvec3()) else { return DVec3::ZERO };
    let mut previous = DVec3::ZERO;
    let mut sum = DVec3::ZERO;
    for corner in corners {
        let next = corner.as_dvec3() - start;
        sum += previous.cross(next);
        previous = next;
    }
    sum
}

/// The faces of a convex surface as polygons, largest triangles first.
fn merge(mesh: &TriMesh) -> Result<Vec<Vec<u32>>, Error> {
    let topology = HalfEdgeMesh::from_mesh(mesh)?;
    let corners = |face: u32| mesh.triangles[face as usize].map(|v| mesh.positions[v as usize]);
    let mut by_area: Vec<(f64, u32)> = topology
        .faces()
        .map(|face| (area_vector(corners(face).into_iter()).length_squared(), face))
        .collect();
    by_area.put_in_order_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut merging = Merging {
        mesh,
        topology: &topology,
        tolerance: f64::from(flatness(&mesh.positions)),
        taken: vec![false; mesh.triangles.len()],
        on_outline: vec![false; mesh.positions.len()],
    };
    let mut polygons = Vec::new();
    for (_, seed) in by_area {
        if !merging.taken[seed as usize] {
            let region = merging.grow(seed);
            let outline: Vec<u32> = region.outline.iter().map(|&edge| topology.origin(edge)).collect();
            if merging.is_convex(&outline, region.normal) {
                polygons.push(outline);
            } else {
                // A surface that bends by no more than the tolerance over many triangles.
                polygons.extend(region.triangles.iter().map(|&face| topology.triangle(face).to_vec()));
            }
        }
    }
    Ok(polygons)
}

struct Merging<'a> {
    mesh: &'a TriMesh,
    topology: &'a HalfEdgeMesh,
    tolerance: f64,
    /// By triangle: whether it belongs to a region.
    taken: Vec<bool>,
    /// By vertex: whether the outline of the region that grows passes through it.
    on_outline: Vec<bool>,
}

/// Triangles near the plane of one of them; always a disc.
struct Region {
    origin: DVec3,
    normal: DVec3,
    triangles: Vec<u32>,
    /// Half-edges around it, counter-clockwise.
    outline: Vec<u32>,
}

impl Merging<'_> {
    fn position(&self, vertex: u32) -> Vec3 {
        self.mesh.positions[vertex as usize]
    }

    fn grow(&mut self, seed: u32) -> Region {
        let corners = self.topology.triangle(seed).map(|vertex| self.position(vertex));
        let mut region = Region {
            origin: corners[0].as_dvec3(),
            normal: area_vector(corners.into_iter()).unit_or_zero(),
            triangles: vec![seed],
            outline: vec![3 * seed, 3 * seed + 1, 3 * seed + 2],
        };
        self.taken[seed as usize] = true;
        self.mark(&region, true);
        let (mut place, mut refused) = (0, 0);
        while refused < region.outline.len() {
            if self.absorb(&mut region, place) {
                refused = 0;
            } else {
                (place, refused) = (place + 1, refused + 1);
            }
            place %= region.outline.len();
        }
        self.mark(&region, false);
        region
    }

    fn mark(&mut self, region: &Region, on_outline: bool) {
        for &edge in &region.outline {
            self.on_outline[self.topology.origin(edge) as usize] = on_outline;
        }
    }

    /// Adds the triangle beyond an edge of the outline, if it is free, in the plane, and the region stays a disc.
    fn absorb(&mut self, region: &mut Region, place: usize) -> bool {
        let topology = self.topology;
        let count = region.outline.len();
        let (before, after) = ((place + count - 1) % count, (place + 1) % count);
        let edge = region.outline[place];
        let twin = topology.twin(edge);
        // Around the new triangle the outline goes to its third corner and back.
        let (there, back) = (topology.next(twin), topology.previous(twin));
        let (triangle, apex) = (twin / 3, topology.origin(back));
        let closes_before = topology.twin(region.outline[before]) == there;
        let closes_after = topology.twin(region.outline[after]) == back;
        let stays_disc = match (closes_before, closes_after) {
            (false, false) => !self.on_outline[apex as usize],
            (true, true) => false,
            _ => count > 3,
        };
        let height = (self.position(apex).as_dvec3() - region.origin).dot(region.normal);
        if self.taken[triangle as usize] || !stays_disc || height.abs() > self.tolerance {
            return false;
        }
        self.taken[triangle as usize] = true;
        region.triangles.push(triangle);
        if closes_before {
            self.on_outline[topology.origin(edge) as usize] = false;
            region.outline[place] = back;
            region.outline.remove(before);
        } else if closes_after {
            self.on_outline[topology.target(edge) as usize] = false;
            region.outline[place] = there;
            region.outline.remove(after);
        } else {
            self.on_outline[apex as usize] = true;
            region.outline.splice(place..=place, [there, back]);
        }
        true
    }

    /// Whether no corner is further within the line between its neighbours than the tolerance.
    fn is_convex(&self, outline: &[u32], normal: DVec3) -> bool {
        let count = outline.len();
        (0..count).all(|place| {
            let [a, b, c] = [0, 1, 2].map(|k| self.position(outline[(place + k) % count]).as_dvec3());
            (b - a).cross(c - b).dot(normal) >= -self.tolerance * (c - a).norm()
        })
    }
}

/// Removes the corners at which only two polygons meet: they are on a straight edge.
fn remove_straight_corners(polygons: &mut [Vec<u32>], vertex_count: usize) {
    let mut around = vec![Vec::new(); vertex_count];
    for (number, polygon) in polygons.iter().enumerate() {
        for &corner in polygon {
            around[corner as usize].push(number);
        }
    }
    for (corner, around) in (0_u32..).zip(&around) {
        if around.len() == 2 && around.iter().all(|&number| polygons[number].len() > 3) {
            for &number in around {
                polygons[number].retain(|&other| other != corner);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;
    use proptest::prelude::*;

    use super::*;
    use crate::mesh::primitives;

    /// How many faces there are of each number of corners, ascending.
    fn census(convex: &Convex) -> Vec<(u32, usize)> {
        let mut counts: Vec<u32> = convex.faces.iter().map(|face| face.count).collect();
        counts.sort_unstable();
        counts.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).collect()
    }

    /// Closed, convex, and flat, each in f64.
    fn check(convex: &Convex, points: &[Vec3]) {
        let tolerance = 2.0 * f64::from(flatness(points));
        let mut edges = Vec::new();
        for &face in &convex.faces {
            let normal = face.normal.as_dvec3();
            assert!((normal.length() - 1.0).abs() < 1e-6);
            let height = |p: Vec3| normal.dot(p.as_dvec3()) - f64::from(face.offset);
            assert!(points.iter().all(|&p| height(p) < tolerance));
            assert!(convex.corners(face).all(|(_, p)| height(p).abs() < tolerance));
            let corners: Vec<(u16, Vec3)> = convex.corners(face).collect();
            let count = corners.len();
            for place in 0..count {
                let [a, b, c] = [0, 1, 2].map(|k| corners[(place + k) % count]);
                let turn = (b.1 - a.1).as_dvec3().cross((c.1 - b.1).as_dvec3()).dot(normal);
                assert!(turn > -tolerance * f64::from(a.1.distance(c.1)));
                edges.push((a.0, b.0));
            }
        }
        edges.sort_unstable();
        let twins = edges.iter().filter(|&&(a, b)| edges.binary_search(&(b, a)).is_ok()).count();
        edges.dedup();
        assert_eq!(twins, edges.len(), "every edge once in each direction");
        assert_eq!(convex.vertices.len() + convex.faces.len(), edges.len() / 2 + 2, "Euler");
    }

    fn around(points: &[Vec3]) -> Convex {
        let convex = Convex::around(points, 0.0).unwrap();
        check(&convex, points);
        convex
    }

    #[test]
    fn faces_of_known_solids_in_any_pose_and_size() {
        let solids = [
            (primitives::tetrahedron(1.0), vec![(3, 4)]),
            (primitives::cuboid(Vec3::new(1.0, 0.01, 2.0)), vec![(4, 6)]),
            (primitives::octahedron(1.0), vec![(3, 8)]),
            (primitives::dodecahedron(1.0), vec![(5, 12)]),
            (primitives::icosahedron(1.0), vec![(3, 20)]),
            (primitives::cylinder(0.5, 1.0, 32), vec![(4, 32), (32, 2)]),
            (primitives::icosphere(1.0, 3), vec![(3, 1280)]),
        ];
        for (mesh, expected) in solids {
            let points = mesh.unwrap().positions;
            for pose in 0..20 {
                let turn = Quat::from_scaled_axis(Vec3::new(0.3, 0.5, -0.2) * pose as f32);
                let (size, far) = ([1e-4, 1.0, 300.0][pose % 3], Vec3::splat([0.0, 5.0, 100.0][pose % 3]));
                let moved: Vec<Vec3> = points.iter().map(|&p| turn * p * size + far * size).collect();
                assert_eq!(census(&around(&moved)), expected);
            }
        }
    }

    #[test]
    fn points_on_faces_and_edges_are_no_corners() {
        let grid = |k: i32| Vec3::new((k % 5) as f32, (k / 5 % 5) as f32, (k / 25) as f32) * 0.1;
        let turn = Quat::from_scaled_axis(Vec3::new(1.0, 0.5, 0.2));
        let points: Vec<Vec3> = (0..125).map(|k| turn * grid(k)).collect();
        let convex = around(&points);
        assert_eq!((convex.vertices.len(), census(&convex)), (8, vec![(4, 6)]));
    }

    /// Around the tolerance it is neither flat nor round.
    #[test]
    fn lids_that_bend_by_little_stay_convex() {
        for bend in [1e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 1e-3] {
            let lid = |k: i32| {
                let (x, z) = ((k % 21 - 10) as f32 / 10.0, (k / 21 - 10) as f32 / 10.0);
                Vec3::new(x, -bend * (x * x + z * z), z)
            };
            let points: Vec<Vec3> = (0..441).map(lid).chain([Vec3::NEG_Y]).collect();
            assert!(around(&points).is_sound(), "{bend}");
        }
    }

    #[test]
    fn too_many_corners_are_refused() {
        let points = primitives::icosphere(1.0, 7).unwrap().positions;
        let refused =
            matches!(Convex::around(&points, 0.0), Err(Error::Invalid { field, .. }) if field == "points");
        assert!(refused);
    }

    fn noisy() -> impl Strategy<Value = Vec<Vec3>> {
        let on_lattice =
            prop::array::uniform3(-2..=2).prop_map(|c: [i32; 3]| Vec3::from(c.map(|k| k as f32)));
        let noise = prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from);
        let size = prop::sample::select(vec![0.0, 1e-7, 1e-6, 4e-6, 1e-5, 1e-3]);
        size.prop_flat_map(move |size| {
            prop::collection::vec(
                (on_lattice.clone(), noise.clone()).prop_map(move |(p, n)| p + n * size),
                6..80,
            )
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

        /// Of nearly coplanar, collinear and coinciding points.
        #[test]
        fn noisy_hulls_are_closed_and_convex(points in noisy()) {
            if let Ok(convex) = Convex::around(&points, 0.0) {
                check(&convex, &points);
                prop_assert!(convex.is_sound());
            }
        }
    }
}
