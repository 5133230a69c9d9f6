//! Random changes of examples: other scenes, other names, slips.

use cinesplat_director::names::NameWord;
use cinesplat_language::{NamedObject, Things};
use rand::RngExt;
use rand::seq::{IndexedRandom, SliceRandom};
use rand_pcg::Pcg64;

use super::example::{Labels, Piece, RawExample};
use super::rename::{absent, could_name, new_label, phrase, rename, resay, split_number};

/// Most objects of a scene.
const MAX_OBJECTS: usize = 18;

/// Things whose names hold a word of film.
const FILM_LIKE: [(&str, &str); 44] = [
    ("frame", "picture frame"),
    ("frame", "door frame"),
    ("shot", "shot glass"),
    ("camera", "security camera"),
    ("crane", "tower crane"),
    ("track", "railway track"),
    ("pan", "frying pan"),
    ("boom", "boom box"),
    ("dolly", "furniture dolly"),
    ("level", "spirit level"),
    ("lens", "lens cabinet"),
    ("roll", "paper roll"),
    ("rack", "coat rack"),
    ("rack", "server rack"),
    ("top", "top hat"),
    ("side", "side table"),
    ("corner", "corner sofa"),
    ("end", "end table"),
    ("floor", "floor lamp"),
    ("ceiling", "ceiling fan"),
    ("wall", "wall clock"),
    ("wall", "wall cabinet"),
    ("head", "stone head"),
    ("foot", "foot stool"),
    ("face", "clock face"),
    ("screen", "screen"),
    ("stage", "stage"),
    ("room", "room divider"),
    ("drone", "drone"),
    ("light", "light"),
    ("cut", "paper cutter"),
    ("circle", "stone circle"),
    ("angle", "angle grinder"),
    ("zoom", "zoom lens"),
    ("view", "view master"),
    ("center", "center console"),
    ("middle", "middle rail"),
    ("eye", "eye chart"),
    ("hand", "hand truck"),
    ("wide", "wide bench"),
    ("close", "closet"),
    ("ground", "ground lamp"),
    ("focus", "focus group sign"),
    ("arc", "arc welder"),
];

/// Changes examples.
pub(super) struct Augmentation<'a> {
    /// Labels to draw from.
    pub(super) pool: &'a [String],
}

impl Augmentation<'_> {
    /// A changed copy.
    pub(super) fn apply(&self, raw: &RawExample, labels: &mut Labels, rng: &mut Pcg64) -> RawExample {
        let mut example = raw.clone();
        if rng.random_bool(0.12) {
            slips(&mut example, rng);
            return example;
        }
        for _ in 0..rng.random_range(0..7) {
            rename(&mut example, self.pool, labels, rng);
        }
        for _ in 0..rng.random_range(0..3) {
            resay(&mut example, labels, rng);
        }
        match rng.random_range(0..10) {
            0 => absent(&mut example, self.pool, labels, rng),
            1 => drop_named(&mut example, labels, rng),
            _ => {}
        }
        drop_unnamed(&mut example, rng);
        self.add(&mut example, labels, rng);
        by_number(&mut example, rng);
        slips(&mut example, rng);
        example
    }

    /// Adds things that no mention could mean.
    fn add(&self, example: &mut RawExample, labels: &mut Labels, rng: &mut Pcg64) {
        let count = if rng.random_bool(0.5) { rng.random_range(0..5) } else { 0 };
        for _ in 0..count {
            let label = new_label(self.pool, rng);
            add_object(example, &label, labels, rng);
        }
        if rng.random_bool(0.25) {
            let has =
                |text: &str| example.pieces.iter().any(|piece| matches!(piece, Piece::Word(word) if word.stem == text));
            let fitting: Vec<&str> = FILM_LIKE.iter().filter(|(word, _)| has(word)).map(|(_, label)| *label).collect();
            if let Some(label) = fitting.choose(rng) {
                add_object(example, label, labels, rng);
            }
        }
    }
}

/// Slips of the keyboard, articles left out.
fn slips(example: &mut RawExample, rng: &mut Pcg64) {
    if rng.random_bool(0.35) {
        return;
    }
    let no_articles = rng.random_bool(0.1);
    for piece in &mut example.pieces {
        match piece {
            Piece::Word(word) => slip(word, 0.05, rng),
            Piece::Mention { words, .. } => {
                if no_articles
                    && words.len() > 1
                    && words.first().is_some_and(|word| ["the", "a", "an"].contains(&&*word.text))
                {
                    words.remove(0);
                }
                words.iter_mut().for_each(|word| slip(word, 0.05, rng));
            }
        }
    }
}

