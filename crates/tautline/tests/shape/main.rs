//! Shapes against closed forms and brute force.

mod compounds;
mod concave;
mod hulls;
mod primitives;
mod refusals;
mod surfaces;

use glam::{DMat3, DVec3};
use tautline::{Shape, Vec3};

fn close(actual: f32, expected: f64, tolerance: f64) {
    assert!((f64::from(actual) / expected - 1.0).abs() < tolerance, "{actual} is not {expected}");
}

/// ∫ x xᵀ dm / m about the centre of mass in the shape's own frame, from four equal particles at s∘t in the
/// principal frame: what a body is made of.
fn particle_moments(shape: &Shape) -> DMat3 {
    let s = shape.second_moments().as_dvec3().map(f64::sqrt);
    let signs = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let particles = signs.map(|t| shape.principal_rotation().as_dquat() * (s * DVec3::from(t)));
    assert!(particles.iter().sum::<DVec3>().length() < 1e-6 * s.length());
    let outer = |p: DVec3| DMat3::from_cols(p * p.x, p * p.y, p * p.z);
    particles.into_iter().fold(DMat3::ZERO, |sum, p| sum + outer(p) * 0.25)
}

fn close_matrix(actual: DMat3, expected: DMat3, tolerance: f64) {
    let scale = expected.diagonal().max_element();
    let difference = (actual - expected).to_cols_array();
    assert!(difference.iter().all(|x| x.abs() < tolerance * scale), "{actual} is not {expected}");
}

/// What holds for every solid.
fn check_frame(shape: &Shape) {
    let moments = shape.second_moments();
    assert!(moments.min_element() > 0.0);
    assert!(moments.x >= moments.y * 0.99999 && moments.y >= moments.z * 0.99999, "{moments}");
    assert!((shape.principal_rotation().length() - 1.0).abs() < 1e-6);
    let reach = shape.positions().iter().map(|p| p.distance(shape.center_of_mass())).fold(0.0, f32::max);
    let rounding = 1e-5 * shape.reach() + 1e-6 * shape.center_of_mass().length();
    assert!(reach <= shape.reach() + rounding, "{reach} > {}", shape.reach());
    assert!(shape.inner_radius() > 0.0 && shape.inner_radius() <= shape.reach());
}

/// A number from −1 to 1 out of a whole one.
fn scatter(seed: u32) -> f32 {
    (seed.wrapping_mul(2_654_435_761) >> 8) as f32 / (1 << 23) as f32 - 1.0
}

fn scattered(seed: u32) -> Vec3 {
    Vec3::new(scatter(3 * seed), scatter(3 * seed + 1), scatter(3 * seed + 2))
}
