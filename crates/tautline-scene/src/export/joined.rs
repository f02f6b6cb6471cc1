//! A recording as one mesh: for formats that know a single one.

use tautline::Vec3;

use crate::recording::{Recording, Track};

/// Where the vertices of a track begin among those of all tracks.
pub(super) fn first_vertices(recording: &Recording) -> impl Iterator<Item = (&Track, usize)> {
    recording.tracks.iter().scan(0, |next, track| {
        let first = *next;
        *next += track.mesh.positions.len();
        Some((track, first))
    })
}

/// How many vertices all tracks have together.
pub(super) fn vertex_count(recording: &Recording) -> usize {
    recording.tracks.iter().map(|track| track.mesh.positions.len()).sum()
}

/// How many triangles all tracks have together.
pub(super) fn triangle_count(recording: &Recording) -> usize {
    recording.tracks.iter().map(|track| track.mesh.triangles.len()).sum()
}

/// The vertices of all tracks at a frame, in m, track after track.
pub(super) fn positions_at(recording: &Recording, frame: usize) -> Vec<Vec3> {
    recording.tracks.iter().flat_map(|track| track.positions_at(frame).into_owned()).collect()
}
