//! Things of the scene that are told to act: `make the bear turn its head, then push in on its face`.
//!
//! No camera can do it. Enters: a prompt and its mentions of objects. Leaves: the bytes of such clauses, and the mentions
//! without theirs; what a pronoun behind such a clause stands for is who was told to act.

use cinesplat_language::{LanguageError, Mention, NamedObject, Word, is_listed, part_of, tokenize};

use crate::explained::insert_mention;
use crate::names::FoundMention;
use crate::said::is_form;

/// Verbs that tell somebody to act, and words between the actor and what he does.
const CAUSES: &str = "make makes making have having get getting let tell ask order want need";
const LINKS: &str = "to should must will shall would could can now then suddenly slowly starts start begins begin";
/// What only the living and machines do.
const ACTS: &str = "jump leap hop blink wink wave dance bark meow purr roar sing talk speak say \
    shout yell scream kneel crawl swim yawn sneeze cough bow clap kick punch juggle gallop trot limp stagger topple tumble shatter crumble levitate";
/// What somebody is told to do, and what the words say as well of things at rest (`the road runs along the wall`).
const TOLD_ACTS: &str = "smile grin laugh cry weep frown walk run fly sit stand lie sleep wake eat drink breathe stretch open \
    explode burn melt collapse ring strike chime light shine flicker grow shrink fall climb ride drive dress undress cook clean play pose shake switch";
/// Verbs of what one does with one's own: `turns its head`.
const OWN_ACTS: &str =
    "turn move lift raise tilt shake nod bow drop lower open close wag flap wave stretch bend swing roll";
const OWN: &str = "its his her their";
/// What is one's own and moves.
const LIMBS: &str = "head heads face eye eyes eyelids mouth jaw lips arm arms hand hands paw paws leg legs foot feet tail wing wings \
    ear ears beak neck body lid door doors finger fingers trunk";
/// Words behind `runs` by which it is a way of the living.
const AWAY: &str = "off away over up";
/// Words that end a clause, and marks.
const ENDS: &str = "then while as and but so until before after";
/// Words before a clause of its own.
const OPENERS: &str = "then and while as when so but that";
const PRONOUNS: &str = "it him them";

/// The bytes of the clauses in which a thing is told to act. Nothing of a prompt that says nothing else.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of parts.
pub(crate) fn acts(
    prompt: &str,
    objects: &[NamedObject],
    found: &mut Vec<FoundMention>,
) -> Result<Vec<[usize; 2]>, LanguageError> {
    let words = tokenize(prompt);
    let mut clauses: Vec<(Vec<u32>, [usize; 2])> = Vec::new();
    for mention in found.iter().map(|found| &found.mention).filter(|mention| !mention.ids.is_empty()) {
        clauses.extend(clause_of(&words, mention).map(|clause| (mention.ids.clone(), clause)));
    }
    let bytes = |[from, to]: [usize; 2]| [words[from].span[0], words[to - 1].span[1]];
    let spans: Vec<[usize; 2]> = clauses.iter().map(|(_, clause)| bytes(*clause)).collect();
    let is_inside = |at: usize| spans.iter().any(|[from, to]| (*from..*to).contains(&at));
    let is_left = |word: &Word| word.is_alphabetic() && !is_inside(word.span[0]) && !is_listed(ENDS, &word.text);
    if !words.iter().any(is_left) {
        return Ok(Vec::new());
    }
    found.retain(|found| !is_inside(found.mention.bytes[0]));
    for (ids, [_, to]) in &clauses {
        point_to_actor(&words, objects, ids, *to, found)?;
    }
    Ok(spans)
}

