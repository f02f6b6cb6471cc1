//! Whether segments and triangles pass through triangles, up to the last bit that `f64` is sure of.

use tautline::DVec3;

/// Whether a segment's ends are on opposite sides of a triangle's plane, and the place between them is in the triangle
/// or on its edge. A segment that only touches the plane does not pass through it: within rounding, an end in the
/// plane is on neither side.
pub(super) fn passes_through([start, end]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let [a, b, c] = triangle;
    side(a, b, c, start) * side(a, b, c, end) < 0 && line_meets([start, end], triangle)
}

/// Whether an edge of one of two triangles passes through the other.
pub(super) fn triangles_intersect(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let sides = |of: [DVec3; 3], [a, b, c]: [DVec3; 3]| of.map(|corner| side(a, b, c, corner));
    let sides_of_b = sides(b, a);
    // Most pairs: one is on one side of the other's plane, or both are in one plane.
    if sides_of_b.iter().all(|&side| side == sides_of_b[0]) {
        return false;
    }
    let sides_of_a = sides(a, b);
    (0..3).any(|k| {
        let next = (k + 1) % 3;
        sides_of_b[k] * sides_of_b[next] < 0 && line_meets([b[k], b[next]], a)
            || sides_of_a[k] * sides_of_a[next] < 0 && line_meets([a[k], a[next]], b)
    })
}

/// Whether the line through two points passes all three edges of a triangle on one side. An edge it meets belongs to
/// the triangle, or a segment could slip through the seam between two.
fn line_meets([start, end]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let around = [side(start, end, a, b), side(start, end, b, c), side(start, end, c, a)];
    around.iter().all(|&side| side >= 0) || around.iter().all(|&side| side <= 0)
}

/// On which side of the plane through a, b, c the point d is: the sign of (a − d) · (b − d) × (c − d), and 0 where
/// rounding could have turned it.
fn side(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> i32 {
    let (a, b, c) = (a - d, b - d, c - d);
    let products = [[b.x * c.y, c.x * b.y, a.z], [c.x * a.y, a.x * c.y, b.z], [a.x * b.y, b.x * a.y, c.z]];
    let (mut determinant, mut permanent) = (0.0, 0.0);
    for [plus, minus, z] in products {
        determinant += z * (plus - minus);
        permanent += z.abs() * (plus.abs() + minus.abs());
    }
    if determinant.abs() <= ROUNDING * permanent {
        return 0;
    }
    if determinant > 0.0 { 1 } else { -1 }
}

/// (7 + 56ε) ε with ε = 2⁻⁵³: the bound of orient3d's first stage (Shewchuk 1997, Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates, section 4.3), which holds for its order of operations.
const ROUNDING: f64 = (7.0 + 28.0 * f64::EPSILON) * (0.5 * f64::EPSILON);

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn passes(start: [f64; 3], end: [f64; 3]) -> bool {
        let ends = [DVec3::from_array(start), DVec3::from_array(end)];
        let back = [ends[1], ends[0]];
        let [a, b, c] = TRIANGLE;
        let turned = [[a, b, c], [b, c, a], [c, b, a]];
        let found = passes_through(ends, TRIANGLE);
        assert!(turned.iter().all(|&t| passes_through(ends, t) == found && passes_through(back, t) == found));
        found
    }

    #[test]
    fn through_the_inside_an_edge_or_a_corner_but_not_beside_it() {
        assert!(passes([0.2, 0.2, 1.0], [0.3, 0.3, -1.0]));
        assert!(passes([0.5, 0.5, 1.0], [0.5, 0.5, -1.0]), "the longest edge");
        assert!(passes([0.5, 0.0, 1.0], [0.5, 0.0, -1.0]), "a short edge");
        assert!(passes([0.0, 1.0, 1.0], [0.0, 1.0, -1.0]), "a corner");
        assert!(!passes([0.51, 0.5, 1.0], [0.51, 0.5, -1.0]));
        assert!(!passes([-1e-12, 0.5, 1.0], [-1e-12, 0.5, -1.0]));
    }

    #[test]
    fn what_touches_or_lies_in_the_plane_does_not_pass() {
        assert!(!passes([0.2, 0.2, 1.0], [0.2, 0.2, 0.0]));
        assert!(!passes([0.2, 0.2, 1.0], [0.2, 0.2, 1e-9]));
        assert!(!passes([-1.0, 0.2, 0.0], [1.0, 0.2, 0.0]));
        assert!(passes([0.2, 0.2, 1.0], [0.2, 0.2, -1e-9]));
        assert!(!passes_through([DVec3::Z, DVec3::NEG_Z], [DVec3::NEG_X, DVec3::ZERO, DVec3::X]), "no area");
    }

    #[test]
    fn far_from_the_origin_what_f32_can_tell_apart_is_told_apart() {
        let far = DVec3::new(1000.0, 2000.0, -500.0);
        let triangle = TRIANGLE.map(|corner| corner * 0.01 + far);
        let above = far + DVec3::new(0.002, 0.002, 0.01);
        // The spacing of f32 at −500.
        let below = far + DVec3::new(0.002, 0.002, -3e-5);
        assert!(passes_through([above, below], triangle));
        assert!(!passes_through([above, far + DVec3::new(0.002, 0.002, 3e-5)], triangle));
    }
}
