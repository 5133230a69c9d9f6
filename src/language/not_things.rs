//! Words that look like the name of a thing and name none: colors of a look (`teal and orange grade`), terms of the trade
//! (`reference plate`, `the objective`, `none of the axes`), heights (`at table height`), what is as smooth as silk, the
//! `that` of `scratch that`.

use super::camera_words::is_of_camera;
use super::heights::is_level_name;
use super::mention::Mention;
use super::names::NamedObject;
use super::numerals::number_word;
use super::things::{Relation, Things};
use super::tokenizer::{Word, is_listed, tokenize, word_at};

/// Colors and what they are mixed with.
const COLORS: &str = "teal orange gold golden yellow butter blue red green black white pink purple magenta cyan amber \
    sepia cream ivory silver copper bronze rose violet brown beige grey gray turquoise crimson honey peach mint lavender \
    pastel neon warm cool cold pale deep soft dark light bright muted dusty faded rich moody and & to with";
/// What has colors without being a thing.
const LOOKS: &str = "grade grading graded palette palettes tone tones hue hues tint tints tinted color colors colour colours \
    glow light lighting contrast highlights shadows wash haze bokeh accents hour lut look scheme split";
/// Terms of cameras and robots, of which objects are hardly ever the bearers of the name.
const TERMS: &str = "axis axes objective constraint constraints sensor gimbal goal goals waypoint waypoints target targets \
    pose poses floorboard floorboards ceiling skirting exhibit exhibits item items element elements position trajectory centroid standoff heading profile profiles silhouette panel panels sticks barrel";
/// Words beside such a term.
const BESIDE: &str = "of the a an his her full exact side left right its each every all any none of both this that next last first no optical";
/// What comes before `plate` where it is a piece of film.
const PLATES: &str = "beauty hero reference background clean back empty bg vfx still";

/// Verbs of somebody who corrects himself, before `that`.
const TAKEN_BACK: &str = "scratch strike forget cancel delete undo scrap ignore make";

/// What people do with pets that are no part of the film: `sorry about the wind, I'm walking the dog`.
const CHORES: &str = "walking feeding petting washing grooming";
/// Words behind `is` and `only`, of which what is named is but a decoration.
const MERE: &str = "only just mere merely";

/// Whether somebody only tells what he does with an animal.
fn is_chore(words: &[Word], first: usize) -> bool {
    let is_article = |at: usize| matches!(word_at(words, at), "the" | "my" | "our");
    let verb = first.checked_sub(1 + usize::from(first > 0 && is_article(first - 1)));
    let noun = first + usize::from(is_article(first));
    verb.is_some_and(|verb| is_listed(CHORES, word_at(words, verb)))
        && is_listed("dog dogs cat cats horse puppy", word_at(words, noun))
}

/// Whether a mention says that something is only there to look nice: `the rest of it is only decoration`.
fn is_mere(words: &[Word], end: usize) -> bool {
    let is_noun = end > 0
        && is_listed("decoration decorations backdrop background set-dressing dressing", word_at(words, end - 1));
    is_noun && (1..=3).any(|back| end > back && is_listed(MERE, word_at(words, end - 1 - back)))
}

/// Whether a mention is the portrait that a film is of something: `portrait of the bust`.
fn is_portrait(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    // The name of what it is of may belong to the mention.
    let of = (first..end).find(|at| word_at(words, *at) == "of").unwrap_or(end);
    let is_portrait = words[first..of]
        .iter()
        .all(|word| is_listed("a the little small nice short quick proper portrait portraits", &word.text));
    let is_named = |object: &NamedObject| object.label.to_lowercase().contains("portrait");
    let says_so = words[first..of].iter().any(|word| word.text.starts_with("portrait"));
    is_portrait && says_so && word_at(words, of) == "of" && !objects.iter().any(is_named)
}

