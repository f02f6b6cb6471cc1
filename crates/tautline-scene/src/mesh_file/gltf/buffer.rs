//! The bytes that a glTF document refers to: in the file itself, in its text, or in files beside it.

use std::borrow::Cow;
use std::path::Path;

use super::super::{Limits, Refusal, folder};
use super::base64;
use super::document::Document;

/// The bytes of every buffer.
pub(super) struct Buffers<'a> {
    bytes: Vec<Cow<'a, [u8]>>,
    outside: usize,
}

impl<'a> Buffers<'a> {
    pub(super) fn read(
        document: &Document,
        binary: Option<&'a [u8]>,
        folder: Option<&Path>,
        limits: &Limits,
    ) -> Result<Self, Refusal> {
        let mut buffers = Self { bytes: Vec::with_capacity(document.buffers.len()), outside: 0 };
        for (i, buffer) in document.buffers.iter().enumerate() {
            let refuse = |message: String| Refusal::at_field(format!("buffers[{i}].uri"), message);
            let bytes: Cow<[u8]> = match (buffer.uri.as_deref(), binary) {
                (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
                (None, _) => return Err(refuse("it is missing, and the file has no binary part".into())),
                (Some(uri), _) if uri.starts_with("data:") => base64::of_uri(uri).map_err(refuse)?.into(),
                (Some(uri), _) => {
                    let left = limits.file_bytes.saturating_sub(buffers.outside as u64);
                    let bytes = beside(uri, folder, left).map_err(refuse)?;
                    buffers.outside += bytes.len();
                    bytes.into()
                }
            };
            if (bytes.len() as u64) < buffer.byte_length {
                let message = format!("{}, but the buffer has {} bytes", buffer.byte_length, bytes.len());
                return Err(Refusal::at_field(format!("buffers[{i}].byteLength"), message));
            }
            buffers.bytes.push(bytes);
        }
        Ok(buffers)
    }

    pub(super) fn get(&self, buffer: u32) -> Option<&[u8]> {
        self.bytes.get(buffer as usize).map(|bytes| &**bytes)
    }

    /// Bytes that came from other files.
    pub(super) fn bytes_outside(&self) -> usize {
        self.outside
    }
}

/// The bytes of a file in the folder or below it.
fn beside(uri: &str, folder: Option<&Path>, most: u64) -> Result<Vec<u8>, String> {
    let folder = folder.ok_or("a buffer in another file, but there is only this one")?;
    let path = unescaped(uri).ok_or("an escaped name that is not UTF-8")?;
    if path.contains(':') {
        return Err("an address: only files beside this one are read".to_owned());
    }
    let file = folder::inside(folder, &path).map_err(|error| error.to_string())?;
    folder::read_limited(&file, most).map_err(|error| error.to_string())
}

/// A name with `%20` for a space and so on as it is.
fn unescaped(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => {
                let mut digit = || char::from(rest.next()?).to_digit(16);
                (digit()? * 16 + digit()?) as u8
            }
            other => other,
        });
    }
    String::from_utf8(bytes).ok()
}
