//! Films in which nothing would move because their words were not understood.

use cinesplat_director::Direction;
use cinesplat_language::{is_listed, tokenize};
use cinesplat_trajectory::Move;

/// Below this probability a rest is more likely a move that was not understood.
const DOUBTFUL: f64 = 0.25;
/// Words that ask for a picture that stands still.
const STILL: &str = "static still stills locked lock lockdown fixed frozen freeze motionless stationary immobile unmoving tripod sticks \
    hold holds holding held stay stays staying rest rests stop stops linger lingers wait photo photograph picture portrait postcard \
    snapshot shot frame framing composition tableau view thumbnail packshot";

/// Comes up to what a film of one rest would show, where the rest is unlikely and no word asks for it: a request that is half
/// understood is met better by a way to its subject than by a photograph.
pub(super) fn approach(prompt: &str, direction: &mut Direction) {
    let [step] = &mut direction.program.steps[..] else { return };
    let rests = step.movement == Move::Static && step.with.is_empty() && step.via.is_none();
    let is_doubtful =
        !direction.certainty.is_empty() && direction.certainty.iter().all(|certainty| certainty.probability < DOUBTFUL);
    let is_still = tokenize(prompt).iter().any(|word| is_listed(STILL, &word.text));
    if !rests || !is_doubtful || is_still || step.end.subjects.is_empty() {
        return;
    }
    // A way from one thing to another.
    let leads = !step.start.subjects.is_empty() && step.start.subjects != step.end.subjects;
    step.movement = if leads { Move::Follow } else { Move::PushIn };
    step.duration_secs = None;
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_director::StepCertainty;
    use cinesplat_operator::{Framing, Program, Step};

    fn movement(prompt: &str, probability: f64, start: &[u32]) -> Move {
        let framing = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
        let step = Step { start: framing(start), end: framing(&[1]), ..Step::of(Move::Static) };
        let mut direction = Direction::of(Program { steps: vec![step], ..Program::default() });
        direction.certainty = vec![StepCertainty { probability, weakest: ("move", probability), words: None }];
        approach(prompt, &mut direction);
        direction.program.steps[0].movement
    }

    #[test]
    fn a_doubtful_rest_that_nobody_asks_for_is_a_way() {
        assert_eq!(movement("get nice and near to the little padded arms", 0.14, &[]), Move::PushIn);
        assert_eq!(movement("bring me there, leaving from the plaid", 0.14, &[2]), Move::Follow);
        assert_eq!(movement("get nice and near to the little padded arms", 0.6, &[]), Move::Static);
        assert_eq!(movement("a nice still of the little padded arms", 0.14, &[]), Move::Static);
    }
}
