//! A recording as an animated GIF.

use std::io::Write;
use std::path::Path;

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use rayon::prelude::*;

use super::atomic::{io_error, write_atomically};
use super::palette::{Palette, TRANSPARENT};
use crate::Error;
use crate::recording::Recording;
use crate::render::{Image, Renderer, Scratch, Settings};

/// How long the last picture stays before the animation starts over, in hundredths of a second.
const PAUSE: usize = 100;
/// Pictures from which the palette is made, spread over the whole time.
const PALETTE_PICTURES: usize = 16;
/// Pictures drawn at once: bounds memory, and is enough to keep every core busy.
const BATCH: usize = 16;
/// A pixel is left as it was while each of its channels is within this of what is shown.
const TOLERANCE: u8 = 3;
/// Height of the dither pattern, in steps of a channel: about the distance between neighbouring colours.
const DITHER: i32 = 8;

/// Writes an endless animation with at most `frame_rate` pictures a second, in real time; `progress` is told
/// (pictures done, pictures to do). The bytes do not depend on the number of threads.
///
/// # Errors
/// [`Error::Io`] if the file cannot be written; [`Error::Unsupported`] if `frame_rate` is not between 1 and 50
/// (a GIF counts hundredths of a second, and browsers show nothing faster) or a setting is out of its range;
/// [`Error::Recording`] if the recording contradicts itself.
pub fn write_gif(
    recording: &Recording,
    path: &Path,
    settings: Settings,
    frame_rate: f32,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), Error> {
    if !(1.0..=50.0).contains(&frame_rate) {
        let problem = format!("{frame_rate} is not between 1 and 50 pictures a second");
        return Err(Error::Unsupported { option: "frame_rate", problem });
    }
    let renderer = Renderer::new(recording, settings)?;
    let schedule = schedule(recording, frame_rate);
    write_atomically(path, |out| {
        let palette = palette(&renderer, &schedule);
        let mut animation = Animation::new(out, palette, settings).map_err(|e| refused(path, e))?;
        let mut done = 0;
        progress(done, schedule.len());
        for batch in schedule.chunks(BATCH) {
            let pictures = pictures(&renderer, batch);
            for (picture, shot) in pictures.iter().zip(batch) {
                animation.push(picture, shot.hundredths).map_err(|e| refused(path, e))?;
                done += 1;
                progress(done, schedule.len());
            }
        }
        Ok(())
    })
}

/// A frame of the recording and how long it is shown, in hundredths of a second.
#[derive(Clone, Copy)]
struct Shot {
    frame: usize,
    hundredths: u16,
}

/// Shots in real time at the given rate or the recording's, whichever is less. The first and the last frame are
/// among them.
fn schedule(recording: &Recording, frame_rate: f32) -> Vec<Shot> {
    let last = recording.frame_count() - 1;
    let step = (recording.frame_rate / frame_rate).max(1.0);
    let mut frames: Vec<usize> =
        (0..).map(|k| (k as f32 * step).round() as usize).take_while(|&f| f < last).collect();
    frames.push(last);
    let at = |frame: usize| (100.0 * recording.time_of(frame)).round() as usize;
    let ends = frames.iter().skip(1).map(|&next| at(next)).chain([at(last) + PAUSE]);
    let shown = frames.iter().zip(ends);
    shown
        .map(|(&frame, end)| Shot { frame, hundredths: (end - at(frame)).min(u16::MAX.into()) as u16 })
        .collect()
}

fn palette(renderer: &Renderer, schedule: &[Shot]) -> Palette {
    let count = schedule.len().min(PALETTE_PICTURES);
    let spread = (0..count).map(|i| &schedule[i * (schedule.len() - 1) / (count - 1).max(1)]);
    Palette::new(&pictures(renderer, &spread.copied().collect::<Vec<_>>()))
}

/// Draws on as many cores as there are.
fn pictures(renderer: &Renderer, shots: &[Shot]) -> Vec<Image> {
    let draw = |scratch: &mut Scratch, shot: &Shot| renderer.frame_with(shot.frame, scratch);
    shots.par_iter().map_init(Scratch::default, draw).collect()
}

/// A GIF in the making: each picture is stored as what changed since the one before.
struct Animation<W: Write> {
    encoder: Encoder<W>,
    palette: Palette,
    width: usize,
    /// The colours that the pixels on show were made from.
    shown: Option<Vec<[u8; 3]>>,
}

impl<W: Write> Animation<W> {
    fn new(out: W, palette: Palette, settings: Settings) -> Result<Self, gif::EncodingError> {
        // Sizes fit: they are at most `render::MAX_SIZE`.
        let mut encoder = Encoder::new(out, settings.width as u16, settings.height as u16, &palette.bytes())?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self { encoder, palette, width: settings.width as usize, shown: None })
    }

    fn push(&mut self, picture: &Image, hundredths: u16) -> Result<(), gif::EncodingError> {
        let indices = self.changes(picture);
        let [left, top, right, bottom] = extent(&indices, self.width);
        let rows = indices.chunks_exact(self.width).take(bottom).skip(top);
        let buffer: Vec<u8> = rows.flat_map(|row| &row[left..right]).copied().collect();
        self.encoder.write_frame(&Frame {
            delay: hundredths,
            dispose: DisposalMethod::Keep,
            transparent: Some(TRANSPARENT),
            left: left as u16,
            top: top as u16,
            width: (right - left) as u16,
            height: (bottom - top) as u16,
            buffer: buffer.into(),
            ..Frame::default()
        })
    }

    /// Palette indices of the pixels that differ from what is shown; the others are transparent.
    fn changes(&mut self, picture: &Image) -> Vec<u8> {
        let fresh = self.shown.is_none();
        let shown = self.shown.get_or_insert_with(|| picture.pixels.clone());
        let pixels = picture.pixels.iter().zip(shown).enumerate();
        pixels
            .map(|(i, (&color, shown))| {
                if !fresh && (0..3).all(|c| color[c].abs_diff(shown[c]) <= TOLERANCE) {
                    return TRANSPARENT;
                }
                *shown = color;
                let offset = dither(i % self.width, i / self.width);
                self.palette.index(color.map(|c| (c as i32 + offset).clamp(0, 255) as u8))
            })
            .collect()
    }
}

/// The least rectangle (left, top, right, bottom) around all pixels that change; one pixel if none does.
fn extent(indices: &[u8], width: usize) -> [usize; 4] {
    let mut extent = [usize::MAX, usize::MAX, 0, 0];
    for (y, row) in indices.chunks_exact(width).enumerate() {
        let changes = |&index: &u8| index != TRANSPARENT;
        if let (Some(first), Some(last)) = (row.iter().position(changes), row.iter().rposition(changes)) {
            let [left, top, right, _] = extent;
            extent = [left.min(first), top.min(y), right.max(last + 1), y + 1];
        }
    }
    if extent[2] == 0 { [0, 0, 1, 1] } else { extent }
}

/// Ordered dithering by Bayer's 8 × 8 matrix: fixed to the picture, so that what stands still does not flicker.
fn dither(x: usize, y: usize) -> i32 {
    let (x, y) = (x as i32, y as i32);
    let rank = (0..3).fold(0, |rank, bit| {
        let (bx, by) = (x >> bit & 1, y >> bit & 1);
        rank << 2 | (bx ^ by) << 1 | by
    });
    (2 * rank - 63) * DITHER / 128
}

fn refused(path: &Path, error: gif::EncodingError) -> Error {
    let source = match error {
        gif::EncodingError::Io(source) => source,
        other => std::io::Error::other(other),
    };
    io_error(path, source)
}
