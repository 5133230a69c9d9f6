//! Moves of the lens: zoom, dolly zoom.

use super::context::{StepContext, require_visible};
use super::dolly_length::{large_ratio, least_open_ratio};
use crate::composition::lens_fov_deg;
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Fill, Target, extent_frac, in_frame_frac};
use crate::motion::MotionSegment;
use crate::program::{Amount, Framing};
use crate::vertigo::swelling;
use crate::view::{aimed, fill_in, lerp, moved, with_fov};
use cinesplat_trajectory::{CameraState, Move, ShotSize};

/// Narrowest and widest vertical field of view that a move chooses, degrees.
const LENS_LIMITS_DEG: (f64, f64) = (9.0, 84.0);

/// Changes only the field of view.
pub(super) fn zoom(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let inward = (context.step.movement == Move::ZoomIn) != (context.step.either_way && context.parameters[5] < 0.5);
    let (fill, lens) = match (inward, ends_on_room(context)) {
        (true, _) => ((0.24, 0.5), (38.0, 58.0)),
        (false, false) => ((0.55, 1.0), (16.0, 30.0)),
        // A long lens puts the camera far away, from where a wide one shows the room.
        (false, true) => ((0.55, 1.0), (9.0, 16.0)),
    };
    let (mut segments, first) = match &context.before {
        Some(before) => context.turned_to(before, target.aim),
        None => (Vec::new(), context.view(&target, &context.opening_framing_for_zoom(inward), fill, lens)),
    };
    // What is beside the middle would wander outward, or inward, as the lens zooms.
    let is_placed = [&context.step.start, &context.step.end].iter().any(|framing| framing.place.is_some());
    let first = if is_placed || context.before.is_some() { first } else { aimed(context.world, &first, target.aim) };
    let ratio = zoom_ratio(context, &target, &first, inward);
    let tan = (first.fov_y_rad / 2.0).tan() * ratio;
    let limits = (LENS_LIMITS_DEG.0.to_radians(), LENS_LIMITS_DEG.1.to_radians());
    let last = with_fov(&first, (2.0 * tan.atan()).clamp(limits.0, limits.1));
    let mut segment = context.segment(vec![first, last]);
    let wanted = if inward { (0.0, 0.76) } else { (1.3, f64::INFINITY) };
    if context.step.amount.is_none() {
        segment = segment.requiring(Scope::All, ConstraintKind::LensRatio(wanted));
    }
    segment = segment.requiring(Scope::All, ConstraintKind::Centered(target.clone(), 0.2));
    let segment = context.constrained_in_pitch(segment);
    segments.push(require_visible(context.constrained_at_end(segment), &target, Scope::All));
    segments
}

impl StepContext<'_> {
    /// Framing of a zoom's opening view. A size stated for the end does not apply to the start.
    fn opening_framing_for_zoom(&self, inward: bool) -> Framing {
        let mut framing = self.opening_framing();
        if !inward && self.start.is_none() {
            framing.size = None;
            framing.height_frac = None;
            framing.whole = false;
        }
        framing
    }
}

/// Ratios of a zoom in whose size the words leave open, and the least of one that goes farther for a small thing.
const OPEN_RATIOS: (f64, f64) = (0.38, 0.56);
const NARROWEST_RATIO: f64 = 0.24;
/// Vertical field of view that shows a room, degrees.
const ROOM_LENS_DEG: (f64, f64) = (54.0, 70.0);

/// Whether the prompt ends on the room as a whole: a wide size without subjects.
fn ends_on_room(context: &StepContext) -> bool {
    let end = &context.step.end;
    end.subjects.is_empty() && matches!(end.size, Some(ShotSize::Long | ShotSize::ExtremeLong))
}

/// The ratio of a zoom in without a stated size: a small thing in a room is large in the picture at the end.
fn inward_ratio(context: &StepContext, target: &Target, first: &CameraState) -> f64 {
    let open = lerp(OPEN_RATIOS, context.parameters[6]);
    if target.ids.is_empty() {
        return open;
    }
    let large = || large_ratio(context, target, first).max(NARROWEST_RATIO);
    let ratio = if context.world.is_indoor() { open.min(large()) } else { open };
    ratio.max(least_open_ratio(context, target, first))
}

