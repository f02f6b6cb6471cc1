//! The doctor: every defect is named where it is, and what repair makes of it; random damage; brute force.

use proptest::prelude::*;
use tautline::mesh::doctor::{Action, Defect, RepairOptions, Repaired, Report, Why, diagnose, repair};
use tautline::mesh::{HalfEdgeMesh, MassProperties, TriMesh, primitives};
use tautline::{DVec3, Vec3};

fn cube() -> TriMesh {
    primitives::cuboid(Vec3::ONE).unwrap()
}

fn ball() -> TriMesh {
    primitives::icosphere(1.0, 2).unwrap()
}

fn mend(mesh: &TriMesh) -> Repaired {
    repair(mesh, &RepairOptions::default())
}

/// Both meshes as one.
fn joined(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let first = a.positions.len() as u32;
    let mut mesh = a.clone();
    mesh.positions.extend(&b.positions);
    mesh.triangles.extend(b.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    mesh
}

fn moved(mut mesh: TriMesh, by: Vec3) -> TriMesh {
    mesh.positions.iter_mut().for_each(|position| *position += by);
    mesh
}

fn turned(mut mesh: TriMesh) -> TriMesh {
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    mesh
}

fn volume(mesh: &TriMesh) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize].as_dvec3());
    mesh.triangles.iter().map(corners).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum()
}

/// Clean, as the rest of the engine sees it too.
fn assert_clean(mesh: &TriMesh, report: &Report) {
    assert!(report.is_clean(), "{:?}", report.defects);
    MassProperties::of(mesh, 1000.0).unwrap();
}

