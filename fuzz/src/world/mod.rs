//! Random calls of a world: of every kind, with numbers of every kind. What is refused leaves no trace, and nothing ever
//! panics or is not finite.

mod add;
mod ask;
mod change;
mod input;
mod make;
mod shapes;
mod tie;

use input::Input;
use tautline::body::BodyDescription;
use tautline::{AttachmentHandle, BodyHandle, Error, GrabHandle, JointHandle, Settings, World};

/// Most bodies of one input, those of them that are soft, most steps, and the substeps of a step: few, since runs are to
/// be many.
const MOST_BODIES: usize = 6;
const MOST_SOFT: usize = 3;
const MOST_STEPS: u32 = 8;
const SUBSTEPS: u32 = 2;
/// Most snapshots that an input asks for.
const MOST_RESTORED: u32 = 1;

/// Makes the calls that the bytes stand for. To look at refusals takes a snapshot before every call, a quarter of the time.
pub(crate) fn run(bytes: &[u8], looks_at_refusals: bool) {
    let settings = Settings { substeps: SUBSTEPS, ..Settings::default() };
    let mut calls = Calls {
        input: Input(bytes),
        world: World::new(settings).expect("sound settings"),
        looks_at_refusals,
        snapshot: None,
        bodies: Vec::new(),
        joints: Vec::new(),
        attachments: Vec::new(),
        grabs: Vec::new(),
        soft: 0,
        steps: 0,
        restored: 0,
    };
    while !calls.input.is_over() {
        calls.next();
    }
    let world = &calls.world;
    assert!(world.positions().iter().all(|position| position.is_finite()));
    let restored = World::restore(&world.snapshot()).expect("a snapshot is whole");
    assert_eq!(restored.state_hash(), world.state_hash());
}

struct Calls<'a> {
    input: Input<'a>,
    world: World,
    looks_at_refusals: bool,
    /// Of the world as it is, if that is known: a snapshot takes as long as a small step.
    snapshot: Option<Vec<u8>>,
    /// These are also of what has been removed.
    bodies: Vec<BodyHandle>,
    joints: Vec<JointHandle>,
    attachments: Vec<AttachmentHandle>,
    grabs: Vec<GrabHandle>,
    soft: usize,
    steps: u32,
    restored: u32,
}

impl Calls<'_> {
    /// The kinds from 192 to 239 came later than the seeds, of which the other bytes are.
    fn next(&mut self) {
        match self.input.byte() {
            192..=203 => self.add(make::body),
            204..=219 => self.change_more(),
            220..=227 => self.change_tie(),
            228..=233 => self.look(),
            234..=239 => self.change_settings(),
            byte => match byte % 24 {
                0..=4 => self.add(add::body),
                5..=8 => self.step(),
                9 => self.join(),
                10 => self.attach(),
                11 => self.ask(),
                12 => self.restore(),
                13 => {
                    let wind = self.input.vector();
                    self.attempt(|world| world.set_wind(wind));
                }
                _ => self.change(),
            },
        }
    }

    /// Makes a call that may be refused, and then leaves no trace.
    fn attempt<R>(&mut self, call: impl FnOnce(&mut World) -> Result<R, Error>) -> Option<R> {
        if !self.looks_at_refusals {
            return call(&mut self.world).ok();
        }
        let before = self.snapshot.take().unwrap_or_else(|| self.world.snapshot());
        let result = call(&mut self.world);
        if result.is_err() {
            assert!(self.world.snapshot() == before, "refused, but not without a trace");
            self.snapshot = Some(before);
        }
        result.ok()
    }

    fn body(&mut self) -> Option<BodyHandle> {
        choose(&self.bodies, self.input.byte())
    }

    /// Adds what comes next, if there is room for it.
    fn add(&mut self, next: fn(&mut Input<'_>) -> Result<BodyDescription, Error>) {
        use BodyDescription::{Cloth, Rope, SoftSolid};
        if self.world.bodies().len() >= MOST_BODIES {
            return;
        }
        let Ok(body) = next(&mut self.input) else { return };
        let is_soft = matches!(body, Cloth(_) | Rope(_) | SoftSolid(_));
        if is_soft && self.soft == MOST_SOFT {
            return;
        }
        if let Some(added) = self.attempt(|world| world.add(body)) {
            self.bodies.push(added);
            self.soft += usize::from(is_soft);
        }
    }

    fn step(&mut self) {
        if self.steps >= MOST_STEPS {
            return;
        }
        if !self.input.byte().is_multiple_of(8) {
            self.steps += 1;
            self.snapshot = None;
            self.world.step(1.0 / 60.0).expect("a usual time");
            return;
        }
        let dt = self.input.number();
        // Cloth and rope make so many small steps a second.
        let is_long = self.soft > 0 && dt > 1.0 / 60.0 && dt <= 1.0;
        self.steps += if is_long { (dt * 60.0) as u32 } else { 1 };
        if self.steps <= MOST_STEPS {
            self.attempt(|world| world.step(dt));
        }
    }

    fn restore(&mut self) {
        if self.restored < MOST_RESTORED {
            self.restored += 1;
            self.world = World::restore(&self.world.snapshot()).expect("a snapshot is whole");
        }
    }
}

/// One of these, if there is any.
fn choose<T: Copy>(items: &[T], byte: u8) -> Option<T> {
    items.get(usize::from(byte) % items.len().max(1)).copied()
}
