//! Mesh files to meshes of documents.

use std::path::Path;

use serde_json::json;
use tautline::mesh::{HalfEdgeMesh, TriMesh};
use tautline_scene::document::{MeshSource, limits, parse_part};
use tautline_scene::mesh_file;
use wasm_bindgen::prelude::*;

use crate::failure::Failure;

/// The mesh of a file, `scale` metres to its unit, as a document holds it, in JSON.
#[wasm_bindgen]
pub fn read_mesh(bytes: &[u8], file_name: &str, scale: f32) -> Result<String, JsValue> {
    if bytes.len() as u64 > limits::FILE_BYTES {
        let message = format!("{} bytes are more than {}", bytes.len(), limits::FILE_BYTES);
        return Err(Failure::invalid("bytes", message).into());
    }
    if !(scale.is_finite() && scale > 0.0) {
        return Err(Failure::invalid("scale", format!("{scale} is not a finite number above 0")).into());
    }
    let TriMesh { positions, triangles } =
        mesh_file::parse(bytes, Path::new(file_name)).map_err(Failure::from)?;
    let positions = positions.iter().map(|&position| (position * scale).to_array()).collect();
    Ok(serde_json::to_string(&MeshSource { positions, triangles }).unwrap_or_default())
}

/// How large a mesh is, and whether it is closed.
#[wasm_bindgen]
pub fn mesh_info(text: &str) -> Result<String, JsValue> {
    let MeshSource { positions, triangles } = parse_part(text).map_err(Failure::from)?;
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for point in &positions {
        for axis in 0..3 {
            min[axis] = min[axis].min(point[axis]);
            max[axis] = max[axis].max(point[axis]);
        }
    }
    let (vertices, faces) = (positions.len(), triangles.len());
    let mesh = TriMesh { positions: positions.into_iter().map(Into::into).collect(), triangles };
    let is_closed = HalfEdgeMesh::from_mesh(&mesh).is_ok_and(|mesh| mesh.boundary_loops().is_empty());
    Ok(json!({ "vertices": vertices, "triangles": faces, "closed": is_closed, "min": min, "max": max })
        .to_string())
}
