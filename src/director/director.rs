//! Runs the trained network: turns a linked prompt and a scene into a program and cameras.

use std::path::Path;

use cinesplat_files::sha256_hex;
use cinesplat_language::{
    Linked, Mention, NamedObject, Word, are_effect_phrases, blanked, check_prompt, is_no_thing, link_parts, part_of,
    scenery, tokenize, without_arrows, without_behind, without_camera_settings, without_dictation, without_frame_shape,
    without_references, without_slate, without_tolerances,
};
use cinesplat_objects::{Object, only_whole};
use cinesplat_trajectory::ModelRef;
use glam::DVec3;
use rayon::iter::{IntoParallelRefIterator as _, ParallelIterator as _};

use crate::acting::acts;
use crate::appositions::{drop_contents, drop_described, share_nouns};
use crate::banned::name_banned;
use crate::bearers::drop_other_bearers;
use crate::consensus::consensus;
use crate::contained::point_by_words;
use crate::direction::Direction;
use crate::error::DirectorError;
use crate::explained::{drop_first_ones, drop_sizes, name_by_label_words, name_by_parts, point_back, point_ones};
use crate::heads::point_by_heads;
use crate::hung::name_pictures;
use crate::idle::without_idle;
use crate::inputs::other_objects;
use crate::lacking::name_lacking;
use crate::lettered::name_lettered;
use crate::likeness::join_likenesses;
use crate::located::absorb_places;
use crate::model::Model;
use crate::model_files::{ModelFiles, folder_of};
use crate::names::{FoundMention, Names, NamesFiles};
use crate::numbered_lists::name_numbered;
use crate::ordinals::point_by_order;
use crate::pairs::name_pairs;
use crate::placed::{Places, point_by_places};
use crate::said_again::point_to_said;
use crate::scan_parts::{described_part, own_parts};
use crate::sized::{point_by_comparison, point_by_size};
use crate::tensor_file::bad_weights;
use crate::uses::name_by_uses;
use crate::verbs_apart::take_verbs_off;

/// The facts about a scene that the director needs.
#[derive(Debug, Clone, Copy)]
pub struct SceneContext<'a> {
    /// Objects of the scene, with their clouds where they have one.
    pub objects: &'a [Object],
    /// Up direction of the world.
    pub up: DVec3,
    /// Center of the scene, world.
    pub center: DVec3,
    /// Size of the scene, scene units.
    pub size: f64,
}

/// The trained networks, which turn words and objects into keys.
#[derive(Debug, Clone)]
pub struct Director {
    /// At least one.
    models: Vec<Model>,
    names: Names,
}

impl Director {
    /// The director with the weights that are compiled into the program.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the built-in files do not fit together.
    pub fn embedded() -> Result<Self, DirectorError> {
        Self::from_all(&ModelFiles::embedded_all())
    }

    /// A director from the files of a folder; `path` is the folder, or the `director.json` in it. Folders of models in it are
    /// further networks. A folder without the network of names takes the built-in one.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] when a file is damaged, of another version, or does not
    /// fit the others.
    pub fn load(path: &Path) -> Result<Self, DirectorError> {
        let folder = folder_of(path);
        let has_names = NamesFiles::NAMES.iter().any(|name| folder.join(name).exists());
        let names = if has_names { Names::load(folder)? } else { Names::embedded()? };
        Self::of(&ModelFiles::read_all(path)?, names)
    }

    /// A director from model files in memory, with the built-in network of names.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a file is damaged, of another version, or does not fit the others.
    pub fn from_files(files: &ModelFiles) -> Result<Self, DirectorError> {
        Self::from_all(std::slice::from_ref(files))
    }

    /// A director of several networks from their files in memory, with the built-in network of names.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a file is damaged, of another version, or does not fit the others, and without files.
    pub fn from_all(files: &[ModelFiles]) -> Result<Self, DirectorError> {
        if files.is_empty() {
            return Err(bad_weights(&"no model", &"at least one"));
        }
        Self::of(files, Names::embedded()?)
    }

    /// A director of the networks of some files, at least one.
    fn of(files: &[ModelFiles], names: Names) -> Result<Self, DirectorError> {
        let loaded: Vec<Result<Model, DirectorError>> = files.par_iter().map(Model::load).collect();
        Ok(Self { models: loaded.into_iter().collect::<Result<_, _>>()?, names })
    }

