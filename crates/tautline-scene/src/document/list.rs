//! Reads long lists.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::{Attachment, Body, Cue, Joint, limits};

pub(super) fn bodies<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Body>, D::Error> {
    limited(deserializer, limits::BODIES, "bodies")
}

pub(super) fn joints<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Joint>, D::Error> {
    limited(deserializer, limits::JOINTS, "joints")
}

pub(super) fn attachments<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Attachment>, D::Error> {
    limited(deserializer, limits::ATTACHMENTS, "attachments")
}

pub(super) fn cues<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Cue>, D::Error> {
    limited(deserializer, limits::CUES, "cues")
}

/// Stops at the first item one too many, so that a long list takes no memory.
fn limited<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
    most: usize,
    what: &'static str,
) -> Result<Vec<T>, D::Error> {
    struct Limited<T> {
        most: usize,
        what: &'static str,
        item: PhantomData<T>,
    }

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Limited<T> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "a list of at most {} {}", self.most, self.what)
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
            let mut items = Vec::new();
            while let Some(item) = list.next_element()? {
                if items.len() == self.most {
                    return Err(A::Error::custom(format!("there are more than {} {}", self.most, self.what)));
                }
                items.push(item);
            }
            Ok(items)
        }
    }

    deserializer.deserialize_seq(Limited { most, what, item: PhantomData })
}
