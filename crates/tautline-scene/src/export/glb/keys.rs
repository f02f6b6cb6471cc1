//! Key frames of a deforming motion: as few as the eye allows.

use tautline::Vec3;

/// The most key frames of a motion; viewers hold a morph target in memory for each.
pub(super) const MAX_KEYS: usize = 60;
/// The most frames from one key to the next: bounds the search, which is quadratic in it.
const LONGEST_SPAN: usize = 30;
/// Deviation that nobody sees, as a share of the motion's extent.
const INVISIBLE: f32 = 3e-4;

/// Key frames, in order, from the first frame to the last. Linear interpolation between them deviates from no
/// frame by more than [`INVISIBLE`] times the extent of the motion or, where that would take more than
/// [`MAX_KEYS`] keys, by as little as a fixed ladder of tolerances (each 1.4 times the one before) allows.
pub(super) fn choose(shapes: &[Vec<Vec3>]) -> Vec<usize> {
    let mut tolerance = INVISIBLE * extent(shapes);
    let mut span = LONGEST_SPAN;
    loop {
        let keys = within(shapes, tolerance, span);
        if keys.len() <= MAX_KEYS {
            return keys;
        }
        tolerance = 1.4 * tolerance + f32::MIN_POSITIVE;
        // Very long motions need longer spans to have few keys.
        span = span.max(2 * shapes.len() / MAX_KEYS);
    }
}

/// Greedy: each span is as long as the tolerance (m) allows.
fn within(shapes: &[Vec<Vec3>], tolerance: f32, longest_span: usize) -> Vec<usize> {
    let last = shapes.len().saturating_sub(1);
    let mut keys = vec![0];
    let mut from = 0;
    while from < last {
        let mut to = from + 1;
        while to < last && to - from < longest_span && follows(&shapes[from..=to + 1], tolerance) {
            to += 1;
        }
        keys.push(to);
        from = to;
    }
    keys
}

/// Whether every shape is within the tolerance (m) of the linear motion from the first to the last.
fn follows(shapes: &[Vec<Vec3>], tolerance: f32) -> bool {
    let [first, between @ .., last] = shapes else { return true };
    between.iter().enumerate().all(|(i, shape)| {
        let t = (i + 1) as f32 / (between.len() + 1) as f32;
        let ends = first.iter().zip(last);
        shape.iter().zip(ends).all(|(&p, (&a, &b))| p.distance_squared(a.lerp(b, t)) <= tolerance * tolerance)
    })
}

/// Diagonal (m) of the box around the first and the last shape.
fn extent(shapes: &[Vec<Vec3>]) -> f32 {
    let ends = shapes.first().into_iter().chain(shapes.last()).flatten();
    let (low, high) = ends.fold((Vec3::MAX, Vec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
    if low.x > high.x { 0.0 } else { (high - low).length() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(frames: usize, place: impl Fn(f32) -> f32) -> Vec<Vec<Vec3>> {
        (0..frames).map(|f| vec![Vec3::ZERO, Vec3::new(1.0, place(f as f32 / frames as f32), 0.0)]).collect()
    }

    #[test]
    fn straight_motion_needs_only_its_ends() {
        assert_eq!(choose(&motion(25, |t| t)), [0, 24]);
    }

    #[test]
    fn a_single_frame_is_its_own_key() {
        assert_eq!(choose(&motion(1, |t| t)), [0]);
    }

    #[test]
    fn keys_are_few_and_reach_the_last_frame() {
        for frames in [2, 61, 600, 5000] {
            let keys = choose(&motion(frames, |t| (40.0 * t).sin()));
            assert!(keys.len() <= MAX_KEYS);
            assert_eq!((keys[0], keys[keys.len() - 1]), (0, frames - 1));
            assert!(keys.windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn interpolation_stays_within_the_tolerance() {
        let shapes = motion(100, |t| t * t);
        let keys = choose(&shapes);
        assert!(keys.len() < 40, "{}", keys.len());
        for span in keys.windows(2) {
            let (a, b) = (shapes[span[0]][1], shapes[span[1]][1]);
            for (i, shape) in shapes[span[0]..=span[1]].iter().enumerate() {
                let t = i as f32 / (span[1] - span[0]) as f32;
                assert!(a.lerp(b, t).distance(shape[1]) <= INVISIBLE * 1.5);
            }
        }
    }
}