/// The clause in which the thing of a mention is told to act, or acts.
fn clause_of(words: &[Word], mention: &Mention) -> Option<[usize; 2]> {
    let [start, end] = mention.bytes;
    let first = words.iter().position(|word| (start..end).contains(&word.span[0]))?;
    let behind = words.iter().position(|word| word.span[0] >= end)?;
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let is_told = first > 0 && is_listed(CAUSES, text(first - 1));
    let opens = first == 0 || is_listed(OPENERS, text(first - 1)) || !words[first - 1].is_alphabetic();
    let verb = behind + (behind..words.len()).take_while(|at| is_listed(LINKS, text(*at))).count();
    let has_modal = verb > behind;
    let said = text(verb);
    // `The cat waves`, and `the cat should wave`.
    let fits = |list: &str| list.split_ascii_whitespace().any(|act| is_form(said, act)) && !said.ends_with("ing");
    let acts_with_own = || fits(OWN_ACTS) && is_listed(OWN, text(verb + 1)) && is_listed(LIMBS, text(verb + 2));
    let is_finite = is_told || has_modal || said.ends_with('s');
    let goes_away = || fits(TOLD_ACTS) && is_listed(AWAY, text(verb + 1)) && is_finite;
    let acts = fits(ACTS) || acts_with_own() || (is_told || has_modal) && fits(TOLD_ACTS) || goes_away();
    if !(acts && is_finite && (is_told || opens)) {
        return None;
    }
    let ends =
        |at: &usize| is_listed(ENDS, text(*at)) || matches!(text(*at), "," | "." | ";" | ":" | "!" | "?" | "-" | "(");
    let to = (verb + 1..words.len()).find(ends).unwrap_or(words.len());
    let from = if is_told { first - 1 } else { first };
    let is_joint = |at: usize| {
        is_listed("while as when that", text(at)) || is_listed("please can you could i we to just", text(at))
    };
    let from = (0..from).rev().take_while(|at| is_joint(*at)).last().unwrap_or(from);
    Some([from, to])
}

/// Makes the pronouns behind a clause, up to the next name, stand for who acts in it.
fn point_to_actor(
    words: &[Word],
    objects: &[NamedObject],
    ids: &[u32],
    from: usize,
    found: &mut Vec<FoundMention>,
) -> Result<(), LanguageError> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let label = objects.iter().find(|object| ids == [object.id]).map_or("", |object| object.label.as_str());
    for at in from..words.len() {
        let is_own = is_listed(OWN, text(at));
        let named = found
            .iter_mut()
            .find(|found| (found.mention.bytes[0]..found.mention.bytes[1]).contains(&words[at].span[0]));
        match named {
            Some(named) if is_own || is_listed(PRONOUNS, text(at)) => named.mention.ids = ids.to_vec(),
            Some(_) => return Ok(()),
            None if is_own || is_listed(PRONOUNS, text(at)) => {
                let part = format!("{} {}", text(at), text(at + 1));
                let is_part = is_own && part_of(&part, label)?.is_some();
                let to = if is_part { at + 1 } else { at };
                if is_part || !is_own {
                    let bytes = [words[at].span[0], words[to].span[1]];
                    insert_mention(found, Mention { bytes, ids: ids.to_vec() });
                }
            }
            None => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(prompt: &str) -> (Vec<&str>, Vec<u32>) {
        let objects = [(1, "cat"), (2, "chair")].map(|(id, label)| NamedObject { id, label: label.to_owned() });
        let mut found = Vec::new();
        for (name, id) in [("the cat", 1), ("the chair", 2)] {
            found.extend(prompt.match_indices(name).map(|(at, name)| FoundMention {
                mention: Mention { bytes: [at, at + name.len()], ids: vec![id] },
                probability: 1.0,
                nearest: Vec::new(),
            }));
        }
        found.sort_by_key(|found| found.mention.bytes[0]);
        let spans = acts(prompt, &objects, &mut found).unwrap();
        let named = found.iter().flat_map(|found| found.mention.ids.clone()).collect();
        (spans.iter().map(|[from, to]| &prompt[*from..*to]).collect(), named)
    }

    #[test]
    fn what_is_told_to_act_is_what_the_next_pronoun_means() {
        assert_eq!(
            told("make the cat jump onto the chair, then push in on it"),
            (vec!["make the cat jump onto the chair"], vec![1])
        );
        assert_eq!(told("the cat waves at us. push in on its face"), (vec!["the cat waves at us"], vec![1]));
        assert_eq!(
            told("have the cat turn its head to the chair, then pan to the chair"),
            (vec!["have the cat turn its head to the chair"], vec![2])
        );
    }

    #[test]
    fn what_a_camera_can_show_is_no_act() {
        for prompt in [
            "let the cat slide past",
            "make the cat fill the frame",
            "the cat runs along the wall, pan left",
            "make the cat jump",
        ] {
            assert_eq!(told(prompt).0, Vec::<&str>::new(), "{prompt}");
        }
    }
}
