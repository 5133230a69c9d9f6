//! Perceived colors: CIE Lab and the basic color terms.

use cinesplat_render::srgb;
use glam::{Mat3, Vec3};

/// Basic color terms as sRGB (Berlin and Kay 1969, with shades and with beige, gold, teal and turquoise, which are
/// common in interiors).
const NAMES: [(&str, [u8; 3]); 26] = [
    ("black", [25, 25, 27]),
    ("dark gray", [75, 75, 78]),
    ("gray", [128, 128, 128]),
    ("light gray", [185, 185, 185]),
    ("white", [235, 235, 235]),
    ("red", [190, 30, 35]),
    ("dark red", [110, 20, 25]),
    ("pink", [225, 130, 165]),
    ("orange", [225, 115, 30]),
    ("brown", [105, 65, 35]),
    ("light brown", [165, 115, 75]),
    ("dark brown", [60, 40, 28]),
    ("beige", [215, 195, 160]),
    ("gold", [165, 125, 50]),
    ("yellow", [230, 205, 60]),
    ("pale yellow", [238, 215, 145]),
    ("olive", [105, 105, 45]),
    ("green", [55, 135, 55]),
    ("dark green", [30, 65, 35]),
    ("light green", [150, 205, 140]),
    ("teal", [30, 130, 130]),
    ("turquoise", [90, 195, 190]),
    ("blue", [45, 85, 180]),
    ("light blue", [140, 180, 220]),
    ("dark blue", [25, 40, 85]),
    ("purple", [120, 60, 145]),
];

/// Linear sRGB (D65) to CIE XYZ, IEC 61966-2-1.
const XYZ_FROM_RGB: Mat3 = Mat3::from_cols(
    Vec3::new(0.412_456, 0.212_673, 0.019_334),
    Vec3::new(0.357_576, 0.715_152, 0.119_192),
    Vec3::new(0.180_437, 0.072_175, 0.950_304),
);

/// The white point D65 in XYZ.
const WHITE_XYZ: Vec3 = Vec3::new(0.950_47, 1.0, 1.088_83);

/// CIE Lab (L 0..100) of an sRGB color, 0..=1.
pub(crate) fn lab(rgb: Vec3) -> Vec3 {
    let linear = rgb.to_array().map(srgb::to_light);
    let xyz = XYZ_FROM_RGB * Vec3::from_array(linear) / WHITE_XYZ;
    let [x, y, z] = xyz.to_array().map(|t| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 });
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// Difference of two colors (CIE Lab). Lightness counts half, because light and shade change it most.
pub(crate) fn difference(a: Vec3, b: Vec3) -> f32 {
    ((a - b) * Vec3::new(0.5, 1.0, 1.0)).length()
}

/// The name of the nearest basic color. Lightness is weighted by 0.6, so that a white object in the shade stays white.
pub(crate) fn name(color_lab: Vec3) -> &'static str {
    let weights = Vec3::new(0.6, 1.0, 1.0);
    let distance = |rgb: [u8; 3]| {
        let named = lab(Vec3::from_array(rgb.map(|v| f32::from(v) / 255.0)));
        ((named - color_lab) * weights).length_squared()
    };
    NAMES.iter().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or("gray", |named| named.0)
}

/// Median of some colors, channel by channel; black for none.
pub(crate) fn median(colors: &[Vec3]) -> Vec3 {
    let channel = |channel: usize| super::median::median(colors.iter().map(|color| color[channel]));
    Vec3::new(channel(0), channel(1), channel(2))
}
