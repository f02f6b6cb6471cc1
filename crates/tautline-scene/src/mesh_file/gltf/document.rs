//! The fields of a glTF document that say where triangles are. Others are passed over without taking memory.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::super::Refusal;
use super::super::refusal::quoted;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object, that of a glTF document")]
pub(super) struct Document {
    asset: Asset,
    #[serde(default)]
    extensions_required: Vec<String>,
    pub(super) scene: Option<u32>,
    #[serde(default)]
    pub(super) scenes: Vec<Scene>,
    #[serde(default)]
    pub(super) nodes: Vec<Node>,
    #[serde(default)]
    pub(super) meshes: Vec<Mesh>,
    #[serde(default)]
    pub(super) accessors: Vec<Accessor>,
    #[serde(default)]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub(super) buffers: Vec<Buffer>,
    #[serde(default)]
    pub(super) materials: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) images: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) animations: Vec<IgnoredAny>,
    #[serde(default)]
    pub(super) skins: Vec<IgnoredAny>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub(super) nodes: Vec<u32>,
}

/// A place in the scene. Its numbers are in boxes, since most nodes have few of them.
#[derive(Deserialize)]
pub(super) struct Node {
    pub(super) mesh: Option<u32>,
    #[serde(default)]
    pub(super) children: Vec<u32>,
    pub(super) matrix: Option<Box<[f64; 16]>>,
    pub(super) translation: Option<Box<[f64; 3]>>,
    pub(super) rotation: Option<Box<[f64; 4]>>,
    pub(super) scale: Option<Box<[f64; 3]>>,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<u32>,
    #[serde(default = "list_of_triangles")]
    pub(super) mode: u32,
    #[serde(default)]
    pub(super) targets: Vec<IgnoredAny>,
}

fn list_of_triangles() -> u32 {
    4
}

#[derive(Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<u32>,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: u32,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    pub(super) byte_stride: Option<u64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) byte_length: u64,
    pub(super) uri: Option<String>,
}

/// Bytes of text that an object must have on average: `{},` would take thirty times its text in memory.
const BYTES_PER_OBJECT: usize = 12;
/// Objects that any document may have, however short its text.
const FREE_OBJECTS: usize = 10_000;

/// Reads the JSON. What its numbers refer to is not looked at, except that all of it is known.
pub(super) fn parse(json: &[u8]) -> Result<Document, Refusal> {
    let objects = json.iter().filter(|&&byte| byte == b'{').count();
    if objects > FREE_OBJECTS + json.len() / BYTES_PER_OBJECT {
        return Err(Refusal::new(format!("{objects} objects in {} bytes of JSON are no glTF", json.len())));
    }
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    let document: Document = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        let message = error.inner().to_string();
        if path == "." { Refusal::new(message) } else { Refusal::at_field(path, message) }
    })?;
    deserializer.end().map_err(|error| Refusal::new(error.to_string()))?;
    if !document.asset.version.starts_with("2.") {
        let message = format!("{} of glTF: only 2.0 is read", quoted(&document.asset.version));
        return Err(Refusal::at_field("asset.version", message));
    }
    if let Some(extension) = document.extensions_required.first() {
        let message = format!(
            "{} is not known here: export without it, such as without compression",
            quoted(extension)
        );
        return Err(Refusal::at_field("extensionsRequired[0]", message));
    }
    Ok(document)
}
