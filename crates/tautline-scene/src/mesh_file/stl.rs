//! STL, text and binary. Its triangles share nothing: corners at the same place become one vertex.

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::words::Words;
use super::{Limits, MeshFile, Refusal, weld};

/// Bytes before the triangles of a binary file: a comment of 80 and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three corners, two bytes of attributes.
const FACET: usize = 50;

/// Least bytes of a facet as text: `facet`, `outer loop`, three times `vertex 0 0 0`, `endloop`, `endfacet`.
const LEAST_TEXT: usize = 76;

/// Reads the bytes of a file. The normals are passed over: the order of the corners says the same.
pub(super) fn parse(bytes: &[u8], limits: &Limits) -> Result<MeshFile, Refusal> {
    // Some binary files begin with `solid` too, so their length decides.
    let corners = if binary_length(bytes) == Some(bytes.len()) {
        limits.check_triangles((bytes.len() - HEADER) / FACET)?;
        read_binary(&bytes[HEADER..])?
    } else if bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        read_text(&String::from_utf8_lossy(bytes), limits)?
    } else {
        return Err(Refusal::new(match binary_length(bytes) {
            Some(length) => format!("it announces {length} bytes of binary STL and has {}", bytes.len()),
            None => "it is neither text that begins with `solid` nor long enough for binary STL".to_owned(),
        }));
    };
    if corners.is_empty() {
        return Err(Refusal::new("it has no triangles"));
    }
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = weld::weld(TriMesh { positions: corners, triangles });
    Ok(MeshFile { mesh, notes: Vec::new() })
}

/// How long a binary file with this header is.
fn binary_length(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?.first_chunk::<4>()?;
    (u32::from_le_bytes(*count) as usize).checked_mul(FACET)?.checked_add(HEADER)
}

fn read_binary(facets: &[u8]) -> Result<Vec<Vec3>, Refusal> {
    let mut corners = Vec::with_capacity(facets.len() / FACET * 3);
    for (i, facet) in facets.chunks_exact(FACET).enumerate() {
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
