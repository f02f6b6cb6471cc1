//! What can be asked for on the command line.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};

use crate::Failure;
use crate::cloth::{self, Support};
use crate::compare::Plan;
use crate::engine::Contender;
use crate::scene::{Room, Scene};

/// Compare tautline with rapier3d and Box3D on the same scenes, one thread each, sleeping off; Box3D has no cloth.
#[derive(Debug, Parser)]
#[command(name = "tautline-peers", version, max_term_width = 100)]
pub(crate) struct Arguments {
    /// Run only these experiments.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "e1,e2,e3")]
    only: Vec<Experiment>,
    /// With e1, its numbers of bodies, for each of which there is a scene [default: 200,1000,4000]; without, particles
    /// along each side of the cloth [default: 20,40,100].
    #[arg(long, value_delimiter = ',')]
    n: Option<Vec<u32>>,
    /// Substeps of tautline; the others run with their own defaults.
    #[arg(long, value_delimiter = ',', default_value = "8,4", value_parser = clap::value_parser!(u32).range(1..=1000))]
    substeps: Vec<u32>,
    /// How often each engine runs each scene of bodies; the median counts.
    #[arg(long, default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeats: u32,
    /// How many times each engine lets each cloth fall, each time a little different; rapier above 60 × 60 only once.
    #[arg(long, default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    starts: u32,
    /// Which rooms the bodies fall in.
    #[arg(long, value_enum, default_value_t = Room::Dense)]
    room: Room,
    /// Run only these engines.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "ours,rapier,box3d")]
    engines: Vec<EngineName>,
    /// Write the measurements as JSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Draw time per step, as .svg and as .png beside it: of bodies in FILE.svg, of cloth in FILE-cloth.svg.
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) chart: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Experiment {
    /// Icosahedra fall in a room.
    E1,
    /// A cloth falls on a cube.
    E2,
    /// A cloth falls on a rope.
    E3,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum EngineName {
    /// tautline, once for every number of substeps.
    Ours,
    /// rapier3d.
    Rapier,
    /// Box3D.
    Box3d,
}

impl Arguments {
    /// What is to be run with bodies; without scenes if nothing is.
    pub(crate) fn plan(&self) -> Result<Plan, Failure> {
        let mut contenders = Vec::new();
        if self.engines.contains(&EngineName::Ours) {
            contenders.extend(self.substeps.iter().map(|&substeps| Contender::Ours { substeps }));
        }
        if self.engines.contains(&EngineName::Rapier) {
            contenders.push(Contender::Rapier);
        }
        if self.engines.contains(&EngineName::Box3d) {
            contenders.push(Contender::Box3d);
        }
        let numbers = match &self.n {
            _ if !self.only.contains(&Experiment::E1) => &[][..],
            Some(numbers) => numbers,
            None => &[200, 1000, 4000],
        };
        let scenes = numbers.iter().map(|&n| Scene::read(self.room, n as usize));
        Ok(Plan { scenes: scenes.collect::<Result<_, _>>()?, contenders, repeats: self.repeats })
    }

    /// What is to be run with cloth.
    pub(crate) fn cloth_plan(&self) -> Result<cloth::Plan, Failure> {
        let mut makes = Vec::new();
        if self.engines.contains(&EngineName::Ours) {
            makes.push(cloth::Make::Ours);
        }
        if self.engines.contains(&EngineName::Rapier) {
            makes.push(cloth::Make::Rapier);
        }
        let both =
            |&make: &cloth::Make| [true, false].map(|on| cloth::Contender { make, self_collision: on });
        let supports = [(Experiment::E2, Support::Cube), (Experiment::E3, Support::Rope)];
        let asked_for = supports.into_iter().filter(|(experiment, _)| self.only.contains(experiment));
        let resolutions = match &self.n {
            Some(numbers) if !self.only.contains(&Experiment::E1) => numbers.clone(),
            _ => vec![20, 40, 100],
        };
        if let Some(n) = resolutions.iter().find(|n| !(2..=1024).contains(*n)) {
            return Err(format!("--n {n}: a cloth has 2 to 1024 particles along each side").into());
        }
        Ok(cloth::Plan {
            supports: asked_for.map(|(_, support)| support).collect(),
            resolutions,
            contenders: makes.iter().flat_map(both).collect(),
            starts: self.starts,
        })
    }
}
