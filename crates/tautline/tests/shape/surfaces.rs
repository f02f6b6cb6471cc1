//! Triangle meshes and height fields: shapes without a mass.

use tautline::mesh::{TriMesh, primitives};
use tautline::{Error, MeshDefect, Quat, Shape, Vec3};

#[test]
fn a_triangle_mesh_stays_in_its_frame() {
    let mut sheet = primitives::grid(4, 3, 2.0, 1.0).unwrap();
    sheet.positions.iter_mut().for_each(|position| *position += Vec3::new(5.0, 0.0, 0.0));
    let shape = Shape::triangle_mesh(&sheet).unwrap();
    assert!(!shape.is_solid());
    assert_eq!((shape.volume(), shape.second_moments(), shape.inner_radius()), (0.0, Vec3::ZERO, 0.0));
    assert_eq!((shape.center_of_mass(), shape.principal_rotation()), (Vec3::ZERO, Quat::IDENTITY));
    assert_eq!((shape.positions(), shape.triangles()), (&sheet.positions[..], &sheet.triangles[..]));
    assert_eq!(shape.reach(), 36.25_f32.sqrt());
    assert_eq!(shape.part_count(), 0);
}

#[test]
fn a_height_field_is_a_grid() {
    let shape = Shape::height_field(3, 2, 2.0, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
    assert!(!shape.is_solid());
    assert_eq!(shape.triangles().len(), 4);
    assert_eq!(shape.positions()[1], Vec3::new(0.0, 1.0, -1.0));
    assert_eq!(shape.positions()[5], Vec3::new(2.0, 5.0, 1.0));
}

fn field(result: Result<Shape, Error>) -> String {
    match result {
        Err(Error::OutOfRange { field, .. } | Error::Invalid { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}

#[test]
fn refusals() {
    assert_eq!(field(Shape::height_field(1, 2, 1.0, &[0.0; 2])), "columns");
    assert_eq!(field(Shape::height_field(2, u32::MAX, 1.0, &[0.0; 2])), "rows");
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(field(Shape::height_field(2, 2, bad, &[0.0; 4])), "cell_size");
    }
    assert_eq!(field(Shape::height_field(2, 2, 1.0, &[0.0; 5])), "heights");
    assert_eq!(field(Shape::height_field(2, 2, 1.0, &[0.0, 0.0, f32::NAN, 0.0])), "heights[2]");
    let sheet = primitives::grid(3, 3, 1.0, 1.0).unwrap();
    let flipped = TriMesh { triangles: vec![[0, 1, 2], [0, 1, 3]], positions: sheet.positions[..4].to_vec() };
    let refused = Shape::triangle_mesh(&flipped);
    assert!(matches!(refused, Err(Error::Mesh(MeshDefect::FlippedTriangle { .. }))));
    let mut far = sheet.clone();
    far.positions[1].z = f32::INFINITY;
    assert_eq!(field(Shape::triangle_mesh(&far)), "positions[1].z");
    let ground = Shape::triangle_mesh(&sheet).unwrap();
    assert_eq!(field(Shape::compound(&[(&ground, Vec3::ZERO, Quat::IDENTITY)])), "parts[0].shape");
}
