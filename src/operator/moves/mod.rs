//! Every move as geometry, one file a family. Definitions: the contract "Moves, exactly".
//!
//! Enters: one step of a program, the camera before it, and open choices. Leaves: parts whose states are exact.

mod circles;
mod lens;
mod paths;
mod straight;
mod turns;
mod with;

use glam::DVec3;

use super::draft::{Genes, GoalKind, Part, When};
use super::framing::{Target, off_center};
use super::view::{ViewRange, across, aimed, broad_sides, first_view};
use super::world::World;
use super::{Framing, Pass, Program, Speed, Step, Suggestion};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::{CameraState, Easing, Move};

/// Share of a subject's framed points that has to be seen; the film's report calls less than this hidden.
const SEEN_FRAC: f64 = 0.6;
/// Turn rate of joins and of pans at normal speed, degrees a second: a frame width takes 3 to 4 seconds.
const TURN_DEG_PER_SEC: f64 = 17.0;

/// A step with all that its geometry depends on.
pub(super) struct Scenario<'a> {
    pub(super) world: &'a World,
    pub(super) step: &'a Step,
    pub(super) index: usize,
    /// No step follows without a cut.
    pub(super) is_last: bool,
    /// The camera at the end of the step before; `None` at the start and after a cut.
    pub(super) before: Option<CameraState>,
    /// The camera at the start of the whole shot.
    pub(super) origin: Option<CameraState>,
    /// What the step is about at its start and end.
    pub(super) start: Option<Target>,
    pub(super) end: Option<Target>,
    /// What the step before was about.
    pub(super) subject: Option<Target>,
    pub(super) suggestion: Option<&'a Suggestion>,
    /// Headings that later steps would like.
    pub(super) azimuths_rad: Vec<f64>,
    pub(super) genes: &'a Genes,
}

