//! Sheets that tear while they are recorded. A recording has one topology: a triangle that tears gets corners of its own,
//! which shrink to a point when it does.

use crate::recording::{Motion, Track};

/// What has torn of a sheet.
#[derive(Debug, Clone)]
pub(super) struct Tears {
    /// The triangles of the last frame.
    whole: Vec<[u32; 3]>,
    /// Triangles that tore, each with the first frame without it.
    torn: Vec<([u32; 3], usize)>,
}

impl Tears {
    /// Of a sheet with these triangles.
    pub(super) fn new(triangles: &[[u32; 3]]) -> Self {
        Self { whole: triangles.to_vec(), torn: Vec::new() }
    }

    /// Notes what is left of the triangles, in their order, at a frame.
    pub(super) fn note(&mut self, left: &[[u32; 3]], frame: usize) {
        if left.len() == self.whole.len() {
            return;
        }
        let mut next = left.iter().peekable();
        let torn = self.whole.iter().filter(|triangle| next.next_if_eq(triangle).is_none());
        self.torn.extend(torn.map(|triangle| (*triangle, frame)));
        self.whole = left.to_vec();
    }

    /// Gives what tore its own corners in a track of all frames.
    pub(super) fn apply(self, track: &mut Track) {
        let Motion::Deforming(frames) = &mut track.motion else { return };
        if self.torn.is_empty() {
            return;
        }
        for (number, positions) in frames.iter_mut().enumerate() {
            for (corners, first_without) in &self.torn {
                let corners = if number < *first_without { *corners } else { [corners[0]; 3] };
                let own = corners.map(|corner| positions[corner as usize]);
                positions.extend(own);
            }
        }
        let vertices = track.mesh.positions.len() as u32;
        for (corners, _) in &self.torn {
            let corners = corners.map(|corner| track.mesh.positions[corner as usize]);
            track.mesh.positions.extend(corners);
        }
        track.mesh.triangles = self.whole;
        let own = (0..self.torn.len() as u32).map(|k| [0, 1, 2].map(|corner| vertices + 3 * k + corner));
        track.mesh.triangles.extend(own);
    }
}