/// Whether a mention names no thing: its words are the colors of a look or a term of the trade.
pub fn is_no_thing(prompt: &str, mention: &Mention, objects: &[NamedObject]) -> bool {
    let words = tokenize(prompt);
    let [from, to] = mention.bytes;
    let Some(first) = words.iter().position(|word| (from..to).contains(&word.span[0])) else { return false };
    let end = words.iter().rposition(|word| (from..to).contains(&word.span[0])).map_or(first, |last| last + 1);
    let is_phrase = || word_at(&words, first) == "that" && end == first + 1;
    // `The best place on earth`.
    let is_world = first > 1
        && matches!(word_at(&words, first - 1), "on" | "in" | "the")
        && words[first..end].iter().all(|word| is_listed("earth world universe", &word.text));
    // `Scratch that` or its first word alone.
    let is_whole_phrase = end <= first + 2
        && is_listed(TAKEN_BACK, word_at(&words, first))
        && matches!(word_at(&words, first + 1), "that" | "this" | "it");
    let is_taken_back =
        is_whole_phrase || first > 0 && is_listed(TAKEN_BACK, word_at(&words, first - 1)) && is_phrase();
    is_taken_back
        || is_world
        || is_chore(&words, first)
        || is_mere(&words, end)
        || is_portrait(&words, [first, end], objects)
        || is_color_of_look(&words, [first, end])
        || is_plate(&words, [first, end])
        || is_term(&words[first..end], objects)
        || is_level(&words, [first, end])
        || is_smoothness(&words, [first, end])
        || is_mount(&words, [first, end])
        || is_frame(&words, [first, end])
        || is_until(&words, [first, end])
        || is_daylight(&words, [first, end])
        || is_sky(&words, [first, end], objects)
        || is_lounge(&words, [first, end], objects)
        || is_count(&words, [first, end])
        || is_floor(&words, [first, end], objects)
        || is_likeness(&words, [first, end], objects)
        || words[first..end].iter().all(|word| is_listed(COURTESIES, &word.text))
        || is_of_other_work(&words, [first, end], objects)
        || is_control(&words, [first, end], objects)
        || is_of_camera(&words, [first, end], objects)
        || is_corner(&words[first..end], objects)
}

/// What people end a message with.
const COURTESIES: &str = "cheers thanks thx ta cheerio regards ciao";

/// What people make or keep that is about a thing: `my toaster ad`, `the guitar channel`.
const WORKS: &str = "ad ads advert adverts advertisement commercial commercials channel blog vlog podcast newsletter brand business \
    company empire club forum";

/// A thing that only says what a work is about, where the scene has none of that name.
fn is_of_other_work(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    let owner = first.checked_sub(1).map_or(word_at(words, first), |before| word_at(words, before));
    let is_owned = is_listed(OWNERS, owner) || is_listed(OWNERS, word_at(words, first));
    let names = &words[first..end];
    let is_work =
        is_listed(WORKS, word_at(words, end)) || names.last().is_some_and(|last| is_listed(WORKS, &last.text));
    is_owned && is_work && !names.iter().any(|word| is_called(objects, word))
}

/// What a game or an editor is controlled with, and words of what is done with it.
const CONTROLS: &str = "mouse keyboard joystick gamepad controller thumbstick key keys wasd";
const CONTROLLED: &str = "untouched still held pressed released down idle alone up only off";

/// `A key held down, mouse untouched`: what somebody plays with, where the scene has none.
fn is_control(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    let names = words[first..end].iter().filter(|word| !is_listed(OWNERS, &word.text));
    let is_all = names.clone().all(|word| is_listed(CONTROLS, &word.text) && !is_called(objects, word));
    names.count() > 0 && is_all && is_listed(CONTROLLED, word_at(words, end))
}

/// `The whole corner`: a part of the room, where no thing of the scene is called so.
fn is_corner(names: &[Word], objects: &[NamedObject]) -> bool {
    let is_all =
        names.iter().all(|word| is_listed("the a this that whole entire far other opposite corner", &word.text));
    is_all && names.last().is_some_and(|word| word.text == "corner" && !is_called(objects, word))
}

/// Who somebody is before the noun: `I'm the cat`, `imagine you're our cat`.
const PERSONAS: [[&str; 2]; 8] = [
    ["i", "am"],
    ["i", "'m"],
    ["you", "are"],
    ["you", "'re"],
    ["we", "are"],
    ["we", "'re"],
    ["you", "were"],
    ["you", "be"],
];
const OWNERS: &str = "the a an our my your their his her";

