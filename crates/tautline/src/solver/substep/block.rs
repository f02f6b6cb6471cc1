//! Eight bodies side by side: read from their particles when a step begins, written back when it ends.
//!
//! A rigid body moves as four equal masses would at s∘tᵢ in its principal frame, with t = (1, 1, 1), (1, −1, −1),
//! (−1, 1, −1), (−1, −1, 1) and sₖ = √(Cₖ/M), Cₖ the second moment along axis k (Routh's equimomental system; Laus &
//! Selig 2020). Its centre is their mean, its axes are signed sums of them over 4 sₖ, and its velocities are the
//! moments of their displacements. In between the solver holds those instead.
//!
//! The solver's row of a body is [v, 1/m, w, 1]: v its motion in a substep (m), w = √I Rᵀ ω h its scaled rotation in
//! the frame of the step's start. In these variables the inverse mass matrix is diag(1/m, 1), so that one Jacobian
//! √I⁻¹ (l × Rᵀd) both reads a velocity and applies an impulse. The last number is 0 for what no impulse turns.

use std::sync::Arc;

use glam::Mat3;

use super::rigidity;
use crate::simd::{LANES, Lanes, Matrix3x8, Row, Vec3x8};

pub(super) use crate::simd::column;

/// Three rows: all x, all y, all z.
pub(super) type Rows3 = [Row; 3];

/// What does not change from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Constants {
    /// sₖ, in m.
    pub(super) spread: Rows3,
    /// Principal moments per mass, in m².
    pub(super) inertia: Rows3,
    /// √I, in √kg m.
    pub(super) root_inertia: Rows3,
    pub(super) inverse_root_inertia: Rows3,
    /// 1/m, in 1/kg; 0 = moved by nothing.
    pub(super) inverse_mass: Row,
    /// 1 if impulses turn it, 0 if not.
    pub(super) response: Row,
    /// How far the shape reaches from the centre of mass, in m.
    pub(super) reach: Row,
    /// The radius of a ball that fits into each part of the shape, in m; 0 without an inside.
    pub(super) inner_radius: Row,
    /// How many times gravity acts on it.
    pub(super) gravity_scale: Row,
    /// Rates at which motion and rotation die out, in 1/s.
    pub(super) damping: [Row; 2],
}

/// Where eight bodies are.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    /// Blocks of like bodies share them.
    pub(super) constants: Arc<Constants>,
    /// Centres of mass when the step began, in m.
    pub(super) center: Rows3,
    /// How far they have moved since the step began, in m, and what was rounded off the centres then. By itself, so
    /// that it is not rounded to what is left of a centre far from the origin.
    pub(super) shift: Rows3,
    /// Axes: the columns of the rotation R from the principal frame.
    pub(super) axes: [Rows3; 3],
    /// Axes when the step began, R₀.
    pub(super) start_axes: [Rows3; 3],
}

/// The particles of eight bodies: particle k's coordinate j is row 3 k + j.
pub(super) type ParticleRows = [Row; 12];

/// Velocities of eight bodies over a substep.
#[derive(Clone, Copy)]
pub(super) struct Motion<L> {
    /// In m.
    pub(super) linear: Vec3x8<L>,
    /// In the body's frame, in rad.
    pub(super) angular: Vec3x8<L>,
}

/// The axes that nine rows have in a lane.
pub(super) fn columns(rows: &[Rows3; 3], lane: usize) -> Mat3 {
    let [x, y, z] = rows.each_ref().map(|rows| column(rows, lane));
    Mat3::from_cols(x, y, z)
}

#[inline(always)]
pub(super) fn particles<L: Lanes>(rows: &ParticleRows) -> [Vec3x8<L>; 4] {
    let mut vectors = [Vec3x8::zero(); 4];
    for (k, vector) in vectors.iter_mut().enumerate() {
        *vector = Vec3x8::new(L::load(&rows[3 * k]), L::load(&rows[3 * k + 1]), L::load(&rows[3 * k + 2]));
    }
    vectors
}