/// Repairing it gives a closed surface of this volume, by these actions.
fn assert_mends(mesh: &TriMesh, expected: f64, actions: &[Action]) {
    let repaired = mend(mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!((volume(&repaired.mesh) - expected).abs() < 1e-5, "{} and {expected}", volume(&repaired.mesh));
    assert_eq!(repaired.actions, actions);
    assert_eq!(mend(&repaired.mesh).actions, [], "the second repair has nothing to do");
}

#[test]
fn sound_meshes_have_no_defects() {
    for mesh in
        [cube(), ball(), primitives::torus(1.0, 0.3, 24, 12).unwrap(), primitives::dodecahedron(1.0).unwrap()]
    {
        let report = diagnose(&mesh);
        assert_clean(&mesh, &report);
        assert!(report.has_all_crossings);
        let [component] = report.components[..] else { panic!("{:?}", report.components) };
        assert!(component.is_closed && component.triangles == mesh.triangles.len());
        assert!((component.volume - volume(&mesh)).abs() < 1e-6);
        let repaired = mend(&mesh);
        assert_eq!((repaired.mesh, repaired.actions), (mesh, vec![]));
    }
}

#[test]
fn nothing_is_named_empty() {
    assert_eq!(diagnose(&TriMesh::default()).defects, [Defect::Empty]);
    assert_eq!(mend(&TriMesh::default()).report.defects, [Defect::Empty]);
}

#[test]
fn numbers_that_are_none_are_named_and_dropped() {
    let mut mesh = cube();
    mesh.positions.push(Vec3::new(0.0, f32::NAN, 0.0));
    mesh.triangles.extend([[0, 1, 8], [0, 1, 4_000_000_000], [2, 2, 5]]);
    let expected = [
        Defect::NotFinite { vertex: 8 },
        Defect::MissingVertex { triangle: 13, vertex: 4_000_000_000 },
        Defect::Degenerate { triangle: 14 },
    ];
    assert_eq!(diagnose(&mesh).defects, expected);
    let dropped = |why, triangles: &[u32]| Action::DroppedTriangles {
        why,
        count: triangles.len(),
        triangles: triangles.to_vec(),
    };
    let actions = [
        dropped(Why::NoPlace, &[12, 13]),
        dropped(Why::NoArea, &[14]),
        Action::DroppedVertices { vertices: vec![8] },
    ];
    assert_mends(&mesh, 8.0, &actions);
}

#[test]
fn isolated_vertices_are_named_and_dropped() {
    let mut mesh = cube();
    mesh.positions.insert(3, Vec3::splat(7.0));
    mesh.triangles.as_flattened_mut().iter_mut().filter(|v| **v >= 3).for_each(|v| *v += 1);
    let defect = Defect::Isolated { vertex: 3 };
    assert_eq!(defect.place(&mesh), Vec3::splat(7.0));
    assert_eq!(diagnose(&mesh).defects, [defect]);
    assert_mends(&mesh, 8.0, &[Action::DroppedVertices { vertices: vec![3] }]);
}

#[test]
fn a_hole_is_named_by_its_rim_and_filled() {
    let mut mesh = ball();
    let missing: Vec<usize> = (0..mesh.triangles.len()).filter(|&t| mesh.triangles[t].contains(&0)).collect();
    let rim = missing.len();
    mesh.triangles.retain(|t| !t.contains(&0));
    let report = diagnose(&mesh);
    let [Defect::Isolated { vertex: 0 }, Defect::Open { vertices, is_loop: true }] = &report.defects[..]
    else {
        panic!("{:?}", report.defects)
    };
    assert_eq!(vertices.len(), rim);
    let near = report.defects[1].place(&mesh).distance(ball().positions[0]);
    assert!(near < 0.1, "{near} m from the vertex that is missing");
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!(matches!(&repaired.actions[0], Action::Filled { triangles, .. } if *triangles == rim - 2));
    assert!((volume(&repaired.mesh) - volume(&ball())).abs() < 0.02);
}

#[test]
fn sheets_and_bowls_are_left_open() {
    let sheet = primitives::grid(4, 4, 1.0, 1.0).unwrap();
    let mut bowl = ball();
    bowl.triangles.retain(|t| t.iter().all(|&v| bowl.positions[v as usize].y < 0.3));
    for mesh in [sheet, bowl] {
        let repaired = mend(&mesh);
        assert!(
            repaired.report.is_clean_but_open() && !repaired.report.is_clean(),
            "{:?}",
            repaired.report.defects
        );
        assert!(!repaired.actions.iter().any(|action| matches!(action, Action::Filled { .. })));
        HalfEdgeMesh::from_mesh(&repaired.mesh).unwrap();
    }
}

#[test]
fn a_filling_that_would_cross_is_not_made() {
    // A spike goes through the hole.
    let mut mesh = ball();
    mesh.triangles.retain(|t| !t.contains(&0));
    let (mut spike, way) = (primitives::octahedron(1.0).unwrap(), ball().positions[0]);
    spike.positions.iter_mut().for_each(|p| *p = *p * 0.02 + way * (0.95 + 0.4 * p.y));
    let repaired = mend(&joined(&mesh, &spike));
    assert!(!repaired.report.defects.iter().any(|defect| matches!(defect, Defect::Crossing { .. })));
    assert!(
        repaired.report.defects.iter().any(|defect| matches!(defect, Defect::Open { .. })),
        "{:?}",
        repaired.actions
    );
}

#[test]
fn a_flipped_triangle_is_named_and_turned() {
    let mut mesh = ball();
    mesh.triangles[17].swap(0, 1);
    assert_eq!(diagnose(&mesh).defects, [Defect::Flipped { triangle: 17 }]);
    assert_mends(&mesh, volume(&ball()), &[Action::Turned { count: 1, triangles: vec![17] }]);
}

#[test]
fn duplicates_are_named_and_dropped() {
    let mut mesh = cube();
    let [a, b, c] = mesh.triangles[5];
    mesh.triangles.extend([[b, c, a], [c, b, a]]);
    let duplicate = |triangle| Defect::Duplicate { triangle, first: 5 };
    assert_eq!(diagnose(&mesh).defects, [duplicate(12), duplicate(13)]);
    let dropped = Action::DroppedTriangles { why: Why::Duplicate, count: 2, triangles: vec![12, 13] };
    assert_mends(&mesh, 8.0, &[dropped]);
}

/// A box of 2 m × 1 m × 1 m in two halves, with a wall between them that has both its faces: triangles 20 to 23.
fn box_with_wall() -> TriMesh {
    let ring = |x: u32| {
        (0..4).map(move |k: u32| Vec3::new(x as f32, !k.is_multiple_of(3) as u8 as f32, (k > 1) as u8 as f32))
    };
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for x in 0..2 {
        (0..4).for_each(|k| quad([4 * x + k, 4 * x + (k + 1) % 4, 4 * x + 4 + (k + 1) % 4, 4 * x + 4 + k]));
    }
    quad([3, 2, 1, 0]);
    quad([8, 9, 10, 11]);
    quad([4, 5, 6, 7]);
    triangles.extend([[6, 5, 4], [7, 6, 4]]);
    TriMesh { positions: (0..3).flat_map(ring).collect(), triangles }
}

#[test]
fn a_wall_inside_a_solid_is_taken_out() {
    let mut mesh = box_with_wall();
    if volume(&mesh) < 0.0 {
        mesh = turned(mesh);
    }
    let defects = diagnose(&mesh).defects;
    assert_eq!(defects.iter().filter(|defect| matches!(defect, Defect::Duplicate { .. })).count(), 2);
    assert_eq!(defects.iter().filter(|defect| matches!(defect, Defect::NonManifoldEdge { .. })).count(), 4);
    let dropped = Action::DroppedTriangles { why: Why::Wall, count: 4, triangles: vec![20, 21, 22, 23] };
    assert_mends(&mesh, 2.0, &[dropped]);
}

/// Two cubes whose last and first vertices are one, and as many more as are told.
fn cubes_sharing(vertices: &[(u32, u32)]) -> TriMesh {
    let (first, second) = (cube(), cube());
    let shift = first.positions[vertices[0].0 as usize] - second.positions[vertices[0].1 as usize];
    let mut mesh = joined(&first, &moved(second, shift));
    for &(a, b) in vertices {
        assert_eq!(mesh.positions[a as usize], mesh.positions[b as usize + 8]);
        mesh.triangles.as_flattened_mut().iter_mut().filter(|v| **v == b + 8).for_each(|v| *v = a);
    }
    mesh
}

fn vertex_at(mesh: &TriMesh, position: Vec3) -> u32 {
    mesh.positions.iter().position(|&p| p == position).unwrap() as u32
}

#[test]
fn solids_that_share_a_corner_are_parted() {
    let (high, low) = (vertex_at(&cube(), Vec3::ONE), vertex_at(&cube(), Vec3::NEG_ONE));
    let mesh = cubes_sharing(&[(high, low)]);
    let defects = [Defect::Isolated { vertex: low + 8 }, Defect::BowTie { vertex: high, fans: 2 }];
    assert_eq!(diagnose(&mesh).defects, defects);
    assert_eq!(defects[1].place(&mesh), Vec3::ONE);
    let actions =
        [Action::Parted { vertices: vec![high] }, Action::DroppedVertices { vertices: vec![low + 8] }];
    assert_mends(&mesh, 16.0, &actions);
    assert_eq!(mend(&mesh).report.components.len(), 2);
}

#[test]
fn solids_that_share_an_edge_are_parted() {
    let at = |x: f32, y: f32, z: f32| vertex_at(&cube(), Vec3::new(x, y, z));
    let shared = [(at(1.0, 1.0, -1.0), at(-1.0, -1.0, -1.0)), (at(1.0, 1.0, 1.0), at(-1.0, -1.0, 1.0))];
    let mesh = cubes_sharing(&shared);
    let defects = diagnose(&mesh).defects;
    let edge = defects.iter().find(|defect| matches!(defect, Defect::NonManifoldEdge { .. })).unwrap();
    assert_eq!(edge.place(&mesh), Vec3::new(1.0, 1.0, 0.0));
    assert!(matches!(edge, Defect::NonManifoldEdge { triangles, .. } if triangles.len() == 4));
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    assert_eq!(repaired.report.components.len(), 2);
    assert!((volume(&repaired.mesh) - 16.0).abs() < 1e-9);
}

#[test]
fn a_fin_is_parted_from_its_solid_and_told_of() {
    let mut mesh = cube();
    let [a, b, _] = mesh.triangles[0];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) * 1.5);
    mesh.triangles.push([a, b, 8]);
    let edge = Defect::NonManifoldEdge { edge: [a.min(b), a.max(b)], triangles: vec![] };
    assert!(diagnose(&mesh).defects.iter().any(|defect| defect.vertices(&mesh) == edge.vertices(&mesh)));
    let repaired = mend(&mesh);
    let [Defect::Open { vertices, is_loop: true }] = &repaired.report.defects[..] else {
        panic!("{:?}", repaired.report.defects)
    };
    assert_eq!(vertices.len(), 3, "the fin has a rim of its own");
}

