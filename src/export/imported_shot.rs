//! The shot of a track that another program wrote: its frame rate, what is assumed, and what is lost.

use std::borrow::Cow;

use glam::DVec3;

use super::ExportError;
use super::track::{DEFAULT_FOV_Y_DEG, DEFAULT_FPS, DEFAULT_SIZE_PX, LensSide, PoseFrame, PoseTrack};
use cinesplat_trajectory::{Easing, EffectRequest, Keyframe, LENS_EFFECT, LensModel, SceneRef, Shot};

/// Largest distance of an even stamp from its place, s.
const EVEN_SECS: f64 = 1e-3;
/// Largest distance of an even stamp from its place, in steps.
const EVEN_STEPS: f64 = 0.05;
/// Largest distance of a time from a frame of the film that is rounding: six decimals, or 32 bits up to 10 s.
const ROUNDING_SECS: f64 = 1e-6;
/// The same for later times of 32 bits, over the time.
const ROUNDING_FRAC: f64 = 1e-7;
/// Largest frame rate of a film, frames per second. Even stamps closer together are keyframes, too.
const MAX_FPS: f64 = 1000.0;
/// Most decimals of a rate that is found from rounded stamps.
const RATE_DECIMALS: i32 = 6;
/// Lowest frame rate of a film, frames per second. Even stamps further apart are keyframes.
const MIN_INFERRED_FPS: f64 = 4.0;

/// Values that replace those of the file, or the defaults for what the file does not state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ImportSettings {
    /// Frames per second.
    pub fps: Option<f64>,
    /// Image width and height, pixels.
    pub size_px: Option<(u32, u32)>,
    /// Vertical field of view, rad.
    pub fov_y_rad: Option<f64>,
    /// World up, any length above 0.
    pub up: Option<DVec3>,
}

/// A shot with one keyframe per frame and times from 0, and one line per assumption and loss.
///
/// # Errors
/// [`ExportError::NoPoses`] without frames, [`ExportError::BadShot`] if times do not increase or a number is out of
/// range.
pub(super) fn shot_of(track: &PoseTrack, settings: &ImportSettings) -> Result<(Shot, Vec<String>), ExportError> {
    let (track, mut lines) = in_order(track);
    let Some(first) = track.frames.first() else { return Err(ExportError::NoPoses) };
    lines.splice(0..0, track.unread.iter().cloned());
    if track.timed && first.time_secs != 0.0 {
        lines.push(format!("a shot starts at 0 s: {} s are subtracted from every time", first.time_secs));
    }
    let rate = FrameRate::new(&track, settings);
    let fps = settings.fps.or(rate.own).unwrap_or(DEFAULT_FPS);
    lines.extend(rate.line(&track, settings));
    let (size_px, line) = size_px(&track, settings);
    lines.extend(line);
    lines.extend(fov_line(&track, settings, size_px));
    let lens = |fov_y_rad: f64| match track.lens_side {
        LensSide::Vertical => fov_y_rad,
        LensSide::Larger => refitted(fov_y_rad, size_px),
    };
    if track.lens_side == LensSide::Larger && settings.fov_y_rad.is_none() {
        let (width, height) = size_px;
        lines.push(format!("the field of view is along the larger side: of an image of {width} x {height}"));
    }
    let up = settings.up.and_then(DVec3::try_normalize).or(track.up);
    if up.is_none() {
        lines.push("the file has no world up: the shot states none".to_owned());
    }
    let times = |idx: usize, frame: &PoseFrame| match rate.own.filter(|_| !track.timed) {
        Some(own) if track.is_numbered => ((frame.time_secs - first.time_secs) * DEFAULT_FPS).round() / own,
        Some(own) => idx as f64 / own,
        None => on_frame(frame.time_secs - first.time_secs, fps),
    };
    let keyframe = |(idx, frame): (usize, &PoseFrame)| Keyframe {
        time_secs: times(idx, frame),
        pose: frame.pose,
        fov_y_rad: settings
            .fov_y_rad
            .or(frame.fov_y_rad.map(lens))
            .or(frame.fov_x_rad.map(|across| upward(across, size_px)))
            .unwrap_or(DEFAULT_FOV_Y_DEG.to_radians()),
        focus_distance: frame.focus_distance,
        optics: cinesplat_trajectory::KeyOptics::default(),
        easing: frame.easing,
        cut: frame.cut,
        intent: None,
    };
    let keyframes: Vec<Keyframe> = track.frames.iter().enumerate().map(keyframe).collect();
    // The last frame is shown for one frame time, too.
    let last_secs = keyframes.last().map_or(0.0, |key| key.time_secs);
    let duration_secs = last_secs + rate.own.filter(|_| rate.is_sampled).map_or(0.0, f64::recip);
    let scene = SceneRef { up, ..SceneRef::default() };
    let effects = track.lens_model.iter().map(lens_effect).collect();
    let shot = Shot { scene, effects, ..Shot::from_keyframes(size_px.into(), fps, duration_secs, keyframes) };
    Ok((shot.validated()?, lines))
}

