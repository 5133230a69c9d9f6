//! Moves that are taken back by name: `crane up while orbiting the teapot; actually leave out the orbit`.

use cinesplat_language::Linked;
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs that take back, and their particle.
const BACK: [(&str, &str); 8] = [
    ("leave", "out"),
    ("skip", ""),
    ("forget", ""),
    ("drop", ""),
    ("scrap", ""),
    ("lose", ""),
    ("ditch", ""),
    ("cancel", ""),
];

/// Words that deny what follows.
const DENIALS: [&str; 7] = ["no", "not", "never", "'t", "n't", "don", "dont"];

/// Removes the moves that the words take back, where something else remains.
pub(crate) fn drop_taken_back(linked: &Linked, direction: &mut Direction) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    for (at, name) in (0..texts.len()).filter_map(|at| Some((at, taken_back_at(&texts, at)?))) {
        let byte = words[at].1[0];
        let is_named = |movement: &Move| names(name, *movement) || names_way(name, *movement);
        for nth in (0..direction.program.steps.len()).rev() {
            let num_steps = direction.program.steps.len();
            let step = &mut direction.program.steps[nth];
            // A way that a clause adds to the next one is said in neither.
            if matches!(name, "up" | "down") {
                step.with.retain(|movement| !is_named(movement));
            }
            // What is taken back was said before.
            if step.words.is_none_or(|[from, _]| from >= byte) {
                continue;
            }
            step.with.retain(|movement| !is_named(movement));
            if !is_named(&step.movement) {
                continue;
            }
            if step.with.is_empty() {
                if num_steps > 1 {
                    direction.remove_step(nth);
                }
            } else {
                (step.movement, step.either_way) = (step.with.remove(0), false);
            }
        }
    }
}

/// The name of the move that the words from word `at` on take back.
fn taken_back_at<'a>(words: &[&'a str], at: usize) -> Option<&'a str> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let (_, particle) = BACK.iter().find(|(verb, _)| *verb == word(at))?;
    // `Never drop the pan` takes nothing back, but `no scrap the up` does.
    let said = if at > 0 && words[at - 1] == "no" { at - 1 } else { at };
    if words[said.saturating_sub(3)..said].iter().any(|word| DENIALS.contains(word)) {
        return None;
    }
    let next = at + 1 + usize::from(!particle.is_empty() && word(at + 1) == *particle);
    let is_split = !particle.is_empty() && next == at + 1;
    let name = next + usize::from(matches!(word(next), "the" | "that"));
    let end = name + 1 + usize::from(is_split && word(name + 1) == *particle);
    let is_complete = name > next && (!is_split || end > name + 1);
    let ends = matches!(word(end), "" | "." | "," | ";" | "!" | "part" | "bit" | "and" | "then" | ")");
    (is_complete && ends).then(|| word(name))
}

/// Whether a word names a move.
pub(super) fn names(word: &str, movement: Move) -> bool {
    let is = |verb: &str| is_form(word, verb);
    match movement {
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => is("orbit") || is("circle") || is("arc"),
        Move::ZoomIn | Move::ZoomOut => is("zoom"),
        Move::PanLeft | Move::PanRight => is("pan"),
        Move::TiltUp | Move::TiltDown => is("tilt"),
        Move::RollCw | Move::RollCcw => is("roll"),
        Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown => {
            is("crane") || is("rise") || is("boom") || is("pedestal") || is("descent")
        }
        Move::PushIn => is("push") || is("dolly"),
        Move::PullOut => is("pull"),
        Move::Handheld => is("shake") || is("handheld"),
        Move::TruckLeft | Move::TruckRight => is("truck") || is("slide") || is("track"),
        Move::Static => is("hold"),
        _ => false,
    }
}

/// Whether a word names the way of a rise or a descent: `scrap the up`.
fn names_way(word: &str, movement: Move) -> bool {
    match movement {
        Move::CraneUp | Move::PedestalUp | Move::TiltUp => word == "up",
        Move::CraneDown | Move::PedestalDown | Move::TiltDown => word == "down",
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_is_taken_back_by_its_name() {
        let says = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).find_map(|at| taken_back_at(&words, at).map(str::to_owned))
        };
        assert_eq!(says("crane up while orbiting <obj-0> ; actually leave out the orbit").as_deref(), Some("orbit"));
        assert_eq!(says("out and up . . . no scrap the up , just out").as_deref(), Some("up"));
        assert!(names_way("up", Move::CraneUp) && !names_way("up", Move::CraneDown));
        assert_eq!(says("leave the zoom out .").as_deref(), Some("zoom"));
        assert_eq!(says("pan to <obj-0> , skip the zoom").as_deref(), Some("zoom"));
        assert_eq!(says("drop the camera to the floor"), None);
        assert_eq!(says("leave the frame"), None);
    }
}