#[test]
fn small_fins_are_dropped() {
    let mut mesh = ball();
    let [a, b, _] = mesh.triangles[7];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) * 0.52);
    mesh.triangles.push([a, b, mesh.positions.len() as u32 - 1]);
    let fin = mesh.triangles.len() as u32 - 1;
    let repaired = mend(&mesh);
    assert_clean(&repaired.mesh, &repaired.report);
    let dropped = Action::DroppedTriangles { why: Why::Fin, count: 1, triangles: vec![fin] };
    assert!(repaired.actions.contains(&dropped), "{:?}", repaired.actions);
}

#[test]
fn torn_surfaces_are_welded() {
    for noise in [0.0, 2e-7] {
        let mut mesh = TriMesh::default();
        for (t, triangle) in ball().triangles.iter().enumerate() {
            let corner =
                |k: usize| ball().positions[triangle[k] as usize] * (1.0 + noise * ((3 * t + k) % 5) as f32);
            mesh.positions.extend([corner(0), corner(1), corner(2)]);
            mesh.triangles.push([3 * t as u32, 3 * t as u32 + 1, 3 * t as u32 + 2]);
        }
        let report = diagnose(&mesh);
        let unwelded =
            report.defects.iter().filter(|defect| matches!(defect, Defect::Unwelded { .. })).count();
        assert!(noise > 0.0 || unwelded == ball().positions.len(), "{unwelded}");
        assert_eq!(report.components.len(), mesh.triangles.len());
        let repaired = mend(&mesh);
        assert_clean(&repaired.mesh, &repaired.report);
        assert_eq!(repaired.mesh.positions.len(), ball().positions.len());
        let [Action::Welded { pairs }] = &repaired.actions[..] else { panic!("{:?}", repaired.actions) };
        assert_eq!(pairs.len(), mesh.positions.len() - ball().positions.len());
    }
}

