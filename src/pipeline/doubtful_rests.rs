//! Films in which nothing would move because their words were not understood.

use cinesplat_director::Direction;
use cinesplat_language::{Word, is_listed, tokenize};
use cinesplat_operator::{Amount, Speed, Step};
use cinesplat_trajectory::Move;

/// Below this probability a rest is more likely a move that was not understood.
const DOUBTFUL: f64 = 0.25;
/// Words that ask for a picture that stands still.
const STILL: &str = "static still stills locked lock lockdown fixed frozen freeze motionless stationary immobile unmoving tripod sticks \
    hold holds holding held stay stays staying rest rests stop stops linger lingers wait photo photograph picture portrait postcard \
    snapshot composition tableau thumbnail packshot";
/// Words for a picture, which may move.
const PICTURES: &str = "shot frame framing view";
/// Words before `around` of who is shown a place: `show me around`, `have a look around`.
const SHOWN: &str = "me us them you him her everyone everybody people buyers guests look peek";
/// Words of what a film is for or feels like: it lives.
const MOODS: &str = "important opening establishing establisher intro introduction introductory hero heroic dramatic epic calm cosy \
    cozy moody dreamy romantic mysterious ominous atmospheric tense majestic magical melancholic nostalgic intimate peaceful serene \
    spooky creepy powerful";

/// Comes up to what a film of one rest would show, where no word asks for a rest and it is unlikely, or the words say what the
/// film feels like: such a request is met better by a way to its subject than by a photograph.
pub(super) fn approach(prompt: &str, direction: &mut Direction) {
    let [step] = &mut direction.program.steps[..] else { return };
    let rests = step.movement == Move::Static && step.with.is_empty() && step.via.is_none();
    let is_doubtful =
        !direction.certainty.is_empty() && direction.certainty.iter().all(|certainty| certainty.probability < DOUBTFUL);
    let words = tokenize(prompt);
    let says = |list: &str| words.iter().any(|word| is_listed(list, &word.text));
    if !rests || says(STILL) {
        return;
    }
    let shows = |pair: &[Word]| is_listed(SHOWN, &pair[0].text) && pair[1].text == "around";
    if step.end.subjects.is_empty() && words.windows(2).any(shows) {
        *step = Step { words: step.words, duration_secs: step.duration_secs, speed: step.speed, ..Step::look_around() };
        return;
    }
    if says(MOODS) {
        come_nearer(step);
        return;
    }
    if !is_doubtful || says(PICTURES) || step.end.subjects.is_empty() {
        return;
    }
    // A way from one thing to another.
    let leads = !step.start.subjects.is_empty() && step.start.subjects != step.end.subjects;
    step.movement = if leads { Move::Follow } else { Move::PushIn };
    step.duration_secs = None;
}

/// Goes in slowly and a little.
fn come_nearer(step: &mut Step) {
    (step.movement, step.speed) = (Move::PushIn, Speed::Slow);
    step.amount = step.amount.or(Some(Amount::Slight));
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_director::StepCertainty;
    use cinesplat_operator::{Framing, Program};

    fn movement(prompt: &str, probability: f64, start: &[u32]) -> Move {
        let framing = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
        let step = Step { start: framing(start), end: framing(&[1]), ..Step::of(Move::Static) };
        let mut direction = Direction::of(Program { steps: vec![step], ..Program::default() });
        direction.certainty = vec![StepCertainty::of(probability, None)];
        approach(prompt, &mut direction);
        direction.program.steps[0].movement
    }

    #[test]
    fn a_doubtful_rest_that_nobody_asks_for_is_a_way() {
        assert_eq!(movement("get nice and near to the little padded arms", 0.14, &[]), Move::PushIn);
        assert_eq!(movement("bring me there, leaving from the plaid", 0.14, &[2]), Move::Follow);
        assert_eq!(movement("get nice and near to the little padded arms", 0.6, &[]), Move::Static);
        assert_eq!(movement("a nice still of the little padded arms", 0.14, &[]), Move::Static);
        assert_eq!(movement("a shot of the little padded arms", 0.14, &[]), Move::Static);
    }

    #[test]
    fn who_is_shown_around_looks_around() {
        let step = Step::of(Move::Static);
        let mut direction = Direction::of(Program { steps: vec![step], ..Program::default() });
        approach("hi, can you just show me around?", &mut direction);
        assert_eq!(direction.program.steps[0], Step::look_around());
    }

    #[test]
    fn a_mood_is_no_still() {
        assert_eq!(movement("make the lamp look important", 0.6, &[]), Move::PushIn);
        assert_eq!(movement("a calm opening shot of the lamp", 0.6, &[]), Move::PushIn);
        assert_eq!(movement("a calm static shot of the lamp", 0.6, &[]), Move::Static);
    }
}
