//! Soft solids: tetrahedra of particles that keep their shape elastically.

use glam::{Quat, Vec3};

use super::deformable::{BuiltDeformable, Deformable, Parts};
use super::fabric::Fabric;
use super::flesh::{Flesh, Material};
use crate::error::{Error, MeshDefect, all_coordinates, coordinates, positive, within};
use crate::geometry::sphere_tree::Feature;
use crate::mesh::{Tetrahedra, TriMesh, lattice, tetrahedralise};
use crate::norm::Norm;

/// A soft solid to be added to a world: a jelly, a tyre, a sponge.
///
/// Its inside is divided into tetrahedra of a stable neo-Hookean material, which obeys Hooke's law where it is strained
/// little, resists being squeezed to nothing, and comes right again if it is turned inside out. Its particles touch what
/// those of a cloth touch: solids, cloth, rope, other soft solids and itself. Only the default solver knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftSolid {
    volume: Volume,
    position: Vec3,
    rotation: Quat,
    velocity: Vec3,
    angular_velocity: Vec3,
    heft: Heft,
    young_modulus: f32,
    poisson_ratio: f32,
    friction: f32,
    thickness: Option<f32>,
    self_collision: bool,
    pins: Vec<u32>,
}

#[derive(Debug, Clone, PartialEq)]
enum Volume {
    Cuboid { half_extents: Vec3, cells: [u32; 3] },
    Mesh(TriMesh),
    Tetrahedra(Tetrahedra),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Heft {
    /// In kg/m³.
    Density(f32),
    /// In kg.
    Mass(f32),
}

impl SoftSolid {
    /// A box from −`half_extents` to `half_extents` (m), of so many cells along each axis, each six tetrahedra; particle
    /// (i, j, k), counted from the lowest corner, has the number (k (n_y + 1) + j)(n_x + 1) + i. 1000 kg/m³, Young's modulus
    /// 1e5 Pa, Poisson's ratio 0.45, friction 0.5, self-colliding.
    pub fn cuboid(half_extents: Vec3, cells: [u32; 3]) -> Self {
        Self::of(Volume::Cuboid { half_extents, cells })
    }

    /// The inside of a closed surface (m), divided as [`tetrahedralise`] does: the finer the surface, the finer the solid.
    /// Its vertices are the first particles. Otherwise as [`SoftSolid::cuboid`].
    pub fn from_mesh(mesh: TriMesh) -> Self {
        Self::of(Volume::Mesh(mesh))
    }

    /// These tetrahedra (m), whose points are the particles. Otherwise as [`SoftSolid::cuboid`].
    pub fn from_tetrahedra(tetrahedra: Tetrahedra) -> Self {
        Self::of(Volume::Tetrahedra(tetrahedra))
    }

    fn of(volume: Volume) -> Self {
        Self {
            volume,
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            velocity: Vec3::ZERO,
            angular_velocity: Vec3::ZERO,
            heft: Heft::Density(1000.0),
            young_modulus: 1e5,
            poisson_ratio: 0.45,
            friction: 0.5,
            thickness: None,
            self_collision: true,
            pins: Vec::new(),
        }
    }

    /// Where the origin of its shape is put, in m.
    pub fn position(self, position: Vec3) -> Self {
        Self { position, ..self }
    }

    /// Rotation about the origin of its shape; normalised when added.
    pub fn rotation(self, rotation: Quat) -> Self {
        Self { rotation, ..self }
    }

    /// Velocity, in m/s.
    pub fn velocity(self, velocity: Vec3) -> Self {
        Self { velocity, ..self }
    }

    /// Angular velocity about the origin of its shape, in rad/s, in the world's frame.
    pub fn angular_velocity(self, angular_velocity: Vec3) -> Self {
        Self { angular_velocity, ..self }
    }

    /// Density, in kg/m³: every tetrahedron gives a quarter of its mass to each of its corners.
    pub fn density(self, density: f32) -> Self {
        Self { heft: Heft::Density(density), ..self }
    }

    /// Mass, in kg, instead of a density.
    pub fn mass(self, mass: f32) -> Self {
        Self { heft: Heft::Mass(mass), ..self }
    }

    /// Young's modulus E, in Pa: a bar of length L and cross section A that is pulled by a small force F is longer by
    /// F L/(E A). What is stiffer than small steps can carry, E/(ρ l²) above about 2e6 s⁻² for cells of side l, is softer
    /// than this says.
    pub fn young_modulus(self, young_modulus: f32) -> Self {
        Self { young_modulus, ..self }
    }

    /// Poisson's ratio, 0 to 0.49: how much narrower it gets than longer, relative to its size. At 0.5 its volume could not
    /// change.
    pub fn poisson_ratio(self, poisson_ratio: f32) -> Self {
        Self { poisson_ratio, ..self }
    }

