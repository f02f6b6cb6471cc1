//! Ropes and nets as tubes: a rope is one, a net has one for each segment.

use tautline::Vec3;
use tautline::constraint::Stick;
use tautline::mesh::TriMesh;

use super::tube::Tube;

/// Tubes along moving lines.
#[derive(Debug, Clone)]
pub(super) struct Tubes {
    /// Each with the particles that it goes through.
    tubes: Vec<(Tube, Vec<u32>)>,
}

impl Tubes {
    /// Along the segments of a rope or net.
    pub(super) fn new(radius: f32, segments: &[Stick]) -> Self {
        let is_chain = segments.iter().zip(0..).all(|(stick, i)| [stick.a, stick.b] == [i, i + 1]);
        let lines = if is_chain {
            vec![(0..=segments.len() as u32).collect()]
        } else {
            segments.iter().map(|stick| vec![stick.a, stick.b]).collect()
        };
        Self { tubes: lines.into_iter().map(|line| (Tube::new(radius), line)).collect() }
    }

    /// All tubes, as they are where particles are here.
    pub(super) fn mesh(&mut self, particles: &[Vec3]) -> TriMesh {
        let mut all = TriMesh::default();
        for (tube, line) in &mut self.tubes {
            let mesh = tube.mesh(&along(line, particles));
            let start = all.positions.len() as u32;
            all.positions.extend(mesh.positions);
            all.triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|corner| start + corner)));
        }
        all
    }

    /// The corners of all tubes, as in [`Tubes::mesh`].
    pub(super) fn positions(&mut self, particles: &[Vec3]) -> Vec<Vec3> {
        self.tubes.iter_mut().flat_map(|(tube, line)| tube.positions(&along(line, particles))).collect()
    }
}

fn along(line: &[u32], particles: &[Vec3]) -> Vec<Vec3> {
    line.iter().map(|&particle| particles[particle as usize]).collect()
}
