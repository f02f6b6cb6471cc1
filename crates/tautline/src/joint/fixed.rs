//! Joints like a weld.

use super::build::{Link, common, common_angular};
use crate::world::BodyHandle;

/// A body stays to its base as it stands when the joint is added.
#[derive(Debug, Clone, PartialEq)]
pub struct FixedJoint {
    pub(crate) link: Link,
}

common!(FixedJoint);
common_angular!(FixedJoint);

impl FixedJoint {
    /// `body` is held by `base`, or by the world if that is `None`.
    pub fn new(body: BodyHandle, base: impl Into<Option<BodyHandle>>) -> Self {
        Self { link: Link::new(body, base.into()) }
    }
}
