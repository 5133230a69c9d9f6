//! A program becomes keyframes: search, detours, timing, clearance certificate, report.

use std::collections::BTreeSet;

use super::as_filmed::as_filmed;
use super::detours;
use super::dutch;
use super::ends::bettered;
use super::film_limits::{self, has_speeds, haste, within_speeds};
use super::flow::{Flow, Joint, is_left_out, joints, tightened, without_stops};
use super::forbidden;
use super::framing::extent_frac;
use super::handles::{MAX_FREE_FILM_SECS, handles, settle};
use super::inward::turned_inward;
use super::motion::{MotionSegment, StepLabels, keyframes};
use super::pacing::pace;
use super::pictures::worst_void;
use super::program::{Amount, Framing, Program, Step};
use super::report;
use super::safer::{indoor_programs, safer_programs};
use super::search::{Candidate, SearchProblem, best_candidates};
use super::settings::{SolveLevel, SolveSettings};
use super::sighting::{Sighting, sightings};
use super::suggestion::StepCameras;
use super::world::World;
use cinesplat_trajectory::{CameraPath, CameraState, ClearanceProof, Keyframe, Move, ReportLine, retime};

/// Tries, and films, of the search for one that gives words up, over those of the first search.
const SAFER_TRIES: f64 = 0.5;
const SAFER_FINALISTS: usize = 2;
/// Largest size of a thing in the frame, over the frame's, while a camera circles it.
const SQUEEZED: f64 = 1.1;
/// Distance from matter, over the camera's radius, below which a film goes through it; and the share of a segment in the
/// captured region below which it leaves the room, and not only the estimate of where that ends.
const SAFE_RADII: f64 = 0.25;
const SAFE_CAPTURED_FRAC: f64 = 0.7;
/// The same share below which a camera that goes through matter goes through a wall, and one that does not is outside.
const THROUGH_WALL_FRAC: f64 = 0.5;
const OUTSIDE_FRAC: f64 = 0.25;
/// How often a film that is faster than its program allows is slowed down.
const MOST_SLOWED: usize = 4;
/// Shortest time into which a stated total duration compresses the segments of free length.
const MIN_FREE_SECS: f64 = 0.3;

/// A solved shot.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Keyframes in order of time, the first at 0.
    pub keyframes: Vec<Keyframe>,
    /// Length of the film.
    pub duration_secs: f64,
    /// Requested and measured values, one line per constraint.
    pub report: Vec<ReportLine>,
    /// Index of the keyframe at which each step of the program begins, followed by the index of the last keyframe.
    pub step_keys: Vec<usize>,
    /// When the film should show which object.
    pub sightings: Vec<Sighting>,
    /// Certified clearance of the whole path.
    pub clearance: ClearanceProof,
    /// The cost that the search minimized. Below 3, every constraint was met during the search.
    pub cost: f64,
    /// Whether the camera stays in the room and clear of matter at every moment, and does not squeeze in between a thing and
    /// a wall to get around it.
    pub is_safe: bool,
    /// Whether the camera goes through a wall of the room, or stays outside.
    pub leaves_room: bool,
}

/// Solves a program: keyframes whose path carries out every step.
///
/// `prompt` is the sentence that the report quotes. `suggestions` holds the director's cameras, one entry per step; it
/// may be shorter than the program. An empty program gives a static view of the scene.
pub fn realize(
    world: &World,
    program: &Program,
    prompt: &str,
    suggestions: &[StepCameras],
    settings: &SolveSettings,
) -> Solution {
    let mut best = finalists(world, (program, prompt), suggestions, settings, 1);
    best.swap_remove(0)
}

