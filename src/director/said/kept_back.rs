//! What a film keeps for its end: `let us find the guitar last`, `close along the top, never the whole thing until the last moments`.

use cinesplat_language::{Linked, add_ids, is_listed};
use cinesplat_operator::{Framing, Pass, Step};
use cinesplat_trajectory::{Move, ShotSize};

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of what is seen only then, and words of the end of a film.
const FINDS: [&str; 4] = ["find", "discover", "notice", "spot"];
const LAST: &str = "last lastly finally late";
/// Words of a near picture.
const CLOSE: &str = "close closeup close-up tight near details detail macro";
/// Most words between a verb and the end.
const NEAR: usize = 5;
/// Most words between `the whole` and those that keep it for the end.
const AROUND: usize = 8;

/// Shows at its end what a film keeps for it.
pub(crate) fn keep_for_end(linked: &Linked, direction: &mut Direction) {
    find_last(linked, direction);
    show_whole_last(linked, direction);
    widen_last(linked, direction);
}

/// Goes back from a detail to all of a thing, where the one step goes the other way: `first a detail and only later the whole of it`.
fn widen_last(linked: &Linked, direction: &mut Direction) {
    let [step] = &mut direction.program.steps[..] else { return };
    let words = linked.texts_in([0, usize::MAX]);
    let nears = matches!(step.movement, Move::PushIn | Move::Follow | Move::ZoomIn | Move::Static | Move::Reveal);
    let mut subjects = step.start.subjects.clone();
    add_ids(&mut subjects, &step.end.subjects);
    let is_of_one = subjects.len() == 1 && step.via.is_none() && step.with.is_empty();
    if !(nears && is_of_one && ends_on_whole(&words)) {
        return;
    }
    let size = step.start.size.or(Some(ShotSize::CloseUp));
    step.movement = Move::PullOut;
    step.start = Framing { subjects: subjects.clone(), size, ..Framing::default() };
    step.end = Framing { subjects, whole: true, ..Framing::default() };
    step.amount = None;
}

/// Whether words show a detail first and all of the thing later.
fn ends_on_whole(words: &[&str]) -> bool {
    let detail = words.iter().position(|word| is_listed("detail details fragment glimpse macro", word));
    let Some(detail) = detail else { return false };
    let is_first = words[..detail]
        .iter()
        .rev()
        .take(AROUND)
        .any(|word| is_listed("first start starting begin beginning from", word));
    let rest = &words[detail + 1..];
    let whole = rest.iter().position(|word| is_listed("whole entire complete full all everything", word));
    let is_later = |whole: usize| {
        rest[..whole]
            .iter()
            .rev()
            .take(AROUND)
            .any(|word| is_listed("later then finally last end only until till", word))
    };
    is_first && whole.is_some_and(is_later)
}

/// Reveals from behind a thing what the words bring out `from behind` it.
pub(crate) fn reveal_from_behind(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Reveal) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(via) = step.via.as_mut().filter(|via| via.how == Pass::Past) else { continue };
        let cover = linked.expanded(&via.objects);
        let is_cover = |word: &&str| linked.stands_for(word, &cover);
        let comes_out =
            |at: usize| words[at..].starts_with(&["from", "behind"]) && words[at..].get(2).is_some_and(is_cover);
        if (0..words.len()).any(comes_out) {
            via.how = Pass::Behind;
        }
    }
}

