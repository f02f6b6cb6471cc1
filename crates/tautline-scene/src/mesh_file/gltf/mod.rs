//! glTF 2.0: the triangles of every mesh that its scene shows, where the nodes put them. Read by own types rather than
//! by a library's, whose objects can take a hundred times the memory of the text they are read from.
//!
//! Materials, images, animations, skins and shapes to morph into are noted and not read; nothing is fetched.

mod accessor;
mod base64;
mod buffer;
mod container;
mod document;
mod place;

use std::path::Path;

use tautline::Vec3;
use tautline::mesh::TriMesh;

use super::notes::Notes;
use super::weld::weld;
use super::{Limits, MeshFile, Refusal, limits};
use accessor::Data;
use buffer::Buffers;
use container::Parts;
use document::{Document, Primitive};
use place::{Instance, for_each_instance};

/// Reads the bytes of a file, JSON or binary. A buffer with a name is looked for in the folder.
pub(super) fn parse(bytes: &[u8], limits: &Limits, folder: Option<&Path>) -> Result<MeshFile, Refusal> {
    let Parts { json, binary } = container::parts(bytes)?;
    let document = document::parse(json)?;
    let buffers = Buffers::read(&document, binary, folder, limits)?;
    let mut assembly = Assembly {
        data: Data { document: &document, buffers: &buffers },
        limits,
        bytes: bytes.len() + buffers.bytes_outside(),
        mesh: TriMesh::default(),
        points_and_lines: 0,
    };
    for_each_instance(&document, limits, |instance| assembly.add(instance))?;
    if assembly.mesh.triangles.is_empty() {
        return Err(Refusal::new("it has no triangles in its scene"));
    }
    let mut notes = document.notes();
    notes.add("primitives of points or lines", assembly.points_and_lines);
    Ok(MeshFile { mesh: weld(assembly.mesh), notes: notes.into_vec() })
}

/// A mesh that grows.
struct Assembly<'a> {
    data: Data<'a>,
    limits: &'a Limits,
    /// Bytes of the file and its buffers.
    bytes: usize,
    mesh: TriMesh,
    points_and_lines: usize,
}

impl Assembly<'_> {
    fn add(&mut self, instance: &Instance) -> Result<(), Refusal> {
        let document = self.data.document;
        for (k, primitive) in document.meshes[instance.mesh].primitives.iter().enumerate() {
            let field = format!("meshes[{}].primitives[{k}]", instance.mesh);
            match primitive.mode {
                0..=3 => self.points_and_lines += 1,
                4..=6 => self.add_primitive(instance, primitive, &field)?,
                mode => return Err(Refusal::at_field(field + ".mode", format!("{mode} is no mode: 0 to 6"))),
            }
        }
        Ok(())
    }

    fn add_primitive(
        &mut self,
        instance: &Instance,
        primitive: &Primitive,
        field: &str,
    ) -> Result<(), Refusal> {
        let Some(positions) = primitive.attributes.position else {
            return Err(Refusal::at_field(format!("{field}.attributes"), "it has no POSITION"));
        };
        let positions = self.data.positions(positions, &format!("{field}.attributes.POSITION"))?;
        let indices = primitive
            .indices
            .map(|indices| self.data.indices(indices, &format!("{field}.indices"), positions.count))
            .transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let count = if primitive.mode == 4 { corners / 3 } else { corners.saturating_sub(2) };
        let (vertices, triangles) =
            (self.mesh.positions.len() + positions.count, self.mesh.triangles.len() + count);
        self.limits.check_vertices(vertices)?;
        self.limits.check_triangles(triangles)?;
        limits::check_growth(self.bytes, vertices + triangles)?;

        let first = self.mesh.positions.len() as u32;
        for i in 0..positions.count {
            self.mesh.positions.push(self.place(instance, positions.at(i), field)?);
        }
        for i in 0..count {
            let mut triangle = [0; 3];
            for (corner, place) in triangle.iter_mut().zip(corners_of(primitive.mode, i)) {
                *corner = first + indices.as_ref().map_or(Ok(place as u32), |indices| indices.at(place))?;
            }
            if instance.placement.is_mirrored() {
                triangle.swap(1, 2);
            }
            self.mesh.triangles.push(triangle);
        }
        Ok(())
    }

    fn place(&self, instance: &Instance, position: Vec3, field: &str) -> Result<Vec3, Refusal> {
        let placed = instance.placement.apply(position.as_dvec3()).as_vec3();
        if placed.is_finite() {
            return Ok(placed);
        }
        let message =
            format!("a coordinate that is not finite, or is not where node {} puts it", instance.node);
        Err(Refusal::at_field(format!("{field}.attributes.POSITION"), message))
    }
}

/// The corners of the i-th triangle of a list (mode 4), a strip (5) or a fan (6).
fn corners_of(mode: u32, i: usize) -> [usize; 3] {
    match mode {
        4 => [3 * i, 3 * i + 1, 3 * i + 2],
        // Every second triangle of a strip runs the other way round.
        5 => [i, i + 1 + i % 2, i + 2 - i % 2],
        _ => [i + 1, i + 2, 0],
    }
}

impl Document {
    /// What is passed over.
    fn notes(&self) -> Notes {
        let mut notes = Notes::default();
        notes.add("materials", self.materials.len());
        notes.add("images", self.images.len());
        notes.add("animations", self.animations.len());
        notes.add("skins", self.skins.len());
        let primitives = self.meshes.iter().flat_map(|mesh| &mesh.primitives);
        notes.add("shapes to morph into", primitives.map(|primitive| primitive.targets.len()).sum());
        notes
    }
}
