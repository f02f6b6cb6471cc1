//! The colours of a GIF: one palette for all frames, and the nearest colour in it.

use crate::render::Image;

/// Colours in a palette; index [`TRANSPARENT`] is left for pixels that stay as they are.
const COLORS: usize = 255;
/// Stands for "unchanged" in a frame.
pub(super) const TRANSPARENT: u8 = 255;
/// Bits per channel by which colours are told apart.
const BITS: u32 = 6;
/// How much differences in red, green and blue are seen.
const WEIGHTS: [i32; 3] = [3, 4, 2];

/// A colour that occurs, and how often.
#[derive(Clone, Copy)]
struct Entry {
    color: [f32; 3],
    count: f32,
}

/// A palette with a memory of nearest colours.
pub(super) struct Palette {
    colors: Vec<[u8; 3]>,
    /// By the leading bits of each channel; [`TRANSPARENT`] where nobody has asked yet.
    nearest: Vec<u8>,
}

impl Palette {
    /// Colours for these pictures by variance-driven median cut (after Wu 1991): the group of colours with the
    /// greatest squared error along a channel is cut at its mean, until there are enough groups.
    pub(super) fn new(pictures: &[Image]) -> Self {
        let mut groups = vec![Group::new(histogram(pictures))];
        while groups.len() < COLORS {
            // The first of equals, so that the outcome is always the same.
            let worst = (0..groups.len()).rev().max_by(|&a, &b| groups[a].error.total_cmp(&groups[b].error));
            let Some(worst) = worst.filter(|&i| groups[i].error > 0.0) else { break };
            let (low, high) = groups.swap_remove(worst).cut();
            groups.extend([low, high]);
        }
        let colors = groups.iter().map(|group| group.mean.map(|c| (c + 0.5) as u8)).collect();
        Self { colors, nearest: vec![TRANSPARENT; 1 << (3 * BITS)] }
    }

    /// Red, green, blue of 256 colours, the last for transparency.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.as_flattened().to_vec();
        bytes.resize(256 * 3, 0);
        bytes
    }

    /// The index of the colour nearest to this one.
    pub(super) fn index(&mut self, color: [u8; 3]) -> u8 {
        let key = key(color);
        if self.nearest[key] == TRANSPARENT {
            // Measured from the middle of the cell: what is kept must not depend on who asks first.
            let middle = color.map(|c| (c >> (8 - BITS) << (8 - BITS) | 1 << (7 - BITS)) as i32);
            let distance_squared = |other: [u8; 3]| -> i32 {
                (0..3).map(|i| (other[i] as i32 - middle[i]).pow(2) * WEIGHTS[i]).sum()
            };
            let nearest = (0..self.colors.len()).min_by_key(|&i| distance_squared(self.colors[i]));
            self.nearest[key] = nearest.unwrap_or(0) as u8;
        }
        self.nearest[key]
    }
}

fn key(color: [u8; 3]) -> usize {
    color.iter().fold(0, |key, &c| key << BITS | (c >> (8 - BITS)) as usize)
}

/// The colours that occur, pooled by their leading bits, in order of these.
fn histogram(pictures: &[Image]) -> Vec<Entry> {
    let mut cells = vec![([0_u64; 3], 0_u64); 1 << (3 * BITS)];
    for &pixel in pictures.iter().flat_map(|picture| &picture.pixels) {
        let (sums, count) = &mut cells[key(pixel)];
        for (sum, c) in sums.iter_mut().zip(pixel) {
            *sum += c as u64;
        }
        *count += 1;
    }
    let occurring = cells.into_iter().filter(|(_, count)| *count > 0);
    occurring
        .map(|(sums, count)| Entry {
            color: sums.map(|sum| sum as f32 / count as f32),
            // Rare colours matter more than their number says: small things would lose their hue.
            count: (count as f32).sqrt(),
        })
        .collect()
}

/// Colours that will share an index.
struct Group {
    entries: Vec<Entry>,
    mean: [f32; 3],
    /// The channel along which they differ most, and the sum of squared differences from the mean in it.
    channel: usize,
    error: f32,
}

impl Group {
    fn new(entries: Vec<Entry>) -> Self {
        let total = entries.iter().map(|e| e.count).sum::<f32>().max(1e-9);
        let mean = [0, 1, 2].map(|i| entries.iter().map(|e| e.color[i] * e.count).sum::<f32>() / total);
        let square = |x: f32| x * x;
        let errors = [0, 1, 2]
            .map(|i: usize| entries.iter().map(|e| square(e.color[i] - mean[i]) * e.count).sum::<f32>());
        let channel = (0..3).rev().max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
        // A single colour cannot be cut, whatever rounding says.
        let error = if entries.len() > 1 { errors[channel] } else { 0.0 };
        Self { entries, mean, channel, error }
    }

    fn cut(self) -> (Self, Self) {
        let Self { entries, mean, channel, .. } = self;
        let (low, high) = entries.into_iter().partition(|e| e.color[channel] < mean[channel]);
        (Self::new(low), Self::new(high))
    }
}
