//! Training examples: prompts with the keys that they mean.
//!
//! The prompt sampler draws new sentences for every example. A fraction of the examples comes from realized shots, which have
//! poses as well.

use cinesplat_director::codes::{KeyCode, PoseCode, encode_key};
use cinesplat_director::inputs::{Grounding, ObjectInput, Prompt, TokenInput, Vocabulary, encode_text, object_token};
use cinesplat_director::keys::{MAX_KEYS, keys_of};
use cinesplat_language::{Linked, NamedObject, link};
use cinesplat_operator::Program;
use glam::DVec3;
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::augmentation::{Augmentation, noisy_pose};
use super::error::TrainError;
use super::sentence::Sentence;
use super::sentences::Sentences;
use crate::dataset::RealizedShot;
use crate::sampler::{LabeledPrompt, PromptSampler};

/// Draws for one example before the sampler gives up.
const MAX_DRAWS: usize = 100;

/// A prompt and the correct output for it.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Example {
    pub(super) prompt: Prompt,
    /// Codes of the keys.
    pub(super) keys: Vec<KeyCode>,
    /// Pointer at the quantity that is the length of the film, from 1; 0 = none; `None` = unknown, training skips it.
    pub(super) film_length: Option<usize>,
    /// For each token, whether the notation cannot say it.
    pub(super) unmet: Vec<bool>,
    /// One per key, or empty for sampled sentences.
    pub(super) poses: Vec<PoseCode>,
    /// The poses with noise, which the decoder gets as earlier poses.
    pub(super) noisy_poses: Vec<PoseCode>,
}

/// Source of examples.
#[derive(Debug, Clone)]
pub(super) struct ExampleSampler<'a> {
    pub(super) prompts: PromptSampler,
    pub(super) vocabulary: &'a Vocabulary,
    /// Known words, from which augmentation makes unknown ones.
    pub(super) words: &'a [String],
    /// Sentences of the corpus.
    pub(super) sentences: &'a Sentences,
    /// Fraction of the examples that are sentences of the corpus, 0..=1.
    pub(super) sentences_frac: f64,
    pub(super) shots: &'a [RealizedShot],
    /// Fraction of the examples that are realized shots, 0..=1.
    pub(super) shots_frac: f64,
    pub(super) augmentation: Augmentation,
}

