//! Human captions of camera motion: the moves read against yes/no labels, beside a reader of keywords.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use cinesplat::director::{Director, SceneContext};
use cinesplat::operator::Program;
use cinesplat::trajectory::Move;
use glam::DVec3;
use serde::Deserialize;

use crate::cli::failure::Failure;
use crate::cli::outputs;

/// A caption with the motions that people saw (true) and did not see (false) in its clip.
#[derive(Debug, Deserialize)]
struct Caption {
    caption: String,
    labels: BTreeMap<String, bool>,
}

/// Motions with the moves that are such a motion, and the phrases by which the reader of keywords finds it.
const MOTIONS: [(&str, &[Move], &[&str]); 14] = [
    (
        "Move_In",
        &[Move::PushIn, Move::DollyZoomIn],
        &["forward", "push in", "pushes in", "dolly in", "dollies in", "closer"],
    ),
    (
        "Move_Out",
        &[Move::PullOut, Move::DollyZoomOut],
        &["backward", "moves back", "pulls back", "pull out", "dollies out"],
    ),
    ("Move_Left", &[Move::TruckLeft], &["truck left", "trucks left", "moves left", "to the left", "leftward"]),
    ("Move_Right", &[Move::TruckRight], &["truck right", "trucks right", "moves right", "to the right", "rightward"]),
    ("Move_Up", &[Move::PedestalUp, Move::CraneUp], &["pedestals up", "moves up", "rises", "ascends", "upward"]),
    (
        "Move_Down",
        &[Move::PedestalDown, Move::CraneDown],
        &["pedestals down", "moves down", "descends", "lowers", "downward"],
    ),
    ("Pan_Left", &[Move::PanLeft], &["pan left", "pans left", "pans to the left", "panning left"]),
    (
        "Pan_Right",
        &[Move::PanRight],
        &["pan right", "pans right", "pans to the right", "panning right", "left to right"],
    ),
    ("Tilt_Up", &[Move::TiltUp], &["tilt up", "tilts up", "tilting up"]),
    ("Tilt_Down", &[Move::TiltDown], &["tilt down", "tilts down", "tilting down"]),
    ("Roll_Clockwise", &[Move::RollCw], &[" clockwise"]),
    ("Roll_Counterclockwise", &[Move::RollCcw], &["counterclockwise", "counter-clockwise", "anticlockwise"]),
    ("Zoom_In", &[Move::ZoomIn], &["zoom in", "zooms in", "zooming in"]),
    ("Zoom_Out", &[Move::ZoomOut], &["zoom out", "zooms out", "zooming out"]),
];

/// Counts of one motion.
#[derive(Debug, Clone, Copy, Default)]
struct Counts {
    hits: usize,
    misses: usize,
    false_alarms: usize,
}

impl Counts {
    /// Counts a clip: whether the motion is read, and whether people saw it.
    fn add(&mut self, [is_read, is_there]: [bool; 2]) {
        self.hits += usize::from(is_read && is_there);
        self.misses += usize::from(!is_read && is_there);
        self.false_alarms += usize::from(is_read && !is_there);
    }

    fn f1(self) -> f64 {
        2.0 * self.hits as f64 / (2 * self.hits + self.misses + self.false_alarms).max(1) as f64
    }
}

/// F1 per motion of the director and of the keywords, then the means, as a table of CSV.
pub(super) fn table(director: &Director, path: &Path) -> Result<String, Failure> {
    let bad = |line: usize, error: &serde_json::Error| {
        let message = format!("{}: line {line}: {error}, expected caption and labels", path.display());
        Failure::usage(message, "give a file of JSON lines with caption and labels")
    };
    let mut counts = BTreeMap::<&str, [Counts; 2]>::new();
    let text = outputs::read_text(path)?;
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()) {
        let caption: Caption = serde_json::from_str(line).map_err(|error| bad(number, &error))?;
        let program = read(director, &caption.caption)?;
        for (motion, is_there) in &caption.labels {
            let Some((name, [read, keywords])) = found(motion, &program, &caption.caption) else { continue };
            let [of_program, of_keywords] = counts.entry(name).or_default();
            of_program.add([read, *is_there]);
            of_keywords.add([keywords, *is_there]);
        }
    }
    let mut table = String::from("motion,captions,director_f1,keywords_f1\n");
    for (motion, [director, keywords]) in &counts {
        let total = director.hits + director.misses;
        // Writing to a string cannot fail.
        let _ = writeln!(table, "{motion},{total},{:.3},{:.3}", director.f1(), keywords.f1());
    }
    let mean = |nth: usize| counts.values().map(|both| both[nth].f1()).sum::<f64>() / counts.len().max(1) as f64;
    let _ = writeln!(table, "mean,,{:.3},{:.3}", mean(0), mean(1));
    Ok(table)
}

/// The program of a caption about things that are all there.
fn read(director: &Director, caption: &str) -> Result<Program, Failure> {
    let linked = director.link(caption, &[])?;
    let scene = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::ZERO, size: 4.0 };
    match director.direct(&linked, &scene) {
        Ok(direction) => Ok(direction.program),
        Err(_) => Ok(Program::default()),
    }
}

/// Name of a motion, and whether the program and the keywords have it; `None` for an unknown motion.
fn found(motion: &str, program: &Program, caption: &str) -> Option<(&'static str, [bool; 2])> {
    if motion == "Static" {
        let is_still = |movement: &Move| matches!(movement, Move::Static | Move::Handheld);
        let read = program.steps.iter().all(|step| is_still(&step.movement) && step.with.iter().all(is_still));
        let words = caption.to_lowercase();
        let keywords = ["static", "stationary", "does not move", "fixed"].iter().any(|word| words.contains(word));
        return Some(("Static", [read, keywords]));
    }
    let (name, moves, phrases) = MOTIONS.iter().find(|(name, ..)| *name == motion)?;
    let has = |step: &cinesplat::operator::Step| {
        (!step.either_way && moves.contains(&step.movement)) || step.with.iter().any(|second| moves.contains(second))
    };
    let words = caption.to_lowercase();
    Some((*name, [program.steps.iter().any(has), phrases.iter().any(|phrase| words.contains(phrase))]))
}
