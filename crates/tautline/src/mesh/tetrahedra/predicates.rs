//! Exact predicates on points: orientation, the perturbed in-sphere test, and whether two simplices
//! meet properly. All decide by sign alone, with Shewchuk's adaptive arithmetic ("Adaptive precision
//! floating-point arithmetic and fast robust geometric predicates", 1997), so nothing here has a
//! tolerance.

use glam::DVec3;
use robust::{Coord, Coord3D};

/// Four corners; positive where the fourth lies on the side the first three turn counter-clockwise to.
pub(super) type Tet = [u32; 4];
/// Three corners, counter-clockwise seen from outside of what the face bounds.
pub(in crate::mesh) type Face = [u32; 3];

/// Outward faces of a positive tetrahedron; face i is opposite corner i.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Outward face of `tet` opposite corner `i`.
pub(super) fn face_of(tet: &Tet, i: usize) -> Face {
    FACES[i].map(|k| tet[k])
}

/// The four outward faces, each in canonical form.
pub(super) fn faces_of(tet: &Tet) -> [Face; 4] {
    [0, 1, 2, 3].map(|i| canonical(face_of(tet, i)))
}

/// The tetrahedron between a face and an apex on its inner side.
pub(super) fn tet_on(face: Face, apex: u32) -> Tet {
    [face[0], face[2], face[1], apex]
}

/// The rotation of a face that starts with its lowest corner: equal for equal oriented faces.
pub(super) fn canonical([a, b, c]: Face) -> Face {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The same face seen from the other side, in canonical form.
pub(super) fn reversed([a, b, c]: Face) -> Face {
    canonical([a, c, b])
}

/// Six times the signed volume of (a, b, c, d), exact in sign: positive where a, b, c run
/// counter-clockwise seen from d's side.
pub(in crate::mesh) fn orient(points: &[DVec3], [a, b, c]: Face, d: u32) -> f64 {
    let at = |i: u32| {
        let p = points[i as usize];
        Coord3D { x: p.x, y: p.y, z: p.z }
    };
    -robust::orient3d(at(a), at(b), at(c), at(d))
}

/// Whether `p` lies inside the sphere around a positive tetrahedron. Five points on one sphere are
/// decided as if each were lifted by an infinitesimal that grows with its index, so that the Delaunay
/// triangulation is unique and has no flat tetrahedra (Devillers and Teillaud, "Perturbations for
/// Delaunay and weighted Delaunay 3D triangulations", 2011).
pub(super) fn in_sphere(points: &[DVec3], tet: &Tet, p: u32) -> bool {
    let at = |i: u32| {
        let p = points[i as usize];
        Coord3D { x: p.x, y: p.y, z: p.z }
    };
    let inside = robust::insphere(at(tet[0]), at(tet[2]), at(tet[1]), at(tet[3]), at(p));
    if inside != 0.0 {
        return inside > 0.0;
    }
    let mut order = [tet[0], tet[1], tet[2], tet[3], p];
    order.sort_unstable_by(|a, b| b.cmp(a));
    for lifted in order {
        let Some(corner) = tet.iter().position(|&v| v == lifted) else {
            return false; // p itself is lifted most: off the sphere, outwards
        };
        let mut replaced = *tet;
        replaced[corner] = p;
        let side = orient(points, [replaced[0], replaced[1], replaced[2]], replaced[3]);
        if side != 0.0 {
            return side > 0.0;
        }
    }
    false
}

/// Height of the sphere's centre over the face: Delaunay tetrahedra have the
/// lowest. In units of the face's normal, and rounded: for sorting only.
pub(super) fn reach(points: &[DVec3], face: Face, apex: u32) -> f64 {
    let [a, b, c, d] = tet_on(face, apex).map(|v| points[v as usize]);
    let (u, v, w) = (b - a, c - a, d - a);
    let normal = u.cross(v);
    let foot = (normal.cross(u) * v.length_squared() + v.cross(normal) * u.length_squared())
        / (2.0 * normal.length_squared());
    (w.length_squared() - 2.0 * w.dot(foot)) / (2.0 * w.dot(normal))
}

/// Orientation of three points seen along `axis`.
fn orient_along(points: &[DVec3], axis: usize, [a, b, c]: Face) -> f64 {
    let at = |i: u32| {
        let p = points[i as usize];
        Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] }
    };
    robust::orient2d(at(a), at(b), at(c))
}