impl ExampleSampler<'_> {
    /// Example `number` of the training with this seed; the same arguments give the same example.
    ///
    /// # Errors
    /// [`TrainError::NoExample`] after 100 draws that keys cannot express · errors of linking and encoding.
    pub(super) fn example(&self, seed: u64, number: u64) -> Result<Example, TrainError> {
        let mut rng = Pcg64::seed_from_u64(seed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        for _ in 0..MAX_DRAWS {
            if let Some(example) = self.draw(&mut rng)? {
                return Ok(example);
            }
        }
        Err(TrainError::NoExample { number })
    }

    /// One draw; `None` when the keys cannot express it (too many keys, objects or mentions).
    fn draw(&self, rng: &mut Pcg64) -> Result<Option<Example>, TrainError> {
        if rng.random_bool(self.shots_frac)
            && let Some(shot) = self.shots.choose(rng)
        {
            return self.of_shot(shot, rng);
        }
        if rng.random_bool(self.sentences_frac)
            && let Some(sentence) = self.sentences.draw(rng)
        {
            return self.of_sentence(&sentence, rng);
        }
        let objects = self.prompts.invent_objects(rng.random_range(3..=12), rng);
        let LabeledPrompt { prompt, program } = self.prompts.sample(&objects, rng);
        let linked = link(&prompt, &objects)?;
        let others = other_ids(&objects, &linked, rng);
        let Some(encoded) = self.encode(&linked, &program, &others, rng)? else { return Ok(None) };
        Ok(Some(self.without_poses(encoded, &linked, &[], rng)))
    }

    /// A sentence of the corpus as an example; `None` when the keys cannot express it.
    fn of_sentence(&self, sentence: &Sentence, rng: &mut Pcg64) -> Result<Option<Example>, TrainError> {
        let first = 1_000_000 - 64;
        let others: Vec<u32> = (first..first + rng.random_range(0..=4)).collect();
        let Some(encoded) = self.encode(&sentence.linked, &sentence.program, &others, rng)? else { return Ok(None) };
        Ok(Some(self.without_poses(encoded, &sentence.linked, &sentence.unmet, rng)))
    }

    /// An example with random objects. `unmet` are bytes of the prompt that the notation cannot say.
    fn without_poses(&self, encoded: EncodedSample, linked: &Linked, unmet: &[[usize; 2]], rng: &mut Pcg64) -> Example {
        let objects = (0..encoded.grounding.object_ids.len()).map(|slot| random_object(slot, rng)).collect();
        let prompt = encoded.prompt(objects, linked.slots.len());
        let unmet = encoded.grounding.tokens_in(unmet);
        let (keys, film_length) = (encoded.keys, encoded.film_length);
        let mut example = Example { prompt, keys, film_length, unmet, ..Example::default() };
        self.augmentation.slots(&mut example.prompt, rng);
        example
    }

    /// A realized shot as an example; `None` when its keys and poses do not match.
    fn of_shot(&self, shot: &RealizedShot, rng: &mut Pcg64) -> Result<Option<Example>, TrainError> {
        let linked = shot.linked()?;
        let inputs = shot.inputs(&linked, rng)?;
        let Some(encoded) = self.encode(&linked, &shot.program, &inputs.others, rng)? else { return Ok(None) };
        if encoded.keys.len() != inputs.poses.len() {
            return Ok(None);
        }
        let noisy_poses = inputs.poses.iter().map(|pose| noisy_pose(*pose, rng)).collect();
        let prompt = encoded.prompt(inputs.objects, linked.slots.len());
        let (keys, film_length) = (encoded.keys, encoded.film_length);
        let mut example = Example { prompt, keys, film_length, poses: inputs.poses, noisy_poses, ..Example::default() };
        self.augmentation.slots(&mut example.prompt, rng);
        Ok(Some(example))
    }

    /// Tokens of the augmented text and key codes of the program; `None` when the keys cannot express it.
    fn encode(
        &self,
        linked: &Linked,
        program: &Program,
        others: &[u32],
        rng: &mut Pcg64,
    ) -> Result<Option<EncodedSample>, TrainError> {
        let keys = keys_of(program);
        if keys.len() > MAX_KEYS {
            return Ok(None);
        }
        let exchanged = self.augmentation.phrases(linked, rng);
        let (augmented, senses) = self.augmentation.words(&exchanged, self.words, rng)?;
        let (tokens, grounding) = encode_text(&augmented, &senses, others, self.vocabulary)?;
        let codes = keys.iter().enumerate().map(|(idx, key)| encode_key(key, idx == 0, &program.forbidden, &grounding));
        let Some(keys) = codes.collect::<Option<Vec<_>>>() else { return Ok(None) };
        let film_length = match program.duration_secs {
            Some(secs) => grounding.seconds_idx(secs, None).map(|idx| idx + 1),
            None => Some(0),
        };
        Ok(Some(EncodedSample { tokens, grounding, keys, film_length }))
    }
}

/// A sentence and its program as numbers.
struct EncodedSample {
    tokens: Vec<TokenInput>,
    grounding: Grounding,
    keys: Vec<KeyCode>,
    film_length: Option<usize>,
}

impl EncodedSample {
    /// The prompt with its objects. The text names the first `num_named` of them.
    fn prompt(&self, objects: Vec<ObjectInput>, num_named: usize) -> Prompt {
        let (tokens, num_quantities) = (self.tokens.clone(), self.grounding.quantities.len());
        Prompt { tokens, num_quantities, objects, num_named }
    }
}

/// Ids of up to four objects that the text does not name.
fn other_ids(objects: &[NamedObject], linked: &Linked, rng: &mut Pcg64) -> Vec<u32> {
    let rest = objects.iter().map(|object| object.id).filter(|id| !linked.slots.contains(id));
    let mut others: Vec<u32> = rest.collect();
    others.shuffle(rng);
    others.truncate(rng.random_range(0..=4));
    others
}

/// A random box in the scene's frame, with up to six random points inside it.
fn random_object(slot: usize, rng: &mut Pcg64) -> ObjectInput {
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
        slot_token: object_token(slot),
        center,
        half_extents,
        points: (0..num_points).map(|_| point(rng)).collect(),
    }
}
