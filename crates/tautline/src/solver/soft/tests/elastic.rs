use glam::DMat3;

use super::*;
use crate::mesh::lattice;
use crate::solver::soft::tests::{noise3, on_all};

const H: f32 = 5e-4;

/// A box of 0.4 m by 0.6 m by 0.4 m whose particles have been moved by up to so much (m).
fn shaken(material: Material, by: f32) -> (Elastic, Points) {
    let solid = lattice(Vec3::new(0.2, 0.3, 0.2), [2, 3, 2]).unwrap();
    let flesh = Flesh::new(&solid, material).unwrap();
    let masses: Vec<f32> =
        flesh.shares(solid.points.len()).unwrap().iter().map(|share| share * 1000.0).collect();
    let mut points = Points::default();
    points.reset(solid.points.len());
    for (place, (&at, mass)) in solid.points.iter().zip(&masses).enumerate() {
        points.put(place, at + noise3(place) * by, Vec3::ZERO);
        points.inverse_mass[place] = 1.0 / mass;
    }
    (Elastic::new(&flesh, &masses, 0), points)
}

struct Relaxed<'a>(&'a Elastic, Points);

impl Kernel for Relaxed<'_> {
    type Output = Points;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> Points {
        self.0.relax::<L>(&mut self.1, H);
        self.1
    }
}

/// Ψ (Smith, de Goes and Kim 2018, Eq 14), in f64.
fn energy(material: Material, f: DMat3) -> f64 {
    let (mu, lambda) = (f64::from(material.shear), f64::from(material.bulk));
    let squares: f64 = f.to_cols_array().iter().map(|x| x * x).sum();
    let alpha = 1.0 + 0.75 * mu / lambda;
    0.5 * mu * (squares - 3.0) + 0.5 * lambda * (f.determinant() - alpha).powi(2)
        - 0.5 * mu * (squares + 1.0).ln()
}

/// V Ψ of a tetrahedron with corners at the origin and at these places, which were the unit vectors times 0.1 m.
fn energy_of(material: Material, corners: [DVec3; 4]) -> f64 {
    let [a, b, c, d] = corners;
    energy(material, DMat3::from_cols(b - a, c - a, d - a) * 10.0) * 1e-3 / 6.0
}

struct OfOne(Material, [Vec3; 3], [f32; 4]);

impl Kernel for OfOne {
    type Output = [Vec3; 3];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [Vec3; 3] {
        let Self(material, edges, masses) = self;
        let edges = [Vec3x8::<L>::splat(edges[0]), Vec3x8::splat(edges[1]), Vec3x8::splat(edges[2])];
        let gradients =
            [Vec3x8::splat(Vec3::X * 10.0), Vec3x8::splat(Vec3::Y * 10.0), Vec3x8::splat(Vec3::Z * 10.0)];
        let masses = [L::splat(masses[0]), L::splat(masses[1]), L::splat(masses[2]), L::splat(masses[3])];
        let impulses = impulses(edges, gradients, masses, (material, L::splat(H * H * 1e-3 / 6.0)));
        let mut rows = [[Row::ZERO; 3]; 3];
        impulses[0].store(&mut rows[0]);
        impulses[1].store(&mut rows[1]);
        impulses[2].store(&mut rows[2]);
        [column(&rows[0], 3), column(&rows[1], 3), column(&rows[2], 3)]
    }
}

