//! The binary container of glTF: a header of 12 bytes, a chunk of JSON and one of binary data (glTF 2.0, section 4).

use super::super::Refusal;
use super::super::disguise::without_mark;

/// The parts of a file.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    /// Bytes of the buffer without a name.
    pub(super) binary: Option<&'a [u8]>,
}

const HEADER: usize = 12;
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";

/// Takes a binary file apart; any other is JSON as a whole.
pub(super) fn parts(bytes: &[u8]) -> Result<Parts<'_>, Refusal> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Parts { json: without_mark(bytes), binary: None });
    }
    let number =
        |at: usize| bytes.get(at..).and_then(<[u8]>::first_chunk).map(|&four| u32::from_le_bytes(four));
    match number(4) {
        Some(2) => {}
        Some(version) => {
            return Err(Refusal::at_byte(4, format!("version {version} of glTF: only 2 is read")));
        }
        None => return Err(Refusal::at_byte(bytes.len(), "the file ends in its header")),
    }
    if number(8).map(|length| length as usize) != Some(bytes.len()) {
        let announced = number(8).unwrap_or(0);
        return Err(Refusal::at_byte(8, format!("it announces {announced} bytes and has {}", bytes.len())));
    }
    let (json, next) = chunk(bytes, HEADER)?.filter(|(kind, _, _)| kind == JSON).map_or_else(
        || Err(Refusal::at_byte(HEADER, "the first chunk is not JSON")),
        |(_, json, next)| Ok((json, next)),
    )?;
    let binary = chunk(bytes, next)?.filter(|(kind, _, _)| kind == BINARY).map(|(_, data, _)| data);
    Ok(Parts { json, binary })
}

/// What a chunk is, its bytes, and where the next one begins.
type Chunk<'a> = ([u8; 4], &'a [u8], usize);

/// The kind and the data of the chunk at a byte, and where the next begins; `None` at the end of the file.
fn chunk(bytes: &[u8], start: usize) -> Result<Option<Chunk<'_>>, Refusal> {
    if start == bytes.len() {
        return Ok(None);
    }
    let chunk = bytes[start..].split_first_chunk::<4>().and_then(|(length, rest)| {
        let length = u32::from_le_bytes(*length) as usize;
        let (kind, rest) = rest.split_first_chunk::<4>()?;
        Some((*kind, rest.get(..length)?, start + 8 + length))
    });
    chunk.map(Some).ok_or_else(|| Refusal::at_byte(start, "a chunk is longer than the file"))
}
