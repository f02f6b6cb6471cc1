//! PLY (Turk 1994, The PLY polygon file format), text and binary of either byte order: coordinates `x`, `y`, `z` of
//! the element `vertex` and lists `vertex_indices` or `vertex_index` of the element `face`. Colours, normals and the
//! like are passed over; other elements are noted.

mod binary;
mod header;
mod source;
mod text;

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::notes::Notes;
use super::polygon::Divider;
use super::refusal::quoted;
use super::{Limits, MeshFile, Refusal, limits};
use binary::Binary;
use header::{Element, Encoding, Header, Kind, Property};
use source::Source;
use text::Text;

/// Reads the bytes of a file.
pub(super) fn parse(bytes: &[u8], limits: &Limits) -> Result<MeshFile, Refusal> {
    let header = header::parse(bytes)?;
    match header.encoding {
        Encoding::Text => {
            let text = String::from_utf8_lossy(&bytes[header.length..]);
            read(&header, Text::new(&text, header.lines + 1), limits)
        }
        Encoding::LittleEndian => read(&header, Binary::new(bytes, header.length, false), limits),
        Encoding::BigEndian => read(&header, Binary::new(bytes, header.length, true), limits),
    }
}

/// The columns of the elements that matter.
struct Columns {
    vertices: usize,
    coordinates: [usize; 3],
    faces: usize,
    corners: usize,
}

/// Reads what follows the header. Twice: faces may come before the vertices, and are divided by their places; and so
/// their number is known before memory is taken for them.
fn read(header: &Header, body: impl Source + Clone, limits: &Limits) -> Result<MeshFile, Refusal> {
    let columns = Columns::of(header)?;
    limits.check_vertices(header.elements[columns.vertices].count)?;
    let (positions, count) = read_vertices(header, &columns, body.clone(), limits)?;
    limits::check_growth(body.remaining(), positions.len() + count)?;
    let triangles = read_faces(header, &columns, body, &positions, count)?;
    if triangles.is_empty() {
        return Err(Refusal::new("it has no faces"));
    }
    let mut notes = Notes::default();
    for (i, element) in header.elements.iter().enumerate() {
        if i != columns.vertices && i != columns.faces {
            notes.add(&format!("elements {}", quoted(&element.name)), element.count);
        }
    }
    Ok(MeshFile { mesh: TriMesh { positions, triangles }, notes: notes.into_vec() })
}

/// The places of the vertices, and how many triangles the faces will be.
fn read_vertices(
    header: &Header,
    columns: &Columns,
    mut body: impl Source,
    limits: &Limits,
) -> Result<(Vec<Vec3>, usize), Refusal> {
    let mut positions = Vec::new();
    let mut triangles = 0_usize;
    for (i, element) in header.elements.iter().enumerate() {
        body.check_room(element)?;
        if i == columns.vertices {
            positions.reserve_exact(element.count);
        }
        for _ in 0..element.repeats() {
            let mut position = Vec3::ZERO;
            for (k, property) in element.properties.iter().enumerate() {
                let axis = columns.coordinates.iter().position(|&column| column == k);
                match (axis.filter(|_| i == columns.vertices), property.list) {
                    (Some(axis), _) => position[axis] = body.coordinate(property.kind)?,
                    (None, None) => body.skip(property.kind, 1)?,
                    (None, Some(count)) => {
                        let length = body.length(count)?;
                        body.skip(property.kind, length)?;
                        let is_face = i == columns.faces && k == columns.corners;
                        triangles += if is_face { length.saturating_sub(2) } else { 0 };
                    }
                }
            }
            if i == columns.vertices {
                positions.push(position);
            }
        }
        limits.check_triangles(triangles)?;
    }
    Ok((positions, triangles))
}

fn read_faces(
    header: &Header,
    columns: &Columns,
    mut body: impl Source,
    positions: &[Vec3],
    count: usize,
) -> Result<Vec<[u32; 3]>, Refusal> {
    let (mut triangles, mut corners) = (Vec::with_capacity(count), Vec::new());
    let mut divider = Divider::new();
    for (i, element) in header.elements[..=columns.faces].iter().enumerate() {
        for _ in 0..element.repeats() {
            for (k, property) in element.properties.iter().enumerate() {
                let length = property.list.map_or(Ok(1), |count| body.length(count))?;
                if i != columns.faces || k != columns.corners {
                    body.skip(property.kind, length)?;
                    continue;
                }
                corners.clear();
                corners.reserve_exact(length);
                for _ in 0..length {
                    corners.push(index(&mut body, property.kind, positions.len())?);
                }
                let divided = divider.divide(positions, &corners, &mut triangles);
                divided.map_err(|message| body.refuse(message))?;
            }
        }
    }
    Ok(triangles)
}

fn index(body: &mut impl Source, kind: Kind, vertices: usize) -> Result<u32, Refusal> {
    let number = body.integer(kind)?;
    let index = u32::try_from(number).ok().filter(|&index| (index as usize) < vertices);
    index.ok_or_else(|| {
        body.refuse(format!("a face names vertex {number}, but there are only {vertices}, counted from 0"))
    })
}

impl Columns {
    fn of(header: &Header) -> Result<Self, Refusal> {
        let (vertices, vertex) = header.element("vertex")?;
        let (faces, face) = header.element("face").map_err(|refusal| {
            let hint = match header.element("tristrips") {
                Ok(_) => "triangle strips are not read, write them as faces",
                Err(_) => "points alone are no surface",
            };
            Refusal::new(format!("{}: {hint}", refusal.message))
        })?;
        let coordinate = |name: &str| {
            let found = vertex
                .properties
                .iter()
                .position(|property| property.name == name && property.list.is_none());
            found.ok_or_else(|| Refusal::new(format!("the element vertex has no property {name}, a number")))
        };
        let is_corners = |property: &Property| {
            property.list.is_some() && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
        };
        let corners = face.properties.iter().position(is_corners);
        Ok(Self {
            vertices,
            coordinates: [coordinate("x")?, coordinate("y")?, coordinate("z")?],
            faces,
            corners: corners
                .ok_or_else(|| Refusal::new("the element face has no property list vertex_indices"))?,
        })
    }
}

impl Element {
    /// How often there is something to read: an element without properties takes no room, whatever its count.
    fn repeats(&self) -> usize {
        if self.properties.is_empty() { 0 } else { self.count }
    }
}
