/// How closely the critic looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CriticSettings {
    /// Pictures per film at even times, the first and the last moment included, for the films that come into question; at
    /// least 2.
    pub num_moments: usize,
    /// The same for a first look at all films. Where the intervals of both divide each other, no picture is rendered twice.
    pub num_first_moments: usize,
    /// Pixels per picture, in the film's own aspect; at least 64.
    pub num_pixels: u32,
}

impl Default for CriticSettings {
    fn default() -> Self {
        Self { num_moments: 13, num_first_moments: 5, num_pixels: 128 * 72 }
    }
}
