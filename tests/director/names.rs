//! Names: which words of a prompt name which objects.

use cinesplat::director::{FoundMention, Names, NamesFiles};
use cinesplat::language::{NamedObject, Relation, Things};

fn objects(labels: &[&str]) -> Vec<NamedObject> {
    (1..).zip(labels).map(|(id, label)| NamedObject { id, label: (*label).to_owned() }).collect()
}

fn found(prompt: &str, labels: &[&str]) -> Vec<FoundMention> {
    Names::embedded().unwrap().mentions(prompt, &objects(labels)).unwrap()
}

/// The words of each mention with its ids.
fn read(prompt: &str, labels: &[&str]) -> Vec<(String, Vec<u32>)> {
    let of = |found: FoundMention| {
        let [start, end] = found.mention.bytes;
        (prompt[start..end].to_owned(), found.mention.ids)
    };
    found(prompt, labels).into_iter().map(of).collect()
}

const ROOM: [&str; 7] = ["sofa", "coffee table", "floor lamp", "chair", "chair", "bookcase", "oil painting"];

#[test]
fn a_synonym_names_its_object() {
    assert_eq!(read("push in on the couch", &ROOM), [("the couch".to_owned(), vec![1])]);
    assert_eq!(
        read("Orbit the settee, then tilt up to the picture.", &ROOM),
        [("the settee".to_owned(), vec![1]), ("the picture".to_owned(), vec![7])]
    );
}

#[test]
fn a_plural_names_all_and_a_singular_the_first() {
    assert_eq!(read("truck past both chairs", &ROOM), [("both chairs".to_owned(), vec![4, 5])]);
    assert_eq!(read("push in on the chair", &ROOM), [("the chair".to_owned(), vec![4])]);
}

#[test]
fn a_misspelled_name_is_its_object() {
    assert_eq!(read("orbit the bookcaes", &ROOM), [("the bookcaes".to_owned(), vec![6])]);
}

#[test]
fn words_of_film_name_nothing() {
    let none: [(String, Vec<u32>); 0] = [];
    for prompt in ["pan left 90 degrees", "dolly in slowly, keep the horizon level", "hold the frame for two seconds"] {
        assert_eq!(read(prompt, &ROOM), none, "{prompt}");
    }
}

#[test]
fn a_missing_thing_has_no_ids_and_the_nearest_names() {
    let found = found("push in on the elephant", &ROOM);
    assert_eq!(found.len(), 1);
    assert!(found[0].mention.ids.is_empty());
    assert_eq!(found[0].nearest.len(), 3);
}

#[test]
fn a_mention_by_number_is_that_object() {
    assert_eq!(read("orbit <obj-3> and hold", &ROOM), [("<obj-3>".to_owned(), vec![3])]);
    assert_eq!(read("go from object 2 to [obj 6]", &ROOM).iter().map(|m| m.1[0]).collect::<Vec<_>>(), [2, 6]);
    assert_eq!(read("orbit <obj-30>", &ROOM), [("<obj-30>".to_owned(), vec![])]);
}

#[test]
fn hostile_prompts_give_probabilities_and_spans_in_order() {
    let long = "the chair ".repeat(700);
    for prompt in ["", " \n", "<", "]]|[[", "the the the", "\u{1F3A5}\u{1F3A5} é\u{301}", "0 0 0 0", long.as_str()] {
        for labels in [&ROOM[..], &[], &["", "2", "the"]] {
            let mut last = 0;
            for mention in found(prompt, labels) {
                assert!((0.0..=1.0).contains(&mention.probability), "{prompt}");
                assert!(mention.mention.bytes[0] >= last && mention.mention.bytes[0] < mention.mention.bytes[1]);
                assert!(prompt.get(mention.mention.bytes[0]..mention.mention.bytes[1]).is_some());
                last = mention.mention.bytes[1];
            }
        }
    }
}

#[test]
fn the_order_of_the_objects_changes_nothing() {
    let names = Names::embedded().unwrap();
    let forward = objects(&ROOM);
    let backward: Vec<NamedObject> = forward.iter().rev().cloned().collect();
    let prompt = "from the lamp over the chairs to the painting";
    assert_eq!(names.mentions(prompt, &forward).unwrap(), names.mentions(prompt, &backward).unwrap());
}

#[test]
fn changed_weights_are_rejected() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in NamesFiles::embedded().named() {
        let mut bytes = bytes.to_vec();
        if name.ends_with("safetensors") {
            *bytes.last_mut().unwrap() ^= 1;
        }
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    assert_eq!(Names::load(folder.path()).unwrap_err().code(), "MODEL-BAD");
}

#[test]
fn kinds_relate_names_kinds_and_parts() {
    let things = Things::embedded();
    let related = things.related(&things.kinds_of("coffee machine"));
    let has = |phrase: &str, relation: Relation| relation.is_in(related.get(phrase).copied().unwrap_or(0));
    assert!(has("espresso maker", Relation::Same));
    assert!(has("machine", Relation::Broader));
    assert!(has("drip tray", Relation::Part));
    assert!(!has("sofa", Relation::Same));
}

#[test]
fn the_head_of_one_name_means_its_object() {
    let scene = ["electric guitar", "potted palm", "golden skull", "knife rack", "teal base cabinet", "drawer chest"];
    let mentions = read("Widen the glass until palm, guitar and skull all fit", &scene);
    let guitar = mentions.iter().find(|(words, _)| words == "guitar").map(|(_, ids)| &ids[..]);
    assert_eq!(guitar, Some(&[1][..]));
}
