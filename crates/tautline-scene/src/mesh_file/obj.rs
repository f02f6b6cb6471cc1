//! Wavefront OBJ: the vertices `v` and faces `f`; everything else (normals, texture coordinates, groups,
//! materials, curves) says nothing about a solid and is passed over.

use std::num::NonZeroI64;

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::{Defect, coordinate, polygon};

/// Reads the text of a file. Vertices that no face uses are left out; faces of more than three corners are
/// divided.
pub(super) fn parse(text: &str) -> Result<TriMesh, Defect> {
    let mut mesh = TriMesh::default();
    // A face may come before its vertices, so all of them are read first.
    for (number, mut words) in lines(text) {
        if words.next() == Some("v") {
            mesh.positions.push(vertex(words).ok_or_else(|| {
                Defect::at(number, "a vertex needs three coordinates, each a finite number")
            })?);
        }
    }
    let mut preceding = 0;
    for (number, mut words) in lines(text) {
        match words.next() {
            Some("v") => preceding += 1,
            Some("f") => {
                let corners = words.map(|word| corner(word, preceding, mesh.positions.len()));
                let corners: Vec<u32> =
                    corners.collect::<Result<_, _>>().map_err(|message| Defect::at(number, message))?;
                let triangles = polygon::triangulate(&mesh.positions, &corners);
                mesh.triangles.extend(triangles.map_err(|message| Defect::at(number, message))?);
            }
            _ => {}
        }
    }
    if mesh.triangles.is_empty() {
        return Err(Defect::new("it has no faces"));
    }
    Ok(without_unused(mesh))
}

/// The lines with their numbers, as words, without comments.
fn lines(text: &str) -> impl Iterator<Item = (usize, impl Iterator<Item = &str>)> {
    text.lines().zip(1..).map(|(line, number)| {
        let content = line.split_once('#').map_or(line, |(content, _)| content);
        (number, content.split_whitespace())
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
    let number: NonZeroI64 = vertex
        .parse()
        .map_err(|_| format!("{word:?} is not a corner: the first vertex is 1, the last -1"))?;
    let number = number.get();
    let index = if number > 0 { number.checked_sub(1) } else { number.checked_add(preceding as i64) };
    let index = index.and_then(|index| usize::try_from(index).ok()).filter(|&index| index < count);
    let index = index.and_then(|index| u32::try_from(index).ok());
    index.ok_or_else(|| format!("{word:?} names vertex {number}, but there are only {count}"))
}

/// Leaves out the vertices of no triangle and keeps the order of the others.
fn without_unused(mesh: TriMesh) -> TriMesh {
    let mut used = vec![false; mesh.positions.len()];
    for &vertex in mesh.triangles.as_flattened() {
        used[vertex as usize] = true;
    }
    let mut renumbered = vec![0; mesh.positions.len()];
    let mut positions = Vec::new();
    for (vertex, position) in mesh.positions.into_iter().enumerate().filter(|&(vertex, _)| used[vertex]) {
        renumbered[vertex] = positions.len() as u32;
        positions.push(position);
    }
    let triangles =
        mesh.triangles.into_iter().map(|triangle| triangle.map(|v| renumbered[v as usize])).collect();
    TriMesh { positions, triangles }
}
