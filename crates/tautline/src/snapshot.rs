//! A world as bytes, to be restored anywhere.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Serialize};

use crate::attachment::Attachments;
use crate::body::{Body, Substance, Truss};
use crate::collision::PairCache;
use crate::error::Error;
use crate::events::Contacts;
use crate::joint::Joints;
use crate::particles::Particles;
use crate::settings::Settings;
use crate::shape::Shape;
use crate::slots::Slots;
use crate::solver::soft::SoftSolver;
use crate::solver::substep::{Kept, RigidSolver};
use crate::world::{Grabs, Scratch, World};

const MAGIC: [u8; 8] = *b"tautline";
const VERSION: u32 = 8;

/// Everything but the trusses and shapes, which bodies share: each is stored once, and by its number for each body.
#[derive(Serialize, Deserialize)]
struct Stored {
    settings: Settings,
    particles: Particles,
    bodies: Vec<Body>,
    trusses: Vec<Truss>,
    truss_of_body: Vec<Option<u32>>,
    shapes: Vec<Shape>,
    shape_of_body: Vec<Option<u32>>,
    slots: Slots,
    pairs: PairCache,
    grabs: Grabs,
    joints: Joints,
    attachments: Attachments,
    rigid: Kept,
    contacts: Contacts,
    time: f64,
}

impl World {
    /// The whole world as bytes. A world restored from them goes on exactly as this one does, also on another
    /// platform, and knows the same handles.
    pub fn snapshot(&self) -> Vec<u8> {
        let (trusses, truss_of_body) = self.shared(|substance| match substance {
            Substance::Truss { truss } => Some(truss),
            _ => None,
        });
        let (shapes, shape_of_body) = self.shared(|substance| match substance {
            Substance::Rigid(rigid) => Some(&rigid.shape),
            _ => None,
        });
        let stored = Stored {
            settings: self.settings.clone(),
            particles: self.particles.clone(),
            bodies: self.bodies.clone(),
            trusses: trusses.into_iter().cloned().collect(),
            truss_of_body,
            shapes: shapes.into_iter().cloned().collect(),
            shape_of_body,
            slots: self.slots.clone(),
            pairs: self.pairs.clone(),
            grabs: self.grabs.clone(),
            joints: self.joints.clone(),
            attachments: self.attachments.clone(),
            rigid: self.rigid.kept(),
            contacts: self.contacts.clone(),
            time: self.time,
        };
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        // Writing plain data into memory has no way to fail.
        bytes.extend(postcard::to_stdvec(&stored).unwrap_or_default());
        bytes
    }

    /// The world that [`World::snapshot`] wrote.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are something else, of another version, cut off or inconsistent.
    pub fn restore(bytes: &[u8]) -> Result<Self, Error> {
        let body =
            bytes.strip_prefix(&MAGIC).ok_or_else(|| refuse("the bytes are not a snapshot of a world"))?;
        let (version, body) = body.split_first_chunk().ok_or_else(|| refuse("it ends too early"))?;
        let version = u32::from_le_bytes(*version);
        if version != VERSION {
            return Err(refuse(&format!("its version is {version}; this build reads version {VERSION}")));
        }
        let (stored, rest): (Stored, &[u8]) = postcard::take_from_bytes(body)
            .map_err(|error| refuse(&format!("it cannot be read: {error}")))?;
        if !rest.is_empty() {
            return Err(refuse("there are bytes behind its end"));
        }
        stored.into_world()
    }

    /// What bodies share, each once, and the number of each body's.
    fn shared<'a, T>(
        &'a self,
        of: impl Fn(&'a Substance) -> Option<&'a Arc<T>>,
    ) -> (Vec<&'a T>, Vec<Option<u32>>) {
        let mut shared: Vec<&T> = Vec::new();
        // By address: bodies share a thing by pointing at it. The numbers follow the order of the bodies.
        let mut known: BTreeMap<*const T, u32> = BTreeMap::new();
        let mut number_of = |thing: &'a Arc<T>| {
            *known.entry(Arc::as_ptr(thing)).or_insert_with(|| {
                shared.push(thing);
                shared.len() as u32 - 1
            })
        };
        let numbers = self.bodies.iter().map(|body| of(&body.substance).map(&mut number_of)).collect();
        (shared, numbers)
    }
}

impl Stored {
    fn into_world(mut self) -> Result<World, Error> {
        self.settings.validate().map_err(|error| refuse(&error.to_string()))?;
        self.particles.validate()?;
        self.trusses.iter().try_for_each(Truss::validate)?;
        let trusses: Vec<Arc<Truss>> = std::mem::take(&mut self.trusses).into_iter().map(Arc::new).collect();
        self.shapes.iter().try_for_each(Shape::validate)?;
        let shapes: Vec<Arc<Shape>> = std::mem::take(&mut self.shapes).into_iter().map(Arc::new).collect();
        let counts = [self.truss_of_body.len(), self.shape_of_body.len()];
        if counts.iter().any(|&count| count != self.bodies.len()) || !self.slots.is_valid(self.bodies.len()) {
            return Err(refuse("its lists of bodies disagree"));
        }
        let mut next = 0;
        let indices = self.truss_of_body.iter().zip(&self.shape_of_body);
        for (body, (&truss_index, &shape_index)) in self.bodies.iter_mut().zip(indices) {
            if let Substance::Truss { truss } = &mut body.substance {
                let found = truss_index.and_then(|index| trusses.get(index as usize));
                *truss = Arc::clone(found.ok_or_else(|| refuse("a body's truss is missing"))?);
            }
            if let Substance::Rigid(rigid) = &mut body.substance {
                let found = shape_index.and_then(|index| shapes.get(index as usize));
                rigid.shape = Arc::clone(found.ok_or_else(|| refuse("a body's shape is missing"))?);
            }
            body.validate(next)?;
            next = body.particles.end;
        }
        if next != self.particles.len() || !self.pairs.is_valid(self.bodies.len()) || !self.time.is_finite() {
            return Err(refuse("its particles or pairs disagree with its bodies"));
        }
        if !self.grabs.is_valid(&self.slots, &self.bodies) {
            return Err(refuse("it holds what is not there"));
        }
        if !self.joints.is_valid(self.bodies.len()) {
            return Err(refuse("its joints disagree with its bodies"));
        }
        if !self.attachments.is_valid(&self.bodies) {
            return Err(refuse("its attachments disagree with its bodies"));
        }
        if !self.contacts.is_valid(self.bodies.len()) {
            return Err(refuse("its contact events disagree with its bodies"));
        }
        let Self { settings, particles, bodies, slots, pairs, grabs, joints, attachments, .. } = self;
        let (rigid, contacts, time) = (self.rigid, self.contacts, self.time);
        let rigid = RigidSolver::restore(rigid, &bodies, &joints)
            .ok_or_else(|| refuse("its contacts disagree with its bodies"))?;
        let (index, scratch) = (OnceLock::new(), Scratch::default());
        let soft = SoftSolver::default();
        Ok(World {
            settings,
            particles,
            bodies,
            slots,
            pairs,
            joints,
            attachments,
            rigid,
            soft,
            contacts,
            grabs,
            index,
            time,
            scratch,
        })
    }
}

fn refuse(problem: &str) -> Error {
    Error::Snapshot(problem.into())
}
