//! How large a document may be. What is larger is refused before it takes memory.

/// Bytes of a scene or mesh file.
pub const FILE_BYTES: u64 = 64 << 20;
/// Bodies of a scene.
pub const BODIES: usize = 50_000;
/// Joints of a scene.
pub const JOINTS: usize = 100_000;
/// Attachments of a scene.
pub const ATTACHMENTS: usize = 100_000;
/// Cues of a scene.
pub const CUES: usize = 100_000;
/// Particles of a scene, over all bodies.
pub const PARTICLES: u64 = 1_000_000;
/// Triangles of a scene, over all meshes that are given as triangles.
pub const TRIANGLES: u64 = 4_000_000;
/// Lists and objects inside each other.
pub const NESTING: usize = 64;
/// Steps of a run.
pub const STEPS: f32 = 1e7;
/// Metres from the origin, metres of a length, metres per second of a velocity.
pub const REACH: f32 = 1e6;
/// Kilograms of a body, kilograms per cubic metre of a density.
pub const MASS: f32 = 1e12;
/// Problems that are listed one by one.
pub const PROBLEMS: usize = 100;
/// Positions of a recording, over all frames: 12 bytes each.
pub const RECORDED_POSITIONS: u64 = 100_000_000;
