//! What can be asked for on the command line.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};

use crate::Failure;
use crate::compare::Plan;
use crate::engine::Contender;
use crate::scene::{Room, Scene};

/// Compare tautline with rapier3d and Box3D on the same scenes, one thread each, sleeping off.
#[derive(Debug, Parser)]
#[command(name = "tautline-peers", version, max_term_width = 100)]
pub(crate) struct Arguments {
    /// Numbers of bodies; for each there is a scene.
    #[arg(long, value_delimiter = ',', default_value = "200,1000,4000")]
    n: Vec<usize>,
    /// Substeps of tautline; the others run with their own defaults.
    #[arg(long, value_delimiter = ',', default_value = "8,4", value_parser = clap::value_parser!(u32).range(1..=1000))]
    substeps: Vec<u32>,
    /// How often each engine runs each scene; the median counts.
    #[arg(long, default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeats: u32,
    /// Which rooms the bodies fall in.
    #[arg(long, value_enum, default_value_t = Room::Dense)]
    room: Room,
    /// Run only these engines.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "ours,rapier,box3d")]
    engines: Vec<EngineName>,
    /// Write the measurements as JSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Draw time per step; written as .svg and as .png beside it.
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) chart: Option<PathBuf>,
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
    /// What is to be run.
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
        let scenes = self.n.iter().map(|&n| Scene::read(self.room, n));
        Ok(Plan { scenes: scenes.collect::<Result<_, _>>()?, contenders, repeats: self.repeats })
    }
}
