//! Random and hostile prompts: no panic, no number that is not finite, no object that does not exist.

use cinesplat::director::{Director, SceneContext};
use cinesplat::language::NamedObject;
use glam::DVec3;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Prompts of the test; `cinesplat read` took 110 others of the same kinds.
const NUM_PROMPTS: usize = 300;

#[test]
fn random_and_hostile_prompts_give_finite_programs_about_known_objects() {
    let director = Director::embedded().unwrap();
    let objects = ["sofa", "bottle 1", "bottle 2", "the", "", "\u{202e}x"];
    let objects: Vec<NamedObject> =
        (1..).zip(objects).map(|(id, label)| NamedObject { id, label: label.to_owned() }).collect();
    let words: Vec<&str> = include_str!("../../prompts/lexicon.txt").split_whitespace().collect();
    let mut rng = Pcg64::seed_from_u64(11);
    let scene = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::ZERO, size: 8.0 };
    for _ in 0..NUM_PROMPTS {
        let prompt = prompt(&words, &mut rng);
        let Ok(linked) = director.link(&prompt, &objects) else { continue };
        let Ok(direction) = director.direct(&linked, &scene) else { continue };
        for id in direction.program.object_ids() {
            assert!(linked.missing(id).is_some() || objects.iter().any(|object| object.id == id), "{id} in {prompt:?}");
        }
        for cameras in &direction.step_cameras {
            assert!(cameras.start.pose.position.is_finite() && cameras.secs.is_finite(), "{prompt:?}");
        }
        for certainty in &direction.certainty {
            assert!((0.0..=1.0).contains(&certainty.probability), "{prompt:?}");
        }
        for [start, end] in direction.unmet {
            assert!(prompt.get(start..end).is_some(), "{prompt:?}");
        }
    }
}

/// Words of the lexicon, or any characters, or repetitions.
fn prompt(words: &[&str], rng: &mut Pcg64) -> String {
    let count = rng.random_range(1..60);
    match rng.random_range(0..3) {
        0 => (0..count).filter_map(|_| words.choose(rng).copied()).collect::<Vec<_>>().join(" "),
        1 => (0..count).filter_map(|_| char::from_u32(rng.random_range(0..0x3000))).collect(),
        _ => ["<obj-1> ", "orbit ", "1e308 deg ", "0 s ", "then ", "the bottle "].choose(rng).unwrap().repeat(count),
    }
}
