//! Whether and when two things that move on straight lines meet, without rounding.
//!
//! Four corners that meet lie in one plane: a cubic in the time is zero. At each of its roots in [0, 1] some polynomials tell
//! by their signs whether the meeting is inside the face, or on both edges.

use crate::polynomial::{Dyadic, Polynomial};

/// A corner's way: where it is at 0 and at 1, in whole numbers.
pub(crate) type Way = [[i64; 3]; 2];

/// What is true of a pair.
#[derive(Debug, Clone)]
pub(crate) enum Truth {
    /// They meet first at this time.
    Meet(Time),
    /// They do not meet.
    Pass,
    /// They are in one plane when the face has no area or the edges are parallel: not decided here.
    Degenerate,
}

/// A time from 0 to 1: 0 itself, or the one root of a polynomial in (low, high].
#[derive(Debug, Clone)]
pub(crate) enum Time {
    Start,
    Root { of: Polynomial, low: Dyadic, high: Dyadic },
}

type Vector = [Polynomial; 3];

pub(crate) fn vertex_face(vertex: Way, [a, b, c]: [Way; 3]) -> Truth {
    let [ap, bp, cp] = [a, b, c].map(|corner| between(vertex, corner));
    let normal = cross(&between(a, b), &between(a, c));
    let areas = [cross(&bp, &cp), cross(&cp, &ap), cross(&ap, &bp)].map(|area| dot(&area, &normal));
    first(&dot(&normal, &ap), &areas, &dot(&normal, &normal))
}

pub(crate) fn edge_edge([p, q]: [Way; 2], [r, s]: [Way; 2]) -> Truth {
    let (along, other, from) = (between(p, q), between(r, s), between(p, r));
    let normal = cross(&along, &other);
    let square = dot(&normal, &normal);
    // On the first at the share dot(from × other, normal)/square, likewise on the other.
    let shares = [&other, &along].map(|edge| dot(&cross(&from, edge), &normal));
    let [on_first, on_other] = &shares;
    let inside = [on_first.clone(), square.minus(on_first), on_other.clone(), square.minus(on_other)];
    first(&dot(&normal, &from), &inside, &square)
}

fn first(plane: &Polynomial, inside: &[Polynomial], square: &Polynomial) -> Truth {
    let times = if plane.is_zero() {
        // Always in one plane: they begin to meet when one sign changes, or at once.
        let mut times = vec![Time::Start];
        times.extend(inside.iter().flat_map(roots));
        times
    } else {
        let starts = plane.sign_at(&Dyadic::whole(0)) == 0;
        starts.then_some(Time::Start).into_iter().chain(roots(plane)).collect()
    };
    let mut earliest: Option<(f64, Time)> = None;
    for mut time in times {
        if time.sign_of(square) == 0 {
            return Truth::Degenerate;
        }
        if inside.iter().all(|part| time.sign_of(part) >= 0) {
            let rounded = time.rounded();
            earliest = earliest.filter(|(other, _)| *other <= rounded).or(Some((rounded, time)));
        }
    }
    earliest.map_or(Truth::Pass, |(_, time)| Truth::Meet(time))
}

/// Those in (0, 1], ascending.
fn roots(of: &Polynomial) -> Vec<Time> {
    if of.is_zero() {
        return Vec::new();
    }
    let of = of.with_simple_roots();
    let mut found = Vec::new();
    let mut pending = vec![(Dyadic::whole(0), Dyadic::whole(1))];
    while let Some((low, high)) = pending.pop() {
        match of.roots_in(&low, &high) {
            0 => {}
            1 => found.push(Time::Root { of: of.clone(), low, high }),
            _ => {
                let middle = low.middle(&high);
                pending.extend([(middle.clone(), high), (low, middle)]);
            }
        }
    }
    found
}

impl Time {
    /// The sign of another polynomial at this time.
    fn sign_of(&mut self, other: &Polynomial) -> i32 {
        let Self::Root { of, .. } = self else { return other.sign_at(&Dyadic::whole(0)) };
        if other.is_zero() {
            return 0;
        }
        let common = of.common_divisor(other).with_simple_roots();
        let simple = other.with_simple_roots();
        loop {
            let Self::Root { low, high, .. } = self else { return 0 };
            if common.roots_in(low, high) > 0 {
                return 0;
            }
            if simple.roots_in(low, high) == 0 {
                return other.sign_at(high);
            }
            self.halve();
        }
    }

    fn halve(&mut self) {
        let Self::Root { of, low, high } = self else { return };
        let middle = low.middle(high);
        if of.roots_in(low, &middle) > 0 { *high = middle } else { *low = middle }
    }

    /// To within 2^−40, from above.
    pub(crate) fn rounded(&mut self) -> f64 {
        while let Self::Root { low, high, .. } = self
            && high.to_f64() - low.to_f64() > 2f64.powi(-40)
        {
            self.halve();
        }
        match self {
            Self::Start => 0.0,
            Self::Root { high, .. } => high.to_f64(),
        }
    }

    /// Whether it is before `time`.
    pub(crate) fn is_before(&self, time: f32) -> bool {
        let time = Dyadic::of(time);
        match self {
            Self::Start => Dyadic::whole(0).is_below(&time),
            Self::Root { of, low, high } if low.is_below(&time) => {
                let end = if high.is_below(&time) { high } else { &time };
                of.roots_in(low, end) > 0 && (high.is_below(&time) || of.sign_at(&time) != 0)
            }
            Self::Root { .. } => false,
        }
    }
}

fn between(from: Way, to: Way) -> Vector {
    [0, 1, 2].map(|i| {
        let [start, end] = [0, 1].map(|k: usize| to[k][i] - from[k][i]);
        Polynomial::line(start, end - start)
    })
}

fn dot(p: &Vector, q: &Vector) -> Polynomial {
    p[0].times(&q[0]).plus(&p[1].times(&q[1])).plus(&p[2].times(&q[2]))
}

fn cross(p: &Vector, q: &Vector) -> Vector {
    let part = |i: usize, j: usize| p[i].times(&q[j]).minus(&p[j].times(&q[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}
