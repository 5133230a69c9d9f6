//! Senses: what words tell a camera operator.

use cinesplat::language::{Mention, link_mentions, sense_names};

/// The senses of each word of a prompt, in which the words in brackets are a mention.
fn senses(marked: &str) -> Vec<String> {
    let (mut prompt, mut mentions) = (String::new(), Vec::new());
    for (nth, part) in marked.split(['[', ']']).enumerate() {
        if nth % 2 == 1 {
            mentions.push(Mention { bytes: [prompt.len(), prompt.len() + part.len()], ids: vec![nth as u32] });
        }
        prompt.push_str(part);
    }
    let names = sense_names().unwrap();
    let of_words = link_mentions(&prompt, &mentions).unwrap().senses().unwrap();
    let named = |index: usize| names[index].as_str();
    of_words.into_iter().map(|senses| senses.indices().map(named).collect::<Vec<_>>().join(" ")).collect()
}

#[test]
fn words_that_no_sentence_of_the_corpus_has_still_have_a_meaning() {
    assert_eq!(senses("plummet")[0], "down lift fast");
    assert!(senses("saunter")[0].contains("go"));
    assert!(senses("careen")[0].contains("fast"));
}

#[test]
fn forms_of_a_word_have_its_senses() {
    let of_base = senses("glide")[0].clone();
    assert!(of_base.contains("smooth"), "{of_base}");
    for form in ["glides", "glided", "gliding"] {
        assert_eq!(senses(form)[0], of_base, "{form}");
    }
}

#[test]
fn a_phrase_counts_before_its_words_and_objects_have_no_sense() {
    let away = senses("backing away from [the mug]");
    assert!(away[0].contains("out") && away[0] == away[1], "{away:?}");
    assert_eq!(away.last().unwrap(), "");
    // `right` is no direction here.
    assert!(!senses("go right up to [the mug]").iter().any(|senses| senses.split(' ').any(|sense| sense == "right")));
}
