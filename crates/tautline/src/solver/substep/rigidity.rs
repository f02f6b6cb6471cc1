//! One substep of free motion that keeps bodies rigid and their spin exact.
//!
//! Moving the four particles by their displacements and projecting them back onto a rigid body would lose spin,
//! dω/dt = −ω³h. The discrete Moser–Veselov equation instead asks for the rotation R' with
//! Σₖ Cₖ Rₖ × (Aₖ − R'ₖ) = 0: angular momentum is kept to rounding and energy does not drift (Moser & Veselov 1991;
//! Hairer, Lubich & Wanner, Geometric Numerical Integration, VII.5). With the quaternion (u, s) of the turn in the
//! body's frame it reads 2 (s I u + u × I u) = I ω h, and is solved by iterating
//! u ← (ω h/2 − I⁻¹ (u × I u)) / s, s = √(1 − u·u).

use crate::simd::{LANES, Lanes, Matrix3x8, Row, Vec3x8};

use super::block::Block;

/// How often u is improved; each gains a factor of about |ω h|.
const ITERATIONS: usize = 3;
/// Half the angle, in rad, up to which a substep's rotation is solved for; beyond, a body keeps its ω.
pub(super) const FASTEST: f32 = 0.5;
/// From this ratio of its moments of inertia on a body is too fast sooner: a rotation that is off by ε turns ε of the
/// angular momentum onto the axis of the least moment, and adds ε² times the ratio to the energy.
const SLENDER: f32 = 16.0;
/// Up to this |half| I₁/I₃ one iteration will do.
const SLOWEST: f32 = 1e-4;
/// From here on more energy than there was is not rounding.
const ROUNDED: f32 = 1.0001;

/// Moves eight bodies by a substep of `h` (s) and returns their rows after it, damped by their own rates and that of
/// the world (1/s).
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn advance<L: Lanes>(block: &mut Block, columns: &[L; LANES], h: f32, damping: f32) -> [L; LANES] {
    let motion = block.motion(columns);
    let shift = Vec3x8::load(&block.shift) + motion.linear;
    shift.store(&mut block.shift);

    let inertia = Vec3x8::<L>::load(&block.constants.inertia);
    let turn = Turn::of(motion.angular, inertia);
    let axes = Matrix3x8::<L>::load(&block.axes);
    // The angular momentum stays in the world's frame: Qᵀ I ω in that of the turned body. Only what that changes of ω
    // is computed, and added to it; anew, ω would be rounded in the same way for many substeps.
    let momentum = turn.change_back(motion.angular.scale(inertia));
    let change = Vec3x8::new(momentum.x / inertia.x, momentum.y / inertia.y, momentum.z / inertia.z);
    let change = change + turn.change(motion.angular + change);
    let change = axes.apply(Vec3x8::select(turn.is_too_fast, Vec3x8::zero(), change));
    let in_start = Matrix3x8::<L>::load(&block.start_axes).apply_transposed(change);
    let change = in_start.scale(Vec3x8::load(&block.constants.root_inertia));
    turn.applied_to(axes).store(&mut block.axes);

    let [x, y, z, mass, p, q, r, response] = *columns;
    let linear = Vec3x8::new(x, y, z) * kept(&block.constants.damping[0], h, damping);
    let angular = (Vec3x8::new(p, q, r) + change) * kept(&block.constants.damping[1], h, damping);
    [linear.x, linear.y, linear.z, mass, angular.x, angular.y, angular.z, response]
}

/// The rows of bodies that have moved, those of which turned too fast with no more energy than was given to them.
///
/// What acts on a body after it has moved acts on the inertia of where the step began. A rod has turned since then, and
/// what made it spin about its axis would have it spin across that, with the energy of that.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn calmed<L: Lanes>(block: &Block, columns: [L; LANES]) -> [L; LANES] {
    let angular = block.motion(&columns).angular;
    let inertia = Vec3x8::<L>::load(&block.constants.inertia);
    let [x, y, z, mass, p, q, r, response] = columns;
    let given = Vec3x8::new(p, q, r).length_squared();
    let found = angular.scale(Vec3x8::load(&block.constants.root_inertia)).length_squared();
    let gains = found.greater(given * L::splat(ROUNDED)).and(response.greater(L::splat(0.0)));
    let gains = gains.and(is_too_fast(angular * L::splat(0.5), inertia));
    let kept = gains.select((given / found).sqrt(), L::splat(1.0));
    [x, y, z, mass, p * kept, q * kept, r * kept, response]
}

/// Axes that are unit and right-angled again: what rounding adds to them in every substep would otherwise add up in
/// the angular momentum. Lengths are so near 1 that one Newton step makes them so.
#[inline(always)]
fn straightened<L: Lanes>(e0: Vec3x8<L>, e1: Vec3x8<L>) -> Matrix3x8<L> {
    let e0 = unit(e0);
    let e1 = unit(e1 - e0 * e0.dot(e1));
    Matrix3x8([e0, e1, e0.cross(e1)])
}

