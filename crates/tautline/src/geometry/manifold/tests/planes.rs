//! Half-spaces.

use glam::{Quat, Vec3};

use super::distances::zoo;
use super::shapes::*;
use super::*;

struct Plane<'a>(&'a Convex, Vec3, f32, f32);

impl Kernel for Plane<'_> {
    type Output = Manifold;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Manifold {
        collide_plane::<L>(self.0, self.1, self.2, &mut Scratch::default(), self.3)
    }
}

fn on_plane(a: &Convex, normal: Vec3, offset: f32, margin: f32) -> Manifold {
    run(Instructions::Widest, Plane(a, normal, offset, margin))
}

#[test]
fn the_lowest_point_is_among_the_points_and_all_are_on_both_surfaces() {
    let mut random = Random(31);
    for a in zoo() {
        for _ in 0..100 {
            let normal = random.direction();
            let lowest = a.vertices.iter().map(|v| v.dot(normal)).fold(f32::INFINITY, f32::min) - a.radius;
            let gap = random.between(-0.1, 0.04);
            let manifold = on_plane(&a, normal, lowest - gap, 0.02);
            assert_eq!(manifold.count == 0, gap > 0.02);
            assert_eq!(manifold.normal, -normal);
            for point in manifold.used() {
                assert!((normal.dot(point.on_b) - (lowest - gap)).abs() < 1e-5);
                assert!((point.on_b - point.on_a + normal * point.separation).length() < 1e-6);
                assert!(point.separation <= 0.02 + 1e-6);
                let core = point.on_a + normal * a.radius;
                assert!(a.vertices.iter().any(|v| v.distance(core) < 1e-6));
            }
            if manifold.count > 0 {
                assert!((manifold.deepest() - gap).abs() < 1e-4, "{} {gap}", manifold.deepest());
            }
            assert!(manifold.keys().windows(2).all(|pair| pair[0] != pair[1]));
        }
    }
}

#[test]
fn a_standing_cylinder_has_a_wide_base() {
    for turn in 0..10 {
        let normal = Quat::from_rotation_x(1e-5 * turn as f32) * Vec3::Y;
        let manifold = on_plane(&prism(32, 1.0, 0.5), normal, -0.499, 0.01);
        // The largest square in a circle of radius 1 has area 2.
        assert!(manifold.count == 4 && manifold.area() > 1.95, "{}", manifold.area());
    }
}
