//! Cloth: a sheet of particles with sticks on the edges of its triangles (paper, 4).

mod fabric;
mod mass;

use glam::{Quat, Vec2, Vec3};

use super::deformable::{BuiltDeformable, Deformable, GridShape, Parts};
use crate::constraint::{AngleLimit, Bending, Stick};
use crate::error::{Error, all_coordinates, coordinates, within};
use crate::geometry::sphere_tree::Feature;
use crate::mesh::{HalfEdgeMesh, TriMesh, primitives};

use mass::Mass;

/// A sheet to be added to a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Cloth {
    surface: Surface,
    position: Vec3,
    rotation: Quat,
    sag: f32,
    velocity: Vec3,
    mass: Mass,
    friction: f32,
    thickness: Option<f32>,
    self_collision: bool,
    bending_compliance: Option<f32>,
    pins: Vec<u32>,
    wish: fabric::Wish,
}

#[derive(Debug, Clone, PartialEq)]
enum Surface {
    Grid { columns: u32, rows: u32, width: f32, depth: f32 },
    Mesh(TriMesh),
}

/// A corner of a cloth grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Column 0, row 0: least x, least z.
    First,
    /// Last column, row 0: greatest x, least z.
    RowEnd,
    /// Column 0, last row: least x, greatest z.
    ColumnEnd,
    /// Last column, last row: greatest x, greatest z.
    Last,
}

impl Cloth {
    /// A level rectangle about the origin, `width` along x and `depth` along z (m), of `columns` × `rows`
    /// particles; particle `row·columns + column`. 1 kg, friction 0.5, self-colliding, without bending.
    pub fn grid(columns: u32, rows: u32, width: f32, depth: f32) -> Self {
        Self::with_surface(Surface::Grid { columns, rows, width, depth })
    }

    /// Any triangulated surface, also with holes, in m. 1 kg, friction 0.5, self-colliding, without bending.
    pub fn from_mesh(mesh: TriMesh) -> Self {
        Self::with_surface(Surface::Mesh(mesh))
    }

    fn with_surface(surface: Surface) -> Self {
        Self {
            surface,
            position: Vec3::ZERO,
            rotation: Quat::IDENTITY,
            sag: 0.0,
            velocity: Vec3::ZERO,
            mass: Mass::Whole(1.0),
            friction: 0.5,
            thickness: None,
            self_collision: true,
            bending_compliance: None,
            pins: Vec::new(),
            wish: fabric::Wish::default(),
        }
    }

    /// Where the surface's origin is put, in m.
    pub fn position(self, position: Vec3) -> Self {
        Self { position, ..self }
    }

    /// Rotation about the surface's origin; normalised when added.
    pub fn rotation(self, rotation: Quat) -> Self {
        Self { rotation, ..self }
    }

    /// How far the middle of a grid hangs below its corners where it is laid out, at rest, in m: so much more cloth
    /// there is than the rectangle takes. Half as far at the middle of its sides. No effect on other surfaces.
    pub fn sag(self, sag: f32) -> Self {
        Self { sag, ..self }
    }

    /// Velocity of all particles, in m/s.
    pub fn velocity(self, velocity: Vec3) -> Self {
        Self { velocity, ..self }
    }

    /// Mass, in kg, shared equally by its particles. Of this, [`Cloth::masses`] and [`Cloth::density`] the last counts.
    pub fn mass(self, mass: f32) -> Self {
        Self { mass: Mass::Whole(mass), ..self }
    }

    /// The mass of every particle, in kg.
    pub fn masses(self, masses: Vec<f32>) -> Self {
        Self { mass: Mass::Each(masses), ..self }
    }

    /// Mass per area, in kg/m²: every particle gets a third of the triangles around it, also where a mesh is uneven.
    pub fn density(self, density: f32) -> Self {
        Self { mass: Mass::PerArea(density), ..self }
    }

    /// Coulomb's coefficient of friction; a contact uses the geometric mean of both bodies' own.
    pub fn friction(self, friction: f32) -> Self {
        Self { friction, ..self }
    }

    /// How far from solids it is kept, in m: enough to cover what pokes through between its particles. At most
    /// the radius of its leaf spheres is used. Default 0.6 × the mean edge length.
    pub fn thickness(self, thickness: f32) -> Self {
        Self { thickness: Some(thickness), ..self }
    }

    /// Whether it collides with itself.
    pub fn self_collision(self, self_collision: bool) -> Self {
        Self { self_collision, ..self }
    }

    /// Holds the angle between neighbouring triangles with this compliance, in rad/(N·m); 0 = rigid.
    pub fn bending(self, compliance: f32) -> Self {
        Self { bending_compliance: Some(compliance), ..self }
    }

    /// Pins a particle where it starts.
    pub fn pin(mut self, particle: u32) -> Self {
        self.pins.push(particle);
        self
    }

    /// Pins a corner of a grid; no effect on other surfaces.
    pub fn pin_corner(self, corner: Corner) -> Self {
        let Surface::Grid { columns, rows, .. } = self.surface else { return self };
        let (last_column, last_row) = (columns.saturating_sub(1), rows.saturating_sub(1));
        self.pin(match corner {
            Corner::First => 0,
            Corner::RowEnd => last_column,
            Corner::ColumnEnd => last_row.saturating_mul(columns),
            Corner::Last => last_row.saturating_mul(columns).saturating_add(last_column),
        })
    }

