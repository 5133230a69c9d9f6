//! Lines, rectangles and text on a picture.

use font8x8::legacy::BASIC_LEGACY;
use glam::DVec2;
use image::{Rgb, RgbImage};

/// Side of a letter of the font at scale 1.
const LETTER_PX: i64 = 8;

/// A color with 8 bits per channel.
pub(crate) type Ink = Rgb<u8>;

/// Width and height of a text whose letters have a side of `scale` times 8 px.
pub(crate) fn text_size_px(text: &str, scale: i64) -> (i64, i64) {
    (text.chars().count() as i64 * LETTER_PX * scale, LETTER_PX * scale)
}

/// Writes a text with its upper left corner at a pixel, clipped to the picture. Letters outside ASCII become question
/// marks.
pub(crate) fn text(image: &mut RgbImage, at: (i64, i64), scale: i64, ink: Ink, text: &str) {
    for (column, letter) in text.chars().enumerate() {
        let code = if letter.is_ascii_graphic() || letter == ' ' { letter as usize } else { '?' as usize };
        let glyph = BASIC_LEGACY.get(code).copied().unwrap_or_default();
        for (row, bits) in glyph.iter().enumerate() {
            for bit in (0..LETTER_PX).filter(|bit| bits >> bit & 1 == 1) {
                let left = at.0 + (column as i64 * LETTER_PX + bit) * scale;
                fill(image, (left, at.1 + row as i64 * scale), (scale, scale), ink);
            }
        }
    }
}

/// Writes a text on a rectangle of another color that is `scale` px larger on every side. `inks`: text, rectangle.
pub(crate) fn tag(image: &mut RgbImage, at: (i64, i64), scale: i64, inks: (Ink, Ink), words: &str) {
    let (width, height) = text_size_px(words, scale);
    fill(image, (at.0 - scale, at.1 - scale), (width + 2 * scale, height + 2 * scale), inks.1);
    text(image, at, scale, inks.0, words);
}

/// Fills a rectangle, clipped to the picture.
pub(crate) fn fill(image: &mut RgbImage, at: (i64, i64), size: (i64, i64), ink: Ink) {
    let range = |start: i64, length: i64, limit: u32| {
        let limit = i64::from(limit);
        (start.clamp(0, limit) as u32)..((start + length).clamp(0, limit) as u32)
    };
    for y in range(at.1, size.1, image.height()) {
        for x in range(at.0, size.0, image.width()) {
            image.put_pixel(x, y, ink);
        }
    }
}

/// Draws a straight line two pixels thick, clipped to the picture.
pub(crate) fn line(image: &mut RgbImage, from: DVec2, to: DVec2, ink: Ink) {
    let Some((from, to)) = clipped(from, to, DVec2::new(f64::from(image.width()), f64::from(image.height()))) else {
        return;
    };
    let num_steps = (to - from).abs().max_element().ceil().max(1.0) as usize;
    for step in 0..=num_steps {
        let p = from.lerp(to, step as f64 / num_steps as f64);
        fill(image, (p.x.floor() as i64, p.y.floor() as i64), (2, 2), ink);
    }
}

/// The part of a line segment inside `0..size` (Liang and Barsky 1984); `None` where it is empty.
fn clipped(from: DVec2, to: DVec2, size: DVec2) -> Option<(DVec2, DVec2)> {
    let step = to - from;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if step[axis] == 0.0 {
            if !(0.0..=size[axis]).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let (a, b) = (-from[axis] / step[axis], (size[axis] - from[axis]) / step[axis]);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    (enter < leave).then(|| (from + step * enter, from + step * leave))
}
