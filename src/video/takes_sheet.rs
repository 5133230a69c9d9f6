use std::path::Path;

use cinesplat_files::Existing;
use font8x8::legacy::BASIC_LEGACY;

use super::{VideoError, write_png};

/// Gap between thumbnails, pixels, and its gray.
const GAP: usize = 6;
const GAP_GRAY: u8 = 24;
/// Height of the line of numbers, pixels.
const HEAD: usize = 28;
/// Pixels per dot of a digit, and dots per side of a digit.
const DOT: usize = 2;
const GLYPH: usize = 8;
const INK: u8 = 235;

/// Several films side by side in one PNG: one column per film under its number, frames from top to bottom.
#[derive(Debug, Clone)]
pub struct TakesSheet {
    thumb_size: (usize, usize),
    num_films: usize,
    num_frames: usize,
    rgb8: Vec<u8>,
}

impl TakesSheet {
    /// A sheet without pictures for `num_films` films, numbered from 1, of `num_frames` frames each. All thumbnails have
    /// `thumb_size_px`.
    pub fn new(thumb_size_px: [u32; 2], num_films: usize, num_frames: usize) -> Self {
        let thumb_size = (thumb_size_px[0] as usize, thumb_size_px[1] as usize);
        let mut sheet = Self { thumb_size, num_films, num_frames, rgb8: Vec::new() };
        let (width, height) = sheet.size();
        sheet.rgb8 = vec![GAP_GRAY; width * height * 3];
        (0..num_films).for_each(|film| sheet.number(film));
        sheet
    }

    /// Puts a frame into the sheet (`width * height * 3` bytes of a thumbnail). Ignores frames that it has no place for.
    pub fn put(&mut self, film: usize, frame: usize, rgb8: &[u8]) {
        let (width, height) = self.thumb_size;
        if film >= self.num_films || frame >= self.num_frames || rgb8.len() != width * height * 3 {
            return;
        }
        let (left, top) = (GAP + film * (width + GAP), HEAD + frame * (height + GAP));
        let stride = self.size().0;
        for (y, row) in rgb8.chunks_exact(width * 3).enumerate() {
            let at = ((top + y) * stride + left) * 3;
            self.rgb8[at..at + row.len()].copy_from_slice(row);
        }
    }

    /// Writes the sheet.
    ///
    /// # Errors
    /// As [`write_png`].
    pub fn write(&self, path: &Path, existing: Existing) -> Result<(), VideoError> {
        let (width, height) = self.size();
        write_png(path, &self.rgb8, [width as u32, height as u32], existing)
    }

    fn size(&self) -> (usize, usize) {
        let (width, height) = self.thumb_size;
        (GAP + self.num_films * (width + GAP), HEAD + self.num_frames * (height + GAP))
    }

    /// Draws the number of a film above its column.
    fn number(&mut self, film: usize) {
        let stride = self.size().0;
        for (place, digit) in (film + 1).to_string().bytes().enumerate() {
            let glyph = BASIC_LEGACY.get(usize::from(digit)).copied().unwrap_or_default();
            let left = GAP + film * (self.thumb_size.0 + GAP) + place * GLYPH * DOT;
            for (y, x) in (0..GLYPH * DOT).flat_map(|y| (0..GLYPH * DOT).map(move |x| (y, x))) {
                let is_ink = glyph[y / DOT] >> (x / DOT) & 1 == 1;
                let at = ((GAP + y) * stride + left + x) * 3;
                if let Some(pixel) = self.rgb8.get_mut(at..at + 3).filter(|_| is_ink && left + x < stride) {
                    pixel.fill(INK);
                }
            }
        }
    }
}
