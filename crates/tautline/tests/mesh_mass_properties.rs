//! Mass properties against closed forms.

use glam::{DMat3, DVec3, dvec3};
use proptest::prelude::*;
use tautline::mesh::{MassProperties, TriMesh, convex_hull, primitives};
use tautline::{Error, MeshDefect, Vec3};

const GOLDEN: f64 = 1.618_033_988_749_895;

/// Positions are rounded to f32, so closed forms hold to about 1e-7.
const ROUNDING: f64 = 4e-7;

fn of(mesh: Result<TriMesh, Error>) -> MassProperties {
    MassProperties::of(&mesh.unwrap(), 3.0).unwrap()
}

fn close(actual: f64, expected: f64, tolerance: f64) {
    assert!((actual / expected - 1.0).abs() < tolerance, "{actual} is not {expected}");
}

fn close_matrix(actual: DMat3, expected: DMat3, tolerance: f64) {
    let scale = expected.diagonal().abs().max_element();
    assert!(
        (actual - expected).to_cols_array().iter().all(|x| x.abs() < tolerance * scale),
        "{actual} is not {expected}"
    );
}

/// Volume and I / m of a solid around the origin.
fn check(properties: MassProperties, volume: f64, inertia_per_mass: DVec3, tolerance: f64) {
    close(properties.volume, volume, tolerance);
    close(properties.mass, 3.0 * volume, tolerance);
    assert!(properties.center_of_mass.length() < 1e-7);
    close_matrix(properties.inertia, DMat3::from_diagonal(inertia_per_mass * properties.mass), tolerance);
}

#[test]
fn platonic_solids() {
    let edge = 2.0 * (8.0_f64 / 3.0).sqrt();
    check(
        of(primitives::tetrahedron(2.0)),
        edge.powi(3) / 72_f64.sqrt(),
        DVec3::splat(edge * edge / 20.0),
        ROUNDING,
    );

    let edge = 2.0 * 2_f64.sqrt();
    check(
        of(primitives::octahedron(2.0)),
        edge.powi(3) * 2_f64.sqrt() / 3.0,
        DVec3::splat(edge * edge / 10.0),
        ROUNDING,
    );

    let edge = 2.0 / (0.4 * std::f64::consts::PI).sin();
    let volume = 5.0 / 6.0 * GOLDEN.powi(2) * edge.powi(3);
    check(
        of(primitives::icosahedron(2.0)),
        volume,
        DVec3::splat(edge * edge * GOLDEN.powi(2) / 10.0),
        ROUNDING,
    );

    let edge = 4.0 / (3_f64.sqrt() * GOLDEN);
    let volume = (15.0 + 7.0 * 5_f64.sqrt()) / 4.0 * edge.powi(3);
    check(
        of(primitives::dodecahedron(2.0)),
        volume,
        DVec3::splat(edge * edge * (39.0 * GOLDEN + 28.0) / 150.0),
        ROUNDING,
    );
}

#[test]
fn boxes() {
    let inertia = dvec3(4.0 + 0.25, 1.0 + 0.25, 1.0 + 4.0) / 3.0;
    let properties = of(primitives::cuboid(Vec3::new(1.0, 2.0, 0.5)));
    check(properties, 8.0, inertia, 1e-14);
    assert_eq!(properties.principal_axes, DMat3::IDENTITY);
    assert_eq!(properties.principal_moments, properties.inertia.diagonal());
    assert_eq!(properties.principal_second_moments, properties.second_moments.diagonal());
}

/// A cylinder of n segments is a prism over a regular polygon: ∫ x² dA = A r² (2 + cos 2π/n) / 12.
#[test]
fn cylinder_is_the_regular_prism() {
    let (radius, half_height) = (0.5_f64, 2.0_f64);
    for segments in [3, 4, 7, 32] {
        let angle = std::f64::consts::TAU / f64::from(segments);
        let area = 0.5 * f64::from(segments) * radius * radius * angle.sin();
        let (across, along) = (radius * radius * (2.0 + angle.cos()) / 12.0, half_height * half_height / 3.0);
        let inertia = dvec3(across + along, 2.0 * across, across + along);
        check(of(primitives::cylinder(0.5, 2.0, segments)), 2.0 * half_height * area, inertia, ROUNDING);
    }
}

