//! How long a move takes: as long as its motion on the screen asks for.
//!
//! Enters: the cameras of a segment. Leaves: its duration. The measure is the way `S` of the picture in widths of the
//! frame. An operator accelerates alike for short and long moves, and the time of such a move grows with the square root
//! of its way: `T = k sqrt(S)`. The constant `k` of a kind of move is chosen so that its usual extent takes the 4 to 6
//! seconds that one would choose; a pan by a frame width then takes about 6 seconds, close to the 7 below which pictures
//! judder at 24 frames per second (RED, "Camera panning speed").

use glam::{DVec2, DVec3};

use super::cost::{path_of, sampled};
use super::framing::{Target, frame_position};
use super::motion::MotionSegment;
use super::program::{Program, Speed, Step};
use super::world::World;
use cinesplat_trajectory::{CameraState, Move, ramp_secs};

/// Points of the picture whose way is measured: across and down the frame, as fractions of its size from the middle.
const ACROSS: [f64; 5] = [-0.4, -0.2, 0.0, 0.2, 0.4];
const DOWN: [f64; 3] = [-0.3, 0.0, 0.3];
/// Distance of the background over that of the subject.
const BACKGROUND: f64 = 2.0;
/// Distance of the subject over the scene size where nothing is named.
const FREE_DISTANCE: f64 = 0.3;
/// Samples of a segment, and further ones per keyframe.
const NUM_SAMPLES: usize = 9;

/// Seconds that a move takes for a way of the picture of one frame width. The middle of the picture moves little in a
/// travel toward the subject or a zoom, and least in a dolly zoom.
fn secs_per_root_width(movement: Move) -> f64 {
    match movement {
        Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown => 6.6,
        Move::RollCw | Move::RollCcw => 12.0,
        Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut => 10.7,
        Move::DollyZoomIn | Move::DollyZoomOut => 17.0,
        Move::CraneUp | Move::CraneDown => 10.5,
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => 7.6,
        Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown => 8.2,
        Move::WhipPan => 0.7,
        _ => 7.0,
    }
}

/// The same for a turn to a new aim between two moves.
const JOIN_SECS: f64 = 3.0;
/// Least and largest duration of a move at normal speed, of a whip pan, and of a turn between two moves.
const MOVE_RANGE_SECS: (f64, f64) = (2.0, 13.0);
const WHIP_RANGE_SECS: (f64, f64) = (0.6, 1.0);
const JOIN_RANGE_SECS: (f64, f64) = (0.9, 4.5);

/// Sets the duration of every segment whose duration nothing fixes.
pub(super) fn pace(world: &World, program: &Program, segments: &mut [MotionSegment]) {
    for segment in segments {
        let still = matches!(segment.movement, Move::Static | Move::Handheld | Move::RackFocus);
        let Some(step) = program.steps.get(segment.step) else { continue };
        let sways = !segment.is_join && step.with.contains(&Move::Handheld);
        if !(segment.secs_bind || still || sways) {
            segment.secs = natural_secs(world, step, segment);
        }
    }
}

/// The duration of a segment that the words leave open.
pub(super) fn natural_secs(world: &World, step: &Step, segment: &MotionSegment) -> f64 {
    let root = screen_travel(world, step, segment).sqrt();
    if segment.is_join {
        let secs = (JOIN_SECS * root).clamp(JOIN_RANGE_SECS.0, JOIN_RANGE_SECS.1);
        return secs + ramp_secs(secs);
    }
    let secs = secs_per_root_width(if goes_ahead(step, segment) { Move::PushIn } else { segment.movement }) * root;
    if segment.movement == Move::WhipPan {
        return secs.clamp(WHIP_RANGE_SECS.0, WHIP_RANGE_SECS.1);
    }
    secs.clamp(MOVE_RANGE_SECS.0, MOVE_RANGE_SECS.1) * factor(step.speed)
}

/// Whether a flight leads straight on and names nothing: the middle of its picture moves as little as that of a push.
fn goes_ahead(step: &Step, segment: &MotionSegment) -> bool {
    let names = !step.start.subjects.is_empty() || !step.end.subjects.is_empty() || step.via.is_some();
    matches!(segment.movement, Move::FlyThrough | Move::Follow) && !names && segment.states.len() == 2
}

/// Factor on a step's duration.
pub(super) fn factor(speed: Speed) -> f64 {
    match speed {
        Speed::Slow => 1.6,
        Speed::Normal => 1.0,
        Speed::Fast => 0.5,
    }
}

/// The way of the picture over a segment, in frame widths: the median over the frame, of the subject's distance or of the
/// background, whichever moves more.
fn screen_travel(world: &World, step: &Step, segment: &MotionSegment) -> f64 {
    let named = Target::of(world, &step.end).or_else(|| Target::of(world, &step.start));
    let aim = segment.pivot.or(named.map(|target| target.aim));
    let count = NUM_SAMPLES + 4 * segment.states.len();
    let states = sampled(&path_of(world, segment), segment, count);
    let free = FREE_DISTANCE * world.bounds.size();
    let depth = |state: &CameraState| {
        let seen = aim.and_then(|aim| frame_position(world, state, aim)).map(|(_, depth)| depth);
        seen.map_or(free, |depth| depth.clamp(0.2 * free, 4.0 * free))
    };
    states
        .windows(2)
        .map(|pair| flow(world, pair, depth(&pair[0])).max(flow(world, pair, BACKGROUND * depth(&pair[0]))))
        .sum()
}

/// Median way of the points of the first picture at a distance until the second one, in frame widths. Points that leave
/// the view count as infinitely far.
fn flow(world: &World, pair: &[CameraState], depth: f64) -> f64 {
    let half = (pair[0].fov_y_rad / 2.0).tan();
    let way = |at: DVec2| {
        let ray = DVec3::new(2.0 * at.x * half * world.aspect, -2.0 * at.y * half, 1.0);
        let point = pair[0].pose.position + pair[0].pose.rotation * (ray * depth);
        let moved = frame_position(world, &pair[1], point).map(|(to, _)| to - at);
        moved.map_or(f64::INFINITY, |by| DVec2::new(by.x, by.y / world.aspect).length())
    };
    let mut ways: Vec<f64> =
        ACROSS.iter().flat_map(|&x| DOWN.iter().map(move |&y| DVec2::new(x, y))).map(way).collect();
    ways.sort_by(f64::total_cmp);
    let median = ways[ways.len() / 2];
    if median.is_finite() { median } else { 1.0 }
}
