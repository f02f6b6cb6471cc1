//! What other engines get in the same cases: measured once, on one machine, with steps of 1/60 s (MuJoCo: 2 ms) and
//! nothing put to sleep.

use serde::Serialize;

/// An engine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Peer {
    /// Its name.
    pub name: &'static str,
    /// The version that was measured.
    pub version: &'static str,
    /// How it was set.
    pub settings: &'static str,
}

/// The engines that there are figures of.
pub const PEERS: [Peer; 2] = [
    Peer { name: "rapier3d", version: "0.36.1", settings: "defaults: 4 solver iterations" },
    Peer { name: "MuJoCo", version: "4.0.0", settings: "steps of 2 ms" },
];

/// Errors of the peers in a case, in the order of [`PEERS`]: the quantity that they do worst in.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Figure {
    /// The case.
    pub id: u32,
    /// What is off.
    pub quantity: &'static str,
    /// Our demand, in the unit of the errors.
    pub demand: f64,
    /// One for each engine; `None` where it was not measured.
    pub errors: [Option<f64>; 2],
}

const fn figure(id: u32, quantity: &'static str, demand: f64, errors: [Option<f64>; 2]) -> Figure {
    Figure { id, quantity, demand, errors }
}

const FIGURES: [Figure; 22] = [
    figure(1, "m", 1e-4, [Some(0.041), Some(0.020)]),
    figure(2, "m", 2e-5, [Some(2e-5), None]),
    figure(3, "share of the first apex", 1e-3, [Some(0.018), None]),
    figure(4, "share of the apex", 5e-3, [Some(0.031), None]),
    figure(5, "share of the speed", 1e-5, [Some(2e-7), None]),
    figure(7, "share of tan θ", 3e-4, [Some(3.4e-4), Some(0.073)]),
    figure(8, "mm", 0.05, [Some(0.17), Some(129.0)]),
    figure(9, "share of the way", 5e-4, [Some(2.5e-3), Some(5.6e-4)]),
    figure(10, "share of the way", 5e-4, [Some(2.5e-3), Some(1.1e-3)]),
    figure(11, "share of the acceleration", 2e-3, [Some(2.2e-3), None]),
    figure(12, "share of tan θ", 3e-3, [Some(0.011), None]),
    figure(13, "mm of penetration", 0.25, [Some(5.0), Some(0.3)]),
    figure(14, "mm of penetration, of 20", 0.5, [Some(10.5), Some(0.5)]),
    figure(15, "mm", 1.0, [Some(28.0), Some(0.8)]),
    figure(16, "share of the period", 1e-3, [Some(0.32), Some(2e-6)]),
    figure(17, "share of the energy", 1e-2, [Some(0.39), Some(0.38)]),
    figure(18, "share of the energy", 1e-3, [Some(0.048), Some(0.22)]),
    figure(19, "share of the time", 3e-3, [Some(0.092), None]),
    figure(20, "share of the sag", 2e-4, [Some(0.268), None]),
    figure(21, "share of the length, 10 ×", 1e-3, [Some(0.22), None]),
    figure(22, "bullets that got through", 0.0, [Some(0.0), Some(40.0)]),
    figure(23, "mm of penetration", 5.0, [Some(43.6), None]),
];

/// What the peers get, by case.
pub fn figures() -> &'static [Figure] {
    &FIGURES
}

impl Figure {
    /// The errors in units of the demand.
    pub fn ratios(&self) -> [Option<f64>; 2] {
        self.errors.map(|error| {
            error.map(|error| match error {
                0.0 => 0.0,
                // More than none is infinitely more.
                _ => error / self.demand,
            })
        })
    }
}
