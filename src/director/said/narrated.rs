//! Films through the eyes of somebody who gets up: `you come to on the floor, you get up, you see the clock, then the way out: the
//! door. End on it, creeping towards it`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Speed, Step};
use cinesplat_trajectory::Move;

use super::briefs::{is_loose, pace};
use crate::direction::Direction;

/// Words of somebody who lies somewhere, and of what he lies on.
const LIES: [&[&str]; 12] = [
    &["come", "to"],
    &["comes", "to"],
    &["wake"],
    &["wakes"],
    &["waking"],
    &["woke"],
    &["lie"],
    &["lies"],
    &["lying"],
    &["flat", "on"],
    &["knocked", "out"],
    &["passed", "out"],
];
const LOW_PLACES: &str = "floor ground carpet rug back boards tiles";
/// Words of somebody who gets up.
// An idiom has `get up` rise.
const GETS_UP: [&[&str]; 11] = [
    &["pedestal", "up"],
    &["get", "up"],
    &["gets", "up"],
    &["getting", "up"],
    &["stand", "up"],
    &["stands", "up"],
    &["standing", "up"],
    &["to", "your", "feet"],
    &["to", "his", "feet"],
    &["to", "her", "feet"],
    &["struggle", "up"],
];
/// Words of a way to what is seen last.
const NEARS: &str = "creep creeps creeping approach approaching towards toward walk walking stumble stumbling crawl crawling head \
    heading closer reach reaching go";
/// Words between a thing and the one that says where it is.
const WHERE: &str = "over above on in by under near beside behind the a";
/// Heights of eyes on the floor and of those of somebody who stands, scene units.
const LYING: f64 = 0.3;
const STANDING: f64 = 1.6;
/// Most things that are looked at.
const MOST: usize = 5;

/// Films what somebody sees who gets up from the floor, where the network has made little of it. Says whether the words tell that.
pub(crate) fn film_narrated(linked: &Linked, direction: &mut Direction) -> bool {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let found =
        |phrases: &[&[&str]]| (0..words.len()).find(|at| phrases.iter().any(|phrase| words[*at..].starts_with(phrase)));
    let (Some(lies), Some(rises)) = (found(&LIES), found(&GETS_UP)) else { return false };
    let is_low = words[lies..].iter().take(8).any(|word| is_listed(LOW_PLACES, word));
    if !is_low || rises < lies || !is_loose(direction, &words) || linked.timeline.is_some() {
        return false;
    }
    let mut seen: Vec<Vec<u32>> = Vec::new();
    // `The clock over the desk` is one thing.
    let is_where = |at: usize| {
        let before: Vec<&&str> = words[..at].iter().rev().take(3).collect();
        before.iter().any(|word| word.starts_with("<obj-"))
            && before.iter().take_while(|word| !word.starts_with('<')).all(|word| is_listed(WHERE, word))
    };
    let slots = (rises..words.len()).filter(|at| !is_where(*at)).filter_map(|at| linked.slot_at(words[at]));
    for id in slots.filter(|id| linked.missing(*id).is_none()) {
        let ids = linked.expanded(&[id]);
        // What is named again is what it ends on.
        seen.retain(|other| *other != ids);
        seen.push(ids);
    }
    seen.truncate(MOST);
    let Some(last) = seen.last().cloned() else { return false };
    let nears = words[rises..].iter().any(|word| is_listed(NEARS, word));
    let steps = steps(&seen, &last, nears, pace(&words));
    let span = direction.span();
    direction.replace_steps(steps.into_iter().map(|step| Step { words: span, ..step }).collect());
    true
}

/// The rise, a look at each thing, and the way to the last one.
fn steps(seen: &[Vec<u32>], last: &[u32], nears: bool, speed: Speed) -> Vec<Step> {
    let about = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
    let at = |height: f64| Framing { height: Some(height), ..Framing::default() };
    let mut steps = vec![Step { start: at(LYING), end: at(STANDING), speed, ..Step::of(Move::PedestalUp) }];
    let look = |ids: &Vec<u32>| Step { end: about(ids), either_way: true, speed, ..Step::of(Move::PanRight) };
    steps.extend(seen.iter().map(look));
    if nears {
        steps.push(Step { end: about(last), speed: Speed::Slow, ..Step::of(Move::PushIn) });
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, linked};
    use super::*;

    fn moves(text: &str) -> Vec<(Move, Vec<u32>)> {
        let step = Step { words: Some([0, text.len()]), ..Step::of(Move::Static) };
        let mut read = direction(vec![step]);
        film_narrated(&linked(text), &mut read);
        read.program.steps.into_iter().map(|step| (step.movement, step.end.subjects)).collect()
    }

    #[test]
    fn who_gets_up_sees_one_thing_after_the_other() {
        let told = "you come to on the floor of this workshop . you get up , you see <obj-0> , then the way out : <obj-1> . end \
                    on <obj-1> , creeping towards it";
        let want =
            [(Move::PedestalUp, vec![]), (Move::PanRight, vec![5]), (Move::PanRight, vec![7]), (Move::PushIn, vec![7])];
        assert_eq!(moves(told), want);
        let over = moves("lying on the floor you get up and see <obj-0> over the <obj-1>");
        assert_eq!(over, [(Move::PedestalUp, vec![]), (Move::PanRight, vec![5])]);
        assert_eq!(moves("you get up late and see <obj-0>"), [(Move::Static, vec![])]);
        assert_eq!(moves("we come to <obj-0> and get up to <obj-1>"), [(Move::Static, vec![])]);
    }
}
