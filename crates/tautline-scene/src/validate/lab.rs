//! What the cases share: constants, shapes, stepping and reading.

use std::sync::Arc;

use tautline::{BodyHandle, DVec3, Error, Quat, Shape, Vec3, World};

/// A step, in s.
pub(super) const DT: f32 = 1.0 / 60.0;

/// Gravity of the default settings, in m/s², as the engine has it.
pub(super) const G: f64 = 9.81f32 as f64;

/// So many steps are so many seconds.
pub(super) fn steps(seconds: f64) -> usize {
    (seconds * 60.0).round() as usize
}

/// Steps a world for so long.
pub(super) fn run(world: &mut World, seconds: f64) -> Result<(), Error> {
    for _ in 0..steps(seconds) {
        world.step(DT)?;
    }
    Ok(())
}

/// A cube, shared.
pub(super) fn cube(side: f32) -> Result<Arc<Shape>, Error> {
    cuboid(Vec3::splat(0.5 * side))
}

/// A box, shared.
pub(super) fn cuboid(half_extents: Vec3) -> Result<Arc<Shape>, Error> {
    Shape::cuboid(half_extents).map(Arc::new)
}

/// A ball, shared.
pub(super) fn ball(radius: f32) -> Result<Arc<Shape>, Error> {
    Shape::sphere(radius).map(Arc::new)
}

/// The centre of mass of a body.
pub(super) fn center(world: &World, body: BodyHandle) -> Result<DVec3, Error> {
    Ok(world.body(body)?.center_of_mass().as_dvec3())
}

/// The velocity of a body's centre in the middle of the last substep.
pub(super) fn velocity(world: &World, body: BodyHandle) -> Result<DVec3, Error> {
    Ok(world.body(body)?.velocity().as_dvec3())
}

/// The pose of a rigid body's shape; the identity for what has none.
pub(super) fn pose(world: &World, body: BodyHandle) -> Result<(DVec3, Quat), Error> {
    let (position, rotation) = world.body(body)?.pose().unwrap_or((Vec3::ZERO, Quat::IDENTITY));
    Ok((position.as_dvec3(), rotation))
}

/// A vector turned by a rotation, in `f64`, whatever the quaternion's length.
pub(super) fn turned(rotation: Quat, vector: DVec3) -> DVec3 {
    let [x, y, z, w] = rotation.to_array().map(f64::from);
    let axis = DVec3::new(x, y, z);
    let twice = axis.cross(vector) * (2.0 / (axis.length_squared() + w * w));
    vector + twice * w + axis.cross(twice)
}

/// When a function of time changes its sign.
#[derive(Default)]
pub(super) struct Crossings {
    last: Option<[f64; 2]>,
    times: Vec<f64>,
}

impl Crossings {
    pub(super) fn add(&mut self, time: f64, value: f64) {
        if let Some([last_time, last]) = self.last
            && (last < 0.0) != (value < 0.0)
        {
            self.times.push(last_time + (time - last_time) * last / (last - value));
        }
        self.last = Some([time, value]);
    }

    /// Twice the mean interval; not a number without any.
    pub(super) fn period(&self) -> f64 {
        let intervals = self.intervals();
        2.0 * intervals.iter().sum::<f64>() / intervals.len() as f64
    }

    pub(super) fn times(&self) -> &[f64] {
        &self.times
    }

    pub(super) fn intervals(&self) -> Vec<f64> {
        self.times.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }
}

/// Where a condition that holds from some value on begins to hold, by halving [low, high] until it is `share` of it wide.
/// If it holds nowhere or everywhere, an end.
pub(super) fn threshold(
    [mut low, mut high]: [f64; 2],
    share: f64,
    mut holds: impl FnMut(f64) -> Result<bool, Error>,
) -> Result<f64, Error> {
    while high - low > share * high {
        let middle = 0.5 * (low + high);
        if holds(middle)? { high = middle } else { low = middle }
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_threshold_is_found_and_rotations_turn() {
        let found = threshold([0.0, 1.0], 1e-9, |x| Ok(x * x > 0.5)).unwrap();
        assert!((found - 0.5f64.sqrt()).abs() < 1e-8);
        let rotation = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
        assert!((turned(rotation * 3.0, DVec3::X) - DVec3::Y).length() < 1e-7);
    }
}
