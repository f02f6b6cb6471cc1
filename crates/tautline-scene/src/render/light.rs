//! From surfaces to colours: sun, sky, tone mapping and the sRGB curve. Colours are linear unless they say sRGB.

use std::sync::LazyLock;

use tautline::Vec3;

/// Sunlight on a face turned to it, a little warm.
const SUN: Vec3 = Vec3::new(0.94, 0.89, 0.80);
/// Light from straight above, a little cool.
const SKY: Vec3 = Vec3::new(0.47, 0.50, 0.55);
/// Light from below, off the ground.
const GROUND: Vec3 = Vec3::new(0.36, 0.335, 0.31);
/// Strength of the highlight on solids.
const GLOSS: f32 = 0.10;

/// What is known of a spot when it is lit.
pub(super) struct Spot {
    /// Colour of the surface.
    pub(super) albedo: Vec3,
    /// Unit normal, on the side the camera is on.
    pub(super) normal: Vec3,
    /// Unit direction to the camera.
    pub(super) towards_eye: Vec3,
    /// Share of the sun's light that gets here.
    pub(super) sunlight: f32,
    /// Share of the sky's light that gets here.
    pub(super) openness: f32,
    /// Whether it shines, as solids do.
    pub(super) glossy: bool,
}

/// The light that a spot sends to the camera.
pub(super) fn light(spot: &Spot, towards_sun: Vec3) -> Vec3 {
    let facing_sun = spot.normal.dot(towards_sun).max(0.0);
    let sky = GROUND.lerp(SKY, 0.5 + 0.5 * spot.normal.y) * spot.openness;
    let diffuse = spot.albedo * (SUN * (facing_sun * spot.sunlight) + sky);
    if !spot.glossy {
        return diffuse;
    }
    // Blinn–Phong with an exponent of 32, and Schlick's Fresnel term for the sky at grazing angles. Powers are
    // written out: those of the standard library may round differently from build to build.
    let half = (towards_sun + spot.towards_eye).normalize_or_zero();
    let square = |x: f32| x * x;
    let highlight = square(square(square(square(square(spot.normal.dot(half).max(0.0))))));
    let grazing = 1.0 - spot.normal.dot(spot.towards_eye).clamp(0.0, 1.0);
    let fresnel = square(square(grazing)) * grazing;
    diffuse
        + SUN * (GLOSS * 4.0 * highlight * facing_sun * spot.sunlight)
        + SKY * (GLOSS * 3.0 * fresnel * spot.openness)
}

/// Keeps colours as they are up to 0.76 and compresses what is brighter without turning its hue (the Khronos
/// PBR neutral tone mapper, without its toe).
pub(super) fn tone_map(color: Vec3) -> Vec3 {
    const START: f32 = 0.76;
    const DESATURATION: f32 = 0.15;
    let peak = color.max_element();
    if peak <= START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let grey = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (color * (new_peak / peak)).lerp(Vec3::splat(new_peak), grey)
}

/// The background: soft and light, a little darker towards the top; `height` runs from 0 at the top to 1.
pub(super) fn background(height: f32) -> Vec3 {
    Vec3::new(0.74, 0.78, 0.83).lerp(Vec3::new(0.93, 0.935, 0.94), height)
}

/// sRGB to linear.
pub(crate) fn from_srgb(color: [u8; 3]) -> Vec3 {
    Vec3::from(color.map(|c| {
        let c = c as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { libm::powf((c + 0.055) / 1.055, 2.4) }
    }))
}

/// Linear to sRGB, clamped to what can be shown.
pub(super) fn to_srgb(color: Vec3) -> [u8; 3] {
    color.to_array().map(|c| SRGB[(c.clamp(0.0, 1.0) * (SRGB.len() - 1) as f32 + 0.5) as usize])
}

/// sRGB bytes of 0 … 1 in 8191 steps: fine enough for every dark byte but the first few.
static SRGB: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let encode = |c: f32| {
        let c = if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * libm::powf(c, 1.0 / 2.4) - 0.055 };
        (c * 255.0 + 0.5) as u8
    };
    (0..8192).map(|i| encode(i as f32 / 8191.0)).collect()
});
