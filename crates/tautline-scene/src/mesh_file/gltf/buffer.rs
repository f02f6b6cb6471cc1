//! The bytes that a glTF document refers to: in the file itself, in its text, or in files beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::super::{Limits, Refusal, folder};
use super::base64;
use super::document::Document;

/// The bytes of every buffer.
pub(super) struct Buffers<'a> {
    bytes: Vec<Bytes<'a>>,
    outside: usize,
}

enum Bytes<'a> {
    /// In the file.
    Here(&'a [u8]),
    /// In its text, or in a file beside it, of which several buffers may be.
    Read(Rc<Vec<u8>>),
}

impl<'a> Buffers<'a> {
    pub(super) fn read(
        document: &Document,
        binary: Option<&'a [u8]>,
        folder: Option<&Path>,
        limits: &Limits,
    ) -> Result<Self, Refusal> {
        let mut beside = Beside { folder, left: limits.file_bytes, files: BTreeMap::new(), named: 0 };
        let mut buffers = Vec::with_capacity(document.buffers.len());
        for (i, buffer) in document.buffers.iter().enumerate() {
            let refuse = |message: String| Refusal::at_field(format!("buffers[{i}].uri"), message);
            let bytes = match (buffer.uri.as_deref(), binary) {
                (None, Some(binary)) if i == 0 => Bytes::Here(binary),
                (None, _) => return Err(refuse("it is missing, and the file has no binary part".into())),
                (Some(uri), _) if uri.starts_with("data:") => {
                    Bytes::Read(Rc::new(base64::of_uri(uri).map_err(refuse)?))
                }
                (Some(uri), _) => Bytes::Read(beside.read(uri).map_err(refuse)?),
            };
            let length = bytes.as_slice().len();
            if (length as u64) < buffer.byte_length {
                let message = format!("{}, but the buffer has {length} bytes", buffer.byte_length);
                return Err(Refusal::at_field(format!("buffers[{i}].byteLength"), message));
            }
            buffers.push(bytes);
        }
        Ok(Self { bytes: buffers, outside: (limits.file_bytes - beside.left) as usize })
    }

    pub(super) fn get(&self, buffer: u32) -> Option<&[u8]> {
        self.bytes.get(buffer as usize).map(Bytes::as_slice)
    }

    /// Bytes that came from other files.
    pub(super) fn bytes_outside(&self) -> usize {
        self.outside
    }
}

impl Bytes<'_> {
    fn as_slice(&self) -> &[u8] {
        match self {
            Self::Here(bytes) => bytes,
            Self::Read(bytes) => bytes,
        }
    }
}

/// Buffers that may be in other files: finding one takes long beside reading its name.
const MOST_NAMES: usize = 1000;

/// Files in the folder or below it.
struct Beside<'a> {
    folder: Option<&'a Path>,
    /// Bytes that may still be read.
    left: u64,
    /// Those read, each once, by their true paths.
    files: BTreeMap<PathBuf, Rc<Vec<u8>>>,
    /// How often one was named.
    named: usize,
}

impl Beside<'_> {
    fn read(&mut self, uri: &str) -> Result<Rc<Vec<u8>>, String> {
        let folder = self.folder.ok_or("a buffer in another file, but there is only this one")?;
        let path = unescaped(uri).ok_or("an escaped name that is not UTF-8")?;
        if path.contains(':') {
            return Err("an address: only files beside this one are read".to_owned());
        }
        self.named += 1;
        if self.named > MOST_NAMES {
            return Err(format!("more than {MOST_NAMES} buffers in other files"));
        }
        let file = folder::inside(folder, &path).map_err(|error| error.to_string())?;
        if let Some(known) = self.files.get(&file) {
            return Ok(Rc::clone(known));
        }
        let bytes = Rc::new(folder::read_limited(&file, self.left).map_err(|error| error.to_string())?);
        self.left -= bytes.len() as u64;
        self.files.insert(file, Rc::clone(&bytes));
        Ok(bytes)
    }
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
