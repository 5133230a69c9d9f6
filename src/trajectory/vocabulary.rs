//! The names of moves, shot sizes and angles that prompts, shots and reports use.

/// Declares an enum whose variants have fixed names, with `ALL`, `name` and `from_name`.
macro_rules! named_choices {
    ($(#[$meta:meta])* $type:ident { $($(#[$doc:meta])* $variant:ident = $name:literal,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $type { $($(#[$doc])* $variant,)* }

        impl $type {
            /// Every choice, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The name in prompts, JSON files and reports.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// The choice with this name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|choice| choice.name() == name)
            }
        }
    };
}
pub(crate) use named_choices;

named_choices! {
    /// What the camera does between two keys. Definitions: `docs` of the operator's move files.
    Move {
        /// Nothing moves.
        Static = "static",
        /// Yaw to the left about the world's up, position fixed.
        PanLeft = "pan-left",
        /// Yaw to the right about the world's up, position fixed.
        PanRight = "pan-right",
        /// Pitch up, position fixed.
        TiltUp = "tilt-up",
        /// Pitch down, position fixed.
        TiltDown = "tilt-down",
        /// Turn clockwise about the view axis: the right side dips.
        RollCw = "roll-cw",
        /// Turn counter-clockwise about the view axis.
        RollCcw = "roll-ccw",
        /// Toward the subject, no turn.
        PushIn = "push-in",
        /// Away from the subject, no turn.
        PullOut = "pull-out",
        /// Sideways to the camera's left, no turn.
        TruckLeft = "truck-left",
        /// Sideways to the camera's right, no turn.
        TruckRight = "truck-right",
        /// Up along the world's up, no turn.
        PedestalUp = "pedestal-up",
        /// Down along the world's up, no turn.
        PedestalDown = "pedestal-down",
        /// Up, the aim staying on the subject.
        CraneUp = "crane-up",
        /// Down, the aim staying on the subject.
        CraneDown = "crane-down",
        /// Around the subject, the camera travelling to its left (clockwise from above).
        OrbitLeft = "orbit-left",
        /// Around the subject, the camera travelling to its right (counter-clockwise from above).
        OrbitRight = "orbit-right",
        /// An orbit to the left of a stated or smaller angle.
        ArcLeft = "arc-left",
        /// An orbit to the right of a stated or smaller angle.
        ArcRight = "arc-right",
        /// The lens alone narrows.
        ZoomIn = "zoom-in",
        /// The lens alone widens.
        ZoomOut = "zoom-out",
        /// Toward the subject while the lens widens, its height in the frame constant.
        DollyZoomIn = "dolly-zoom-in",
        /// Away from the subject while the lens narrows, its height in the frame constant.
        DollyZoomOut = "dolly-zoom-out",
        /// From one framing to the next, keeping the subject in the frame.
        Follow = "follow",
        /// Along a free path ahead, through gaps.
        FlyThrough = "fly-through",
        /// From where the subject is hidden or out of frame to where it shows.
        Reveal = "reveal",
        /// A pan fast enough to smear.
        WhipPan = "whip-pan",
        /// The focus distance alone changes.
        RackFocus = "rack-focus",
        /// Small unsteady motion about a pose.
        Handheld = "handheld",
    }
}

named_choices! {
    /// How large the subject stands in the frame: its projected height over the frame's.
    ShotSize {
        /// Above 1.6 frame heights.
        ExtremeCloseUp = "extreme-close-up",
        /// 1.0 to 1.6 frame heights.
        CloseUp = "close-up",
        /// 0.8 to 1.0.
        MediumCloseUp = "medium-close-up",
        /// 0.6 to 0.8.
        Medium = "medium",
        /// 0.45 to 0.6.
        MediumLong = "medium-long",
        /// 0.25 to 0.45.
        Long = "long",
        /// Below 0.25.
        ExtremeLong = "extreme-long",
    }
}

impl ShotSize {
    /// Band of projected height over frame height, `(low, high)`; table 4.1 of the cinematography notes.
    pub fn height_band_frac(self) -> (f64, f64) {
        match self {
            Self::ExtremeCloseUp => (1.6, 3.0),
            Self::CloseUp => (1.0, 1.6),
            Self::MediumCloseUp => (0.8, 1.0),
            Self::Medium => (0.6, 0.8),
            Self::MediumLong => (0.45, 0.6),
            Self::Long => (0.25, 0.45),
            Self::ExtremeLong => (0.05, 0.25),
        }
    }

    /// The size whose band holds a projected height over frame height.
    pub fn of_height_frac(height_frac: f64) -> Self {
        let holds = |size: &&Self| height_frac >= size.height_band_frac().0;
        Self::ALL.iter().find(holds).copied().unwrap_or(Self::ExtremeLong)
    }
}

named_choices! {
    /// From how high the camera sees the subject.
    ShotAngle {
        /// From above, pitch below -40 degrees.
        Overhead = "overhead",
        /// Looking down, pitch -10 to -40 degrees.
        High = "high",
        /// Level, pitch within 10 degrees.
        EyeLevel = "eye-level",
        /// Looking up, pitch 10 to 40 degrees.
        Low = "low",
        /// From the ground, pitch above 40 degrees.
        Worm = "worm",
    }
}