    /// Names of the networks, and the hash of the weights, as shots store them: of several networks it is the hash of their hashes.
    pub fn model_ref(&self) -> ModelRef {
        let names: Vec<&str> = self.models.iter().map(|model| &*model.name).collect();
        let hashes: Vec<&str> = self.models.iter().map(|model| &*model.weights_sha256).collect();
        let sha256 = if let [hash] = hashes[..] { hash.to_owned() } else { sha256_hex(hashes.concat().as_bytes()) };
        ModelRef { name: names.join("+"), sha256 }
    }

    /// The words of a prompt but those about the shape of the frame, with its mentions of objects. A mention of
    /// something that the scene lacks is a group without members.
    ///
    /// # Errors
    /// [`DirectorError::Language`] for a prompt that is empty, too long, or names too many objects or a number that no
    /// object has · [`DirectorError::NotFinite`] when the weights of the network of names are damaged ·
    /// [`DirectorError::Compute`] when a tensor operation fails.
    pub fn link(&self, prompt: &str, objects: &[NamedObject]) -> Result<Linked, DirectorError> {
        self.link_placed(prompt, objects, Places { objects: &[], up: DVec3::Y })
    }

    /// [`link`](Self::link), where it is known where the objects are: the words may tell things of one kind by their places.
    ///
    /// # Errors
    /// Those of [`link`](Self::link).
    pub fn link_placed(
        &self,
        prompt: &str,
        objects: &[NamedObject],
        places: Places<'_>,
    ) -> Result<Linked, DirectorError> {
        check_prompt(prompt)?;
        let prompt = &*without_dictation(prompt);
        let prompt = &*without_slate(prompt);
        let prompt = &*without_references(prompt);
        let prompt = &*without_frame_shape(prompt, objects);
        let prompt = &*without_camera_settings(prompt)?;
        let prompt = &*without_tolerances(prompt);
        let prompt = &*without_arrows(prompt);
        let (prompt, behinds) = without_behind(prompt);
        let prompt = &*prompt;
        let mut found = self.names.mentions(prompt, objects)?;
        take_verbs_off(prompt, objects, &mut found);
        found.retain(|found| !is_no_thing(prompt, &found.mention, objects));
        let mentions: Vec<Mention> = found.iter().map(|found| found.mention.clone()).collect();
        let scenery = scenery(prompt, &mentions)?;
        let prompt = &*blanked(prompt, &scenery);
        let is_blank = |at: usize| scenery.iter().any(|[start, end]| (*start..*end).contains(&at));
        found.retain(|found| !is_blank(found.mention.bytes[0]));
        drop_sizes(prompt, objects, &mut found);
        name_numbered(prompt, objects, &mut found);
        let defined = name_lettered(prompt, objects, &mut found);
        let prompt = &*blanked(prompt, &defined);
        let described = drop_described(prompt, objects, &mut found);
        let prompt = &*blanked(prompt, &described);
        share_nouns(prompt, objects, &mut found);
        name_by_label_words(prompt, objects, &mut found);
        name_by_uses(prompt, objects, &mut found);
        name_banned(prompt, objects, &mut found);
        name_lacking(prompt, objects, &mut found)?;
        join_likenesses(prompt, objects, &mut found);
        name_pictures(prompt, objects, &mut found);
        point_by_heads(prompt, objects, places, &mut found);
        point_by_words(prompt, objects, &mut found);
        point_to_said(prompt, objects, &mut found);
        point_by_size(prompt, objects, places, &mut found);
        point_by_comparison(prompt, places, &mut found);
        point_by_places(prompt, objects, places, &mut found);
        point_by_order(prompt, places, &mut found);
        let led = name_pairs(prompt, objects, places, &mut found);
        let prompt = &*blanked(prompt, &led);
        absorb_places(prompt, objects, places, &mut found)?;
        drop_other_bearers(prompt, objects, places, &mut found);
        point_back(prompt, objects, &mut found);
        point_ones(prompt, objects, &mut found);
        drop_first_ones(prompt, &mut found);
        own_parts(prompt, objects, places, &mut found)?;
        name_by_parts(prompt, objects, &mut found)?;
        let acts = acts(prompt, objects, &mut found)?;
        let prompt = &*blanked(prompt, &acts);
        let contents = drop_contents(prompt, &mut found);
        let prompt = &*blanked(prompt, &contents);
        let parts: Vec<[usize; 2]> = found.iter().map(|found| found.mention.bytes).collect();
        let are_effects = are_effect_phrases(prompt, &parts)?;
        // The scene lacks no `bloom`, and the bike is not meant by it either: it is what the lens makes.
        let is_thing =
            |(found, is_effect): &(&FoundMention, bool)| !is_effect || has_word_of_name(prompt, found, objects);
        let things = found.iter().zip(are_effects).filter(is_thing);
        let mentions: Vec<Mention> = things.map(|(found, _)| found.mention.clone()).collect();
        let whole = only_whole(places.objects).map(|whole| whole.id);
        let part = |mention: &Mention| {
            let [id] = mention.ids[..] else { return Ok(None) };
            let label = objects.iter().find(|object| object.id == id).map_or("", |object| object.label.as_str());
            let words = prompt.get(mention.bytes[0]..mention.bytes[1]).unwrap_or_default();
            Ok(part_of(words, label)?.or(described_part(words, label, whole == Some(id))?))
        };
        let mut linked = Linked { scenery, acts, ..link_parts(prompt, &mentions, &part)? };
        name_nearest(prompt, &found, &mut linked);
        Ok(linked.without_limits()?.without_backdrops(&behinds))
    }

