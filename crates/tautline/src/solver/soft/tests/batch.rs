use super::*;
use crate::simd::Kernel;
use crate::solver::soft::tests::{cloud, farthest, in_f64, noise, on_all, positions, relax_in_f64, weights};

const PLACES: usize = 120;

/// A tangle of sticks, and a star with more rays than there are colours.
fn sticks() -> Vec<([u32; 2], Span)> {
    let number = |k: usize| ((noise(k) + 1.0) * 0.4999 * PLACES as f32) as u32;
    let tangle = (0..300).map(|k| [number(2 * k), number(2 * k + 1)]);
    let star = (10..90).map(|k| [5, k]);
    let span = |k: usize| Span { low: 0.5, high: 0.5 + 0.2 * noise(k).abs(), compliance: noise(k + 9).abs() };
    tangle
        .chain(star)
        .filter(|ends| ends[0] != ends[1])
        .enumerate()
        .map(|(k, ends)| (ends, span(k)))
        .collect()
}

struct Sweep<'a>(&'a Batches);

impl Kernel for Sweep<'_> {
    type Output = Points;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Points {
        let mut points = Points::default();
        points.reset(PLACES);
        points.start = cloud(PLACES, 1);
        points.inverse_mass = weights(PLACES);
        self.0.sweep::<L>(&mut points);
        points
    }
}

#[test]
fn every_stick_is_in_a_batch_in_which_none_shares_its_particles() {
    let batches = Batches::new(&sticks());
    let mut found = Vec::new();
    for batch in &batches.batches {
        let mut ends: Vec<u32> = batch.ends.iter().flat_map(|ends| ends[..batch.count].to_vec()).collect();
        found.extend((0..batch.count).map(|lane| [batch.ends[0][lane], batch.ends[1][lane]]));
        ends.sort_unstable();
        ends.dedup();
        assert_eq!(ends.len(), 2 * batch.count);
    }
    let mut expected: Vec<[u32; 2]> = sticks().iter().map(|(ends, _)| *ends).collect();
    expected.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn a_sweep_relaxes_batch_after_batch() {
    let batches = Batches::new(&sticks());
    let start = in_f64(&cloud(PLACES, 1));
    let mut expected = start.clone();
    for batch in &batches.batches {
        for lane in 0..batch.count {
            let ends = batch.ends.map(|ends| ends[lane] as usize);
            relax_in_f64(&mut expected, &start, &weights(PLACES), ends, batch.spans.map(|row| row.0[lane]));
        }
    }
    let off = farthest(&positions(&on_all(|| Sweep(&batches))), &expected);
    assert!(off < 1e-5, "{off} m off");
}

#[test]
fn few_colours_do_for_a_mesh() {
    let cloth = crate::body::Cloth::grid(20, 20, 1.0, 1.0).build().unwrap();
    let span = Span { low: 1.0, high: 1.0, compliance: 0.0 };
    let sticks: Vec<_> = cloth.body.sticks.iter().map(|stick| ([stick.a, stick.b], span)).collect();
    let batches = Batches::new(&sticks);
    assert!(batches.batches.len() * LANES < sticks.len() + 10 * LANES, "{} batches", batches.batches.len());
    assert!(Batches::new(&[]).batches.is_empty());
}
