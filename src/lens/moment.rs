//! One moment of a shot.

use std::fmt;

use super::budget::Budget;
use super::optics::LensAndShutter;
use super::planned::Sampling;
use super::samples::Between;
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{RenderSettings, SubFrame, ThinLens};
use cinesplat_trajectory::{Keyframe, LensModel};
use glam::DVec3;

/// Where a shot's cameras come from.
#[derive(Clone, Copy)]
pub struct Take<'a> {
    /// The camera at a time, with the motion that effects add.
    pub camera_at: &'a (dyn Fn(f64) -> Camera + Sync),
    /// What the keyframes say about the lens.
    pub optics: &'a OpticsTrack,
    /// World up, unit length; `None` if it is unknown.
    pub up: Option<DVec3>,
    /// Frames per second.
    pub fps: f64,
    /// Seed of the shot.
    pub seed: u64,
}

impl fmt::Debug for Take<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Take").field("fps", &self.fps).field("seed", &self.seed).finish_non_exhaustive()
    }
}

/// The exposure of a picture, which the renderer carries out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposing {
    /// When the shutter opens and when it closes, seconds in the shot; `None` = an instant.
    pub shutter_secs: Option<[f64; 2]>,
    /// The lens; `None` = a pinhole.
    pub lens: Option<ThinLens>,
    /// Samples of both, at least 1.
    pub samples: u32,
    /// What becomes of the blur between the samples.
    pub between: Between,
    /// Height over width of the aperture, 1 or more.
    pub squeeze: f64,
    /// Whether every part of the picture takes all samples, even where little is blurred.
    pub is_even: bool,
}

impl Exposing {
    /// A sharp picture of an instant.
    pub const SHARP: Self =
        Self { shutter_secs: None, lens: None, samples: 1, between: Between::Sharp, squeeze: 1.0, is_even: false };
}

/// What a picture is taken of, and how: an effect changes it for the pictures that it asks for.
#[derive(Debug, Clone)]
pub struct Moment<'a> {
    /// Number of the frame in the shot. The same for all moments of a frame.
    pub frame_idx: usize,
    /// Time in the shot.
    pub time_secs: f64,
    /// The camera, with the motion that effects add.
    pub camera: Camera,
    /// How the picture is rendered.
    pub render: RenderSettings,
    /// The errors that its effects may make: those of the quality of `render`, unless the plan says otherwise.
    pub budget: Budget,
    /// How the lens and the shutter expose it.
    pub exposing: Exposing,
    /// The shot.
    pub take: Take<'a>,
}

impl<'a> Moment<'a> {
    /// The moment of a frame.
    pub fn of_frame(take: Take<'a>, frame_idx: usize, render: &RenderSettings) -> Self {
        let time_secs = frame_idx as f64 / take.fps;
        Self {
            frame_idx,
            time_secs,
            camera: (take.camera_at)(time_secs),
            render: *render,
            budget: Budget::of(render.quality),
            exposing: Exposing::SHARP,
            take,
        }
    }

    /// The same frame at another time: what the effects outside have turned, cut or scaled of this moment's camera, they
    /// turn, cut and scale of the camera at that time.
    #[must_use]
    pub fn at(&self, time_secs: f64) -> Self {
        let (here, there) = ((self.take.camera_at)(self.time_secs), (self.take.camera_at)(time_secs));
        if self.camera == here {
            return Self { time_secs, camera: there, ..self.clone() };
        }
        let turned = here.pose.inverse().compose(&self.camera.pose);
        let zoom = there.intrinsics.fy_px / here.intrinsics.fy_px;
        let own = self.camera.intrinsics;
        let intrinsics = Intrinsics { fx_px: own.fx_px * zoom, fy_px: own.fy_px * zoom, ..own };
        Self { time_secs, camera: Camera { pose: there.pose.compose(&turned), intrinsics }, ..self.clone() }
    }

    /// The same moment with another camera.
    #[must_use]
    pub fn with_camera(&self, camera: Camera) -> Self {
        Self { camera, ..self.clone() }
    }

    /// The same moment, exposed through a lens or over a time as well, with at least these samples.
    #[must_use]
    pub fn exposed(&self, change: impl FnOnce(&mut Exposing), (samples, between): (u32, Between)) -> Self {
        let mut moment = self.clone();
        change(&mut moment.exposing);
        moment.exposing.samples = moment.exposing.samples.max(samples);
        if between == Between::Blurred {
            moment.exposing.between = between;
        }
        moment
    }

    /// How the renderer takes the picture.
    pub(super) fn sampling(&self) -> Sampling {
        let Exposing { shutter_secs, lens, samples, between, squeeze, is_even } = self.exposing;
        if shutter_secs.is_none() && lens.is_none() {
            return Sampling::SubFrames(vec![SubFrame::from(self.camera)]);
        }
        let camera_at = |fraction: f64| match shutter_secs {
            Some([opens, closes]) => self.at(opens + (closes - opens) * fraction).camera,
            None => self.camera,
        };
        let lens = lens.map(|lens| ThinLens { squeeze, ..lens });
        let taken = LensAndShutter { camera_at: &camera_at, lens };
        let (samples, moves) = (samples as usize, shutter_secs.is_some());
        if is_even && between == Between::Sharp && samples > 1 {
            return Sampling::Sweep(Box::new(taken.even_sweep(samples, moves)));
        }
        taken.sampling(samples, (between, moves), &self.budget)
    }

