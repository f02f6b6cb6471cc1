//! Bodies of a document to bodies of a world.

use std::collections::{BTreeMap, BTreeSet};
use std::f32::consts::PI;

use tautline::mesh::TriMesh;
use tautline::{AttachmentHandle, BodyHandle, Error, JointHandle, Quat, Vec3, World};

use super::attachment::{anchor, strength};
use super::cloth::sheet;
use super::cue::Cue;
use super::joint::joint;
use super::rigid::{rigid_body, surface, truss_body};
use super::shape::{Make, Solids};
use super::soft::SoftSolids;
use super::wall::{self, draw_walls};
use super::{Look, Part};
use crate::document::{
    self, Anchor, Attachment, Body, BodyRef, Cloth, Color, HalfSpace, Joint, Motion, Pin, Rigid, Room, Rope,
    RopeEnd, Rotation, SheetPlace, SoftSolid, Surface, Thread,
};
use crate::error::Problem;
use crate::render::palette;

/// Colour of what never moves.
pub(super) const GREY: [u8; 3] = [176, 180, 188];

/// Why a body was refused, and in which of its fields, such as `.shape`.
pub(crate) struct Refusal {
    pub(crate) field: &'static str,
    pub(crate) error: Error,
}

impl Refusal {
    /// As a problem of that body, its path beginning with its kind.
    pub(crate) fn of(&self, body: &Body) -> Problem {
        let path = format!("{}{}", body.kind(), self.field);
        Problem { path, message: self.error.to_string() }
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self { field: "", error }
    }
}

/// A world in the making.
#[derive(Debug)]
pub(crate) struct Builder {
    pub(crate) world: World,
    /// Every body that was added, in that order.
    pub(crate) parts: Vec<Part>,
    solids: Solids,
    soft_solids: SoftSolids,
    /// The bodies by all that the document can call them, with their indices in it; rooms are many.
    bodies: BTreeMap<BodyRef, (usize, BodyHandle)>,
    names: BTreeSet<String>,
    /// How many bodies have a colour from the palette.
    colored: usize,
}

impl Builder {
    pub(crate) fn new(world: World, has_trusses: bool) -> Self {
        Self {
            world,
            parts: Vec::new(),
            solids: Solids::new(has_trusses),
            soft_solids: SoftSolids::default(),
            bodies: BTreeMap::new(),
            names: BTreeSet::new(),
            colored: 0,
        }
    }

    /// Adds the document's body number `index`, which is called by `number` from now on.
    pub(crate) fn add(&mut self, index: usize, number: u32, body: &Body) -> Result<(), Refusal> {
        let name = body.name().map_or_else(|| format!("{} {index}", body.kind()), str::to_owned);
        match body {
            Body::Rigid(rigid) => self.add_rigid(name, rigid),
            Body::Cloth(cloth) => self.add_cloth(name, cloth),
            Body::Rope(rope) => self.add_rope(name, rope),
            Body::SoftSolid(solid) => self.add_soft_solid(name, solid),
            Body::HalfSpace(half_space) => self.add_half_space(name, half_space),
            Body::Room(room) => return self.add_room(&name, room),
        }?;
        if let Some(part) = self.parts.last() {
            let found = (index, part.body);
            self.bodies.insert(BodyRef::Index(number), found);
            self.bodies.extend(body.name().map(|name| (BodyRef::Name(name.to_owned()), found)));
        }
        Ok(())
    }

    fn add_rigid(&mut self, name: String, rigid: &Rigid) -> Result<(), Refusal> {
        let solid = self.solids.get(&rigid.shape).map_err(|error| Refusal { field: ".shape", error })?;
        let body = match solid.make {
            Make::Rigid(shape) => self.world.add(rigid_body(rigid, &shape)),
            Make::Truss { truss, origin, volume } => {
                self.world.add(truss_body(rigid, &truss, origin, volume))
            }
        }?;
        let color = match rigid.color {
            None if rigid.motion() == Motion::Fixed => GREY,
            given => self.color(given),
        };
        let look = if solid.is_round { Look::Round } else { Look::Solid };
        self.push(name, color, body, look(solid.surface));
        Ok(())
    }

    fn add_cloth(&mut self, name: String, cloth: &Cloth) -> Result<(), Refusal> {
        let body = self.world.add(sheet(cloth)?)?;
        for weight in &cloth.weights {
            self.weigh(body, sheet_particles(weight.at, &cloth.surface), weight.mass)?;
        }
        let color = self.color(cloth.color);
        self.push(name, color, body, Look::Sheet);
        Ok(())
    }

