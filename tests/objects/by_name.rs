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
