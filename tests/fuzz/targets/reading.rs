//! Prompts, as the director reads them: numbers are finite, and objects are those of the scene.
#![no_main]

use std::sync::OnceLock;

use cinesplat_director::{Director, SceneContext};
use cinesplat_language::NamedObject;
use glam::DVec3;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|prompt: &str| {
    static DIRECTOR: OnceLock<Director> = OnceLock::new();
    let director = DIRECTOR.get_or_init(|| Director::embedded().expect("the built-in weights"));
    let object = |id, label: &str| NamedObject { id, label: label.to_owned() };
    let objects = [object(1, "sofa"), object(2, "bottle 1"), object(3, "bottle 2"), object(4, "floor lamp")];
    let scene = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::ZERO, size: 8.0 };
    let Ok(linked) = director.link(prompt, &objects) else { return };
    let Ok(direction) = director.direct(&linked, &scene) else { return };
    for id in direction.program.object_ids() {
        assert!(linked.missing(id).is_some() || (1..=4).contains(&id), "object {id}");
    }
    for cameras in &direction.step_cameras {
        assert!(cameras.start.pose.position.is_finite() && cameras.secs.is_finite(), "a camera");
    }
    for [start, end] in direction.unmet {
        assert!(prompt.get(start..end).is_some(), "spans lie on characters");
    }
});