/// Halving the edges quarters the error.
#[test]
fn round_solids_converge_to_their_closed_forms() {
    use std::f64::consts::PI;
    let sphere = |n: u32| of(primitives::icosphere(2.0, n + 2));
    let sphere_inertia = DVec3::splat(0.4 * 4.0);
    let torus = |n: u32| of(primitives::torus(1.0, 0.25, 32 << n, 16 << n));
    let across = 0.5 + 0.625 * 0.0625;
    let torus_inertia = dvec3(across, 1.0 + 0.75 * 0.0625, across);
    let capsule = |n: u32| of(primitives::capsule(0.5, 1.0, 32 << n, 8 << n));
    let capsule_volume = PI * 0.25 * 2.0 + PI / 6.0;
    // Cylinder of length 2 and two half spheres, whose centres of mass are 3/8 r beyond their flat sides.
    let (rod, balls) = (PI * 0.5 / capsule_volume, PI / 6.0 / capsule_volume);
    let across = rod * (0.25 / 4.0 + 1.0 / 3.0) + balls * (0.4 * 0.25 + 1.0 + 2.0 * 0.375 * 0.5);
    let capsule_inertia = dvec3(across, rod * 0.125 + balls * 0.1, across);

    type Solid<'a> = (&'a dyn Fn(u32) -> MassProperties, f64, DVec3);
    let solids: [Solid; 3] = [
        (&sphere, 4.0 / 3.0 * PI * 8.0, sphere_inertia),
        (&torus, 2.0 * PI * PI * 0.0625, torus_inertia),
        (&capsule, capsule_volume, capsule_inertia),
    ];
    for (solid, volume, inertia) in solids {
        let error = |n: u32| {
            let properties = solid(n);
            let inertia_error = properties.inertia * (1.0 / properties.mass) - DMat3::from_diagonal(inertia);
            let largest = inertia_error.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
            [(properties.volume / volume - 1.0).abs(), largest / inertia.max_element()]
        };
        let (coarse, fine) = (error(0), error(2));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            assert!(fine < 3e-3 && (14.0..18.0).contains(&(coarse / fine)), "{coarse} {fine}");
        }
    }
}

