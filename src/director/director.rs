//! Runs the trained network: turns a linked prompt and a scene into a program and cameras.

use std::path::Path;

use cinesplat_language::{
    Linked, Mention, NamedObject, Word, are_effect_phrases, blanked, check_prompt, is_no_thing, link_parts, part_of,
    scenery, tokenize, without_arrows, without_behind, without_camera_settings, without_dictation, without_frame_shape,
    without_references, without_slate, without_tolerances,
};
use cinesplat_objects::{Object, only_whole};
use cinesplat_operator::{Program, StepCameras};
use cinesplat_trajectory::{CameraState, ModelRef};
use glam::{DQuat, DVec3, Vec3};

use crate::acting::acts;
use crate::alternatives::without_denied_turns;
use crate::banned::name_banned;
use crate::bearers::drop_other_bearers;
use crate::beats::direct_beats;
use crate::codes::{self, Field, KeyCode, NEXT_SEGMENT, PoseCode};
use crate::compositions::direct_composed;
use crate::contained::point_by_words;
use crate::decoding::{Choice, DecodedPrompt, KeyCertainty, WordRules, decode};
use crate::direction::{Direction, StepCertainty};
use crate::error::DirectorError;
use crate::explained::{drop_first_ones, drop_sizes, name_by_label_words, name_by_parts, point_back, point_ones};
use crate::frame::SceneFrame;
use crate::heads::point_by_heads;
use crate::hung::name_pictures;
use crate::inputs::{Grounding, Prompt, encode_text, object_input, other_objects};
use crate::keys::{boundaries_of, steps_of};
use crate::lacking::name_lacking;
use crate::lettered::name_lettered;
use crate::likeness::join_likenesses;
use crate::located::absorb_places;
use crate::lost::add_lost_clauses;
use crate::model::Model;
use crate::model_files::ModelFiles;
use crate::names::{FoundMention, Names, NamesFiles};
use crate::numbered_lists::name_numbered;
use crate::ordinals::point_by_order;
use crate::pairs::name_pairs;
use crate::placed::{Places, point_by_places};
use crate::said::{frame_parts, pan_from_first_to_last, take_said, take_said_of_all};
use crate::said_again::point_to_said;
use crate::scan_parts::{described_part, own_parts};
use crate::sized::{point_by_comparison, point_by_size};
use crate::times::ListedTimes;
use crate::told::without_told;
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

/// The trained network, which turns words and objects into keys.
#[derive(Debug, Clone)]
pub struct Director {
    model: Model,
    names: Names,
}

impl Director {
    /// The director with the weights that are compiled into the program.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the built-in files do not fit together.
    pub fn embedded() -> Result<Self, DirectorError> {
        Self::from_files(&ModelFiles::embedded())
    }

