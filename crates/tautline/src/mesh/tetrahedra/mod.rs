//! Dividing the inside of a closed surface into tetrahedra that keep the surface as it is: the paper's
//! "restricted 3D triangulation" (section 4), whose edges become the sticks of a rigid body.
//!
//! The vertices' Delaunay triangulation is made first, and what of it lies inside and respects the
//! surface is kept. The rest is empty cavities, bounded by triangles. An advancing front fills most of
//! them; what it leaves is searched exhaustively together with a small neighbourhood, and where that
//! fails, interior points are added: one that sees a whole cavity, or several half way through the solid
//! (Schönhardt's polyhedron cannot be divided without). Points that turn out unnecessary are taken out
//! again. All decisions are exact, so a result is always valid; that there is one is likely, not proven.
//! Shape is not optimised: corners almost in one plane can give tetrahedra that are almost flat.

mod advance;
mod boxes;
mod conforming;
mod delaunay;
mod filling;
mod lattice;
pub(super) mod predicates;
mod quality;
mod search;
mod steiner;
mod surface;

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};

use super::TriMesh;
use crate::order::PutInOrder;
use crate::{Error, MeshDefect};
use filling::{Cavity, Filling};
pub use lattice::lattice;
use predicates::{Face, Tet};
pub use quality::TetrahedraQuality;

/// The inside of a closed surface as tetrahedra.
#[derive(Debug, Clone, PartialEq)]
pub struct Tetrahedra {
    /// In m; of a divided surface its vertices in their order, then the interior points.
    pub points: Vec<Vec3>,
    /// Four indices into `points` each; the first three run counter-clockwise seen from the fourth.
    pub tetrahedra: Vec<[u32; 4]>,
    /// How many points lie inside. Of a divided surface they are at the end of `points`, and few, but not proven to be the
    /// fewest.
    pub interior_points: usize,
}

/// How often a cavity is widened by the tetrahedra around it before an interior point is accepted.
const WIDENINGS: usize = 4;
/// Seedings in a row that do not shrink what is empty before the mesh is refused.
const MAX_STALLED: usize = 16;
/// Seedings in all, for a small mesh.
const MAX_SEEDINGS: usize = 40;
/// Where on the way through the solid points are put: half way, or else elsewhere.
const SHARES: [f64; 5] = [0.5, 0.3, 0.7, 0.1, 0.4];

/// Divides the inside of a closed mesh into tetrahedra. No vertex of the surface is moved or added, and
/// every triangle is a face of exactly one tetrahedron. The same mesh gives the same result to the bit.
///
/// # Errors
///
/// [`Error::Mesh`] with the first defect found: the mesh is empty, open, turned inside out or
/// degenerate; has unused or coincident vertices; crosses or touches itself (the message names the two
/// triangles); or no division was found.
pub fn tetrahedralise(mesh: &TriMesh) -> Result<Tetrahedra, Error> {
    let (mut points, faces) = surface::checked(mesh)?;
    let (first_interior, mut surface) = (points.len(), BTreeSet::new());
    surface.extend(faces.iter().copied());
    let delaunay = delaunay::delaunay(&points).ok_or(MeshDefect::Flat { count: points.len() })?;
    let mut filling = Filling::new(surface.clone());
    for tet in conforming::conforming(&points, &faces, &delaunay) {
        filling.place(tet);
    }
    for cavity in filling.cavities(&points) {
        filling.replace(&cavity, advance::advance(&points, &cavity.faces, &[]));
    }
    if let Err(refusal) = fill_cavities(&mut points, &mut filling, &surface) {
        // A solid that is star-shaped as a whole can always be joined to one point, however thin its rays.
        points.truncate(first_interior);
        filling = Filling::new(surface.clone());
        let star = steiner::kernel_star(&mut points, &surface).ok_or(refusal)?;
        star.into_iter().for_each(|tet| filling.place(tet));
    }
    remove_interior_points(&points, &mut filling, first_interior);
    Ok(numbered(&points, filling.tetrahedra(), first_interior))
}

