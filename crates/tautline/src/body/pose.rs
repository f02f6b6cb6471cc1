//! The rotation of a body that is stored as particles.

use glam::{DVec3, Quat, Vec3};

/// The rotation that carries `rest` (about its mean) into `positions` (about `center`) with the least squared
/// error: the eigenvector of the largest eigenvalue of Horn's 4 × 4 matrix (Horn 1987, section 4). Identity for
/// fewer than two distinct points.
pub(crate) fn best_rotation(rest: &[Vec3], positions: &[Vec3], center: Vec3) -> Quat {
    let mut s = [[0.0; 3]; 3];
    for (r, x) in rest.iter().zip(positions) {
        let (r, x): (DVec3, DVec3) = (r.as_dvec3(), (*x - center).as_dvec3());
        for i in 0..3 {
            for j in 0..3 {
                s[i][j] += r[i] * x[j];
            }
        }
    }
    let matrix = [
        [s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]],
        [s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]],
        [s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]],
        [s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]],
    ];
    let [w, x, y, z] = largest_eigenvector(matrix);
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    Quat::from_xyzw((x * sign) as f32, (y * sign) as f32, (z * sign) as f32, (w * sign) as f32).normalize()
}

/// Of a symmetric matrix, by Jacobi's rotations: each zeroes one entry off the diagonal; a few rounds over all
/// six leave only rounding.
fn largest_eigenvector(mut m: [[f64; 4]; 4]) -> [f64; 4] {
    let mut vectors =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    for _ in 0..10 {
        for p in 0..3 {
            for q in p + 1..4 {
                rotate(&mut m, &mut vectors, p, q);
            }
        }
    }
    let largest = (1..4).fold(0, |best, k| if m[k][k] > m[best][best] { k } else { best });
    [0, 1, 2, 3].map(|row| vectors[row][largest])
}

fn rotate(m: &mut [[f64; 4]; 4], vectors: &mut [[f64; 4]; 4], p: usize, q: usize) {
    if m[p][q].abs() < f64::MIN_POSITIVE {
        return;
    }
    let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    let sign = if theta < 0.0 { -1.0 } else { 1.0 };
    let t = sign / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    let turned = |x: f64, y: f64| (c * x - s * y, s * x + c * y);
    for row in m.iter_mut().chain(vectors) {
        (row[p], row[q]) = turned(row[p], row[q]);
    }
    let (row_p, row_q) = (m[p], m[q]);
    for (column, (x, y)) in row_p.into_iter().zip(row_q).enumerate() {
        (m[p][column], m[q][column]) = turned(x, y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_rotation_that_was_applied_also_half_turns() {
        let rest =
            [Vec3::new(0.4, 0.1, 0.0), Vec3::new(-0.3, 0.5, 0.2), Vec3::new(0.1, -0.4, 0.6), Vec3::ZERO];
        let mean = rest.iter().sum::<Vec3>() / 4.0;
        let rest = rest.map(|p| p - mean);
        let center = Vec3::new(5.0, -3.0, 2.0);
        for (axis, angle) in
            [(Vec3::X, 0.3), (Vec3::Y, std::f32::consts::PI), (Vec3::new(0.6, 0.0, 0.8), 2.0)]
        {
            let rotation = Quat::from_axis_angle(axis, angle);
            let moved = rest.map(|p| center + rotation * p);
            let found = best_rotation(&rest, &moved, center);
            assert!(found.dot(rotation).abs() > 1.0 - 1e-6, "{axis} {angle}: {found} {rotation}");
        }
        assert_eq!(best_rotation(&[Vec3::ZERO], &[center], center), Quat::IDENTITY);
    }
}
