//! What a file turns out to be that is not what its name says.

use super::Refusal;

/// The text behind the mark that some editors begin UTF-8 with.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// What bytes are that are no text in UTF-8 with lines, and what to do about it, if they tell.
pub(crate) fn unmasked(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => Some("it is text in UTF-16: save it as UTF-8"),
        [0x1f, 0x8b, ..] => Some("it is packed by gzip: unpack it first"),
        [b'P', b'K', 3, 4, ..] => Some("it is a ZIP archive: unpack it first"),
        _ if bytes.contains(&b'\r') && !bytes.iter().any(|byte| matches!(byte, b'\n' | 0)) => {
            Some("its lines end in CR alone: save it with LF or CR LF")
        }
        _ => None,
    }
}

/// Says of bytes that were refused what they are, if they tell.
pub(super) fn explain(bytes: &[u8], refusal: Refusal) -> Refusal {
    unmasked(bytes).map_or(refusal, Refusal::new)
}
