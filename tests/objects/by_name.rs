use cinesplat::objects::{Object, named};
use glam::DVec3;

#[test]
fn an_object_is_found_by_its_id_and_by_its_label() {
    let object = |id: u32, label: &str| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
    let objects = [object(1, "Mug"), object(3, "chair"), object(7, "chair"), object(9, "")];
    let found = |name: &str| named(&objects, name).map(|object| object.id);
    assert_eq!((found("<obj-3>"), found("mug"), found(" MUG ")), (Ok(3), Ok(1), Ok(1)));
    assert_eq!(found("chair").unwrap_err(), "one object: <obj-3> chair, <obj-7> chair");
    let listed = "one of the objects <obj-1> Mug, <obj-3> chair, <obj-7> chair, <obj-9>";
    for unknown in ["lamp", "<obj-4>", "<obj-x>", ""] {
        assert_eq!(found(unknown).unwrap_err(), listed, "{unknown}");
    }
    assert_eq!(named(&[], "mug").unwrap_err(), "a point, because the scene has no objects");
}

#[test]
fn the_last_words_of_a_label_name_the_only_object_that_has_them() {
    let object = |(idx, label): (usize, &str)| Object::from_box(idx as u32 + 1, label, DVec3::ZERO, DVec3::ONE);
    let labels = ["green sofa", "coffee table", "side table", "white curtains 1", "white curtains 2", "table lamp 1"];
    let objects: Vec<Object> = labels.into_iter().enumerate().map(object).collect();
    let found = |name: &str| named(&objects, name).map(|object| object.id);
    assert_eq!((found("sofa"), found("the sofa"), found("Green  Sofa"), found("lamp")), (Ok(1), Ok(1), Ok(1), Ok(6)));
    assert_eq!((found("coffee table"), found("side")), (Ok(2), Ok(3)));
    assert_eq!(found("table").unwrap_err(), "one object: <obj-2> coffee table, <obj-3> side table");
    assert_eq!(found("curtains").unwrap_err(), "one object: <obj-4> white curtains 1, <obj-5> white curtains 2");
    assert!(found("red sofa").is_err() && found("of").is_err());
}

#[test]
fn of_many_objects_the_nearest_are_offered() {
    let mut objects: Vec<Object> =
        (1..=30).map(|id| Object::from_box(id, &format!("thing number {id}"), DVec3::ZERO, DVec3::ONE)).collect();
    objects[20].label = "green sofa".to_owned();
    let error = named(&objects, "soffa").unwrap_err();
    assert!(error.starts_with("one of 30 objects, the nearest are <obj-21> green sofa, "), "{error}");
    let error = named(&objects, "<obj-31>").unwrap_err();
    assert!(error.starts_with("one of 30 objects, the nearest are <obj-30> thing number 30, <obj-29>"), "{error}");
}
