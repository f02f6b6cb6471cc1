//! Triangles of static meshes.

use glam::{Quat, Vec3};

use super::shapes::*;
use super::*;

struct OnTriangle<'a>(&'a Convex, &'a Triangle, Placement, &'a mut Memory, f32);

impl Kernel for OnTriangle<'_> {
    type Output = Manifold;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Manifold {
        let memory = (self.3, &mut Scratch::default());
        collide_triangle::<L>(self.0, self.1, &self.2, memory, self.4)
    }
}

/// With A at `position` over the mesh.
fn on_triangle(a: &Convex, triangle: &Triangle, position: Vec3, memory: &mut Memory) -> Manifold {
    let triangle_in_a = placed(Quat::IDENTITY, -position);
    run(Instructions::Widest, OnTriangle(a, triangle, triangle_in_a, memory, 0.02))
}

/// A square of the floor, 2 m wide, its diagonal inside the surface; `active` says whether its outline stands out.
fn floor(active: bool) -> [Triangle; 2] {
    let corner = |x, z| Vec3::new(x, 0.0, z);
    let [p, q, r, s] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    let triangle =
        |corners, edges| Triangle { corners, normal: Vec3::Y, active_edges: if active { edges } else { 0 } };
    [triangle([p, q, r], 0b011), triangle([p, r, s], 0b110)]
}

#[test]
fn what_rolls_or_slides_over_an_inner_edge_feels_the_face_only() {
    let shapes = [
        (ball(0.3), 0.3),
        (cuboid(Vec3::splat(0.2)), 0.2),
        (icosahedron(0.4), 0.0),
        (capsule(0.1, 0.2), 0.3),
    ];
    for (a, height) in &shapes {
        let lowest = a.vertices.iter().map(|v| v.y).fold(f32::INFINITY, f32::min) - a.radius;
        assert!(*height == 0.0 || (height + lowest).abs() < 1e-6);
        let mut memories = [Memory::default(); 2];
        for step in -40..40 {
            // Across the diagonal, a millimetre deep.
            let along = step as f32 * 0.017;
            let position = Vec3::new(along, -lowest - 0.001, -0.7 * along + 0.03);
            let mut deepest = f32::INFINITY;
            for (triangle, memory) in floor(true).iter().zip(&mut memories) {
                let manifold = on_triangle(a, triangle, position, memory);
                if manifold.count > 0 {
                    assert!((manifold.normal - Vec3::NEG_Y).length() < 1.5e-3, "{manifold:?} at {position}");
                    assert!(manifold.deepest() > -0.0011, "{manifold:?} at {position}");
                    deepest = deepest.min(manifold.deepest());
                }
            }
            assert!((deepest + 0.001).abs() < 2e-4, "held at {deepest} at {position}");
        }
    }
}

#[test]
fn edges_that_stand_out_are_touched_from_the_side() {
    let ball = ball(0.3);
    let center = Vec3::new(-1.2, 0.2, 0.0);
    let expected = -Vec3::new(-0.2, 0.2, 0.0).normalize();
    let touch = |active| on_triangle(&ball, &floor(active)[0], center, &mut Memory::default());
    let manifold = touch(true);
    assert!((manifold.normal - expected).length() < 1e-4, "{manifold:?}");
    assert!((manifold.deepest() - (0.08_f32.sqrt() - 0.3)).abs() < 1e-5);
    assert!((touch(false).normal - Vec3::NEG_Y).length() < 1e-5);
}

#[test]
fn the_back_is_not_there() {
    for (a, reach) in [(ball(0.3), 0.3), (cuboid(Vec3::splat(0.2)), 0.2)] {
        let at = |y: f32| on_triangle(&a, &floor(true)[0], Vec3::new(-0.3, y, 0.3), &mut Memory::default());
        assert_eq!(at(-reach - 0.001).count, 0);
        assert_eq!(at(reach + 0.021).count, 0);
        // Sunk in up to its middle and beyond it is pushed out to the front.
        for depth in [0.01, 0.1, reach * 1.2] {
            let manifold = at(reach - depth);
            assert!(
                (manifold.normal - Vec3::NEG_Y).length() < 1e-4 && (manifold.deepest() + depth).abs() < 1e-4
            );
        }
    }
}

#[test]
fn a_box_on_a_floor_of_two_triangles_stands_on_all_corners() {
    let cube = cuboid(Vec3::splat(0.2));
    let mut corners = [false; 4];
    for triangle in floor(true) {
        let manifold = on_triangle(&cube, &triangle, Vec3::new(0.0, 0.199, 0.0), &mut Memory::default());
        assert!(manifold.count >= 3);
        for point in manifold.used() {
            let corner = usize::from(point.on_a.x > 0.0) + 2 * usize::from(point.on_a.z > 0.0);
            corners[corner] |= point.on_a.abs().distance(Vec3::splat(0.2)) < 1e-5;
        }
    }
    assert_eq!(corners, [true; 4]);
}
