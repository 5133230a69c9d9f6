use std::path::Path;

use cinesplat_files::Existing;

use super::{Planes420, VideoError, encode_png};

/// Columns and rows of thumbnails.
const GRID: (usize, usize) = (4, 3);
/// Width of a thumbnail in pixels.
const THUMB_WIDTH: usize = 320;
/// Gap between thumbnails in pixels.
const GAP: usize = 4;
/// Gray of the gaps.
const GAP_GRAY: u8 = 40;

/// Thumbnails of a film in one PNG: up to twelve frames at even intervals, first and last included, in reading order.
#[derive(Debug, Clone)]
pub struct ContactSheet {
    size: (usize, usize),
    thumb_size: (usize, usize),
    frame_of_cell: Vec<usize>,
    rgb8: Vec<u8>,
}

impl ContactSheet {
    /// An empty sheet for a film of `num_frames` frames of `width` x `height` pixels.
    pub fn new(width: u32, height: u32, num_frames: usize) -> Self {
        let size = (width as usize, height as usize);
        let num_thumbs = (GRID.0 * GRID.1).min(num_frames.max(1));
        let last = num_frames.saturating_sub(1);
        let frame_of_cell = (0..num_thumbs).map(|i| (i * last).div_euclid(num_thumbs.max(2) - 1)).collect();
        let thumb_width = THUMB_WIDTH.min(size.0);
        let thumb_size = (thumb_width, (size.1 * thumb_width).div_ceil(size.0.max(1)).max(1));
        let mut sheet = Self { size, thumb_size, frame_of_cell, rgb8: Vec::new() };
        let (sheet_width, sheet_height) = sheet.sheet_size();
        sheet.rgb8 = vec![GAP_GRAY; sheet_width * sheet_height * 3];
        sheet
    }

    /// Adds frame `frame_idx` (0 = first of the film; `width * height * 3` bytes) if the sheet shows it; ignores it
    /// otherwise.
    pub fn add_frame(&mut self, frame_idx: usize, rgb8: &[u8]) {
        for (cell, _) in self.frame_of_cell.iter().enumerate().filter(|&(_, &pick)| pick == frame_idx) {
            let left = GAP + cell % GRID.0 * (self.thumb_size.0 + GAP);
            let top = GAP + cell / GRID.0 * (self.thumb_size.1 + GAP);
            let sheet_width = sheet_size(self.thumb_size, self.frame_of_cell.len()).0;
            for y in 0..self.thumb_size.1 {
                for x in 0..self.thumb_size.0 {
                    let at = ((top + y) * sheet_width + left + x) * 3;
                    self.rgb8[at..at + 3].copy_from_slice(&box_mean(rgb8, self.size, self.thumb_size, (x, y)));
                }
            }
        }
    }

    /// As [`ContactSheet::add_frame`], for a frame as the encoders take it. An odd picture has its last column or row twice.
    pub fn add_planes(&mut self, frame_idx: usize, planes: &Planes420) {
        if !self.shows(frame_idx) {
            return;
        }
        let rgb8 = planes.to_rgb8();
        let rows = rgb8.chunks_exact(planes.width * 3).take(self.size.1);
        let cropped: Vec<u8> = rows.flat_map(|row| &row[..self.size.0 * 3]).copied().collect();
        self.add_frame(frame_idx, &cropped);
    }

    /// Whether frame `frame_idx` is on the sheet.
    pub fn shows(&self, frame_idx: usize) -> bool {
        self.frame_of_cell.contains(&frame_idx)
    }

    /// The frames on the sheet.
    pub fn shown_frames(&self) -> impl Iterator<Item = usize> {
        self.frame_of_cell.iter().copied()
    }

    /// Writes the sheet. A file that holds the same sheet already is left as it is.
    ///
    /// # Errors
    /// As [`super::write_png`].
    pub fn write(&self, path: &Path, existing: Existing) -> Result<(), VideoError> {
        let (width, height) = self.sheet_size();
        let bytes = encode_png(&self.rgb8, [width as u32, height as u32])?;
        if cinesplat_files::holds(path, &bytes) { Ok(()) } else { Ok(cinesplat_files::write(path, &bytes, existing)?) }
    }

    fn sheet_size(&self) -> (usize, usize) {
        sheet_size(self.thumb_size, self.frame_of_cell.len())
    }
}

fn sheet_size(thumb_size: (usize, usize), num_thumbs: usize) -> (usize, usize) {
    let (columns, rows) = (GRID.0.min(num_thumbs), num_thumbs.div_ceil(GRID.0));
    (GAP + columns * (thumb_size.0 + GAP), GAP + rows * (thumb_size.1 + GAP))
}

/// Mean of the source pixels that a thumbnail pixel covers, whole pixels only.
fn box_mean(rgb8: &[u8], size: (usize, usize), thumb_size: (usize, usize), at: (usize, usize)) -> [u8; 3] {
    let span = |i: usize, from: usize, to: usize| {
        let start = i * from / to;
        start..((i + 1) * from / to).clamp(start + 1, from.max(start + 1))
    };
    let (xs, ys) = (span(at.0, size.0, thumb_size.0), span(at.1, size.1, thumb_size.1));
    let num_pixels = (xs.len() * ys.len()) as u32;
    let mut sum = [0_u32; 3];
    for y in ys {
        for pixel in rgb8[(y * size.0 + xs.start) * 3..(y * size.0 + xs.end) * 3].chunks_exact(3) {
            for (total, &value) in sum.iter_mut().zip(pixel) {
                *total += u32::from(value);
            }
        }
    }
    sum.map(|total| ((total + num_pixels / 2) / num_pixels) as u8)
}