    /// Ids of the objects that are inputs of the network: those that the prompt names, then the nearest others.
    pub fn looks_at(linked: &Linked, objects: &[Object]) -> Vec<u32> {
        let mut named = linked.expanded(&linked.slots);
        named.retain(|id| linked.missing(*id).is_none());
        let others = other_objects(objects, &named);
        named.into_iter().chain(others).collect()
    }

    /// The program that the prompt requests, and one camera per key: the reading of one of the networks that agrees best with the
    /// readings of all. Each reads all words, and those that ask for something. The same input gives the same output.
    ///
    /// # Errors
    /// [`DirectorError::PromptTooLong`] · [`DirectorError::EmptyPrompt`] · [`DirectorError::BadScene`], also when a camera's
    /// position is not finite · [`DirectorError::NotFinite`] when the weights are damaged · [`DirectorError::Compute`] when a
    /// tensor operation fails.
    pub fn direct(&self, linked: &Linked, scene: &SceneContext<'_>) -> Result<Direction, DirectorError> {
        let asked = without_idle(linked)?;
        let texts: Vec<&Linked> = std::iter::once(linked).chain(&asked).collect();
        let tasks: Vec<(&Model, &Linked)> =
            self.models.iter().flat_map(|model| texts.iter().map(move |text| (model, *text))).collect();
        let found: Vec<Result<Direction, DirectorError>> =
            tasks.par_iter().map(|(model, text)| model.direct(text, linked, scene)).collect();
        let mut readings = Vec::with_capacity(found.len());
        let mut first_error = None;
        for reading in found {
            match reading {
                Ok(reading) => readings.push(reading),
                // One network has more tokens for the same words than another, and less words may be few enough.
                Err(error @ (DirectorError::PromptTooLong { .. } | DirectorError::EmptyPrompt)) => {
                    first_error.get_or_insert(error);
                }
                Err(error) => return Err(error),
            }
        }
        if let (true, Some(error)) = (readings.is_empty(), first_error) {
            return Err(error);
        }
        Ok(consensus(readings))
    }
}

/// Gives what the scene lacks the nearest names of the scene, as its mention has them.
fn name_nearest(prompt: &str, found: &[FoundMention], linked: &mut Linked) {
    for group in linked.groups.iter_mut().filter(|group| group.members.is_empty()) {
        let words = |found: &&FoundMention| {
            let [start, end] = found.mention.bytes;
            prompt.get(start..end).is_some_and(|words| group.is_named(words))
        };
        group.nearest = found.iter().find(words).map(|found| found.nearest.clone()).unwrap_or_default();
    }
}

/// Whether a mention and the label of one of its objects have a word in common.
fn has_word_of_name(prompt: &str, found: &FoundMention, objects: &[NamedObject]) -> bool {
    let Mention { bytes: [start, end], ids } = &found.mention;
    let said = tokenize(prompt.get(*start..*end).unwrap_or_default());
    let is_said = |word: Word| word.is_alphabetic() && said.iter().any(|said| said.stem == word.stem);
    objects.iter().any(|object| ids.contains(&object.id) && tokenize(&object.label).into_iter().any(is_said))
}