/// Rises from behind a thing to what the words reveal over it: `reveal the sofa: start low behind the chair, rise up and see the sofa and
/// the table over the top of it` is one move.
pub(crate) fn rise_from_behind(linked: &Linked, direction: &mut Direction) {
    let steps = &direction.program.steps;
    let Some(first) = steps.first().filter(|step| step.movement == Move::Reveal) else { return };
    let Some(cover) = first.via.as_ref().filter(|via| via.how == Pass::Behind).map(|via| via.objects.clone()) else {
        return;
    };
    let words = linked.texts_in([0, usize::MAX]);
    let hides = words.windows(2).any(|pair| pair == ["hidden", "behind"] || pair == ["hiding", "behind"])
        || words.windows(2).any(|pair| pair == ["low", "behind"]);
    let rises = |step: &Step| matches!(step.movement, Move::CraneUp | Move::PedestalUp);
    let Some(rise) = steps.get(1).filter(|step| rises(step) && hides) else { return };
    let shares = |step: &Step| step.end.subjects.iter().any(|id| first.end.subjects.contains(id));
    // Behind the rise only rests on what it shows follow.
    let rests = |step: &Step| step.movement == Move::Static && (step.end.subjects.is_empty() || shares(step));
    if !shares(rise) || !steps[2..].iter().all(rests) {
        return;
    }
    let mut end = rise.end.clone();
    let shown =
        steps[2..].iter().flat_map(|step| step.end.subjects.iter().chain(step.via.iter().flat_map(|via| &via.objects)));
    let shown: Vec<u32> = shown.filter(|id| !cover.contains(id)).copied().collect();
    add_ids(&mut end.subjects, &shown);
    let words =
        steps.iter().fold(first.words, |words, step| Step { words, ..Step::of(Move::Static) }.joint_words(step));
    let with = vec![Move::PedestalUp];
    let one = Step { end, with, words, ..first.clone() };
    while direction.program.steps.len() > 1 {
        direction.remove_step(1);
    }
    direction.program.steps[0] = one;
}

/// Begins where the one thing that is found last is not seen.
fn find_last(linked: &Linked, direction: &mut Direction) {
    let words = linked.texts_in([0, usize::MAX]);
    let mut moving = direction.program.steps.iter_mut().filter(|step| step.movement != Move::Static);
    let (Some(step), None) = (moving.next(), moving.next()) else { return };
    let is_way = matches!(step.movement, Move::Follow | Move::PushIn | Move::FlyThrough);
    let is_open = step.start == Framing::default() && step.via.is_none() && step.with.is_empty() && step.look.is_none();
    if is_way && is_open && step.end.subjects.len() == 1 && finds_last(&words) {
        step.movement = Move::Reveal;
    }
}

fn finds_last(words: &[&str]) -> bool {
    let is_find = |at: usize| FINDS.iter().any(|verb| is_form(words[at], verb));
    let behind = |at: usize| words[at + 1..].iter().take(NEAR).take_while(|word| **word != ".");
    (0..words.len()).any(|at| is_find(at) && behind(at).any(|word| is_listed(LAST, word)))
}

/// Goes close along a thing first and shows all of it then.
fn show_whole_last(linked: &Linked, direction: &mut Direction) {
    let [step] = &direction.program.steps[..] else { return };
    let words = linked.texts_in([0, usize::MAX]);
    let slides = matches!(
        step.movement,
        Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown | Move::ArcLeft | Move::ArcRight
    );
    let is_of_one = step.end.subjects.len() == 1
        && (step.start.subjects.is_empty() || step.start.subjects == step.end.subjects)
        && step.via.as_ref().is_none_or(|via| via.objects == step.end.subjects);
    let is_plain = step.duration_secs.is_none() && !step.returns && step.end.size.is_none();
    if !(slides && is_of_one && is_plain && keeps_whole_back(&words)) {
        return;
    }
    let subjects = step.end.subjects.clone();
    let whole = Framing { subjects: subjects.clone(), whole: true, ..Framing::default() };
    let close = Framing { subjects, size: Some(ShotSize::CloseUp), ..Framing::default() };
    let first = Step { start: close, end: Framing::default(), via: None, ..step.clone() };
    let last = Step { end: whole, speed: step.speed, words: step.words, ..Step::of(Move::PullOut) };
    direction.replace_steps(vec![first, last]);
}

