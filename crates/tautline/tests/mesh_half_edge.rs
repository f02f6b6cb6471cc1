//! The half-edge mesh: round trips, circulators against brute force, every defect with its place.

use proptest::prelude::*;
use tautline::mesh::{HalfEdgeMesh, TriMesh, convex_hull, primitives};
use tautline::{Error, MeshDefect, Vec3};

fn build(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<HalfEdgeMesh, Error> {
    HalfEdgeMesh::from_triangles(vertex_count, triangles)
}

fn defect(vertex_count: usize, triangles: &[[u32; 3]]) -> MeshDefect {
    match build(vertex_count, triangles).unwrap_err() {
        Error::Mesh(defect) => defect,
        other => panic!("{other}"),
    }
}

fn octahedron() -> Vec<[u32; 3]> {
    primitives::octahedron(1.0).unwrap().triangles
}

/// Renames the vertices that are in use to 0, 1, 2 … so that none is isolated.
fn compact(triangles: &[[u32; 3]]) -> (usize, Vec<[u32; 3]>) {
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let rename = |vertex: u32| used.binary_search(&vertex).unwrap() as u32;
    (used.len(), triangles.iter().map(|corners| corners.map(rename)).collect())
}

/// A sheet of 6 × 6 cells with a hole of this many cells.
fn windowed_grid(columns: usize, rows: usize) -> TriMesh {
    let mut mesh = primitives::grid(7, 7, 1.0, 1.0).unwrap();
    let mut cell = 0..;
    mesh.triangles.retain(|_| {
        let cell = cell.next().unwrap_or(0) / 2;
        !((1..=columns).contains(&(cell % 6)) && (1..=rows).contains(&(cell / 6)))
    });
    mesh
}

/// Sheets, sheets with a window, hulls, spheres and tori, whole or with some triangles missing, in any order and
/// with any first corner. What is left may well have bow-ties; those are for the builder to find.
fn surfaces() -> impl Strategy<Value = (usize, Vec<[u32; 3]>)> {
    let base = prop_oneof![
        (2_u32..8, 2_u32..8).prop_map(|(columns, rows)| primitives::grid(columns, rows, 1.0, 1.0).unwrap()),
        (3_u32..9, 2_u32..7)
            .prop_map(|(segments, rings)| primitives::uv_sphere(1.0, segments, rings).unwrap()),
        (3_u32..9, 3_u32..7)
            .prop_map(|(segments, sides)| primitives::torus(1.0, 0.3, segments, sides).unwrap()),
        (0_u32..2).prop_map(|subdivisions| primitives::icosphere(1.0, subdivisions).unwrap()),
        (1_usize..4, 1_usize..4).prop_map(|(columns, rows)| windowed_grid(columns, rows)),
        prop::collection::vec([-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0], 4..30).prop_map(|points| {
            convex_hull(&points.into_iter().map(Vec3::from).collect::<Vec<_>>()).unwrap().mesh
        }),
    ];
    let shuffled = base.prop_flat_map(|mesh| Just(mesh.triangles).prop_shuffle());
    (shuffled, prop_oneof![Just(0.0), 0.0_f64..0.2], prop::collection::vec((0.0_f64..1.0, 0_usize..3), 200))
        .prop_map(|(triangles, holes, draws)| {
            let mut kept: Vec<[u32; 3]> = Vec::new();
            for (&corners, &(draw, turn)) in triangles.iter().zip(draws.iter().cycle()) {
                if kept.is_empty() || draw >= holes {
                    let mut corners = corners;
                    corners.rotate_left(turn);
                    kept.push(corners);
                }
            }
            compact(&kept)
        })
}

/// The directed sides of the faces, each with its face.
fn sides(triangles: &[[u32; 3]]) -> Vec<(u32, u32, usize)> {
    let of_face = |(face, &[a, b, c]): (usize, &[u32; 3])| [(a, b, face), (b, c, face), (c, a, face)];
    triangles.iter().enumerate().flat_map(of_face).collect()
}

/// Whether the triangles around a vertex are connected through edges at it, by flooding.
fn is_one_fan(vertex: u32, triangles: &[[u32; 3]]) -> bool {
    let around: Vec<&[u32; 3]> = triangles.iter().filter(|corners| corners.contains(&vertex)).collect();
    let share = |a: &[u32; 3], b: &[u32; 3]| a.iter().any(|v| *v != vertex && b.contains(v));
    let mut reached = vec![false; around.len()];
    let mut open = vec![0];
    reached[0] = true;
    while let Some(current) = open.pop() {
        for other in 0..around.len() {
            if !reached[other] && share(around[current], around[other]) {
                reached[other] = true;
                open.push(other);
            }
        }
    }
    reached.into_iter().all(|seen| seen)
}

fn check_against_brute_force(mesh: &HalfEdgeMesh, triangles: &[[u32; 3]]) {
    let sides = sides(triangles);
    let face_along =
        |a: u32, b: u32| sides.iter().find(|side| (side.0, side.1) == (a, b)).map(|side| side.2 as u32);
    let mut edges: Vec<[u32; 2]> = sides.iter().map(|&(a, b, _)| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    assert!(mesh.edges().eq(edges.iter().copied()));

    for half_edge in mesh.half_edges() {
        let (a, b) = (mesh.origin(half_edge), mesh.target(half_edge));
        assert_eq!(mesh.face(half_edge), face_along(a, b));
        assert_eq!(mesh.previous(mesh.next(half_edge)), half_edge);
        assert_eq!(mesh.next(mesh.previous(half_edge)), half_edge);
        assert_eq!(mesh.face(mesh.next(half_edge)), mesh.face(half_edge));
        assert_eq!(
            mesh.edge_of(half_edge),
            edges.binary_search(&[a.min(b), a.max(b)]).ok().map(|e| e as u32)
        );
    }
    let mut hinges = mesh.hinges();
    for (edge, &[a, b]) in (0..).zip(&edges) {
        let mut expected: Vec<u32> = [face_along(a, b), face_along(b, a)].into_iter().flatten().collect();
        expected.sort_unstable();
        let (first, second) = mesh.edge_faces(edge);
        assert_eq!(expected, [Some(first), second].into_iter().flatten().collect::<Vec<_>>());
        let across = |face: u32| triangles[face as usize].into_iter().find(|v| *v != a && *v != b).unwrap();
        assert_eq!(mesh.opposite_vertices(edge), (across(first), second.map(across)));
        assert_eq!((mesh.edge_between(a, b), mesh.edge_between(b, a)), (Some(edge), Some(edge)));
        if let Some(second) = second {
            let [p, q, c, d] = hinges.next().unwrap();
            assert_eq!([p.min(q), p.max(q), c, d], [a, b, across(first), across(second)]);
            assert_eq!((face_along(p, q), face_along(q, p)), (Some(first), Some(second)));
        }
    }
    assert_eq!(hinges.next(), None);
    check_vertices(mesh, triangles, &edges);
    check_loops(mesh, &sides);
}

fn check_vertices(mesh: &HalfEdgeMesh, triangles: &[[u32; 3]], edges: &[[u32; 2]]) {
    for vertex in mesh.vertices() {
        let ring: Vec<u32> = mesh.one_ring(vertex).collect();
        let mut sorted = ring.clone();
        sorted.sort_unstable();
        let mut neighbors: Vec<u32> =
            edges.iter().filter(|edge| edge.contains(&vertex)).map(|&[a, b]| a + b - vertex).collect();
        neighbors.sort_unstable();
        assert_eq!(sorted, neighbors);

        let faces: Vec<u32> = mesh.vertex_faces(vertex).collect();
        let around = triangles.iter().filter(|corners| corners.contains(&vertex)).count();
        assert_eq!(faces.len(), around);
        assert_eq!(mesh.is_boundary_vertex(vertex), ring.len() > around);
        // Face k of the fan lies between neighbours k and k + 1, counter-clockwise.
        for (k, &face) in faces.iter().enumerate() {
            let mut corners = triangles[face as usize];
            let place = corners.iter().position(|&corner| corner == vertex).unwrap();
            corners.rotate_left(place);
            assert_eq!(corners, [vertex, ring[k], ring[(k + 1) % ring.len()]]);
        }
    }
}

fn check_loops(mesh: &HalfEdgeMesh, sides: &[(u32, u32, usize)]) {
    let mut open: Vec<(u32, u32)> = sides.iter().map(|&(a, b, _)| (b, a)).collect();
    open.retain(|&(b, a)| !sides.iter().any(|side| (side.0, side.1) == (b, a)));
    open.sort_unstable();
    let mut walked = Vec::new();
    for vertices in mesh.boundary_loops() {
        for (k, &vertex) in vertices.iter().enumerate() {
            walked.push((vertex, vertices[(k + 1) % vertices.len()]));
        }
    }
    walked.sort_unstable();
    assert_eq!(walked, open);
    assert_eq!(mesh.closed(), open.is_empty());
    let named = match mesh.require_closed() {
        Ok(()) => None,
        Err(Error::Mesh(MeshDefect::OpenEdge { a, b })) => Some((a, b)),
        Err(other) => panic!("{other}"),
    };
    assert_eq!(named, open.iter().map(|&(a, b)| (a.min(b), a.max(b))).min());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn surfaces_are_built_whole_or_their_bow_tie_is_named((count, triangles) in surfaces()) {
        let bow_tie = (0..count as u32).find(|&vertex| !is_one_fan(vertex, &triangles));
        match (build(count, &triangles), bow_tie) {
            (Ok(mesh), None) => {
                mesh.validate().unwrap();
                prop_assert_eq!(mesh.to_triangles(), triangles.clone());
                check_against_brute_force(&mesh, &triangles);
                let bytes = postcard::to_stdvec(&mesh).unwrap();
                prop_assert_eq!(postcard::from_bytes::<HalfEdgeMesh>(&bytes).unwrap(), mesh);
            }
            (Err(error), Some(vertex)) => prop_assert_eq!(error, MeshDefect::BowTieVertex { vertex }.into()),
            (built, expected) => prop_assert!(false, "{:?} but bow-tie {:?}", built, expected),
        }
    }

    /// Whatever is accepted holds every invariant, and each refusal is borne out by the soup.
    #[test]
    fn random_soup_is_refused_for_a_reason(
        triangles in prop::collection::vec([0_u32..6, 0_u32..6, 0_u32..6], 0..7), count in 3_usize..7,
    ) {
        let along = |a: u32, b: u32| sides(&triangles).iter().filter(|side| (side.0, side.1) == (a, b)).count();
        match build(count, &triangles) {
            Ok(mesh) => {
                mesh.validate().unwrap();
                check_against_brute_force(&mesh, &triangles);
            }
            Err(Error::Mesh(defect)) => prop_assert!(match defect {
                MeshDefect::Empty => triangles.is_empty(),
                MeshDefect::IndexOutOfRange { triangle, vertex, .. } =>
                    vertex as usize >= count && triangles[triangle].contains(&vertex),
                MeshDefect::DegenerateTriangle { triangle: t } => {
                    let [a, b, c] = triangles[t];
                    a == b || b == c || c == a
                }
                MeshDefect::IsolatedVertex { vertex } =>
                    (vertex as usize) < count && !triangles.as_flattened().contains(&vertex),
                MeshDefect::DuplicateTriangle { first, second } =>
                    first < second && triangles[first].iter().all(|v| triangles[second].contains(v)),
                MeshDefect::NonManifoldEdge { a, b, .. } => along(a, b) + along(b, a) > 2,
                MeshDefect::FlippedTriangle { a, b, .. } => along(a, b) == 2,
                MeshDefect::BowTieVertex { vertex } => !is_one_fan(vertex, &triangles),
                _ => false,
            }, "{defect}"),
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn any_bytes_give_a_valid_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..40)) {
        if let Ok(mesh) = postcard::from_bytes::<HalfEdgeMesh>(&bytes) {
            mesh.validate().unwrap();
        }
    }
}

#[test]
fn every_defect_is_named_with_its_place() {
    let mut triangles = octahedron();
    assert_eq!(defect(3, &[]), MeshDefect::Empty);
    assert_eq!(defect(7, &triangles), MeshDefect::IsolatedVertex { vertex: 6 });
    assert_eq!(defect(4, &[[0, 1, 3]]), MeshDefect::IsolatedVertex { vertex: 2 });
    triangles[3][1] = 9;
    assert_eq!(defect(6, &triangles), MeshDefect::IndexOutOfRange { triangle: 3, vertex: 9, count: 6 });
    triangles[2] = [4, 3, 4];
    assert_eq!(defect(10, &triangles), MeshDefect::DegenerateTriangle { triangle: 2 });

    let mut triangles = octahedron();
    let [a, b, c] = triangles[1];
    triangles.push([c, b, a]);
    assert_eq!(defect(6, &triangles), MeshDefect::DuplicateTriangle { first: 1, second: 8 });
    triangles.push(triangles[0]);
    assert_eq!(defect(6, &triangles), MeshDefect::DuplicateTriangle { first: 1, second: 8 });

    // The later of two neighbours is the one named.
    let mut triangles = octahedron();
    triangles[7].swap(1, 2);
    let [a, b, c] = triangles[7];
    let named = defect(6, &triangles);
    let expected = [(a, b), (b, c), (c, a)].map(|(a, b)| MeshDefect::FlippedTriangle { triangle: 7, a, b });
    assert!(expected.contains(&named), "{named}");
    let book = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
    assert_eq!(defect(5, &book), MeshDefect::NonManifoldEdge { a: 0, b: 1, triangle: 2 });
    assert_eq!(defect(5, &[[0, 1, 2], [2, 3, 4]]), MeshDefect::BowTieVertex { vertex: 2 });
}

#[test]
fn positions_are_checked_exactly() {
    let mesh = primitives::octahedron(1.0).unwrap();
    let mut broken = mesh.clone();
    broken.positions[4].y = f32::NAN;
    assert_eq!(HalfEdgeMesh::from_mesh(&broken), Err(MeshDefect::NotFinite { vertex: 4 }.into()));

    let thin = |y: f32| TriMesh {
        positions: vec![Vec3::ZERO, Vec3::new(1.0, 1.0, 1.0), Vec3::new(3.0, 3.0 + y, 3.0)],
        triangles: vec![[0, 1, 2]],
    };
    assert!(HalfEdgeMesh::from_mesh(&thin(3e-7)).is_ok());
    let flat = HalfEdgeMesh::from_mesh(&thin(0.0));
    assert_eq!(flat, Err(MeshDefect::DegenerateTriangle { triangle: 0 }.into()));
}

#[test]
fn a_closed_surface_with_a_triangle_missing_names_its_first_open_edge() {
    let mut triangles = octahedron();
    build(6, &triangles).unwrap().require_closed().unwrap();
    let mut corners = triangles.remove(4);
    corners.sort_unstable();
    let [a, b, _] = corners;
    let mesh = build(6, &triangles).unwrap();
    assert_eq!(mesh.require_closed(), Err(MeshDefect::OpenEdge { a, b }.into()));
}

#[test]
fn loops_run_clockwise_around_the_surface_and_counter_clockwise_around_holes() {
    let mesh = windowed_grid(2, 3);
    let (count, triangles) = compact(&mesh.triangles);
    let loops = build(count, &triangles).unwrap().boundary_loops();
    assert_eq!(loops.iter().map(Vec::len).collect::<Vec<_>>(), [24, 10]);

    let sheet = primitives::grid(3, 3, 2.0, 2.0).unwrap();
    let around = &HalfEdgeMesh::from_mesh(&sheet).unwrap().boundary_loops()[0];
    let area: f32 = (0..around.len())
        .map(|k| {
            sheet.positions[around[k] as usize]
                .cross(sheet.positions[around[(k + 1) % around.len()] as usize])
                .y
        })
        .sum();
    assert_eq!(area, -8.0); // Twice the area, negative for clockwise seen from above.
}

#[test]
fn a_vertex_count_from_hostile_bytes_allocates_nothing() {
    let bytes = postcard::to_stdvec(&(u32::MAX, vec![[0_u32, 1, 2]])).unwrap();
    assert!(postcard::from_bytes::<HalfEdgeMesh>(&bytes).is_err());
}
