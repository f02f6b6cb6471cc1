//! Two particles of cloth that are kept apart.

use glam::Vec3;

use super::points::PointSlices;

/// How two particles are kept apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parting {
    /// How far, in m.
    pub(super) distance: f32,
    /// The most by which what was too close before is moved apart in a small step, in m.
    pub(super) most: f32,
    /// What share of their motion against each other they lose.
    pub(super) friction: f32,
    /// How what they are of turns in this small step, in rad: to turn with it is not to rub.
    pub(super) turn: Vec3,
}

/// Moves a pair apart that is too close, with friction. Returns what that has added to angular momentum, in kg m² in a small
/// step, if it was.
///
/// It is pushed along what lay between when the small step began, s, as sticks are: that turns nothing. What is deeper
/// than it moved in is moved out without velocity along the normal; across, where angular momentum is s × μ d, a longer
/// s takes a smaller d.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn part_pair(points: &mut PointSlices<'_>, [a, b]: [usize; 2], parting: Parting) -> Option<Vec3> {
    let between = points.at(b) - points.at(a);
    let squared = between.length_squared();
    let masses = [points.inverse_mass[a], points.inverse_mass[b]];
    let free = masses[0] + masses[1];
    if squared >= parting.distance * parting.distance || free == 0.0 {
        return None;
    }
    let length = squared.sqrt();
    let slip = points.motion(b) - points.motion(a);
    let before = between - slip;
    let (direction, along) = direction_of(between, before);
    // In lengths of the direction.
    let per_square = 1.0 / direction.length_squared();
    let depth = (parting.distance - length) * length / along;
    let approach = slip.dot(direction) * per_square;
    let braked = depth.min((-approach).max(0.0));
    let out = (depth - braked).min(parting.most / length);
    let across = slip - direction * approach;
    let rubbed = (across - parting.turn.cross(before)) * parting.friction;
    let slowed = (across - rubbed) * (out / (1.0 + out));
    let apart = (direction * braked - rubbed - slowed) / free;
    let out = direction * (out / free);
    points.shift(a, -(apart * masses[0]));
    points.shift(b, apart * masses[1]);
    points.carry(a, -(out * masses[0]));
    points.carry(b, out * masses[1]);
    Some(before.cross(apart) + out.cross(slip + apart * free))
}

/// Along what two are pushed that are `between` (m) apart and were `before`, and its product with what is between, in m²:
/// along what was before, unless they have turned about each other by more than 60°. What is in one place parts along
/// some direction, the same for all.
#[inline(always)]
fn direction_of(between: Vec3, before: Vec3) -> (Vec3, f32) {
    let (squared, along) = (between.length_squared(), between.dot(before));
    if along > 0.5 * squared.max(before.length_squared()) && squared > 1e-16 {
        (before, along)
    } else if squared > 1e-16 {
        (between, squared)
    } else {
        (Vec3::Y * 1e-8, 1e-16)
    }
}
