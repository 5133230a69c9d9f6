//! Detours around matter, and the clearance certificate of the finished film.
//!
//! Only segments whose shape the prompt leaves open (follow, fly through, back to the start) take a detour. Where a
//! move fixes the geometry, the search has already varied radius, height and length for clearance.

use super::clearance::{ClearanceIndex, ClearanceQuery, SIGMA_LEVEL, least_clearance, prove};
use super::cost::{cost, path_of};
use super::motion::MotionSegment;
use super::program::{Pass, Program};
use super::report::clause;
use super::route::{NoRoute, Route, route};
use super::world::{World, default_camera_radius};
use cinesplat_scene::{Bounds, Gaussians, SOLID_OPACITY};
use cinesplat_trajectory::{CameraPath, ClearanceFailure, ClearanceProof, Keyframe, Move, ReportLine};

/// Largest factor by which a detour may lengthen a segment's duration.
const MAX_SLOWDOWN: f64 = 2.5;
/// Clause of the report's line about the clearance certificate.
const CERTIFICATE: &str = "clear of matter";
/// Limit on the path intervals examined to decide whether a segment is blocked.
const MAX_INTERVALS: usize = 4000;

/// The outcome of rerouting a blocked segment.
pub(super) struct Detour {
    /// Index of the segment.
    segment: usize,
    /// Number of inner keyframes of the detour, or why there is none.
    found: Result<usize, NoRoute>,
}

/// Replaces blocked segments of free shape by a detour where that lowers their cost.
pub(super) fn reroute(world: &World, program: &Program, segments: &mut [MotionSegment]) -> Vec<Detour> {
    let mut detours = Vec::new();
    for (index, segment) in segments.iter_mut().enumerate() {
        let passes = program.steps.get(segment.step).is_some_and(|step| {
            let passes = step.via.as_ref().is_some_and(|via| via.how != Pass::From);
            passes || step.look.is_some()
        });
        if passes || !is_free(segment) || is_clear(world, segment) {
            continue;
        }
        match route(world, &segment.states[0], &segment.last()) {
            Ok(route) => {
                let around = along_route(segment, route);
                if cost(world, &around, None) < cost(world, segment, None) {
                    detours.push(Detour { segment: index, found: Ok(around.states.len() - 2) });
                    *segment = around;
                }
            }
            Err(why) => detours.push(Detour { segment: index, found: Err(why) }),
        }
    }
    detours
}

/// The segment along a route. Its duration grows with the length of the path, unless the prompt states it.
fn along_route(segment: &MotionSegment, route: Route) -> MotionSegment {
    let mut around = MotionSegment { states: route.states, ..segment.clone() };
    if !around.secs_bind {
        around.secs *= (length(&around) / length(segment)).clamp(1.0, MAX_SLOWDOWN);
    }
    around
}

/// Whether the move fixes only the ends of a segment.
fn is_free(segment: &MotionSegment) -> bool {
    segment.pivot.is_none() && matches!(segment.movement, Move::Follow | Move::FlyThrough) && length(segment) > 0.0
}

fn length(segment: &MotionSegment) -> f64 {
    segment.states.windows(2).map(|pair| pair[0].pose.position.distance(pair[1].pose.position)).sum()
}

pub(super) fn is_clear(world: &World, segment: &MotionSegment) -> bool {
    let radius = world.camera_radius;
    let query = ClearanceQuery { enough: radius, tolerance: 0.1 * radius, max_intervals: MAX_INTERVALS };
    least_clearance(world.ellipsoids(), &path_of(world, segment), &query).bound >= radius
}

/// Certifies the distance between a path and the matter of a scene, for a camera of the default radius.
pub fn prove_clear(gaussians: &Gaussians, path: &CameraPath) -> ClearanceProof {
    prove_clear_around(gaussians, path, 0.0)
}

/// As [`prove_clear`], for a camera that leaves the path by up to `reach`, scene units.
pub fn prove_clear_around(gaussians: &Gaussians, path: &CameraPath, reach: f64) -> ClearanceProof {
    let radius = default_camera_radius(&Bounds::of(gaussians));
    prove_around(&ClearanceIndex::new(gaussians), path, [radius, reach])
}

