//! STL, text and binary. Its triangles share nothing: corners at the same place become one vertex.

use std::io::{self, Read};

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::words::Words;
use super::{Limits, MeshFile, Refusal, disguise, weld};

/// Bytes before the triangles of a binary file: a comment of 80 and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three corners, two bytes of attributes.
const FACET: usize = 50;

/// Least bytes of a facet as text: `facet`, `outer loop`, three times `vertex 0 0 0`, `endloop`, `endfacet`.
const LEAST_TEXT: usize = 76;

/// Reads the bytes of a file. The normals are passed over: the order of the corners says the same.
pub(super) fn parse(bytes: &[u8], limits: &Limits) -> Result<MeshFile, Refusal> {
    // Some binary files begin with `solid` too, so their length decides.
    if binary_length(bytes) == Some(bytes.len() as u64) {
        welded(read_binary(&bytes[HEADER..], bytes.len() as u64, limits)?)
    } else {
        parse_text(bytes, limits)
    }
}

/// Reads a file of so many bytes. Those of a binary one go by, and need no memory.
pub(super) fn read(mut file: impl Read, length: u64, limits: &Limits) -> Result<MeshFile, Refusal> {
    let mut bytes = Vec::new();
    file.by_ref().take(HEADER as u64).read_to_end(&mut bytes).map_err(unreadable)?;
    if binary_length(&bytes) == Some(length) {
        welded(read_binary(file, length, limits)?)
    } else {
        bytes.reserve_exact((length as usize).saturating_sub(bytes.len()));
        file.take(limits.file_bytes).read_to_end(&mut bytes).map_err(unreadable)?;
        parse_text(&bytes, limits).map_err(|refusal| disguise::explain(&bytes, refusal))
    }
}

fn unreadable(error: io::Error) -> Refusal {
    Refusal::new(format!("it cannot be read to its end: {error}"))
}

fn parse_text(bytes: &[u8], limits: &Limits) -> Result<MeshFile, Refusal> {
    let text = disguise::without_mark(bytes);
    if text.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        return welded(read_text(&String::from_utf8_lossy(text), limits)?);
    }
    Err(Refusal::new(match binary_length(bytes) {
        Some(length) => format!(
            "it announces {length} bytes of binary STL and has {}: it was cut off, or is no STL",
            bytes.len()
        ),
        None => "it is neither text that begins with `solid` nor long enough for binary STL".to_owned(),
    }))
}

fn welded(corners: Vec<Vec3>) -> Result<MeshFile, Refusal> {
    if corners.is_empty() {
        return Err(Refusal::new("it has no triangles"));
    }
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = weld::weld(TriMesh { positions: corners, triangles });
    Ok(MeshFile { mesh, notes: Vec::new() })
}

/// How long a binary file with this header is.
fn binary_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?.first_chunk::<4>()?;
    Some(HEADER as u64 + u64::from(u32::from_le_bytes(*count)) * FACET as u64)
}

/// The corners of what follows the header of a file of so many bytes.
fn read_binary(mut facets: impl Read, length: u64, limits: &Limits) -> Result<Vec<Vec3>, Refusal> {
    let count = (length as usize - HEADER) / FACET;
    limits.check_triangles(count)?;
    let mut corners = Vec::with_capacity(count * 3);
    for i in 0..count {
        let mut facet = [0; FACET];
        facets.read_exact(&mut facet).map_err(unreadable)?;
        let mut numbers = [0.0; 12];
        for (number, bytes) in numbers.iter_mut().zip(facet.as_chunks::<4>().0) {
            *number = f32::from_le_bytes(*bytes);
        }
        let [.., x0, y0, z0, x1, y1, z1, x2, y2, z2] = numbers;
        let facet = [Vec3::new(x0, y0, z0), Vec3::new(x1, y1, z1), Vec3::new(x2, y2, z2)];
        if !facet.iter().all(|corner| corner.is_finite()) {
            let message = format!("triangle {i} has a coordinate that is not finite");
            return Err(Refusal::at_byte(HEADER + i * FACET, message));
        }
        corners.extend(facet);
    }
    Ok(corners)
}

/// Any number of `solid … endsolid`, one after another.
fn read_text(text: &str, limits: &Limits) -> Result<Vec<Vec3>, Refusal> {
    let mut words = Words::new(text, 1);
    let mut corners = Vec::with_capacity((text.len() / LEAST_TEXT).min(limits.triangles) * 3);
    while words.peek().is_some() {
        words.keyword("solid")?;
        words.skip_line();
        while !words.peek().is_some_and(|word| word.eq_ignore_ascii_case("endsolid")) {
            corners.extend(read_facet(&mut words)?);
            limits.check_triangles(corners.len() / 3)?;
        }
        words.keyword("endsolid")?;
        words.skip_line();
    }
    Ok(corners)
}

fn read_facet(words: &mut Words) -> Result<[Vec3; 3], Refusal> {
    words.keyword("facet")?;
    // A normal may be anything, even NaN.
    words.skip_line();
    words.keyword("outer")?;
    words.keyword("loop")?;
    let mut corners = [Vec3::ZERO; 3];
    for corner in &mut corners {
        words.keyword("vertex")?;
        *corner = Vec3::new(words.coordinate()?, words.coordinate()?, words.coordinate()?);
    }
    words.keyword("endloop")?;
    words.keyword("endfacet")?;
    Ok(corners)
}
