//! How surfaces touch: friction, restitution, and how those of two bodies combine.

use serde::{Deserialize, Serialize};

use crate::error::{Error, within};

/// How two bodies' coefficients become one. Where the bodies disagree, the rule that is later in this list counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Combine {
    /// √(a b).
    #[default]
    GeometricMean,
    /// (a + b)/2.
    Average,
    /// The smaller.
    Minimum,
    /// a b.
    Multiply,
    /// The larger.
    Maximum,
}

impl Combine {
    pub(crate) fn apply(self, a: f32, b: f32) -> f32 {
        match self {
            Self::GeometricMean => (a * b).sqrt(),
            Self::Average => (a + b) / 2.0,
            Self::Minimum => a.min(b),
            Self::Multiply => a * b,
            Self::Maximum => a.max(b),
        }
    }
}

/// The surface of a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Coulomb's coefficient μ: the tangential force is at most μ times the normal one.
    pub friction: f32,
    /// Speed apart over speed together of a collision, 0 to 1.
    pub restitution: f32,
    /// How far, in m, the normal force acts in front of the point of contact of a body that rolls.
    pub rolling_friction: f32,
    /// How friction and rolling friction combine with those of the other body.
    pub friction_rule: Combine,
    /// How restitution combines with that of the other body.
    pub restitution_rule: Combine,
}

impl Default for Surface {
    /// Friction 0.5, no restitution, no rolling friction; friction combines to the geometric mean, restitution to
    /// the larger.
    fn default() -> Self {
        Self {
            friction: 0.5,
            restitution: 0.0,
            rolling_friction: 0.0,
            friction_rule: Combine::GeometricMean,
            restitution_rule: Combine::Maximum,
        }
    }
}

impl Surface {
    /// The default surface with this friction.
    pub fn with_friction(friction: f32) -> Self {
        Self { friction, ..Self::default() }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        within("friction", self.friction, 0.0, 1e6, "a number from 0 to 1e6")?;
        within("restitution", self.restitution, 0.0, 1.0, "a share from 0 to 1")?;
        within("rolling_friction", self.rolling_friction, 0.0, 1e6, "a length from 0 to 1e6 (m)")?;
        Ok(())
    }

    /// What acts between two surfaces.
    pub(crate) fn against(&self, other: &Self) -> Touch {
        let friction_rule = self.friction_rule.max(other.friction_rule);
        let restitution_rule = self.restitution_rule.max(other.restitution_rule);
        Touch {
            friction: friction_rule.apply(self.friction, other.friction),
            restitution: restitution_rule.apply(self.restitution, other.restitution),
            rolling_friction: friction_rule.apply(self.rolling_friction, other.rolling_friction),
        }
    }
}

/// The coefficients between two surfaces.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Touch {
    pub(crate) friction: f32,
    pub(crate) restitution: f32,
    /// In m.
    pub(crate) rolling_friction: f32,
}

impl Touch {
    pub(crate) fn is_sound(&self) -> bool {
        [self.friction, self.restitution, self.rolling_friction]
            .iter()
            .all(|number| (0.0..=1e12).contains(number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_later_rule_counts() {
        let ice = Surface { friction: 0.1, friction_rule: Combine::Minimum, ..Surface::default() };
        let rubber = Surface { friction: 0.9, restitution: 0.5, ..Surface::default() };
        assert_eq!(ice.against(&rubber).friction, 0.1);
        assert_eq!(rubber.against(&ice), ice.against(&rubber));
        assert_eq!(rubber.against(&rubber).friction, 0.9);
        assert_eq!(ice.against(&rubber).restitution, 0.5);
    }
}