/// The axis along which the triangle looks largest; `None` if its corners lie on one line.
pub(super) fn widest_axis(points: &[DVec3], face: Face) -> Option<usize> {
    let area = |axis: &usize| orient_along(points, *axis, face).abs();
    (0..3).max_by(|a, b| area(a).total_cmp(&area(b))).filter(|axis| area(axis) > 0.0)
}

/// Whether edge and triangle share more than corners, or one corner's point with no corner there.
pub(super) fn edge_crosses_face(points: &[DVec3], [p, q]: [u32; 2], face: Face) -> bool {
    match (face.contains(&p), face.contains(&q)) {
        (true, true) => false,
        (true, false) => edge_runs_into_face(points, p, q, face),
        (false, true) => edge_runs_into_face(points, q, p, face),
        (false, false) => {
            let (side_p, side_q) = (orient(points, face, p), orient(points, face, q));
            if side_p == 0.0 && side_q == 0.0 {
                return coplanar_edge_meets_face(points, [p, q], face);
            }
            if (side_p > 0.0 && side_q > 0.0) || (side_p < 0.0 && side_q < 0.0) {
                return false;
            }
            let [a, b, c] = face;
            let turns = [[a, b], [b, c], [c, a]].map(|[s, t]| orient(points, [p, q, s], t));
            turns.iter().all(|&t| t >= 0.0) || turns.iter().all(|&t| t <= 0.0)
        }
    }
}

/// For an edge that starts at corner `p` of the face: whether it goes on within the face.
fn edge_runs_into_face(points: &[DVec3], p: u32, q: u32, face: Face) -> bool {
    if orient(points, face, q) != 0.0 {
        return false;
    }
    let Some(axis) = widest_axis(points, face) else { return true };
    let k = face.iter().position(|&v| v == p).unwrap_or(0);
    let (next, last) = (face[(k + 1) % 3], face[(k + 2) % 3]);
    let turn = orient_along(points, axis, face);
    turn * orient_along(points, axis, [p, next, q]) >= 0.0
        && turn * orient_along(points, axis, [p, q, last]) >= 0.0
}

fn coplanar_edge_meets_face(points: &[DVec3], [p, q]: [u32; 2], face: Face) -> bool {
    let Some(axis) = widest_axis(points, face) else { return true };
    let side = |a, b, c| {
        let turn = orient_along(points, axis, [a, b, c]);
        if turn > 0.0 { 1 } else { -i32::from(turn < 0.0) }
    };
    let [a, b, c] = face;
    let turn = side(a, b, c);
    let contains = |v| [[a, b], [b, c], [c, a]].iter().all(|&[s, t]| side(s, t, v) * turn >= 0);
    // With neither end inside, the edge meets the triangle only where it properly crosses its outline
    // or passes through a corner.
    let crosses = |s, t| side(p, q, s) * side(p, q, t) <= 0 && side(s, t, p) * side(s, t, q) < 0;
    contains(p) || contains(q) || crosses(a, b) || crosses(b, c) || crosses(c, a)
}

/// Whether two triangles share more than a common corner or a common edge.
pub(in crate::mesh) fn faces_cross(points: &[DVec3], f: Face, g: Face) -> bool {
    let crosses = |f: Face, g: Face| (0..3).any(|k| edge_crosses_face(points, [f[k], f[(k + 1) % 3]], g));
    crosses(f, g) || crosses(g, f)
}

/// Whether tetrahedron and triangle overlap: their intersection is not a corner, edge or face of both.
pub(super) fn tet_crosses_face(points: &[DVec3], tet: &Tet, face: Face) -> bool {
    let outer = [0, 1, 2, 3].map(|i| face_of(tet, i));
    let beyond = |side: Face| face.iter().all(|&v| side.contains(&v) || orient(points, side, v) > 0.0);
    if outer.iter().any(|&side| beyond(side)) {
        return false;
    }
    let sides = tet.map(|v| if face.contains(&v) { 0.0 } else { orient(points, face, v) });
    let apart = |sign: f64| tet.iter().zip(sides).all(|(v, s)| face.contains(v) || sign * s > 0.0);
    if apart(1.0) || apart(-1.0) {
        return false;
    }
    let within = |v: u32| !tet.contains(&v) && outer.iter().all(|&side| orient(points, side, v) <= 0.0);
    face.iter().any(|&v| within(v))
        || EDGES.iter().any(|e| edge_crosses_face(points, e.map(|k| tet[k]), face))
        || outer.iter().any(|&g| (0..3).any(|k| edge_crosses_face(points, [face[k], face[(k + 1) % 3]], g)))
}