/// Solves a program up to `num` times: films that clearly differ in side, height, distance, lens or path, the one of
/// [`realize()`] first and the others in order of cost. At least one; only one where the level is [`SolveLevel::Off`]. Inputs are those of [`realize()`].
///
/// A film that violates more requirements than the best one is left out.
pub fn finalists(
    world: &World,
    (program, prompt): (&Program, &str),
    suggestions: &[StepCameras],
    settings: &SolveSettings,
    num: usize,
) -> Vec<Solution> {
    let fallback;
    let program = if program.steps.is_empty() {
        fallback = Program { steps: vec![Step::of(Move::Static)], ..program.clone() };
        &fallback
    } else {
        program
    };
    let solved = |program: &Program, settings: &SolveSettings, num: usize| -> Vec<Solution> {
        let program = &as_filmed(world, program);
        let candidates = best_candidates(&SearchProblem { world, program, suggestions }, settings, num);
        candidates.into_iter().map(|candidate| solution(world, (program, prompt), candidate, settings)).collect()
    };
    let asked = solved(program, settings, num);
    if settings.level == SolveLevel::Off || asked.iter().all(|solution| solution.is_safe) {
        return asked;
    }
    let sooner = SolveSettings { tries_factor: SAFER_TRIES * settings.tries_factor, ..*settings };
    let solved = |safer: &Program| solved(safer, &sooner, num.min(SAFER_FINALISTS));
    let mut solutions = safe_solutions(program, prompt, asked, &solved);
    if solutions.iter().any(|solution| !solution.leaves_room) {
        solutions.retain(|solution| !solution.leaves_room);
        return solutions;
    }
    if settings.level != SolveLevel::Full {
        return solutions;
    }
    // Nobody keeps a film of the outside of a room's walls.
    safest(indoor_programs(program, prompt), &solved).unwrap_or(solutions)
}

/// Solutions that stay in the room and clear of matter: those of the program, or else of one that gives up the words that
/// lead through a wall, one after the other. The solutions of the program itself where none is safe.
fn safe_solutions(
    program: &Program,
    prompt: &str,
    mut asked: Vec<Solution>,
    solved: &dyn Fn(&Program) -> Vec<Solution>,
) -> Vec<Solution> {
    if asked.iter().any(|solution| solution.is_safe) {
        // A film that leaves the room is no alternative.
        asked.retain(|solution| solution.is_safe);
        return asked;
    }
    safest(safer_programs(program, prompt), solved).unwrap_or(asked)
}

/// The safe solutions of the first program that has some, with the lines of what it gives up.
fn safest(
    programs: Vec<(Program, Vec<ReportLine>)>,
    solved: &dyn Fn(&Program) -> Vec<Solution>,
) -> Option<Vec<Solution>> {
    programs.into_iter().find_map(|(program, given_up)| {
        let mut others = solved(&program);
        others.retain(|solution| solution.is_safe);
        others.iter_mut().for_each(|solution| solution.report.extend(given_up.iter().cloned()));
        (!others.is_empty()).then_some(others)
    })
}

/// The finished film of a candidate: detours, times, keyframes, certificate and report.
fn solution(
    world: &World,
    (program, prompt): (&Program, &str),
    candidate: Candidate,
    settings: &SolveSettings,
) -> Solution {
    let cost = candidate.cost();
    let mut segments: Vec<MotionSegment> = candidate.segments.into_iter().flatten().collect();
    if settings.level != SolveLevel::Off {
        segments = bettered(world, program, segments);
        segments = turned_inward(world, program, segments);
    }
    settle(&mut segments);
    if let Some(slant) = settings.slant {
        segments = dutch::slanted(segments, slant);
    }
    // A detour is searched: without a search the report names the matter in the way.
    let detours = match settings.level {
        SolveLevel::Off => Vec::new(),
        SolveLevel::Fast | SolveLevel::Full => detours::reroute(world, program, &mut segments),
    };
    pace(world, program, &mut segments);
    within_speeds(world, program, &mut segments);
    let joints = joints(program, prompt, &segments);
    without_stops(&mut segments, &joints);
    let handles = handles(program, &segments);
    let wanted_secs = program.duration_secs.or_else(|| too_long(program, &segments, handles));
    let (flow, segments, keys, clearance) = filmed(world, program, (segments, wanted_secs), (joints, handles));
    let path = CameraPath::fine(keys.clone(), world.frame);
    let (mut report, captured) =
        report::report(world, (program, prompt), (&segments, &flow.spans), &path, settings.level);
    let least = SAFE_RADII * clearance.camera_radius;
    let is_clear = clearance.failure.is_none_or(|failure| failure.distance >= least);
    let stays = captured >= SAFE_CAPTURED_FRAC || !world.is_indoor();
    let leaves = captured < if is_clear { OUTSIDE_FRAC } else { THROUGH_WALL_FRAC };
    // Who asks for a turn all the way round asks for what lies behind the camera too.
    let is_lost = world.is_indoor() && !turns_round(program) && most_void(world, &path, flow.secs()) > LOST_VOID;
    let leaves_room = world.is_indoor() && leaves || is_lost;
    let squeezes = || segments.iter().any(|segment| squeezes(world, program, segment));
    let is_safe = is_clear && stays && !is_lost && !squeezes();
    report.extend(detours::clearance_lines(world, (program, prompt), (&segments, &flow.spans), &detours, &clearance));
    report.extend(forbidden::lines(world, program, &segments, &keys));
    report.extend(film_limits::lines(world, program, &keys));
    report.extend(settings.slant.map(|slant| dutch::report_line(world, &segments, slant)));
    let step_keys = step_keys(&flow.segments, program.steps.len());
    let sightings = sightings(&segments, &flow.spans, flow.secs());
    Solution {
        sightings,
        keyframes: keys,
        duration_secs: flow.secs(),
        report,
        step_keys,
        cost,
        clearance,
        is_safe,
        leaves_room,
    }
}

