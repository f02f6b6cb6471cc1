//! Pairs that move: at random on a small lattice, and made so that they meet.

use crate::exact::Way;
use crate::random::Random;

/// Of the corners a vertex and a face, or twice two edges, in this order.
pub(crate) type Pair = [Way; 4];
type Case = (&'static str, fn(&mut Random) -> Pair);

/// Pairs of which nothing is known beforehand. The smaller the lattice, the more of them only touch.
pub(crate) const RANDOM: [Case; 6] = [
    ("random, 1000 cells", |r| r.pair(|r| r.way(1000))),
    ("random, 8 cells", |r| r.pair(|r| r.way(8))),
    ("random, 2 cells", |r| r.pair(|r| r.way(2))),
    ("slow", |r| {
        r.pair(|r| {
            let place = r.place(50);
            [place, sum(place, r.place(2), 1)]
        })
    }),
    ("one direction", |r| {
        let push = r.place(20);
        r.pair(|r| {
            let place = r.place(20);
            [place, sum(place, push, r.whole(3))]
        })
    }),
    ("in one plane", |r| {
        r.pair(|r| {
            let [[x, z, _], [u, w, _]] = r.way(20);
            [[x, x + z, z], [u, u + w, w]]
        })
    }),
];

/// Places, at one moment, of a vertex and a face that touch, or of two edges.
type Contact = (&'static str, fn(&mut Random) -> [[i64; 3]; 4]);

/// With the vertex first.
pub(crate) const ON_FACE: [Contact; 6] = [
    ("inside the face", |r| {
        let [a, b, c] = [0; 3].map(|_| scaled(r.place(20), 4));
        [sum(sum(scaled(a, 2), b, 1), c, 1).map(|x| x / 4), a, b, c]
    }),
    ("on its edge", |r| {
        let [a, b, c] = [0; 3].map(|_| scaled(r.place(20), 2));
        [sum(a, b, 1).map(|x| x / 2), a, b, c]
    }),
    ("at its corner", |r| {
        let [a, b, c] = [0; 3].map(|_| r.place(20));
        [a, a, b, c]
    }),
    ("face without area", |r| {
        let (a, along) = (r.place(20), r.place(5));
        let [k, l, m] = [0; 3].map(|_| r.whole(4));
        [sum(a, along, k.min(l).max(k.max(l).min(m))), sum(a, along, k), sum(a, along, l), sum(a, along, m)]
    }),
    ("face that is a point", |r| [r.place(20); 4]),
    ("needle of a face", |r| {
        let (a, b) = (r.place(1000), r.place(1000));
        let c = sum(b, r.place(1), 1);
        [b, a, b, c]
    }),
];

/// Two edges, end by end.
pub(crate) const ON_EDGE: [Contact; 6] = [
    ("edges across", |r| {
        let (at, u, v) = (r.place(20), r.place(9), r.place(9));
        [sum(at, u, -1), sum(at, u, 2), sum(at, v, -3), sum(at, v, 1)]
    }),
    ("end on an edge", |r| {
        let (at, u, v) = (r.place(20), r.place(9), r.place(9));
        [at, sum(at, u, 2), sum(at, v, -3), sum(at, v, 1)]
    }),
    ("end on end", |r| {
        let (at, u, v) = (r.place(20), r.place(9), r.place(9));
        [at, sum(at, u, 2), sum(at, v, 3), at]
    }),
    ("on one line", |r| {
        let (at, u) = (r.place(20), r.place(9));
        [sum(at, u, -2), at, sum(at, u, -1), sum(at, u, 3)]
    }),
    ("edge that is a point", |r| {
        let (at, u) = (r.place(20), r.place(9));
        [at, at, sum(at, u, -1), sum(at, u, 3)]
    }),
    ("nearly parallel", |r| {
        let (at, u) = (r.place(20), r.place(400));
        let v = sum(u, r.place(1), 1);
        [sum(at, u, -1), sum(at, u, 1), sum(at, v, -1), sum(at, v, 1)]
    }),
];

/// Ways that lead through these places at an eighth of the time, and which. Some corners stand still, some all move alike.
pub(crate) fn through(contact: [[i64; 3]; 4], r: &mut Random) -> (Pair, f32) {
    let eighth = r.whole(4) + 4;
    let (common, reach) = (r.place(30), [0, 1, 30][r.index(3)]);
    let ways = contact.map(|place| {
        let speed = sum(common, r.place(reach), 1);
        [sum(place, speed, -eighth), sum(place, speed, 8 - eighth)]
    });
    (ways, eighth as f32 / 8.0)
}

fn scaled(place: [i64; 3], by: i64) -> [i64; 3] {
    place.map(|x| x * by)
}

/// place + times · way.
fn sum(place: [i64; 3], way: [i64; 3], times: i64) -> [i64; 3] {
    [0, 1, 2].map(|i| place[i] + times * way[i])
}
