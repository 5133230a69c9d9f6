use glam::DVec2;

use super::letters::text_strokes;
use super::{Anchor, Drawing, Ink, Mark, Picture, Stroke, text_width_px};
use crate::error::PlotError;
use crate::png;

/// Lines per pixel row at which polygons are filled.
const LINES_PER_ROW: usize = 4;
/// Corners of a circle.
const NUM_CORNERS: usize = 96;
/// Width of a letter's strokes over the font size.
const REGULAR_FRAC: f64 = 0.085;
const BOLD_FRAC: f64 = 0.135;

impl Drawing {
    /// The drawing as the bytes of a PNG with `px_per_px` pixels along each px of the drawing.
    ///
    /// # Errors
    /// [`PlotError::Picture`] if it cannot be encoded.
    pub fn to_png(&self, px_per_px: f64) -> Result<Vec<u8>, PlotError> {
        let (size, rgb8) = self.to_pixels(px_per_px);
        png::encode(size, &rgb8)
    }

    /// The drawing as pixels: width and height, and red, green and blue row by row.
    fn to_pixels(&self, scale: f64) -> ([u32; 2], Vec<u8>) {
        let size = (self.size_px * scale).round().max(DVec2::ONE);
        let (width, height) = (size.x as usize, size.y as usize);
        let mut page = Page { width, height, scale, rgb: vec![1.0; width * height * 3] };
        self.marks.iter().for_each(|mark| page.draw(mark));
        let rgb8 = page.rgb.iter().map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8).collect();
        ([width as u32, height as u32], rgb8)
    }
}

/// Pixels under construction: red, green and blue, 0..=1.
struct Page {
    width: usize,
    height: usize,
    /// Pixels per px of the drawing.
    scale: f64,
    rgb: Vec<f32>,
}

/// How much of each pixel of a rectangle a mark covers, 0..=1.
struct Coverage {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Page {
    fn draw(&mut self, mark: &Mark) {
        match mark {
            Mark::Area { outline_px, fill, border } => self.area(outline_px, *fill, *border),
            Mark::Circle { center_px, radius_px, fill, border } => {
                let corner = |i: usize| std::f64::consts::TAU * i as f64 / NUM_CORNERS as f64;
                let outline: Vec<DVec2> =
                    (0..NUM_CORNERS).map(|i| *center_px + DVec2::from_angle(corner(i)) * *radius_px).collect();
                self.area(&outline, *fill, *border);
            }
            Mark::Line { points_px, stroke } => self.line(&self.scaled(points_px), *stroke),
            Mark::Text { at_px, style, halo_px, text } => {
                let back = match style.anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => 0.5,
                    Anchor::End => 1.0,
                };
                let start = *at_px - DVec2::new(back * text_width_px(text, style.size_px), 0.0);
                let strokes: Vec<Vec<DVec2>> =
                    text_strokes(text, start, style.size_px).iter().map(|points| self.scaled(points)).collect();
                let width_px = style.size_px * if style.is_bold { BOLD_FRAC } else { REGULAR_FRAC };
                if *halo_px > 0.0 {
                    self.strokes(&strokes, width_px + 2.0 * halo_px, Ink::new([255; 3]));
                }
                self.strokes(&strokes, width_px, style.ink);
            }
            Mark::Picture { corner_px, size_px, picture } => self.picture(*corner_px, *size_px, picture),
        }
    }

    fn scaled(&self, points_px: &[DVec2]) -> Vec<DVec2> {
        points_px.iter().map(|point| *point * self.scale).collect()
    }

    fn area(&mut self, outline_px: &[DVec2], fill: Option<Ink>, border: Option<Stroke>) {
        let outline = self.scaled(outline_px);
        if let (Some(ink), Some(mut coverage)) = (fill, self.coverage(&outline, 1.0)) {
            coverage.fill(&outline);
            self.blend(&coverage, ink);
        }
        if let Some(stroke) = border {
            let closed: Vec<DVec2> = outline.iter().chain(outline.first()).copied().collect();
            self.line(&closed, stroke);
        }
    }

