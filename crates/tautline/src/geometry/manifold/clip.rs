//! A face against a face: the incident one clipped to what lies over the reference one (Sutherland & Hodgman 1974,
//! Reentrant polygon clipping), each corner with a key that names the features that made it.

use glam::Vec3;

use super::core::{Core, Pair};
use super::key::{Body, Key};
use super::reduce::Candidate;
use crate::simd::Lanes;

/// A face takes part when its normal is within 3.1° of the touching one (cosine).
pub(super) const ALIGNED: f32 = 0.9985;
/// By how much (cosine) the face of A has to be nearer to the normal than that of B to be the reference: two that
/// lie flat on each other do not take turns.
const PREFERENCE: f32 = 1e-4;

/// Memory for polygons, reused.
#[derive(Debug, Clone, Default)]
pub(crate) struct Polygon {
    reference: Vec<(u16, Vec3)>,
    incident: Vec<Corner>,
    clipped: Vec<Corner>,
    pub(super) candidates: Vec<Candidate>,
}

/// A corner of the clipped polygon, and the edge that leaves it.
#[derive(Debug, Clone, Copy)]
struct Corner {
    position: Vec3,
    key: Key,
    leaving: Edge,
}

#[derive(Debug, Clone, Copy)]
enum Edge {
    /// Of the incident face, by the corner of the body that it starts from.
    Incident(u16),
    /// Of the reference face, by its place there.
    Reference(usize),
}

/// The face to clip against.
#[derive(Clone, Copy)]
pub(super) struct Reference {
    pub(super) body: Body,
    face: usize,
    /// Unit, outward of that body, in A's frame.
    pub(super) outward: Vec3,
}

impl Reference {
    /// The face that is nearest to a direction from A to B, or `None` if none is near.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn choose<L: Lanes, B: Core>(pair: &Pair<B>, normal: Vec3) -> Option<Self> {
        let (face_a, along_a) = pair.a.facing::<L>(normal);
        let (face_b, along_b) = pair.b.facing::<L>(-pair.b_in_a.direction_inside(normal));
        if along_a.max(along_b) < ALIGNED {
            None
        } else if along_a > along_b + PREFERENCE {
            Some(Self { body: Body::A, face: face_a, outward: pair.a.normal(face_a) })
        } else {
            Some(Self::of_b(pair, face_b))
        }
    }

    #[inline(always)]
    pub(super) fn of_b<B: Core>(pair: &Pair<B>, face: usize) -> Self {
        Self { body: Body::B, face, outward: pair.b_in_a.rotation * pair.b.normal(face) }
    }

    /// Unit, from A to B.
    #[inline(always)]
    pub(super) fn normal(&self) -> Vec3 {
        match self.body {
            Body::A => self.outward,
            Body::B => -self.outward,
        }
    }
}

impl Polygon {
    /// The least separation of the candidates, in m; ∞ without any.
    #[inline(always)]
    pub(super) fn deepest(&self) -> f32 {
        self.candidates.iter().fold(f32::INFINITY, |least, candidate| least.min(candidate.separation))
    }

    /// Fills `candidates` with the corners of what the incident face, segment or point has over the reference face
    /// and less than `limit` beyond its plane. Separations are those of the cores.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub(super) fn clip<L: Lanes, B: Core>(&mut self, pair: &Pair<B>, reference: &Reference, limit: f32) {
        self.gather::<L, B>(pair, reference);
        let count = self.reference.len();
        for side in 0..count {
            let (start, end) = (self.reference[side].1, self.reference[(side + 1) % count].1);
            let inward = reference.outward.cross(end - start);
            if self.clip_to_side(side, start, inward, reference.body) {
                std::mem::swap(&mut self.incident, &mut self.clipped);
            }
        }
        self.candidates.clear();
        let origin = self.reference[0].1;
        for corner in &self.incident {
            let separation = reference.outward.dot(corner.position - origin);
            if separation < limit {
                let on_a = match reference.body {
                    Body::A => corner.position - reference.outward * separation,
                    Body::B => corner.position,
                };
                self.candidates.push(Candidate { on_a, separation, key: corner.key });
            }
        }
    }

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn gather<L: Lanes, B: Core>(&mut self, pair: &Pair<B>, reference: &Reference) {
        let Self { reference: outline, incident, .. } = self;
        outline.clear();
        incident.clear();
        let against = -reference.outward;
        match reference.body {
            Body::A => {
                outline.extend(pair.a.corners(pair.a.faces[reference.face]));
                let (face, along) = pair.b.facing::<L>(pair.b_in_a.direction_inside(against));
                collect(pair.b, face, along, |(index, position)| {
                    incident.push(Corner::of(Body::B, index, pair.b_in_a.point(position)));
                });
            }
            Body::B => {
                let placed = |(index, position)| (index, pair.b_in_a.point(position));
                outline.extend(pair.b.corners(reference.face).map(placed));
                let (face, along) = pair.a.facing::<L>(against);
                collect(pair.a, face, along, |(index, position)| {
                    incident.push(Corner::of(Body::A, index, position));
                });
            }
        }
        // A segment is gone there and back: one edge, so that what both ways give has one name.
        if let [_, back] = &mut incident[..] {
            back.leaving = Edge::Incident(0);
        }
    }

    /// Cuts off what lies outside one side of the reference face, into `clipped`; false if that is nothing.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn clip_to_side(&mut self, side: usize, start: Vec3, inward: Vec3, body: Body) -> bool {
        let height = |corner: &Corner| inward.dot(corner.position - start);
        if self.incident.iter().all(|corner| height(corner) >= 0.0) {
            return false;
        }
        self.clipped.clear();
        let Some(mut last) = self.incident.last().copied() else { return false };
        let mut last_height = height(&last);
        for &corner in &self.incident {
            let corner_height = height(&corner);
            let is_inside = corner_height >= 0.0;
            if (last_height >= 0.0) != is_inside {
                let part = last_height / (last_height - corner_height);
                let position = last.position + (corner.position - last.position) * part;
                let leaving = if is_inside { last.leaving } else { Edge::Reference(side) };
                let key = self.key_of_crossing(last.leaving, side, body);
                self.clipped.push(Corner { position, key, leaving });
            }
            if is_inside {
                self.clipped.push(corner);
            }
            (last, last_height) = (corner, corner_height);
        }
        true
    }

    /// Where an edge of the polygon crosses a side of the reference face.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn key_of_crossing(&self, edge: Edge, side: usize, body: Body) -> Key {
        let corner = self.reference[side].0;
        match edge {
            Edge::Incident(start) => Key::crossing(body, corner, start),
            // Two sides meet in a corner of the reference face: in the latter's start, but for the last and the first.
            Edge::Reference(earlier) if earlier == 0 && side + 1 == self.reference.len() => {
                Key::corner(body, self.reference[0].0)
            }
            Edge::Reference(_) => Key::corner(body, corner),
        }
    }
}

impl Corner {
    #[inline(always)]
    fn of(body: Body, index: u16, position: Vec3) -> Self {
        Self { position, key: Key::corner(body, index), leaving: Edge::Incident(index) }
    }
}

/// The corners of a face, or, without faces, of the whole core.
#[inline(always)]
fn collect<C: Core>(core: &C, face: usize, along: f32, visit: impl FnMut((u16, Vec3))) {
    if along > f32::NEG_INFINITY {
        core.corners(face).for_each(visit);
    } else {
        core.vertices().iter().enumerate().map(|(index, &position)| (index as u16, position)).for_each(visit);
    }
}