#[test]
fn a_triangle_without_area_gets_one() {
    // The middle of an edge is a corner on one side of it, and a triangle without area lies between.
    let mut mesh = cube();
    let [a, b, c] = mesh.triangles[0];
    mesh.positions.push((mesh.positions[a as usize] + mesh.positions[b as usize]) / 2.0);
    mesh.triangles[0] = [a, 8, c];
    mesh.triangles.extend([[8, b, c], [a, b, 8]]);
    let defects = diagnose(&mesh).defects;
    assert_eq!(defects[0], Defect::Degenerate { triangle: 13 });
    let touches =
        |defect: &Defect| matches!(defect, Defect::Crossing { triangles: [a, b] } if *a == 0 || *b == 12);
    assert!(defects[1..].iter().all(touches), "only what the new corner touches: {defects:?}");
    assert_mends(&mesh, 8.0, &[Action::Swapped { count: 1, triangles: vec![13] }]);
    // An edge without length.
    let mut mesh = cube();
    mesh.positions.push(mesh.positions[a as usize]);
    mesh.triangles[0] = [8, b, c];
    mesh.triangles.push([a, b, 8]);
    mesh.triangles.push([a, 8, c]);
    assert_eq!(diagnose(&mesh).defects, [12, 13].map(|triangle| Defect::Degenerate { triangle }));
    let dropped = Action::DroppedTriangles { why: Why::NoArea, count: 2, triangles: vec![12, 13] };
    assert_mends(&mesh, 8.0, &[Action::Welded { pairs: vec![[8, a]] }, dropped]);
}