/// The effect that shows the lens of a file.
fn lens_effect(lens: &LensModel) -> EffectRequest {
    let settings = lens.own_values().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    EffectRequest { kind: LENS_EFFECT.to_owned(), because: "the lens of the file".to_owned(), settings, runs: None }
}

/// The track in order of time and without poses that stand there twice, and a line for each of both. Frames with cuts
/// belong to those before them and stay.
fn in_order(track: &PoseTrack) -> (Cow<'_, PoseTrack>, Vec<String>) {
    let is_late = |pair: &[PoseFrame]| !(pair[0].time_secs < pair[1].time_secs);
    if !track.timed || !track.frames.windows(2).any(is_late) || track.frames.iter().any(|frame| frame.cut) {
        return (Cow::Borrowed(track), Vec::new());
    }
    let mut ordered = track.clone();
    let num_early = track.frames.windows(2).filter(|pair| pair[1].time_secs < pair[0].time_secs).count();
    ordered.frames.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
    ordered.frames.dedup();
    let num_repeated = track.frames.len() - ordered.frames.len();
    let mut lines = Vec::new();
    if num_early > 0 {
        lines.push(format!("the poses are put in order of time (places where the time steps back: {num_early})"));
    }
    if num_repeated > 0 {
        lines.push(format!("poses that are repeated with their times are taken once (repetitions: {num_repeated})"));
    }
    (Cow::Owned(ordered), lines)
}

/// A time that is that of a frame but for rounding becomes exactly that: at a cut that is a hair late the frame would
/// show what is before the cut.
fn on_frame(time_secs: f64, fps: f64) -> f64 {
    let frame_secs = (time_secs * fps).round() / fps;
    let is_rounded = (frame_secs - time_secs).abs() <= ROUNDING_SECS.max(ROUNDING_FRAC * time_secs);
    if is_rounded { frame_secs } else { time_secs }
}

/// The vertical field of view in an image of a size, from that in the default size with the same field of view along the
/// larger side.
fn refitted(fov_y_rad: f64, (width, height): (u32, u32)) -> f64 {
    let larger_over_height = |(width, height): (u32, u32)| (f64::from(width) / f64::from(height)).max(1.0);
    let tangent = (fov_y_rad / 2.0).tan() * larger_over_height(DEFAULT_SIZE_PX) / larger_over_height((width, height));
    2.0 * tangent.atan()
}

/// The vertical field of view in an image of a size, from the horizontal one, rad.
fn upward(across_rad: f64, (width, height): (u32, u32)) -> f64 {
    2.0 * ((across_rad / 2.0).tan() * f64::from(height) / f64::from(width)).atan()
}

/// Replaces what the settings state in a shot.
pub(super) fn overrule(shot: Shot, settings: &ImportSettings) -> Result<Shot, ExportError> {
    let (width, height) = settings.size_px.unwrap_or((shot.width, shot.height));
    let mut shot = Shot { width, height, fps: settings.fps.unwrap_or(shot.fps), ..shot };
    shot.scene.up = settings.up.and_then(DVec3::try_normalize).or(shot.scene.up);
    for key in &mut shot.keyframes {
        key.fov_y_rad = settings.fov_y_rad.unwrap_or(key.fov_y_rad);
    }
    Ok(shot.validated()?)
}

/// The frame rate of a track's own frames.
struct FrameRate {
    /// Stated, found from even times, or chosen for a file without times; `None` if the times are not even.
    own: Option<f64>,
    /// Whether every frame of a film is in the track, and not only its keyframes.
    is_sampled: bool,
}

impl FrameRate {
    fn new(track: &PoseTrack, settings: &ImportSettings) -> Self {
        if !track.timed {
            return Self { own: settings.fps.or(track.fps).or(Some(DEFAULT_FPS)), is_sampled: true };
        }
        if track.fps.is_some() {
            return Self { own: track.fps, is_sampled: track.is_sampled() };
        }
        let own = even_rate(&track.frames);
        Self { own, is_sampled: own.is_some() }
    }

    /// A line about a rate that the file does not state.
    fn line(&self, track: &PoseTrack, settings: &ImportSettings) -> Option<String> {
        match (settings.fps, track.fps.or(self.own.filter(|_| track.timed))) {
            (Some(wanted), Some(own)) if (wanted / own - 1.0).abs() > 1e-9 => {
                Some(format!("the rate of {own} frames per second in the file is replaced by {wanted}"))
            }
            (None, Some(own)) if track.fps.is_none() => {
                Some(format!("the file has no frame rate: its times are even at {own} frames per second"))
            }
            (Some(_), _) | (None, Some(_)) => None,
            (None, None) if !track.timed => {
                Some(format!("the file has no times: {DEFAULT_FPS} frames per second are assumed"))
            }
            (None, None) => Some(format!(
                "the file has no frame rate and its times are not those of a film{}: {DEFAULT_FPS} frames per second \
                 are assumed",
                steps(&track.frames)
            )),
        }
    }
}

