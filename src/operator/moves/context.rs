//! One step of a program with everything that its geometry depends on, and what all moves share.

use glam::DVec3;

use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Target, off_center};
use crate::motion::{MotionSegment, StepParameters};
use crate::program::{Framing, Program, Speed, Step};
use crate::suggestion::StepCameras;
use crate::view::{ViewRange, aimed, azimuth_across, broadside_azimuths, opening_view};
use crate::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Easing, Move};

/// Required visible share of a subject's points in the frame.
const VISIBLE_FRAC: f64 = 0.6;
/// Turn rate of pans at normal speed, degrees per second: a frame width takes 3 to 4 seconds. Joins turn twice as fast.
pub(super) const TURN_DEG_PER_SEC: f64 = 17.0;

/// A step with everything that its geometry depends on.
pub(crate) struct StepContext<'a> {
    pub(super) world: &'a World,
    pub(super) step: &'a Step,
    /// Index of the step in the program.
    pub(super) index: usize,
    /// No step follows, or the next one begins with a cut.
    pub(super) is_last: bool,
    /// The camera at the end of the step before; `None` at the start and after a cut.
    pub(super) before: Option<CameraState>,
    /// The camera at the start of the whole shot.
    pub(super) origin: Option<CameraState>,
    /// Target of the step's start framing.
    pub(super) start: Option<Target>,
    /// Target of the step's end framing.
    pub(super) end: Option<Target>,
    /// Target of the nearest earlier step that names one.
    pub(super) earlier: Option<Target>,
    /// The cameras that the director proposes.
    pub(super) suggestion: Option<&'a StepCameras>,
    /// Azimuths of the opening view that suit this step and those after it.
    pub(super) azimuths_rad: Vec<f64>,
    pub(super) parameters: &'a StepParameters,
}