/// The rotation, in the body's frame, that is in the displacements of four particles.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn spin_of<L: Lanes>(
    displacements: &[Vec3x8<L>; 4],
    arms: &[Vec3x8<L>; 4],
    axes: &Matrix3x8<L>,
    inertia: Vec3x8<L>,
) -> Vec3x8<L> {
    let mut moment = Vec3x8::zero();
    for (displacement, arm) in displacements.iter().zip(arms) {
        moment = moment + arm.cross(*displacement);
    }
    let momentum = axes.apply_transposed(moment * L::splat(0.25));
    Vec3x8::new(momentum.x / inertia.x, momentum.y / inertia.y, momentum.z / inertia.z)
}

/// How many times further out than its particles a body is far.
const FAR: f32 = 8.0;

#[inline(always)]
fn store_particle<L: Lanes>(vector: Vec3x8<L>, rows: &mut [Row]) {
    vector.x.store(&mut rows[0]);
    vector.y.store(&mut rows[1]);
    vector.z.store(&mut rows[2]);
}

impl Block {
    /// Finds where the bodies are, and how their displacements times `scale` move them.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn read<L: Lanes>(
        &mut self,
        positions: &ParticleRows,
        displacements: &ParticleRows,
        scale: L,
    ) -> Motion<L> {
        let quarter = L::splat(0.25);
        let (x, d) = (particles::<L>(positions), particles::<L>(displacements));
        let (front, back) = (x[0] + x[1], x[2] + x[3]);
        // Far out from the first particle on: sums of four are rounded coarser than they are.
        let near = (front + back) * quarter;
        let offset = ((x[1] - x[0]) + ((x[2] - x[0]) + (x[3] - x[0]))) * quarter;
        let is_far = self.is_far(near);
        let center = Vec3x8::select(is_far, x[0] + offset, near);
        let shift = Vec3x8::select(is_far, offset - (center - x[0]), Vec3x8::zero());
        let (first, second) = (front - back, (x[0] - x[1]) + (x[2] - x[3]));
        // The largest two of the axes, since those are the best known: moments are in descending order.
        let e0 = rigidity::unit(first * (L::splat(1.0) / first.length()));
        let e2 = e0.cross(second);
        let e2 = rigidity::unit(e2 * (L::splat(1.0) / e2.length()));
        let axes = Matrix3x8([e0, e2.cross(e0), e2]);
        let linear = ((d[0] + d[1]) + (d[2] + d[3])) * quarter;
        let arms = [x[0] - center, x[1] - center, x[2] - center, x[3] - center];
        let inertia = Vec3x8::<L>::load(&self.constants.inertia);
        let first = spin_of(&d, &arms, &axes, inertia);
        // Once more for what that leaves: the inertia's rounding would be in every step's rotation alike.
        let turn = axes.apply(first);
        let mut rest = d;
        for (rest, arm) in rest.iter_mut().zip(arms) {
            *rest = *rest - linear - turn.cross(arm);
        }
        let angular = first + spin_of(&rest, &arms, &axes, inertia);
        center.store(&mut self.center);
        shift.store(&mut self.shift);
        axes.store(&mut self.axes);
        axes.store(&mut self.start_axes);
        Motion { linear: linear * scale, angular: angular * scale }
    }

    /// A mask: whether a centre is so far from the origin that rounding it matters more than rounding axes.
    #[inline(always)]
    fn is_far<L: Lanes>(&self, center: Vec3x8<L>) -> L {
        let spread = Vec3x8::<L>::load(&self.constants.spread);
        center.length_squared().greater(spread.length_squared() * L::splat(FAR * FAR))
    }

    /// From the principal frames to the world.
    #[inline(always)]
    pub(super) fn axes_now<L: Lanes>(&self) -> Matrix3x8<L> {
        Matrix3x8::load(&self.axes)
    }

    /// The particles of the bodies where they are now, and their displacements in the last substep.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn write<L: Lanes>(
        &self,
        columns: &[L; LANES],
        positions: &mut ParticleRows,
        displacements: &mut ParticleRows,
    ) {
        let (center, shift) = (Vec3x8::<L>::load(&self.center), Vec3x8::load(&self.shift));
        let axes = Matrix3x8::<L>::load(&self.axes);
        let spread = Vec3x8::<L>::load(&self.constants.spread);
        let (e0, e1, e2) = (axes.0[0] * spread.x, axes.0[1] * spread.y, axes.0[2] * spread.z);
        let linear = Vec3x8::new(columns[0], columns[1], columns[2]);
        let turn = self.turn(columns);
        let arms = [e0 + e1 + e2, e0 - e1 - e2, e1 - e0 - e2, e2 - e0 - e1];
        // Far out the shift is not to be rounded with the centre, and the first particle makes up for what rounding takes
        // from the others: at a constant speed that is the same in every step, and would add up. Near the origin that
        // would only disturb the axes.
        let is_far = self.is_far(center);
        let moved = Vec3x8::select(is_far, shift, Vec3x8::zero());
        let center = Vec3x8::select(is_far, center, center + shift);
        let mut lost = Vec3x8::zero();
        for (k, arm) in arms.into_iter().enumerate().rev() {
            let (arm, d) = (moved + arm, linear + turn.cross(arm));
            let x = if k == 0 { center + (arm + lost) } else { center + arm };
            lost = lost + Vec3x8::select(is_far, (center - x) + arm, Vec3x8::zero());
            store_particle(x, &mut positions[3 * k..]);
            store_particle(d, &mut displacements[3 * k..]);
        }
    }

    /// The solver's rows of the bodies moving so.
    #[inline(always)]
    pub(super) fn velocity_rows<L: Lanes>(&self, motion: Motion<L>) -> [L; LANES] {
        let scaled = motion.angular.scale(Vec3x8::load(&self.constants.root_inertia));
        let v = motion.linear;
        let (mass, response) = (L::load(&self.constants.inverse_mass), L::load(&self.constants.response));
        [v.x, v.y, v.z, mass, scaled.x, scaled.y, scaled.z, response]
    }

    /// The rotation over a substep, in the world's frame, of the bodies with these rows.
    #[inline(always)]
    fn turn<L: Lanes>(&self, columns: &[L; LANES]) -> Vec3x8<L> {
        // Divided, not multiplied by the inverse: what is read and written in every step would be rounded alike in all.
        let root = Vec3x8::<L>::load(&self.constants.root_inertia);
        let in_start = Vec3x8::new(columns[4] / root.x, columns[5] / root.y, columns[6] / root.z);
        Matrix3x8::<L>::load(&self.start_axes).apply(in_start)
    }

    /// How the bodies with these rows move, turned from the frame of the step's start to theirs of now.
    #[inline(always)]
    pub(super) fn motion<L: Lanes>(&self, columns: &[L; LANES]) -> Motion<L> {
        let angular = self.axes_now().apply_transposed(self.turn(columns));
        Motion { linear: Vec3x8::new(columns[0], columns[1], columns[2]), angular }
    }

    /// A bound of how far any point of a body is from where it was at another pose: √(|Δc|² + r² Σ|Δeₖ|²/2), in m,
    /// squared.
    #[inline(always)]
    pub(super) fn moved_squared<L: Lanes>(&self, center: &Rows3, [x, y]: &[Rows3; 2]) -> L {
        let shift = Vec3x8::<L>::load(&self.center) - Vec3x8::load(center);
        let (x, y) = (Vec3x8::<L>::load(x), Vec3x8::load(y));
        let mut turn = L::splat(0.0);
        for (now, before) in self.axes_now::<L>().0.into_iter().zip([x, y, x.cross(y)]) {
            turn = turn + (now - before).length_squared();
        }
        let reach = L::load(&self.constants.reach);
        shift.length_squared() + reach * reach * L::splat(0.5) * turn
    }
}
