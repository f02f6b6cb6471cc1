//! The inside of soft solids: tetrahedra of an elastic material, in batches of eight that share no particle.
//!
//! In a tetrahedron with the corners x_i, that were at X_i at rest, F = Σ x_i ⊗ ∇N_i tells how it is deformed: ∇N_i are the
//! gradients of its linear weights. Its energy is V Ψ(F), with
//! Ψ = μ/2 (I − 3) + λ/2 (J − α)² − μ/2 log(I + 1), I = |F|² and J = det F (Smith, de Goes and Kim 2018, Stable neo-Hookean
//! flesh simulation, Eq 14), which is finite and has a slope back to rest even where F is turned inside out. Corner i gets
//! the impulse −h² V P ∇N_i with P = ∂Ψ/∂F: an explicit force, so that stiffness is exact and no work is done against the
//! neighbours' sum; but no more than leads to the least energy of the tetrahedron alone, so that no stiffness is unstable.
//! Impulses add up to nothing, and since P Fᵀ is symmetric neither do they turn anything.

use std::ops::Range;

use glam::{DVec3, Vec3};

use super::SoftSolver;
use super::batch::without_sharing;
use super::piece::Layout;
use super::points::Points;
use super::spin::Spin;
use crate::body::{Flesh, Material, RestShape};
use crate::simd::{Kernel, LANES, Lanes, Row, Vec3x8, column};

/// Eight tetrahedra. What is missing in the last ones has no volume.
#[derive(Debug, Clone)]
struct Eight {
    corners: [[u32; LANES]; 4],
    /// ∇N of the corners but the first, whose is minus their sum, in 1/m.
    gradients: [[Row; 3]; 3],
    /// In m³.
    volume: Row,
    count: usize,
}

/// What is stiffer than an explicit force can be in a small step is relaxed in so many sweeps at most, of a part of the force
/// each.
const MOST_SWEEPS: f32 = 8.0;

/// All tetrahedra of a piece.
#[derive(Debug, Clone)]
pub(super) struct Elastic {
    eights: Vec<Eight>,
    material: Material,
    /// Of the tetrahedron that is stiffest for its mass: a bound of its stiffness over its mass at rest, in 1/s².
    stiffness: f32,
}

impl Elastic {
    /// Of particles of these masses (kg); `start` is the place of the first.
    pub(super) fn new(flesh: &Flesh, masses: &[f32], start: usize) -> Self {
        let places: Vec<[u32; 4]> =
            flesh.corners.iter().map(|corners| corners.map(|corner| corner + start as u32)).collect();
        let eight = |members: &Vec<usize>| Eight::new(&places, &flesh.rests, members);
        let stiffness = |(corners, rest): (&[u32; 4], &RestShape)| {
            let gradients = rest.inverse.transpose();
            let [p, q, r] = [gradients.x_axis, gradients.y_axis, gradients.z_axis];
            let squares = [-(p + q + r), p, q, r].map(Vec3::length_squared);
            let mobility =
                corners.iter().zip(squares).map(|(&corner, square)| square / masses[corner as usize]);
            rest.volume * mobility.sum::<f32>()
        };
        let stiffest = flesh.corners.iter().zip(&flesh.rests).map(stiffness).fold(0.0, f32::max);
        let Material { shear, bulk } = flesh.material;
        let swelling = (flesh.material.swelling() - 1.0) * 3.0_f32.sqrt();
        Self {
            eights: without_sharing(&places).iter().map(eight).collect(),
            material: flesh.material,
            stiffness: stiffest * (1.5 * shear + bulk * (3.0 + swelling)),
        }
    }

    /// Relaxes every tetrahedron; `h` is a small step (s).
    #[inline(always)]
    pub(super) fn relax<L: Lanes>(&self, points: &mut Points, h: f32) {
        let sweeps = (h * h * self.stiffness).ceil().clamp(1.0, MOST_SWEEPS);
        for _ in 0..sweeps as u32 {
            for eight in &self.eights {
                eight.relax::<L>(points, self.material, h * h / sweeps);
            }
        }
    }
}

/// Relaxing in the middle of a motion brakes rotation: what is pulled inwards moves while it is (m d × Δ for each impulse
/// m Δ). The solid gets back what it had, as a turn of the whole.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn keep_spin<L: Lanes>(points: &mut Points, places: Range<usize>, before: DVec3) {
    let spin = Spin::of(points, places.clone());
    spin.give::<L>(points, places, before - spin.momentum);
}

/// Relaxes all soft solids, in a small step (s).
pub(super) struct Stiffen<'a>(pub(super) &'a mut SoftSolver, pub(super) f32);

impl Kernel for Stiffen<'_> {
    type Output = ();

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn run<L: Lanes>(self) {
        let Self(SoftSolver { points, pieces, .. }, h) = self;
        for piece in pieces {
            if let Layout::Solid(elastic) = &piece.layout {
                let before = (!piece.is_held()).then(|| Spin::of(points, piece.places.clone()).momentum);
                elastic.relax::<L>(points, h);
                if let Some(before) = before {
                    keep_spin::<L>(points, piece.places.clone(), before);
                }
            }
        }
    }
}

