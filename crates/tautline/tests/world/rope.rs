//! A hung rope against the discrete catenary.

use tautline::{Rope, Settings, Vec3, World};

use crate::run;

/// The nodes of a hung chain of `segments` equal links of length `link`, hung at x = ±span/2, y = 0. In
/// equilibrium link k carries the horizontal tension H everywhere and the vertical (k − (n − 1)/2) m g; H follows
/// from the span by bisection (in units of m g).
fn discrete_catenary(segments: usize, link: f64, span: f64) -> Vec<[f64; 2]> {
    let vertical = |k: usize| k as f64 - (segments as f64 - 1.0) / 2.0;
    let width = |h: f64| (0..segments).map(|k| link * h / h.hypot(vertical(k))).sum::<f64>();
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        if width(middle) < span { low = middle } else { high = middle }
    }
    let mut nodes = vec![[-span / 2.0, 0.0]];
    for k in 0..segments {
        let [x, y] = nodes[k];
        let tension = low.hypot(vertical(k));
        nodes.push([x + link * low / tension, y + link * vertical(k) / tension]);
    }
    nodes
}

#[test]
fn a_hung_rope_takes_the_shape_of_the_discrete_catenary() {
    let (segments, span, length) = (20, 2.0f32, 2.6f32);
    let settings = Settings { substeps: 64, damping: 2.0, sleep: None, ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let (start, end) = (Vec3::X * (-span / 2.0), Vec3::X * (span / 2.0));
    let rope = world.add(Rope::straight(start, end, segments).length(length).pin_ends()).unwrap();
    run(&mut world, 480);
    let expected = discrete_catenary(segments as usize, f64::from(length / segments as f32), f64::from(span));
    let positions = world.body(rope).unwrap().positions();
    let off = |(x, node): (&Vec3, &[f64; 2])| (f64::from(x.x) - node[0]).hypot(f64::from(x.y) - node[1]);
    let worst = positions.iter().zip(&expected).map(off).fold(0.0, f64::max);
    println!("worst node {worst} m off, strain {:?}", world.strain());
    assert!(worst < 0.004 * f64::from(span), "a node is {worst} m off");
    assert!(world.strain().max < 0.01);
}
