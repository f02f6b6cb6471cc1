//! Where pictures are taken from, and how points land on them.

use tautline::{Quat, Vec3};

/// A perspective camera, upright (its up is as close to +Y as its direction allows).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it stands, in m.
    pub eye: Vec3,
    /// What it looks at, in m.
    pub target: Vec3,
    /// Angle of view from bottom to top, in radians.
    pub vertical_fov: f32,
}

/// Half the free border around what is framed, as a share of the picture.
const MARGIN: f32 = 0.06;

impl Camera {
    /// The camera closest to `points` (m) that has all of them in a picture of the given width over height,
    /// looking along `direction`. Without points it looks at the origin from a few metres.
    pub fn framing(points: impl Iterator<Item = Vec3>, direction: Vec3, aspect: f32) -> Self {
        let vertical_fov = 30.0_f32.to_radians();
        let tan_y = libm::tanf(vertical_fov / 2.0) * (1.0 - 2.0 * MARGIN);
        let tan_x = tan_y * aspect;
        let [right, up, forward] = basis(direction);
        // A point (x, y, z) in these axes is inside the picture of a camera at e if |x − eₓ| ≤ (z − e_z) tan;
        // the tightest e touches the outermost point on either side of the wider of the two angles.
        let mut reach = [f32::MIN; 4];
        let (mut near, mut far) = (f32::MAX, f32::MIN);
        for p in points {
            let (x, y, z) = (p.dot(right), p.dot(up), p.dot(forward));
            let sides = [x - tan_x * z, -x - tan_x * z, y - tan_y * z, -y - tan_y * z];
            for (reach, side) in reach.iter_mut().zip(sides) {
                *reach = reach.max(side);
            }
            (near, far) = (near.min(z), far.max(z));
        }
        if near > far {
            return Self { eye: forward * -5.0, target: Vec3::ZERO, vertical_fov };
        }
        let [x_max, x_min, y_max, y_min] = reach;
        let depth = (-(x_max + x_min) / (2.0 * tan_x)).min(-(y_max + y_min) / (2.0 * tan_y));
        // Points in one spot leave no distance: step back a little.
        let depth = depth.min(near - 0.05);
        let eye = right * ((x_max - x_min) / 2.0) + up * ((y_max - y_min) / 2.0) + forward * depth;
        Self { eye, target: eye + forward * ((near + far) / 2.0 - depth), vertical_fov }
    }

    /// The three-quarter view from above that pictures have unless told otherwise.
    pub fn three_quarter() -> Vec3 {
        Vec3::new(-0.50, -0.42, -0.80)
    }
}

/// Right, up and forward of somebody looking along `direction`; −Z where that is zero.
pub(super) fn basis(direction: Vec3) -> [Vec3; 3] {
    let forward = direction.normalize_or(Vec3::NEG_Z);
    let right = forward.cross(Vec3::Y).normalize_or(Vec3::X);
    [right, right.cross(forward), forward]
}

/// A camera with a grid of samples behind it.
#[derive(Debug, Clone)]
pub(super) struct View {
    pub(super) eye: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    pub(super) forward: Vec3,
    /// Distance of the picture plane, in samples.
    focal: f32,
    center: [f32; 2],
    near: f32,
    tan: [f32; 2],
}

impl View {
    pub(super) fn new(camera: &Camera, width: usize, height: usize) -> Self {
        let to_target = camera.target - camera.eye;
        let [right, up, forward] = basis(to_target);
        let tan_y = libm::tanf(camera.vertical_fov / 2.0);
        Self {
            eye: camera.eye,
            right,
            up,
            forward,
            focal: height as f32 / 2.0 / tan_y,
            center: [width as f32 / 2.0, height as f32 / 2.0],
            near: to_target.length() * 1e-3 + 1e-4,
            tan: [tan_y * width as f32 / height as f32, tan_y],
        }
    }

    /// The length, in samples, of something 1 m long at a depth of 1 m.
    pub(super) fn focal(&self) -> f32 {
        self.focal
    }

    /// A world point in the camera's axes: right, up, depth.
    pub(super) fn to_view(&self, p: Vec3) -> Vec3 {
        self.turn(p - self.eye)
    }

    /// A world direction in the camera's axes.
    pub(super) fn turn(&self, d: Vec3) -> Vec3 {
        Vec3::new(d.dot(self.right), d.dot(self.up), d.dot(self.forward))
    }

    /// The ray through a point of the picture (in samples), with a depth of 1.
    pub(super) fn ray(&self, x: f32, y: f32) -> Vec3 {
        let u = (x - self.center[0]) / self.focal;
        let v = (self.center[1] - y) / self.focal;
        self.forward + self.right * u + self.up * v
    }

    /// Where a point in the camera's axes lands: x and y in samples, and 1 / depth.
    fn project(&self, p: Vec3) -> Vec3 {
        let inverse_depth = 1.0 / p.z;
        let scale = self.focal * inverse_depth;
        Vec3::new(self.center[0] + p.x * scale, self.center[1] - p.y * scale, inverse_depth)
    }

    /// Hands out the part of a triangle (in the camera's axes) that is in the picture, as projected triangles.
    pub(super) fn clip_and_project(&self, corners: [Vec3; 3], mut draw: impl FnMut([Vec3; 3])) {
        let mut polygon = Polygon { corners: [Vec3::ZERO; 8], len: 3 };
        polygon.corners[..3].copy_from_slice(&corners);
        let [tan_x, tan_y] = self.tan;
        polygon.clip(|p| p.z - self.near);
        polygon.clip(|p| p.z * tan_x - p.x);
        polygon.clip(|p| p.z * tan_x + p.x);
        polygon.clip(|p| p.z * tan_y - p.y);
        polygon.clip(|p| p.z * tan_y + p.y);
        let projected = polygon.corners.map(|p| self.project(p));
        for i in 2..polygon.len {
            draw([projected[0], projected[i - 1], projected[i]]);
        }
    }
}

/// A convex polygon: three corners and at most one more for each of five clipping planes.
struct Polygon {
    corners: [Vec3; 8],
    len: usize,
}

impl Polygon {
    /// Keeps the part where `height` ≥ 0 (Sutherland & Hodgman 1974).
    fn clip(&mut self, height: impl Fn(Vec3) -> f32) {
        let old = &self.corners[..self.len];
        if old.iter().all(|&p| height(p) >= 0.0) {
            return;
        }
        let mut kept = Polygon { corners: [Vec3::ZERO; 8], len: 0 };
        for (i, &from) in old.iter().enumerate() {
            let to = old[(i + 1) % old.len()];
            let (at_from, at_to) = (height(from), height(to));
            if at_from >= 0.0 {
                kept.push(from);
            }
            if (at_from >= 0.0) != (at_to >= 0.0) {
                kept.push(from + (to - from) * (at_from / (at_from - at_to)));
            }
        }
        *self = kept;
    }

    /// Rounding could make a polygon not quite convex and a ninth corner of it: that one is dropped.
    fn push(&mut self, p: Vec3) {
        if let Some(corner) = self.corners.get_mut(self.len) {
            *corner = p;
            self.len += 1;
        }
    }
}

/// Turns a direction about the vertical, in radians.
pub(super) fn turned(direction: Vec3, angle: f32) -> Vec3 {
    let (sin, cos) = libm::sincosf(angle / 2.0);
    Quat::from_xyzw(0.0, sin, 0.0, cos) * direction
}