#[test]
fn a_moebius_strip_is_cut_open() {
    let n = 12;
    let corner = |i: u32, side: f32| {
        let angle = std::f32::consts::TAU * i as f32 / n as f32;
        let (out, up) = (side * (angle / 2.0).cos(), side * (angle / 2.0).sin());
        Vec3::new((3.0 + out) * angle.cos(), up, (3.0 + out) * angle.sin())
    };
    let positions = (0..n).flat_map(|i| [corner(i, -1.0), corner(i, 1.0)]).collect();
    let next = |i: u32| if i + 1 < n { [2 * i + 2, 2 * i + 3] } else { [1, 0] };
    let triangles =
        (0..n).flat_map(|i| [[2 * i, 2 * i + 1, next(i)[1]], [2 * i, next(i)[1], next(i)[0]]]).collect();
    let mesh = TriMesh { positions, triangles };
    let defects = diagnose(&mesh).defects;
    assert!(defects.iter().any(|defect| matches!(defect, Defect::OneSided { .. })), "{defects:?}");
    let repaired = mend(&mesh);
    // What was cut is told of as torn: that is why it is not clean.
    assert!(matches!(
        repaired.report.defects[..],
        [Defect::Unwelded { .. }, Defect::Unwelded { .. }, Defect::Open { .. }]
    ));
    assert_eq!(repaired.mesh.positions.len(), 2 * n as usize + 2);
    HalfEdgeMesh::from_mesh(&repaired.mesh).unwrap();
}

#[test]
fn crossings_are_named_and_stay() {
    let mesh = joined(&cube(), &moved(cube(), Vec3::new(1.1, 0.7, 0.3)));
    let report = diagnose(&mesh);
    assert!(!report.defects.is_empty());
    for defect in &report.defects {
        let Defect::Crossing { triangles: [a, b] } = *defect else { panic!("{defect}") };
        assert!(a < 12 && b >= 12, "{defect}");
        assert!(defect.place(&mesh).distance(Vec3::new(0.55, 0.35, 0.15)) < 2.0);
    }
    let repaired = mend(&mesh);
    assert_eq!((repaired.mesh, repaired.actions), (mesh, vec![]));
    assert_eq!(repaired.report, report);
}

#[test]
fn solids_that_touch_cross_but_are_not_joined() {
    let mesh = joined(&cube(), &moved(cube(), Vec3::X * 2.0));
    assert!(diagnose(&mesh).defects.iter().all(|defect| matches!(defect, Defect::Crossing { .. })));
    assert_eq!(mend(&mesh).mesh, mesh);
}