/// Tangent of half the field of view at the end, over that at the start.
fn zoom_ratio(context: &StepContext, target: &Target, first: &CameraState, inward: bool) -> f64 {
    let open = if inward { inward_ratio(context, target, first) } else { lerp((1.7, 2.4), context.parameters[6]) };
    let height = extent_frac(context.world, first, target.sized_by()).y;
    let by_size = fill_in(context.world, &context.step.end, context.parameters[7]).map(|fill| match fill {
        Fill::Height(wanted) | Fill::Fit(wanted) => height / wanted,
    });
    let by_lens = context.step.end.lens.map(|lens| {
        let fov_rad = lerp(lens_fov_deg(lens), context.parameters[7]).to_radians();
        (fov_rad / 2.0).tan() / (first.fov_y_rad / 2.0).tan()
    });
    let zooms = |ratio: &f64| if inward { *ratio < 0.9 } else { *ratio > 1.1 };
    let by_size = by_lens.filter(zooms).or(by_size.filter(zooms));
    let to_room = (!inward && ends_on_room(context))
        .then(|| (lerp(ROOM_LENS_DEG, context.parameters[6]).to_radians() / 2.0).tan() / (first.fov_y_rad / 2.0).tan());
    let by_size = to_room.filter(zooms).or(by_size);
    let whole = || {
        let end = context.end.as_ref().filter(|_| context.step.end.whole && !inward)?;
        let ratios = (0..30).map(|i| 1.3 * 1.06_f64.powi(i));
        let wider = |ratio: f64| with_fov(first, 2.0 * ((first.fov_y_rad / 2.0).tan() * ratio).atan());
        ratios.into_iter().find(|&ratio| in_frame_frac(context.world, &wider(ratio), &end.corners, 0.03) >= 1.0)
    };
    match context.step.amount {
        // A stated factor is on the focal length, the reciprocal of the tangent.
        Some(Amount::Factor(factor)) if factor > 0.0 => (1.0 / factor).clamp(0.05, 20.0),
        Some(Amount::Slight) => {
            if inward {
                0.8
            } else {
                1.25
            }
        }
        Some(Amount::Large) => {
            if inward {
                0.3
            } else {
                3.0
            }
        }
        _ => by_size.or_else(whole).unwrap_or(open),
    }
}

/// Travels along the line to the subject while the lens keeps the subject's height in the frame: d tan(fov / 2) is
/// constant.
pub(super) fn dolly_zoom(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let inward =
        (context.step.movement == Move::DollyZoomIn) != (context.step.either_way && context.parameters[5] < 0.5);
    let lens = if inward { (20.0, 34.0) } else { (40.0, 62.0) };
    let (mut segments, first) = match &context.before {
        Some(before) => context.turned_to(before, target.aim),
        None => (Vec::new(), context.view(&target, &context.opening_framing(), (0.38, 0.76), lens)),
    };
    let distance = first.pose.position.distance(target.aim);
    let tan = (first.fov_y_rad / 2.0).tan();
    // A lone thing swells from close by, which a room behind it does not need.
    let (nearer, farther) =
        if context.world.is_indoor() { ((0.32, 0.56), (1.8, 3.0)) } else { ((0.46, 0.66), (1.5, 2.3)) };
    let open = lerp(if inward { nearer } else { farther }, context.parameters[6]);
    // The limits of the lens shorten the travel, not the subject.
    let limit_tan = |deg: f64| (deg.to_radians() / 2.0).tan();
    let ratio = open.clamp(tan / limit_tan(LENS_LIMITS_DEG.1), tan / limit_tan(LENS_LIMITS_DEG.0));
    let ratio = if context.world.is_indoor() { kept_in_shape(&target, &first, ratio) } else { ratio };
    let last = moved(&first, first.pose.forward() * distance * (1.0 - ratio));
    let last = with_fov(&last, 2.0 * (tan / ratio).atan());
    let last = with_fov(&last, 2.0 * ((last.fov_y_rad / 2.0).tan() * grown(context, &target, [&first, &last])).atan());
    let segment = context.segment(vec![first, last]);
    let mut segment = segment.requiring(Scope::All, ConstraintKind::Centered(target.clone(), 0.22));
    let wanted = if inward { (0.0, 0.77) } else { (1.3, f64::INFINITY) };
    segment = segment.requiring(Scope::All, ConstraintKind::DistanceRatio(target.aim, wanted));
    // Where the prompt leaves the direction open, the keyframes record the one that was taken.
    segment.movement = if inward { Move::DollyZoomIn } else { Move::DollyZoomOut };
    segments.push(require_visible(segment, &target, Scope::All));
    segments
}

/// Factor on a subject's height in the frame from one camera to another, by the points on it: that of its middle stays where the
/// distance and the lens make up for each other, but what is seen of it from nearby is its near side. 1 where it is unknown.
fn grown(context: &StepContext, target: &Target, states: [&CameraState; 2]) -> f64 {
    let points = match target.ids[..] {
        [id] => context.world.subject(id).map(|subject| &subject.points[..]),
        _ => None,
    };
    let points = points.unwrap_or(target.sized_by());
    let [from, to] = states.map(|state| extent_frac(context.world, state, points).y);
    let factor = to / from;
    if factor.is_finite() && factor > 0.0 { factor.clamp(1.0 / MOST_SWELLING, MOST_SWELLING) } else { 1.0 }
}

/// Most by which the near side of a subject grows over its middle while the lens keeps the size of that.
const MOST_SWELLING: f64 = 1.22;
/// Least change of the distance of a dolly zoom.
const LEAST_CHANGE: f64 = 0.7;

/// The ratio of the distances of a dolly zoom, nearer to 1 where the nearer camera would be so close that the near side of
/// the subject swells: a skull with its chin out of the frame has not kept its size.
fn kept_in_shape(target: &Target, first: &CameraState, ratio: f64) -> f64 {
    let distance = first.pose.position.distance(target.aim);
    let toward = -first.pose.forward();
    let reach = target.corners.iter().map(|corner| (*corner - target.aim).dot(toward)).fold(0.0, f64::max);
    let least = reach / (1.0 - 1.0 / (MOST_SWELLING * swelling(distance, reach)));
    let is_near = ratio < 1.0 && distance * ratio < least;
    if is_near { (least / distance).min(LEAST_CHANGE).max(ratio) } else { ratio }
}
