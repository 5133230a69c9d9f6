//! The last look at a solved film: free ways that are blocked lead around, and what is left is proved and reported.
//!
//! Only ways whose shape the words leave open (follow, fly through, back to the start) are led around. Where a move's
//! geometry is bound, the search has already given its radius, height and length for clearance as far as it could.

use super::clearance::{Search, least_clearance, prove};
use super::draft::Part;
use super::judge::{cost, path_of};
use super::report::clause;
use super::route::{NoRoute, Route, route};
use super::world::World;
use super::{Program, SIGMA_LEVEL};
use cinesplat_scene::SOLID_OPACITY;
use cinesplat_trajectory::{CameraPath, ClearanceProof, Keyframe, Move, ReportLine};

/// How much longer a part may take for going around, over what it took.
const LONGEST_DETOUR: f64 = 2.5;
/// Parts of a path looked at to see whether it is blocked.
const MAX_PARTS: usize = 4000;

/// A blocked part of a film and what became of it.
pub(super) struct Detour {
    /// Index of the part.
    part: usize,
    /// Inner keys of the way around, or why there is none.
    found: Result<usize, NoRoute>,
}

/// Leads free parts that are blocked around what blocks them, where that makes the film better.
pub(super) fn lead_around(world: &World, program: &Program, parts: &mut [Part]) -> Vec<Detour> {
    let mut detours = Vec::new();
    for (index, part) in parts.iter_mut().enumerate() {
        let passes = program.steps.get(part.step).is_some_and(|step| step.via.is_some());
        if passes || !is_free(part) || is_clear(world, part) {
            continue;
        }
        match route(world, &part.states[0], &part.last()) {
            Ok(route) => {
                let around = led_along(part, route);
                if cost(world, &around, None) < cost(world, part, None) {
                    detours.push(Detour { part: index, found: Ok(around.states.len() - 2) });
                    *part = around;
                }
            }
            Err(why) => detours.push(Detour { part: index, found: Err(why) }),
        }
    }
    detours
}

/// A part that goes along a route, longer in time by its longer way.
fn led_along(part: &Part, route: Route) -> Part {
    let mut around = Part { states: route.states, ..part.clone() };
    if !around.secs_bind {
        around.secs *= (length(&around) / length(part)).clamp(1.0, LONGEST_DETOUR);
    }
    around
}

/// Whether only the ends of a part are bound.
fn is_free(part: &Part) -> bool {
    part.pivot.is_none() && matches!(part.movement, Move::Follow | Move::FlyThrough) && length(part) > 0.0
}

fn length(part: &Part) -> f64 {
    part.states.windows(2).map(|pair| pair[0].pose.position.distance(pair[1].pose.position)).sum()
}

fn is_clear(world: &World, part: &Part) -> bool {
    let radius = world.camera_radius;
    let search = Search { enough: radius, tolerance: 0.1 * radius, max_parts: MAX_PARTS };
    least_clearance(world.ellipsoids(), &path_of(world, part), &search).bound >= radius
}

/// What can be proved about the path through a film's keys.
pub(super) fn proof(world: &World, keys: &[Keyframe]) -> ClearanceProof {
    prove(world.ellipsoids(), &CameraPath::fine(keys.to_vec(), world.frame), world.camera_radius)
}

/// Report of the detours and of the proof.
pub(super) fn clearance_lines(
    world: &World,
    (program, prompt): (&Program, &str),
    parts: &[Part],
    detours: &[Detour],
    proof: &ClearanceProof,
) -> Vec<ReportLine> {
    let words = |part: &Part| clause(prompt, program.steps.get(part.step).and_then(|step| step.words), part);
    let around = |detour: &Detour| {
        let (part, num_inner) = (parts.get(detour.part)?, detour.found.ok()?);
        Some(ReportLine {
            clause: words(part),
            wanted: "a way clear of matter".to_owned(),
            got: proof.min_distance.min(world.bounds.size()),
            met: true,
            note: format!("the direct way is blocked: the camera goes around, through {num_inner} more keys"),
        })
    };
    let mut lines: Vec<ReportLine> = detours.iter().filter_map(around).collect();
    let note = proof.failure.map_or_else(String::new, |failure| {
        let (index, part) = part_at(parts, failure.from_secs);
        let blocked = detours.iter().find(|detour| detour.part == index).and_then(|detour| detour.found.err());
        let why = blocked.map_or_else(String::new, |why| format!("; no way around: {why}"));
        format!(
            "{:.4} from matter between {:.2} and {:.2} s, in \"{}\": clearance gave way{why}",
            failure.distance,
            failure.from_secs,
            failure.to_secs,
            words(part)
        )
    });
    lines.push(ReportLine {
        clause: "clear of matter".to_owned(),
        wanted: format!(
            "at every moment at least {:.4} scene units from all Gaussians of opacity {SOLID_OPACITY} and more, out to \
             {SIGMA_LEVEL} standard deviations",
            proof.camera_radius
        ),
        got: proof.min_distance.min(world.bounds.size()),
        met: proof.is_clear(),
        note,
    });
    lines
}

/// The part of a film that is on at a time, and its index.
fn part_at(parts: &[Part], secs: f64) -> (usize, &Part) {
    let mut end = 0.0;
    for (index, part) in parts.iter().enumerate() {
        end += part.secs;
        if secs < end {
            return (index, part);
        }
    }
    (parts.len() - 1, &parts[parts.len() - 1])
}
