//! Numbers in a glTF buffer, and the container around them (glTF 2.0, sections 3.6 and 4.4).

use serde_json::{Value, json};
use tautline::{Quat, Vec3};

use crate::Error;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// What a list of vectors is for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Use {
    Vertex,
    Animation,
}

/// Bytes, the views into them and the accessors that give them a type. Everything is 4 bytes wide, so that
/// nothing needs padding.
#[derive(Default)]
pub(super) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds vectors, with their bounds, and returns the accessor.
    pub(super) fn vec3s(&mut self, values: &[Vec3], purpose: Use) -> usize {
        let (low, high) =
            values.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &v| (low.min(v), high.max(v)));
        let floats = values.iter().flat_map(|v| v.to_array());
        let target = (purpose == Use::Vertex).then_some(ARRAY_BUFFER);
        let accessor = self.add(floats.map(f32::to_le_bytes), target, FLOAT, "VEC3", values.len());
        self.bound(accessor, &low.to_array(), &high.to_array());
        accessor
    }

    /// Adds quaternions (xyzw) and returns the accessor.
    pub(super) fn quats(&mut self, values: &[Quat]) -> usize {
        let floats = values.iter().flat_map(|q| q.to_array());
        self.add(floats.map(f32::to_le_bytes), None, FLOAT, "VEC4", values.len())
    }

    /// Adds numbers, with their bounds, and returns the accessor.
    pub(super) fn scalars(&mut self, values: &[f32]) -> usize {
        let (low, high) =
            values.iter().fold((f32::MAX, f32::MIN), |(low, high), &v| (low.min(v), high.max(v)));
        let accessor = self.add(values.iter().map(|v| v.to_le_bytes()), None, FLOAT, "SCALAR", values.len());
        self.bound(accessor, &[low], &[high]);
        accessor
    }

    /// Adds the corners of triangles and returns the accessor.
    pub(super) fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let corners = triangles.as_flattened();
        let bytes = corners.iter().map(|v| v.to_le_bytes());
        self.add(bytes, Some(ELEMENT_ARRAY_BUFFER), UNSIGNED_INT, "SCALAR", corners.len())
    }

    fn add(
        &mut self,
        values: impl Iterator<Item = [u8; 4]>,
        target: Option<u32>,
        component_type: u32,
        element_type: &str,
        count: usize,
    ) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(values.flatten());
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": self.bytes.len() - offset });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1,
            "componentType": component_type,
            "type": element_type,
            "count": count,
        }));
        self.accessors.len() - 1
    }

    fn bound(&mut self, accessor: usize, low: &[f32], high: &[f32]) {
        self.accessors[accessor]["min"] = json!(low);
        self.accessors[accessor]["max"] = json!(high);
    }

    /// The file: header, JSON chunk (`root` with the buffer described in it) and binary chunk.
    pub(super) fn into_glb(self, mut root: Value) -> Result<Vec<u8>, Error> {
        if !self.bytes.is_empty() {
            root["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
            root["bufferViews"] = Value::Array(self.views);
            root["accessors"] = Value::Array(self.accessors);
        }
        let mut text = root.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let binary_chunk = if self.bytes.is_empty() { 0 } else { 8 + self.bytes.len() };
        let total = 12 + 8 + text.len() + binary_chunk;
        let length = u32::try_from(total).map_err(|_| Error::Unsupported {
            option: "recording",
            problem: format!("a GLB file holds at most 4 GiB; this one would have {total} bytes"),
        })?;

        let mut file = Vec::with_capacity(total);
        file.extend(b"glTF");
        file.extend(2_u32.to_le_bytes());
        file.extend(length.to_le_bytes());
        // Both chunks are smaller than the whole, whose length fits.
        file.extend((text.len() as u32).to_le_bytes());
        file.extend(b"JSON");
        file.extend(text);
        if binary_chunk > 0 {
            file.extend((self.bytes.len() as u32).to_le_bytes());
            file.extend(b"BIN\0");
            file.extend(self.bytes);
        }
        Ok(file)
    }
}
