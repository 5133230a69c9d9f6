use glam::Vec3;

/// Texture of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pattern {
    /// One color.
    Plain,
    /// Wood grain along the longest axis of the primitive; `scale` is the ring width, m.
    Wood,
    /// Woven threads with slow variation.
    Weave,
    /// Stripes across the first surface direction.
    Stripes,
    /// Veins of marble.
    Marble,
    /// Speckles of both colors: stone, foliage, soil.
    Speckle,
    /// A leaf with midrib and side veins; the first surface direction runs across it.
    Leaf,
    /// Rug with border bands and a lattice of diamonds.
    RugClassic,
    /// Rug with large overlapping arcs.
    RugModern,
    /// Rug with stripes and zigzags.
    RugStriped,
    /// Painting of layered hills under a sun.
    PictureHills,
    /// Painting of blocks and discs.
    PictureShapes,
    /// Print of a stem with leaves.
    PictureStem,
    /// View through a window: sky, trees and a hedge, from top to bottom.
    Outside,
    /// Clock face: hour marks and hands.
    Clock,
    /// Lines like text on a screen.
    Screen,
    /// Spine of a book: bands near both ends and a title.
    Spine,
    /// Oceans and continents.
    Globe,
    /// Keys in rows and columns.
    Keys,
}

/// Material of a primitive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Material {
    /// Texture.
    pub(super) pattern: Pattern,
    /// Main linear reflectance.
    pub(super) color: Vec3,
    /// Second linear reflectance.
    pub(super) accent: Vec3,
    /// Feature size, m.
    pub(super) scale: f64,
    /// Seed of the texture's noise.
    pub(super) seed: u32,
    /// Strength of the view-dependent sheen, 0..=1.
    pub(super) gloss: f32,
    /// Emitted radiance divided by the reflectance, in units of exposed white.
    pub(super) emission: f32,
    /// Peak opacity of its Gaussians.
    pub(super) opacity: f32,
    /// Lit from both sides: leaves and cloth.
    pub(super) two_sided: bool,
}

impl Material {
    /// A matte material of one color.
    pub(super) fn plain(color: Vec3) -> Self {
        Self {
            pattern: Pattern::Plain,
            color,
            accent: color * 0.6,
            scale: 0.1,
            seed: 0,
            gloss: 0.0,
            emission: 0.0,
            opacity: 0.985,
            two_sided: false,
        }
    }

    /// A texture of two colors with features of `scale` m.
    pub(super) fn patterned(pattern: Pattern, color: Vec3, accent: Vec3, scale: f64) -> Self {
        Self { pattern, accent, scale, ..Self::plain(color) }
    }

    /// Oiled wood.
    pub(super) fn wood(color: Vec3, seed: u32) -> Self {
        Self { seed, gloss: 0.25, ..Self::patterned(Pattern::Wood, color, color * 0.5, 0.035) }
    }

    /// Woven cloth.
    pub(super) fn cloth(color: Vec3, seed: u32) -> Self {
        Self { seed, ..Self::patterned(Pattern::Weave, color, color * 0.72, 0.012) }
    }

    /// Polished metal.
    pub(super) fn metal(color: Vec3) -> Self {
        Self::plain(color).gloss(0.7)
    }

    /// The same with a sheen of this strength, 0..=1.
    pub(super) fn gloss(self, gloss: f32) -> Self {
        Self { gloss, ..self }
    }

    /// The same with emission, in units of exposed white.
    pub(super) fn emission(self, emission: f32) -> Self {
        Self { emission, ..self }
    }

    /// The same with this peak opacity, 0..=1.
    pub(super) fn opacity(self, opacity: f32) -> Self {
        Self { opacity, ..self }
    }

    /// The same, lit from both sides.
    pub(super) fn two_sided(self) -> Self {
        Self { two_sided: true, ..self }
    }

    /// The same with another seed of the noise.
    pub(super) fn seeded(self, seed: u32) -> Self {
        Self { seed, ..self }
    }
}