/// Whether words show details, and all of the thing only at last.
fn keeps_whole_back(words: &[&str]) -> bool {
    let is_close = words.iter().any(|word| is_listed(CLOSE, word));
    let is_whole = |at: usize| is_listed("whole entire complete full all", words[at]);
    let waits = |at: usize| {
        let to = words.len().min(at + 1 + AROUND);
        words[at + 1..to].iter().any(|word| is_listed("until till only", word))
            && words[at.saturating_sub(AROUND)..to].iter().any(|word| is_listed("last end finally very", word))
    };
    is_close && (0..words.len()).any(|at| is_whole(at) && waits(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::{about, direction, linked};
    use cinesplat_operator::Via;

    fn moves(text: &str, movement: Move) -> Vec<Move> {
        let mut direction = direction(vec![about(movement, &[5], [0, text.len()])]);
        keep_for_end(&linked(text), &mut direction);
        direction.program.steps.iter().map(|step| step.movement).collect()
    }

    #[test]
    fn what_is_found_last_is_not_seen_first() {
        assert_eq!(moves("drift , let us find <obj-0> last", Move::Follow), [Move::Reveal]);
        assert_eq!(moves("drift and discover <obj-0> only at last", Move::PushIn), [Move::Reveal]);
        assert_eq!(moves("drift over to <obj-0> at last", Move::Follow), [Move::Follow]);
        assert_eq!(moves("find <obj-0> . the last one on the left", Move::Follow), [Move::Follow]);
    }

    #[test]
    fn a_rise_from_behind_a_thing_is_one_reveal() {
        let read = |text: &str| {
            let [first, second] = ["rise", "over"].map(|word| text.find(word).unwrap());
            let mut reveal = about(Move::Reveal, &[7], [0, first]);
            reveal.via = Some(Via { how: Pass::Behind, objects: vec![5] });
            let rest = Step { end: Framing::default(), ..about(Move::Static, &[], [second, text.len()]) };
            let mut direction = direction(vec![reveal, about(Move::CraneUp, &[7, 9], [first, second]), rest]);
            rise_from_behind(&linked(text), &mut direction);
            let steps = direction.program.steps;
            (steps.len(), steps[0].with.clone(), steps[0].end.subjects.clone())
        };
        let one = (1, vec![Move::PedestalUp], vec![7, 9]);
        assert_eq!(read("start low hidden behind <obj-0> , rise and see <obj-1> over it"), one);
        assert_eq!(read("come from <obj-0> , rise and see <obj-1> over it").0, 3);
    }

    #[test]
    fn what_comes_out_from_behind_a_thing_is_hidden_by_it() {
        let how = |text: &str| {
            let mut step = about(Move::Reveal, &[5], [0, text.len()]);
            step.via = Some(Via { how: Pass::Past, objects: vec![7] });
            let mut steps = [step];
            reveal_from_behind(&linked(text), &mut steps);
            steps[0].via.as_ref().map(|via| via.how)
        };
        assert_eq!(how("reveal <obj-0> from behind <obj-1>"), Some(Pass::Behind));
        assert_eq!(how("reveal <obj-0> past <obj-1>"), Some(Pass::Past));
    }

    #[test]
    fn a_detail_comes_before_all_of_it() {
        let said = "come at <obj-0> like a relic , first a detail and only later the whole of it";
        assert_eq!(moves(said, Move::PushIn), [Move::PullOut]);
        assert_eq!(moves("first the whole of <obj-0> , then a detail of it", Move::PushIn), [Move::PushIn]);
        assert_eq!(moves("show a detail of <obj-0>", Move::Static), [Move::Static]);
    }

    #[test]
    fn details_come_before_the_whole_thing() {
        let said = "close along the top of <obj-0> , never the whole thing until the last moments";
        assert_eq!(moves(said, Move::TruckRight), [Move::TruckRight, Move::PullOut]);
        assert_eq!(moves("slide along the whole of <obj-0>", Move::TruckRight), [Move::TruckRight]);
    }
}
