//! What can be chosen about a named scene.

use crate::error::Error;

/// Something that can be chosen about a named scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it is, with its unit.
    pub description: &'static str,
    /// The value it has unless told otherwise.
    pub default: f64,
    /// The least value.
    pub min: f64,
    /// The greatest value.
    pub max: f64,
    /// Whether it is a whole number.
    pub integer: bool,
}

impl Parameter {
    /// A whole number.
    pub(super) const fn count(
        name: &'static str,
        description: &'static str,
        default: u32,
        (min, max): (u32, u32),
    ) -> Self {
        Self { name, description, default: default as f64, min: min as f64, max: max as f64, integer: true }
    }

    /// The number that all of a scene's random numbers come from.
    pub(super) const SEED: Self = Self {
        name: "seed",
        description: "what the random numbers begin with: another seed, another scene of the same kind",
        default: 1.0,
        min: 0.0,
        // The greatest whole number below which f64 has all of them.
        max: 9_007_199_254_740_991.0,
        integer: true,
    };

    fn expected(&self) -> String {
        let kind = if self.integer { "a whole number" } else { "a number" };
        format!("{kind} from {} to {}", self.min, self.max)
    }
}

/// Values of a scene's parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    scene: &'static str,
    parameters: &'static [Parameter],
    values: Vec<f64>,
}

impl Parameters {
    pub(super) fn defaults(scene: &'static str, parameters: &'static [Parameter]) -> Self {
        Self { scene, parameters, values: parameters.iter().map(|parameter| parameter.default).collect() }
    }

    /// Sets a parameter from a text such as `n=100`.
    ///
    /// # Errors
    /// [`Error::UnknownParameter`], which lists those there are; [`Error::ParameterValue`] for a value out of
    /// its range or none at all. Nothing is changed then.
    pub fn assign(&mut self, assignment: &str) -> Result<(), Error> {
        let (name, text) = assignment.split_once('=').unwrap_or((assignment, ""));
        let value = text.trim().parse().unwrap_or(f64::NAN);
        self.change(name.trim(), value, text.trim())
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// As [`Parameters::assign`].
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        self.change(name, value, &value.to_string())
    }

    fn change(&mut self, name: &str, value: f64, text: &str) -> Result<(), Error> {
        let Some(index) = self.index(name) else {
            let known = self.parameters.iter().map(|parameter| parameter.name).collect();
            return Err(Error::UnknownParameter { scene: self.scene, name: name.to_owned(), known });
        };
        let parameter = &self.parameters[index];
        let in_range = (parameter.min..=parameter.max).contains(&value);
        if !in_range || parameter.integer && value != value.trunc() {
            let (name, value, expected) = (name.to_owned(), text.to_owned(), parameter.expected());
            return Err(Error::ParameterValue { name, value, expected });
        }
        self.values[index] = value;
        Ok(())
    }

    /// A parameter's value.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.index(name).map(|index| self.values[index])
    }

    /// A whole number; 0 for a name there is not.
    pub(super) fn count(&self, name: &str) -> u32 {
        self.get(name).unwrap_or_default() as u32
    }

    /// The seed.
    pub(super) fn seed(&self) -> u64 {
        self.get(Parameter::SEED.name).unwrap_or_default() as u64
    }

    fn index(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|parameter| parameter.name == name)
    }
}