    /// A director from the files of a folder; `path` is the folder, or the `director.json` in it. A folder without the
    /// network of names takes the built-in one.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] when a file is damaged, of another version, or does not
    /// fit the others.
    pub fn load(path: &Path) -> Result<Self, DirectorError> {
        let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new(".")) };
        let has_names = NamesFiles::NAMES.iter().any(|name| folder.join(name).exists());
        let names = if has_names { Names::load(folder)? } else { Names::embedded()? };
        Ok(Self { model: Model::load(&ModelFiles::read(path)?)?, names })
    }

    /// A director from model files in memory, with the built-in network of names.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a file is damaged, of another version, or does not fit the others.
    pub fn from_files(files: &ModelFiles) -> Result<Self, DirectorError> {
        Ok(Self { model: Model::load(files)?, names: Names::embedded()? })
    }

    /// Name and hash of the weights, as shots store them.
    pub fn model_ref(&self) -> ModelRef {
        ModelRef { name: self.model.name.clone(), sha256: self.model.weights_sha256.clone() }
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

    /// The program that the prompt requests, and one camera per key. The same input gives the same output.
    ///
    /// # Errors
    /// [`DirectorError::PromptTooLong`] · [`DirectorError::EmptyPrompt`] · [`DirectorError::BadScene`], also when a camera's
    /// position is not finite · [`DirectorError::NotFinite`] when the weights are damaged · [`DirectorError::Compute`] when a
    /// tensor operation fails.
    pub fn direct(&self, linked: &Linked, scene: &SceneContext<'_>) -> Result<Direction, DirectorError> {
        let whole = linked;
        let asked = without_told(linked);
        let linked = asked.as_ref().unwrap_or(linked);
        let done = without_denied_turns(linked);
        let linked = done.as_ref().unwrap_or(linked);
        let times = ListedTimes::of(linked);
        let timeless = times.as_ref().and_then(|times| times.without(linked));
        let mut direction =
            direct_composed(timeless.as_ref().unwrap_or(linked), &|linked, subjects| match &linked.timeline {
                Some(timeline) => direct_beats(linked, timeline, subjects, &|part| self.direct_corrected(part, scene)),
                None => self.direct_clauses(linked, scene),
            })?;
        if let Some(times) = times {
            times.write(&mut direction);
        }
        take_said_of_all(whole, scene.objects, &mut direction);
        frame_parts(whole, (scene.objects, scene.up), &mut direction.program);
        pan_from_first_to_last((scene.objects, scene.up), &mut direction.program);
        direction.unmet.extend(&whole.acts);
        Ok(direction)
    }

    /// The direction of a prompt, with that of its clauses that are left out where it is read as a whole.
    fn direct_clauses(&self, linked: &Linked, scene: &SceneContext<'_>) -> Result<Direction, DirectorError> {
        let mut direction = self.direct_corrected(linked, scene)?;
        add_lost_clauses(linked, &mut direction, &|part| self.direct_corrected(part, scene))?;
        Ok(direction)
    }

    /// The direction of a prompt, or of what a person who corrects himself in it means, whichever is surer.
    fn direct_corrected(&self, linked: &Linked, scene: &SceneContext<'_>) -> Result<Direction, DirectorError> {
        let without_denied = linked.without_denied();
        let linked = without_denied.as_ref().unwrap_or(linked);
        let as_said = self.direct_part(linked, scene)?;
        let Some(corrected) = linked.corrected() else { return Ok(as_said) };
        let as_meant = self.direct_part(&corrected, scene)?;
        // What somebody takes back is in no step.
        let is_back = |id: &u32| !linked.expanded(&corrected.slots).contains(id);
        let keeps_back = as_said.program.object_ids().iter().any(is_back)
            && !as_meant.program.steps.is_empty()
            && !as_meant.program.object_ids().is_empty();
        let is_surer = as_meant.mean_certainty() > as_said.mean_certainty();
        Ok(if keeps_back || is_surer || goes_other_way(&as_said, &as_meant) { as_meant } else { as_said })
    }

    /// The program and cameras of a prompt that is read as a whole.
    fn direct_part(&self, linked: &Linked, scene: &SceneContext<'_>) -> Result<Direction, DirectorError> {
        let others = other_objects(scene.objects, &linked.expanded(&linked.slots));
        let senses = linked.senses()?;
        let (tokens, grounding) = encode_text(linked, &senses, &others, &self.model.vocabulary)?;
        // A group looks like its first member.
        let object = |id: &u32| {
            let id = linked.expanded(&[*id]).first().copied()?;
            scene.objects.iter().find(|object| object.id == id)
        };
        let seen = || grounding.object_ids.iter().map(object);
        let frame = SceneFrame::new(scene.up, scene.center, scene.size, seen().next().flatten().map(|o| o.center))?;
        let objects = seen().enumerate().map(|(idx, object)| object.map(|o| object_input(o, idx, &frame)));
        let prompt = Prompt {
            tokens,
            num_quantities: grounding.quantities.len(),
            objects: objects.map(Option::unwrap_or_default).collect(),
            num_named: linked.slots.len(),
        };
        let rules = WordRules { kinds: grounding.kinds(), is_move: grounding.is_move(&linked.tokens_text) };
        let decoded = decode((&self.model.network, &self.model.config), &prompt, &rules)?;
        let mut direction = direction(&decoded, &grounding, &frame)?;
        for certainty in &mut direction.certainty {
            certainty.probability = self.model.calibration.apply(certainty.probability);
        }
        take_said(linked, &senses, &mut direction)?;
        // What the scene lacks stays a group, so that callers can tell it.
        direction.program = direction.program.with_ids(&|ids| linked.expanded(ids));
        Ok(direction)
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

/// Whether both directions have the same steps but for a way that one of them goes in the opposite direction: the one that is said
/// last counts.
fn goes_other_way(said: &Direction, meant: &Direction) -> bool {
    let (said, meant) = (&said.program.steps, &meant.program.steps);
    let mut pairs = said.iter().zip(meant);
    said.len() == meant.len() && pairs.any(|(said, meant)| said.movement.opposite() == Some(meant.movement))
}

/// Whether a mention and the label of one of its objects have a word in common.
fn has_word_of_name(prompt: &str, found: &FoundMention, objects: &[NamedObject]) -> bool {
    let Mention { bytes: [start, end], ids } = &found.mention;
    let said = tokenize(prompt.get(*start..*end).unwrap_or_default());
    let is_said = |word: Word| word.is_alphabetic() && said.iter().any(|said| said.stem == word.stem);
    objects.iter().any(|object| ids.contains(&object.id) && tokenize(&object.label).into_iter().any(is_said))
}

/// The program and the cameras of decoded keys.
fn direction(decoded: &DecodedPrompt, grounding: &Grounding, frame: &SceneFrame) -> Result<Direction, DirectorError> {
    let keys: Vec<_> = decoded.keys.iter().map(|code| codes::decode_key(code, grounding)).collect();
    let program = Program {
        steps: steps_of(&keys),
        duration_secs: decoded.film_length.and_then(|idx| grounding.seconds(idx)),
        forbidden: decoded.keys.first().map(codes::forbidden_of).unwrap_or_default(),
        limits: Vec::new(),
    };
    let step_keys = boundaries_of(&keys);
    let certainty = step_keys
        .iter()
        .zip(&program.steps)
        .map(|([start, end], step)| certainty(&decoded.keys, &decoded.certainties, [*start, *end], step.words))
        .collect();
    let cameras = cameras(&decoded.poses, frame)?;
    let ends = step_keys.iter().map_while(|&[start, end]| cameras.get(start).zip(cameras.get(end)));
    let step_cameras = ends.map(|((start_secs, start), (end_secs, end))| StepCameras {
        start: *start,
        end: *end,
        secs: end_secs - start_secs,
    });
    let unmet = grounding.ranges_of(&decoded.unmet);
    Ok(Direction { program, step_cameras: step_cameras.collect(), certainty, unmet })
}

/// World cameras of pose codes, each with its time from the start of the film. A degenerate rotation is replaced by the
/// rotation of the camera before.
fn cameras(poses: &[PoseCode], frame: &SceneFrame) -> Result<Vec<(f64, CameraState)>, DirectorError> {
    let mut fallback = level_rotation();
    let mut time_secs = 0.0;
    let mut cameras = Vec::with_capacity(poses.len());
    for code in poses {
        let pose = frame.world_pose(Vec3::from(code.position).as_dvec3(), code.rotation_6d.map(f64::from), fallback);
        if !pose.position.is_finite() {
            return Err(DirectorError::BadScene {
                found: format!("a camera at {}", pose.position),
                expected: "an extent whose cameras have finite positions",
            });
        }
        if !cameras.is_empty() {
            time_secs += f64::from(code.log_wait).exp_m1();
        }
        fallback = frame.turn(pose.rotation);
        let fov_y_rad = codes::fov_y_rad(code.log_fov);
        cameras.push((time_secs, CameraState { pose, fov_y_rad, focus_distance: None }));
    }
    Ok(cameras)
}

/// Rotation `frame_from_camera` of a level camera that looks along -z of the scene's frame.
fn level_rotation() -> DQuat {
    DQuat::from_rotation_x(std::f64::consts::PI)
}

/// Certainty of the step between two keys: the choices that its start key makes for what follows, and the choices that
/// its end key makes for the arrival.
fn certainty(
    keys: &[KeyCode],
    certainties: &[KeyCertainty],
    [start, end]: [usize; 2],
    words: Option<[usize; 2]>,
) -> StepCertainty {
    let of = |key_idx: usize| certainties.get(key_idx).map_or(&[][..], |certainty| &certainty.choices);
    let starts = of(start).iter().filter(|(choice, _)| !choice.is_arrival());
    let ends = of(end).iter().filter(|(choice, _)| choice.is_arrival());
    let mut out = StepCertainty { probability: 1.0, weakest: (Choice::Class(Field::Next).into(), 1.0), words };
    if keys.get(start).is_none_or(|key| key.class(Field::Next) != NEXT_SEGMENT) {
        out.probability = 0.0;
    }
    for (choice, probability) in starts.chain(ends) {
        out.probability *= probability;
        if *probability < out.weakest.1 {
            out.weakest = ((*choice).into(), *probability);
        }
    }
    out
}
