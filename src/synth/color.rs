use glam::Vec3;

/// A color and its English word.
#[derive(Debug, Clone, Copy)]
pub(super) struct NamedColor {
    /// Color word, such as `green`.
    pub(super) name: &'static str,
    /// Linear reflectance.
    pub(super) linear: Vec3,
}

/// A color as the tables hold it: display-encoded (sRGB).
#[derive(Debug, Clone, Copy)]
struct EncodedColor {
    name: &'static str,
    rgb: [u8; 3],
}

const fn raw(name: &'static str, rgb: [u8; 3]) -> EncodedColor {
    EncodedColor { name, rgb }
}

impl EncodedColor {
    fn decoded(self) -> NamedColor {
        NamedColor { name: self.name, linear: srgb(self.rgb[0], self.rgb[1], self.rgb[2]) }
    }
}

/// Linear reflectance of an sRGB color (IEC 61966-2-1).
pub(super) fn srgb(red: u8, green: u8, blue: u8) -> Vec3 {
    Vec3::new(decode(red), decode(green), decode(blue))
}

fn decode(channel: u8) -> f32 {
    let c = f32::from(channel) / 255.0;
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// sRGB value of a linear value; both in 0..=1.
pub(super) fn encode(linear: f32) -> f32 {
    let c = linear.clamp(0.0, 1.0);
    if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

/// Colors of one room.
#[derive(Debug, Clone, Copy)]
pub(super) struct Palette {
    /// Walls.
    pub(super) wall: NamedColor,
    /// The wall behind the main furniture.
    pub(super) feature: NamedColor,
    /// Floor boards.
    pub(super) floor: NamedColor,
    /// Furniture wood.
    pub(super) wood: NamedColor,
    /// Large upholstery.
    pub(super) main: NamedColor,
    /// Small upholstery and textiles.
    pub(super) accent: NamedColor,
    /// Second accent color.
    pub(super) second: NamedColor,
    /// Light neutral of textiles and ceramics.
    pub(super) light: NamedColor,
    /// Dark neutral of metal and frames.
    pub(super) dark: NamedColor,
}

/// Number of palettes.
pub(super) const NUM_PALETTES: usize = 9;

const CREAM: EncodedColor = raw("cream", [234, 223, 201]);
const WHITE: EncodedColor = raw("white", [238, 234, 226]);
const BLACK: EncodedColor = raw("black", [38, 36, 35]);

/// Columns: wall, feature wall, floor, wood, main, accent, second, light, dark.
const PALETTES: [[EncodedColor; 9]; NUM_PALETTES] = [
    [
        raw("white", [226, 220, 208]),
        raw("green", [124, 140, 124]),
        raw("brown", [178, 132, 88]),
        raw("brown", [142, 92, 56]),
        raw("teal", [46, 92, 98]),
        raw("orange", [202, 122, 58]),
        raw("red", [158, 58, 46]),
        CREAM,
        BLACK,
    ],
    [
        raw("cream", [228, 212, 192]),
        raw("orange", [190, 122, 92]),
        raw("brown", [150, 104, 68]),
        raw("brown", [118, 76, 48]),
        raw("green", [104, 112, 74]),
        raw("red", [172, 74, 52]),
        raw("yellow", [214, 166, 82]),
        CREAM,
        BLACK,
    ],
    [
        raw("cream", [218, 210, 192]),
        raw("green", [66, 92, 78]),
        raw("brown", [172, 122, 76]),
        raw("brown", [128, 82, 50]),
        raw("brown", [150, 82, 44]),
        raw("green", [60, 104, 78]),
        raw("yellow", [206, 160, 76]),
        CREAM,
        BLACK,
    ],
    [
        raw("gray", [206, 204, 202]),
        raw("navy", [52, 66, 92]),
        raw("brown", [166, 122, 82]),
        raw("brown", [124, 84, 54]),
        raw("cream", [206, 192, 170]),
        raw("pink", [212, 142, 126]),
        raw("yellow", [204, 158, 84]),
        WHITE,
        BLACK,
    ],
    [
        raw("pink", [230, 212, 202]),
        raw("pink", [206, 160, 146]),
        raw("brown", [190, 150, 108]),
        raw("brown", [160, 112, 72]),
        raw("green", [36, 96, 78]),
        raw("pink", [214, 122, 104]),
        raw("navy", [46, 62, 96]),
        WHITE,
        BLACK,
    ],
    [
        raw("white", [222, 218, 210]),
        raw("gray", [112, 114, 116]),
        raw("brown", [118, 84, 58]),
        raw("brown", [104, 68, 44]),
        raw("gray", [86, 88, 92]),
        raw("red", [170, 52, 42]),
        raw("yellow", [216, 164, 68]),
        WHITE,
        BLACK,
    ],
    [
        raw("green", [186, 194, 174]),
        raw("green", [142, 156, 132]),
        raw("brown", [184, 140, 96]),
        raw("brown", [150, 102, 62]),
        raw("cream", [216, 204, 182]),
        raw("orange", [186, 94, 52]),
        raw("blue", [84, 108, 130]),
        WHITE,
        BLACK,
    ],
    [
        raw("blue", [196, 208, 214]),
        raw("blue", [126, 152, 170]),
        raw("brown", [192, 152, 108]),
        raw("brown", [166, 118, 74]),
        raw("navy", [40, 58, 96]),
        raw("yellow", [222, 172, 68]),
        raw("orange", [206, 106, 66]),
        WHITE,
        BLACK,
    ],
    [
        raw("cream", [222, 214, 200]),
        raw("purple", [98, 76, 96]),
        raw("brown", [156, 110, 74]),
        raw("brown", [110, 70, 46]),
        raw("purple", [108, 74, 100]),
        raw("yellow", [212, 164, 92]),
        raw("teal", [64, 118, 118]),
        CREAM,
        BLACK,
    ],
];

impl Palette {
    /// The palette of an index modulo [`NUM_PALETTES`].
    pub(super) fn numbered(index: usize) -> Self {
        let [wall, feature, floor, wood, main, accent, second, light, dark] =
            PALETTES[index % NUM_PALETTES].map(EncodedColor::decoded);
        Self { wall, feature, floor, wood, main, accent, second, light, dark }
    }
}

/// Number of muted colors for ceramics, glass and book spines.
pub(super) const NUM_MUTED_COLORS: usize = 10;

/// The muted color of an index modulo [`NUM_MUTED_COLORS`].
pub(super) fn muted_color(index: usize) -> NamedColor {
    const TABLE: [EncodedColor; NUM_MUTED_COLORS] = [
        raw("blue", [62, 92, 132]),
        raw("white", [232, 226, 214]),
        raw("green", [86, 118, 84]),
        raw("red", [160, 54, 44]),
        raw("yellow", [216, 172, 78]),
        raw("teal", [56, 118, 120]),
        raw("orange", [204, 116, 62]),
        raw("black", [46, 44, 44]),
        raw("pink", [206, 146, 138]),
        raw("brown", [122, 82, 56]),
    ];
    TABLE[index % NUM_MUTED_COLORS].decoded()
}
