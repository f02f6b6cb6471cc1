//! The scene document: what a file says about a scene, versioned, every field with a default.
//!
//! Axes are right-handed with Y up; lengths are in metres, masses in kilograms, times in seconds, angles in
//! degrees where the name says so. A document is read by [`parse`], judged by [`Scene::check`] and described
//! to editors by [`json_schema`]. Nothing here knows a world.

mod attachment;
mod body;
mod check;
mod cloth;
mod cue;
mod joint;
pub mod limits;
mod list;
mod locate;
mod nesting;
mod parse;
mod rigid;
mod settings;
mod shape;
mod soft;
mod toml;
mod validate;
mod value;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

pub use attachment::{Anchor, AnchorPlace, Attachment};
pub use body::{Body, HalfSpace, Room, Rope};
pub use cloth::{Cloth, Creep};
pub use cue::Cue;
pub use joint::{Joint, JointKind, Motor, Spring};
pub use locate::{locate, locate_in_json};
pub(crate) use parse::line_and_column;
pub use parse::{Format, json_of_json5, parse, parse_part};
pub use rigid::{Damping, Groups, Motion, Rigid};
pub use settings::{BroadPhase, Ordering, Settings, Sleep, Solver, SquareRoot};
pub use shape::{MeshFile, MeshSource, PartOfCompound, Shape, Surface, Thread};
pub use soft::SoftSolid;
pub use value::{AxisAngle, BodyRef, Color, Pin, RopeEnd, Rotation, SheetPlace, Weight};

/// The version of the format that this crate reads and writes.
pub const VERSION: u32 = 1;

/// A scene: bodies, what holds them together, how long they move, and how they are looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Address of this schema, for editors; ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Version of the format: 1.
    #[serde(deserialize_with = "version")]
    #[schemars(range(min = 1, max = 1))]
    pub tautline: u32,
    /// A short name, used for files.
    #[serde(default = "unnamed")]
    pub name: String,
    /// What there is to see.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// How long the scene runs, in s.
    #[serde(default = "ten_seconds")]
    pub seconds: f32,
    /// Time step, in s.
    #[serde(default = "sixtieth")]
    pub dt: f32,
    /// A recording keeps one step in so many: 1 keeps all of them.
    #[serde(default = "one")]
    pub record_every: u32,
    /// How the scene is solved.
    #[serde(default)]
    pub settings: Settings,
    /// What there is in the scene.
    #[serde(default, deserialize_with = "list::bodies")]
    pub bodies: Vec<Body>,
    /// What holds rigid bodies together.
    #[serde(default, deserialize_with = "list::joints", skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Joint>,
    /// What holds cloth and rope to each other and to everything else.
    #[serde(default, deserialize_with = "list::attachments", skip_serializing_if = "Vec::is_empty")]
    pub attachments: Vec<Attachment>,
    /// What happens at a time.
    #[serde(default, deserialize_with = "list::cues", skip_serializing_if = "Vec::is_empty")]
    pub cues: Vec<Cue>,
    /// Where it is seen from; a view of everything if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// A box that bodies belong in; what leaves it counts as escaped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounds: Option<Bounds>,
}

impl Default for Scene {
    /// No bodies, for ten seconds at 60 steps a second.
    fn default() -> Self {
        Self {
            schema: None,
            tautline: VERSION,
            name: unnamed(),
            description: String::new(),
            seconds: ten_seconds(),
            dt: sixtieth(),
            record_every: one(),
            settings: Settings::default(),
            bodies: Vec::new(),
            joints: Vec::new(),
            attachments: Vec::new(),
            cues: Vec::new(),
            camera: None,
            bounds: None,
        }
    }
}

impl Scene {
    /// Whether its rigid bodies are trusses of sticks.
    pub fn has_trusses(&self) -> bool {
        self.settings.solver == Solver::Paper
    }
}

/// A point of view.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Camera {
    /// Where the eye is, in m.
    pub eye: [f32; 3],
    /// What it looks at, in m.
    pub target: [f32; 3],
    /// Vertical field of view, in degrees, between 0 and 180.
    pub fov: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { eye: [3.0, 2.0, 4.0], target: [0.0, 0.5, 0.0], fov: 40.0 }
    }
}

/// An axis-aligned box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bounds {
    /// Corner with the smallest coordinates, in m.
    pub min: [f32; 3],
    /// Corner with the largest coordinates, in m.
    pub max: [f32; 3],
}

/// The JSON Schema of the format, indented, for editors and other programs.
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(Scene);
    format!("{:#}\n", schema.as_value())
}

/// Refuses another version as soon as it is read, before the fields that version may have.
fn version<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u32, D::Error> {
    let version = u32::deserialize(deserializer)?;
    if version == VERSION {
        return Ok(version);
    }
    Err(serde::de::Error::custom(format!(
        "{version} is not a version of the format this program reads: {VERSION}"
    )))
}

fn unnamed() -> String {
    "scene".to_owned()
}

fn ten_seconds() -> f32 {
    10.0
}

fn sixtieth() -> f32 {
    1.0 / 60.0
}

fn one() -> u32 {
    1
}
