//! Things of rooms that touch each other, or lie flat on floor and walls.

use cinesplat::synth::{SynthKind, SynthSettings, generate};

use super::find::{overlaps, overlaps_in};

/// A patch of sunlight that falls across the edge of a rug was part of the rug.
#[test]
fn sunlight_beside_a_rug_is_no_part_of_it() {
    for seed in [213, 217] {
        let overlaps = overlaps(SynthKind::Room, seed);
        assert!(overlaps["yellow rug"] > 0.8, "room {seed}: {overlaps:?}");
    }
}

/// Mirrors are thinner than what counted as standing out from a wall, and as pale as it.
#[test]
fn thin_mirrors_on_an_even_wall_are_objects() {
    let overlaps = overlaps(SynthKind::Room, 221);
    for name in ["mirror 2", "mirror 3"] {
        assert!(overlaps[name] > 0.85, "{name}: {overlaps:?}");
    }
}

/// Every pane of a window with a wide bar was a window, the curtains on one rod were two things, and the casing of a door was
/// wall.
#[test]
fn windows_curtains_and_doors_are_whole() {
    let overlaps = overlaps(SynthKind::Room, 219);
    for name in ["window 1", "yellow curtains 1", "white door"] {
        assert!(overlaps[name] > 0.85, "{name}: {overlaps:?}");
    }
}

/// A cactus whose arm is next to a wine glass was one thing with the glass.
#[test]
fn things_closer_to_each_other_than_a_cell_are_apart() {
    let overlaps = overlaps(SynthKind::Room, 214);
    assert!(overlaps["cactus"] > 0.9, "{overlaps:?}");
}

/// The upmost board of a bookshelf cut off what is above it.
#[test]
fn the_storeys_of_a_bookshelf_are_one_object() {
    let made = generate(&SynthSettings { seed: 218, kind: SynthKind::Room, detail: 0.3 });
    let overlaps = overlaps_in(made);
    assert!(overlaps["bookshelf 1"] > 0.95, "{overlaps:?}");
}