    /// Draws a line through points in pixels.
    fn line(&mut self, points: &[DVec2], stroke: Stroke) {
        let dashes = match stroke.dash_px {
            Some([dash, gap]) => dashes(points, dash * self.scale, gap * self.scale),
            None => vec![points.to_vec()],
        };
        self.strokes(&dashes, stroke.width_px, stroke.ink);
    }

    /// Draws lines of one color; where they overlap they cover once.
    fn strokes(&mut self, lines: &[Vec<DVec2>], width_px: f64, ink: Ink) {
        let radius = (width_px * self.scale / 2.0).max(0.35);
        let all: Vec<DVec2> = lines.iter().flatten().copied().collect();
        let Some(mut coverage) = self.coverage(&all, radius + 1.0) else { return };
        for line in lines {
            coverage.line(line, radius);
        }
        self.blend(&coverage, ink);
    }

    /// An empty coverage of the box around points, extended by a margin; `None` outside the page.
    fn coverage(&self, points: &[DVec2], margin: f64) -> Option<Coverage> {
        let low = points.iter().copied().reduce(DVec2::min)? - margin;
        let high = points.iter().copied().reduce(DVec2::max)? + margin;
        let clamp = |value: f64, limit: usize| value.clamp(0.0, limit as f64) as usize;
        let (left, top) = (clamp(low.x.floor(), self.width), clamp(low.y.floor(), self.height));
        let (right, bottom) = (clamp(high.x.ceil(), self.width), clamp(high.y.ceil(), self.height));
        let (width, height) = (right.saturating_sub(left), bottom.saturating_sub(top));
        (width * height > 0).then(|| Coverage { left, top, width, height, values: vec![0.0; width * height] })
    }

    fn blend(&mut self, coverage: &Coverage, ink: Ink) {
        let color = ink.rgb.map(|level| f32::from(level) / 255.0);
        for (row, values) in coverage.values.chunks_exact(coverage.width).enumerate() {
            let start = ((coverage.top + row) * self.width + coverage.left) * 3;
            for (pixel, &value) in self.rgb[start..].chunks_exact_mut(3).zip(values) {
                let alpha = value * ink.opacity as f32;
                pixel.iter_mut().zip(color).for_each(|(channel, color)| *channel += (color - *channel) * alpha);
            }
        }
    }

    /// Draws a picture, each pixel the mean of what it covers, or an interpolated value where the picture is coarser.
    fn picture(&mut self, corner_px: DVec2, size_px: DVec2, picture: &Picture) {
        let low = (corner_px * self.scale).round().max(DVec2::ZERO);
        let high = ((corner_px + size_px) * self.scale).round();
        let [width, height] = picture.size.map(f64::from);
        let steps = DVec2::new(width, height) / (high - low);
        for y in low.y as usize..(high.y as usize).min(self.height) {
            for x in low.x as usize..(high.x as usize).min(self.width) {
                let at = (DVec2::new(x as f64, y as f64) + 0.5 - low) * steps - 0.5;
                let color = interpolated(picture, at);
                let start = (y * self.width + x) * 3;
                self.rgb[start..start + 3].copy_from_slice(&color);
            }
        }
    }
}

/// Bilinear interpolation at a position in pixels, 0 in the middle of the first pixel.
fn interpolated(picture: &Picture, at: DVec2) -> [f32; 3] {
    let [width, height] = picture.size.map(|size| f64::from(size.saturating_sub(1)));
    let at = at.clamp(DVec2::ZERO, DVec2::new(width, height));
    let (column, row) = (at.x.floor(), at.y.floor());
    let (across, down) = ((at.x - column) as f32, (at.y - row) as f32);
    let value = |dx: f64, dy: f64, channel: usize| {
        let (x, y) = ((column + dx).min(width) as usize, (row + dy).min(height) as usize);
        f32::from(picture.rgb8[(y * picture.size[0] as usize + x) * 3 + channel]) / 255.0
    };
    std::array::from_fn(|channel| {
        let mix = |dy: f64| value(0.0, dy, channel) * (1.0 - across) + value(1.0, dy, channel) * across;
        mix(0.0) * (1.0 - down) + mix(1.0) * down
    })
}

