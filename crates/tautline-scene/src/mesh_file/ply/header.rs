//! The header of a PLY file: which elements follow, and how they are written.

use super::super::Refusal;
use super::super::disguise::without_mark;
use super::super::refusal::quoted;

/// How the elements are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A kind of number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A column of an element.
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// The kind of the number of entries, if it is a list.
    pub(super) list: Option<Kind>,
}

/// So many rows of the same columns.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// What a header says.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Bytes of the header.
    pub(super) length: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

impl Header {
    /// The element of this name.
    pub(super) fn element(&self, name: &str) -> Result<(usize, &Element), Refusal> {
        let found = self.elements.iter().enumerate().find(|(_, element)| element.name == name);
        found.ok_or_else(|| Refusal::new(format!("it has no element {name}")))
    }
}

/// Elements and properties that are counted one by one: more are no mesh.
const MOST_LINES: usize = 1000;

/// Reads the header at the beginning of a file.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, Refusal> {
    let (mut encoding, mut elements, mut length) = (None, Vec::new(), 0);
    for (i, line) in bytes.split_inclusive(|&byte| byte == b'\n').enumerate().take(MOST_LINES) {
        length += line.len();
        let number = i + 1;
        let refuse = |message: String| Refusal::at_line(number, message);
        let line = String::from_utf8_lossy(if i == 0 { without_mark(line) } else { line });
        let words: Vec<&str> = line.split_ascii_whitespace().take(6).collect();
        match words[..] {
            ["ply"] if i == 0 => {}
            // Behind such a header there may be numbers with any bytes.
            _ if i == 0 && line.starts_with("ply\r") => {
                return Err(refuse(
                    "the lines of the header end in CR alone: end them with LF or CR LF".into(),
                ));
            }
            _ if i == 0 => return Err(refuse("the first line of a PLY file is `ply`".into())),
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, _] if encoding.is_none() => encoding = Some(encoding_of(name).map_err(refuse)?),
            ["element", name, count] => {
                elements.push(element(name, count, &elements).map_err(refuse)?);
            }
            ["property", ref words @ ..] => {
                let element =
                    elements.last_mut().ok_or("a property of no element").map_err(|m| refuse(m.into()))?;
                element.properties.push(property(words).map_err(refuse)?);
            }
            ["end_header"] => {
                let encoding = encoding.ok_or_else(|| refuse("the header has no line `format`".into()))?;
                return Ok(Header { encoding, elements, length, lines: number });
            }
            _ => return Err(refuse(format!("{} is not a line of a PLY header", quoted(line.trim_ascii())))),
        }
    }
    Err(Refusal::new("the header does not end: a line `end_header` should follow"))
}

fn encoding_of(name: &str) -> Result<Encoding, String> {
    match name {
        "ascii" => Ok(Encoding::Text),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(format!(
            "the format {} is none of ascii, binary_little_endian, binary_big_endian",
            quoted(name)
        )),
    }
}

fn element(name: &str, count: &str, before: &[Element]) -> Result<Element, String> {
    if before.iter().any(|element| element.name == name) {
        return Err(format!("the element {} comes twice", quoted(name)));
    }
    let count = count.parse().map_err(|_| format!("{} is not a number of elements", quoted(count)))?;
    Ok(Element { name: name.to_owned(), count, properties: Vec::new() })
}

fn property(words: &[&str]) -> Result<Property, String> {
    match *words {
        ["list", count, kind, name] => {
            let list = kind_of(count)?;
            if matches!(list, Kind::F32 | Kind::F64) {
                return Err(format!("the length of a list is a whole number, not {}", quoted(count)));
            }
            Ok(Property { name: name.to_owned(), kind: kind_of(kind)?, list: Some(list) })
        }
        [kind, name] => Ok(Property { name: name.to_owned(), kind: kind_of(kind)?, list: None }),
        _ => Err("a property is `property TYPE NAME` or `property list TYPE TYPE NAME`".to_owned()),
    }
}

fn kind_of(name: &str) -> Result<Kind, String> {
    Ok(match name {
        "char" | "int8" => Kind::I8,
        "uchar" | "uint8" => Kind::U8,
        "short" | "int16" => Kind::I16,
        "ushort" | "uint16" => Kind::U16,
        "int" | "int32" => Kind::I32,
        "uint" | "uint32" => Kind::U32,
        "float" | "float32" => Kind::F32,
        "double" | "float64" => Kind::F64,
        _ => return Err(format!("{} is not a type of PLY, such as uchar, int or float", quoted(name))),
    })
}

impl Kind {
    /// Bytes in a binary file.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}