#[test]
fn what_is_inside_out_is_told_from_a_cavity() {
    let small = |turn: bool| {
        let mut mesh = primitives::icosahedron(0.3).unwrap();
        mesh.positions.iter_mut().for_each(|p| *p += Vec3::new(0.01, 0.02, 0.03));
        if turn { turned(mesh) } else { mesh }
    };
    let inner = volume(&small(false));
    assert_eq!(diagnose(&turned(cube())).defects, [Defect::InsideOut { triangle: 0 }]);
    assert_mends(&turned(cube()), 8.0, &[Action::Turned { count: 12, triangles: (0..12).collect() }]);
    let hollow = joined(&cube(), &small(true));
    assert_clean(&hollow, &diagnose(&hollow));
    let nested = joined(&cube(), &small(false));
    assert_eq!(diagnose(&nested).defects, [Defect::InsideOut { triangle: 12 }]);
    assert_mends(&nested, 8.0 - inner, &[Action::Turned { count: 20, triangles: (12..32).collect() }]);
    // On a ray through corners and edges too: the small one is in the middle of the cube's faces.
    let mut centred = primitives::octahedron(0.5).unwrap();
    centred = joined(&cube(), &turned(std::mem::take(&mut centred)));
    assert_clean(&centred, &diagnose(&centred));
}

/// Whether two triangles in general position cross, in f64: an edge of one goes through the other.
fn cross_by_force(mesh: &TriMesh, a: usize, b: usize) -> bool {
    let corners = |t: usize| mesh.triangles[t].map(|v| mesh.positions[v as usize].as_dvec3());
    let side = |[a, b, c]: [DVec3; 3], p: DVec3| (b - a).cross(c - a).dot(p - a) > 0.0;
    let pierces = |p: DVec3, q: DVec3, [a, b, c]: [DVec3; 3]| {
        let turns = [side([p, q, a], b), side([p, q, b], c), side([p, q, c], a)];
        side([a, b, c], p) != side([a, b, c], q) && turns[0] == turns[1] && turns[1] == turns[2]
    };
    let any =
        |[a, b, c]: [DVec3; 3], other| [[a, b], [b, c], [c, a]].iter().any(|&[p, q]| pierces(p, q, other));
    any(corners(a), corners(b)) || any(corners(b), corners(a))
}

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from)
}

/// Coordinates that files hold, and should not.
const STRANGE: [f32; 7] = [0.0, 1.0, -1.0, 0.5, f32::NAN, f32::MAX, 1e-45];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn crossings_are_those_that_brute_force_finds(positions in prop::collection::vec(point(), 60)) {
        let triangles = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = TriMesh { positions, triangles };
        let found: Vec<[u32; 2]> = diagnose(&mesh).defects.iter().filter_map(|defect| match defect {
            Defect::Crossing { triangles } => Some(*triangles),
            _ => None,
        }).collect();
        let pairs = (0..20_u32).flat_map(|a| (a + 1..20).map(move |b| [a, b]));
        let expected: Vec<_> = pairs.filter(|&[a, b]| cross_by_force(&mesh, a as usize, b as usize)).collect();
        prop_assert_eq!(found, expected);
    }

    /// Whatever happens to a mesh, the two never break, agree with the half-edge mesh, and find an end.
    #[test]
    fn damage_is_named_and_mended(
        damage in prop::collection::vec((0_usize..7, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..12),
    ) {
        let mut mesh = primitives::icosphere(1.0, 1).unwrap();
        for (kind, first, second) in damage {
            if mesh.triangles.is_empty() {
                break;
            }
            let (t, v) = (first.index(mesh.triangles.len()), second.index(mesh.positions.len()));
            match kind {
                0 => drop(mesh.triangles.swap_remove(t)),
                1 => mesh.triangles[t].swap(0, 1),
                2 => mesh.triangles.push(mesh.triangles[t]),
                3 => mesh.triangles[t][v % 3] = v as u32,
                4 => mesh.positions[v] = mesh.positions[mesh.triangles[t][0] as usize],
                5 => {
                    mesh.positions.push(mesh.positions[v]);
                    mesh.triangles[t][v % 3] = mesh.positions.len() as u32 - 1;
                }
                _ => mesh.positions[v] *= -0.5,
            }
        }
        let report = diagnose(&mesh);
        let is_surface = report.defects.iter().all(|defect| {
            matches!(defect, Defect::Open { .. } | Defect::Unwelded { .. } | Defect::Crossing { .. } | Defect::InsideOut { .. })
        });
        prop_assert_eq!(is_surface, HalfEdgeMesh::from_mesh(&mesh).is_ok(), "{:?}", report.defects);
        let repaired = mend(&mesh);
        prop_assert_eq!(&repaired.report, &diagnose(&repaired.mesh));
        if repaired.report.is_clean() {
            prop_assert!(MassProperties::of(&repaired.mesh, 1.0).is_ok());
            prop_assert_eq!(mend(&repaired.mesh).actions, vec![]);
        }
    }

    #[test]
    fn soup_is_survived(
        positions in prop::collection::vec(prop::array::uniform3(prop::sample::select(STRANGE.to_vec())), 0..12),
        triangles in prop::collection::vec(prop::array::uniform3(0_u32..13), 0..40),
    ) {
        let mesh = TriMesh { positions: positions.into_iter().map(Vec3::from).collect(), triangles };
        let repaired = mend(&mesh);
        prop_assert_eq!(&repaired.report, &diagnose(&repaired.mesh));
        let wanted = |defect: &Defect| {
            use Defect::{Duplicate, Isolated, MissingVertex, NotFinite};
            matches!(defect, NotFinite { .. } | MissingVertex { .. } | Isolated { .. } | Duplicate { .. })
        };
        prop_assert!(!repaired.report.defects.iter().any(wanted), "{:?}", repaired.report.defects);
    }
}

