use super::vocabulary::named_choices;

named_choices! {
    /// How the camera's speed changes along the segment that starts at a key.
    ///
    /// `smooth`, `ease-in`, `ease-out` are a cruise at even speed with ramps, so that the middle of a move is steady.
    Easing {
        /// Ramp up, even cruise, ramp down: at rest at both ends.
        Smooth = "smooth",
        /// Even speed, passing through both ends.
        Linear = "linear",
        /// From rest up to even speed.
        EaseIn = "ease-in",
        /// From even speed down to rest.
        EaseOut = "ease-out",
    }
}

impl Easing {
    /// Whether the camera is at rest where the segment starts.
    pub fn rests_at_start(self) -> bool {
        matches!(self, Self::Smooth | Self::EaseIn)
    }

    /// Whether the camera is at rest where the segment ends.
    pub fn rests_at_end(self) -> bool {
        matches!(self, Self::Smooth | Self::EaseOut)
    }
}