/// What a move or a person is only compared with, where no thing of the scene is called so: `fly up like a drone`, `I am the cat`.
fn is_likeness(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    // `Way an accordion`: the first word may belong to the mention.
    let first = first + usize::from(word_at(words, first) == "way");
    let article = usize::from(is_listed(OWNERS, word_at(words, first)));
    let noun = first + article;
    let before = if article == 1 { first } else { first.saturating_sub(1) };
    let owner = word_at(words, before);
    let text = |back: usize| before.checked_sub(back).map_or("", |at| word_at(words, at));
    let is_like = text(1) == "like" && !is_listed("look looks looking", text(2));
    // `The way an accordion does`, `as a butler would`.
    let is_way = matches!(text(1), "way" | "as" | "how") && is_listed("does would do did might", word_at(words, end));
    let is_compared = (is_like || is_way) && matches!(owner, "a" | "an");
    let is_persona = is_listed(OWNERS, owner) && PERSONAS.contains(&[text(2), text(1)]);
    noun < end && (is_compared || is_persona) && !words[noun..end].iter().any(|word| is_called(objects, word))
}

/// Whether a thing of the scene is called so: by a word of its label, or by another name for it.
fn is_called(objects: &[NamedObject], word: &Word) -> bool {
    objects.iter().any(|object| {
        Things::embedded().is_related(&object.label, &word.stem, &[Relation::Same])
            || tokenize(&object.label).iter().any(|own| own.stem == word.stem)
    })
}

/// What floors are made of, and words of who is near them.
const FLOORS: &str = "tile floorboard lino linoleum carpet board parquet flagstone flag plank cobble cobblestone laminate lawn turf \
    skirting pavement paving";
const LOW: &str = "down low lying along level crouched close height inches centimeters centimetres";
const BESIDE_FLOOR: &str = "by on at near to with the just right against above off";

/// `Start down by the tiles`: the floor, where no thing of the scene is called so.
fn is_floor(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    let names: Vec<&Word> = words[first..end].iter().filter(|word| word.text != "the").collect();
    let is_one = names.len() == 1 && is_listed(FLOORS, &names[0].stem);
    let mut before = words[..first].iter().rev().skip_while(|word| is_listed(BESIDE_FLOOR, &word.text));
    let is_low = before.next().is_some_and(|word| is_listed(LOW, &word.text));
    is_one && is_low && !is_called(objects, names[0])
}

/// Verbs of who goes where the light goes, and words behind it.
const CHASES: &str =
    "follow follows following trace traces tracing chase chases chasing track tracks tracking catch catches catching";
const LIGHTS: &str = "light sunlight sun daylight sunbeam moonlight";

/// `Follow the light from the window to the bed`: that of the sun, and no lamp.
fn is_daylight(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let article = first + usize::from(word_at(words, first) == "the");
    let verb = first.checked_sub(1).map_or("", |before| word_at(words, before));
    let verb = if verb == "the" { first.checked_sub(2).map_or("", |before| word_at(words, before)) } else { verb };
    end == article + 1 && is_listed(LIGHTS, word_at(words, article)) && is_listed(CHASES, verb)
}

/// What is seen in a picture or through a window: `the one with the red sun`.
const SKIES: &str = "sun sky moon clouds horizon stars sea";

/// Something in the sky, where no thing of the scene is called so.
fn is_sky(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    let is_label =
        |word: &Word| objects.iter().any(|object| tokenize(&object.label).iter().any(|w| w.stem == word.stem));
    words[first..end].last().is_some_and(|last| is_listed(SKIES, &last.text) && !is_label(last))
}

/// `A wide of the lounge`, `let the whole set come together`: the room, where no thing of the scene is called so.
fn is_lounge(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    let is_label =
        |name: &str| objects.iter().any(|object| tokenize(&object.label).iter().any(|word| word.text == name));
    let mut names = words[first..end].iter().filter(|word| !is_listed("the our my this whole entire a", &word.text));
    let name = names.next().map_or("", |word| &word.text);
    is_listed("lounge set", name) && names.next().is_none() && !is_label(name)
}

