//! One step of a program with everything that its geometry depends on, and what all moves share.

use glam::DVec3;

use super::room_view::{room_target, room_view, target_ahead};
use super::standing_view::{Standing, standing_view};
use crate::composition::lens_fov_deg;
use crate::constraint::{ConstraintKind, Scope, pitch_band_deg};
use crate::framing::{Target, off_center};
use crate::motion::{MotionSegment, StepParameters};
use crate::pacing::factor;
use crate::program::{Framing, Limit, Motion, Pass, Program, Step, SubjectSide};
use crate::suggestion::StepCameras;
use crate::view::{
    CIRCLING_OVERHEAD_DEG, OVERHEAD_DEG, ViewRange, aimed, azimuth_across, broadside_azimuths, height_band_frac, lerp,
    opening_view,
};
use crate::wall_side::wall_behind;
use crate::world::World;
use cinesplat_trajectory::{CameraState, Easing, Move, ShotSize};

/// Required visible share of a subject's points in the frame.
const VISIBLE_FRAC: f64 = 0.6;
/// Duration of a segment before its pace is known.
pub(super) const PROVISIONAL_SECS: f64 = 4.0;

/// A step with everything that its geometry depends on.
#[derive(Clone)]
pub(crate) struct StepContext<'a> {
    pub(super) world: &'a World,
    pub(super) step: &'a Step,
    /// Index of the step in the program.
    pub(super) index: usize,
    /// No step follows, or the next one begins with a cut.
    pub(super) is_last: bool,
    /// The step that follows circles what this one ends on.
    pub(super) is_circled_next: bool,
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
    /// Motions that the prompt forbids.
    pub(super) forbidden: &'a [Motion],
    /// Limits that the prompt sets.
    pub(super) limits: &'a [Limit],
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
        let next = program.steps.get(index + 1).filter(|next| !next.cut);
        let is_last = next.is_none();
        let goes_on = |next: &Step| {
            next.end.subjects.is_empty() || next.end.subjects.first() == program.steps[index].end.subjects.first()
        };
        let is_circled_next = next.is_some_and(|next| next.movement.is_circular() && goes_on(next));
        Self {
            world,
            step,
            index,
            is_last,
            is_circled_next,
            before,
            origin,
            start,
            end,
            earlier,
            suggestion,
            azimuths_rad,
            parameters,
            forbidden: &program.forbidden,
            limits: &program.limits,
        }
    }

    /// The step's main target: that of its end, else of its start, else of an earlier step, else what there is to see.
    pub(super) fn main_target(&self) -> Target {
        let named = self.end.as_ref().or(self.start.as_ref()).or(self.earlier.as_ref());
        named.cloned().unwrap_or_else(|| self.unnamed_target())
    }

    /// The target of a step that names none: in a room what the camera before is aimed at, or what a person who stands
    /// there looks at; elsewhere the scene as a whole.
    fn unnamed_target(&self) -> Target {
        match &self.before {
            Some(before) if self.world.is_indoor() => target_ahead(self.world, before),
            _ => room_target(self.world, self.parameters).unwrap_or_else(|| Target::scene(self.world)),
        }
    }

    /// Whether the step or one before it names a subject, or an object to pass or to look at.
    pub(crate) fn names_objects(&self) -> bool {
        let named = self.end.as_ref().or(self.start.as_ref()).or(self.earlier.as_ref());
        named.is_some() || self.step.via.is_some() || self.step.look.is_some()
    }

    /// The target at the step's start: that of its start, else of an earlier step, else the main one.
    pub(super) fn opening_target(&self) -> Target {
        self.start.clone().or_else(|| self.earlier.clone()).unwrap_or_else(|| self.main_target())
    }

    /// The framing at the step's start.
    pub(super) fn opening_framing(&self) -> Framing {
        let (start, end) = (&self.step.start, &self.step.end);
        let mut framing = if self.start.is_some() || start.size.is_some() || start.angle.is_some() {
            start.clone()
        } else if is_composed(start) {
            Framing { angle: start.angle.or(end.angle), ..start.clone() }
        } else {
            Framing { angle: end.angle, ..Framing::default() }
        };
        framing.side = framing.side.or(self.passed_side());
        if self.opens_on_room() && !self.main_target().ids.is_empty() {
            // The room is wide where its subject is small in it.
            framing.size = Some(ShotSize::ExtremeLong);
        }
        self.inherit(&mut framing);
        let is_level = framing.angle.is_none() && framing.height.is_none() && framing.elevation_deg.is_none();
        if is_level && self.before.is_none() && self.backs_to_room() {
            framing.elevation_deg = Some(lerp(BACKING_ELEVATION_DEG, self.parameters[1]));
        }
        framing
    }

    /// Whether the step pulls out from a small thing to the room as a whole: where it begins, the camera looks nearly level
    /// and through no long lens, or it would end under the ceiling and still see little.
    pub(super) fn backs_to_room(&self) -> bool {
        let end = &self.step.end;
        let is_wide = end.subjects.is_empty() && matches!(end.size, Some(ShotSize::Long | ShotSize::ExtremeLong));
        let left = self.start.as_ref().or(self.earlier.as_ref());
        let is_small = |left: &Target| left.radius <= SMALL_FRAC * self.world.bounds.size();
        self.step.movement == Move::PullOut && is_wide && self.world.is_indoor() && left.is_some_and(is_small)
    }

    /// Whether the step pulls out from a small thing to the whole of something large, which a long lens never takes in.
    fn backs_to_large(&self) -> bool {
        let (Some(start), Some(end)) = (&self.start, &self.end) else { return false };
        let is_whole = self.step.end.whole && self.step.movement == Move::PullOut;
        is_whole && self.world.is_indoor() && end.radius > MUCH_LARGER * start.radius
    }

    /// The side of the passed object from which a truck that goes behind or in front of it sees it.
    fn passed_side(&self) -> Option<SubjectSide> {
        let truck = matches!(self.step.movement, Move::TruckLeft | Move::TruckRight);
        match self.step.via.as_ref().filter(|_| truck)?.how {
            Pass::Behind => Some(SubjectSide::FromBack),
            Pass::Front => Some(SubjectSide::FromFront),
            _ => None,
        }
    }

    /// Completes the framing at the start with what the move keeps until the end, where the prompt states it for the end
    /// alone.
    pub(super) fn inherit(&self, framing: &mut Framing) {
        let end = &self.step.end;
        framing.lens = framing.lens.or(end.lens.filter(|_| !is_lens_move(self.step.movement)));
        let same = framing.subjects.is_empty() || end.subjects.is_empty() || framing.subjects[0] == end.subjects[0];
        if !same {
            return;
        }
        let keeps = |quantity: Quantity| kept(self.step.movement).contains(&quantity);
        framing.side = framing.side.or(end.side.filter(|_| keeps(Quantity::Side)));
        if framing.backdrop.is_empty() && keeps(Quantity::Side) {
            framing.backdrop.clone_from(&end.backdrop);
        }
        framing.elevation_deg = framing.elevation_deg.or(end.elevation_deg.filter(|_| keeps(Quantity::Elevation)));
        framing.height = framing.height.or(end.height.filter(|_| keeps(Quantity::Height)));
        if keeps(Quantity::Distance) {
            framing.distance = framing.distance.or(end.distance);
            framing.height_frac = framing.height_frac.or(end.height_frac.filter(|_| !is_lens_move(self.step.movement)));
        }
    }

    /// Vertical field of view at the step's end: the stated lens, or else that of its first camera.
    pub(super) fn end_fov_rad(&self, first: &CameraState) -> f64 {
        self.step.end.lens.map_or(first.fov_y_rad, |lens| {
            let (low, high) = lens_fov_deg(lens);
            let kept = first.fov_y_rad.to_degrees();
            if (low..=high).contains(&kept) { first.fov_y_rad } else { low.midpoint(high).to_radians() }
        })
    }

    /// The step as far as a stated place of the camera needs it.
    pub(super) fn standing(&self) -> Standing<'a> {
        Standing { world: self.world, step: self.step, parameters: self.parameters }
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
        if let Some(view) = standing_view(&self.standing(), target, framing, fill, fov_deg) {
            return view;
        }
        let lens = Some(fov_deg).filter(|&lens| lens != NORMAL_LENS_DEG);
        if target.ids.is_empty()
            && let Some(view) = room_view(self.world, target, framing, self.parameters, lens)
        {
            return view;
        }
        let mut azimuths_rad = self.azimuths_rad.clone();
        match self.world.known_front(target.center).or_else(|| self.world.facing(target.center)) {
            Some(front) => azimuths_rad.push(front),
            None => azimuths_rad.extend(broadside_azimuths(&self.world.frame, &target.corners)),
        }
        if matches!(self.step.movement, Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown) {
            let first = target.ids.first().and_then(|id| self.world.subject(*id));
            azimuths_rad.extend(first.and_then(|subject| wall_behind(self.world, subject)));
        }
        let is_close = |framing: &Framing| {
            let height = framing.height_frac.or(framing.size.map(|size| size.height_band_frac().0));
            height.is_some_and(|height| height >= 0.8)
        };
        let close = is_close(framing) || self.step.movement == Move::PushIn && is_close(&self.step.end);
        // Close views use a long lens, so that the camera does not have to stand inside its subject.
        let fov_deg = match (self.backs_to_room() || self.backs_to_large(), close) {
            (true, _) => BACKING_LENS_DEG,
            (false, true) => (fov_deg.0.min(18.0), fov_deg.1.min(44.0)),
            (false, false) => fov_deg,
        };
        // Around a lone thing there is nothing to see: it fills more of the picture.
        let grows = self.step.with.iter().any(|second| matches!(second, Move::ZoomIn | Move::PushIn));
        let roomy = self.world.is_indoor() || grows;
        let fill = if roomy { fill } else { (1.35 * fill.0, fill.1.max((1.2 * fill.1).min(0.9))) };
        let (fill, fov_deg) = self.widened(fill, fov_deg);
        let overhead_deg = if self.leaves_zenith() { CIRCLING_OVERHEAD_DEG } else { OVERHEAD_DEG };
        let range = ViewRange { fill, fov_deg, azimuths_rad, overhead_deg };
        opening_view(self.world, target, framing, &range, self.suggestion, self.parameters)
    }

    /// Whether an overhead view of the step is oblique: a camera that circles its subject, or rises beside it, would spin in
    /// place straight above it. A descent is none of these: it swoops down from there.
    fn leaves_zenith(&self) -> bool {
        use Move::{ArcLeft, ArcRight, CraneDown, CraneUp, OrbitLeft, OrbitRight};
        let moves = || std::iter::once(&self.step.movement).chain(&self.step.with);
        let leaves = |movement: &Move| matches!(movement, OrbitLeft | OrbitRight | ArcLeft | ArcRight | CraneUp);
        moves().any(leaves) && self.step.movement != CraneDown
    }

    /// Whether the prompt opens on the room as a whole: a wide size without subjects.
    pub(super) fn opens_on_room(&self) -> bool {
        let start = &self.step.start;
        let wide = matches!(start.size, Some(ShotSize::Long | ShotSize::ExtremeLong));
        self.before.is_none() && wide && start.subjects.is_empty()
    }

    /// The ranges of size and field of view, widened where the step keeps objects in view or avoids them: farther and
    /// wider views hold more, nearer and narrower ones less.
    fn widened(&self, (small, large): (f64, f64), (narrow, wide): (f64, f64)) -> ((f64, f64), (f64, f64)) {
        let (keeps, avoids) = (!self.step.keep.is_empty(), !self.step.avoid.is_empty());
        let fill = (if keeps { 0.6 * small } else { small }, if avoids { (2.0 * large).min(0.9) } else { large });
        let fov_deg = (if avoids { 0.5 * narrow } else { narrow }, if keeps { wide.max(74.0) } else { wide });
        (fill, fov_deg)
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
        if off_center(self.world, before, point) < 0.03 || self.forbids_turning() {
            return (Vec::new(), *before);
        }
        (vec![self.join(*before, turned)], turned)
    }

    /// Whether the film comes to a target with this step, from something else.
    pub(super) fn comes_to(&self, target: &Target) -> bool {
        self.earlier.as_ref().is_some_and(|earlier| !target.ids.iter().any(|id| earlier.ids.contains(id)))
    }

    /// Whether the words rule out every turn of the camera, or one to a side, up or down.
    pub(super) fn forbids_turning(&self) -> bool {
        self.forbidden.iter().any(|motion| matches!(motion, Motion::Turn | Motion::Pan | Motion::Tilt))
    }

    /// The way from the camera before to where the step's own motion begins.
    pub(super) fn join(&self, before: CameraState, first: CameraState) -> MotionSegment {
        let join = MotionSegment::new(self.index, Move::Follow, vec![before, first], PROVISIONAL_SECS);
        MotionSegment { is_join: true, ..join }
    }

    /// A segment of the step's move, with its easing. It lasts as long as the prompt says; where it says nothing, the
    /// duration here is provisional (see [`pace`](crate::pacing::pace)).
    pub(super) fn segment(&self, states: Vec<CameraState>) -> MotionSegment {
        self.lasting(states, PROVISIONAL_SECS)
    }

    /// As [`Self::segment`], with the duration that the move takes at normal speed.
    pub(super) fn lasting(&self, states: Vec<CameraState>, natural_secs: f64) -> MotionSegment {
        let secs = natural_secs * factor(self.step.speed);
        let mut segment = MotionSegment::new(self.index, self.step.movement, states, secs);
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
        let is_wide = matches!(framing.size, Some(ShotSize::Long | ShotSize::ExtremeLong));
        let left = self.earlier.as_ref().filter(|_| is_wide && self.step.movement == Move::PullOut);
        if let (Some(size), Some(end)) = (framing.size, self.end.as_ref().or(self.start.as_ref()).or(left)) {
            let (low, high) = height_band_frac(framing, size);
            // A wide view without a subject shows the room: what the step leaves behind may be as small as it likes.
            let is_of_room = self.end.is_none() && is_wide;
            let band = (if is_of_room { 0.0 } else { low }, high);
            segment = segment.requiring(Scope::End, ConstraintKind::Height(end.clone(), band));
        }
        if framing.whole {
            segment = segment.requiring(Scope::End, ConstraintKind::InFrame(framing.subjects.clone(), 0.97));
        }
        segment
    }

    /// The segment with the pitch of a stated angle required at its start, where no step before decides that.
    pub(super) fn constrained_in_pitch(&self, segment: MotionSegment) -> MotionSegment {
        match self.step.start.angle.or(self.step.end.angle).filter(|_| self.before.is_none()) {
            Some(angle) => segment.requiring(Scope::Start, ConstraintKind::Pitch(pitch_band_deg(angle))),
            None => segment,
        }
    }

    /// The segment with the constraints of the step's start framing.
    pub(super) fn constrained_at_start(&self, mut segment: MotionSegment) -> MotionSegment {
        let framing = &self.step.start;
        if let (Some(size), Some(start)) = (framing.size, &self.start) {
            segment =
                segment.requiring(Scope::Start, ConstraintKind::Height(start.clone(), height_band_frac(framing, size)));
        }
        if framing.whole {
            segment = segment.requiring(Scope::Start, ConstraintKind::InFrame(framing.subjects.clone(), 0.97));
        }
        segment
    }
}

