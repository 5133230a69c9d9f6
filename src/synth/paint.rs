//! Patterns: the linear reflectance of a surface point from its place on the part.

use glam::{DVec2, DVec3, Vec3};

use super::noise;

/// Where on a part a surfel lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Texel {
    /// Distance along the surface, m.
    pub(super) along: DVec2,
    /// The same as fractions 0..=1 of the surface's extent.
    pub(super) frac: DVec2,
    /// Position in the part's frame, m.
    pub(super) local: DVec3,
}

/// What a surface looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pattern {
    /// One color.
    Plain,
    /// Grain along the longest axis of the part, m per ring in `scale`.
    Wood,
    /// Threads over and under, with a nap that wanders.
    Weave,
    /// Bands across the first surface direction.
    Stripes,
    /// Veins in a polished stone.
    Marble,
    /// Speckles of both colors, as stone, foliage undergrowth or soil.
    Speckle,
    /// A leaf: lighter midrib and side veins; the first fraction runs across it.
    Leaf,
    /// Rug with border bands and a lattice of diamonds.
    RugClassic,
    /// Rug with large overlapping arcs.
    RugModern,
    /// Rug with stripes and zigzags.
    RugStriped,
    /// Painting of layered hills under a disc.
    PictureHills,
    /// Painting of blocks and discs.
    PictureShapes,
    /// Print of a stem with leaves.
    PictureStem,
    /// Bright view through a window: sky above trees above a hedge.
    Outside,
    /// Clock face: hour marks and hands.
    Clock,
    /// Text-like lines on a light screen.
    Screen,
    /// Spine of a book: bands near both ends and a title.
    Spine,
    /// Seas and lands.
    Globe,
    /// Rows of keys.
    Keys,
}

/// The material of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paint {
    /// Pattern.
    pub(super) pattern: Pattern,
    /// Main linear reflectance.
    pub(super) color: Vec3,
    /// Second linear reflectance.
    pub(super) accent: Vec3,
    /// Feature size, m.
    pub(super) scale: f64,
    /// Seed of the noise.
    pub(super) seed: u32,
    /// Strength of the view-dependent sheen, 0..=1.
    pub(super) gloss: f32,
    /// Light given off, in units of the exposed white.
    pub(super) glow: f32,
    /// Peak opacity of its Gaussians.
    pub(super) opacity: f32,
    /// Lit from both sides, as leaves and cloth.
    pub(super) thin: bool,
}

impl Paint {
    /// One color, dull.
    pub(super) fn plain(color: Vec3) -> Self {
        Self {
            pattern: Pattern::Plain,
            color,
            accent: color * 0.6,
            scale: 0.1,
            seed: 0,
            gloss: 0.0,
            glow: 0.0,
            opacity: 0.985,
            thin: false,
        }
    }

    /// A pattern of two colors with features of `scale` m.
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

    /// Dark or bright metal.
    pub(super) fn metal(color: Vec3) -> Self {
        Self::plain(color).gloss(0.7)
    }

    /// With a sheen.
    pub(super) fn gloss(self, gloss: f32) -> Self {
        Self { gloss, ..self }
    }

    /// Giving off light.
    pub(super) fn glow(self, glow: f32) -> Self {
        Self { glow, ..self }
    }

    /// Seen through.
    pub(super) fn opacity(self, opacity: f32) -> Self {
        Self { opacity, ..self }
    }

    /// Lit from both sides.
    pub(super) fn thin(self) -> Self {
        Self { thin: true, ..self }
    }

    /// Another seed for its noise.
    pub(super) fn seeded(self, seed: u32) -> Self {
        Self { seed, ..self }
    }

    /// Linear reflectance at a point; `grain` is the part's longest axis, 0..=2.
    pub(super) fn albedo(&self, at: &Texel, grain: usize) -> Vec3 {
        let (x, y) = (at.along.x / self.scale, at.along.y / self.scale);
        let blend = |t: f64| self.color.lerp(self.accent, t.clamp(0.0, 1.0) as f32);
        match self.pattern {
            Pattern::Plain => self.color * (0.985 + 0.03 * noise::smooth(x, y, self.seed) as f32),
            Pattern::Wood => blend(self.rings(at.local, grain)),
            Pattern::Weave => blend(0.65 * noise::octaves(x * 0.12, y * 0.12, self.seed) + 0.5 * thread(x, y) - 0.2),
            Pattern::Stripes => blend(f64::from((x.floor() as i32).rem_euclid(2))),
            Pattern::Marble => blend(self.veins(at.local)),
            Pattern::Speckle => blend(1.6 * noise::octaves(x * 1.7, y * 1.7, self.seed) - 0.3),
            Pattern::Leaf => blend(leaf_shade(at.frac)),
            Pattern::Spine => blend(spine(at.frac, self.seed)),
            Pattern::Clock => blend(clock(at.frac)),
            Pattern::Screen => blend(screen(at.frac, self.seed)),
            Pattern::Globe => blend(smoothstep(0.47, 0.53, noise::octaves(x, y, self.seed))),
            Pattern::Keys => blend(keys(at.along)),
            Pattern::Outside => self.outside(at.frac),
            _ => super::pictures::albedo(self, at),
        }
    }

