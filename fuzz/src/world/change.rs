//! Changes of bodies and of settings.

use tautline::{
    BodyHandle, BroadPhase, ClothSolver, Error, Grip, Instructions, Motion, Quat, Settings, Sleep, Vec3,
    World,
};

use super::make::{groups, surface};
use super::{Calls, SUBSTEPS};

impl Calls<'_> {
    pub(super) fn change(&mut self) {
        let Some(body) = self.body() else { return };
        let (vector, particle) = (self.input.vector(), self.input.index());
        if particle % 13 == 12 {
            self.grab(body, vector, Grip::default());
            return;
        }
        self.attempt(|world| match particle % 13 {
            0 => world.remove(body),
            1 => world.apply_force(body, vector),
            2 => world.apply_impulse(body, vector),
            3 => world.apply_torque(body, vector),
            4 => world.set_velocity(body, vector),
            5 => world.set_angular_velocity(body, vector),
            6 => world.set_pose(body, vector, Quat::from_xyzw(vector.x, 0.3, vector.z, 0.8)),
            7 => world.pin(body, particle),
            8 => world.set_particle_position(body, particle, vector),
            9 => world.set_particle_mass(body, particle, vector.x),
            10 => world.set_motion(body, if vector.x > 0.0 { Motion::Kinematic } else { Motion::Dynamic }),
            _ => world.set_rope_length(body, vector.x),
        });
    }

    /// What [`change`](Self::change) leaves out.
    pub(super) fn change_more(&mut self) {
        let Some(body) = self.body() else { return };
        let (what, vector, index) = (self.input.byte() % 16, self.input.vector(), self.input.index());
        let input = &mut self.input;
        if what >= 12 {
            let point = input.vector();
            self.change_at(body, what, [vector, point]);
            return;
        }
        match what {
            0 => self.attempt(|world| world.wake(body)),
            1 => self.attempt(|world| world.unpin(body, index)),
            2 => self.attempt(|world| world.apply_force_at(body, index, vector)),
            3 => self.attempt(|world| world.set_particle_velocity(body, index, vector)),
            4 => self.attempt(|world| world.apply_angular_impulse(body, vector)),
            5 => self.attempt(|world| world.set_gravity_scale(body, vector.x)),
            6 => self.attempt(|world| world.set_damping(body, vector.x, vector.y)),
            7 => {
                let groups = groups(input);
                self.attempt(|world| world.set_groups(body, groups))
            }
            8 => {
                let surface = surface(input);
                self.attempt(|world| world.set_surface(body, surface))
            }
            9 => self.attempt(|world| world.set_report_contacts(body, vector.x > 0.0)),
            10 => self.attempt(|world| world.set_pose(body, vector, Quat::IDENTITY)),
            _ => self.attempt(|world| world.set_motion(body, Motion::Fixed)),
        };
    }

    fn change_at(&mut self, body: BodyHandle, what: u8, [vector, point]: [Vec3; 2]) {
        match what {
            12 => {
                self.attempt(|world| world.apply_force_at_point(body, vector, point));
            }
            13 => {
                self.attempt(|world| world.apply_impulse_at_point(body, vector, point));
            }
            14 => {
                let velocities = self.input.flag();
                self.attempt(|world| set_all(world, body, velocities, [vector, point]));
            }
            _ => {
                let grip = Grip { frequency: vector.x, max_acceleration: vector.y };
                self.grab(body, point, grip);
            }
        }
    }

    fn grab(&mut self, body: BodyHandle, point: Vec3, grip: Grip) {
        let grabbed = self.attempt(|world| world.grab(body, point, grip));
        self.grabs.extend(grabbed);
    }

    pub(super) fn change_settings(&mut self) {
        let number = self.input.number();
        let old = self.world.settings().clone();
        let settings = match self.input.byte() % 10 {
            0 => Settings { gravity: self.input.vector(), ..old },
            1 => Settings { substeps: self.input.index() % (SUBSTEPS + 1), ..old },
            2 => Settings { features_per_pair: self.input.index(), ..old },
            3 => Settings { separation_speed: self.input.flag().then_some(number), ..old },
            4 => Settings { damping: number, air_density: self.input.number(), ..old },
            5 => Settings { sleep: Some(Sleep { speed: number, seconds: self.input.number() }), ..old },
            6 => Settings { cloth: ClothSolver::Paper, ..old },
            7 => Settings { cloth: ClothSolver::SmallSteps, ..old },
            8 => Settings { broad_phase: BroadPhase::AllPairs, ..old },
            _ => Settings { instructions: Instructions::Scalar, sleep: None, ..old },
        };
        self.attempt(|world| world.set_settings(settings));
    }
}

/// Sets the velocity or the position of every particle: they run from one vector to another.
fn set_all(
    world: &mut World,
    body: BodyHandle,
    velocities: bool,
    [from, to]: [Vec3; 2],
) -> Result<(), Error> {
    let count = world.body(body)?.positions().len();
    let between: Vec<Vec3> = (0..count).map(|i| from.lerp(to, i as f32 / count as f32)).collect();
    if velocities {
        world.set_particle_velocities(body, &between)
    } else {
        world.set_particle_positions(body, &between)
    }
}