    fn add_rope(&mut self, name: String, rope: &Rope) -> Result<(), Refusal> {
        let builder = match rope.path {
            Thread::Line { from, to, segments } => tautline::Rope::straight(from.into(), to.into(), segments),
            Thread::Points(ref points) => {
                tautline::Rope::through(points.iter().copied().map(Vec3::from).collect())
            }
            Thread::Network { ref points, ref segments } => {
                let points = points.iter().copied().map(Vec3::from).collect();
                tautline::Rope::network(points, segments.clone())
            }
        };
        let mut builder = builder
            .radius(rope.radius)
            .velocity(rope.velocity.into())
            .mass(rope.mass)
            .friction(rope.friction)
            .self_collision(rope.self_collision);
        if let Some(length) = rope.length {
            builder = builder.length(length);
        }
        if let Some(compliance) = rope.bending {
            builder = builder.bending(compliance);
        }
        if let Some(stiffness) = rope.bending_stiffness {
            builder = builder.bending_stiffness(stiffness);
        }
        if let Some(compliance) = rope.compliance {
            builder = builder.compliance(compliance);
        }
        if let Some(degrees) = rope.least_angle_degrees {
            builder = builder.bend_limit(degrees.to_radians().min(PI));
        }
        for pin in &rope.pins {
            builder = builder.pin(rope_particle(*pin, &rope.path));
        }
        let body = self.world.add(builder)?;
        for weight in &rope.weights {
            self.weigh(body, vec![rope_particle(weight.at, &rope.path)], weight.mass)?;
        }
        let color = self.color(rope.color);
        self.push(name, color, body, Look::Tube { radius: rope.radius });
        Ok(())
    }

    fn add_soft_solid(&mut self, name: String, solid: &SoftSolid) -> Result<(), Refusal> {
        let (soft, skin) = self.soft_solids.get(solid)?;
        let body = self.world.add(soft)?;
        let color = self.color(solid.color);
        self.push(name, color, body, skin.map_or(Look::Sheet, Look::Skin));
        Ok(())
    }

    fn add_half_space(&mut self, name: String, half_space: &HalfSpace) -> Result<(), Refusal> {
        let HalfSpace { normal, offset, friction, restitution, rolling_friction, color, .. } = half_space;
        let wall = tautline::HalfSpace::new(Vec3::from(*normal), *offset);
        let wall = wall.surface(surface(*friction, *restitution, *rolling_friction));
        let body = self.world.add(wall)?;
        // What is drawn of it depends on where the other bodies are: see `finish`.
        self.push(name, color.map_or(GREY, |color| color.0), body, Look::Wall(TriMesh::default()));
        Ok(())
    }

    fn add_room(&mut self, name: &str, room: &Room) -> Result<(), Refusal> {
        for side in wall::sides(room) {
            let wall = tautline::HalfSpace::new(side.normal, side.offset);
            let wall = wall.surface(surface(room.friction, room.restitution, room.rolling_friction));
            let body = self.world.add(wall)?;
            let color = room.color.map_or(GREY, |color| color.0);
            self.push(format!("{name} {}", side.name), color, body, Look::Wall(side.mesh));
        }
        Ok(())
    }

    /// Adds a joint between bodies that have been added.
    pub(crate) fn join(&mut self, document: &Joint) -> Result<JointHandle, Error> {
        let (_, body) = self.find("body", &document.body)?;
        let base = document.base.as_ref().map(|base| self.find("base", base)).transpose()?;
        let base = base.map(|(_, base)| base);
        let center = self.world.body(body)?.center_of_mass();
        self.world.add_joint(joint(document, body, base, center))
    }

    /// Adds an attachment between bodies that have been added; `bodies` are those of the document.
    pub(crate) fn attach(
        &mut self,
        document: &Attachment,
        bodies: &[Body],
    ) -> Result<AttachmentHandle, Error> {
        let anchor_of = |end: &Anchor| {
            let found = end.body.as_ref().map(|body| self.find("body", body)).transpose()?;
            anchor(&self.world, &end.at, found.map(|(index, body)| (body, &bodies[index])))
        };
        let (a, b) = (anchor_of(&document.a)?, anchor_of(&document.b)?);
        self.world.attach(a, b, strength(document))
    }

