//! The corpus of people's sentences.

use cinesplat::training::corpus::{Split, parse_marked, read_writer};

use crate::support::corpus;

#[test]
fn marks_say_mentions_steps_and_unmet_words() {
    let marked = parse_marked("Hi, @1 orbit [the couch|3/4] @0 {to music} @2 then [both chairs|6+5] [x]").unwrap();
    assert_eq!(marked.text, "Hi, orbit the couch to music then both chairs [x]");
    let ids: Vec<&[u32]> = marked.mentions.iter().map(|mention| &mention.ids[..]).collect();
    assert_eq!(ids, [&[3][..], &[5, 6]]);
    assert_eq!(&marked.text[marked.unmet[0][0]..marked.unmet[0][1]], "to music");
    let [start, end] = marked.words_of(1).unwrap();
    assert_eq!(&marked.text[start..end], "orbit the couch ");
    assert!(marked.words_of(3).is_none());
    assert!(parse_marked("orbit [the couch|x]").is_err());
    assert!(parse_marked("orbit } it").is_err());
}

#[test]
fn every_sentence_of_the_corpus_has_a_program() {
    let writers = corpus();
    let count = |split| writers.iter().filter(|writer| writer.split == split).count();
    assert!(writers.len() >= 16, "{} writers", writers.len());
    assert!(count(Split::Exam) >= 3 && count(Split::Development) >= 2);
    let sentences: usize = writers.iter().map(|writer| writer.sentences.len()).sum();
    assert!(sentences >= 8000, "{sentences} sentences");
    for writer in writers {
        for sentence in &writer.sentences {
            assert!(writer.scenes.contains_key(&sentence.scene), "{} line {}", writer.name, sentence.line);
        }
    }
}

#[test]
fn a_malformed_line_names_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("w.txt");
    std::fs::write(&path, "object A 1 lamp\nA | s | @1 orbit [the lamp|1] | spin end=1\n").unwrap();
    let error = read_writer(&path).unwrap_err().to_string();
    assert!(error.starts_with("line 2: unknown move"), "{error}");
    assert!(error.ends_with("w.txt"), "{error}");
}