/// Certifies the clearance of a ball of this radius that leaves the path by up to `reach`.
fn prove_around(index: &ClearanceIndex, path: &CameraPath, [radius, reach]: [f64; 2]) -> ClearanceProof {
    if !(reach > 0.0) {
        return prove(index, path, radius);
    }
    // A ball about the path that holds the ball about the camera wherever it is.
    let proof = prove(index, path, radius + reach);
    let distance = |of_path: f64| (of_path - reach).max(0.0);
    let failure = proof.failure.map(|failure| ClearanceFailure { distance: distance(failure.distance), ..failure });
    ClearanceProof { camera_radius: radius, min_distance: distance(proof.min_distance), failure, ..proof }
}

/// Certifies the clearance of the path through a film's keyframes, for a camera that its effects move.
pub(super) fn proof(world: &World, keys: &[Keyframe]) -> ClearanceProof {
    prove_around(world.ellipsoids(), &CameraPath::fine(keys.to_vec(), world.frame), world.ball)
}

/// Report lines of the detours and of the certificate.
pub(super) fn clearance_lines(
    world: &World,
    (program, prompt): (&Program, &str),
    (segments, spans): (&[MotionSegment], &[[f64; 2]]),
    detours: &[Detour],
    proof: &ClearanceProof,
) -> Vec<ReportLine> {
    let words = |segment: &MotionSegment| {
        clause(prompt, program.steps.get(segment.step).and_then(|step| step.words), segment.movement)
    };
    let failed = proof.failure.map(|failure| segment_at((segments, spans), failure.from_secs).0);
    let around = |detour: &Detour| {
        let (segment, num_inner) = (segments.get(detour.segment)?, detour.found.ok()?);
        Some(ReportLine {
            clause: words(segment),
            wanted: "a path clear of matter".to_owned(),
            got: proof.min_distance.min(world.bounds.size()),
            met: failed != Some(detour.segment),
            note: format!("the direct path is blocked: the camera takes a detour through {num_inner} more keyframes"),
        })
    };
    let mut lines: Vec<ReportLine> = detours.iter().filter_map(around).collect();
    let note = proof.failure.map_or_else(String::new, |failure| {
        let (index, segment) = segment_at((segments, spans), failure.from_secs);
        let blocked = detours.iter().find(|detour| detour.segment == index).and_then(|detour| detour.found.err());
        let why = blocked.map_or_else(String::new, |why| format!("; no detour: {why}"));
        format!("{}, in \"{}\"{why}", found(&failure), words(segment))
    });
    lines.push(certificate_line(proof, world.bounds.size(), note));
    lines
}

/// Where and by how much a path is too near to matter.
fn found(failure: &ClearanceFailure) -> String {
    let ClearanceFailure { distance, from_secs, to_secs, .. } = failure;
    format!("{distance:.4} from matter between {from_secs:.2} and {to_secs:.2} s")
}

/// The report's line of a certificate.
fn certificate_line(proof: &ClearanceProof, scene_size: f64, note: String) -> ReportLine {
    ReportLine {
        clause: CERTIFICATE.to_owned(),
        wanted: format!(
            "at every moment at least {:.4} scene units from all Gaussians of opacity {SOLID_OPACITY} and more, out to \
             {SIGMA_LEVEL} standard deviations",
            proof.camera_radius
        ),
        got: proof.min_distance.min(scene_size),
        met: proof.is_clear(),
        note,
    }
}

/// Makes the report's line about clearance, if it has one, say what a certificate says: the path, or how far effects take
/// the camera from it, may have changed since the line was written. A line that still holds keeps its note.
pub fn restate_clearance(report: &mut [ReportLine], proof: &ClearanceProof, scene_size: f64) {
    let new = certificate_line(proof, scene_size, proof.failure.as_ref().map_or_else(String::new, found));
    let holds = |line: &ReportLine| line.met == new.met && (line.got - new.got).abs() <= 1e-9 * scene_size;
    for line in report.iter_mut().filter(|line| line.clause == CERTIFICATE && !holds(line)) {
        line.clone_from(&new);
    }
}

/// The segment that plays at a time, and its index.
fn segment_at<'a>((segments, spans): (&'a [MotionSegment], &[[f64; 2]]), secs: f64) -> (usize, &'a MotionSegment) {
    let index = spans.iter().position(|[_, end]| secs < *end).unwrap_or(segments.len() - 1);
    (index, &segments[index])
}
