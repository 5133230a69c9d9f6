//! Perceived colors: CIE Lab and the basic color terms.

use std::sync::LazyLock;

use cinesplat_render::srgb;
use glam::{Mat3, Vec3};

/// Colors between which light and shade change those of one thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hue {
    Dark,
    Light,
    Red,
    Pink,
    Orange,
    Brown,
    Gold,
    Yellow,
    Green,
    Teal,
    Blue,
    Purple,
}

impl Hue {
    const ALL: [Self; 12] = [
        Self::Dark,
        Self::Light,
        Self::Red,
        Self::Pink,
        Self::Orange,
        Self::Brown,
        Self::Gold,
        Self::Yellow,
        Self::Green,
        Self::Teal,
        Self::Blue,
        Self::Purple,
    ];

    /// How much a part of a thing in it counts where it is saturated: people notice colors before grays, warm ones first, and
    /// call a plant by the color of its flowers.
    fn salience(self) -> f32 {
        match self {
            Self::Red | Self::Pink | Self::Orange | Self::Yellow | Self::Purple => 2.0,
            Self::Teal | Self::Blue => 1.5,
            Self::Green => 1.2,
            Self::Dark | Self::Light | Self::Brown | Self::Gold => 1.0,
        }
    }
}

/// Chroma (CIE Lab) of a gray, and of a saturated color.
const GRAY_CHROMA: f32 = 5.0;
const SATURATED_CHROMA: f32 = 25.0;

/// Least share of what is seen of a thing from which on a color counts more than its share.
const SALIENT_FRAC: f32 = 0.2;

/// Basic color terms as sRGB (Berlin and Kay 1969, with shades and with beige, cream, gold, teal and turquoise, which are
/// common in interiors).
const NAMES: [(&str, [u8; 3], Hue); 28] = [
    ("black", [25, 25, 27], Hue::Dark),
    ("dark gray", [75, 75, 78], Hue::Dark),
    ("gray", [128, 128, 128], Hue::Light),
    ("light gray", [185, 185, 185], Hue::Light),
    ("white", [235, 235, 235], Hue::Light),
    ("red", [190, 30, 35], Hue::Red),
    ("dark red", [110, 20, 25], Hue::Red),
    ("pink", [225, 130, 165], Hue::Pink),
    ("pale pink", [235, 205, 200], Hue::Pink),
    ("orange", [225, 115, 30], Hue::Orange),
    ("brown", [105, 65, 35], Hue::Brown),
    ("light brown", [165, 115, 75], Hue::Brown),
    ("dark brown", [60, 40, 28], Hue::Brown),
    ("beige", [215, 195, 160], Hue::Light),
    ("cream", [240, 228, 203], Hue::Light),
    ("gold", [165, 125, 50], Hue::Gold),
    ("yellow", [230, 205, 60], Hue::Yellow),
    ("pale yellow", [238, 215, 145], Hue::Yellow),
    ("olive", [105, 105, 45], Hue::Green),
    ("green", [55, 135, 55], Hue::Green),
    ("dark green", [30, 65, 35], Hue::Green),
    ("light green", [150, 205, 140], Hue::Green),
    ("teal", [30, 130, 130], Hue::Teal),
    ("turquoise", [90, 195, 190], Hue::Teal),
    ("blue", [45, 85, 180], Hue::Blue),
    ("light blue", [140, 180, 220], Hue::Blue),
    ("dark blue", [25, 40, 85], Hue::Blue),
    ("purple", [120, 60, 145], Hue::Purple),
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
    nearest(color_lab, |_| true).map_or("gray", |(name, _)| name)
}

/// The name of the color of a thing of which colors (CIE Lab) are seen, each on as much of it: that of most of it, where warm
/// and saturated colors count more than their share. Shades of one color count together.
pub(crate) fn dominant(seen: &[Vec3]) -> &'static str {
    let own: Vec<Option<Hue>> = seen.iter().map(|color| nearest(*color, |_| true).map(|(_, hue)| hue)).collect();
    let of_hue = |hue: Hue| -> Vec<Vec3> {
        let is_hue = |(_, own): &(&Vec3, &Option<Hue>)| **own == Some(hue);
        seen.iter().zip(&own).filter(is_hue).map(|(color, _)| *color).collect()
    };
    let weight = |colors: &[Vec3], hue: Hue| {
        let share = colors.len() as f32 / seen.len().max(1) as f32;
        if share < SALIENT_FRAC {
            return share;
        }
        let typical = median(colors);
        let chroma = typical.y.hypot(typical.z);
        let saturation = ((chroma - GRAY_CHROMA) / (SATURATED_CHROMA - GRAY_CHROMA)).clamp(0.0, 1.0);
        share * (1.0 + (hue.salience() - 1.0) * saturation)
    };
    let weighed = |hue: Hue| {
        let colors = of_hue(hue);
        (weight(&colors, hue), hue, colors)
    };
    let most = Hue::ALL.map(weighed).into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let own = most.and_then(|(_, hue, colors)| nearest(median(&colors), |other| other == hue));
    own.map_or("gray", |(name, _)| name)
}

/// The basic color of some hues that is nearest to a color.
fn nearest(color_lab: Vec3, is_hue: impl Fn(Hue) -> bool) -> Option<(&'static str, Hue)> {
    let weights = Vec3::new(0.6, 1.0, 1.0);
    let distance = |(_, own, _): &(&'static str, Vec3, Hue)| ((*own - color_lab) * weights).length_squared();
    let of_hue = named_colors().iter().filter(|(_, _, hue)| is_hue(*hue));
    of_hue.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|(name, _, hue)| (*name, *hue))
}

/// The basic colors in CIE Lab.
fn named_colors() -> &'static [(&'static str, Vec3, Hue)] {
    static COLORS: LazyLock<Vec<(&'static str, Vec3, Hue)>> = LazyLock::new(|| {
        let named = |(name, rgb, hue): (&'static str, [u8; 3], Hue)| {
            (name, lab(Vec3::from_array(rgb.map(|v| f32::from(v) / 255.0))), hue)
        };
        NAMES.map(named).to_vec()
    });
    &COLORS
}

/// Median of some colors, channel by channel; black for none.
pub(crate) fn median(colors: &[Vec3]) -> Vec3 {
    let channel = |channel: usize| super::median::median(colors.iter().map(|color| color[channel]));
    Vec3::new(channel(0), channel(1), channel(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The name for so many pixels of some sRGB colors.
    fn called(seen: &[(usize, [u8; 3])]) -> &'static str {
        let colors = seen.iter().flat_map(|(count, rgb)| {
            std::iter::repeat_n(lab(Vec3::from_array(rgb.map(|v| f32::from(v) / 255.0))), *count)
        });
        dominant(&colors.collect::<Vec<_>>())
    }

    #[test]
    fn a_thing_has_the_color_of_most_of_it_and_not_a_mixture() {
        assert_eq!(called(&[(60, [225, 120, 160]), (40, [60, 120, 60])]), "pink");
        // Petals count more than leaves.
        assert_eq!(called(&[(40, [225, 120, 160]), (60, [60, 120, 60])]), "pink");
        assert_eq!(called(&[(10, [225, 120, 160]), (90, [60, 120, 60])]), "green");
        assert_eq!(called(&[(35, [225, 225, 225]), (30, [180, 180, 178]), (35, [45, 85, 180])]), "white");
        assert_eq!(called(&[(100, [228, 198, 194])]), "pale pink");
    }
}
