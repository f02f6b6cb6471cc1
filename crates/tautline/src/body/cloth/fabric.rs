//! What a cloth is made of: the air around it, the gas in it.

use super::Cloth;
use crate::body::fabric::{AirGrip, Fabric, Gas, volume_of};
use crate::error::{Error, within};
use crate::mesh::{HalfEdgeMesh, TriMesh};

/// What a cloth was asked to be, beyond sticks of one length.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Wish {
    drag: Option<f32>,
    lift: Option<f32>,
    pressure: Option<f32>,
}

/// What the air and what is in it do. Only [`ClothSolver::SmallSteps`](crate::ClothSolver::SmallSteps) knows them: under
/// the paper's solver a cloth that asks for any of them is refused.
impl Cloth {
    /// How the air drags at it: the coefficient C of the force F = ½ ρ C A |n·u| u on every triangle of area A and unit
    /// normal n, where u is the velocity of the [wind](crate::Settings::wind) past it and ρ the
    /// [density of the air](crate::Settings::air_density). About 1.2 for a plate that is blown upon from the front; absent
    /// or 0, there is no air. Drag never turns the relative motion round, however light the cloth is.
    ///
    /// ```
    /// use tautline::{Cloth, Settings, Vec3, World};
    ///
    /// let mut world = World::new(Settings { gravity: Vec3::ZERO, ..Settings::default() })?;
    /// let sail = world.add(Cloth::grid(8, 8, 1.0, 1.0).drag(1.2))?;
    /// world.set_wind(Vec3::Y * 5.0)?;
    /// for _ in 0..60 {
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// let speed = world.body(sail)?.velocity().y;
    /// assert!(speed > 4.0 && speed < 5.0, "the wind takes it along");
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn drag(mut self, coefficient: f32) -> Self {
        self.wish.drag = Some(coefficient);
        self
    }

    /// How the air lifts it across the wind: the coefficient C of the force F = ½ ρ C A (n·u) |u| (n − û (n·û)) on every
    /// triangle, which is largest where the wind meets it at 45°, with what [`Cloth::drag`] says. It does no work on what
    /// moves against the air; flags flutter by it.
    pub fn lift(mut self, coefficient: f32) -> Self {
        self.wish.lift = Some(coefficient);
        self
    }

    /// Fills a closed surface with gas of this pressure p over the surroundings, in Pa, at the volume V it is built with.
    /// p V stays as it is: at half the volume the pressure is twice as large, up to a hundred times at a hundredth of it.
    /// (Were p counted from vacuum, one per mille that a cloth is stretched would let out 300 Pa.)
    ///
    /// ```
    /// use tautline::mesh::primitives;
    /// use tautline::{Cloth, Settings, Vec3, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let balloon = Cloth::from_mesh(primitives::icosphere(0.2, 2)?).mass(0.05).pressure(500.0);
    /// let balloon = world.add(balloon)?;
    /// assert!((world.body(balloon)?.pressure().unwrap() - 500.0).abs() < 1.0);
    /// # Ok::<(), tautline::Error>(())
    /// ```
    pub fn pressure(mut self, pressure: f32) -> Self {
        self.wish.pressure = Some(pressure);
        self
    }
}

impl Wish {
    pub(super) fn validate(&self) -> Result<(), Error> {
        for (field, coefficient) in [("drag", self.drag), ("lift", self.lift)] {
            if let Some(coefficient) = coefficient {
                within(field, coefficient, 0.0, 1e6, "a coefficient from 0 to 1e6")?;
            }
        }
        if let Some(pressure) = self.pressure {
            within("pressure", pressure, 0.0, 1e12, "a pressure from 0 to 1e12 (Pa)")?;
        }
        Ok(())
    }

    /// What a cloth of this surface becomes.
    pub(super) fn fabric(&self, mesh: &TriMesh, half_edges: &HalfEdgeMesh) -> Result<Fabric, Error> {
        let (drag, lift) = (self.drag.unwrap_or(0.0), self.lift.unwrap_or(0.0));
        let air = (drag > 0.0 || lift > 0.0).then_some(AirGrip { drag, lift });
        let gas = self.pressure.map(|pressure| gas_in(pressure, mesh, half_edges)).transpose()?;
        Ok(Fabric { air, gas })
    }
}

fn gas_in(pressure: f32, mesh: &TriMesh, half_edges: &HalfEdgeMesh) -> Result<Gas, Error> {
    let refuse = |problem: &str| Error::Invalid { field: "pressure".into(), problem: problem.into() };
    if !half_edges.closed() {
        return Err(refuse("needs a closed surface: gas would escape from this one"));
    }
    let volume = volume_of(&mesh.triangles, &mesh.positions);
    if volume > 0.0 && volume.is_finite() {
        return Ok(Gas { pressure, volume });
    }
    Err(refuse("needs a surface that holds a volume, its triangles counter-clockwise seen from outside"))
}