/// What this thread has worked, in s: other programs on the machine do not count.
#[cfg(target_os = "linux")]
fn worked() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e-9
}

#[test]
#[cfg(target_os = "linux")]
fn large_meshes_take_seconds() {
    let mut mesh = primitives::torus(1.0, 0.4, 320, 160).unwrap();
    let count = mesh.triangles.len();
    assert!(count > 100_000);
    (0..count).step_by(997).for_each(|t| mesh.triangles[t].swap(0, 1));
    (0..count).step_by(1499).for_each(|t| mesh.triangles[t] = mesh.triangles[(t + 7) % count]);
    let start = worked();
    let report = diagnose(&mesh);
    let examined = worked() - start;
    let repaired = mend(&mesh);
    let all = worked() - start;
    println!("{count} triangles: {examined:.2} s, with repair {all:.2} s");
    assert!(report.defects.len() > 100);
    assert_clean(&repaired.mesh, &repaired.report);
    assert!(all < 5.0 * count as f64 / 1e5, "{all} s");
}

/// Triangles around one edge, and closed surfaces inside each other: all lie over all others.
#[test]
#[cfg(target_os = "linux")]
fn heaps_take_seconds_too() {
    let count = 40_000_u32;
    let around = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / f64::from(count);
        Vec3::new(angle.cos() as f32, angle.sin() as f32, 0.0)
    };
    let fan = TriMesh {
        positions: [Vec3::Z, -Vec3::Z].into_iter().chain((0..count).map(around)).collect(),
        triangles: (0..count).map(|k| [0, 1, k + 2]).collect(),
    };
    let mut shells = TriMesh::default();
    for k in 0..count / 4 {
        let first = shells.positions.len() as u32;
        let size = 1.0 + k as f32 * 0.01;
        let corners =
            [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|corner| (corner - Vec3::splat(0.1)) * size);
        shells.positions.extend(corners);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        shells.triangles.extend(faces.map(|face| face.map(|corner| corner + first)));
    }
    for (what, mesh) in [("fan", fan), ("shells", shells)] {
        let start = worked();
        let report = diagnose(&mesh);
        let took = worked() - start;
        println!("{what}: {took:.2} s for {} defects", report.defects.len());
        assert!(!report.is_clean() && took < 5.0 * f64::from(count) / 1e5, "{what}: {took} s");
    }
}