    /// Time from one frame to the next.
    pub fn frame_secs(&self) -> f64 {
        1.0 / self.take.fps
    }
}

/// Lens fields of keyframes as functions of time: linear between keys that have the field, except across a cut; the lens
/// itself is the same from cut to cut.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OpticsTrack {
    /// Times and values of f-stop, shutter angle (radians) and focus distance (scene units); a cut is `true` where its
    /// key begins.
    keys: Vec<(f64, bool, [Option<f64>; 3])>,
    /// The lens of each part from cut to cut, and when the part begins.
    lenses: Vec<(f64, Option<LensModel>)>,
}

impl OpticsTrack {
    /// The track of some keyframes.
    pub fn new(keyframes: &[Keyframe]) -> Self {
        let fields = |key: &Keyframe| [key.optics.f_stop, key.optics.shutter_angle_rad, key.focus_distance];
        let mut lenses: Vec<(f64, Option<LensModel>)> = Vec::new();
        for key in keyframes {
            match lenses.last_mut() {
                // The keys of a part agree.
                Some((_, lens)) if !key.cut => *lens = lens.or(key.optics.lens),
                _ => lenses.push((key.time_secs, key.optics.lens)),
            }
        }
        Self { keys: keyframes.iter().map(|key| (key.time_secs, key.cut, fields(key))).collect(), lenses }
    }

    /// The lens of the part around a time; `None` if its keyframes state none.
    pub fn lens(&self, time_secs: f64) -> Option<LensModel> {
        let after = self.lenses.partition_point(|(begins, _)| *begins <= time_secs);
        self.lenses.get(after.saturating_sub(1)).and_then(|(_, lens)| *lens)
    }

    /// The f-stop at a time; `None` if no keyframe has one.
    pub fn f_stop(&self, time_secs: f64) -> Option<f64> {
        self.value(0, time_secs)
    }

    /// The shutter angle at a time, radians; `None` if no keyframe has one.
    pub fn shutter_angle_rad(&self, time_secs: f64) -> Option<f64> {
        self.value(1, time_secs)
    }

    /// The focus distance at a time, scene units; `None` if no keyframe has one. Between two keys the focus is pulled:
    /// it starts and ends gently, and turns the ring of the lens, whose scale is the reciprocal of the distance.
    pub fn focus_distance(&self, time_secs: f64) -> Option<f64> {
        let pulled = |from: f64, to: f64, part: f64| {
            let eased = part * part * (3.0 - 2.0 * part);
            1.0 / (1.0 / from + (1.0 / to - 1.0 / from) * eased)
        };
        self.mixed(2, time_secs, pulled)
    }

    /// The least and the largest focus distance of the keyframes, scene units; `None` if no keyframe has one.
    pub fn focus_range(&self) -> Option<[f64; 2]> {
        let mut distances = self.keys.iter().filter_map(|(.., fields)| fields[2]);
        let first = distances.next()?;
        Some(distances.fold([first; 2], |[near, far], distance| [near.min(distance), far.max(distance)]))
    }

    /// Times that cut an interval about `time_secs` short: the last cut at or before it and the first one after it.
    pub fn uncut(&self, time_secs: f64, [from, to]: [f64; 2]) -> [f64; 2] {
        let cuts = || self.keys.iter().filter(|(_, cut, _)| *cut).map(|(time, ..)| *time);
        let opens = cuts().filter(|cut| *cut <= time_secs).fold(from, f64::max);
        // At the time of a cut the camera is behind it.
        let closes = cuts().filter(|cut| *cut > time_secs).map(f64::next_down).fold(to, f64::min);
        [opens, closes]
    }

    fn value(&self, field: usize, time_secs: f64) -> Option<f64> {
        self.mixed(field, time_secs, |from, to, part| from + (to - from) * part)
    }

    fn mixed(&self, field: usize, time_secs: f64, mix: impl Fn(f64, f64, f64) -> f64) -> Option<f64> {
        let after = self.keys.partition_point(|(time, ..)| *time <= time_secs);
        let has = |(time, _, fields): &(f64, bool, [Option<f64>; 3])| Some((*time, fields[field]?));
        let before = self.keys[..after].iter().rposition(|key| key.2[field].is_some());
        let next = self.keys[after..].iter().position(|key| key.2[field].is_some()).map(|at| at + after);
        match (before, next) {
            (Some(a), Some(b)) => {
                let ((from, value), (to, next_value)) = (has(&self.keys[a])?, has(&self.keys[b])?);
                let is_cut = self.keys[a + 1..=b].iter().any(|(_, cut, _)| *cut);
                let part = if is_cut { 0.0 } else { (time_secs - from) / (to - from) };
                Some(mix(value, next_value, part))
            }
            (Some(only), None) | (None, Some(only)) => self.keys[only].2[field],
            (None, None) => None,
        }
    }
}
