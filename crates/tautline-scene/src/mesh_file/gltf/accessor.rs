//! Numbers in buffers, found through accessors and views (glTF 2.0, sections 3.6.2 and 5.1). Every range is checked
//! before anything is read.

use tautline::Vec3;

use super::super::Refusal;
use super::buffer::Buffers;
use super::document::{Accessor, Document};

/// A document and its bytes.
pub(super) struct Data<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
}

/// Equal elements at equal distances.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

/// Places.
pub(super) struct Positions<'a> {
    pub(super) count: usize,
    elements: Elements<'a>,
}

/// Numbers of vertices.
pub(super) struct Indices<'a> {
    pub(super) count: usize,
    elements: Elements<'a>,
    vertices: usize,
    field: String,
}

const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

impl Data<'_> {
    /// The positions of an accessor that `field` names.
    pub(super) fn positions(&self, accessor: u32, field: &str) -> Result<Positions<'_>, Refusal> {
        let (accessor, field) = self.accessor(accessor, field)?;
        if accessor.shape != "VEC3" || accessor.component_type != F32 {
            return Err(Refusal::at_field(field, "positions are VEC3 of componentType 5126 (floats)"));
        }
        let elements = self.elements(accessor, 12, &field)?;
        Ok(Positions { count: accessor.count as usize, elements })
    }

    /// The indices of an accessor that `field` names, of so many vertices.
    pub(super) fn indices(
        &self,
        accessor: u32,
        field: &str,
        vertices: usize,
    ) -> Result<Indices<'_>, Refusal> {
        let (accessor, field) = self.accessor(accessor, field)?;
        let size = match accessor.component_type {
            U8 => 1,
            U16 => 2,
            U32 => 4,
            _ => 0,
        };
        if accessor.shape != "SCALAR" || size == 0 {
            let message = "indices are SCALAR of componentType 5121, 5123 or 5125 (whole numbers)";
            return Err(Refusal::at_field(field, message));
        }
        let elements = self.elements(accessor, size, &field)?;
        Ok(Indices { count: accessor.count as usize, elements, vertices, field })
    }

    fn accessor(&self, number: u32, field: &str) -> Result<(&Accessor, String), Refusal> {
        let accessors = &self.document.accessors;
        let accessor = accessors.get(number as usize).ok_or_else(|| {
            Refusal::at_field(field, format!("accessor {number}, but there are only {}", accessors.len()))
        })?;
        let field = format!("accessors[{number}]");
        if accessor.sparse.is_some() {
            return Err(Refusal::at_field(
                field + ".sparse",
                "sparse numbers are not read: export without them",
            ));
        }
        Ok((accessor, field))
    }

    /// The elements of an accessor, once they are known to lie in its view and that in its buffer.
    fn elements(&self, accessor: &Accessor, size: usize, field: &str) -> Result<Elements<'_>, Refusal> {
        let refuse = |what: &str| Refusal::at_field(field, what);
        let number = accessor.buffer_view.ok_or_else(|| refuse("it has no bufferView"))?;
        let views = &self.document.buffer_views;
        let view = views
            .get(number as usize)
            .ok_or_else(|| refuse(&format!("bufferView {number}, but there are only {}", views.len())))?;
        let buffer = self.buffers.get(view.buffer).ok_or_else(|| {
            Refusal::at_field(
                format!("bufferViews[{number}].buffer"),
                format!("there is no buffer {}", view.buffer),
            )
        })?;
        let view_bytes = range(buffer, view.byte_offset, view.byte_length).ok_or_else(|| {
            Refusal::at_field(format!("bufferViews[{number}]"), "it reaches beyond the end of its buffer")
        })?;
        let stride = view.byte_stride.unwrap_or(size as u64);
        if stride < size as u64 {
            let message = format!("{stride} is less than the {size} bytes of an element");
            return Err(Refusal::at_field(format!("bufferViews[{number}].byteStride"), message));
        }
        let length = match accessor.count {
            0 => Some(0),
            count => (count - 1).checked_mul(stride).and_then(|before| before.checked_add(size as u64)),
        };
        let bytes = length.and_then(|length| range(view_bytes, accessor.byte_offset, length));
        let bytes = bytes.ok_or_else(|| refuse("it reaches beyond the end of its bufferView"))?;
        // A stride beyond usize leaves room for one element only, whose place does not depend on it.
        Ok(Elements { bytes, stride: usize::try_from(stride).unwrap_or(0), size })
    }
}

fn range(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    bytes.get(usize::try_from(offset).ok()?..)?.get(..usize::try_from(length).ok()?)
}

impl Elements<'_> {
    /// The bytes of an element that is there.
    fn at(&self, i: usize) -> &[u8] {
        let start = i * self.stride;
        self.bytes.get(start..start + self.size).unwrap_or_default()
    }
}

impl Positions<'_> {
    /// The i-th place, which may not be finite.
    pub(super) fn at(&self, i: usize) -> Vec3 {
        let mut place = [0.0; 3];
        for (coordinate, bytes) in place.iter_mut().zip(self.elements.at(i).as_chunks::<4>().0) {
            *coordinate = f32::from_le_bytes(*bytes);
        }
        place.into()
    }
}

impl Indices<'_> {
    /// The i-th number, which is that of a vertex.
    pub(super) fn at(&self, i: usize) -> Result<u32, Refusal> {
        let mut bytes = [0; 4];
        let element = self.elements.at(i);
        bytes[..element.len()].copy_from_slice(element);
        let index = u32::from_le_bytes(bytes);
        if (index as usize) < self.vertices {
            return Ok(index);
        }
        let message = format!("it names vertex {index}, but there are only {}", self.vertices);
        Err(Refusal::at_field(&*self.field, message))
    }
}