impl Coverage {
    /// Covers the inside of a polygon by the even-odd rule.
    fn fill(&mut self, outline: &[DVec2]) {
        let share = 1.0 / LINES_PER_ROW as f32;
        for line in 0..self.height * LINES_PER_ROW {
            let y = self.top as f64 + (line as f64 + 0.5) / LINES_PER_ROW as f64;
            let mut crossings: Vec<f64> = Vec::new();
            for (i, &from) in outline.iter().enumerate() {
                let to = outline[(i + 1) % outline.len()];
                if (from.y <= y) != (to.y <= y) {
                    crossings.push(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y) - self.left as f64);
                }
            }
            crossings.sort_unstable_by(f64::total_cmp);
            let row = line / LINES_PER_ROW * self.width;
            for pair in crossings.chunks_exact(2) {
                let (start, end) = (pair[0].max(0.0), pair[1].min(self.width as f64));
                for column in start as usize..(end.ceil().max(0.0) as usize).min(self.width) {
                    let covered = (end.min(column as f64 + 1.0) - start.max(column as f64)).max(0.0);
                    self.values[row + column] += covered as f32 * share;
                }
            }
        }
    }

    /// Covers the pixels within a distance of a line, with soft edges one pixel wide.
    fn line(&mut self, points: &[DVec2], radius: f64) {
        let pairs = points.windows(2).map(|pair| (pair[0], pair[1]));
        let dot = points.first().filter(|_| points.len() == 1).map(|point| (*point, *point));
        for (from, to) in pairs.chain(dot) {
            self.segment(from, to, radius);
        }
    }

    fn segment(&mut self, from: DVec2, to: DVec2, radius: f64) {
        let (low, high) = (from.min(to) - radius - 1.0, from.max(to) + radius + 1.0);
        let span = |low: f64, high: f64, start: usize, size: usize| {
            let clamp = |value: f64| (value - start as f64).clamp(0.0, size as f64) as usize;
            clamp(low.floor())..clamp(high.ceil())
        };
        let step = to - from;
        let length_squared = step.length_squared();
        for y in span(low.y, high.y, self.top, self.height) {
            for x in span(low.x, high.x, self.left, self.width) {
                let center = DVec2::new((self.left + x) as f64 + 0.5, (self.top + y) as f64 + 0.5);
                let along = if length_squared > 0.0 { (center - from).dot(step) / length_squared } else { 0.0 };
                let distance = (center - from - step * along.clamp(0.0, 1.0)).length();
                let covered = (radius + 0.5 - distance).clamp(0.0, 1.0) as f32;
                let value = &mut self.values[y * self.width + x];
                *value = value.max(covered);
            }
        }
    }
}

/// Pieces of a line of length `dash`, with gaps between them.
fn dashes(points: &[DVec2], dash: f64, gap: f64) -> Vec<Vec<DVec2>> {
    let mut pieces = Vec::new();
    if !(dash > 0.0 && gap > 0.0) {
        return vec![points.to_vec()];
    }
    let mut piece: Vec<DVec2> = points.first().copied().into_iter().collect();
    let (mut is_dash, mut left) = (true, dash);
    for pair in points.windows(2) {
        let length = pair[0].distance(pair[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let at = pair[0].lerp(pair[1], done / length);
            if is_dash {
                piece.push(at);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![at];
            }
            is_dash = !is_dash;
            left = if is_dash { dash } else { gap };
        }
        left -= length - done;
        if is_dash {
            piece.push(pair[1]);
        }
    }
    if is_dash {
        pieces.push(piece);
    }
    pieces
}