    /// A cue for a body that has been added.
    pub(crate) fn cue(&self, document: &document::Cue) -> Result<Cue, Error> {
        let (_, body) = self.find("body", &document.body)?;
        let document::Cue { at, velocity, angular_velocity, .. } = *document;
        Ok(Cue { at, body, velocity: velocity.into(), angular_velocity: angular_velocity.into() })
    }

    fn find(&self, field: &str, body: &BodyRef) -> Result<(usize, BodyHandle), Error> {
        let problem = "it is no body of the scene that can be held".to_owned();
        self.bodies.get(body).copied().ok_or(Error::Invalid { field: field.to_owned(), problem })
    }

    fn weigh(&mut self, body: BodyHandle, particles: Vec<u32>, mass: f32) -> Result<(), Error> {
        particles.into_iter().try_for_each(|particle| self.world.set_particle_mass(body, particle, mass))
    }

    /// The colour given, or the next of the palette.
    fn color(&mut self, given: Option<Color>) -> [u8; 3] {
        given.map_or_else(
            || {
                self.colored += 1;
                palette(self.colored - 1)
            },
            |color| color.0,
        )
    }

    fn push(&mut self, mut name: String, color: [u8; 3], body: BodyHandle, look: Look) {
        // A name that was made up may be one that was given.
        while !self.names.insert(name.clone()) {
            name.push('\'');
        }
        self.parts.push(Part { name, color, body, look });
    }

    /// From now on a body is called by these numbers and no longer by its index in the document.
    pub(crate) fn renumber(&mut self, number: impl Fn(BodyHandle) -> Option<u32>) {
        let known = std::mem::take(&mut self.bodies).into_iter();
        let renamed = known.filter_map(|(name, found)| match name {
            BodyRef::Name(_) => Some((name, found)),
            BodyRef::Index(_) => number(found.1).map(|number| (BodyRef::Index(number), found)),
        });
        self.bodies.extend(renamed);
    }

    /// Whether there is a body of this name.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.bodies.contains_key(&BodyRef::Name(name.to_owned()))
    }

    /// Forgets what a body is called, which has been removed; returns its index in the document.
    pub(crate) fn forget(&mut self, body: BodyHandle) -> Option<usize> {
        let known = self.bodies.values().find(|(_, known)| *known == body).map(|(index, _)| *index);
        self.bodies.retain(|_, (_, known)| *known != body);
        known
    }

    /// Draws half-spaces so large that no edge is near a body.
    pub(crate) fn draw_walls(&mut self) {
        draw_walls(&self.world, &mut self.parts);
    }
}

/// The rotation as a unit quaternion.
pub(super) fn quaternion(rotation: Rotation) -> Quat {
    match rotation {
        Rotation::Quaternion(quaternion) => Quat::from_array(quaternion).normalize(),
        Rotation::AxisAngle(turn) => {
            Quat::from_axis_angle(Vec3::from(turn.axis).normalize(), turn.degrees.to_radians())
        }
    }
}

/// The particles at a place of a sheet; places are of grids only.
pub(super) fn sheet_particles(pin: Pin<SheetPlace>, surface: &Surface) -> Vec<u32> {
    let place = match pin {
        Pin::Index(index) => return vec![index],
        Pin::Place(place) => place,
    };
    let Surface::Grid { columns, rows, .. } = *surface else { return Vec::new() };
    let at = |column: u32, row: u32| row * columns + column;
    let (right, front) = (columns - 1, rows - 1);
    match place {
        SheetPlace::BackLeft => vec![at(0, 0)],
        SheetPlace::BackRight => vec![at(right, 0)],
        SheetPlace::FrontLeft => vec![at(0, front)],
        SheetPlace::FrontRight => vec![at(right, front)],
        SheetPlace::Corners => vec![at(0, 0), at(right, 0), at(0, front), at(right, front)],
        SheetPlace::Back => (0..columns).map(|column| at(column, 0)).collect(),
        SheetPlace::Front => (0..columns).map(|column| at(column, front)).collect(),
        SheetPlace::Left => (0..rows).map(|row| at(0, row)).collect(),
        SheetPlace::Right => (0..rows).map(|row| at(right, row)).collect(),
    }
}

pub(super) fn rope_particle(pin: Pin<RopeEnd>, path: &Thread) -> u32 {
    match pin {
        Pin::Index(index) => index,
        Pin::Place(RopeEnd::First) => 0,
        Pin::Place(RopeEnd::Last) => (path.point_count() - 1) as u32,
    }
}