#[test]
fn a_corner_is_pushed_down_the_slope_of_the_energy() {
    let material = Material::new(1e5, 0.4);
    for k in 0..20 {
        // Some are turned inside out.
        let spread = 0.02 + 0.01 * k as f32;
        let edges = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * 0.1);
        let edges: [Vec3; 3] = std::array::from_fn(|i| edges[i] + noise3(7 * k + i) * spread);
        let impulses = on_all(|| OfOne(material, edges, [1.0; 4]));
        let corners = [DVec3::ZERO, edges[0].as_dvec3(), edges[1].as_dvec3(), edges[2].as_dvec3()];
        let mut slopes = [DVec3::ZERO; 3];
        for (i, slope) in slopes.iter_mut().enumerate() {
            for axis in 0..3 {
                let at = |by: f64| {
                    let mut moved = corners;
                    moved[i + 1][axis] += by;
                    energy_of(material, moved)
                };
                slope[axis] = (at(1e-6) - at(-1e-6)) / 2e-6;
            }
        }
        for (impulse, slope) in impulses.iter().zip(slopes) {
            let expected = -slope * f64::from(H * H);
            let off =
                (impulse.as_dvec3() - expected).length() / slopes.map(|s| s.length()).iter().sum::<f64>();
            assert!(off < 1e-4 * f64::from(H * H), "{impulse} is not {expected}");
        }
    }
}

#[test]
fn little_strain_is_hookes() {
    let (young, nu) = (2e5_f64, 0.35);
    let material = Material::new(young as f32, nu as f32);
    // Drawn along x, and as much narrower as Poisson says: no stress across, and E ε²/2 of energy.
    let stretch = 1e-3;
    let strained = |across: f64| DMat3::from_diagonal(DVec3::new(1.0 + stretch, 1.0 - across, 1.0 - across));
    let at_rest = energy(material, DMat3::IDENTITY);
    let gained = |across: f64| energy(material, strained(across)) - at_rest;
    let expected = 0.5 * young * stretch * stretch;
    assert!((gained(nu * stretch) / expected - 1.0).abs() < 0.01, "{} J/m³", gained(nu * stretch));
    for beside in [0.9, 1.1] {
        assert!(gained(beside * nu * stretch) > gained(nu * stretch));
    }
    let shear = DMat3::from_cols(DVec3::X, DVec3::new(stretch, 1.0, 0.0), DVec3::Z);
    let modulus = 2.0 * (energy(material, shear) - at_rest) / (stretch * stretch);
    assert!((modulus * 2.0 * (1.0 + nu) / young - 1.0).abs() < 0.01, "{modulus} Pa");
}

#[test]
fn what_is_at_rest_stays_and_impulses_add_up_to_nothing() {
    let material = Material::new(1e5, 0.45);
    let (elastic, still) = shaken(material, 0.0);
    let relaxed = on_all(|| Relaxed(&elastic, still.clone()));
    let count = 36;
    let farthest = (0..count).map(|place| relaxed.at(place).distance(still.at(place))).fold(0.0, f32::max);
    assert!(farthest < 1e-8, "{farthest} m off");
    for by in [0.02, 0.3] {
        let (elastic, before) = shaken(material, by);
        let after = on_all(|| Relaxed(&elastic, before.clone()));
        let (mut sum, mut turn, mut size) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for place in 0..count {
            let impulse = after.motion(place).as_dvec3() / f64::from(after.inverse_mass[place]);
            sum += impulse;
            turn += before.at(place).as_dvec3().cross(impulse);
            size += impulse.length();
        }
        assert!(sum.length() < 1e-6 * size, "{sum} of {size}");
        // Batch after batch, each from where the one before left it.
        assert!(turn.length() < 1e-2 * size, "{turn} of {size}");
    }
}

#[test]
fn no_stiffness_is_unstable() {
    for young_modulus in [1e3, 1e6, 1e9, 1e13] {
        let (elastic, mut points) = shaken(Material::new(young_modulus, 0.45), 0.05);
        let size = |points: &Points| (0..36).map(|place| points.at(place).length()).fold(0.0, f32::max);
        let before = size(&points);
        for _ in 0..200 {
            points = on_all(|| Relaxed(&elastic, points.clone()));
            assert!(size(&points) < 1.2 * before, "{young_modulus} Pa: {} m", size(&points));
        }
    }
    let one = OfOne(Material::new(1e13, 0.45), [Vec3::X * 0.11, Vec3::Y * 0.1, Vec3::Z * 0.1], [1.0; 4]);
    let [impulse, ..] = crate::simd::run(crate::simd::Instructions::Scalar, one);
    assert!(impulse.x < 0.0 && impulse.x > -0.01, "{impulse}");
}
