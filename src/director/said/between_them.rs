//! Two things that are passed without their names: `frame the two statues together, then push in between them`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::Move;

/// Leads a step between the two things that were named together before it, where its words say `between them`.
pub(crate) fn pass_between_them(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let bytes = step.words.unwrap_or_default();
        let words: Vec<(&str, [usize; 2])> = linked.words_in(bytes).collect();
        let says = |pair: &[(&str, [usize; 2])]| pair[0].0 == "between" && pair[1].0 == "them";
        let Some(at) = words.windows(2).position(says) else { continue };
        let before: Vec<&str> = linked.words_in([0, words[at].1[0]]).map(|(word, _)| word).collect();
        let named = before.iter().rev().find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let Some(pair) = named.filter(|pair| pair.len() == 2) else { continue };
        let is_way = matches!(step.movement, Move::PushIn | Move::PullOut | Move::Follow | Move::FlyThrough);
        if !is_way {
            continue;
        }
        if linked.expanded(&step.end.subjects).iter().all(|id| pair.contains(id)) {
            step.end = Framing::default();
        }
        step.movement = Move::FlyThrough;
        step.via = Some(Via { how: Pass::Between, objects: pair });
    }
}

#[cfg(test)]
mod tests {
    use cinesplat_language::Group;

    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn between_them_is_between_the_two_that_were_named() {
        let text = "frame <obj-0> , push in between them";
        let step = |members: &[u32]| {
            let group = Group { id: 5, members: members.to_vec(), name: "statues".to_owned(), nearest: Vec::new() };
            let linked = Linked { groups: vec![group], ..linked(text) };
            let mut steps = [about(Move::PushIn, &[5], [0, text.len()])];
            pass_between_them(&linked, &mut steps);
            steps[0].via.clone()
        };
        assert_eq!(step(&[1, 2]), Some(Via { how: Pass::Between, objects: vec![1, 2] }));
        assert_eq!(step(&[1, 2, 3]), None);
    }
}
