//! Dividing the inside of a closed surface into tetrahedra that keep the surface as it is: the paper's
//! "restricted 3D triangulation" (section 4), whose edges become the sticks of a rigid body.
//!
//! The vertices' Delaunay triangulation is made first, and what of it lies inside and respects the
//! surface is kept. The rest is empty cavities, bounded by triangles; they are filled by an advancing
//! front, then by exhaustive search in small neighbourhoods, and where that fails by an interior point
//! (Schönhardt's polyhedron needs one; no algorithm can do without). Interior points that turn out
//! unnecessary are removed again. All decisions are exact, so a result is always valid.

mod advance;
mod boxes;
mod conforming;
mod delaunay;
mod filling;
mod predicates;
mod quality;
mod search;
mod steiner;
mod surface;

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};

use super::TriMesh;
use crate::{Error, MeshDefect};
use filling::{Cavity, Filling};
use predicates::Face;

/// The inside of a closed surface as tetrahedra.
#[derive(Debug, Clone, PartialEq)]
pub struct Tetrahedra {
    /// The surface's vertices in their order, then the interior points; in m.
    pub points: Vec<Vec3>,
    /// Four indices into `points` each; the first three run counter-clockwise seen from the fourth.
    pub tetrahedra: Vec<[u32; 4]>,
    /// How many points at the end of `points` were added inside. 0 wherever that was found possible.
    pub interior_points: usize,
}

/// How often a cavity is widened by the tetrahedra around it before an interior point is accepted.
const WIDENINGS: usize = 4;
/// How often points are seeded before the mesh is refused.
const MAX_SEEDINGS: usize = 40;

/// Divides the inside of a closed mesh into tetrahedra. No vertex of the surface is moved or added, and
/// every triangle is a face of exactly one tetrahedron. The same mesh gives the same result to the bit.
///
/// # Errors
///
/// [`Error::Mesh`] with the first defect found: the mesh is empty, open, turned inside out or
/// degenerate; has unused or coincident vertices; crosses or touches itself (the message names the two
/// triangles); or no division was found.
pub fn tetrahedralise(mesh: &TriMesh) -> Result<Tetrahedra, Error> {
    let (mut points, surface) = surface::checked(mesh)?;
    let delaunay = delaunay::delaunay(&points).ok_or(MeshDefect::Flat { count: points.len() })?;
    let mut filling = Filling::new(&surface);
    for tet in conforming::conforming(&points, &surface, &delaunay) {
        filling.place(tet);
    }
    for tet in advance::advance(&points, filling.front(), &[]) {
        filling.place(tet);
    }
    fill_cavities(&mut points, &mut filling, &surface.into_iter().collect())?;
    let first_interior = mesh.positions.len();
    remove_interior_points(&mut points, &mut filling, first_interior);
    Ok(Tetrahedra {
        interior_points: points.len() - first_interior,
        tetrahedra: filling.tetrahedra(),
        points: points.iter().map(|p| p.as_vec3()).collect(), // exact: every point came from an f32 one
    })
}

/// Fills what the advancing front left, cavity by cavity: without a new point if possible, or with one;
/// else a wide neighbourhood is seeded with points and the front advances through it again.
fn fill_cavities(
    points: &mut Vec<DVec3>,
    filling: &mut Filling,
    surface: &BTreeSet<Face>,
) -> Result<(), Error> {
    let mut seedings = 0;
    while let Some(cavity) = filling.cavities(points).into_iter().min_by_key(|cavity| cavity.faces.len()) {
        let rings = rings(filling, &cavity);
        let searched = rings.iter().find_map(|r| Some((r.clone(), search::search(points, &r.faces)?)));
        if let Some((ring, tets)) = searched.or_else(|| steiner::star(points, filling, &cavity)) {
            filling.replace(&ring, tets);
            continue;
        }
        if seedings == MAX_SEEDINGS {
            return Err(unfilled(points, &cavity));
        }
        let ring = &rings[1 + seedings % 2];
        let first = points.len() as u32;
        let bare: Vec<Face> = cavity.faces.intersection(surface).copied().collect();
        steiner::seed(points, surface, &bare, [0.5, 0.3, 0.7, 0.1][seedings / 2 % 4]);
        let mut loose = filling.loose_vertices(ring);
        loose.extend(first..points.len() as u32);
        let tets = advance::advance(points, &ring.faces, &loose);
        filling.replace(ring, tets);
        seedings += 1;
    }
    Ok(())
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
fn remove_interior_points(points: &mut Vec<DVec3>, filling: &mut Filling, first: usize) {
    for vertex in (first..points.len()).rev() {
        let rings = rings(filling, &filling.star(vertex as u32));
        let found = rings.iter().take(2).find_map(|r| search::search(points, &r.faces).map(|t| (r, t)));
        if let Some((ring, tets)) = found {
            filling.replace(ring, tets);
            filling.forget_vertex(vertex as u32);
            points.remove(vertex);
        }
    }
}
