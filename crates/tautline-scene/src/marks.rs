//! A mesh to look at, with its defects marked.

use tautline::Vec3;
use tautline::mesh::doctor::{Defect, Report};
use tautline::mesh::{TriMesh, primitives};

use crate::recording::{Motion, Recording, Surface, Track};

/// Of what is sound.
const SOUND: [u8; 3] = [186, 192, 200];
/// Of open edges.
const OPEN: [u8; 3] = [236, 140, 30];
/// Of edges of too many triangles, and of vertices where surfaces meet in a point.
const TOO_MANY: [u8; 3] = [150, 60, 190];
/// Of triangles that are wrong by themselves or face the wrong way.
const WRONG: [u8; 3] = [40, 110, 220];
/// Of triangles that cross.
const CROSSING: [u8; 3] = [214, 48, 49];

/// The width of a marked edge and of a marked place, as shares of the mesh's diagonal.
const EDGE: f32 = 0.003;
const PLACE: f32 = 0.006;
/// Places that are marked by a ball each; of more, a picture shows nothing more.
const MOST_BALLS: usize = 400;

/// What the colours of [`marked`] mean.
pub const LEGEND: &str = "orange: open edges; purple: non-manifold edges and bow-ties; \
    blue: flipped, degenerate or duplicate triangles; red: triangles that cross";

/// One picture of a mesh, a metre in size: edges and triangles that are wrong in colour, and a ball at what is too small to
/// be seen.
pub fn marked(mesh: &TriMesh, report: &Report) -> Recording {
    let (original, mesh) = (mesh, fitted(mesh));
    let mut color_of = vec![SOUND; mesh.triangles.len()];
    let mut marks: Vec<([u8; 3], TriMesh)> =
        [OPEN, TOO_MANY, WRONG, CROSSING].map(|color| (color, TriMesh::default())).into();
    let mut balls = 0;
    for defect in &report.defects {
        let Some(color) = color(defect) else { continue };
        let Some((_, drawn)) = marks.iter_mut().find(|(known, _)| *known == color) else { continue };
        let triangles = triangles(defect);
        triangles.iter().for_each(|&triangle| color_of[triangle as usize] = color);
        for [a, b] in edges(defect) {
            add_edge(drawn, mesh.positions[a as usize], mesh.positions[b as usize]);
        }
        let is_small = !matches!(defect, Defect::Open { .. }) && extent(&mesh, defect) < 8.0 * PLACE;
        if is_small && balls < MOST_BALLS {
            balls += 1;
            add_ball(drawn, defect.place(&mesh));
        }
    }
    for color in [SOUND, WRONG, CROSSING] {
        let of_color = mesh.triangles.iter().zip(&color_of).filter(|&(_, known)| *known == color);
        let mut triangles: Vec<[u32; 3]> = of_color
            .map(|(&triangle, _)| triangle)
            .filter(|&triangle| is_drawn(original, triangle))
            .collect();
        // Pictures show the outside of solids; what is open is seen from both sides.
        if !report.is_clean() {
            triangles.extend_from_within(..);
            let count = triangles.len() / 2;
            triangles[count..].iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let drawn = TriMesh { positions: mesh.positions.clone(), triangles };
        marks.push((color, drawn));
    }
    let tracks = marks.into_iter().filter(|(_, mesh)| !mesh.triangles.is_empty()).enumerate().map(
        |(i, (color, mesh))| Track {
            name: format!("{i}"),
            color,
            surface: Surface::Solid,
            mesh,
            motion: Motion::Still,
        },
    );
    Recording { name: "defects".into(), frame_rate: 1.0, tracks: tracks.collect() }
}

fn color(defect: &Defect) -> Option<[u8; 3]> {
    match defect {
        Defect::Open { .. } => Some(OPEN),
        Defect::NonManifoldEdge { .. } | Defect::OneSided { .. } | Defect::BowTie { .. } => Some(TOO_MANY),
        Defect::Flipped { .. } | Defect::Degenerate { .. } | Defect::Duplicate { .. } => Some(WRONG),
        Defect::Crossing { .. } => Some(CROSSING),
        _ => None,
    }
}

fn triangles(defect: &Defect) -> Vec<u32> {
    match defect {
        Defect::Flipped { triangle } | Defect::Degenerate { triangle } => vec![*triangle],
        Defect::Duplicate { triangle, first } => vec![*triangle, *first],
        Defect::Crossing { triangles } => triangles.to_vec(),
        _ => Vec::new(),
    }
}

fn edges(defect: &Defect) -> Vec<[u32; 2]> {
    match defect {
        Defect::Open { vertices, is_loop } => {
            let count = if *is_loop { vertices.len() } else { vertices.len().saturating_sub(1) };
            (0..count).map(|i| [vertices[i], vertices[(i + 1) % vertices.len()]]).collect()
        }
        Defect::NonManifoldEdge { edge, .. } | Defect::OneSided { edge } => vec![*edge],
        _ => Vec::new(),
    }
}

/// The mesh about the origin, with a diagonal of 1 m. What is not finite is at the origin, and not drawn.
fn fitted(mesh: &TriMesh) -> TriMesh {
    let used = mesh.triangles.as_flattened().iter().filter_map(|&v| mesh.positions.get(v as usize));
    let finite = used.filter(|position| position.is_finite()).map(|position| position.as_dvec3());
    let nothing = (tautline::DVec3::INFINITY, tautline::DVec3::NEG_INFINITY);
    let (low, high) = finite.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    let (middle, diagonal) = ((low + high) / 2.0, low.distance(high));
    let scale = if diagonal > 0.0 && diagonal.is_finite() { 1.0 / diagonal } else { 1.0 };
    let fit = |position: &Vec3| ((position.as_dvec3() - middle) * scale).as_vec3();
    let positions = mesh.positions.iter().map(fit).map(|p| if p.is_finite() { p } else { Vec3::ZERO });
    TriMesh { positions: positions.collect(), triangles: mesh.triangles.clone() }
}

/// Whether the corners of a triangle are there and finite.
fn is_drawn(mesh: &TriMesh, triangle: [u32; 3]) -> bool {
    triangle
        .iter()
        .all(|&vertex| mesh.positions.get(vertex as usize).is_some_and(|position| position.is_finite()))
}

/// The diagonal of the box around a defect.
fn extent(mesh: &TriMesh, defect: &Defect) -> f32 {
    let vertices = defect.vertices(mesh);
    let points = vertices.iter().map(|&vertex| mesh.positions[vertex as usize]);
    let (low, high) =
        points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    if low.x <= high.x { low.distance(high) } else { 0.0 }
}

/// A bar of four sides.
fn add_edge(mesh: &mut TriMesh, from: Vec3, to: Vec3) {
    let along = (to - from).normalize_or_zero();
    let u = along.any_orthonormal_vector() * EDGE;
    let v = along.cross(u);
    let first = mesh.positions.len() as u32;
    // A little longer than the edge, so that bars meet at corners.
    let (from, to) = (from - along * EDGE / 2.0, to + along * EDGE / 2.0);
    for end in [from, to] {
        mesh.positions.extend([end + u, end + v, end - u, end - v]);
    }
    for k in 0..4 {
        let [a, b] = [k, (k + 1) % 4];
        mesh.triangles.extend([[a, b, b + 4], [a, b + 4, a + 4]].map(|triangle| triangle.map(|i| i + first)));
    }
}

fn add_ball(mesh: &mut TriMesh, middle: Vec3) {
    let Ok(ball) = primitives::icosphere(PLACE, 1) else { return };
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(ball.positions.iter().map(|&position| position + middle));
    mesh.triangles.extend(ball.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
}
