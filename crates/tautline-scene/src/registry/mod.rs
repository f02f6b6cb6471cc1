//! The named scenes: the one place where the command line, tests and benchmarks get their scenes from. Each is
//! a function from parameters to a document, so that every scene can be written out, changed and read again.

mod bag;
mod balance;
mod bridge;
mod chain;
mod cloth;
mod flag;
mod frame;
mod garment;
mod hold;
mod impact;
mod jelly;
mod knot;
mod mesh_drop;
mod net;
mod parameter;
mod ragdoll;
mod rigid;
mod rope;
mod scan;
mod sculpture;
mod stacks;
mod table;
mod tear;
mod together;
mod trampoline;
mod window;

use crate::document::Scene;
use crate::error::Error;

pub use parameter::{Parameter, Parameters};

/// A scene with a name and parameters.
#[derive(Debug)]
pub struct NamedScene {
    /// Its name.
    pub name: &'static str,
    /// What there is to see, in a sentence.
    pub description: &'static str,
    /// What can be chosen.
    pub parameters: &'static [Parameter],
    document: fn(&Parameters) -> Scene,
}

impl NamedScene {
    /// Its parameters at their defaults, to be changed and given to [`NamedScene::document`].
    pub fn defaults(&self) -> Parameters {
        Parameters::defaults(self.name, self.parameters)
    }

    /// The scene's document for values of its own parameters.
    pub fn document(&self, parameters: &Parameters) -> Scene {
        Scene {
            name: self.name.to_owned(),
            description: self.description.to_owned(),
            ..(self.document)(parameters)
        }
    }
}

/// All named scenes.
pub fn scenes() -> &'static [NamedScene] {
    &[
        rigid::ICOSAHEDRA,
        cloth::CLOTH_ON_CUBE,
        cloth::CLOTH_ON_ROPE,
        stacks::TOWER,
        stacks::PYRAMID,
        stacks::MASS_RATIO,
        balance::ARCH,
        balance::CARD_HOUSE,
        balance::DOMINOES,
        impact::BULLETS,
        impact::MIXED_PILE,
        chain::CHAIN,
        ragdoll::RAGDOLL,
        cloth::HUNG_CLOTH,
        cloth::CURTAIN,
        rope::CATENARY,
        rope::WHIP,
        together::HAMMOCK,
        jelly::JELLY,
        table::TABLECLOTH,
        window::CURTAINS,
        net::NET,
        bridge::BRIDGE,
        bag::MARBLES,
        trampoline::TRAMPOLINE,
        knot::KNOT,
        garment::GARMENTS,
        flag::FLAG,
        tear::TEAR,
        mesh_drop::MESH_DROP,
        scan::SCAN_DRAPE,
    ]
}

/// The scene of a name.
///
/// # Errors
/// [`Error::UnknownScene`], which lists the names there are.
pub fn find(name: &str) -> Result<&'static NamedScene, Error> {
    let unknown = || Error::UnknownScene {
        name: name.to_owned(),
        known: scenes().iter().map(|scene| scene.name).collect(),
    };
    scenes().iter().find(|scene| scene.name == name).ok_or_else(unknown)
}