/// `Three` of `the three cookies`: how many things there are of which the scene has none.
fn is_count(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let number = first + usize::from(word_at(words, first) == "the");
    let is_number = (2..=12_u32).any(|count| number_word(count) == Some(word_at(words, number)));
    let next = words.get(end).filter(|word| word.is_alphabetic() && word.stem != word.text);
    end == number + 1 && is_number && next.is_some()
}

/// `Swing round till it stares at us`: what goes on until something, and no drawer of money.
fn is_until(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let before = first.checked_sub(1).map_or("", |before| word_at(words, before));
    let is_named = is_listed("the a my our your this that shop cash", before);
    end == first + 1 && is_listed("till til 'til untill", word_at(words, first)) && !is_named
}

/// What a film shows at once, and words before it and behind it by which it is that.
const FRAMES: &str = "picture image frame shot view";
const INTO: &str = "in into within inside fill fills filling filled";
const FRAME_ARTICLES: &str = "the our my your a one same single";
const FRAME_ENDS: &str = "and then for at while until till before after together throughout all so but as too now hold stop \
    stay the";

/// `Finish with both curtains in the picture`: the film's own picture, and none on the wall.
fn is_frame(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let is_article = |at: &usize| is_listed(FRAME_ARTICLES, word_at(words, *at));
    let article = first + (first..end).take_while(is_article).count();
    let is_named = end == article + 1 && is_listed(FRAMES, word_at(words, article));
    let before = (0..first).rev().find(|at| !is_article(at)).map_or("", |at| word_at(words, at));
    let next = word_at(words, end);
    is_named && is_listed(INTO, before) && (!next.starts_with(char::is_alphanumeric) || is_listed(FRAME_ENDS, next))
}

/// `gold and black palette`, `teal & orange grade`: colors alone, and what has them behind.
fn is_color_of_look(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let is_color = |at: &usize| is_listed(COLORS, word_at(words, *at));
    if first == end || !(first..end).all(|at| is_color(&at) || is_listed(LOOKS, word_at(words, at)) && at > first) {
        return false;
    }
    let behind = (end..words.len()).take_while(is_color).count();
    (first + 1..end).any(|at| is_listed(LOOKS, word_at(words, at)))
        || (end..=end + behind).any(|at| is_listed(LOOKS, word_at(words, at)))
}

/// `reference plate`: a piece of film.
fn is_plate(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let is_pair = |at: usize| word_at(words, at) == "plate" && at > 0 && is_listed(PLATES, word_at(words, at - 1));
    (first..end).any(is_pair) && (first..end).all(|at| is_pair(at) || is_listed(PLATES, word_at(words, at)))
}

/// What is smooth in words of a thing that it is not: `silky smooth`, `smooth as butter`.
const SMOOTH: &str =
    "silk silky butter buttery glass glassy velvet velvety cream creamy satin satiny honey treacle ice icy water";

/// `silky smooth`, `smooth as silk`: how a camera moves.
fn is_smoothness(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let is_all = (first..end).all(|at| {
        let word = word_at(words, at);
        is_listed(SMOOTH, word) || word.starts_with("smooth") || matches!(word, "as" | "like" | "a")
    });
    let is_smooth = |at: usize| word_at(words, at).starts_with("smooth");
    let before =
        || (first.saturating_sub(2)..first).any(is_smooth) && matches!(word_at(words, first - 1), "as" | "like");
    first < end && is_all && ((first..=end).any(is_smooth) || before())
}

/// What a camera stands on, and how it stays.
const MOUNTS: &str = "base platform chassis mount column stand carriage head rig";
const STAYS: &str = "fixed locked stationary static immobile clamped bolted parked stays remains";

/// `Base fixed, pan and tilt only`: what the camera stands on, in a clause of its own.
fn is_mount(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let names = &words[first..end];
    let is_named = names.last().is_some_and(|word| is_listed(MOUNTS, &word.text))
        && names.iter().rev().skip(1).all(|word| is_listed("the its robot camera", &word.text));
    let begins =
        first == 0 || matches!(word_at(words, first - 1), "." | "," | ";" | ":" | "(" | "the" | "with" | "and");
    let stays = end + usize::from(matches!(word_at(words, end), "is" | "kept" | "must" | "held"));
    is_named && begins && is_listed(STAYS, word_at(words, stays))
}

