//! One substep of free motion that keeps bodies rigid and their spin exact.
//!
//! Moving the four particles by their displacements and projecting them back onto a rigid body would lose spin,
//! dω/dt = −ω³h. The discrete Moser–Veselov equation instead asks for the rotation R' with
//! Σₖ Cₖ Rₖ × (Aₖ − R'ₖ) = 0: angular momentum is kept to rounding and energy does not drift (Moser & Veselov 1991;
//! Hairer, Lubich & Wanner, Geometric Numerical Integration, VII.5). With the quaternion (u, s) of the turn in the
//! body's frame it reads 2 (s I u + u × I u) = I ω h, and is solved by iterating
//! u ← (ω h/2 − I⁻¹ (u × I u)) / s, s = √(1 − u·u).

use crate::simd::{LANES, Lanes, Matrix3x8, Row, Vec3x8};

use super::block::{Block, Motion};

/// How often u is improved; each gains a factor of about |ω h|.
const ITERATIONS: usize = 3;

/// Moves eight bodies by a substep of `h` (s) and returns their rows after it, damped.
#[inline(always)]
pub(super) fn advance<L: Lanes>(block: &mut Block, columns: &[L; LANES], h: f32) -> [L; LANES] {
    let motion = block.motion(columns);
    let center = Vec3x8::load(&block.center) + motion.linear;
    center.store(&mut block.center);

    let inertia = Vec3x8::<L>::load(&block.constants.inertia);
    let turn = turn_of(motion.angular, inertia);
    let axes = Matrix3x8::<L>::load(&block.axes);
    // L in the world's frame stays; ω follows from where the axes are now.
    let momentum = axes.apply(motion.angular.scale(inertia));
    let [x, y, z] = turn.0;
    let turned = Matrix3x8([axes.apply(x), axes.apply(y), axes.apply(z)]);
    turned.store(&mut block.axes);
    let momentum = turned.apply_transposed(momentum);
    let angular = Vec3x8::new(momentum.x / inertia.x, momentum.y / inertia.y, momentum.z / inertia.z);

    let in_start = Matrix3x8::<L>::load(&block.start_axes).apply_transposed(turned.apply(angular));
    let (linear, angular) = (kept(&block.constants.damping[0], h), kept(&block.constants.damping[1], h));
    block.velocity_rows(Motion { linear: motion.linear * linear, angular: in_start * angular })
}

/// What a substep of `h` (s) leaves of a motion that dies out at this rate (1/s).
#[inline(always)]
fn kept<L: Lanes>(rate: &Row, h: f32) -> L {
    L::splat(1.0) / (L::splat(1.0) + L::load(rate) * L::splat(h))
}

/// Of the quaternion with this imaginary part. Half a turn in a substep is as far as the equation goes; what spins
/// faster is held there.
#[inline(always)]
fn real_part<L: Lanes>(u: Vec3x8<L>) -> L {
    (L::splat(1.0) - u.length_squared()).max(L::splat(0.1)).sqrt()
}

/// The rotation, in the body's frame, of a body that turns by `angular` = ω h.
#[inline(always)]
fn turn_of<L: Lanes>(angular: Vec3x8<L>, inertia: Vec3x8<L>) -> Matrix3x8<L> {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    let inverse = Vec3x8::new(one / inertia.x, one / inertia.y, one / inertia.z);
    let half = angular * L::splat(0.5);
    let mut u = half;
    for _ in 0..ITERATIONS {
        let coupling = u.cross(u.scale(inertia)).scale(inverse);
        u = (half - coupling) * (one / real_part(u));
    }
    // Renormalised, so that the columns are unit also where the iteration has not ended.
    let s = real_part(u);
    let length = (u.length_squared() + s * s).sqrt();
    let (u, s) = (u * (one / length), s / length);
    let (x, y, z) = (u.x, u.y, u.z);
    Matrix3x8([
        Vec3x8::new(one - two * (y * y + z * z), two * (x * y + z * s), two * (x * z - y * s)),
        Vec3x8::new(two * (x * y - z * s), one - two * (x * x + z * z), two * (y * z + x * s)),
        Vec3x8::new(two * (x * z + y * s), two * (y * z - x * s), one - two * (x * x + y * y)),
    ])
}
