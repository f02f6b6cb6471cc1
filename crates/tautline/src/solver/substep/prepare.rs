//! From held contacts to rows for the solver.

use crate::simd::{LANES, Lanes, Matrix3x8, Row, Vec3x8, rows_at};

use super::batch::{Batch, HeaderRows, NO_PAIR, PointRows};
use super::held::Held;
use super::tangents::with_tangents;

/// Where a body is, as two rows: centre, 1/m, 1/√I, response; first and second axis, two numbers of no concern here.
pub(super) struct Poses<'a>(pub(super) &'a [Row]);

/// Eight poses.
pub(super) struct Frames<L> {
    center: Vec3x8<L>,
    axes: Matrix3x8<L>,
    inverse_mass: L,
    inverse_root_inertia: Vec3x8<L>,
    pub(super) response: L,
}

impl<L: Lanes> Frames<L> {
    /// √I⁻¹ Rᵀd: how an angular impulse along a direction changes the scaled rotation.
    #[inline(always)]
    pub(super) fn turn(&self, direction: Vec3x8<L>) -> Vec3x8<L> {
        self.axes.apply_transposed(direction).scale(self.inverse_root_inertia)
    }

    #[inline(always)]
    fn in_frame(&self, [x, y, z]: &[Vec3x8<L>; 3]) -> [Vec3x8<L>; 3] {
        [self.axes.apply_transposed(*x), self.axes.apply_transposed(*y), self.axes.apply_transposed(*z)]
    }
}

impl Poses<'_> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn gather<L: Lanes>(&self, places: &[u32; LANES]) -> Frames<L> {
        let (mut firsts, mut seconds) = (*places, *places);
        for lane in 0..LANES {
            (firsts[lane], seconds[lane]) = (2 * places[lane], 2 * places[lane] + 1);
        }
        let (first, second) = (L::gather(rows_at(self.0, &firsts)), L::gather(rows_at(self.0, &seconds)));
        let e0 = Vec3x8::new(second[0], second[1], second[2]);
        let e1 = Vec3x8::new(second[3], second[4], second[5]);
        Frames {
            center: Vec3x8::new(first[0], first[1], first[2]),
            axes: Matrix3x8([e0, e1, e0.cross(e1)]),
            inverse_mass: first[3],
            inverse_root_inertia: Vec3x8::new(first[4], first[5], first[6]),
            response: first[7],
        }
    }
}

/// The restitution and the rolling friction (m) of eight pairs.
pub(super) struct Rare {
    pub(super) restitution: Row,
    pub(super) rolling_friction: Row,
}

/// The contacts of a batch.
#[inline(always)]
fn held<'a>(batch: &Batch, contact_of: impl Fn(u32) -> Option<&'a Held>) -> [Option<&'a Held>; LANES] {
    let mut held = [None; LANES];
    for (held, &pair) in held.iter_mut().zip(&batch.pairs) {
        *held = if pair == NO_PAIR { None } else { contact_of(pair) };
    }
    held
}