/// Void of a picture of a room from which on a film shows nothing, and the pictures of a film that are looked at.
const LOST_VOID: f64 = 0.85;
const NUM_PICTURES: u32 = 9;

/// Least angle of a turn on the spot that looks all the way round, degrees.
const ROUND_DEG: f64 = 150.0;

/// Whether the words ask for a turn on the spot that looks all the way round.
fn turns_round(program: &Program) -> bool {
    program.steps.iter().any(|step| {
        let is_far = matches!(step.amount, Some(Amount::Degrees(degrees)) if degrees >= ROUND_DEG);
        matches!(step.movement, Move::PanLeft | Move::PanRight) && is_far
    })
}

/// Void of the emptiest picture of a film.
fn most_void(world: &World, path: &CameraPath, secs: f64) -> f64 {
    let at = |i: u32| path.sample(secs * f64::from(i) / f64::from(NUM_PICTURES - 1));
    worst_void(world, (0..NUM_PICTURES).map(at))
}

/// Whether a camera circles a thing, whose size and how far around the words leave open, so closely that the thing does not
/// fit the picture.
fn squeezes(world: &World, program: &Program, segment: &MotionSegment) -> bool {
    let circles = segment.movement.is_circular() && !segment.is_join;
    let is_free = |step: &&Step| !matches!(step.amount, Some(Amount::Degrees(_)));
    let Some(step) = program.steps.get(segment.step).filter(|_| circles).filter(is_free) else { return false };
    let ends = [&step.end, &step.start];
    let is_sized =
        |framing: &&Framing| framing.size.is_some() || framing.height_frac.is_some() || framing.distance.is_some();
    let subject = ends.iter().find_map(|framing| world.subject(*framing.subjects.first()?));
    let Some(subject) = subject.filter(|_| !ends.iter().any(is_sized)) else { return false };
    let size = |state: &CameraState| extent_frac(world, state, &subject.corners).max_element();
    segment.states.iter().map(size).fold(0.0, f64::max) > SQUEEZED
}

/// The film of the segments in the wanted time, the segments as long as they are in it, its keyframes, and their
/// clearance certificate. A blend that comes too near to matter is shortened, and left out where that does not help.
fn filmed(
    world: &World,
    program: &Program,
    (mut natural, wanted_secs): (Vec<MotionSegment>, Option<f64>),
    (mut joints, handles): (Vec<Joint>, [f64; 2]),
) -> (Flow, Vec<MotionSegment>, Vec<Keyframe>, ClearanceProof) {
    let labels: Vec<StepLabels> = (0..program.steps.len()).map(|i| labels(program, i)).collect();
    let mut num_slowed = 0;
    loop {
        let mut segments = natural.clone();
        fit_duration(&mut segments, &joints, wanted_secs);
        let mut flow = Flow::new(world, &segments, &joints);
        flow.add_handles(handles);
        let mut keys = keyframes(&flow.segments, &labels);
        retime(&mut keys, Some(world.frame));
        // Blends are faster than what they join. What is too fast because of a stated length stays so.
        let is_free = wanted_secs.is_none() && natural.iter().all(|segment| !segment.secs_bind);
        let haste = if is_free { haste(world, program, &keys) } else { 1.0 };
        if haste > 1.0 && num_slowed < MOST_SLOWED {
            natural.iter_mut().for_each(|segment| segment.secs *= haste);
            num_slowed += 1;
            continue;
        }
        let proof = detours::proof(world, &keys);
        match proof.failure.and_then(|failure| flow.blend_in(failure.from_secs, failure.to_secs)) {
            Some(blocked) => joints = tightened(&joints, blocked),
            None => return (flow, segments, keys, proof),
        }
    }
}

/// The longest film without a stated length, where the segments would take longer: what is left of it for them.
fn too_long(program: &Program, segments: &[MotionSegment], handles: [f64; 2]) -> Option<f64> {
    let secs: f64 = segments.iter().map(|segment| segment.secs).sum();
    let room = MAX_FREE_FILM_SECS - handles.iter().sum::<f64>();
    let free = segments.iter().all(|segment| !segment.secs_bind) && !has_speeds(program);
    (free && secs > room).then_some(room)
}

