//! Pictures with opacity as films hold them: ITU-R BT.709-6 in 10 bits, limited range, 4:4:4, and opacity in full range.

/// Codes of 10 bits: of opacity 1, of black, and the spans of luma and chroma.
const OPAQUE: f32 = 1023.0;
const BLACK: f32 = 64.0;
const MIDDLE: f32 = 512.0;
const SPANS: [f32; 2] = [876.0, 896.0];

/// Planes of one picture with opacity: luma, blue difference, red difference, opacity; rows packed. The colors are those of
/// wholly covered pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AlphaPlanes {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The planes, `width * height` codes of 10 bits each.
    pub codes: [Vec<u16>; 4],
}

impl AlphaPlanes {
    /// The planes of a picture: red, green, blue and opacity per pixel, 0..=1, row-major.
    ///
    /// `rgba` must hold `width * height` pixels.
    pub fn new(rgba: &[[f32; 4]], width: usize, height: usize) -> Self {
        let mut codes = [(); 4].map(|()| Vec::with_capacity(rgba.len()));
        for pixel in rgba {
            let [r, g, b, alpha] = pixel.map(|value| value.clamp(0.0, 1.0));
            let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            let exact = [
                BLACK + SPANS[0] * luma,
                MIDDLE + SPANS[1] * (b - luma) / 1.8556,
                MIDDLE + SPANS[1] * (r - luma) / 1.5748,
                OPAQUE * alpha,
            ];
            codes.iter_mut().zip(exact).for_each(|(plane, code)| plane.push((code + 0.5) as u16));
        }
        Self { width, height, codes }
    }

    /// The planes of an opaque picture of 8 bits: `width * height * 3` bytes, row-major, r g b.
    pub fn opaque(rgb8: &[u8], width: usize, height: usize) -> Self {
        let value = |level: u8| f32::from(level) / 255.0;
        let rgba: Vec<[f32; 4]> =
            rgb8.chunks_exact(3).map(|rgb| [value(rgb[0]), value(rgb[1]), value(rgb[2]), 1.0]).collect();
        Self::new(&rgba, width, height)
    }

    /// The planes one after the other, little-endian.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.codes.iter().flatten().flat_map(|code| code.to_le_bytes()).collect()
    }

    /// The planes from their bytes; `None` for another number of bytes.
    pub fn from_bytes(bytes: &[u8], width: usize, height: usize) -> Option<Self> {
        let num = width * height;
        if bytes.len() != 8 * num || num == 0 {
            return None;
        }
        let plane = |idx: usize| {
            let part = &bytes[2 * num * idx..2 * num * (idx + 1)];
            part.chunks_exact(2).map(|code| u16::from_le_bytes([code[0], code[1]])).collect()
        };
        Some(Self { width, height, codes: [plane(0), plane(1), plane(2), plane(3)] })
    }

    /// The picture over black as `width * height` pixels of r, g, b.
    pub fn to_rgb8(&self) -> Vec<u8> {
        let pixel = |idx: usize| {
            let [y, cb, cr, alpha] = [0, 1, 2, 3].map(|plane| f32::from(self.codes[plane][idx]));
            let luma = (y - BLACK) / SPANS[0];
            let (r, b) = (luma + 1.5748 * (cr - MIDDLE) / SPANS[1], luma + 1.8556 * (cb - MIDDLE) / SPANS[1]);
            let g = (luma - 0.2126 * r - 0.0722 * b) / 0.7152;
            // The cast saturates at 0 and 255.
            [r, g, b].map(|value| (value * alpha / OPAQUE * 255.0).round() as u8)
        };
        (0..self.width * self.height).flat_map(pixel).collect()
    }
}