/// The shortest and the longest time from frame to frame, in parentheses; empty for one frame.
fn steps(frames: &[PoseFrame]) -> String {
    let steps = frames.windows(2).map(|pair| pair[1].time_secs - pair[0].time_secs);
    let (low, high) = steps.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    if low.is_finite() { format!(" (steps of {low:.4} to {high:.4} s)") } else { String::new() }
}

/// The rate of frames at even times; `None` for uneven times, for keyframes and for one frame.
///
/// The result is the closest usual rate if it explains every time, else the one with the fewest decimals that explains
/// them as well as the mean step does.
fn even_rate(frames: &[PoseFrame]) -> Option<f64> {
    let (first, last) = frames.first().zip(frames.last())?;
    let num_steps = frames.len() as f64 - 1.0;
    let step = (last.time_secs - first.time_secs) / num_steps;
    if !(step > 0.0 && step * MIN_INFERRED_FPS <= 1.0) || frames.iter().any(|frame| frame.easing != Easing::Linear) {
        return None;
    }
    let tolerance = EVEN_SECS.min(EVEN_STEPS * step);
    let off_secs = |step: f64| {
        let off = |(idx, frame): (usize, &PoseFrame)| (frame.time_secs - first.time_secs - idx as f64 * step).abs();
        frames.iter().enumerate().map(off).fold(0.0, f64::max)
    };
    let mean_off_secs = off_secs(step);
    if !(mean_off_secs <= tolerance) {
        return None;
    }
    let film_rates = [24.0, 30.0, 48.0, 60.0, 120.0].map(|fps| fps * 1000.0 / 1001.0);
    let rates = (1..=240).map(f64::from).chain(film_rates);
    let drift_secs = |fps: f64| num_steps * (step - fps.recip()).abs();
    let usual = rates.min_by(|a, b| drift_secs(*a).total_cmp(&drift_secs(*b)));
    let rounded = |decimals: i32| (step.recip() * 10_f64.powi(decimals)).round() / 10_f64.powi(decimals);
    let mut fewest = (0..=RATE_DECIMALS).map(rounded);
    let is_as_near = |fps: &f64| off_secs(fps.recip()) <= 2.0 * mean_off_secs.max(ROUNDING_SECS);
    let found = usual.filter(|fps| drift_secs(*fps) <= tolerance);
    found.or_else(|| fewest.find(is_as_near)).or(Some(step.recip())).filter(|fps| *fps <= MAX_FPS)
}

/// The image size, and a line if the file does not state it.
fn size_px(track: &PoseTrack, settings: &ImportSettings) -> ((u32, u32), Option<String>) {
    match (settings.size_px, track.size_px, track.stated_aspect) {
        (Some(wanted), Some(own), _) if wanted != own => {
            let line = format!(
                "the image size of {} x {} in the file is replaced by {} x {}",
                own.0, own.1, wanted.0, wanted.1
            );
            (wanted, Some(line))
        }
        (Some(size), ..) | (None, Some(size), _) => (size, None),
        (None, None, Some(aspect)) => {
            let height = DEFAULT_SIZE_PX.1;
            let width = (f64::from(height) * aspect).round().clamp(1.0, 65536.0) as u32;
            let line =
                format!("the file has no image size: {width} x {height} is assumed, of its aspect ratio {aspect:.4}");
            ((width, height), Some(line))
        }
        (None, None, None) => {
            let (width, height) = DEFAULT_SIZE_PX;
            (DEFAULT_SIZE_PX, Some(format!("the file has no image size: {width} x {height} is assumed")))
        }
    }
}

/// A line about poses without a vertical field of view, or about fields of view that are replaced.
fn fov_line(track: &PoseTrack, settings: &ImportSettings, (width, height): (u32, u32)) -> Option<String> {
    let num_poses = track.frames.len();
    let has_none = |frame: &&PoseFrame| frame.fov_y_rad.is_none() && frame.fov_x_rad.is_none();
    let num_without = track.frames.iter().filter(has_none).count();
    match settings.fov_y_rad {
        Some(wanted) => {
            let wanted_deg = wanted.to_degrees();
            let own =
                |frame: &PoseFrame| frame.fov_y_rad.or(frame.fov_x_rad.map(|across| upward(across, (width, height))));
            let replaced = track.frames.iter().filter_map(own).filter(|fov| (fov - wanted).abs() > 1e-9);
            let num_replaced = replaced.count();
            (num_replaced > 0).then(|| {
                format!("the field of view of {num_replaced} poses in the file is replaced by {wanted_deg:.3} degrees")
            })
        }
        None if num_without == 0 => track.frames.iter().any(|frame| frame.fov_y_rad.is_none()).then(|| {
            format!("the file states the field of view across the image: that of an image of {width} x {height}")
        }),
        None if num_without == num_poses => {
            Some(format!("the file has no field of view: {DEFAULT_FOV_Y_DEG} degrees is assumed"))
        }
        None => (num_without > 0).then(|| {
            format!("{num_without} of {num_poses} poses have no field of view: {DEFAULT_FOV_Y_DEG} degrees is assumed")
        }),
    }
}