    /// Coulomb's coefficient of friction; a contact uses the geometric mean of both bodies' own.
    pub fn friction(self, friction: f32) -> Self {
        Self { friction, ..self }
    }

    /// How far from solids its particles are kept, in m, and half of how far from each other and those of cloth. Default
    /// 0.35 × the mean edge of its surface.
    pub fn thickness(self, thickness: f32) -> Self {
        Self { thickness: Some(thickness), ..self }
    }

    /// Whether it collides with itself.
    pub fn self_collision(self, self_collision: bool) -> Self {
        Self { self_collision, ..self }
    }

    /// Pins a particle where it starts.
    pub fn pin(mut self, particle: u32) -> Self {
        self.pins.push(particle);
        self
    }

    pub(crate) fn build(self) -> Result<BuiltDeformable, Error> {
        self.validate()?;
        let solid = match self.volume {
            Volume::Cuboid { half_extents, cells } => lattice(half_extents, cells)?,
            Volume::Mesh(mesh) => tetrahedralise(&mesh)?,
            Volume::Tetrahedra(solid) => checked(solid)?,
        };
        all_coordinates("positions", &solid.points)?;
        if let Some(pin) = self.pins.iter().find(|&&pin| pin as usize >= solid.points.len()) {
            let (field, value) = ("pins".into(), f64::from(*pin));
            return Err(Error::OutOfRange { field, value, expected: "the number of one of its particles" });
        }
        let material = Material::new(self.young_modulus, self.poisson_ratio);
        let flesh = Flesh::new(&solid, material)?;
        let volumes = flesh.shares(solid.points.len())?;
        let density = match self.heft {
            Heft::Density(density) => density,
            Heft::Mass(mass) => mass / volumes.iter().sum::<f32>(),
        };
        let masses: Vec<f32> = volumes.iter().map(|volume| volume * density).collect();
        let triangles = solid.surface();
        let thickness = self.thickness.unwrap_or_else(|| 0.35 * mean_edge(&triangles, &solid.points));
        let parts = Parts {
            fabric: Fabric::default(),
            grid: None,
            rigidity: None,
            flesh: Some(flesh),
            bendings: Vec::new(),
            leaves: triangles.iter().map(|&t| Feature::Triangle(t)).collect(),
            triangles,
            sticks: Vec::new(),
            angles: Vec::new(),
            leaf_margin: 0.0,
            thickness,
            self_collision: self.self_collision,
        };
        let body = Deformable::new(parts, &solid.points)?;
        let rotation = self.rotation.normalize();
        let arms: Vec<Vec3> = solid.points.iter().map(|&point| rotation * point).collect();
        Ok(BuiltDeformable {
            positions: arms.iter().map(|&arm| self.position + arm).collect(),
            body,
            velocities: arms.iter().map(|&arm| self.velocity + self.angular_velocity.cross(arm)).collect(),
            masses,
            friction: self.friction,
            pins: self.pins,
        })
    }

    fn validate(&self) -> Result<(), Error> {
        coordinates("position", self.position)?;
        coordinates("velocity", self.velocity)?;
        coordinates("angular_velocity", self.angular_velocity)?;
        within("rotation", self.rotation.length_squared(), 1e-6, 1e6, "a quaternion with a length near 1")?;
        match self.heft {
            Heft::Density(density) => positive("density", density)?,
            Heft::Mass(mass) => positive("mass", mass)?,
        };
        within("young_modulus", self.young_modulus, 1e-6, 1e15, "a modulus from 1e-6 to 1e15 (Pa)")?;
        within("poisson_ratio", self.poisson_ratio, 0.0, 0.49, "a ratio from 0 to 0.49")?;
        within("friction", self.friction, 0.0, 1e6, "a number from 0 to 1e6")?;
        if let Some(thickness) = self.thickness {
            within("thickness", thickness, 0.0, 1e6, "a length from 0 to 1e6 (m)")?;
        }
        Ok(())
    }
}

/// Tetrahedra from a caller, whose numbers may be anything.
fn checked(solid: Tetrahedra) -> Result<Tetrahedra, Error> {
    if solid.tetrahedra.is_empty() {
        return Err(MeshDefect::Empty.into());
    }
    let count = solid.points.len();
    for (index, corners) in solid.tetrahedra.iter().enumerate() {
        if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= count) {
            let problem = format!("names point {corner}, but there are only {count}");
            return Err(Error::Invalid { field: format!("tetrahedra[{index}]"), problem });
        }
    }
    Ok(solid)
}

fn mean_edge(triangles: &[[u32; 3]], points: &[Vec3]) -> f32 {
    let length = |a: u32, b: u32| points[a as usize].distance_to(points[b as usize]);
    let around = |&[a, b, c]: &[u32; 3]| length(a, b) + length(b, c) + length(c, a);
    triangles.iter().map(around).sum::<f32>() / (3 * triangles.len()) as f32
}
