//! The measure of taste: its terms, their weights and their sources, in one table.

use strum::VariantArray;

/// A term of taste. Each gives a film a mark of 0..=1; 1 is what one wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Term {
    /// Little of the frame is void.
    Void,
    /// Nothing close before the lens covers the frame.
    Blocked,
    /// No foreground sweeps across the frame in mid film, or fills it.
    Wipe,
    /// The camera does not pass through thin matter.
    Haze,
    /// The subject is not hidden.
    Visible,
    /// The subject is never lost.
    Kept,
    /// The Gaussians of the subject are small on the screen.
    Sharp,
    /// The surfaces of the subject face the camera.
    Facing,
    /// The subject is large enough to be read.
    Presence,
    /// Neither clipped nor dark.
    Exposure,
    /// There is a foreground and a background.
    Depth,
    /// The weight of the picture is not on one side.
    Balance,
    /// There is something to see in all parts of the frame.
    Interest,
    /// The operator's own cost is low.
    Margin,
}

/// A row of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TermRow {
    /// The term.
    pub term: Term,
    /// Its weight in the sum.
    pub weight: f64,
    /// The fault that lowers it.
    pub punishes: &'static str,
    /// What a film with a better mark has more of, in words.
    pub praise: &'static str,
    /// Where cinematography or measurement asks for it.
    pub source: &'static str,
}

/// One row per [`Term`], in the order of its variants.
pub const TERMS: [TermRow; 14] = [
    TermRow {
        term: Term::Void,
        weight: 3.0,
        punishes: "frames that are partly outside the capture (rooms only)",
        praise: "fills the frame with the room",
        source: "users: do not fly out of the scene; restrict views to what was captured",
    },
    TermRow {
        term: Term::Blocked,
        weight: 2.0,
        punishes: "matter against the lens",
        praise: "keeps the lens clear",
        source: "look-before-move: severe above 35 % of the rays",
    },
    TermRow {
        term: Term::Wipe,
        weight: 1.5,
        punishes: "foreground that sweeps across the frame in mid film, or fills half of it",
        praise: "has no foreground sweeping across",
        source: "a wipe is a transition between shots, never an accident inside one",
    },
    TermRow {
        term: Term::Haze,
        weight: 1.0,
        punishes: "floaters and curtains that the camera passes through",
        praise: "stays out of thin matter",
        source: "users: floaters spoil views",
    },
    TermRow {
        term: Term::Visible,
        weight: 3.0,
        punishes: "a subject partly hidden",
        praise: "shows more of the subject",
        source: "visible share of the subject: close-up .90, medium .82, long .75",
    },
    TermRow {
        term: Term::Kept,
        weight: 3.0,
        punishes: "moments at which the subject is gone",
        praise: "never loses the subject",
        source: "share of frames with the subject off screen, 38 % in a generator without a check",
    },
    TermRow {
        term: Term::Sharp,
        weight: 2.5,
        punishes: "splats that are large on the screen",
        praise: "is sharper",
        source: "closest distance that the capture resolves: size of its splats in pixels",
    },
    TermRow {
        term: Term::Facing,
        weight: 1.5,
        punishes: "surfaces of the subject seen edge-on",
        praise: "sees the subject's surfaces less edge-on",
        source: "three-quarter view: a subject reads by its faces; grazing views are the least supported by a capture",
    },
    TermRow {
        term: Term::Presence,
        weight: 1.5,
        punishes: "a subject lost in its surroundings",
        praise: "shows the subject larger",
        source: "median area of a subject: long shot 2 to 14 % of the frame",
    },
    TermRow {
        term: Term::Exposure,
        weight: 1.0,
        punishes: "clipped and dark frames",
        praise: "is better exposed",
        source: "exposure: keep highlights below clipping and the mean in the middle of the range",
    },
    TermRow {
        term: Term::Depth,
        weight: 1.5,
        punishes: "flat pictures",
        praise: "has more depth",
        source: "staging in depth: foreground, middle, background",
    },
    TermRow {
        term: Term::Balance,
        weight: 1.0,
        punishes: "pictures with all detail on one side",
        praise: "is better balanced",
        source: "balance of visual weight about the frame's middle",
    },
    TermRow {
        term: Term::Interest,
        weight: 1.5,
        punishes: "bare walls and backdrops",
        praise: "has more to see",
        source: "show what the place has: no bare wall fills a frame",
    },
    TermRow {
        term: Term::Margin,
        weight: 2.0,
        punishes: "requirements met by a hair, cameras far from the proposed ones",
        praise: "meets the words with more room to spare",
        source: "the operator's cost: framing, clearance, captured region, the proposed cameras",
    },
];

/// A weight per term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights([f64; TERMS.len()]);

impl Default for Weights {
    fn default() -> Self {
        Self(TERMS.map(|row| row.weight))
    }
}

impl Weights {
    /// The weights with one term switched off.
    #[must_use]
    pub fn without(mut self, term: Term) -> Self {
        self.0[term.index()] = 0.0;
        self
    }

    /// The weight of a term.
    pub fn of(&self, term: Term) -> f64 {
        self.0[term.index()]
    }
}

impl Term {
    /// The row of this term.
    pub fn row(self) -> &'static TermRow {
        &TERMS[self.index()]
    }

    fn index(self) -> usize {
        Self::VARIANTS.iter().position(|&term| term == self).unwrap_or(0)
    }
}
