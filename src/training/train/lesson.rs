//! Lessons: prompts with the keys that they should become.
//!
//! The phrasebook invents the words anew for every lesson; a share of the lessons comes from realized shots and has
//! poses as well. Words are damaged at random, so that the network does not hang on any one of them.

use rand::seq::{IndexedRandom, SliceRandom};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::TrainError;
use crate::dataset::RealizedShot;
use crate::sampler::{LabeledPrompt, PromptSampler};
use cinesplat_director::codes::Grounding;
use cinesplat_director::codes::{self, KeyCode};
use cinesplat_director::ground::{Ground, ground, prompt};
use cinesplat_director::keys::{MAX_KEYS, keys_of};
use cinesplat_director::model::{ObjectInput, PoseCode, Prompt};
use cinesplat_director::vocabulary::{NUM_OBJECT_SLOTS, Vocabulary, object_token};
use cinesplat_language::{Linked, NamedObject, link};
use glam::DVec3;

/// One prompt and what should come of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Lesson {
    pub(crate) prompt: Prompt,
    pub(crate) keys: Vec<KeyCode>,
    /// Place of the film's length among the quantities, from 1; 0 = not said; `None` = not known.
    pub(crate) film: Option<usize>,
    /// One a key, or none at all.
    pub(crate) poses: Vec<PoseCode>,
    /// The same, as the decoder shall see them: a little off, as its own would be.
    pub(crate) seen_poses: Vec<PoseCode>,
}

/// How lessons are damaged.
#[allow(clippy::struct_field_names, reason = "shares carry their unit")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Damage {
    /// Share of the lessons whose words are damaged at all.
    pub(crate) lessons_frac: f64,
    /// Share of their words that are.
    pub(crate) words_frac: f64,
    /// Share of the lessons whose objects get other identifiers than 0, 1, ..
    pub(crate) slots_frac: f64,
}

impl Damage {
    /// None.
    pub(crate) const NONE: Self = Self { lessons_frac: 0.0, words_frac: 0.0, slots_frac: 0.0 };
}

impl Default for Damage {
    fn default() -> Self {
        Self { lessons_frac: 0.5, words_frac: 0.07, slots_frac: 0.2 }
    }
}

/// Where lessons come from.
#[derive(Debug, Clone)]
pub(crate) struct School<'a> {
    pub(crate) phrasebook: PromptSampler,
    pub(crate) vocabulary: &'a Vocabulary,
    /// Words that stand in for others.
    pub(crate) words: &'a [String],
    pub(crate) shots: &'a [RealizedShot],
    /// Share of the lessons that are realized shots.
    pub(crate) shots_frac: f64,
    pub(crate) damage: Damage,
}

