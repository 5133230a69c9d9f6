use cinesplat::objects::{Object, ObjectSet, Renaming, rename};
use glam::DVec3;

fn parsed(text: &str) -> Option<(u32, String)> {
    text.parse::<Renaming>().ok().map(|renaming| (renaming.id, renaming.name))
}

#[test]
fn a_name_is_an_id_and_words() {
    assert_eq!(parsed("41=mug"), Some((41, "mug".to_owned())));
    assert_eq!(parsed(" 7 = \"left chair\" "), Some((7, "left chair".to_owned())));
    assert_eq!(parsed("<obj-7>=a=b"), Some((7, "a=b".to_owned())));
    for bad in ["", "mug", "0=mug", "65536=mug", "-1=mug", "x=mug", "3=", "3= ", "3=\"\"", "3=a\u{7}b"] {
        assert_eq!(parsed(bad), None, "{bad:?}");
    }
}

#[test]
fn lines_are_read_and_bad_ones_numbered() {
    // Some editors begin a text with a mark.
    let names = Renaming::parse_lines("\u{feff}# my room\n\n1=mug\r\n2 = left chair\n").unwrap();
    assert_eq!(names.iter().map(|n| n.name.as_str()).collect::<Vec<_>>(), ["mug", "left chair"]);
    let error = Renaming::parse_lines("1=mug\nchair\n").unwrap_err();
    assert_eq!(error, "line 2: expected ID=NAME such as 41=mug, found `chair`");
}

#[test]
fn objects_get_their_names_and_unknown_ids_are_refused() {
    let object = |id| Object::from_box(id, "old", DVec3::ZERO, DVec3::ONE);
    let mut set = ObjectSet { objects: vec![object(3), object(5)], labels: Vec::new() };
    let names = ["5=mug", "5=cup"].map(|text| text.parse().unwrap());
    assert_eq!(rename(&mut set, &names), Ok(()));
    assert_eq!((set.objects[0].label.as_str(), set.objects[1].label.as_str()), ("old", "cup"));
    assert_eq!(rename(&mut set, &["4=x".parse().unwrap()]), Err(4));
}
