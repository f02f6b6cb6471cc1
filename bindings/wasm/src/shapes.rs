//! The surfaces of solids and walls, each once however many bodies have it.

use std::collections::BTreeMap;
use std::sync::Arc;

use tautline::BodyHandle;
use tautline::mesh::TriMesh;
use tautline_scene::build::{Look, Part};
use wasm_bindgen::prelude::*;

use crate::session::Session;

/// Which mesh has which number.
#[derive(Default)]
pub(crate) struct Meshes {
    meshes: Vec<Arc<TriMesh>>,
    /// By address: bodies share a mesh by pointing at it. It stays where it is for as long as it is in the list.
    shared: BTreeMap<usize, u32>,
    walls: BTreeMap<BodyHandle, u32>,
}

impl Meshes {
    /// The number of a part's mesh, if it has one.
    pub(crate) fn number(&mut self, part: &Part) -> Option<u32> {
        let next = self.meshes.len() as u32;
        match &part.look {
            Look::Solid(mesh) | Look::Round(mesh) => {
                Some(*self.shared.entry(Arc::as_ptr(mesh).addr()).or_insert_with(|| {
                    self.meshes.push(Arc::clone(mesh));
                    next
                }))
            }
            Look::Wall(mesh) => Some(*self.walls.entry(part.body).or_insert_with(|| {
                self.meshes.push(Arc::new(mesh.clone()));
                next
            })),
            Look::Sheet | Look::Skin(_) | Look::Tube { .. } => None,
        }
    }
}

#[wasm_bindgen]
impl Session {
    /// The vertices of a mesh; empty for a number that is none.
    pub fn mesh_positions(&self, mesh: u32) -> Vec<f32> {
        let mesh = self.meshes.meshes.get(mesh as usize);
        mesh.map_or_else(Vec::new, |mesh| mesh.positions.iter().flat_map(|point| point.to_array()).collect())
    }

    /// The triangles of a mesh; empty for a number that is none.
    pub fn mesh_indices(&self, mesh: u32) -> Vec<u32> {
        let mesh = self.meshes.meshes.get(mesh as usize);
        mesh.map_or_else(Vec::new, |mesh| mesh.triangles.as_flattened().to_vec())
    }
}