/// A vector of unit length, of one whose length is within some millionths of it.
#[inline(always)]
pub(super) fn unit<L: Lanes>(v: Vec3x8<L>) -> Vec3x8<L> {
    v * (L::splat(1.5) - v.length_squared() * L::splat(0.5))
}

/// What a substep of `h` (s) leaves of a motion that dies out at these two rates (1/s) together.
#[inline(always)]
fn kept<L: Lanes>(rate: &Row, h: f32, damping: f32) -> L {
    L::splat(1.0) / (L::splat(1.0) + (L::load(rate) + L::splat(damping)) * L::splat(h))
}

/// Of the quaternion with this imaginary part. Half a turn in a substep is as far as the equation goes; what spins
/// faster is held there.
#[inline(always)]
fn real_part<L: Lanes>(u: Vec3x8<L>) -> L {
    (L::splat(1.0) - u.length_squared()).max(L::splat(0.1)).sqrt()
}

/// Whether the iteration leaves more than it may, about |half|⁴.
#[inline(always)]
fn is_too_fast<L: Lanes>(half: Vec3x8<L>, inertia: Vec3x8<L>) -> L {
    let largest = inertia.x.max(inertia.y).max(inertia.z);
    let least = inertia.x.min(inertia.y).min(inertia.z);
    let squared = half.length_squared() * L::splat(1.0 / (FASTEST * FASTEST));
    let fourth = squared * squared;
    (fourth * fourth * largest.max(least * L::splat(SLENDER))).greater(least * L::splat(SLENDER))
}

/// ω h/2 − I⁻¹ (u × I u), from I⁻¹ and I.
#[inline(always)]
fn coupled<L: Lanes>(
    half: Vec3x8<L>,
    u: Vec3x8<L>,
    is_too_fast: L,
    [inverse, inertia]: &[Vec3x8<L>; 2],
) -> Vec3x8<L> {
    let coupling = u.cross(u.scale(*inertia)).scale(*inverse);
    half - Vec3x8::select(is_too_fast, Vec3x8::zero(), coupling)
}

/// Whether all turn so slowly that the first iteration is exact: what is left of u is smaller by (|half| I₁/I₃)², and its
/// real part differs from 1 by |half|²/2; both less than rounding.
#[inline(always)]
fn turns_slowly<L: Lanes>(half: Vec3x8<L>, inertia: Vec3x8<L>) -> bool {
    let largest = inertia.x.max(inertia.y).max(inertia.z);
    let least = inertia.x.min(inertia.y).min(inertia.z);
    let bound = least * L::splat(SLOWEST);
    (half.length_squared() * largest * largest).greater(bound * bound).bits() == 0
}

/// A rotation Q in a body's frame, as a unit quaternion.
struct Turn<L> {
    imaginary: Vec3x8<L>,
    real: L,
    /// A mask: the equation has no answer that means anything; the body turns on as it did.
    is_too_fast: L,
}

impl<L: Lanes> Turn<L> {
    /// Of bodies that turn by `angular` = ω h.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn of(angular: Vec3x8<L>, inertia: Vec3x8<L>) -> Self {
        let one = L::splat(1.0);
        let half = angular * L::splat(0.5);
        let is_too_fast = is_too_fast(half, inertia);
        let inverse = Vec3x8::new(one / inertia.x, one / inertia.y, one / inertia.z);
        let moments = [inverse, inertia];
        let mut u = coupled(half, half, is_too_fast, &moments);
        if turns_slowly(half, inertia) {
            return Self { imaginary: u, real: one, is_too_fast };
        }
        u = u * (one / real_part(half));
        for _ in 1..ITERATIONS {
            u = coupled(half, u, is_too_fast, &moments) * (one / real_part(u));
        }
        // Renormalised, so that it is a rotation also where the iteration has not ended.
        let real = real_part(u);
        let length = (u.length_squared() + real * real).sqrt();
        Self { imaginary: u * (one / length), real: real / length, is_too_fast }
    }

    /// Q v − v.
    #[inline(always)]
    fn change(&self, v: Vec3x8<L>) -> Vec3x8<L> {
        self.imaginary.cross(self.imaginary.cross(v) + v * self.real) * L::splat(2.0)
    }

    /// Qᵀ v − v.
    #[inline(always)]
    fn change_back(&self, v: Vec3x8<L>) -> Vec3x8<L> {
        self.imaginary.cross(self.imaginary.cross(v) - v * self.real) * L::splat(2.0)
    }

    /// R Q.
    #[inline(always)]
    fn applied_to(&self, axes: Matrix3x8<L>) -> Matrix3x8<L> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let x = axes.0[0] + axes.apply(self.change(Vec3x8::new(one, zero, zero)));
        let y = axes.0[1] + axes.apply(self.change(Vec3x8::new(zero, one, zero)));
        straightened(x, y)
    }
}