/// A cube under any affine map: C = V A Aᵀ / 3 for half extents 1.
fn parallelepiped(map: DMat3, shift: DVec3) -> (TriMesh, DMat3) {
    let mut mesh = primitives::cube(2.0).unwrap();
    for position in &mut mesh.positions {
        *position = (map * position.as_dvec3() + shift).as_vec3();
    }
    if map.determinant() < 0.0 {
        mesh.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    (mesh, map * map.transpose() * (8.0 * map.determinant().abs() / 3.0))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    /// In 64ths, so that f32 holds every corner exactly.
    #[test]
    fn parallelepipeds(entries in prop::array::uniform9(-64_i32..65), shift in prop::array::uniform3(-9999_i32..9999)) {
        let map = DMat3::from_cols_array(&entries.map(|entry| f64::from(entry) / 64.0));
        prop_assume!(map.determinant().abs() > 1e-3);
        let shift = DVec3::from(shift.map(f64::from)) / 64.0;
        let (mesh, second_moments) = parallelepiped(map, shift);
        let properties = MassProperties::of(&mesh, 1.0).unwrap();
        close(properties.volume, 8.0 * map.determinant().abs(), 1e-11);
        close_matrix(properties.second_moments, second_moments, 1e-11);
        prop_assert!((properties.center_of_mass - shift).length() < 1e-11);
    }

    /// The principal frame is a rotation in which the matrices are the stated diagonals, for needles and plates too.
    #[test]
    fn principal_axes_diagonalise(
        entries in prop::array::uniform9(-1.0_f64..1.0), thickness in -4_i32..1, width in -4_i32..1,
    ) {
        let map = DMat3::from_cols_array(&entries);
        prop_assume!(map.determinant().abs() > 0.05);
        let squeeze = DMat3::from_diagonal(dvec3(10_f64.powi(thickness), 10_f64.powi(width), 1.0));
        let (mesh, _) = parallelepiped(map * squeeze, DVec3::ZERO);
        let properties = MassProperties::of(&mesh, 1.0).unwrap();
        let axes = properties.principal_axes;
        close_matrix(axes.transpose() * axes, DMat3::IDENTITY, 1e-13);
        prop_assert!((axes.determinant() - 1.0).abs() < 1e-13);
        let rebuilt = |diagonal: DVec3| axes * DMat3::from_diagonal(diagonal) * axes.transpose();
        close_matrix(rebuilt(properties.principal_second_moments), properties.second_moments, 1e-12);
        close_matrix(rebuilt(properties.principal_moments), properties.inertia, 1e-12);
    }

    /// By steps that f32 adds exactly, so that any difference is the method's own.
    #[test]
    fn moving_a_body_moves_its_centre_only(
        corners in prop::collection::vec(prop::array::uniform3(-64_i32..64), 8..20), shift in prop::array::uniform3(-1000_i32..1000),
    ) {
        let at = |[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, z as f32) / 64.0;
        let points: Vec<Vec3> = corners.into_iter().map(at).collect();
        let Ok(hull) = convex_hull(&points) else { return Ok(()) };
        let shift = at(shift) * 64.0;
        let mut moved = hull.mesh.clone();
        moved.positions.iter_mut().for_each(|position| *position += shift);
        let (here, there) = (MassProperties::of(&hull.mesh, 2.0).unwrap(), MassProperties::of(&moved, 2.0).unwrap());
        prop_assert_eq!((here.volume, here.inertia, here.principal_axes), (there.volume, there.inertia, there.principal_axes));
        prop_assert!((there.center_of_mass - here.center_of_mass - shift.as_dvec3()).length() < 1e-12);
    }
}

/// About its corner a box has I_xx = m (b² + c²) / 3 and I_xy = −m a b / 4, its sides being a, b, c.
#[test]
fn parallel_axes_lead_to_the_corner_of_a_box() {
    let [a, b, c] = [2.0, 4.0, 1.0];
    let corner = dvec3(1.0, 2.0, 0.5);
    let about = of(primitives::cuboid(corner.as_vec3())).inertia_about(-corner);
    let row = |x: f64, y: f64, z: f64| dvec3(x, y, z) * 24.0;
    let expected = DMat3::from_cols(
        row((b * b + c * c) / 3.0, -a * b / 4.0, -a * c / 4.0),
        row(-a * b / 4.0, (a * a + c * c) / 3.0, -b * c / 4.0),
        row(-a * c / 4.0, -b * c / 4.0, (a * a + b * b) / 3.0),
    );
    close_matrix(about, expected, 1e-14);
}

/// Two cubes of side 2 at x = ±3 are one body; its inertia about y is that of both plus m d².
#[test]
fn separate_surfaces_add_up() {
    let mut mesh = primitives::cube(2.0).unwrap();
    let other = mesh.clone();
    mesh.positions.iter_mut().for_each(|position| position.x -= 3.0);
    mesh.positions.extend(other.positions.iter().map(|position| *position + 3.0 * Vec3::X));
    mesh.triangles.extend(other.triangles.iter().map(|corners| corners.map(|vertex| vertex + 8)));
    check(of(Ok(mesh)), 16.0, dvec3(2.0 / 3.0, 2.0 / 3.0 + 9.0, 2.0 / 3.0 + 9.0), 1e-14);
}

#[test]
fn a_surface_turned_inside_out_within_another_is_a_cavity() {
    let (mut mesh, inner) = (primitives::cube(4.0).unwrap(), primitives::cube(2.0).unwrap());
    mesh.triangles.extend(inner.triangles.iter().map(|&[a, b, c]| [a + 8, c + 8, b + 8]));
    mesh.positions.extend(inner.positions);
    check(of(Ok(mesh)), 56.0, DVec3::splat((64.0 * 8.0 - 8.0 * 2.0) / 3.0 / 56.0), 1e-14);
}

#[test]
fn unusable_meshes_and_densities_are_refused() {
    let cube = primitives::cube(1.0).unwrap();
    for density in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let refused = MassProperties::of(&cube, density);
        assert!(matches!(refused, Err(Error::OutOfRange { field, .. }) if field == "density"));
    }
    let mut inside_out = cube.clone();
    inside_out.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    let refused = MassProperties::of(&inside_out, 1.0);
    assert!(matches!(refused, Err(Error::Mesh(MeshDefect::NotPositiveVolume { volume })) if volume == -1.0));

    let mut open = cube.clone();
    open.triangles.pop();
    assert!(matches!(MassProperties::of(&open, 1.0), Err(Error::Mesh(MeshDefect::OpenEdge { .. }))));

    let mut flat = cube;
    for position in &mut flat.positions {
        // Sheared first, so that no triangle collapses; all in numbers that f32 holds exactly.
        position.x += 0.25 * position.y;
        position.z += 0.75 * position.y;
        position.y = 0.5 * position.x + 0.25 * position.z;
    }
    assert!(matches!(MassProperties::of(&flat, 1.0), Err(Error::Mesh(MeshDefect::NotPositiveVolume { .. }))));
}

/// An outer cube with two cavities that together reach out of it: volume above 0, a second moment below.
#[test]
fn a_surface_that_cuts_through_itself_is_refused() {
    let mut mesh = primitives::cube(4.0).unwrap();
    let cavity = primitives::cuboid(Vec3::new(6.0, 0.5, 0.5)).unwrap();
    mesh.triangles.extend(cavity.triangles.iter().map(|&[a, b, c]| [a + 8, c + 8, b + 8]));
    mesh.positions.extend(cavity.positions);
    let refused = MassProperties::of(&mesh, 1.0);
    assert!(matches!(refused, Err(Error::Invalid { field, .. }) if field == "mesh"));
}
