//! The names of moves, shot sizes and angles that prompts, shots and reports use.
use strum::VariantArray;

/// What the camera does between two keys. Definitions: `docs` of the operator's move files.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Move {
    /// Nothing moves.
    Static,
    /// Yaw to the left about the world's up, position fixed.
    PanLeft,
    /// Yaw to the right about the world's up, position fixed.
    PanRight,
    /// Pitch up, position fixed.
    TiltUp,
    /// Pitch down, position fixed.
    TiltDown,
    /// Turn clockwise about the view axis: the right side dips.
    RollCw,
    /// Turn counter-clockwise about the view axis.
    RollCcw,
    /// Toward the subject, no turn.
    PushIn,
    /// Away from the subject, no turn.
    PullOut,
    /// Sideways to the camera's left, no turn.
    TruckLeft,
    /// Sideways to the camera's right, no turn.
    TruckRight,
    /// Up along the world's up, no turn.
    PedestalUp,
    /// Down along the world's up, no turn.
    PedestalDown,
    /// Up, the aim staying on the subject.
    CraneUp,
    /// Down, the aim staying on the subject.
    CraneDown,
    /// Around the subject, the camera travelling to its left (clockwise from above).
    OrbitLeft,
    /// Around the subject, the camera travelling to its right (counter-clockwise from above).
    OrbitRight,
    /// An orbit to the left of a stated or smaller angle.
    ArcLeft,
    /// An orbit to the right of a stated or smaller angle.
    ArcRight,
    /// The lens alone narrows.
    ZoomIn,
    /// The lens alone widens.
    ZoomOut,
    /// Toward the subject while the lens widens, its height in the frame constant.
    DollyZoomIn,
    /// Away from the subject while the lens narrows, its height in the frame constant.
    DollyZoomOut,
    /// From one framing to the next, keeping the subject in the frame.
    Follow,
    /// Along a free path ahead, through gaps.
    FlyThrough,
    /// From where the subject is hidden or out of frame to where it shows.
    Reveal,
    /// A pan fast enough to smear.
    WhipPan,
    /// The focus distance alone changes.
    RackFocus,
    /// Small unsteady motion about a pose.
    Handheld,
}

/// How large the subject stands in the frame: its projected height over the frame's.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum ShotSize {
    /// Above 1.6 frame heights.
    ExtremeCloseUp,
    /// 1.0 to 1.6 frame heights.
    CloseUp,
    /// 0.8 to 1.0.
    MediumCloseUp,
    /// 0.6 to 0.8.
    Medium,
    /// 0.45 to 0.6.
    MediumLong,
    /// 0.25 to 0.45.
    Long,
    /// Below 0.25.
    ExtremeLong,
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
        Self::VARIANTS.iter().find(holds).copied().unwrap_or(Self::ExtremeLong)
    }
}

/// From how high the camera sees the subject.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum ShotAngle {
    /// From above, pitch below -40 degrees.
    Overhead,
    /// Looking down, pitch -10 to -40 degrees.
    High,
    /// Level, pitch within 10 degrees.
    EyeLevel,
    /// Looking up, pitch 10 to 40 degrees.
    Low,
    /// From the ground, pitch above 40 degrees.
    Worm,
}
