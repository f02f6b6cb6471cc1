//! Constructors.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Quat, Vec3, dvec3};

use super::mass::{Frame, Mass};
use super::{Convex, Decomposition, Part, Shape, Surface};
use crate::error::{Error, all_coordinates, coordinates, within};
use crate::mesh::{TriMesh, convex_hull, primitives};

/// Sides of the prism that stands for a cylinder.
const CYLINDER_SIDES: u32 = 32;

/// Of the squared longest extent of the mass, how much the squared shortest is at least.
const THINNEST_SQUARED: f64 = 1e-10;

/// What a part is the hull of, in the shape's own frame, and the radius around it.
struct Core {
    points: Vec<DVec3>,
    radius: f32,
}

impl Shape {
    /// A ball around the origin, exact; radius in m. It is drawn as an icosphere of 642 vertices.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the radius is not from 1e-6 to 1e9.
    pub fn sphere(radius: f32) -> Result<Self, Error> {
        let r = length("radius", radius)?;
        let mass = Mass::symmetric(4.0 / 3.0 * PI * r * r * r, DVec3::splat(r * r / 5.0));
        let core = Core { points: vec![DVec3::ZERO], radius };
        Self::solid("radius", &mass, &[core], primitives::icosphere(radius, 3)?)
    }

    /// A box from −`half_extents` to `half_extents`, in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one is not from 1e-6 to 1e9; [`Error::Invalid`] if it is too thin.
    pub fn cuboid(half_extents: Vec3) -> Result<Self, Error> {
        let x = length("half_extents.x", half_extents.x)?;
        let y = length("half_extents.y", half_extents.y)?;
        let z = length("half_extents.z", half_extents.z)?;
        let mass = Mass::symmetric(8.0 * x * y * z, dvec3(x * x, y * y, z * z) / 3.0);
        let mesh = primitives::cuboid(half_extents)?;
        Self::solid("half_extents", &mass, &[Core::sharp(&mesh.positions)], mesh)
    }