/// Largest share of a step of stated length that the turn to its picture may take.
const MOST_TURN_FRAC: f64 = 0.4;

/// Scales the segments of free length so that the film lasts as long as the prompt says. Where the lengths of the steps
/// leave no time for the turns to their pictures (`0-2 s hold on the mug, 2-5 s the jar`), the turns are part of the
/// steps. Segments of stated length are scaled too where the free ones cannot absorb the difference.
fn fit_duration(segments: &mut [MotionSegment], joints: &[Joint], wanted_secs: Option<f64>) {
    let Some(wanted) = wanted_secs.filter(|&secs| secs > 0.0) else { return };
    // What blends leave out takes no time. Shorter segments may leave no room for a blend, so that it counts after all.
    let natural = segments.to_vec();
    let mut filmed: BTreeSet<usize> = (0..natural.len()).filter(|i| !is_left_out(&natural, joints, *i)).collect();
    loop {
        segments.clone_from_slice(&natural);
        scale(segments, &filmed.iter().copied().collect::<Vec<_>>(), wanted);
        let num_filmed = filmed.len();
        filmed.extend((0..segments.len()).filter(|index| !is_left_out(segments, joints, *index)));
        if filmed.len() == num_filmed {
            return;
        }
    }
}

/// Scales the segments that are `filmed` to a length.
fn scale(segments: &mut [MotionSegment], filmed: &[usize], wanted: f64) {
    let sum = |segments: &[MotionSegment], bound: bool| -> f64 {
        filmed.iter().filter(|&&i| segments[i].secs_bind == bound).map(|&i| segments[i].secs).sum()
    };
    if wanted - sum(segments, true) < MIN_FREE_SECS {
        turn_within_steps(segments, filmed);
    }
    let (bound, free) = (sum(segments, true), sum(segments, false));
    let factor = (wanted - bound) / free;
    let all = free <= 0.0 || factor * free < MIN_FREE_SECS;
    let factor = if all { wanted / (bound + free) } else { factor };
    for &index in filmed {
        if all || !segments[index].secs_bind {
            segments[index].secs *= factor;
        }
    }
}

/// Takes the time of turns between two steps from the steps that they lead to, where those have a stated length.
fn turn_within_steps(segments: &mut [MotionSegment], filmed: &[usize]) {
    for pair in filmed.windows(2) {
        let [turn, step] = [pair[0], pair[1]];
        let leads = segments[turn].is_join && !segments[turn].secs_bind && segments[step].secs_bind;
        if leads && segments[turn].step == segments[step].step {
            let secs = segments[turn].secs.min(MOST_TURN_FRAC * segments[step].secs);
            segments[turn].secs = secs;
            segments[step].secs -= secs;
        }
    }
}

/// The labels of a step's keyframes. An empty framing takes the subjects of the step's other end, or else those of the
/// nearest earlier step that names some.
fn labels(program: &Program, index: usize) -> StepLabels {
    let step = &program.steps[index];
    let earlier = || {
        let named =
            |s: &Step| [&s.end, &s.start].into_iter().find(|f| !f.subjects.is_empty()).map(|f| f.subjects.clone());
        program.steps[..index].iter().rev().find_map(named).unwrap_or_default()
    };
    let filled = |framing: &Framing, other: &Framing| match (framing.subjects.is_empty(), other.subjects.is_empty()) {
        (false, _) => framing.subjects.clone(),
        (true, false) => other.subjects.clone(),
        (true, true) => earlier(),
    };
    StepLabels {
        start_subjects: filled(&step.start, &step.end),
        end_subjects: filled(&step.end, &step.start),
        start_size: step.start.size,
        end_size: step.end.size,
        start_angle: step.start.angle,
        end_angle: step.end.angle,
        words: step.words,
    }
}

/// Index of the keyframe at which each step begins, its join included, followed by the index of the last keyframe.
fn step_keys(segments: &[MotionSegment], num_steps: usize) -> Vec<usize> {
    let mut out = vec![0; num_steps + 1];
    let mut key = 0;
    let mut seen = None;
    for (i, segment) in segments.iter().enumerate() {
        if segment.cut && i > 0 {
            key += 1;
        }
        if seen != Some(segment.step) {
            out[segment.step] = key;
            seen = Some(segment.step);
        }
        key += segment.states.len() - 1;
    }
    out[num_steps] = key;
    out
}