/// `At table height`: a height that people know, and no thing, unless it has an article (`at the height of the table`).
fn is_level(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let names = words.get(first..end).unwrap_or_default();
    let is_height = |at: usize| matches!(word_at(words, at), "height" | "level");
    // `Chair-seat height`.
    let seat = end + usize::from(word_at(words, end) == "-");
    let is_seat = names.len() == 1 && word_at(words, seat) == "seat" && is_height(seat + 1)
        || names.last().is_some_and(|word| word.text == "seat") && names.len() < 4 && is_height(end);
    if is_seat {
        return true;
    }
    // `Skirting-board level` is that of the floor.
    let is_board = names.len() > 1 && names.iter().all(|word| is_listed("skirting base board -", &word.text));
    if is_board && is_height(end) {
        return true;
    }
    let is_known = names.last().is_some_and(|word| is_level_name(&word.text)) && names.len() == 1;
    let inside = names.len() == 2 && is_height(first + 1) && is_level_name(word_at(words, first));
    is_known && is_height(end) || inside
}

/// A term alone, where no object of the scene is called so.
fn is_term(words: &[Word], objects: &[NamedObject]) -> bool {
    let is_label =
        |word: &Word| objects.iter().any(|object| tokenize(&object.label).iter().any(|w| w.stem == word.stem));
    words.iter().any(|word| is_listed(TERMS, &word.text))
        && words.iter().all(|word| is_listed(TERMS, &word.text) && !is_label(word) || is_listed(BESIDE, &word.text))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_none(prompt: &str, name: &str) -> bool {
        let objects = [(5, "stack of teal plates"), (9, "golden skull"), (15, "yellow jar")]
            .map(|(id, label)| NamedObject { id, label: label.to_owned() });
        let start = prompt.find(name).unwrap();
        is_no_thing(prompt, &Mention { bytes: [start, start + name.len()], ids: vec![5] }, &objects)
    }

    #[test]
    fn colors_of_a_look_are_no_things() {
        assert!(is_none("high contrast, gold and black palette", "gold"));
        assert!(is_none("moody teal and orange grade", "teal and orange"));
        assert!(is_none("butter yellow light", "butter yellow"));
        assert!(!is_none("push in on the gold skull", "gold skull"));
        assert!(!is_none("pan from the teal one to the light", "teal one"));
        assert!(!is_none("the yellow, then the light", "yellow"));
    }

    #[test]
    fn heights_and_smoothness_are_no_things() {
        assert!(is_none("push in at table height", "table"));
        assert!(!is_none("push in at the table height", "the table"));
        assert!(!is_none("push in on the table", "table"));
        assert!(is_none("silky smooth orbit", "silky"));
        assert!(is_none("push in, smooth as silk", "silk"));
        assert!(!is_none("push in on the silk", "silk"));
    }

    #[test]
    fn a_place_by_another_name_is_no_thing() {
        assert!(is_none("begin near, then let the whole set come together", "the whole set"));
        assert!(!is_none("push in on the tv set", "the tv set"));
    }

    #[test]
    fn what_a_floor_is_made_of_is_no_thing() {
        assert!(is_none("start down by the tiles, looking up at the skull", "the tiles"));
        assert!(is_none("glide low along the floorboards", "the floorboards"));
        assert!(!is_none("push in on the tiles", "the tiles"));
    }

    #[test]
    fn likenesses_works_controls_and_courtesies_are_no_things() {
        assert!(is_none("zoom in and out, the way an accordion does, slowly", "way an accordion"));
        assert!(is_none("three seconds, my toaster ad isn't a feature film", "my toaster"));
        assert!(is_none("strafe left, mouse untouched", "mouse"));
        assert!(is_none("horizon level, cheers", "cheers"));
        assert!(is_none("a little portrait of the skull", "a little portrait of the skull"));
        assert!(!is_none("push in on the toaster", "the toaster"));
        assert!(!is_none("push in on the mouse", "the mouse"));
        assert!(!is_none("my skull ad", "my skull"));
    }

    #[test]
    fn lenses_and_tricks_are_no_things() {
        assert!(is_none("let the glass do the work: close in on the skull", "the glass"));
        assert!(!is_none("push in on the glass", "the glass"));
        assert!(is_none("the Jaws trick on the plates", "Jaws"));
        assert!(is_none("the Jaws trick on the plates", "the Jaws trick"));
        assert!(!is_none("push in on the jaws of the skull", "the jaws"));
        assert!(is_none("go round the skull counter-clockwise", "counter"));
        assert!(is_none("zoom in, let the whole camera sink", "whole camera sink"));
        assert!(!is_none("go round the counter, then clockwise", "the counter"));
        assert!(is_none("until I can see the whole corner with the skull", "the whole corner"));
        assert!(!is_none("push in on the corner shelf", "the corner shelf"));
    }

    #[test]
    fn chores_decorations_and_portraits_are_no_things() {
        assert!(is_none("push in, sorry about the wind, I'm walking the dog", "the dog"));
        assert!(!is_none("pan to the dog", "the dog"));
        assert!(is_none("the rest is only decoration", "decoration"));
        assert!(!is_none("push in on the decoration", "decoration"));
        assert!(is_none("portrait of the skull, three-quarter view", "portrait"));
        assert!(!is_none("push in on the portrait above the sofa", "portrait"));
    }

    #[test]
    fn what_somebody_is_compared_with_is_no_thing() {
        assert!(is_none("fly up like a drone", "drone"));
        assert!(is_none("i am the cat. low along the floor", "the cat"));
        assert!(is_none("imagine you're our cat, looking up", "our cat"));
        assert!(!is_none("push in like a train on the jar", "jar"));
        assert!(!is_none("you are at the cat", "the cat"));
        assert!(!is_none("something that looks like a kettle", "kettle"));
    }

    #[test]
    fn what_is_in_the_picture_is_seen() {
        assert!(is_none("finish with both curtains in the picture", "the picture"));
        assert!(is_none("until both are in the picture, then stop", "picture"));
        assert!(is_none("creep in until they fill the frame", "the frame"));
        assert!(is_none("show me both chairs in the one picture. then go on", "one picture"));
        assert!(is_none("get both in the same shot", "shot"));
        assert!(!is_none("push in on the picture", "the picture"));
        assert!(!is_none("push in on the boat in the picture on the wall", "the picture"));
    }

    #[test]
    fn light_that_comes_in_is_no_thing() {
        assert!(is_none("follow the light from the window to the bed", "the light"));
        assert!(!is_none("push in on the light", "the light"));
    }

    #[test]
    fn until_is_no_thing() {
        assert!(is_none("swing round till it stares at us", "till"));
        assert!(!is_none("push in on the till", "till"));
    }

    #[test]
    fn what_the_camera_stands_on_is_no_thing() {
        assert!(is_none("look at the mug. Base fixed, pan and tilt only", "Base"));
        assert!(is_none("pan to the mug, the base is locked", "the base"));
        assert!(!is_none("push in on the base", "the base"));
        assert!(!is_none("start at the base cabinet, fixed lens", "the base cabinet"));
        assert!(!is_none("look at the base", "the base"));
    }

    #[test]
    fn terms_of_the_trade_are_no_things() {
        assert!(is_none("Reference plate, locked off", "Reference plate"));
        assert!(is_none("none of the axes may translate", "none of the axes"));
        assert!(is_none("dwell 1 s at each target", "each target"));
        assert!(is_none("on the mug, scratch that, on the jar", "that"));
        assert!(is_none("on the mug, scratch that, on the jar", "scratch"));
        assert!(!is_none("on the scratch, then on the jar", "the scratch"));
        assert!(!is_none("look at the skull, then circle that", "that"));
        assert!(!is_none("hold on the plate", "plate"));
        assert!(!is_none("the skull is the target", "the skull"));
    }

    #[test]
    fn daylight_a_lounge_and_a_count_are_no_things() {
        assert!(is_none("follow the light from the window", "the light"));
        assert!(!is_none("push in on the light", "the light"));
        assert!(is_none("a wide of the lounge", "the lounge"));
        assert!(is_none("the one with the red sun", "the red sun"));
        assert!(is_none("until the three cookies fill the frame", "the three"));
        assert!(!is_none("until the three of them are in", "the three"));
    }
}
