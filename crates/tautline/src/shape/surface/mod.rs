//! Surfaces without an inside: what fixed and kinematic bodies may be made of.

mod tree;

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use crate::error::{Error, all_coordinates, within};
use crate::geometry::manifold::Triangle;
use crate::mesh::{HalfEdgeMesh, TriMesh};
use crate::norm::Norm;
use tree::{Tree, bounds};

/// Cosine of the bend (5°) under which a ridge counts as flat.
const FLAT_COSINE: f64 = 0.996_194_698_091_745_5;
/// Cosine of the bend (179°) over which two triangles lie back to back.
const FOLDED_COSINE: f64 = -0.999_847_695_156_391_2;

/// Most columns or rows of a height field.
const MAX_COUNT: u32 = 2049;

/// Triangles that something may run into; in the shape's own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "TriMesh", into = "TriMesh")]
pub(crate) struct Surface {
    mesh: TriMesh,
    /// By triangle, a bit for each side: see [`Triangle::active_edges`].
    active: Vec<u8>,
    tree: Tree,
}

impl Surface {
    pub(crate) fn new(mesh: TriMesh) -> Result<Self, Error> {
        all_coordinates("positions", &mesh.positions)?;
        let topology = HalfEdgeMesh::from_mesh(&mesh)?;
        let corners = |t: &[u32; 3]| t.map(|vertex| mesh.positions[vertex as usize]);
        let triangles: Vec<[Vec3; 3]> = mesh.triangles.iter().map(corners).collect();
        let normals: Vec<DVec3> = triangles.iter().map(normal).collect();
        let is_active = |half_edge: u32| {
            let [a, b] = [topology.origin(half_edge), topology.target(half_edge)]
                .map(|vertex| mesh.positions[vertex as usize].as_dvec3());
            topology.face(topology.twin(half_edge)).is_none_or(|beyond| {
                is_ridge(normals[half_edge as usize / 3], normals[beyond as usize], b - a)
            })
        };
        let sides = |face: u32| (0..3).map(|k| u8::from(is_active(3 * face + k)) << k).sum();
        Ok(Self { active: topology.faces().map(sides).collect(), tree: Tree::new(&triangles), mesh })
    }

    /// Heights in m, row by row, as triangles: columns along X, rows along Z, around the origin.
    pub(crate) fn from_heights(columns: u32, rows: u32, cell: f32, heights: &[f32]) -> Result<Self, Error> {
        for (field, count) in [("columns", columns), ("rows", rows)] {
            if !(2..=MAX_COUNT).contains(&count) {
                let expected = "a count from 2 to 2049";
                return Err(Error::OutOfRange { field: field.into(), value: count.into(), expected });
            }
        }
        within("cell_size", cell, 1e-6, 1e6, "a length from 1e-6 to 1e6 m")?;
        if heights.len() != (columns * rows) as usize {
            let problem = format!("{} numbers for {columns} columns and {rows} rows", heights.len());
            return Err(Error::Invalid { field: "heights".into(), problem });
        }
        if let Some(place) = heights.iter().position(|height| !(-1e9..=1e9).contains(height)) {
            within(&format!("heights[{place}]"), heights[place], -1e9, 1e9, "a number from -1e9 to 1e9")?;
        }
        let along = |place: u32, count: u32| (place as f32 - 0.5 * (count - 1) as f32) * cell;
        let point = |place: u32| {
            Vec3::new(along(place % columns, columns), heights[place as usize], along(place / columns, rows))
        };
        let mut mesh = TriMesh { positions: (0..columns * rows).map(point).collect(), triangles: Vec::new() };
        for a in (0..columns * (rows - 1)).filter(|place| place % columns + 1 < columns) {
            let (b, c, d) = (a + columns, a + columns + 1, a + 1);
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
        Self::new(mesh)
    }

    pub(crate) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Its box: the lower and the upper corner, in m.
    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        self.tree.bounds()
    }

    /// The triangle of this number, which has to be one of [`TriMesh::triangles`].
    pub(crate) fn triangle(&self, number: u32) -> Triangle {
        let corners = self.corners(number);
        Triangle { corners, normal: normal(&corners).as_vec3(), active_edges: self.active[number as usize] }
    }

    /// Puts the numbers of the triangles into `out` whose boxes overlap this one, ascending; touching counts.
    pub(crate) fn triangles_in(&self, low: Vec3, high: Vec3, out: &mut Vec<u32>) {
        let overlaps = |l: Vec3, h: Vec3| l.cmple(high).all() && low.cmple(h).all();
        out.clear();
        self.tree.search(overlaps, |triangle| {
            let (l, h) = bounds(&self.corners(triangle));
            if overlaps(l, h) {
                out.push(triangle);
            }
        });
        out.sort_unstable();
    }

    /// Calls `found` with triangles, in no special order; not with those in boxes that `touches` (given their lower
    /// and their upper corner) rejects. For rays and the like.
    pub(crate) fn search(&self, touches: impl FnMut(Vec3, Vec3) -> bool, found: impl FnMut(u32)) {
        self.tree.search(touches, found);
    }

    fn corners(&self, number: u32) -> [Vec3; 3] {
        self.mesh.triangles[number as usize].map(|vertex| self.mesh.positions[vertex as usize])
    }
}

impl From<Surface> for TriMesh {
    fn from(surface: Surface) -> Self {
        surface.mesh
    }
}

impl TryFrom<TriMesh> for Surface {
    type Error = Error;

