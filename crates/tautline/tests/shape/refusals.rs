//! What is no shape is refused by name.

use tautline::mesh::{TriMesh, primitives};
use tautline::{Error, MeshDefect, Quat, Shape, Vec3};

const NUMBERS: [f32; 7] = [0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, 1e-30];

fn field(result: Result<Shape, Error>) -> String {
    match result {
        Err(Error::OutOfRange { field, .. } | Error::Invalid { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}

#[test]
fn sizes() {
    for bad in NUMBERS {
        assert_eq!(field(Shape::sphere(bad)), "radius");
        assert_eq!(field(Shape::capsule(bad, 1.0)), "radius");
        assert_eq!(field(Shape::capsule(1.0, bad)), "half_height");
        assert_eq!(field(Shape::cylinder(bad, 1.0)), "radius");
        assert_eq!(field(Shape::cylinder(1.0, bad)), "half_height");
        assert_eq!(field(Shape::cuboid(Vec3::new(bad, 1.0, 1.0))), "half_extents.x");
        assert_eq!(field(Shape::cuboid(Vec3::new(1.0, bad, 1.0))), "half_extents.y");
        assert_eq!(field(Shape::cuboid(Vec3::new(1.0, 1.0, bad))), "half_extents.z");
    }
}

#[test]
fn too_thin() {
    assert_eq!(field(Shape::cuboid(Vec3::new(1.0, 1e-6, 1.0))), "half_extents");
    assert_eq!(field(Shape::capsule(1e-4, 100.0)), "half_height");
    assert_eq!(field(Shape::cylinder(1.0, 1e-6)), "half_height");
    assert!(Shape::cuboid(Vec3::new(1.0, 2e-5, 1.0)).is_ok());
}

#[test]
fn points_without_volume() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y, Vec3::X + Vec3::Z];
    for count in 0..4 {
        assert_eq!(field(Shape::convex_hull(&corners[..count])), "points", "{count} points");
    }
    let coplanar: Vec<Vec3> = (0..20).map(|k| Vec3::new((k % 5) as f32, (k / 5) as f32, 1.0)).collect();
    let collinear: Vec<Vec3> = (0..20).map(|k| Vec3::new(1.0, 2.0, 3.0) * k as f32).collect();
    let duplicates = vec![Vec3::ONE; 20];
    let three_places: Vec<Vec3> = corners[..3].repeat(7);
    for points in [coplanar, collinear, duplicates, three_places] {
        assert_eq!(field(Shape::convex_hull(&points)), "points");
    }
    let sliver = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::new(0.3, 1e-6, 0.3)];
    assert_eq!(field(Shape::convex_hull(&sliver)), "points");
    let speck = sliver.map(|p| p * 1e-12 + Vec3::ZERO);
    assert_eq!(field(Shape::convex_hull(&speck)), "points");
    assert!(Shape::convex_hull(&corners).is_ok());
}

#[test]
fn coordinates() {
    for bad in [f32::NAN, f32::INFINITY, -2e9] {
        let mut points = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y];
        points[2].y = bad;
        assert_eq!(field(Shape::convex_hull(&points)), "points[2].y");
        let ball = Shape::sphere(1.0).unwrap();
        let good = (&ball, Vec3::ZERO, Quat::IDENTITY);
        let moved = (&ball, Vec3::new(0.0, 0.0, bad), Quat::IDENTITY);
        assert_eq!(field(Shape::compound(&[good, moved])), "parts[1].translation.z");
        let turned = (&ball, Vec3::ZERO, Quat::from_xyzw(bad, 0.0, 0.0, 1.0));
        assert_eq!(field(Shape::compound(&[turned])), "parts[0].rotation");
    }
    assert_eq!(field(Shape::compound(&[])), "parts");
}

#[test]
fn compounds_that_are_mostly_nothing() {
    let dust = Shape::sphere(1e-3).unwrap();
    let parts = [(&dust, Vec3::ZERO, Quat::IDENTITY), (&dust, Vec3::X * 1e6, Quat::IDENTITY)];
    assert_eq!(field(Shape::compound(&parts)), "parts");
}

/// Each defect of a mesh, by the same name for a solid and for ground.
#[test]
fn meshes_with_defects() {
    let tetrahedron = primitives::tetrahedron(1.0).unwrap();
    let with = |change: &dyn Fn(&mut TriMesh)| {
        let mut mesh = tetrahedron.clone();
        change(&mut mesh);
        mesh
    };
    type IsExpected = fn(&MeshDefect) -> bool;
    let cases: [(TriMesh, IsExpected); 6] = [
        (with(&|m| m.triangles[2][1] = 4), |d| {
            matches!(d, MeshDefect::IndexOutOfRange { triangle: 2, vertex: 4, count: 4 })
        }),
        (with(&|m| m.triangles[2][1] = m.triangles[2][0]), |d| {
            matches!(d, MeshDefect::DegenerateTriangle { triangle: 2 })
        }),
        (with(&|m| m.triangles.push(m.triangles[1])), |d| {
            matches!(d, MeshDefect::DuplicateTriangle { first: 1, second: 4 })
        }),
        (
            with(&|m| {
                let [a, b, _] = m.triangles[0];
                m.positions.push(Vec3::splat(3.0));
                m.triangles.push([b, a, 4]);
            }),
            |d| matches!(d, MeshDefect::NonManifoldEdge { triangle: 4, .. }),
        ),
        (
            // Two that share a corner.
            with(&|m| {
                let corner = m.positions[0];
                m.positions.extend((1..4).map(|k| corner * 2.0 - tetrahedron.positions[k]));
                let other = |v: u32| if v == 0 { 0 } else { v + 3 };
                // Mirrored in a point: the other way round.
                m.triangles
                    .extend(tetrahedron.triangles.iter().map(|&[a, b, c]| [other(a), other(c), other(b)]));
            }),
            |d| matches!(d, MeshDefect::BowTieVertex { vertex: 0 }),
        ),
        (with(&|m| m.positions.push(Vec3::ZERO)), |d| matches!(d, MeshDefect::IsolatedVertex { vertex: 4 })),
    ];
    for (k, (mesh, is_expected)) in cases.iter().enumerate() {
        for refused in [Shape::from_mesh(mesh), Shape::triangle_mesh(mesh)] {
            match refused {
                Err(Error::Mesh(defect)) => assert!(is_expected(&defect), "{k}: {defect}"),
                other => panic!("{k}: {other:?}"),
            }
        }
    }
}
