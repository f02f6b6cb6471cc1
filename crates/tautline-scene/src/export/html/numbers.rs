//! The numbers of a recording as bytes: meshes as they are, motions as differences from frame to frame, which pack well.

use std::io::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use serde_json::{Value, json};
use tautline::mesh::TriMesh;
use tautline::{Quat, Vec3};

/// Steps into which the extent of a motion is divided.
const STEPS: f32 = 65535.0;
/// Steps from 0 to 1 of a rotation's components.
const ROTATION_STEPS: f32 = 32767.0;

/// Bytes in the making: little-endian, one thing after the other.
#[derive(Default)]
pub(super) struct Numbers {
    bytes: Vec<u8>,
}

impl Numbers {
    /// Positions (f32) and indices (u32).
    pub(super) fn mesh(&mut self, mesh: &TriMesh) {
        self.bytes.extend(mesh.positions.iter().flat_map(Vec3::to_array).flat_map(f32::to_le_bytes));
        self.bytes.extend(mesh.triangles.iter().flatten().flat_map(|index| index.to_le_bytes()));
    }

    /// Poses, frame by frame: position as in [`Numbers::shapes`], and rotation. Returns the box of the positions.
    pub(super) fn poses(&mut self, poses: &[(Vec3, Quat)]) -> Value {
        let bounds = Bounds::of(poses.iter().map(|pose| pose.0));
        let row = |&(position, rotation): &(Vec3, Quat)| {
            let rotation =
                rotation.to_array().map(|c| (c.clamp(-1.0, 1.0) * ROTATION_STEPS).round() as i16 as u16);
            bounds.steps(position).into_iter().chain(rotation).collect()
        };
        self.differences(poses.iter().map(row));
        bounds.describe()
    }

    /// Positions of vertices, frame by frame, in steps of their box, which is returned.
    pub(super) fn shapes(&mut self, shapes: &[Vec<Vec3>]) -> Value {
        let bounds = Bounds::of(shapes.iter().flatten().copied());
        self.differences(shapes.iter().map(|shape| shape.iter().flat_map(|&p| bounds.steps(p)).collect()));
        bounds.describe()
    }

    /// Rows of numbers, each as its difference to the one before, modulo 2¹⁶: first all low bytes of a row, then all
    /// high ones, which are nearly always the same.
    fn differences(&mut self, rows: impl Iterator<Item = Vec<u16>>) {
        let mut before: Vec<u16> = Vec::new();
        for row in rows {
            before.resize(row.len(), 0);
            let steps: Vec<[u8; 2]> = row
                .iter()
                .zip(&before)
                .map(|(now, before)| now.wrapping_sub(*before).to_le_bytes())
                .collect();
            self.bytes.extend(steps.iter().map(|bytes| bytes[0]));
            self.bytes.extend(steps.iter().map(|bytes| bytes[1]));
            before = row;
        }
    }

    /// Packed, as text.
    pub(super) fn into_base64(self) -> String {
        let mut packer = DeflateEncoder::new(Vec::new(), Compression::default());
        // Writing into memory does not fail.
        let packed = packer.write_all(&self.bytes).and_then(|()| packer.finish()).unwrap_or_default();
        BASE64_STANDARD.encode(packed)
    }
}

/// The box of a motion.
struct Bounds {
    low: Vec3,
    /// Per axis; 0 where nothing moves along it.
    extent: Vec3,
}

impl Bounds {
    fn of(points: impl Iterator<Item = Vec3>) -> Self {
        let bounds = points.fold(None, |bounds: Option<(Vec3, Vec3)>, p| {
            Some(bounds.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
        });
        let (low, high) = bounds.unwrap_or_default();
        Self { low, extent: high - low }
    }

    /// A point of the box in steps.
    fn steps(&self, point: Vec3) -> [u16; 3] {
        let share = (point - self.low) / self.extent.max(Vec3::splat(f32::MIN_POSITIVE));
        share.to_array().map(|share| (share * STEPS).round() as u16)
    }

    fn describe(&self) -> Value {
        json!({ "low": self.low.to_array(), "extent": self.extent.to_array() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_come_back_from_their_differences() {
        let shapes = [vec![Vec3::ZERO, Vec3::X], vec![Vec3::new(0.5, 2.0, 0.0), Vec3::new(1.0, -1.0, 0.0)]];
        let mut numbers = Numbers::default();
        let bounds = numbers.shapes(&shapes);
        assert_eq!(bounds, json!({ "low": [0.0, -1.0, 0.0], "extent": [1.0, 3.0, 0.0] }));
        let (mut before, mut offset) = ([0u16; 6], 0);
        for shape in shapes {
            let bytes = &numbers.bytes[offset..offset + 12];
            for (k, expected) in shape.iter().flat_map(Vec3::to_array).enumerate() {
                before[k] = before[k].wrapping_add(u16::from_le_bytes([bytes[k], bytes[6 + k]]));
                let [low, extent] = [[0.0, -1.0, 0.0][k % 3], [1.0, 3.0, 0.0][k % 3]];
                let found = low + extent * f32::from(before[k]) / STEPS;
                assert!((found - expected).abs() <= 3.0 / STEPS, "{k}: {found}, not {expected}");
            }
            offset += 12;
        }
        assert_eq!(offset, numbers.bytes.len());
    }
}