    fn try_from(mesh: TriMesh) -> Result<Self, Error> {
        Self::new(mesh)
    }
}

/// In f64, in which no triangle with an area has none.
fn normal(corners: &[Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).unit_or_zero()
}

/// Whether the surface bends outwards where a triangle ends in an edge, beyond which another one begins.
fn is_ridge(normal: DVec3, beyond: DVec3, edge: DVec3) -> bool {
    let cosine = normal.dot(beyond);
    // Back to back, the sense of the bend is rounding.
    cosine < FOLDED_COSINE || (normal.cross(beyond).dot(edge) > 0.0 && cosine < FLAT_COSINE)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::mesh::primitives;

    fn active(mesh: Result<TriMesh, Error>) -> Vec<u8> {
        Surface::new(mesh.unwrap()).unwrap().active
    }

    #[test]
    fn seams_are_inactive_ridges_and_rims_active() {
        // Both triangles of a side share its diagonal only.
        assert!(active(primitives::cube(1.0)).iter().all(|sides| sides.count_ones() == 2));
        let room = primitives::cube(1.0).map(|cube| TriMesh {
            triangles: cube.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
            ..cube
        });
        assert!(active(room).iter().all(|&sides| sides == 0), "valleys");
        let sheet = Surface::new(primitives::grid(5, 4, 1.0, 1.0).unwrap()).unwrap();
        let rim: u32 = sheet.active.iter().map(|sides| sides.count_ones()).sum();
        assert_eq!(rim, 2 * (4 + 3));
        for (number, &[a, b, c]) in (0..).zip(&sheet.mesh.triangles) {
            let triangle = sheet.triangle(number);
            assert_eq!(triangle.normal, Vec3::Y);
            for (k, [p, q]) in [[a, b], [b, c], [c, a]]
                .map(|side| side.map(|v| sheet.mesh.positions[v as usize]))
                .into_iter()
                .enumerate()
            {
                let on_rim = (p.x == q.x && p.x.abs() == 0.5) || (p.z == q.z && p.z.abs() == 0.5);
                assert_eq!(triangle.active_edges >> k & 1 == 1, on_rim);
            }
        }
    }

    /// Two triangles that meet in the X axis, one of them turned by this angle.
    fn bent(degrees: f32) -> u8 {
        let (sin, cos) =
            (f64::from(degrees).to_radians().sin() as f32, f64::from(degrees).to_radians().cos() as f32);
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::new(0.5, -sin, -cos)];
        let mesh = TriMesh { positions, triangles: vec![[1, 0, 2], [0, 1, 3]] };
        active(Ok(mesh))[0] & 1
    }

    #[test]
    fn ridges_count_from_five_degrees_on() {
        let angles = [-179.5, -178.0, -90.0, -6.0, 0.0, 4.9, 5.1, 90.0, 178.0, 179.5];
        assert_eq!(angles.map(bent), [1, 0, 0, 0, 0, 0, 1, 1, 1, 1]);
    }

    #[test]
    fn height_fields_are_grids_that_face_up() {
        let heights: Vec<f32> = (0..12).map(|k| k as f32 * 0.25).collect();
        let field = Surface::from_heights(4, 3, 0.5, &heights).unwrap();
        assert_eq!(field.mesh.positions[0], Vec3::new(-0.75, 0.0, -0.5));
        assert_eq!(field.mesh.positions[11], Vec3::new(0.75, 2.75, 0.5));
        assert_eq!(field.bounds(), (Vec3::new(-0.75, 0.0, -0.5), Vec3::new(0.75, 2.75, 0.5)));
        assert_eq!(field.mesh.triangles.len(), 12);
        // A plane: it rises by 0.25 every 0.5 m along X and by 1 along Z.
        let up = Vec3::new(-0.5, 1.0, -2.0).normalize();
        assert!((0..12).all(|number| field.triangle(number).normal.distance(up) < 1e-6));
        let flat = primitives::grid(4, 3, 1.5, 1.0).unwrap();
        assert_eq!(Surface::from_heights(4, 3, 0.5, &[0.0; 12]).unwrap().mesh, flat);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn the_triangles_in_a_box_are_those_of_brute_force(
            heights in prop::collection::vec(-1.0_f32..1.0, 99),
            corner in prop::array::uniform3(-4..4_i32),
            size in prop::array::uniform3(0..4_i32),
        ) {
            let surface = Surface::from_heights(11, 9, 0.5, &heights).unwrap();
            // Along the grid's own lines, so that touching is common.
            let low = Vec3::from(corner.map(|k| k as f32)) * 0.5;
            let high = low + Vec3::from(size.map(|k| k as f32)) * 0.5;
            let mut found = vec![7];
            surface.triangles_in(low, high, &mut found);
            let expected: Vec<u32> = (0..160)
                .filter(|&number| {
                    let (l, h) = bounds(&surface.triangle(number).corners);
                    (0..3).all(|k| l[k] <= high[k] && low[k] <= h[k])
                })
                .collect();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn survives_storage() {
        let surface = Surface::new(primitives::icosphere(1.0, 2).unwrap()).unwrap();
        let bytes = postcard::to_stdvec(&surface).unwrap();
        assert_eq!(postcard::from_bytes::<Surface>(&bytes).unwrap(), surface);
        let open = TriMesh { triangles: vec![[0, 1, 7]], ..surface.mesh };
        assert!(postcard::from_bytes::<Surface>(&postcard::to_stdvec(&open).unwrap()).is_err());
    }
}