/// One row of each.
#[inline(always)]
fn rows_of<'a>(
    held: &[Option<&'a Held>; LANES],
    row: impl Fn(Option<&'a Held>) -> &'a Row,
) -> [&'a Row; LANES] {
    let mut rows = [Held::header(None); LANES];
    for lane in 0..LANES {
        rows[lane] = row(held[lane]);
    }
    rows
}

/// Fills the rows of a batch, and adds what its multipliers do to `accumulated`. Returns what only few batches have any of.
#[inline(always)]
pub(super) fn fill<'a, L: Lanes>(
    batch: &Batch,
    contact_of: impl Fn(u32) -> Option<&'a Held>,
    [a, b]: &[Frames<L>; 2],
    (header, points): (&mut HeaderRows, &mut [PointRows]),
    accumulated: &mut [Row],
) -> Rare {
    let held = held(batch, contact_of);
    let shared = L::gather(rows_of(&held, Held::header));
    let normal = Vec3x8::new(shared[0], shared[1], shared[2]);
    let directions = with_tangents(normal);
    normal.store(&mut header.normal);
    directions[1].store(&mut header.tangents[0]);
    directions[2].store(&mut header.tangents[1]);
    shared[3].store(&mut header.friction);
    header.is_soft = Row([1.0; LANES]);
    let mut rare = Rare { restitution: Row::ZERO, rolling_friction: Row::ZERO };
    shared[4].store(&mut rare.restitution);
    shared[5].store(&mut rare.rolling_friction);
    for lane in (0..LANES).filter(|lane| batch.stacked >> lane & 1 != 0) {
        // Stacks are too slow to bounce.
        rare.restitution.0[lane] = 0.0;
    }

    let mut sum_a = L::gather(rows_at(accumulated, &batch.a));
    let mut sum_b = L::gather(rows_at(accumulated, &batch.b));
    let mut impulse = Vec3x8::<L>::zero();
    let (local_a, local_b) = (a.in_frame(&directions), b.in_frame(&directions));
    let between = b.center - a.center;
    let counts = L::load(&Row(batch.counts.map(f32::from)));
    let mut both = [L::splat(0.0); LANES];
    for (k, rows) in points.iter_mut().enumerate() {
        let anchors = L::gather(rows_of(&held, |held| Held::anchors(held, k)));
        if k % 2 == 0 {
            both = L::gather(rows_of(&held, |held| Held::friction_of_two(held, k / 2)));
        }
        let [even @ .., _, _, _, _] = both;
        let [_, _, _, _, odd @ ..] = both;
        let [slip_first, slip_second, pull_first, pull_second] = if k % 2 == 0 { even } else { odd };
        let on_a = Vec3x8::new(anchors[0], anchors[1], anchors[2]);
        let on_b = Vec3x8::new(anchors[4], anchors[5], anchors[6]);
        let distance = between + (b.axes.apply(on_b) - a.axes.apply(on_a));
        let impulses = [anchors[3], pull_first, pull_second];
        let mut masses = [L::splat(0.0); 3];
        let [first_a, second_a] = &mut rows.tangents_a;
        let [first_b, second_b] = &mut rows.tangents_b;
        let jacobians = [(&mut rows.normal_a, &mut rows.normal_b), (first_a, first_b), (second_a, second_b)];
        for (j, (row_a, row_b)) in jacobians.into_iter().enumerate() {
            let ja = on_a.cross(local_a[j]).scale(a.inverse_root_inertia);
            let jb = on_b.cross(local_b[j]).scale(b.inverse_root_inertia);
            let compliance = a.inverse_mass
                + b.inverse_mass
                + a.response * ja.length_squared()
                + b.response * jb.length_squared();
            masses[j] = L::splat(1.0) / compliance.max(L::splat(LEAST_COMPLIANCE));
            ja.store(row_a);
            jb.store(row_b);
            turn(&mut sum_a, ja, -(impulses[j] * a.response));
            turn(&mut sum_b, jb, impulses[j] * b.response);
            impulse = impulse + directions[j] * impulses[j];
        }
        // What a pair with fewer points does not have holds nothing.
        let exists = counts.greater(L::splat(k as f32));
        exists.and(masses[0]).store(&mut rows.normal_mass);
        exists.and(masses[1].min(masses[2])).store(&mut rows.tangent_mass);
        exists.select(normal.dot(distance), L::splat(OUT_OF_REACH)).store(&mut rows.separation);
        impulses[0].store(&mut rows.normal_impulse);
        for (axis, slip) in [slip_first, slip_second].into_iter().enumerate() {
            impulses[axis + 1].store(&mut rows.tangent_impulses[axis]);
            (directions[axis + 1].dot(distance) + slip).store(&mut rows.drift[axis]);
        }
        rows.slid = [Row::ZERO; 2];
    }
    shift(&mut sum_a, impulse, -a.inverse_mass);
    shift(&mut sum_b, impulse, b.inverse_mass);
    L::scatter(sum_a, accumulated, &batch.a);
    L::scatter(sum_b, accumulated, &batch.b);
    rare
}

/// Further than anything reaches in a step, in m.
pub(super) const OUT_OF_REACH: f32 = 1e9;

/// Below any real one, in 1/kg: it keeps empty lanes finite.
const LEAST_COMPLIANCE: f32 = 1e-25;

#[inline(always)]
fn turn<L: Lanes>(columns: &mut [L; LANES], jacobian: Vec3x8<L>, impulse: L) {
    columns[4] = columns[4] + jacobian.x * impulse;
    columns[5] = columns[5] + jacobian.y * impulse;
    columns[6] = columns[6] + jacobian.z * impulse;
}

#[inline(always)]
fn shift<L: Lanes>(columns: &mut [L; LANES], impulse: Vec3x8<L>, inverse_mass: L) {
    columns[0] = columns[0] + impulse.x * inverse_mass;
    columns[1] = columns[1] + impulse.y * inverse_mass;
    columns[2] = columns[2] + impulse.z * inverse_mass;
}
