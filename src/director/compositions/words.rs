//! The words of descriptions of pictures.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::FramePlace;
use cinesplat_trajectory::{ShotAngle, ShotSize};

/// Words that state nothing by themselves.
const PLAIN: &str = "the a an is are be has have must should to it its they them both only just still stays stay stand \
    stands sits remains and in on at of with by from frame frames image picture shot view screen composition third \
    thirds line half side intersection corner area fills fill filling occupies takes up height high tall point n vertical";
/// Words of the scene as a whole.
pub(super) const ROOM: &str = "room kitchen scene everything place space";
/// Words of how much of a thing is seen.
pub(super) const WHOLE: &str = "whole wholly fully completely entirely entire full totally all";
pub(super) const SEEN: &str = "visible seen showing shown";
pub(super) const OUT: &str = "out outside hidden invisible gone off lose unseen";
/// Words of places in the frame.
const CENTER: &str = "center centre centered centred middle dead horizontally vertically";
const LEFT: &str = "left";
const RIGHT: &str = "right";
const UPPER: &str = "upper top";
const LOWER: &str = "lower bottom";
/// Words of where the camera is.
const STANDS: &str =
    "elevation above distance away camera lens altitude floor ground fov field eye same \u{B0} degrees 0";
const SIZED: &str = "close closeup medium wide long extreme cu mcu ecu ms";
const ANGLED: &str = "low angle level overhead";

/// Whether a word may be part of a clause that only describes a picture.
pub(super) fn is_picture_word(linked: &Linked, word: &str) -> bool {
    const LISTS: [&str; 13] = [PLAIN, ROOM, WHOLE, SEEN, OUT, CENTER, LEFT, RIGHT, UPPER, LOWER, STANDS, SIZED, ANGLED];
    let is_shown = linked
        .quantity_at(word)
        .is_some_and(|quantity| !matches!(quantity.kind, QuantityKind::Seconds | QuantityKind::Factor));
    linked.slot_at(word).is_some() || is_shown || LISTS.iter().any(|list| is_listed(list, word))
}

/// The stated place in the frame.
pub(super) fn place(words: &[&str]) -> Option<FramePlace> {
    let says = |list: &str| words.iter().any(|word| is_listed(list, word));
    let sides = [says(LEFT), says(RIGHT), says(UPPER), says(LOWER)];
    match sides {
        [true, false, false, false] => Some(FramePlace::AtLeft),
        [false, true, false, false] => Some(FramePlace::AtRight),
        [false, false, true, false] => Some(FramePlace::AtUpper),
        [false, false, false, true] => Some(FramePlace::AtLower),
        [true, false, true, false] => Some(FramePlace::AtUpperLeft),
        [false, true, true, false] => Some(FramePlace::AtUpperRight),
        [true, false, false, true] => Some(FramePlace::AtLowerLeft),
        [false, true, false, true] => Some(FramePlace::AtLowerRight),
        [false, false, false, false] => says(CENTER).then_some(FramePlace::AtCenter),
        _ => None,
    }
}

/// Whether the words name both sides of an axis of the frame.
pub(super) fn has_opposite_places(words: &[&str]) -> bool {
    let says = |list: &str| words.iter().any(|word| is_listed(list, word));
    says(UPPER) && says(LOWER) || says(LEFT) && says(RIGHT)
}

pub(super) fn size(words: &[&str]) -> Option<ShotSize> {
    const SIZES: [(&[&str], ShotSize); 18] = [
        (&["extreme", "close"], ShotSize::ExtremeCloseUp),
        (&["ecu"], ShotSize::ExtremeCloseUp),
        (&["medium", "close"], ShotSize::MediumCloseUp),
        (&["mcu"], ShotSize::MediumCloseUp),
        (&["close", "up"], ShotSize::CloseUp),
        (&["up", "close"], ShotSize::CloseUp),
        (&["closeup"], ShotSize::CloseUp),
        (&["cu"], ShotSize::CloseUp),
        (&["close", "on"], ShotSize::CloseUp),
        (&["medium", "long"], ShotSize::MediumLong),
        (&["medium", "wide"], ShotSize::MediumLong),
        (&["medium"], ShotSize::Medium),
        (&["ms"], ShotSize::Medium),
        (&["extreme", "long"], ShotSize::ExtremeLong),
        (&["extreme", "wide"], ShotSize::ExtremeLong),
        (&["long"], ShotSize::Long),
        (&["wide", "shot"], ShotSize::Long),
        (&["wide"], ShotSize::Long),
    ];
    let says = |phrase: &[&str]| words.windows(phrase.len()).any(|window| window == phrase);
    SIZES.iter().find(|(phrase, _)| says(phrase)).map(|(_, size)| *size)
}

pub(super) fn angle(words: &[&str]) -> Option<ShotAngle> {
    const ANGLES: [(&[&str], ShotAngle); 4] = [
        (&["low", "angle"], ShotAngle::Low),
        (&["high", "angle"], ShotAngle::High),
        (&["eye", "level"], ShotAngle::EyeLevel),
        (&["overhead"], ShotAngle::Overhead),
    ];
    let says = |phrase: &[&str]| words.windows(phrase.len()).any(|window| window == phrase);
    ANGLES.iter().find(|(phrase, _)| says(phrase)).map(|(_, angle)| *angle)
}
