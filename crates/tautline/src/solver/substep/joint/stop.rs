//! Rows with bounds: limits, motors and springs.

use crate::joint::{Mode, Push, Spring, Stop};

use super::assembly::Pace;
use super::work::RECOVERY;

/// What f32 does not tell, in m or rad.
const SLACK: f32 = 1e-6;

/// A row with bounds in this substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Its coordinate at the start of the substep, in m or rad.
    pub(super) now: f32,
    /// The mass that it moves: the inverse of how much its bodies give way.
    pub(super) mass: f32,
    /// How fast the coordinate changed in the last substep, in m/s.
    pub(super) rate: f32,
    /// In m/N.
    pub(super) compliance: f32,
}

/// What comes of the motions as they are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lead {
    /// The coordinate at the end of the substep, in m or rad.
    pub(super) ahead: f32,
    /// How much it changes.
    pub(super) way: f32,
    pub(super) multiplier: f32,
}

/// What a row is to do: to lead to `goal` up to `softness` times its multiplier, if it is held. The
/// goal of a motor is a way.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Aim {
    pub(super) is_held: bool,
    pub(super) goal: f32,
    pub(super) softness: f32,
    /// How much of the way there undoes an error.
    pub(super) undone: f32,
}

impl Aim {
    /// What is beyond its bound comes back no faster than the limit.
    fn bound(row: &Row, goal: f32, undone: f32, softness: f32) -> Self {
        Self { is_held: true, goal: if undone == 0.0 { goal } else { row.now + undone }, softness, undone }
    }
}

pub(super) fn aim(stop: &Stop, mode: Mode, row: &Row, pace: &Pace) -> Aim {
    let softness = row.compliance / (pace.h * pace.h);
    match (mode, stop.push) {
        // A rod.
        (Mode::AtLow, _) if stop.low >= stop.high && softness == 0.0 => {
            let undone = ((stop.low - row.now) * RECOVERY).clamp(-pace.limit, pace.limit);
            Aim::bound(row, stop.low, undone, softness)
        }
        (Mode::AtLow, _) => Aim::bound(row, stop.low, (stop.low - row.now).clamp(0.0, pace.limit), softness),
        (Mode::AtHigh, _) => {
            Aim::bound(row, stop.high, (stop.high - row.now).clamp(-pace.limit, 0.0), softness)
        }
        (Mode::Within, Some(Push::Motor(motor))) => {
            Aim { is_held: true, goal: motor.speed * pace.h, ..Aim::default() }
        }
        (Mode::Within, Some(Push::Spring(spring, length))) => spring_aim(spring, length, row, pace),
        (Mode::Within, None) | (Mode::Forwards | Mode::Backwards, _) => Aim::default(),
    }
}

/// A spring by Newmark's method with the mean acceleration (β = ¼), which keeps the energy of one without damping,
/// whatever its stiffness: λ = −k h² (x + β (x' − 2 x + x⁻)) − c h (γ (x' − x) + (1 − γ) (x − x⁻)). γ is ½, and more
/// for what would otherwise swing through in one substep.
fn spring_aim(spring: Spring, length: f32, row: &Row, pace: &Pace) -> Aim {
    let angular = std::f32::consts::TAU * spring.frequency * pace.h;
    let stiffness = row.mass * angular * angular;
    let damping = 2.0 * spring.damping_ratio * angular;
    let gamma = (1.0 - 1.0 / damping.max(f32::MIN_POSITIVE)).max(0.5);
    let damping = damping * row.mass;
    let (offset, last) = (row.now - length, row.rate * pace.h);
    let constant =
        stiffness * ((1.0 - BETA) * offset - BETA * last) + damping * ((1.0 - gamma) * last - gamma * offset);
    let slope = stiffness * BETA + damping * gamma;
    Aim { is_held: true, goal: length - constant / slope, softness: 1.0 / slope, undone: 0.0 }
}

const BETA: f32 = 0.25;

/// The multiplier of a row that is not held.
pub(super) fn fixed_multiplier(stop: &Stop, mode: Mode, pace: &Pace) -> Option<f32> {
    match (mode, stop.push) {
        (Mode::Forwards, Some(Push::Motor(motor))) => Some(motor.strength * pace.h * pace.h),
        (Mode::Backwards, Some(Push::Motor(motor))) => Some(-motor.strength * pace.h * pace.h),
        (Mode::Within, None) => Some(0.0),
        _ => None,
    }
}

/// What the row does next, seeing where motions lead.
pub(super) fn next_mode(stop: &Stop, mode: Mode, lead: &Lead, pace: &Pace) -> Mode {
    let &Lead { ahead, way, multiplier } = lead;
    if stop.low >= stop.high {
        return Mode::AtLow;
    }
    let motor = match stop.push {
        Some(Push::Motor(motor)) => Some(motor),
        Some(Push::Spring(..)) | None => None,
    };
    let strongest = motor.map_or(0.0, |motor| motor.strength * pace.h * pace.h);
    // A bound only pushes. The motor's share in the multiplier is all it can give, the way it wants to go.
    let share = match motor {
        Some(motor) if motor.speed > 0.0 => strongest,
        Some(motor) if motor.speed < 0.0 => -strongest,
        _ => 0.0,
    };
    let wanted = motor.map_or(0.0, |motor| motor.speed * pace.h);
    match mode {
        Mode::AtLow if multiplier >= share => mode,
        Mode::AtHigh if multiplier <= share => mode,
        Mode::AtLow | Mode::AtHigh => Mode::Within,
        _ if ahead < stop.low - SLACK => Mode::AtLow,
        _ if ahead > stop.high + SLACK => Mode::AtHigh,
        _ if motor.is_none() => Mode::Within,
        Mode::Within if multiplier > strongest => Mode::Forwards,
        Mode::Within if multiplier < -strongest => Mode::Backwards,
        Mode::Forwards if way > wanted + SLACK => Mode::Within,
        Mode::Backwards if way < wanted - SLACK => Mode::Within,
        _ => mode,
    }
}
