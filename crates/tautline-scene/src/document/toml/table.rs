//! Tables while they are read: headers come back to a table until the text ends, or, in a list of tables, until the next one
//! begins. What is complete becomes JSON.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::{Entry, VacantEntry};
use std::fmt::Write;

use super::trail::Trail;
use super::{Outcome, Refusal};

/// A name in a text.
pub(super) struct Key<'a> {
    pub(super) name: Cow<'a, str>,
    pub(super) offset: usize,
}

/// Keys with dots between them.
pub(super) struct Path<'a> {
    pub(super) outer: Vec<Key<'a>>,
    pub(super) last: Key<'a>,
}

/// Counts the keys of tables that are not complete: each takes some hundred bytes.
#[derive(Default)]
pub(super) struct OpenKeys(usize);

impl OpenKeys {
    /// A scene has a hundred: all that is not in a list, and one item of each list.
    const MOST: usize = 500;

    fn add(&mut self, offset: usize) -> Outcome {
        if self.0 == Self::MOST {
            let message = format!("there are more than {} keys in tables that are not complete", Self::MOST);
            return Err(Refusal::new(offset, message));
        }
        self.0 += 1;
        Ok(())
    }
}

/// What has made a table, and so what may still add to it.
#[derive(Clone, Copy, PartialEq)]
enum Origin {
    /// A header of its own, or a bracket: further headers add tables.
    Own,
    /// The header of a table in it: a header of its own, dotted keys and further headers.
    Inner,
    /// A dotted key: dotted keys and further headers.
    Dotted,
}

/// A table that is not complete.
pub(super) struct Table<'a> {
    origin: Origin,
    /// With the offsets of their keys: they are written in the order of the text, so that what is wrong first is told first.
    members: BTreeMap<Cow<'a, str>, (usize, Member<'a>)>,
}

enum Member<'a> {
    /// What is complete, as JSON.
    Value(String),
    Table(Table<'a>),
    Tables(Box<Tables<'a>>),
}

/// A list of tables that have headers.
struct Tables<'a> {
    count: usize,
    /// All but the last, as JSON.
    complete: String,
    last: Table<'a>,
}

/// A table that a header leads into, with its index if it is of a list.
type Entered<'t, 'a> = (&'t mut Table<'a>, Option<usize>);

/// Where a value goes.
pub(super) struct Place<'t, 'a> {
    entry: VacantEntry<'t, Cow<'a, str>, (usize, Member<'a>)>,
    offset: usize,
}

impl Place<'_, '_> {
    pub(super) fn put(self, json: String) {
        self.entry.insert((self.offset, Member::Value(json)));
    }
}

impl<'a> Table<'a> {
    /// The document, or an inline table.
    pub(super) fn new() -> Self {
        Self::made_by(Origin::Own)
    }

    fn made_by(origin: Origin) -> Self {
        Self { origin, members: BTreeMap::new() }
    }

    /// The place of a new value, which is at `value_offset`, and the trail there.
    pub(super) fn place<'s>(
        &mut self,
        path: Path<'a>,
        value_offset: usize,
        mut trail: Trail<'s>,
        open: &mut OpenKeys,
    ) -> Outcome<(Place<'_, 'a>, Trail<'s>)> {
        let mut table = self;
        for key in path.outer {
            trail = trail.key(&key.name, key.offset);
            table = table.enter_by_dot(key, open)?;
        }
        let Key { name, offset } = path.last;
        let trail = trail.key(&name, value_offset);
        match table.members.entry(name) {
            Entry::Vacant(entry) => {
                open.add(offset)?;
                Ok((Place { entry, offset }, trail))
            }
            Entry::Occupied(_) => Err(is_there(offset)),
        }
    }