impl<'a> Scenario<'a> {
    pub(super) fn new(
        world: &'a World,
        (program, index): (&'a Program, usize),
        (before, origin): (Option<CameraState>, Option<CameraState>),
        suggestion: Option<&'a Suggestion>,
        genes: &'a Genes,
    ) -> Self {
        let step = &program.steps[index];
        let start = Target::of(world, &step.start);
        let end = Target::of(world, &step.end);
        let named = |i: usize| {
            let step = &program.steps[i];
            Target::of(world, &step.end).or_else(|| Target::of(world, &step.start))
        };
        let subject = (0..index).rev().find_map(named);
        let azimuths_rad = wishes(world, program, index);
        let is_last = program.steps.get(index + 1).is_none_or(|next| next.cut);
        Self { world, step, index, is_last, before, origin, start, end, subject, suggestion, azimuths_rad, genes }
    }

    /// What the step is mainly about: what it ends on, else what it starts on, else what went before, else the scene.
    fn main(&self) -> Target {
        let named = self.end.as_ref().or(self.start.as_ref()).or(self.subject.as_ref());
        named.cloned().unwrap_or_else(|| Target::scene(self.world))
    }

    /// What the step begins with: what it starts on, else what went before, else what it is about.
    fn opening(&self) -> Target {
        self.start.clone().or_else(|| self.subject.clone()).unwrap_or_else(|| self.main())
    }

    /// How the opening is framed.
    fn opening_framing(&self) -> Framing {
        if self.start.is_some() || self.step.start.size.is_some() || self.step.start.angle.is_some() {
            return self.step.start.clone();
        }
        Framing { angle: self.step.end.angle, ..Framing::default() }
    }

    /// A first view of `target`, as large as `fill` where the words say nothing.
    fn view(&self, target: &Target, framing: &Framing, fill: (f64, f64), fov_deg: (f64, f64)) -> CameraState {
        let mut azimuths_rad = self.azimuths_rad.clone();
        azimuths_rad.extend(broad_sides(&self.world.frame, &target.corners));
        let close = framing.size.is_some_and(|size| size.height_band_frac().0 >= 0.8);
        // Close views of small things through a long lens: the camera cannot stand inside what it looks at.
        let fov_deg = if close { (fov_deg.0.min(18.0), fov_deg.1.min(44.0)) } else { fov_deg };
        let range = ViewRange { fill, fov_deg, azimuths_rad };
        first_view(self.world, target, framing, &range, self.suggestion, self.genes)
    }

    /// The camera where the step's own motion begins, looking at `target`, and a turn that leads there if one is needed.
    fn opened_on(&self, target: &Target, fill: (f64, f64)) -> (Vec<Part>, CameraState) {
        match &self.before {
            Some(before) => self.turned_to(before, target.aim),
            None => (Vec::new(), self.view(target, &self.opening_framing(), fill, NORMAL_LENS_DEG)),
        }
    }

    /// The camera turned in place to a point, with the turn as a join where it is more than a nudge.
    fn turned_to(&self, before: &CameraState, point: DVec3) -> (Vec<Part>, CameraState) {
        let turned = aimed(self.world, before, point);
        if off_center(before, point) < 0.03 {
            return (Vec::new(), *before);
        }
        let angle_deg = rotation::angle_between(before.pose.rotation, turned.pose.rotation).to_degrees();
        let secs = (angle_deg / (2.0 * TURN_DEG_PER_SEC)).clamp(0.8, 2.2);
        let mut join = Part::new(self.index, Move::Follow, vec![*before, turned], secs);
        join.is_join = true;
        (vec![join], turned)
    }

    /// The step's own part with its easing and length in time.
    fn part(&self, states: Vec<CameraState>, natural_secs: f64) -> Part {
        let mut part = Part::new(self.index, self.step.movement, states, natural_secs * pace(self.step.speed));
        if let Some(secs) = self.step.duration_secs {
            part.secs = secs;
            part.secs_bind = true;
        }
        part.easing = self.step.easing.unwrap_or(Easing::Smooth);
        part
    }

    /// Picks one of two directions: the one named, or by gene 5 where the words leave it open.
    fn sign(&self, named: f64) -> f64 {
        if self.step.either_way && self.genes[5] < 0.5 { -named } else { named }
    }

    /// Adds what the step's end framing asks for: size, angle, wholly in frame.
    fn ending(&self, mut part: Part) -> Part {
        let framing = &self.step.end;
        if let (Some(size), Some(end)) = (framing.size, self.end.as_ref().or(self.start.as_ref())) {
            part = part.keeping(When::End, GoalKind::Height(end.clone(), size.height_band_frac()));
        }
        if framing.whole {
            part = part.keeping(When::End, GoalKind::InFrame(framing.subjects.clone(), 0.97));
        }
        part
    }

    /// Adds what the step's start framing asks for.
    fn beginning(&self, mut part: Part) -> Part {
        let framing = &self.step.start;
        if let (Some(size), Some(start)) = (framing.size, &self.start) {
            part = part.keeping(When::Start, GoalKind::Height(start.clone(), size.height_band_frac()));
        }
        if framing.whole {
            part = part.keeping(When::Start, GoalKind::InFrame(framing.subjects.clone(), 0.97));
        }
        part
    }
}

/// The part with its target's first two subjects to be seen.
fn seen(mut part: Part, target: &Target, when: When) -> Part {
    for &id in target.ids.iter().take(2) {
        part = part.keeping(when, GoalKind::Unoccluded(id, SEEN_FRAC));
    }
    part
}

/// Vertical field of view of a normal first view, degrees: 35 to 60 mm on full frame, where rooms and things look natural.
pub(super) const NORMAL_LENS_DEG: (f64, f64) = (32.0, 56.0);

/// Factor on a step's time.
fn pace(speed: Speed) -> f64 {
    match speed {
        Speed::Slow => 1.6,
        Speed::Normal => 1.0,
        Speed::Fast => 0.5,
    }
}

/// The parts of one step.
pub(super) fn build(scenario: &Scenario) -> Vec<Part> {
    let mut parts = if scenario.step.returns && scenario.origin.is_some() {
        paths::back_to_origin(scenario)
    } else {
        family(scenario)
    };
    with::add_second_move(scenario, &mut parts);
    if let Some(first) = parts.first_mut() {
        first.cut = scenario.step.cut;
    }
    parts
}

fn family(scenario: &Scenario) -> Vec<Part> {
    let passes = scenario.step.via.as_ref().is_some_and(|via| via.how != Pass::Past);
    match scenario.step.movement {
        Move::Static => turns::hold(scenario),
        Move::Handheld => turns::handheld(scenario),
        Move::PanLeft | Move::PanRight | Move::WhipPan => turns::pan(scenario),
        Move::TiltUp | Move::TiltDown => turns::tilt(scenario),
        Move::RollCw | Move::RollCcw => turns::roll(scenario),
        Move::FlyThrough | Move::PushIn | Move::PullOut | Move::Follow | Move::CraneUp | Move::CraneDown if passes => {
            paths::passing(scenario)
        }
        Move::PushIn | Move::PullOut => straight::dolly(scenario),
        Move::TruckLeft | Move::TruckRight => straight::truck(scenario),
        Move::PedestalUp | Move::PedestalDown => straight::pedestal(scenario),
        Move::CraneUp | Move::CraneDown => circles::crane(scenario),
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => circles::orbit(scenario),
        Move::ZoomIn | Move::ZoomOut => lens::zoom(scenario),
        Move::DollyZoomIn | Move::DollyZoomOut => lens::dolly_zoom(scenario),
        Move::RackFocus => lens::rack_focus(scenario),
        Move::Follow | Move::FlyThrough => paths::follow(scenario),
        Move::Reveal => paths::reveal(scenario),
    }
}

/// Headings that this step and those after it (up to a cut) would like the camera to stand at, seen from their subjects.
fn wishes(world: &World, program: &Program, index: usize) -> Vec<f64> {
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
        out.extend(across(&world.frame, from.aim, to.aim, left));
        if step.either_way {
            out.extend(across(&world.frame, from.aim, to.aim, !left));
        }
    }
    let hub = world.hubs().first().copied();
    let target =
        Target::of(world, &program.steps[index].start).or_else(|| Target::of(world, &program.steps[index].end));
    if let (Some(hub), Some(target)) = (hub, target)
        && world.is_indoor()
    {
        out.push(world.frame.azimuth(hub - target.aim));
    }
    out
}