impl<'a> StepContext<'a> {
    /// `before` is the camera at the end of the step before; `origin` is the camera at the start of the shot.
    pub(crate) fn new(
        world: &'a World,
        (program, index): (&'a Program, usize),
        (before, origin): (Option<CameraState>, Option<CameraState>),
        suggestion: Option<&'a StepCameras>,
        parameters: &'a StepParameters,
    ) -> Self {
        let step = &program.steps[index];
        let start = Target::of(world, &step.start);
        let end = Target::of(world, &step.end);
        let named = |i: usize| {
            let step = &program.steps[i];
            Target::of(world, &step.end).or_else(|| Target::of(world, &step.start))
        };
        let earlier = (0..index).rev().find_map(named);
        let azimuths_rad = preferred_azimuths(world, program, index);
        let is_last = program.steps.get(index + 1).is_none_or(|next| next.cut);
        Self { world, step, index, is_last, before, origin, start, end, earlier, suggestion, azimuths_rad, parameters }
    }

    /// The step's main target: that of its end, else of its start, else of an earlier step, else the scene.
    pub(super) fn main_target(&self) -> Target {
        let named = self.end.as_ref().or(self.start.as_ref()).or(self.earlier.as_ref());
        named.cloned().unwrap_or_else(|| Target::scene(self.world))
    }

    /// The target at the step's start: that of its start, else of an earlier step, else the main one.
    pub(super) fn opening_target(&self) -> Target {
        self.start.clone().or_else(|| self.earlier.clone()).unwrap_or_else(|| self.main_target())
    }

    /// The framing at the step's start.
    pub(super) fn opening_framing(&self) -> Framing {
        if self.start.is_some() || self.step.start.size.is_some() || self.step.start.angle.is_some() {
            return self.step.start.clone();
        }
        Framing { angle: self.step.end.angle, ..Framing::default() }
    }

    /// An opening view of `target`. `fill` and `fov_deg` are the ranges of size and field of view where the prompt
    /// states no size.
    pub(super) fn view(
        &self,
        target: &Target,
        framing: &Framing,
        fill: (f64, f64),
        fov_deg: (f64, f64),
    ) -> CameraState {
        let mut azimuths_rad = self.azimuths_rad.clone();
        azimuths_rad.extend(broadside_azimuths(&self.world.frame, &target.corners));
        let close = framing.size.is_some_and(|size| size.height_band_frac().0 >= 0.8);
        // Close views use a long lens, so that the camera does not have to stand inside its subject.
        let fov_deg = if close { (fov_deg.0.min(18.0), fov_deg.1.min(44.0)) } else { fov_deg };
        let range = ViewRange { fill, fov_deg, azimuths_rad };
        opening_view(self.world, target, framing, &range, self.suggestion, self.parameters)
    }

    /// The camera where the step's own motion begins, aimed at `target`, and a join that turns to it where needed.
    pub(super) fn opened_on(&self, target: &Target, fill: (f64, f64)) -> (Vec<MotionSegment>, CameraState) {
        match &self.before {
            Some(before) => self.turned_to(before, target.aim),
            None => (Vec::new(), self.view(target, &self.opening_framing(), fill, NORMAL_LENS_DEG)),
        }
    }

    /// The camera turned in place to a point, and a join for the turn. A camera that already aims at the point stays as
    /// it is.
    pub(super) fn turned_to(&self, before: &CameraState, point: DVec3) -> (Vec<MotionSegment>, CameraState) {
        let turned = aimed(self.world, before, point);
        if off_center(before, point) < 0.03 {
            return (Vec::new(), *before);
        }
        let angle_deg = rotation::angle_between(before.pose.rotation, turned.pose.rotation).to_degrees();
        let secs = (angle_deg / (2.0 * TURN_DEG_PER_SEC)).clamp(0.8, 2.2);
        let mut join = MotionSegment::new(self.index, Move::Follow, vec![*before, turned], secs);
        join.is_join = true;
        (vec![join], turned)
    }

    /// A segment of the step's move, with its easing. It lasts as long as the prompt says, or `natural_secs` times the
    /// factor of the step's speed.
    pub(super) fn segment(&self, states: Vec<CameraState>, natural_secs: f64) -> MotionSegment {
        let mut segment =
            MotionSegment::new(self.index, self.step.movement, states, natural_secs * pace(self.step.speed));
        if let Some(secs) = self.step.duration_secs {
            segment.secs = secs;
            segment.secs_bind = true;
        }
        segment.easing = self.step.easing.unwrap_or(Easing::Smooth);
        segment
    }

    /// The sign of the step's direction. Parameter 5 chooses it where the prompt leaves it open.
    pub(super) fn sign(&self, named: f64) -> f64 {
        if self.step.either_way && self.parameters[5] < 0.5 { -named } else { named }
    }

    /// The segment with the constraints of the step's end framing: size, and all subjects in the frame.
    pub(super) fn constrained_at_end(&self, mut segment: MotionSegment) -> MotionSegment {
        let framing = &self.step.end;
        if let (Some(size), Some(end)) = (framing.size, self.end.as_ref().or(self.start.as_ref())) {
            segment = segment.requiring(Scope::End, ConstraintKind::Height(end.clone(), size.height_band_frac()));
        }
        if framing.whole {
            segment = segment.requiring(Scope::End, ConstraintKind::InFrame(framing.subjects.clone(), 0.97));
        }
        segment
    }

    /// The segment with the constraints of the step's start framing.
    pub(super) fn constrained_at_start(&self, mut segment: MotionSegment) -> MotionSegment {
        let framing = &self.step.start;
        if let (Some(size), Some(start)) = (framing.size, &self.start) {
            segment = segment.requiring(Scope::Start, ConstraintKind::Height(start.clone(), size.height_band_frac()));
        }
        if framing.whole {
            segment = segment.requiring(Scope::Start, ConstraintKind::InFrame(framing.subjects.clone(), 0.97));
        }
        segment
    }
}

/// The segment with the first two subjects of a target required to be visible.
pub(super) fn require_visible(mut segment: MotionSegment, target: &Target, scope: Scope) -> MotionSegment {
    for &id in target.ids.iter().take(2) {
        segment = segment.requiring(scope, ConstraintKind::Unoccluded(id, VISIBLE_FRAC));
    }
    segment
}

/// Range of the vertical field of view of a normal view, degrees: 35 to 60 mm on full frame, which renders rooms and
/// objects with a natural perspective.
pub(super) const NORMAL_LENS_DEG: (f64, f64) = (32.0, 56.0);

/// Factor on a step's duration.
fn pace(speed: Speed) -> f64 {
    match speed {
        Speed::Slow => 1.6,
        Speed::Normal => 1.0,
        Speed::Fast => 0.5,
    }
}

/// Azimuths of the camera, seen from its subject, that suit this step and those after it up to a cut: across the line
/// between start and end of each, and toward the best viewpoint.
fn preferred_azimuths(world: &World, program: &Program, index: usize) -> Vec<f64> {
    let mut out = Vec::new();
    for (i, step) in program.steps.iter().enumerate().skip(index) {
        if step.cut && i > index {
            break;
        }
        let named = |j: usize| {
            let step = &program.steps[j];
            Target::of(world, &step.end).or_else(|| Target::of(world, &step.start))
        };
        let earlier = (0..i).rev().find_map(named);
        let from = Target::of(world, &step.start).or(earlier);
        let (Some(from), Some(to)) = (from, Target::of(world, &step.end)) else { continue };
        if from.aim.distance(to.aim) < 1e-9 {
            continue;
        }
        let left = matches!(step.movement, Move::TruckLeft | Move::PanLeft);
        out.extend(azimuth_across(&world.frame, from.aim, to.aim, left));
        if step.either_way {
            out.extend(azimuth_across(&world.frame, from.aim, to.aim, !left));
        }
    }
    let viewpoint = world.viewpoints().first().copied();
    let target =
        Target::of(world, &program.steps[index].start).or_else(|| Target::of(world, &program.steps[index].end));
    if let (Some(viewpoint), Some(target)) = (viewpoint, target)
        && world.is_indoor()
    {
        out.push(world.frame.azimuth(viewpoint - target.aim));
    }
    out
}