/// Adds one object under a new id, if no mention could mean it.
fn add_object(example: &mut RawExample, label: &str, labels: &mut Labels, rng: &mut Pcg64) {
    let read = labels.get(label);
    let meant = example.pieces.iter().any(|piece| match piece {
        Piece::Mention { words, .. } => could_name(words, &read),
        Piece::Word(_) => false,
    });
    if meant || example.objects.len() >= MAX_OBJECTS {
        return;
    }
    let last = example.objects.iter().map(|object| object.id).max().unwrap_or(0);
    for copy in 0..if rng.random_bool(0.2) { rng.random_range(2..4) } else { 1 } {
        example.objects.push(NamedObject { id: last + 1 + copy, label: label.to_owned() });
    }
}

/// Takes some objects away that no mention names.
fn drop_unnamed(example: &mut RawExample, rng: &mut Pcg64) {
    if rng.random_bool(0.5) {
        return;
    }
    let named: Vec<u32> = example.pieces.iter().flat_map(ids_of).collect();
    let keep = rng.random_range(0.2..1.0);
    // Objects of one name stay together: the lowest of them is the one that a mention means.
    let bases: Vec<String> = example
        .objects
        .iter()
        .filter(|object| named.contains(&object.id))
        .map(|object| split_number(&object.label).0.to_owned())
        .collect();
    let mut stays =
        |object: &NamedObject| bases.iter().any(|base| base == split_number(&object.label).0) || rng.random_bool(keep);
    example.objects.retain(&mut stays);
}

/// Takes the things of a mention out of the scene: they are missing now.
fn drop_named(example: &mut RawExample, labels: &mut Labels, rng: &mut Pcg64) {
    let mut named: Vec<u32> = example.pieces.iter().flat_map(ids_of).collect();
    named.shuffle(rng);
    let Some(label) = named.first().and_then(|id| example.label(*id)) else { return };
    let base = split_number(label).0.to_owned();
    let (gone, left): (Vec<NamedObject>, Vec<NamedObject>) =
        example.objects.iter().cloned().partition(|object| split_number(&object.label).0 == base);
    let ids: Vec<u32> = gone.iter().map(|object| object.id).collect();
    let things = Things::embedded();
    for piece in &example.pieces {
        if let Piece::Mention { words, ids: own } = piece
            && own.iter().any(|id| ids.contains(id))
        {
            let is_thing = (0..words.len())
                .any(|start| (start + 1..=words.len()).any(|end| things.roles(&phrase(&words[start..end])) != 0));
            let other = left.iter().any(|object| could_name(words, &labels.get(&object.label)));
            let mixed = own.iter().any(|id| !ids.contains(id));
            let has_tag = words.iter().any(|word| word.tag.is_some());
            if !is_thing || other || mixed || has_tag {
                return;
            }
        }
    }
    example.objects = left;
    for piece in &mut example.pieces {
        if let Piece::Mention { ids: own, .. } = piece {
            own.retain(|id| !ids.contains(id));
        }
    }
}

fn ids_of(piece: &Piece) -> Vec<u32> {
    match piece {
        Piece::Word(_) => Vec::new(),
        Piece::Mention { ids, .. } => ids.clone(),
    }
}

/// Names some objects by their numbers.
fn by_number(example: &mut RawExample, rng: &mut Pcg64) {
    for piece in &mut example.pieces {
        if let Piece::Mention { words, ids } = piece
            && let [id] = ids[..]
            && rng.random_bool(0.015)
        {
            *words = vec![NameWord { tag: Some(Some(id)), ..NameWord::new("<obj>") }];
        }
    }
}

/// With some probability two letters swapped, one left out, or one doubled.
fn slip(word: &mut NameWord, probability: f64, rng: &mut Pcg64) {
    let mut letters: Vec<char> = word.text.chars().collect();
    if letters.len() < 4 || !word.is_alphabetic() || !rng.random_bool(probability) {
        return;
    }
    let at = rng.random_range(1..letters.len() - 1);
    match rng.random_range(0..4) {
        0 => letters.swap(at, at + 1),
        1 => {
            letters.remove(at);
        }
        2 => letters.insert(at, letters[at]),
        _ => letters[at] = char::from(b'a' + rng.random_range(0..26_u8)),
    }
    *word = NameWord::new(&letters.into_iter().collect::<String>());
}
