//! STL, text and binary. Its triangles share nothing: corners at the same place become one vertex.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::{Defect, coordinate};

/// Bytes before the triangles of a binary file: a comment of 80 and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three corners, two bytes of attributes.
const FACET: usize = 50;

/// Reads the bytes of a file. The normals are passed over: the order of the corners says the same.
pub(super) fn parse(bytes: &[u8]) -> Result<TriMesh, Defect> {
    let mut weld = Weld::default();
    // Some binary files begin with `solid` too, so their length decides.
    if binary_length(bytes) == Some(bytes.len()) {
        read_binary(&bytes[HEADER..], &mut weld)?;
    } else if bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        read_text(&String::from_utf8_lossy(bytes), &mut weld)?;
    } else {
        return Err(Defect::new(match binary_length(bytes) {
            Some(length) => format!("it announces {length} bytes of binary STL and has {}", bytes.len()),
            None => "it is neither text that begins with `solid` nor long enough for binary STL".to_owned(),
        }));
    }
    if weld.mesh.triangles.is_empty() {
        return Err(Defect::new("it has no triangles"));
    }
    Ok(weld.mesh)
}

/// How long a binary file with this header is.
fn binary_length(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?.first_chunk::<4>()?;
    (u32::from_le_bytes(*count) as usize).checked_mul(FACET)?.checked_add(HEADER)
}

fn read_binary(facets: &[u8], weld: &mut Weld) -> Result<(), Defect> {
    for (i, facet) in facets.chunks_exact(FACET).enumerate() {
        let mut numbers = [0.0; 12];
        for (number, bytes) in numbers.iter_mut().zip(facet.as_chunks::<4>().0) {
            *number = f32::from_le_bytes(*bytes);
        }
        let [.., x0, y0, z0, x1, y1, z1, x2, y2, z2] = numbers;
        let corners = [Vec3::new(x0, y0, z0), Vec3::new(x1, y1, z1), Vec3::new(x2, y2, z2)];
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Err(Defect::new(format!("triangle {i} has a coordinate that is not finite")));
        }
        weld.push(corners);
    }
    Ok(())
}

/// Any number of `solid … endsolid`, one after another.
fn read_text(text: &str, weld: &mut Weld) -> Result<(), Defect> {
    let mut words = Words::new(text);
    while words.peek().is_some() {
        words.expect("solid")?;
        words.skip_line();
        while !words.peek().is_some_and(|word| word.eq_ignore_ascii_case("endsolid")) {
            weld.push(read_facet(&mut words)?);
        }
        words.expect("endsolid")?;
        words.skip_line();
    }
    Ok(())
}

fn read_facet(words: &mut Words) -> Result<[Vec3; 3], Defect> {
    words.expect("facet")?;
    // A normal may be anything, even NaN.
    words.skip_line();
    words.expect("outer")?;
    words.expect("loop")?;
    let mut corners = [Vec3::ZERO; 3];
    for corner in &mut corners {
        words.expect("vertex")?;
        *corner = Vec3::new(words.number()?, words.number()?, words.number()?);
    }
    words.expect("endloop")?;
    words.expect("endfacet")?;
    Ok(corners)
}

/// The words of a text, and the line of the next.
struct Words<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::iter::Peekable<std::str::SplitWhitespace<'a>>,
    line: usize,
}

impl<'a> Words<'a> {
    fn new(text: &'a str) -> Self {
        Self { lines: text.lines().enumerate(), words: "".split_whitespace().peekable(), line: 0 }
    }

    fn peek(&mut self) -> Option<&'a str> {
        while self.words.peek().is_none() {
            let (i, line) = self.lines.next()?;
            self.line = i + 1;
            self.words = line.split_whitespace().peekable();
        }
        self.words.peek().copied()
    }

    fn next(&mut self) -> Option<&'a str> {
        self.peek()?;
        self.words.next()
    }

    fn skip_line(&mut self) {
        self.words = "".split_whitespace().peekable();
    }

    fn expect(&mut self, keyword: &str) -> Result<(), Defect> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
            found => Err(self.unexpected(found, &format!("`{keyword}`"))),
        }
    }

    fn number(&mut self) -> Result<f32, Defect> {
        let found = self.next();
        found.and_then(coordinate).ok_or_else(|| self.unexpected(found, "a coordinate, a finite number"))
    }

    fn unexpected(&self, found: Option<&str>, expected: &str) -> Defect {
        match found {
            Some(word) => Defect::at(self.line, format!("{word:?} is not {expected}")),
            None => Defect::at(self.line, format!("the file ends where {expected} should be")),
        }
    }
}

/// Triangles whose corners become one vertex where they are equal to the bit, −0 being 0.
#[derive(Default)]
struct Weld {
    mesh: TriMesh,
    vertices: BTreeMap<[u32; 3], u32>,
}

impl Weld {
    fn push(&mut self, corners: [Vec3; 3]) {
        let triangle = corners.map(|corner| {
            // −0 + 0 is +0.
            let corner = corner + Vec3::ZERO;
            match self.vertices.entry(corner.to_array().map(f32::to_bits)) {
                Entry::Occupied(vertex) => *vertex.get(),
                Entry::Vacant(place) => {
                    self.mesh.positions.push(corner);
                    *place.insert(self.mesh.positions.len() as u32 - 1)
                }
            }
        });
        self.mesh.triangles.push(triangle);
    }
}
