//! Panics become traps.
//!
//! In a browser nobody hears what a panic says: the instance traps, and the package says that it can no longer be used.
//! So what does nothing but lead to a panic need not be sent: messages, where they are from, and how they are written.

use std::collections::{HashMap, HashSet};

use walrus::ir::{Call, Instr, InstrSeqId, Unreachable};
use walrus::{FunctionId, FunctionKind, LocalFunction, Module};

/// Makes traps of all calls that end in a trap, and leaves out what only they need.
pub(crate) fn trap(module: &mut Module) {
    let doomed = doomed(module);
    for (_, function) in module.funcs.iter_local_mut() {
        for sequence in sequences(function) {
            cut_short(function, sequence, &doomed);
        }
    }
    walrus::passes::gc::run(module);
}

/// The functions that never return and call nothing outside: all that they can do is trap.
fn doomed(module: &Module) -> HashSet<FunctionId> {
    let mut calls: HashMap<FunctionId, Vec<FunctionId>> = HashMap::new();
    for (id, function) in module.funcs.iter_local() {
        let instructions =
            sequences(function).into_iter().flat_map(|sequence| &function.block(sequence).instrs);
        calls.insert(id, instructions.filter_map(|(instruction, _)| called(instruction)).collect());
    }
    let is_import = |function: &&walrus::Function| matches!(function.kind, FunctionKind::Import(_));
    let mut heard: HashSet<FunctionId> = module.funcs.iter().filter(is_import).map(|f| f.id()).collect();
    grow(
        &mut heard,
        |heard, id| calls.get(&id).is_some_and(|calls| calls.iter().any(|f| heard.contains(f))),
        &calls,
    );
    let mut doomed = HashSet::new();
    let is_doomed = |doomed: &HashSet<FunctionId>, id: FunctionId| {
        let function = module.funcs.get(id).kind.unwrap_local();
        !heard.contains(&id) && !Ways::of(function, doomed).lead_back
    };
    grow(&mut doomed, is_doomed, &calls);
    doomed
}

/// Adds functions to a set until no more belong to it.
fn grow(
    set: &mut HashSet<FunctionId>,
    belongs: impl Fn(&HashSet<FunctionId>, FunctionId) -> bool,
    all: &HashMap<FunctionId, Vec<FunctionId>>,
) {
    loop {
        let more: Vec<FunctionId> =
            all.keys().copied().filter(|id| !set.contains(id) && belongs(set, *id)).collect();
        if more.is_empty() {
            return;
        }
        set.extend(more);
    }
}

/// Where control goes in a function.
struct Ways<'a> {
    function: &'a LocalFunction,
    doomed: &'a HashSet<FunctionId>,
    /// Sequences that something branches out of.
    left: HashSet<InstrSeqId>,
    /// Whether it may return.
    lead_back: bool,
}

impl<'a> Ways<'a> {
    fn of(function: &'a LocalFunction, doomed: &'a HashSet<FunctionId>) -> Self {
        let mut ways = Self { function, doomed, left: HashSet::new(), lead_back: false };
        ways.lead_back |= ways.passes(function.entry_block());
        ways
    }

    /// Follows a sequence; whether what is behind it may be reached.
    fn passes(&mut self, sequence: InstrSeqId) -> bool {
        for (instruction, _) in &self.function.block(sequence).instrs {
            let goes_on = match instruction {
                Instr::Block(block) => self.passes(block.seq),
                // A branch to a loop leads to its start.
                Instr::Loop(body) => self.passes(body.seq),
                Instr::IfElse(two) => self.passes(two.consequent) | self.passes(two.alternative),
                Instr::Br(branch) => {
                    self.left.insert(branch.block);
                    false
                }
                Instr::BrIf(branch) => {
                    self.left.insert(branch.block);
                    true
                }
                Instr::BrTable(table) => {
                    self.left.extend(table.blocks.iter().chain([&table.default]));
                    false
                }
                Instr::Call(Call { func }) => !self.doomed.contains(func),
                Instr::Unreachable(_) => false,
                Instr::Return(_) | Instr::ReturnCall(_) | Instr::ReturnCallIndirect(_) => {
                    self.lead_back = true;
                    false
                }
                _ => true,
            };
            if !goes_on {
                return self.left.contains(&sequence);
            }
        }
        true
    }
}

/// Ends a sequence where its doom is certain.
fn cut_short(function: &mut LocalFunction, sequence: InstrSeqId, doomed: &HashSet<FunctionId>) {
    let instructions = &mut function.block_mut(sequence).instrs;
    let is_end = |instruction: &Instr| match instruction {
        Instr::Unreachable(_) => true,
        _ => called(instruction).is_some_and(|function| doomed.contains(&function)),
    };
    let Some(end) = instructions.iter().position(|(instruction, _)| is_end(instruction)) else { return };
    let stays = |(instruction, _): &(Instr, _)| leads_elsewhere(instruction);
    let start = instructions[..end].iter().rposition(stays).map_or(0, |last| last + 1);
    let place = instructions[end].1;
    instructions.truncate(start);
    instructions.push((Instr::Unreachable(Unreachable {}), place));
}

/// Whether an instruction may do more than change what is lost with the instance.
fn leads_elsewhere(instruction: &Instr) -> bool {
    !matches!(
        instruction,
        Instr::LocalGet(_)
            | Instr::LocalSet(_)
            | Instr::LocalTee(_)
            | Instr::GlobalGet(_)
            | Instr::GlobalSet(_)
            | Instr::Const(_)
            | Instr::Binop(_)
            | Instr::Unop(_)
            | Instr::Select(_)
            | Instr::Load(_)
            | Instr::Store(_)
            | Instr::MemoryCopy(_)
            | Instr::Drop(_)
    )
}

fn called(instruction: &Instr) -> Option<FunctionId> {
    match instruction {
        Instr::Call(Call { func }) | Instr::ReturnCall(walrus::ir::ReturnCall { func }) => Some(*func),
        _ => None,
    }
}

/// All sequences of a function.
fn sequences(function: &LocalFunction) -> Vec<InstrSeqId> {
    let mut all = vec![function.entry_block()];
    let mut next = 0;
    while let Some(&sequence) = all.get(next) {
        next += 1;
        for (instruction, _) in &function.block(sequence).instrs {
            match instruction {
                Instr::Block(block) => all.push(block.seq),
                Instr::Loop(body) => all.push(body.seq),
                Instr::IfElse(two) => all.extend([two.consequent, two.alternative]),
                _ => {}
            }
        }
    }
    all
}