impl School<'_> {
    /// Lesson number `number` of a training with this seed: always the same.
    pub(crate) fn lesson(&self, seed: u64, number: u64) -> Result<Lesson, TrainError> {
        let mut rng = Pcg64::seed_from_u64(seed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        // A draw that the keys cannot express (too many of anything) is made again.
        for _ in 0..100 {
            if let Some(lesson) = self.draw(&mut rng)? {
                return Ok(lesson);
            }
        }
        Err(TrainError::NoLesson { number })
    }

    fn draw(&self, rng: &mut Pcg64) -> Result<Option<Lesson>, TrainError> {
        if rng.random_bool(self.shots_frac)
            && let Some(shot) = self.shots.choose(rng)
        {
            return self.of_shot(shot, rng);
        }
        let objects = self.phrasebook.invent_objects(rng.random_range(3..=12), rng);
        let LabeledPrompt { prompt, program } = self.phrasebook.sample(&objects, rng);
        let linked = link(&prompt, &objects)?;
        let others = other_ids(&objects, &linked, rng);
        let Some((tokens, ground, keys, film)) = self.encode(&linked, &program, &others, rng)? else { return Ok(None) };
        let mut lesson =
            Lesson { prompt: prompt_of(tokens, &ground, linked.slots.len(), rng), keys, film, ..Lesson::default() };
        self.rename_slots(&mut lesson.prompt, rng);
        Ok(Some(lesson))
    }

    fn of_shot(&self, shot: &RealizedShot, rng: &mut Pcg64) -> Result<Option<Lesson>, TrainError> {
        let linked = shot.linked()?;
        let view = shot.view(&linked, rng)?;
        let Some((tokens, ground, keys, film)) = self.encode(&linked, &shot.program, &view.others, rng)? else {
            return Ok(None);
        };
        if keys.len() != view.poses.len() {
            return Ok(None);
        }
        let seen_poses = view.poses.iter().map(|pose| jittered(*pose, rng)).collect();
        let prompt = prompt(tokens, view.objects, &ground, linked.slots.len());
        let mut lesson = Lesson { prompt, keys, film, poses: view.poses, seen_poses };
        self.rename_slots(&mut lesson.prompt, rng);
        Ok(Some(lesson))
    }

    /// Tokens (of damaged words) and key codes of a program; `None` when they do not fit.
    #[allow(clippy::type_complexity, reason = "four parts of one result, taken apart by both callers at once")]
    fn encode(
        &self,
        linked: &Linked,
        program: &cinesplat_operator::Program,
        others: &[u32],
        rng: &mut Pcg64,
    ) -> Result<Option<(Vec<cinesplat_director::model::TokenInput>, Ground, Vec<KeyCode>, Option<usize>)>, TrainError>
    {
        let keys = keys_of(program);
        if keys.len() > MAX_KEYS {
            return Ok(None);
        }
        let damaged = self.damaged(linked, rng);
        let (tokens, ground) = ground(&damaged, others, self.vocabulary)?;
        let codes = keys.iter().enumerate().map(|(idx, key)| codes::encode(key, idx == 0, &ground));
        let Some(codes) = codes.collect::<Option<Vec<_>>>() else { return Ok(None) };
        let film = match program.duration_secs {
            Some(secs) => ground.seconds_place(secs, None).map(|place| place + 1),
            None => Some(0),
        };
        Ok(Some((tokens, ground, codes, film)))
    }

    /// The linked prompt with some words misspelled, exchanged or made unreadable. Their places stay.
    fn damaged(&self, linked: &Linked, rng: &mut Pcg64) -> Linked {
        if !rng.random_bool(self.damage.lessons_frac) {
            return linked.clone();
        }
        let words = linked.tokens_text.split(' ').map(|word| {
            let plain = word.chars().all(char::is_alphabetic);
            if plain && rng.random_bool(self.damage.words_frac) {
                self.damaged_word(word, rng)
            } else {
                word.to_owned()
            }
        });
        Linked { tokens_text: words.collect::<Vec<_>>().join(" "), ..linked.clone() }
    }

    fn damaged_word(&self, word: &str, rng: &mut Pcg64) -> String {
        match rng.random_range(0..4) {
            // No vocabulary has this character.
            0 | 1 => "\u{fffd}".to_owned(),
            2 => self.made_up(word, rng),
            _ => misspelled(word, rng),
        }
    }

    /// A word that nobody knows, of the front of one word and the back of another: like the verbs of people that the
    /// phrasebook lacks it has to be understood from what stands around it.
    fn made_up(&self, word: &str, rng: &mut Pcg64) -> String {
        let mut half = |back: bool| {
            let letters: Vec<char> = self.words.choose(rng).map_or(word, String::as_str).chars().collect();
            let middle = letters.len().div_ceil(2);
            if back { letters.into_iter().skip(middle).collect() } else { letters.into_iter().take(middle).collect() }
        };
        let (front, back): (String, String) = (half(false), half(true));
        front + &back
    }

    /// Gives the objects of some lessons identifiers from anywhere, so that all of them are learned.
    fn rename_slots(&self, prompt: &mut Prompt, rng: &mut Pcg64) {
        if !rng.random_bool(self.damage.slots_frac) {
            return;
        }
        let mut slots: Vec<usize> = (0..NUM_OBJECT_SLOTS).collect();
        for place in 0..prompt.objects.len().min(slots.len()) {
            let other = rng.random_range(place..slots.len());
            slots.swap(place, other);
        }
        let id_of = |place: usize| slots.get(place).map(|slot| object_token(*slot));
        for (place, object) in prompt.objects.iter_mut().enumerate() {
            object.slot_token = id_of(place).unwrap_or(object.slot_token);
        }
        for token in &mut prompt.tokens {
            if let Some(id) = token.object.and_then(id_of) {
                token.id = id;
            }
        }
    }
}

/// Two letters exchanged, or one left out.
fn misspelled(word: &str, rng: &mut Pcg64) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    if letters.len() < 3 {
        return word.to_owned();
    }
    let at = rng.random_range(0..letters.len() - 1);
    if rng.random_bool(0.5) {
        letters.swap(at, at + 1);
    } else {
        letters.remove(at);
    }
    letters.into_iter().collect()
}

/// Some of the objects that the text does not name.
fn other_ids(objects: &[NamedObject], linked: &Linked, rng: &mut Pcg64) -> Vec<u32> {
    let rest = objects.iter().map(|object| object.id).filter(|id| !linked.slots.contains(id));
    let mut others: Vec<u32> = rest.collect();
    others.shuffle(rng);
    others.truncate(rng.random_range(0..=4));
    others
}

/// Tokens with made-up objects: boxes strewn over the frame, each with a few points of a box or a ball.
fn prompt_of(
    tokens: Vec<cinesplat_director::model::TokenInput>,
    ground: &Ground,
    num_named: usize,
    rng: &mut Pcg64,
) -> Prompt {
    let objects = (0..ground.ids.len()).map(|place| invented(place, rng)).collect();
    prompt(tokens, objects, ground, num_named)
}

fn invented(place: usize, rng: &mut Pcg64) -> ObjectInput {
    let mut within = |low: f64, high: f64| rng.random_range(low..high);
    let center = DVec3::new(within(-0.4, 0.4), within(-0.15, 0.15), within(-0.4, 0.4));
    let half_extents = DVec3::new(within(0.01, 0.12), within(0.01, 0.12), within(0.01, 0.12));
    let scale = half_extents.length().recip();
    let num_points = rng.random_range(1..=6);
    let point = |rng: &mut Pcg64| {
        let offset = DVec3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        (offset * half_extents * scale).as_vec3().to_array()
    };
    ObjectInput {
        slot_token: object_token(place),
        center,
        half_extents,
        points: (0..num_points).map(|_| point(rng)).collect(),
    }
}

/// A pose a little off, as the decoder's own poses will be.
fn jittered(pose: PoseCode, rng: &mut Pcg64) -> PoseCode {
    let mut off = |value: f32, by: f32| value + rng.random_range(-by..by);
    PoseCode {
        position: pose.position.map(|value| off(value, 0.05)),
        rotation_6d: pose.rotation_6d.map(|value| off(value, 0.1)),
        log_fov: off(pose.log_fov, 0.05),
        log_wait: off(pose.log_wait, 0.1),
    }
}
