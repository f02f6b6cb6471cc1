//! The two directions across a contact's normal that friction acts along: the normal alone tells them.

use glam::{Vec2, Vec3};

use crate::simd::{Lanes, Vec3x8};

/// A right-handed frame around a unit vector (Duff et al. 2017, Building an orthonormal basis, revisited).
#[inline(always)]
pub(super) fn with_tangents<L: Lanes>(n: Vec3x8<L>) -> [Vec3x8<L>; 3] {
    let one = L::splat(1.0);
    let sign = L::splat(0.0).greater(n.z).select(-one, one);
    let a = -one / (sign + n.z);
    let b = n.x * n.y * a;
    let first = Vec3x8::new(one + sign * n.x * n.x * a, sign * b, -(sign * n.x));
    let second = Vec3x8::new(b, sign + n.y * n.y * a, -n.y);
    [n, first, second]
}

/// Those of one contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tangents([Vec3; 2]);

impl Tangents {
    /// The same as [`with_tangents`] gives.
    #[inline(always)]
    pub(super) fn new(normal: Vec3) -> Self {
        // Of −0 glam would take the other side.
        let (first, second) = (normal + Vec3::ZERO).any_orthonormal_pair();
        Self([first, second])
    }

    /// What a vector is along each.
    #[inline(always)]
    pub(super) fn along(&self, vector: Vec3) -> Vec2 {
        Vec2::new(self.0[0].dot(vector), self.0[1].dot(vector))
    }

    /// The vector that is this along each.
    #[inline(always)]
    pub(super) fn vector(&self, along: Vec2) -> Vec3 {
        self.0[0] * along.x + self.0[1] * along.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Instructions, Kernel, LANES, Row, run};

    struct EightAlike(Vec3);

    impl Kernel for EightAlike {
        type Output = [Vec3; 2];

        fn run<L: Lanes>(self) -> [Vec3; 2] {
            let [x, y, z] = self.0.to_array().map(L::splat);
            let [_, first, second] = with_tangents(Vec3x8::new(x, y, z));
            [first, second].map(|vector| {
                let mut rows = [Row([0.0; LANES]); 3];
                vector.store(&mut rows);
                Vec3::from_array(rows.map(|row| row.0[5]))
            })
        }
    }

    #[test]
    fn tangents_of_one_normal_are_those_of_eight() {
        let signs = [-1.0, -0.0, 0.0, 1.0];
        let axes = signs.into_iter().flat_map(|x| {
            signs.into_iter().flat_map(move |y| signs.into_iter().map(move |z| Vec3::new(x, y, z)))
        });
        let other = (0..200).map(|i| {
            let angle = i as f32;
            Vec3::new(libm::sinf(1.3 * angle), libm::cosf(2.1 * angle), libm::sinf(0.7 * angle))
        });
        for normal in axes.chain(other).filter_map(Vec3::try_normalize) {
            let Tangents(one) = Tangents::new(normal);
            let eight = run(Instructions::default(), EightAlike(normal));
            for (one, eight) in one.into_iter().zip(eight) {
                assert_eq!(one + Vec3::ZERO, eight + Vec3::ZERO, "{normal}");
                assert!(one.dot(normal).abs() < 1e-6, "{normal}");
            }
        }
    }
}