    /// The table that a header begins, and the trail there: `[path]`, or `[[path]]`, which is of a list.
    pub(super) fn begin<'s>(
        &mut self,
        path: Path<'a>,
        is_of_list: bool,
        mut trail: Trail<'s>,
        open: &mut OpenKeys,
    ) -> Outcome<(&mut Self, Trail<'s>)> {
        let Path { outer, last } = path;
        let mut table = self;
        for key in outer {
            let (offset, outside) = (key.offset, trail.key(&key.name, key.offset));
            let (inner, index) = table.enter_by_header(key, open)?;
            (table, trail) = (inner, outside.item_if(index, offset));
        }
        let (offset, outside) = (last.offset, trail.key(&last.name, last.offset));
        let (table, index) =
            if is_of_list { table.begin_item(last, open)? } else { (table.begin_own(last, open)?, None) };
        Ok((table, outside.item_if(index, offset)))
    }

    fn enter_by_dot(&mut self, key: Key<'a>, open: &mut OpenKeys) -> Outcome<&mut Self> {
        let offset = key.offset;
        match self.member(key, open, || Member::Table(Self::made_by(Origin::Dotted)))? {
            Member::Table(table) if table.origin != Origin::Own => {
                table.origin = Origin::Dotted;
                Ok(table)
            }
            // The library `toml` lets a dotted key into a table of the last of the list; TOML does not.
            Member::Tables(_) => {
                Err(Refusal::new(offset, "it is a list of tables: a dotted key adds nothing to it"))
            }
            _ => Err(Refusal::new(offset, "it is there already: a dotted key adds nothing to it")),
        }
    }

    fn enter_by_header(&mut self, key: Key<'a>, open: &mut OpenKeys) -> Outcome<Entered<'_, 'a>> {
        let offset = key.offset;
        match self.member(key, open, || Member::Table(Self::made_by(Origin::Inner)))? {
            Member::Table(table) => Ok((table, None)),
            Member::Tables(tables) => Ok(tables.enter_last()),
            Member::Value(_) => Err(Refusal::new(offset, "it is a value: a header adds nothing to it")),
        }
    }

    fn begin_own(&mut self, key: Key<'a>, open: &mut OpenKeys) -> Outcome<&mut Self> {
        let offset = key.offset;
        match self.member(key, open, || Member::Table(Self::made_by(Origin::Inner)))? {
            Member::Table(table) if table.origin == Origin::Inner => {
                table.origin = Origin::Own;
                Ok(table)
            }
            _ => Err(is_there(offset)),
        }
    }

    fn begin_item(&mut self, key: Key<'a>, open: &mut OpenKeys) -> Outcome<Entered<'_, 'a>> {
        let offset = key.offset;
        let none = || Tables { count: 0, complete: String::new(), last: Self::new() };
        match self.member(key, open, || Member::Tables(Box::new(none())))? {
            Member::Tables(tables) => {
                if tables.count > 0 {
                    tables.complete_last(open);
                }
                tables.count += 1;
                Ok(tables.enter_last())
            }
            _ => Err(is_there(offset)),
        }
    }

    /// What a key stands for, made if it is new.
    fn member(
        &mut self,
        key: Key<'a>,
        open: &mut OpenKeys,
        new: impl FnOnce() -> Member<'a>,
    ) -> Outcome<&mut Member<'a>> {
        let (_, member) = match self.members.entry(key.name) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => {
                open.add(key.offset)?;
                entry.insert((key.offset, new()))
            }
        };
        Ok(member)
    }

    /// Writes what is complete now.
    pub(super) fn write(self, json: &mut String, open: &mut OpenKeys) {
        open.0 -= self.members.len();
        let mut members: Vec<_> = self.members.into_iter().collect();
        members.sort_unstable_by_key(|(_, (offset, _))| *offset);
        json.push('{');
        for (i, (name, (_, member))) in members.into_iter().enumerate() {
            if i > 0 {
                json.push(',');
            }
            write_string(&name, json);
            json.push(':');
            member.write(json, open);
        }
        json.push('}');
    }
}

impl Member<'_> {
    fn write(self, json: &mut String, open: &mut OpenKeys) {
        match self {
            Self::Value(value) => json.push_str(&value),
            Self::Table(table) => table.write(json, open),
            Self::Tables(mut tables) => {
                tables.complete_last(open);
                json.push('[');
                json.push_str(&tables.complete);
                json.push(']');
            }
        }
    }
}

impl<'a> Tables<'a> {
    fn enter_last(&mut self) -> Entered<'_, 'a> {
        (&mut self.last, Some(self.count - 1))
    }

    fn complete_last(&mut self, open: &mut OpenKeys) {
        if !self.complete.is_empty() {
            self.complete.push(',');
        }
        std::mem::replace(&mut self.last, Table::new()).write(&mut self.complete, open);
    }
}

fn is_there(offset: usize) -> Refusal {
    Refusal::new(offset, "there is something of this name already")
}

/// Writes a string of JSON. Sign by sign, since a copy of it may be three times as long as the file.
pub(super) fn write_string(text: &str, json: &mut String) {
    json.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => json.extend(['\\', c]),
            '\n' => json.push_str("\\n"),
            '\0'..' ' => _ = write!(json, "\\u{:04x}", u32::from(c)),
            _ => json.push(c),
        }
    }
    json.push('"');
}
