use std::collections::BTreeSet;

use cinesplat::synth::{SynthKind, SynthSettings, generate};

use super::{SCENES, in_box, spread_in_box};

/// Kinds of the catalog. A label is one of them, with an optional color before it and an optional number after it.
const KINDS: [&str; 54] = [
    "armchair",
    "basket",
    "bed",
    "bench",
    "book",
    "bookshelf",
    "bottle",
    "bowl of fruit",
    "cactus",
    "candle",
    "chair",
    "chest of drawers",
    "clock",
    "coffee table",
    "cooking pot",
    "curtains",
    "desk",
    "desk lamp",
    "dining table",
    "door",
    "easel",
    "fireplace",
    "floor lamp",
    "globe",
    "guitar",
    "keyboard",
    "kitchen counter",
    "laptop",
    "mirror",
    "monitor",
    "mug",
    "nightstand",
    "office chair",
    "pendant lamp",
    "picture",
    "plate",
    "potted plant",
    "pouf",
    "radio",
    "refrigerator",
    "rug",
    "white bust sculpture",
    "white stacked stone sculpture",
    "wooden knot sculpture",
    "side table",
    "sideboard",
    "small plant",
    "sofa",
    "stove",
    "table lamp",
    "teapot",
    "television",
    "vase",
    "window",
];

#[test]
fn ids_count_from_one_and_labels_are_unique() {
    for (name, scene) in SCENES.iter() {
        let ids: Vec<u32> = scene.objects.iter().map(|o| o.id).collect();
        let expected: Vec<u32> = (1..=scene.objects.len() as u32).collect();
        assert_eq!(ids, expected, "{name}");
        let labels: BTreeSet<&str> = scene.objects.iter().map(|o| o.label.as_str()).collect();
        assert_eq!(labels.len(), scene.objects.len(), "{name} repeats a label");
        assert!(scene.objects.len() >= 12, "{name} has only {} objects", scene.objects.len());
    }
}

#[test]
fn every_box_bounds_its_gaussians() {
    for (name, scene) in SCENES.iter() {
        assert_eq!(scene.labels.len(), scene.gaussians.len());
        for (at, object) in scene.objects.iter().enumerate() {
            let own: Vec<_> = (0..scene.labels.len()).filter(|&i| u32::from(scene.labels[i]) == object.id).collect();
            assert!(own.len() >= 8, "{name}: {} has {} Gaussians", object.label, own.len());
            let mut reach = glam::DVec3::ZERO;
            for &i in &own {
                reach = reach.max(in_box(scene, i, at).abs() + spread_in_box(scene, i, at));
            }
            let off = (object.half_extents - reach).abs().max_element();
            assert!(off < 1e-4, "{name}: the box of {} is {off} m off", object.label);
        }
    }
}

#[test]
fn every_kind_appears() {
    let mut missing: BTreeSet<&str> = KINDS.into_iter().collect();
    for seed in 0..80 {
        for kind in [SynthKind::Room, SynthKind::Tabletop] {
            let scene = generate(&SynthSettings { seed, kind, detail: 0.01 });
            missing.retain(|word| !scene.objects.iter().any(|object| object.label.contains(word)));
        }
        if missing.is_empty() {
            return;
        }
    }
    panic!("not in 160 scenes: {missing:?}");
}
