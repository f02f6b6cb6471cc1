//! Panics become traps.
//!
//! In a browser nobody hears what a panic says: the instance traps, and the package says that it can no longer be used.
//! So what does nothing but lead to a panic need not be sent: messages, where they are from, and how they are written.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::ops::Range;

use walrus::ir::{Call, Const, Instr, InstrSeqId, Unreachable, Value};
use walrus::{ConstExpr, DataKind, FunctionId, FunctionKind, LocalFunction, Module};

/// Makes traps of all calls that end in a trap, and clears what only they refer to.
pub(crate) fn trap(module: &mut Module) {
    let doomed = doomed(module);
    let mut cut = BTreeSet::new();
    for (_, function) in module.funcs.iter_local_mut() {
        for sequence in sequences(function) {
            cut_short(function, sequence, &doomed, &mut cut);
        }
    }
    walrus::passes::gc::run(module);
    clear_places(module, &cut);
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

/// Ends a sequence where its doom is certain, and notes the constants that are gone.
fn cut_short(
    function: &mut LocalFunction,
    sequence: InstrSeqId,
    doomed: &HashSet<FunctionId>,
    cut: &mut BTreeSet<u32>,
) {
    let instructions = &mut function.block_mut(sequence).instrs;
    let is_end = |instruction: &Instr| match instruction {
        Instr::Unreachable(_) => true,
        _ => called(instruction).is_some_and(|function| doomed.contains(&function)),
    };
    let Some(end) = instructions.iter().position(|(instruction, _)| is_end(instruction)) else { return };
    let stays = |(instruction, _): &(Instr, _)| leads_elsewhere(instruction);
    let start = instructions[..end].iter().rposition(stays).map_or(0, |last| last + 1);
    cut.extend(instructions[start..end].iter().filter_map(|(instruction, _)| number(instruction)));
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

/// Clears the places in the source (file, line and column) that panics would have named: nothing refers to them any more.
fn clear_places(module: &mut Module, cut: &BTreeSet<u32>) {
    let mut used = HashSet::new();
    for (_, function) in module.funcs.iter_local() {
        for sequence in sequences(function) {
            used.extend(
                function.block(sequence).instrs.iter().filter_map(|(instruction, _)| number(instruction)),
            );
        }
    }
    let segments: Vec<_> = module.data.iter().map(|data| data.id()).collect();
    for segment in segments {
        let data = module.data.get_mut(segment);
        let DataKind::Active { offset: ConstExpr::Value(Value::I32(start)), .. } = data.kind else {
            continue;
        };
        let base = start as u32;
        used.extend((0..data.value.len() / 4).filter_map(|index| word(&data.value, 4 * index)));
        let mut cleared = Vec::new();
        for &address in cut.difference(&used.iter().copied().collect()) {
            let Some(at) = address.checked_sub(base) else { continue };
            if let Some(ranges) = place_in_source(&data.value, at as usize, base) {
                cleared.extend(ranges);
            }
        }
        cleared.into_iter().for_each(|range| data.value[range].fill(0));
    }
}

/// The ranges of a `core::panic::Location` and of the name in it: address and length of a file's name, line, column.
fn place_in_source(bytes: &[u8], at: usize, base: u32) -> Option<[Range<usize>; 2]> {
    let [name, length, line, column] = [0, 4, 8, 12].map(|offset| word(bytes, at + offset));
    let start = name?.checked_sub(base)? as usize;
    let name = start..start.checked_add(length? as usize)?;
    let is_place = bytes.get(name.clone())?.ends_with(b".rs") && line? > 0 && column? > 0;
    is_place.then_some([at..at + 16, name])
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at.checked_add(4)?)?.try_into().ok().map(u32::from_le_bytes)
}

fn called(instruction: &Instr) -> Option<FunctionId> {
    match instruction {
        Instr::Call(Call { func }) | Instr::ReturnCall(walrus::ir::ReturnCall { func }) => Some(*func),
        _ => None,
    }
}

fn number(instruction: &Instr) -> Option<u32> {
    match instruction {
        Instr::Const(Const { value: Value::I32(value) }) => Some(*value as u32),
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
