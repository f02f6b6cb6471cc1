//! A recording's triangles in one list, and where their corners are at a frame.

use tautline::Vec3;

use super::Material;
use super::normals::{face_normal, smooth_normals};
use crate::recording::{Motion, Recording, Surface};

/// All tracks' triangles, one track after the other.
#[derive(Debug)]
pub(super) struct Stage {
    /// Corners of each triangle, counted through all tracks.
    triangles: Vec<[u32; 3]>,
    /// The track of each triangle.
    pub(super) track_of: Vec<u32>,
}

/// Where everything is at one frame, in m.
pub(super) struct Pose {
    positions: Vec<Vec3>,
    /// Of smooth tracks; zero elsewhere.
    normals: Vec<Vec3>,
    /// Of each triangle; zero where it has no area.
    pub(super) face_normals: Vec<Vec3>,
}

impl Stage {
    pub(super) fn new(recording: &Recording) -> Self {
        let (mut triangles, mut track_of, mut first_vertex) = (Vec::new(), Vec::new(), 0);
        for (i, track) in recording.tracks.iter().enumerate() {
            triangles.extend(track.mesh.triangles.iter().map(|t| t.map(|v| v + first_vertex)));
            track_of.resize(triangles.len(), i as u32);
            first_vertex += track.mesh.positions.len() as u32;
        }
        Self { triangles, track_of }
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    pub(super) fn pose(&self, recording: &Recording, frame: usize) -> Pose {
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        for track in &recording.tracks {
            let at_frame = track.positions_at(frame);
            match track.surface {
                Surface::Sheet | Surface::Round => {
                    normals.extend(smooth_normals(&at_frame, &track.mesh.triangles));
                }
                Surface::Solid | Surface::Wall => normals.resize(normals.len() + at_frame.len(), Vec3::ZERO),
            }
            positions.extend_from_slice(&at_frame);
        }
        let face_normals =
            self.triangles.iter().map(|t| face_normal(t.map(|v| positions[v as usize]))).collect();
        Pose { positions, normals, face_normals }
    }

    pub(super) fn corners(&self, pose: &Pose, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| pose.positions[v as usize])
    }

    /// Everything but walls.
    pub(super) fn casters(&self, pose: &Pose, materials: &[Material]) -> impl Iterator<Item = [Vec3; 3]> {
        (0..self.triangles.len())
            .filter(|&t| materials[self.track_of[t] as usize].surface != Surface::Wall)
            .map(|t| self.corners(pose, t))
    }

    /// The unit normal of a smooth surface at a point `p` (m) of a triangle, from those at its corners.
    pub(super) fn smooth_normal(&self, pose: &Pose, triangle: usize, p: Vec3) -> Vec3 {
        let face = pose.face_normals[triangle];
        let [a, b, c] = self.corners(pose, triangle);
        // Barycentric coordinates by areas; the sample may lie a little outside, where they would extrapolate.
        let weight = |from: Vec3, to: Vec3| (to - from).cross(p - from).dot(face).max(0.0);
        let [u, v, w] = [weight(b, c), weight(c, a), weight(a, b)];
        let [na, nb, nc] = self.triangles[triangle].map(|v| pose.normals[v as usize]);
        (na * u + nb * v + nc * w).normalize_or(face)
    }
}

/// Every place (m) where a corner of anything but a wall ever is; of everything if there are only walls.
pub(super) fn motion(recording: &Recording) -> impl Iterator<Item = Vec3> {
    let only_walls = recording.tracks.iter().all(|track| track.surface == Surface::Wall);
    recording.tracks.iter().filter(move |track| only_walls || track.surface != Surface::Wall).flat_map(
        |track| {
            let frames = if matches!(track.motion, Motion::Still) { 1 } else { usize::MAX };
            let frames = frames.min(recording.frame_count());
            (0..frames).flat_map(|frame| track.positions_at(frame).into_owned())
        },
    )
}

/// The least box around [`motion`]; a point at the origin if there is nothing.
pub(super) fn bounds(recording: &Recording) -> (Vec3, Vec3) {
    motion(recording)
        .fold(None, |bounds: Option<(Vec3, Vec3)>, p| {
            bounds.map_or(Some((p, p)), |(low, high)| Some((low.min(p), high.max(p))))
        })
        .unwrap_or_default()
}