/// Radius of a thing over the scene size up to which it is small in a room.
const SMALL_FRAC: f64 = 0.12;
/// Size of what a pull-out takes in, over that of what it leaves, from which on it begins with a normal lens.
const MUCH_LARGER: f64 = 3.0;
/// Elevation of a camera that backs away from a small thing to show the room, and its vertical field of view, degrees.
const BACKING_ELEVATION_DEG: (f64, f64) = (1.0, 14.0);
const BACKING_LENS_DEG: (f64, f64) = (36.0, 52.0);

/// A quantity of the view of a subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Side,
    Elevation,
    Height,
    Distance,
}

/// What a move keeps of the view of its subject.
fn kept(movement: Move) -> &'static [Quantity] {
    use Quantity::{Distance, Elevation, Height, Side};
    match movement {
        Move::Static
        | Move::Handheld
        | Move::RollCw
        | Move::RollCcw
        | Move::ZoomIn
        | Move::ZoomOut
        | Move::TruckLeft
        | Move::TruckRight => &[Side, Elevation, Height, Distance],
        Move::PushIn | Move::PullOut | Move::DollyZoomIn | Move::DollyZoomOut => &[Side, Elevation],
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => &[Elevation, Height, Distance],
        Move::PedestalUp | Move::PedestalDown | Move::CraneUp | Move::CraneDown => &[Side],
        _ => &[],
    }
}

