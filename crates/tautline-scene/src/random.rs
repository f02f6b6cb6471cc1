//! Random numbers for scenes: the same from the same seed, on every platform.

use tautline::{Quat, Vec3};

/// SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// Its numbers all follow from `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1): its upper 24 bits, which f32 holds exactly.
    fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1u32 << 24) as f32
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// One of 0 … count − 1. The first ones are the likelier by count/2⁶⁴: not at all.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// Uniform in the cube of half side `reach`.
    pub fn in_cube(&mut self, reach: f32) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.between(-reach, reach)))
    }

    /// Of uniform direction, and uniform length up to `most`.
    pub fn vector(&mut self, most: f32) -> Vec3 {
        loop {
            let v = self.in_cube(1.0);
            let squared = v.length_squared();
            if (1e-4..=1.0).contains(&squared) {
                return v * (self.between(0.0, most) / squared.sqrt());
            }
        }
    }

    /// A uniform rotation: a point of the unit ball in four dimensions, put on its sphere.
    pub fn rotation(&mut self) -> Quat {
        loop {
            let q = Quat::from_array([(); 4].map(|()| self.between(-1.0, 1.0)));
            if (1e-4..=1.0).contains(&q.length_squared()) {
                return q.normalize();
            }
        }
    }

    /// `count` different ones of 0 … `of` − 1, ascending.
    pub fn choose(&mut self, count: usize, of: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..of).collect();
        for i in 0..count.min(of) {
            all.swap(i, i + self.below(of - i));
        }
        let mut is_chosen = vec![false; of];
        all.iter().take(count).for_each(|&number| is_chosen[number] = true);
        (0..of).filter(|&number| is_chosen[number]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_numbers_are_those_of_the_published_generator() {
        let mut random = Random::new(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| random.next()).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn directions_and_rotations_have_no_side() {
        let mut random = Random::new(7);
        let count = 20_000;
        let mut mean = Vec3::ZERO;
        let mut turned = Vec3::ZERO;
        for _ in 0..count {
            let v = random.vector(2.0);
            assert!(v.length() <= 2.0);
            mean += v / count as f32;
            turned += random.rotation() * Vec3::X / count as f32;
        }
        // Three standard deviations of a component's mean are 0.014 and 0.012.
        assert!(mean.abs().max_element() < 0.02 && turned.abs().max_element() < 0.02, "{mean} {turned}");
    }

    #[test]
    fn a_choice_is_of_different_numbers() {
        let chosen = Random::new(3).choose(50, 64);
        assert!(chosen.len() == 50 && chosen.is_sorted_by(|a, b| a < b) && chosen[49] < 64);
    }
}