    /// How dark the grain is, 0..=1: rings stretched 18 times along the grain, over slow drifts.
    fn rings(&self, local: DVec3, grain: usize) -> f64 {
        let (b, c) = (local[(grain + 1) % 3], local[(grain + 2) % 3]);
        let (along, across) = (local[grain] / self.scale, (b + 0.73 * c) / self.scale);
        let drift = noise::octaves(along * 0.08, across * 0.5, self.seed);
        let fine = noise::smooth(along * 0.12, across * 1.3, self.seed ^ 0x5bd1);
        0.5 * (1.0 - (2.0 * (drift * 5.0).fract() - 1.0).abs()) * drift + 0.35 * fine
    }

    fn veins(&self, local: DVec3) -> f64 {
        let (x, y) = (local.x / self.scale + local.y * 3.0, local.z / self.scale + local.y * 4.0);
        let warp = 2.0 * noise::octaves(x, y, self.seed);
        (1.0 - 7.0 * ((x * 0.7 + y * 0.4 + warp).fract() - 0.5).abs()).max(0.0) * 0.8 + 0.15 * noise::smooth(x, y, 7)
    }

    fn outside(&self, frac: DVec2) -> Vec3 {
        let (x, y) = (frac.x * 16.0, frac.y);
        let sky = self.color.lerp(Vec3::new(0.86, 0.93, 1.0), (1.0 - y).powi(2) as f32);
        let tree_line = 0.46 + 0.14 * noise::octaves(x, 0.3, self.seed);
        let hedge_line = 0.36 + 0.03 * noise::octaves(x * 1.9, 7.7, self.seed);
        let clump = noise::octaves(x * 6.0, y * 50.0, self.seed ^ 0x77) as f32;
        let tree = self.accent * (0.65 + 0.9 * clump);
        let hedge = self.accent * Vec3::new(0.75, 0.8, 0.6) * (0.45 + 0.8 * clump);
        let far = sky.lerp(tree, smoothstep(0.02, -0.02, y - tree_line) as f32);
        far.lerp(hedge, smoothstep(0.01, -0.01, y - hedge_line) as f32)
    }
}

/// 0 below `low`, 1 above `high`, smooth between; falls where `low > high`.
pub(super) fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn thread(x: f64, y: f64) -> f64 {
    f64::from((x.floor() as i32 + y.floor() as i32).rem_euclid(2)) * 0.6
}

fn leaf_shade(frac: DVec2) -> f64 {
    let off = (frac.x - 0.5).abs();
    let rib = smoothstep(0.09, 0.02, off);
    let side = smoothstep(0.35, 0.05, ((frac.y * 7.0 - off * 3.0).fract() - 0.5).abs()) * 0.35;
    (rib * 0.8).max(side)
}

fn spine(frac: DVec2, seed: u32) -> f64 {
    let band = |low: f64, high: f64| frac.y > low && frac.y < high;
    let title = seed & 3 != 0 && band(0.42, 0.78) && noise::cell((frac.y * 40.0) as i32, 0, seed) > 0.3;
    f64::from(u8::from(band(0.08, 0.13) || band(0.87, 0.92) || (title && (frac.x - 0.5).abs() < 0.3)))
}

fn clock(frac: DVec2) -> f64 {
    let p = frac * 2.0 - 1.0;
    let (radius, angle) = (p.length(), p.x.atan2(p.y));
    let hour = (angle / std::f64::consts::TAU * 12.0 + 0.5).rem_euclid(1.0) - 0.5;
    let mark = radius > 0.72 && radius < 0.88 && hour.abs() * radius < 0.055;
    let hand = |at: f64, length: f64| {
        let d = DVec2::new(at.sin(), at.cos());
        p.dot(d) > -0.1 && p.dot(d) < length && p.perp_dot(d).abs() < 0.045
    };
    f64::from(u8::from(mark || hand(5.3, 0.5) || hand(0.9, 0.7) || radius < 0.06))
}

fn screen(frac: DVec2, seed: u32) -> f64 {
    let row = (frac.y * 14.0) as i32;
    let length = 0.25 + 0.6 * noise::cell(row, 0, seed);
    let inside = frac.x > 0.08 && frac.x < length && (frac.y * 14.0).fract() > 0.45 && row > 1;
    if frac.y > 0.9 { 0.7 } else { f64::from(u8::from(inside)) }
}

fn keys(along: DVec2) -> f64 {
    let gap = |v: f64| (v / 0.019).fract() < 0.16;
    f64::from(u8::from(gap(along.x) || gap(along.y)))
}