impl Eight {
    fn new(places: &[[u32; 4]], rests: &[RestShape], members: &[usize]) -> Self {
        let mut eight = Self {
            corners: [[0; LANES]; 4],
            gradients: [[Row::ZERO; 3]; 3],
            volume: Row::ZERO,
            count: members.len(),
        };
        for (lane, &member) in members.iter().enumerate() {
            for (lanes, place) in eight.corners.iter_mut().zip(places[member]) {
                lanes[lane] = place;
            }
            // Its rows are the gradients.
            let by_corner = rests[member].inverse.transpose().to_cols_array_2d();
            for (rows, gradient) in eight.gradients.iter_mut().zip(by_corner) {
                rows.iter_mut().zip(gradient).for_each(|(row, number)| row.0[lane] = number);
            }
            eight.volume.0[lane] = rests[member].volume;
        }
        eight
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn relax<L: Lanes>(&self, points: &mut Points, material: Material, h_squared: f32) {
        let (mut edges, mut masses) = ([[Row::ZERO; 3]; 3], [Row::ZERO; 4]);
        for lane in 0..self.count {
            let first = self.corners[0][lane] as usize;
            for (rows, corners) in edges.iter_mut().zip(&self.corners[1..]) {
                let numbers = points.start.iter().zip(&points.offset);
                for (row, (start, offset)) in rows.iter_mut().zip(numbers) {
                    let corner = corners[lane] as usize;
                    row.0[lane] = (start[corner] - start[first]) + (offset[corner] - offset[first]);
                }
            }
            for (row, corners) in masses.iter_mut().zip(&self.corners) {
                row.0[lane] = points.inverse_mass[corners[lane] as usize];
            }
        }
        let edges = [Vec3x8::<L>::load(&edges[0]), Vec3x8::load(&edges[1]), Vec3x8::load(&edges[2])];
        let [a, b, c] = &self.gradients;
        let gradients = [Vec3x8::load(a), Vec3x8::load(b), Vec3x8::load(c)];
        let masses = [L::load(&masses[0]), L::load(&masses[1]), L::load(&masses[2]), L::load(&masses[3])];
        let volume = L::load(&self.volume) * L::splat(h_squared);
        let impulses = impulses(edges, gradients, masses, (material, volume));
        let mut shifts = [[Row::ZERO; 3]; 4];
        (-(impulses[0] + impulses[1] + impulses[2]) * masses[0]).store(&mut shifts[0]);
        (impulses[0] * masses[1]).store(&mut shifts[1]);
        (impulses[1] * masses[2]).store(&mut shifts[2]);
        (impulses[2] * masses[3]).store(&mut shifts[3]);
        for lane in 0..self.count {
            for (corners, shift) in self.corners.iter().zip(&shifts) {
                points.shift(corners[lane] as usize, column(shift, lane));
            }
        }
    }
}

/// What the corners but the first get, in kg m in a small step, from the edges to them from the first (m), the gradients of
/// their weights and the inverse masses of all four; `volume` is h² V.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn impulses<L: Lanes>(
    edges: [Vec3x8<L>; 3],
    gradients: [Vec3x8<L>; 3],
    masses: [L; 4],
    (material, volume): (Material, L),
) -> [Vec3x8<L>; 3] {
    let (shear, bulk, one) = (L::splat(material.shear), L::splat(material.bulk), L::splat(1.0));
    let [d, e, f] = edges;
    let [p, q, r] = gradients;
    // The columns of F, of ∂J/∂F and of P.
    let deformed = [d * p.x + e * q.x + f * r.x, d * p.y + e * q.y + f * r.y, d * p.z + e * q.z + f * r.z];
    let [fx, fy, fz] = deformed;
    let [jx, jy, jz] = [fy.cross(fz), fz.cross(fx), fx.cross(fy)];
    let squares = fx.length_squared() + fy.length_squared() + fz.length_squared();
    let swollen = fx.dot(jx) - L::splat(material.swelling());
    let (along, across) = (shear * (one - one / (squares + one)), bulk * swollen);
    let [px, py, pz] = [fx * along + jx * across, fy * along + jy * across, fz * along + jz * across];
    // A bound of the second derivatives of Ψ: 3/2 μ of the first and third term, λ (|∂J/∂F|² + |J − α| |F|) of the second,
    // by |∇N|² and mass over the corners.
    let first = p + q + r;
    let mobility = masses[0] * first.length_squared()
        + masses[1] * p.length_squared()
        + masses[2] * q.length_squared()
        + masses[3] * r.length_squared();
    let areas = jx.length_squared() + jy.length_squared() + jz.length_squared();
    let swelling = swollen.max(-swollen) * squares.sqrt();
    let stiffness = volume * mobility * (shear * L::splat(1.5) + bulk * (areas + swelling));
    let share = -(volume / stiffness.max(one));
    [
        (px * p.x + py * p.y + pz * p.z) * share,
        (px * q.x + py * q.y + pz * q.z) * share,
        (px * r.x + py * r.y + pz * r.z) * share,
    ]
}

#[cfg(test)]
#[path = "tests/elastic.rs"]
mod tests;