    pub(crate) fn build(self) -> Result<BuiltDeformable, Error> {
        self.validate()?;
        let mesh = match &self.surface {
            Surface::Grid { columns, rows, width, depth } => sagging(
                primitives::grid(*columns, *rows, *width, *depth)?,
                0.5 * Vec2::new(*width, *depth),
                self.sag,
            ),
            Surface::Mesh(mesh) => mesh.clone(),
        };
        let half_edges = HalfEdgeMesh::from_mesh(&mesh)?;
        all_coordinates("positions", &mesh.positions)?;
        if let Some(pin) = self.pins.iter().find(|&&pin| pin as usize >= mesh.positions.len()) {
            let (field, value) = ("pins".into(), f64::from(*pin));
            return Err(Error::OutOfRange { field, value, expected: "the number of one of its particles" });
        }
        let rotation = self.rotation.normalize();
        let positions: Vec<Vec3> = mesh.positions.iter().map(|&p| self.position + rotation * p).collect();
        // At rest in the surface's own frame: placed far from the origin, positions are rounded.
        let rest = &mesh.positions;
        let sticks: Vec<Stick> = half_edges.edges().map(|[a, b]| Stick::at_rest(a, b, rest)).collect();
        Stick::check_all(&sticks, "surface")?;
        let mean_edge = sticks.iter().map(|stick| stick.rest_length).sum::<f32>() / sticks.len() as f32;
        let leaves = match self.surface {
            Surface::Grid { columns, rows, .. } => grid_cells(columns, rows),
            Surface::Mesh(_) => mesh.triangles.iter().map(|&t| Feature::Triangle(t)).collect(),
        };
        let grid = match self.surface {
            // What is laid out as a grid has sticks that are all alike.
            Surface::Grid { columns, rows, width, depth } if self.wish.is_uniform() && self.sag == 0.0 => {
                let edges = [width / (columns - 1) as f32, depth / (rows - 1) as f32];
                Some(GridShape { columns, rows, edges })
            }
            _ => None,
        };
        let masses = self.mass.of_particles(&mesh)?;
        let mut bendings = bendings(&half_edges, rest, self.bending_compliance);
        let rigidity = if grid.is_some() { self.wish.bending_stiffness } else { None };
        if rigidity.is_none() {
            bendings.extend(self.wish.hinges(&half_edges, rest));
        }
        let parts = Parts {
            grid,
            rigidity,
            flesh: None,
            bendings,
            angles: Vec::new(),
            leaves,
            leaf_margin: 0.0,
            thickness: self.thickness.unwrap_or(0.6 * mean_edge),
            self_collision: self.self_collision,
            fabric: self.wish.fabric(&mesh, &half_edges, &sticks)?,
            sticks,
            triangles: mesh.triangles,
        };
        let body = Deformable::new(parts, rest)?;
        let Self { velocity, mass, friction, pins, .. } = self;
        let count = positions.len();
        let share = if let Mass::Whole(mass) = mass { mass / count as f32 } else { 1.0 };
        let masses = masses.unwrap_or_else(|| vec![share; count]);
        Ok(BuiltDeformable { positions, body, velocities: vec![velocity; count], masses, friction, pins })
    }

    fn validate(&self) -> Result<(), Error> {
        coordinates("position", self.position)?;
        coordinates("velocity", self.velocity)?;
        within("sag", self.sag, 0.0, 1e6, "a length from 0 to 1e6 (m)")?;
        within("rotation", self.rotation.length_squared(), 1e-6, 1e6, "a quaternion with a length near 1")?;
        self.mass.validate()?;
        within("friction", self.friction, 0.0, 1e6, "a number from 0 to 1e6")?;
        if let Some(thickness) = self.thickness {
            within("thickness", thickness, 0.0, 1e6, "a length from 0 to 1e6 (m)")?;
        }
        if let Some(compliance) = self.bending_compliance {
            within("bending_compliance", compliance, 0.0, 1e12, "a number from 0 to 1e12 (rad/(N·m))")?;
        }
        if self.bending_compliance.is_some() && self.wish.bending_stiffness.is_some() {
            let problem = "comes with a compliance of bending: give one of the two".into();
            return Err(Error::Invalid { field: "bending_stiffness".into(), problem });
        }
        self.wish.validate()
    }
}

/// A rectangle with these half sides, lowered by `sag` in the middle (m).
fn sagging(mut rectangle: TriMesh, half: Vec2, sag: f32) -> TriMesh {
    for position in &mut rectangle.positions {
        let outward = Vec2::new(position.x, position.z) / half;
        position.y -= sag * (1.0 - 0.5 * outward.length_squared());
    }
    rectangle
}

/// The cells of a grid: half as many leaves as triangles, and rounder.
fn grid_cells(columns: u32, rows: u32) -> Vec<Feature> {
    let cell = |row: u32, column: u32| {
        let first = row * columns + column;
        Feature::Quad([first, first + 1, first + columns + 1, first + columns])
    };
    (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| cell(row, column))).collect()
}

fn bendings(mesh: &HalfEdgeMesh, positions: &[Vec3], compliance: Option<f32>) -> Vec<Bending> {
    let Some(compliance) = compliance else { return Vec::new() };
    let at_rest = |[start, end, first, second]: [u32; 4]| {
        let [e0, e1, w0, w1] = [start, end, first, second].map(|v| positions[v as usize]);
        let (angle, _) = crate::constraint::bending_gradient([w0, w1], [e0, e1])?;
        let limit = AngleLimit::Target(angle);
        Some(Bending { edge: [start, end], wings: [first, second], limit, compliance })
    };
    mesh.hinges().filter_map(at_rest).collect()
}
