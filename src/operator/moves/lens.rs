//! Moves of the lens: zoom, dolly zoom, rack focus.

use super::Scenario;
use crate::Amount;
use crate::draft::{GoalKind, Part, When};
use crate::framing::{Fill, Target, extent_frac, in_frame_frac};
use crate::view::{lerp, moved, size_fill, with_fov};
use cinesplat_trajectory::{CameraState, Move};

/// Narrowest and widest vertical field of view that a move goes to by itself, degrees.
const LENS_LIMITS_DEG: (f64, f64) = (9.0, 84.0);

/// Changes the field of view alone.
pub(super) fn zoom(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let inward = (scenario.step.movement == Move::ZoomIn) != (scenario.step.either_way && scenario.genes[5] < 0.5);
    let (fill, lens) = if inward { ((0.2, 0.5), (38.0, 58.0)) } else { ((0.55, 1.0), (16.0, 30.0)) };
    let (mut parts, first) = match &scenario.before {
        Some(before) => scenario.turned_to(before, target.aim),
        None => (Vec::new(), scenario.view(&target, &scenario.opening_framing_for_zoom(inward), fill, lens)),
    };
    let ratio = zoom_ratio(scenario, &target, &first, inward);
    let tan = (first.fov_y_rad / 2.0).tan() * ratio;
    let limits = (LENS_LIMITS_DEG.0.to_radians(), LENS_LIMITS_DEG.1.to_radians());
    let last = with_fov(&first, (2.0 * tan.atan()).clamp(limits.0, limits.1));
    let mut part = scenario.part(vec![first, last], (ratio.ln().abs() * 4.5).clamp(2.0, 6.0));
    let wanted = if inward { (0.0, 0.76) } else { (1.3, f64::INFINITY) };
    if scenario.step.amount.is_none() {
        part = part.keeping(When::All, GoalKind::LensRatio(wanted));
    }
    part = part.keeping(When::All, GoalKind::Centered(target.clone(), 0.2));
    parts.push(super::seen(scenario.ending(part), &target, When::All));
    parts
}

impl Scenario<'_> {
    /// How a zoom's first view is framed: an end size belongs to the end.
    fn opening_framing_for_zoom(&self, inward: bool) -> crate::Framing {
        let mut framing = self.opening_framing();
        if !inward && self.start.is_none() {
            framing.size = None;
            framing.whole = false;
        }
        framing
    }
}

/// Tangent of half the field of view at the end over that at the start.
fn zoom_ratio(scenario: &Scenario, target: &Target, first: &CameraState, inward: bool) -> f64 {
    let open = if inward { lerp((0.42, 0.64), scenario.genes[6]) } else { lerp((1.5, 2.2), scenario.genes[6]) };
    let height = extent_frac(first, &target.corners).y;
    let by_size = scenario.step.end.size.map(|size| match size_fill(size, scenario.genes[7]) {
        Fill::Height(wanted) | Fill::Fit(wanted) => height / wanted,
    });
    let by_size = by_size.filter(|&ratio| if inward { ratio < 0.9 } else { ratio > 1.1 });
    let whole = || {
        let end = scenario.end.as_ref().filter(|_| scenario.step.end.whole && !inward)?;
        let ratios = (0..30).map(|i| 1.3 * 1.06_f64.powi(i));
        let wider = |ratio: f64| with_fov(first, 2.0 * ((first.fov_y_rad / 2.0).tan() * ratio).atan());
        ratios.into_iter().find(|&ratio| in_frame_frac(&wider(ratio), &end.corners, 0.03) >= 1.0)
    };
    match scenario.step.amount {
        // A factor is on the focal length, the reciprocal of the tangent.
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

/// Travels along the line to the subject while the lens keeps its height in the frame: d tan(fov / 2) is constant.
pub(super) fn dolly_zoom(scenario: &Scenario) -> Vec<Part> {
    let target = scenario.main();
    let inward = (scenario.step.movement == Move::DollyZoomIn) != (scenario.step.either_way && scenario.genes[5] < 0.5);
    let lens = if inward { (20.0, 34.0) } else { (40.0, 62.0) };
    let (mut parts, first) = match &scenario.before {
        Some(before) => scenario.turned_to(before, target.aim),
        None => (Vec::new(), scenario.view(&target, &scenario.opening_framing(), (0.38, 0.7), lens)),
    };
    let distance = first.pose.position.distance(target.aim);
    let tan = (first.fov_y_rad / 2.0).tan();
    let open = if inward { lerp((0.46, 0.66), scenario.genes[6]) } else { lerp((1.5, 2.3), scenario.genes[6]) };
    // The lens has limits; the way gives in before the size does.
    let limit_tan = |deg: f64| (deg.to_radians() / 2.0).tan();
    let ratio = open.clamp(tan / limit_tan(LENS_LIMITS_DEG.1), tan / limit_tan(LENS_LIMITS_DEG.0));
    let last = moved(&first, first.pose.forward() * distance * (1.0 - ratio));
    let last = with_fov(&last, 2.0 * (tan / ratio).atan());
    let part = scenario.part(vec![first, last], 4.5);
    let mut part = part.keeping(When::All, GoalKind::Centered(target.clone(), 0.22));
    let wanted = if inward { (0.0, 0.77) } else { (1.3, f64::INFINITY) };
    part = part.keeping(When::All, GoalKind::DistanceRatio(target.aim, wanted));
    // Where the words leave the direction open the keys say which way it went.
    part.movement = if inward { Move::DollyZoomIn } else { Move::DollyZoomOut };
    parts.push(super::seen(part, &target, When::All));
    parts
}

/// Moves the focus from one subject to another, the camera still.
pub(super) fn rack_focus(scenario: &Scenario) -> Vec<Part> {
    let (from, to) = (scenario.opening(), scenario.main());
    let (mut parts, view) = match &scenario.before {
        Some(before) => (Vec::new(), *before),
        None => scenario.opened_on(&from, (0.25, 0.5)),
    };
    let depth = |target: &Target| view.pose.to_camera(target.aim).z.max(1e-3 * scenario.world.bounds.size());
    let focused = |target: &Target| CameraState { focus_distance: Some(depth(target)), ..view };
    let part = scenario.part(vec![focused(&from), focused(&to)], 2.5);
    let part = part.keeping(When::All, GoalKind::InFrame(to.ids.iter().take(1).copied().collect(), 0.8));
    parts.push(super::seen(part, &to, When::All));
    parts
}