    /// All points within `radius` of the segment from y = −`half_height` to y = `half_height`, exact; in m.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one is not from 1e-6 to 1e9; [`Error::Invalid`] if it is too thin.
    pub fn capsule(radius: f32, half_height: f32) -> Result<Self, Error> {
        let (r, h) = (length("radius", radius)?, length("half_height", half_height)?);
        // A cylinder and two half balls, whose centres of mass are 3/8 r beyond the cylinder's ends.
        let (cylinder, balls) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r * r * r);
        let across = cylinder * r * r / 4.0 + balls * r * r / 5.0;
        let along = cylinder * h * h / 3.0 + balls * (r * r / 5.0 + h * h + 0.75 * r * h);
        let volume = cylinder + balls;
        let mass = Mass::symmetric(volume, dvec3(across, along, across) / volume);
        let core = Core { points: vec![DVec3::NEG_Y * h, DVec3::Y * h], radius };
        Self::solid("half_height", &mass, &[core], primitives::capsule(radius, half_height, 32, 8)?)
    }

    /// A cylinder from y = −`half_height` to y = `half_height`, in m. It collides as a prism of 32 sides with its
    /// corners on the cylinder, so that it rolls as one; its volume and moments are those of the true cylinder.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one is not from 1e-6 to 1e9; [`Error::Invalid`] if it is too thin.
    pub fn cylinder(radius: f32, half_height: f32) -> Result<Self, Error> {
        let (r, h) = (length("radius", radius)?, length("half_height", half_height)?);
        let second_moments = dvec3(r * r / 4.0, h * h / 3.0, r * r / 4.0);
        let mass = Mass::symmetric(2.0 * PI * r * r * h, second_moments);
        let mesh = primitives::cylinder(radius, half_height, CYLINDER_SIDES)?;
        Self::solid("half_height", &mass, &[Core::sharp(&mesh.positions)], mesh)
    }

    /// The smallest convex solid around some points, in m. Neighbouring facets that are in one plane, to within some
    /// 2e-6 of its extent, become one face.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names a coordinate that is not from −1e9 to 1e9; [`Error::Invalid`] if the points span
    /// no volume, or too thin or too small a one, or more than 65 535 of them are corners.
    pub fn convex_hull(points: &[Vec3]) -> Result<Self, Error> {
        all_coordinates("points", points)?;
        let mesh = convex_hull(points).map_err(|error| of_field("points", error))?.mesh;
        let mass = Mass::of_mesh(&mesh).map_err(|error| of_field("points", error))?;
        Self::solid("points", &mass, &[Core::sharp(&mesh.positions)], mesh)
    }

    /// The inside of a closed mesh, in m. A concave one becomes a union of convex parts that follow it as
    /// [`Decomposition::default`] says; its mass is that of the mesh, exactly.
    ///
    /// # Errors
    /// [`Error::Mesh`] names the first defect: open, non-manifold, flipped, inside out, crossing itself, without
    /// volume; or says that it could not be divided. [`Error::OutOfRange`] names a coordinate that is not from −1e9
    /// to 1e9. [`Error::Invalid`] if it is too thin, or too small, or has more than 65 535 corners.
    pub fn from_mesh(mesh: &TriMesh) -> Result<Self, Error> {
        Self::decomposed(mesh, &Decomposition::default())
    }

    /// As [`Shape::from_mesh`], with parts as close to the mesh, or as few, as you like.
    ///
    /// # Errors
    /// As [`Shape::from_mesh`], and [`Error::OutOfRange`] for `max_parts`, `tolerance` and `max_corners`.
    pub fn decomposed(mesh: &TriMesh, decomposition: &Decomposition) -> Result<Self, Error> {
        decomposition.validate()?;
        let mass = Mass::of_mesh(mesh)?;
        all_coordinates("positions", &mesh.positions)?;
        let hull = convex_hull(&mesh.positions)?.mesh;
        let parts = decomposition.apply(mesh, &hull)?;
        let cores: Vec<Core> = parts.corners.iter().map(|corners| Core::sharp(corners)).collect();
        let shape = Self::solid("mesh", &mass, &cores, mesh.clone())?;
        Ok(Self { hull_excess: parts.excess as f32, hull_shortfall: parts.shortfall, ..shape })
    }

    /// The union of solids, each rotated, then translated (in m). Their masses are added, also where they overlap.
    ///
    /// # Errors
    /// [`Error::Invalid`] if there are none, or they are too far apart for their size; [`Error::OutOfRange`] names
    /// a coordinate that is not from −1e9 to 1e9 or a rotation that is not near a unit quaternion.
    pub fn compound(parts: &[(&Shape, Vec3, Quat)]) -> Result<Self, Error> {
        if parts.is_empty() {
            return Err(Error::Invalid { field: "parts".into(), problem: "there are none".into() });
        }
        let (mut masses, mut cores, mut display) = (Vec::new(), Vec::new(), TriMesh::default());
        let mut excess = 0.0;
        for (number, &(shape, translation, rotation)) in parts.iter().enumerate() {
            coordinates(&format!("parts[{number}].translation"), translation)?;
            if !shape.is_solid() {
                let problem = "a triangle mesh or height field has no inside".into();
                return Err(Error::Invalid { field: format!("parts[{number}].shape"), problem });
            }
            let expected = "a quaternion with a length near 1";
            within(&format!("parts[{number}].rotation"), rotation.length_squared(), 1e-6, 1e6, expected)?;
            let rotation = DMat3::from_quat(rotation.as_dquat().normalize());
            let place = |point: DVec3| rotation * point + translation.as_dvec3();
            excess += f64::from(shape.hull_excess) * shape.volume;
            masses.push(shape.mass().moved(rotation, translation.as_dvec3()));
            cores.extend(shape.parts.iter().map(|part| Core {
                points: part.convex.vertices.iter().map(|&p| place(shape.frame.leave(p))).collect(),
                radius: part.convex.radius,
            }));
            let first = display.positions.len() as u32;
            display.positions.extend(shape.positions().iter().map(|p| place(p.as_dvec3()).as_vec3()));
            display.triangles.extend(shape.triangles().iter().map(|t| t.map(|v| first + v)));
        }
        let mass = Mass::sum(&masses);
        let shape = Self::solid("parts", &mass, &cores, display)?;
        let shortfall = parts.iter().map(|(shape, ..)| shape.hull_shortfall).fold(0.0, f32::max);
        Ok(Self { hull_excess: (excess / mass.volume) as f32, hull_shortfall: shortfall, ..shape })
    }

    /// The triangles of a mesh, in m, which may be open. Only their front, from where they run counter-clockwise, is
    /// solid ground. For fixed and kinematic bodies; a solid is made by [`Shape::from_mesh`].
    ///
    /// # Errors
    /// [`Error::Mesh`] names the first defect; [`Error::OutOfRange`] a coordinate that is not from −1e9 to 1e9.
    pub fn triangle_mesh(mesh: &TriMesh) -> Result<Self, Error> {
        Surface::new(mesh.clone()).map(Self::hollow)
    }

    /// A landscape: `columns` × `rows` (2 – 2049 each) heights (Y, in m) at the corners of square cells of
    /// `cell_size` (m), row after row; columns along X, rows along Z, its middle at the origin. Every cell is cut
    /// from its corner of lowest x and z to the opposite one. For fixed and kinematic bodies.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the parameter or the height; [`Error::Invalid`] if there are too few heights or
    /// too many.
    pub fn height_field(columns: u32, rows: u32, cell_size: f32, heights: &[f32]) -> Result<Self, Error> {
        Surface::from_heights(columns, rows, cell_size, heights).map(Self::hollow)
    }

    pub(super) fn hollow(surface: Surface) -> Self {
        let positions = &surface.mesh().positions;
        let reach_squared = positions.iter().map(|p| p.length_squared()).fold(0.0, f32::max);
        Self {
            parts: Vec::new(),
            volume: 0.0,
            second_moments: DVec3::ZERO,
            frame: Frame::IDENTITY,
            reach: reach_squared.sqrt(),
            inner_radius: 0.0,
            hull_excess: 0.0,
            hull_shortfall: 0.0,
            display: TriMesh::default(),
            surface: Some(surface),
        }
    }

    /// A union of parts with this mass; `field` is blamed for what cannot be.
    fn solid(field: &str, mass: &Mass, cores: &[Core], display: TriMesh) -> Result<Self, Error> {
        let (frame, second_moments) = mass.principal();
        if second_moments.min_element() < THINNEST_SQUARED * second_moments.max_element() {
            let problem = "it is thinner than a 100000th of its length".into();
            return Err(Error::Invalid { field: field.into(), problem });
        }
        let part = |core: &Core| {
            let points: Vec<Vec3> = core.points.iter().map(|&point| frame.enter(point)).collect();
            Convex::around(&points, core.radius).map(Part::from).map_err(|error| of_field(field, error))
        };
        let parts: Vec<Part> = cores.iter().map(part).collect::<Result<_, _>>()?;
        let (reach, inner_radius) = Part::extent_of(&parts);
        within(field, reach, 1e-6, 4e9, "a size from 1e-6 to 1e9")?;
        Ok(Self {
            parts,
            volume: mass.volume,
            second_moments,
            frame,
            reach,
            inner_radius,
            hull_excess: 0.0,
            hull_shortfall: 0.0,
            display,
            surface: None,
        })
    }

    /// As it was given, in its own frame.
    fn mass(&self) -> Mass {
        Mass::symmetric(self.volume, self.second_moments).moved(self.frame.axes, self.frame.center)
    }
}

impl Core {
    /// The hull of points without a radius.
    fn sharp(points: &[Vec3]) -> Self {
        Self { points: points.iter().map(|point| point.as_dvec3()).collect(), radius: 0.0 }
    }
}

fn length(field: &str, value: f32) -> Result<f64, Error> {
    within(field, value, 1e-6, 1e9, "a length from 1e-6 to 1e9 m").map(f64::from)
}

/// The error of a mesh that was made from this field.
fn of_field(field: &str, error: Error) -> Error {
    match error {
        Error::Mesh(defect) => Error::Invalid { field: field.into(), problem: defect.to_string() },
        Error::Invalid { problem, .. } => Error::Invalid { field: field.into(), problem },
        other => other,
    }
}
