//! The names of moves, shot sizes and angles in prompts, shots and reports.

/// The move of the camera between two keys. Left, right and up are those of the camera operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
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
    /// Roll clockwise about the view axis: the camera's right side dips.
    RollCw,
    /// Roll counter-clockwise about the view axis.
    RollCcw,
    /// Toward the subject; no turn, no zoom.
    PushIn,
    /// Away from the subject; no turn, no zoom.
    PullOut,
    /// To the camera's left; no turn.
    TruckLeft,
    /// To the camera's right; no turn.
    TruckRight,
    /// Along the world's up; no turn.
    PedestalUp,
    /// Against the world's up; no turn.
    PedestalDown,
    /// Up, aimed at the subject.
    CraneUp,
    /// Down, aimed at the subject.
    CraneDown,
    /// Around the subject to the camera's left: clockwise seen from above.
    OrbitLeft,
    /// Around the subject to the camera's right: counter-clockwise seen from above.
    OrbitRight,
    /// An orbit to the left of a stated or smaller angle.
    ArcLeft,
    /// An orbit to the right of a stated or smaller angle.
    ArcRight,
    /// The field of view narrows; position and rotation are fixed.
    ZoomIn,
    /// The field of view widens; position and rotation are fixed.
    ZoomOut,
    /// Toward the subject while the field of view widens, with the subject's height in the frame constant.
    DollyZoomIn,
    /// Away from the subject while the field of view narrows, with the subject's height in the frame constant.
    DollyZoomOut,
    /// From one framing to the next while the subject stays in the frame.
    Follow,
    /// Forward along a collision-free path, through gaps.
    FlyThrough,
    /// From where the subject is hidden or out of frame to where it is visible.
    Reveal,
    /// A pan fast enough for motion blur.
    WhipPan,
    /// Only the focus distance changes.
    RackFocus,
    /// Small random motion about a pose.
    Handheld,
}

impl Move {
    /// Whether the camera turns in place to look elsewhere: pans, tilts, whip pans.
    pub fn looks_elsewhere(self) -> bool {
        matches!(self, Self::PanLeft | Self::PanRight | Self::TiltUp | Self::TiltDown | Self::WhipPan)
    }

    /// Whether the camera goes around its subject: orbits and arcs.
    pub fn is_circular(self) -> bool {
        matches!(self, Self::OrbitLeft | Self::OrbitRight | Self::ArcLeft | Self::ArcRight)
    }

    /// The same move in the other direction; `None` for a move without one.
    pub fn opposite(self) -> Option<Self> {
        let pairs = [
            [Self::PanLeft, Self::PanRight],
            [Self::TiltUp, Self::TiltDown],
            [Self::RollCw, Self::RollCcw],
            [Self::PushIn, Self::PullOut],
            [Self::TruckLeft, Self::TruckRight],
            [Self::PedestalUp, Self::PedestalDown],
            [Self::CraneUp, Self::CraneDown],
            [Self::OrbitLeft, Self::OrbitRight],
            [Self::ArcLeft, Self::ArcRight],
            [Self::ZoomIn, Self::ZoomOut],
            [Self::DollyZoomIn, Self::DollyZoomOut],
        ];
        pairs.into_iter().find_map(|[a, b]| match self {
            own if own == a => Some(b),
            own if own == b => Some(a),
            _ => None,
        })
    }
}

/// Size of the subject in the frame: its projected height over the frame's height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum ShotSize {
    /// Above 1.6 frame heights.
    ExtremeCloseUp,
    /// 1.0 to 1.6 frame heights.
    CloseUp,
    /// 0.8 to 1.0 frame heights.
    MediumCloseUp,
    /// 0.6 to 0.8 frame heights.
    Medium,
    /// 0.45 to 0.6 frame heights.
    MediumLong,
    /// 0.25 to 0.45 frame heights.
    Long,
    /// Below 0.25 frame heights.
    ExtremeLong,
}

impl ShotSize {
    /// Range `(low, high)` of the projected height over the frame's height.
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
}

/// Height from which the camera sees the subject, by the pitch of its view axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum ShotAngle {
    /// Steeply down: pitch below -40 degrees.
    Overhead,
    /// Down: pitch -40 to -10 degrees.
    High,
    /// Level: pitch within 10 degrees of the horizon.
    EyeLevel,
    /// Up: pitch 10 to 40 degrees.
    Low,
    /// Steeply up, from the ground: pitch above 40 degrees.
    Worm,
}
