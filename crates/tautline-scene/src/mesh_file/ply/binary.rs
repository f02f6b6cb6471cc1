//! Numbers as bytes.

use super::super::Refusal;
use super::header::{Element, Kind};
use super::source::{Source, check_room};

/// The bytes after the header.
#[derive(Clone)]
pub(super) struct Binary<'a> {
    rest: &'a [u8],
    /// Bytes of the file.
    length: usize,
    is_big_endian: bool,
}

impl<'a> Binary<'a> {
    pub(super) fn new(file: &'a [u8], start: usize, is_big_endian: bool) -> Self {
        Self { rest: &file[start..], length: file.len(), is_big_endian }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Refusal> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| {
            Refusal::at_byte(self.length, format!("the file ends where {count} more bytes should be"))
        })?;
        self.rest = rest;
        Ok(taken)
    }

    /// The next bytes, the least significant first.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Refusal> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N)?);
        if self.is_big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn number(&mut self, kind: Kind) -> Result<f64, Refusal> {
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Kind::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Kind::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Kind::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Kind::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Kind::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Kind::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Kind::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }
}

impl Source for Binary<'_> {
    fn check_room(&self, element: &Element) -> Result<(), Refusal> {
        let row =
            element.properties.iter().map(|property| property.list.unwrap_or(property.kind).size()).sum();
        check_room(element, row, self.rest.len()).map_err(|message| self.refuse(message))
    }

    fn integer(&mut self, kind: Kind) -> Result<i64, Refusal> {
        let number = self.number(kind)?;
        // Whole numbers of up to 32 bits are exact in f64.
        if number == f64::from(number as i32) || number == f64::from(number as u32) {
            return Ok(number as i64);
        }
        Err(self.refuse(format!("{number} is not a whole number")))
    }

    fn coordinate(&mut self, kind: Kind) -> Result<f32, Refusal> {
        let number = self.number(kind)? as f32;
        if number.is_finite() {
            Ok(number)
        } else {
            Err(self.refuse("a coordinate that is not finite".into()))
        }
    }

    fn skip(&mut self, kind: Kind, count: usize) -> Result<(), Refusal> {
        self.take(count.saturating_mul(kind.size())).map(|_| ())
    }

    fn refuse(&self, message: String) -> Refusal {
        Refusal::at_byte(self.length - self.rest.len(), message)
    }

    fn remaining(&self) -> usize {
        self.rest.len()
    }
}