/// Fills what the advancing front left, cavity by cavity: without a new point if possible, or with one;
/// else a wide neighbourhood is seeded with points and the front advances through it again.
fn fill_cavities(
    points: &mut Vec<DVec3>,
    filling: &mut Filling,
    surface: &BTreeSet<Face>,
) -> Result<(), Error> {
    let (mut smallest_front, mut stalled) = (usize::MAX, 0);
    let mut seedings_left = MAX_SEEDINGS + surface.len() / 64;
    let enough_points = 2 * points.len() + 64;
    loop {
        let mut cavities = filling.cavities(points);
        if cavities.is_empty() {
            return Ok(());
        }
        cavities.put_in_order_by_key(|cavity| cavity.faces.len());
        let cavity = &cavities[stalled % cavities.len()];
        let rings = rings(filling, cavity);
        let searched = rings.iter().find_map(|r| Some((r.clone(), search::search(points, &r.faces)?)));
        if let Some((ring, tets)) = searched.or_else(|| steiner::star(points, filling, cavity)) {
            filling.replace(&ring, tets);
            continue;
        }
        stalled = if filling.front().len() < smallest_front { 0 } else { stalled + 1 };
        smallest_front = smallest_front.min(filling.front().len());
        seedings_left -= 1;
        if stalled == MAX_STALLED || seedings_left == 0 || points.len() > enough_points {
            return Err(unfilled(points, cavity));
        }
        let share = SHARES[stalled % SHARES.len()];
        reseed(points, filling, surface, (cavity, &rings[1 + stalled % WIDENINGS]), share);
    }
}

/// Puts points behind the cavity's surface triangles (behind all its faces if it has none) and lets the
/// front advance through the wide neighbourhood around it.
fn reseed(
    points: &mut Vec<DVec3>,
    filling: &mut Filling,
    surface: &BTreeSet<Face>,
    (cavity, wide): (&Cavity, &Cavity),
    share: f64,
) {
    let first = points.len() as u32;
    let bare: Vec<Face> = cavity.faces.intersection(surface).copied().collect();
    if bare.is_empty() {
        let faces: Vec<Face> = cavity.faces.iter().copied().collect();
        steiner::seed(points, &cavity.faces, &faces, share);
    } else {
        steiner::seed(points, surface, &bare, share);
    }
    let mut loose = filling.loose_vertices(wide);
    loose.extend(first..points.len() as u32);
    let tets = advance::advance(points, &wide.faces, &loose);
    filling.replace(wide, tets);
}

/// The cavity, and wider and wider ones around it.
fn rings(filling: &Filling, cavity: &Cavity) -> Vec<Cavity> {
    let mut rings = vec![cavity.clone()];
    for k in 0..WIDENINGS {
        let wider = filling.widened(&rings[k]);
        rings.push(wider);
    }
    rings
}

fn unfilled(points: &[DVec3], cavity: &Cavity) -> Error {
    let corners = filling::vertices(&cavity.faces);
    let middle = corners.iter().map(|&v| points[v as usize]).sum::<DVec3>() / corners.len().max(1) as f64;
    MeshDefect::Tetrahedralisation(format!(
        "the part with {} faces around ({:.4}, {:.4}, {:.4}) could not be filled; larger distances between its \
         surfaces or rounder triangles there would help",
        cavity.faces.len(),
        middle.x,
        middle.y,
        middle.z
    ))
    .into()
}

/// Takes out the interior points whose surroundings can be filled without them.
fn remove_interior_points(points: &[DVec3], filling: &mut Filling, first: usize) {
    for vertex in (first as u32..points.len() as u32).rev() {
        let star = filling.star(vertex);
        let rings = [star.clone(), filling.widened(&star)];
        let searched = rings.iter().find_map(|r| Some((r, search::search(points, &r.faces)?)));
        if let Some((ring, tets)) = searched {
            filling.replace(ring, tets);
        }
    }
}

/// The result, with the interior points that are in use numbered anew.
fn numbered(points: &[DVec3], mut tetrahedra: Vec<Tet>, first: usize) -> Tetrahedra {
    let used = filling::distinct(tetrahedra.iter().flatten().copied().filter(|&v| v as usize >= first));
    let number = |v: u32| used.binary_search(&v).map_or(v, |rank| (first + rank) as u32);
    tetrahedra.iter_mut().flatten().for_each(|v| *v = number(*v));
    let kept = points[..first].iter().chain(used.iter().map(|&v| &points[v as usize]));
    // Exact: every point came from an f32 one.
    Tetrahedra { points: kept.map(|p| p.as_vec3()).collect(), tetrahedra, interior_points: used.len() }
}
