//! Wavefront OBJ: the vertices `v` and faces `f`. Normals, texture coordinates and groups say nothing about a solid;
//! materials, lines, points, curves and what is unknown are noted.

use std::num::NonZeroI64;

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::notes::Notes;
use super::polygon::Divider;
use super::refusal::quoted;
use super::words::coordinate;
use super::{Limits, MeshFile, Refusal};

/// Reads the text of a file. Faces of more than three corners are divided.
pub(super) fn parse(text: &str, limits: &Limits) -> Result<MeshFile, Refusal> {
    let counts = Counts::of(text);
    limits.check_vertices(counts.vertices)?;
    limits.check_triangles(counts.triangles)?;
    // A face may come before its vertices, so all of them are read first.
    let positions = read_vertices(text, counts.vertices)?;
    let triangles = read_faces(text, &positions, counts.triangles)?;
    if triangles.is_empty() {
        let what = if positions.is_empty() { "no faces and no vertices: is it OBJ?" } else { "no faces" };
        return Err(Refusal::new(format!("it has {what}")));
    }
    Ok(MeshFile { mesh: TriMesh { positions, triangles }, notes: counts.notes.into_vec() })
}

/// What a text holds, so that memory is taken once and not by guessing.
#[derive(Default)]
struct Counts {
    vertices: usize,
    triangles: usize,
    notes: Notes,
}

impl Counts {
    fn of(text: &str) -> Self {
        let mut counts = Self::default();
        for (_, mut words) in lines(text) {
            match words.next() {
                Some("v") => counts.vertices += 1,
                Some("f") => counts.triangles += words.count().saturating_sub(2),
                None | Some("vn" | "vt" | "g" | "o" | "s") => {}
                Some("usemtl" | "mtllib") => counts.notes.add("lines about materials", 1),
                Some("l") => counts.notes.add("polylines", 1),
                Some("p") => counts.notes.add("points", 1),
                Some(other) => {
                    counts.notes.add(&format!("lines that begin with {}", quoted(other)), 1);
                }
            }
        }
        counts
    }
}

fn read_vertices(text: &str, count: usize) -> Result<Vec<Vec3>, Refusal> {
    let mut positions = Vec::with_capacity(count);
    for (number, mut words) in lines(text) {
        if words.next() == Some("v") {
            let message = "a vertex needs three coordinates, each a finite number";
            positions.push(vertex(words).ok_or_else(|| Refusal::at_line(number, message))?);
        }
    }
    Ok(positions)
}

fn read_faces(text: &str, positions: &[Vec3], count: usize) -> Result<Vec<[u32; 3]>, Refusal> {
    let (mut triangles, mut corners) = (Vec::with_capacity(count), Vec::new());
    let mut divider = Divider::new();
    let mut preceding = 0;
    for (number, mut words) in lines(text) {
        match words.next() {
            Some("v") => preceding += 1,
            Some("f") => {
                let refuse = |message| Refusal::at_line(number, message);
                corners.clear();
                corners.reserve_exact(words.clone().count());
                for word in words {
                    corners.push(corner(word, preceding, positions.len()).map_err(refuse)?);
                }
                divider.divide(positions, &corners, &mut triangles).map_err(refuse)?;
            }
            _ => {}
        }
    }
    Ok(triangles)
}

/// The lines with their numbers, as words, without comments.
fn lines(text: &str) -> impl Iterator<Item = (usize, impl Iterator<Item = &str> + Clone)> {
    text.lines().zip(1..).map(|(line, number)| {
        let content = line.split_once('#').map_or(line, |(content, _)| content);
        (number, content.split_ascii_whitespace())
    })
}

fn vertex<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<Vec3> {
    let mut next = || words.next().and_then(coordinate);
    Some(Vec3::new(next()?, next()?, next()?))
}

/// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0; negative numbers count back from
/// the last vertex before the face.
fn corner(word: &str, preceding: usize, count: usize) -> Result<u32, String> {
    let vertex = word.split('/').next().unwrap_or_default();
    if word.ends_with('\\') {
        return Err("a face that goes on in the next line: write it in one".to_owned());
    }
    let number: NonZeroI64 = vertex
        .parse()
        .map_err(|_| format!("{} is not a corner: the first vertex is 1, the last -1", quoted(word)))?;
    let number = number.get();
    let index = if number > 0 { number.checked_sub(1) } else { number.checked_add(preceding as i64) };
    let index = index.and_then(|index| usize::try_from(index).ok()).filter(|&index| index < count);
    let index = index.and_then(|index| u32::try_from(index).ok());
    index.ok_or_else(|| format!("{} names vertex {number}, but there are only {count}", quoted(word)))
}
