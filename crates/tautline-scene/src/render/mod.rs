//! Lit, shadowed pictures of a recording, drawn without a graphics card. The same bits on every machine: exact
//! coverage, no platform mathematics, nothing random.

mod camera;
mod light;
mod normals;
mod occlusion;
mod raster;
mod shade;
mod shadow;
mod stage;

use tautline::Vec3;

pub use camera::Camera;
pub(crate) use light::from_srgb as linear_color;
pub(crate) use normals::smooth_normals;
pub(crate) use shade::Scratch;

use crate::Error;
use crate::recording::{Recording, Surface};
use camera::View;
use light::from_srgb;
use shadow::{ShadowMap, Sun};
use stage::Stage;

/// The greatest width and height of a picture, in pixels.
pub const MAX_SIZE: u32 = 8192;

/// A picture: sRGB, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Colours.
    pub pixels: Vec<[u8; 3]>,
}

/// How pictures are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Pixels in a row, 1 to [`MAX_SIZE`].
    pub width: u32,
    /// Rows, 1 to [`MAX_SIZE`].
    pub height: u32,
    /// Samples along a side of each pixel, 1 to 4; edges are as smooth as its square.
    pub supersampling: u32,
    /// Where from; `None` frames the whole motion.
    pub camera: Option<Camera>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { width: 640, height: 480, supersampling: 2, camera: None }
    }
}

/// Everything about a recording's pictures that stays the same from frame to frame.
#[derive(Debug)]
pub struct Renderer<'a> {
    recording: &'a Recording,
    settings: Settings,
    stage: Stage,
    materials: Vec<Material>,
    view: View,
    sun: Sun,
    /// Middle (m) and radius (m) of all that moves, beyond which the ground fades.
    focus: (Vec3, f32),
}

/// A track's looks.
#[derive(Debug, Clone)]
struct Material {
    /// Linear colours of the outside and the inside.
    albedo: [Vec3; 2],
    surface: Surface,
}

impl<'a> Renderer<'a> {
    /// Prepares to take pictures of a recording.
    ///
    /// # Errors
    /// [`Error::Recording`] if the recording contradicts itself, [`Error::Unsupported`] if a setting is outside
    /// its range.
    pub fn new(recording: &'a Recording, settings: Settings) -> Result<Self, Error> {
        recording.check()?;
        settings.check()?;
        let stage = Stage::new(recording);
        let aspect = settings.width as f32 / settings.height as f32;
        let camera = settings
            .camera
            .unwrap_or_else(|| Camera::framing(stage::motion(recording), Camera::three_quarter(), aspect));
        let (width, height) = (settings.width as usize, settings.height as usize);
        let samples = settings.supersampling as usize;
        let (low, high) = stage::bounds(recording);
        Ok(Self {
            recording,
            settings,
            stage,
            materials: recording
                .tracks
                .iter()
                .map(|track| Material::new(track.color, track.surface))
                .collect(),
            view: View::new(&camera, width * samples, height * samples),
            sun: Sun::new(towards_sun(&camera), low, high),
            focus: ((low + high) / 2.0, (high - low).length() / 2.0),
        })
    }

    /// The picture of a frame; after the last frame, that of the last.
    pub fn frame(&self, frame: usize) -> Image {
        self.frame_with(frame, &mut Scratch::default())
    }

    /// [`Self::frame`] for many frames in turn; what is in the scratch before does not matter.
    pub(crate) fn frame_with(&self, frame: usize, scratch: &mut Scratch) -> Image {
        let pose = self.stage.pose(self.recording, frame);
        let mut memory = std::mem::take(&mut scratch.shadow_map);
        let shadow_map = ShadowMap::cast(self.sun, self.stage.casters(&pose, &self.materials), &mut memory);
        let image = shade::picture(self, &pose, &shadow_map, scratch);
        scratch.shadow_map = memory;
        image
    }
}

/// Over the camera's left shoulder.
fn towards_sun(camera: &Camera) -> Vec3 {
    let away = camera.eye - camera.target;
    let level = Vec3::new(away.x, 0.0, away.z).normalize_or(Vec3::Z);
    (camera::turned(level, -0.25) + Vec3::Y * 1.45).normalize()
}

impl Material {
    fn new(color: [u8; 3], surface: Surface) -> Self {
        let outside = from_srgb(color);
        let grey = Vec3::splat((outside.x + outside.y + outside.z) / 3.0);
        let inside = if surface == Surface::Sheet { outside.lerp(grey, 0.25) * 0.8 } else { outside };
        Self { albedo: [outside, inside], surface }
    }

    fn is_smooth(&self) -> bool {
        matches!(self.surface, Surface::Sheet | Surface::Round)
    }
}

impl Settings {
    fn check(&self) -> Result<(), Error> {
        let refuse = |option, problem| Err(Error::Unsupported { option, problem });
        for (option, size) in [("width", self.width), ("height", self.height)] {
            if !(1..=MAX_SIZE).contains(&size) {
                return refuse(option, format!("{size} is not between 1 and {MAX_SIZE} pixels"));
            }
        }
        if !(1..=4).contains(&self.supersampling) {
            return refuse("supersampling", format!("{} is not between 1 and 4", self.supersampling));
        }
        if let Some(camera) = self.camera {
            let fov = camera.vertical_fov;
            if !(camera.eye.is_finite() && camera.target.is_finite() && camera.eye != camera.target) {
                return refuse("camera", "eye and target must be finite and apart".into());
            }
            if !(fov > 0.01 && fov < 3.0) {
                return refuse(
                    "camera",
                    format!("an angle of view of {fov} is not between 0.01 and 3 radians"),
                );
            }
        }
        Ok(())
    }
}

/// Restrained colours that go together, sRGB: distinct for the first ten, then again from the start.
pub fn palette(i: usize) -> [u8; 3] {
    const COLORS: [[u8; 3]; 10] = [
        [52, 101, 164],
        [224, 122, 65],
        [78, 154, 128],
        [214, 84, 89],
        [236, 184, 84],
        [112, 96, 160],
        [94, 168, 196],
        [168, 176, 92],
        [196, 120, 150],
        [110, 120, 134],
    ];
    COLORS[i % COLORS.len()]
}