fn is_lens_move(movement: Move) -> bool {
    matches!(movement, Move::ZoomIn | Move::ZoomOut | Move::DollyZoomIn | Move::DollyZoomOut)
}

/// Whether a framing states more than its subjects.
pub(super) fn is_stated(framing: &Framing) -> bool {
    *framing != Framing { subjects: framing.subjects.clone(), ..Framing::default() }
}

/// Whether a framing states more than subjects, size, angle, part and whole.
fn is_composed(framing: &Framing) -> bool {
    let numbers = [framing.height_frac, framing.elevation_deg, framing.height, framing.distance];
    numbers.iter().any(Option::is_some)
        || framing.lens.is_some()
        || framing.side.is_some()
        || framing.place.is_some()
        || framing.hidden
        || !framing.backdrop.is_empty()
}

/// The segment with the first two subjects of a target required to be visible.
pub(super) fn require_visible(mut segment: MotionSegment, target: &Target, scope: Scope) -> MotionSegment {
    if target.ids.len() > 2 && scope == Scope::All {
        // Of many things some hide others all the way around.
        return segment.requiring(scope, ConstraintKind::InFrame(target.ids.clone(), MANY_IN_FRAME));
    }
    for &id in target.ids.iter().take(2) {
        segment = segment.requiring(scope, ConstraintKind::Unoccluded(id, VISIBLE_FRAC));
    }
    segment
}

/// Share of each of many things that stays in the frame.
const MANY_IN_FRAME: f64 = 0.7;

/// Range of the vertical field of view of a normal view, degrees: 35 to 60 mm on full frame, which renders rooms and
/// objects with a natural perspective.
pub(super) const NORMAL_LENS_DEG: (f64, f64) = (32.0, 56.0);

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
        if matches!(step.movement, Move::TiltUp | Move::TiltDown) {
            // Who tilts from a candle to a picture has the picture behind the candle.
            out.push(world.frame.azimuth(from.aim - to.aim));
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
