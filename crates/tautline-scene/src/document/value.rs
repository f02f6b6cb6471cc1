//! Values that a document can write in more than one way: rotations, pins and colours.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{
    Deserialize, Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor,
};
use serde::{Deserialize as DeriveDeserialize, Serialize};

/// A rotation: a quaternion `[x, y, z, w]`, or `{axis, degrees}`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Rotation {
    /// A quaternion x, y, z, w, of any length above 0.
    Quaternion([f32; 4]),
    /// A turn about an axis.
    AxisAngle(AxisAngle),
}

/// A turn about an axis, counter-clockwise seen from its tip.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, DeriveDeserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisAngle {
    /// The axis, of any length above 0.
    pub axis: [f32; 3],
    /// The angle, in degrees.
    pub degrees: f32,
}

impl Default for Rotation {
    fn default() -> Self {
        Self::Quaternion([0.0, 0.0, 0.0, 1.0])
    }
}

impl<'de> Deserialize<'de> for Rotation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = Rotation;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a quaternion [x, y, z, w] or {axis, degrees}")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Rotation, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(Rotation::Quaternion)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Rotation, A::Error> {
                Deserialize::deserialize(MapAccessDeserializer::new(map)).map(Rotation::AxisAngle)
            }
        }

        deserializer.deserialize_any(Either)
    }
}

/// What is pinned: a particle by its index from 0, or particles by the name of their place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "{Place}Pin")]
pub enum Pin<Place> {
    /// One particle.
    Index(u32),
    /// All particles at a place.
    Place(Place),
}

/// The mass of one particle, or of each at a place, instead of its share of the body's mass.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, DeriveDeserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound(deserialize = "Place: Deserialize<'de>"))]
#[schemars(rename = "{Place}Weight")]
pub struct Weight<Place> {
    /// Which particles.
    pub at: Pin<Place>,
    /// Mass of each, in kg.
    pub mass: f32,
}

/// Places of a grid of cloth, as seen from above before it is turned: X to the right, Z to the front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, DeriveDeserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SheetPlace {
    /// The corner at −X, −Z.
    BackLeft,
    /// The corner at +X, −Z.
    BackRight,
    /// The corner at −X, +Z.
    FrontLeft,
    /// The corner at +X, +Z.
    FrontRight,
    /// The four corners.
    Corners,
    /// The edge at −Z.
    Back,
    /// The edge at +Z.
    Front,
    /// The edge at −X.
    Left,
    /// The edge at +X.
    Right,
}

/// The ends of a rope.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, DeriveDeserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RopeEnd {
    /// The first particle.
    First,
    /// The last particle.
    Last,
}

/// A body of the scene: its index in `bodies` from 0, or its name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum BodyRef {
    /// By its index.
    Index(u32),
    /// By its name.
    Name(String),
}

impl<'de> Deserialize<'de> for BodyRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(IndexOrName("the index or the name of a body")).map(|key| match key {
            Ok(index) => Self::Index(index),
            Err(name) => Self::Name(name),
        })
    }
}

impl<'de, Place: Deserialize<'de>> Deserialize<'de> for Pin<Place> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(IndexOrName("the index of a particle or the name of a place"))? {
            Ok(index) => Ok(Pin::Index(index)),
            Err(name) => Place::deserialize(name.into_deserializer()).map(Pin::Place),
        }
    }
}

/// Reads an index, or a name; says what is expected.
struct IndexOrName(&'static str);

impl Visitor<'_> for IndexOrName {
    /// The index, or else the name.
    type Value = Result<u32, String>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_u64<E: Error>(self, index: u64) -> Result<Self::Value, E> {
        let index = u32::try_from(index).map_err(|_| E::invalid_value(Unexpected::Unsigned(index), &self))?;
        Ok(Ok(index))
    }

    // What comes here is negative.
    fn visit_i64<E: Error>(self, index: i64) -> Result<Self::Value, E> {
        Err(E::invalid_value(Unexpected::Signed(index), &self))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Self::Value, E> {
        Ok(Err(name.to_owned()))
    }
}

/// A colour, sRGB, written `#rrggbb`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, DeriveDeserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(extend("pattern" = "^#[0-9a-fA-F]{6}$"))]
pub struct Color(pub [u8; 3]);

impl TryFrom<String> for Color {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
        let channels = digits.filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        let value = channels.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let [_, red, green, blue] =
            value.ok_or_else(|| format!("{text:?} is not a colour such as \"#3070b0\""))?.to_be_bytes();
        Ok(Self([red, green, blue]))
    }
}

impl From<Color> for String {
    fn from(Color([red, green, blue]): Color) -> Self {
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}
