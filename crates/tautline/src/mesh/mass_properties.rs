//! Mass, centre and inertia of a solid with a closed surface, by exact integrals over its polyhedron.
//!
//! The surface is a sum of signed tetrahedra from one origin, and moments of a tetrahedron are polynomials of its
//! corners (Lien & Kajiya 1984, A symbolic method for calculating the integral properties of arbitrary
//! nonconvex polyhedra). The sums are in f64 and around the middle of the mesh, so that distance from the world's
//! origin costs no accuracy, and the results stay in f64: who places particles rounds, once.

use glam::{DMat3, DVec3};

use super::{HalfEdgeMesh, TriMesh};
use crate::{Error, MeshDefect};

/// What a solid of constant density weighs and how it resists turning. The frame is the mesh's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// In m³.
    pub volume: f64,
    /// In kg.
    pub mass: f64,
    /// In m.
    pub center_of_mass: DVec3,
    /// ∫ x xᵀ dm about the centre of mass, in kg m².
    pub second_moments: DMat3,
    /// ∫ (|x|² 1 − x xᵀ) dm about the centre of mass, in kg m².
    pub inertia: DMat3,
    /// Columns: unit vectors of a right-handed frame in which both matrices are diagonal. Not sorted: if the mesh's
    /// axes are principal they are returned as they are.
    pub principal_axes: DMat3,
    /// Diagonal of the second moments in the principal frame, in kg m². All above 0.
    pub principal_second_moments: DVec3,
    /// Diagonal of the inertia in the principal frame, in kg m².
    pub principal_moments: DVec3,
}

impl MassProperties {
    /// Integrates over the inside of a closed mesh of this density, in kg/m³. Several surfaces add up, and one that
    /// is turned inside out within another is a cavity.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the density; [`Error::Mesh`] names the defect of a mesh that is not a closed
    /// surface, or gives the volume if that is not above 0 beyond rounding (inside out, flat);
    /// [`Error::Invalid`] if a second moment is not above 0, which takes a surface that cuts through itself.
    pub fn of(mesh: &TriMesh, density: f32) -> Result<Self, Error> {
        if !(density.is_finite() && density > 0.0) {
            let expected = "a finite number above 0";
            return Err(Error::OutOfRange { field: "density".into(), value: density.into(), expected });
        }
        HalfEdgeMesh::from_mesh(mesh)?.require_closed()?;
        let origin = middle(mesh);
        let moments = Moments::of(mesh, origin);
        if moments.volume <= moments.rounding {
            return Err(MeshDefect::NotPositiveVolume { volume: moments.volume }.into());
        }
        let density = f64::from(density);
        let mass = density * moments.volume;
        let center = moments.first / moments.volume;
        // Parallel axes: from the origin of the sums to the centre of mass.
        let second_moments = (moments.second - outer(center, center) * moments.volume) * density;
        let (principal_second_moments, principal_axes) = diagonalize(second_moments);
        if !principal_second_moments.cmpgt(DVec3::ZERO).all() {
            let problem = "a second moment is not above 0: the surface cuts through itself".into();
            return Err(Error::Invalid { field: "mesh".into(), problem });
        }
        Ok(Self {
            volume: moments.volume,
            mass,
            center_of_mass: origin + center,
            second_moments,
            inertia: inertia_from(second_moments),
            principal_axes,
            principal_second_moments,
            principal_moments: DVec3::splat(principal_second_moments.element_sum())
                - principal_second_moments,
        })
    }

    /// The inertia about another point, given in the mesh's frame (parallel-axis theorem), in kg m².
    pub fn inertia_about(&self, point: DVec3) -> DMat3 {
        let offset = self.center_of_mass - point;
        self.inertia + inertia_from(outer(offset, offset) * self.mass)
    }
}

/// ∫ 1, ∫ x and ∫ x xᵀ over the volume, about some origin.
struct Moments {
    volume: f64,
    first: DVec3,
    second: DMat3,
    /// A volume that rounding alone may leave.
    rounding: f64,
}

impl Moments {
    /// Over a tetrahedron (0, a, b, c) of volume V, with s = a + b + c: ∫ x = V s / 4 and
    /// ∫ x xᵀ = V (s sᵀ + a aᵀ + b bᵀ + c cᵀ) / 20.
    fn of(mesh: &TriMesh, origin: DVec3) -> Self {
        let mut sum = Self { volume: 0.0, first: DVec3::ZERO, second: DMat3::ZERO, rounding: 0.0 };
        let mut reach: f64 = 0.0;
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|vertex| mesh.positions[vertex as usize].as_dvec3() - origin);
            let volume = a.dot(b.cross(c)) / 6.0;
            let s = a + b + c;
            sum.volume += volume;
            sum.first += s * (volume / 4.0);
            sum.second += (outer(s, s) + outer(a, a) + outer(b, b) + outer(c, c)) * (volume / 20.0);
            reach = reach.max(a.length_squared()).max(b.length_squared()).max(c.length_squared());
        }
        sum.rounding = 1e-14 * reach * reach.sqrt();
        sum
    }
}

/// Centre of the bounding box.
fn middle(mesh: &TriMesh) -> DVec3 {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = mesh.positions.iter().fold(start, |(low, high), position| {
        let position = position.as_dvec3();
        (low.min(position), high.max(position))
    });
    (low + high) * 0.5
}

/// a bᵀ.
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// tr(C) 1 − C.
fn inertia_from(second_moments: DMat3) -> DMat3 {
    let trace = second_moments.diagonal().element_sum();
    DMat3::from_diagonal(DVec3::splat(trace)) - second_moments
}

/// Eigenvalues and eigenvectors (columns, right-handed) of a symmetric matrix by cyclic Jacobi rotations (Golub &
/// Van Loan, Matrix Computations, 8.5). Angles stay within 45°, so axes keep their order as far as possible.
pub(crate) fn diagonalize(mut matrix: DMat3) -> (DVec3, DMat3) {
    const MAX_SWEEPS: usize = 32; // Convergence is quadratic: six are usual.
    let mut axes = DMat3::IDENTITY;
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (pp, qq, pq) = (matrix.col(p)[p], matrix.col(q)[q], matrix.col(q)[p]);
            // Relative to both diagonals, so that the smallest moment of a needle is accurate too; below it a
            // rotation would only follow rounding, and turn the axes of a cube at random.
            if pq * pq <= 1e-26 * pp * qq {
                continue;
            }
            let rotation = jacobi_rotation(p, q, (qq - pp) / (2.0 * pq));
            matrix = rotation.transpose() * matrix * rotation;
            axes *= rotation;
            rotated = true;
        }
        if !rotated {
            break;
        }
    }
    (matrix.diagonal(), axes)
}

/// The rotation in the plane (p, q) that zeroes the entry there; `cot` is the cotangent of twice its angle.
fn jacobi_rotation(p: usize, q: usize, cot: f64) -> DMat3 {
    let tan = 1.0_f64.copysign(cot) / (cot.abs() + (cot * cot + 1.0).sqrt());
    let cos = 1.0 / (tan * tan + 1.0).sqrt();
    let sin = tan * cos;
    let mut rotation = DMat3::IDENTITY;
    rotation.col_mut(p)[p] = cos;
    rotation.col_mut(q)[q] = cos;
    rotation.col_mut(q)[p] = sin;
    rotation.col_mut(p)[q] = -sin;
    rotation
}
