//! What one network reads: the program of a linked prompt and the cameras of its keys, corrected by what the words say plainly.

use cinesplat_language::Linked;
use cinesplat_operator::{Program, StepCameras};
use cinesplat_trajectory::CameraState;
use glam::{DQuat, Vec3};

use crate::alternatives::without_denied_turns;
use crate::beats::direct_beats;
use crate::codes::{self, Field, KeyCode, NEXT_SEGMENT, PoseCode};
use crate::compositions::direct_composed;
use crate::decoding::{Choice, DecodedPrompt, KeyCertainty, WordRules, decode};
use crate::direction::{Direction, StepCertainty};
use crate::director::SceneContext;
use crate::error::DirectorError;
use crate::frame::SceneFrame;
use crate::inputs::{Grounding, Prompt, encode_text, object_input, other_objects};
use crate::keys::{boundaries_of, steps_of};
use crate::lost::add_lost_clauses;
use crate::model::Model;
use crate::said::{frame_parts, pan_from_first_to_last, take_said, take_said_of_all};
use crate::times::ListedTimes;
use crate::told::without_told;

impl Model {
    /// The program that words request, and one camera per key; `whole` are all words of the prompt, of which they may be a part.
    ///
    /// # Errors
    /// Those of [`Director::direct`](crate::Director::direct).
    pub(crate) fn direct(
        &self,
        linked: &Linked,
        whole: &Linked,
        scene: &SceneContext<'_>,
    ) -> Result<Direction, DirectorError> {
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
        let (tokens, grounding) = encode_text(linked, &senses, &others, &self.vocabulary)?;
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
        let decoded = decode((&self.network, &self.config), &prompt, &rules)?;
        let mut direction = direction(&decoded, &grounding, &frame)?;
        for certainty in &mut direction.certainty {
            certainty.probability = self.calibration.apply(certainty.probability);
        }
        take_said(linked, &senses, &mut direction)?;
        // What the scene lacks stays a group, so that callers can tell it.
        direction.program = direction.program.with_ids(&|ids| linked.expanded(ids));
        Ok(direction)
    }
}

/// Whether both directions have the same steps but for a way that one of them goes in the opposite direction: the one that is said
/// last counts.
fn goes_other_way(said: &Direction, meant: &Direction) -> bool {
    let (said, meant) = (&said.program.steps, &meant.program.steps);
    let mut pairs = said.iter().zip(meant);
    said.len() == meant.len() && pairs.any(|(said, meant)| said.movement.opposite() == Some(meant.movement))
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
    let mut out =
        StepCertainty { probability: 1.0, weakest: (Choice::Class(Field::Next).into(), 1.0), words, voices: None };
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
