//! How far other programs stray from a film between its keyframes.

use glam::DVec3;

use super::key_slopes::{CameraValues, KeySlopes, key_slopes, values};
use super::opengl::from_opengl_rotation;
use super::{ExportError, Format, PoseTrack, lichtfeld};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::Shot;

/// How a program joins keys.
enum Curve {
    /// Straight lines, and rotations at constant speed.
    Linear,
    /// A cubic spline through the keys whose slope at a key is that between its neighbors; of rotations the same, by
    /// components.
    Spline,
    /// Cubic curves with the slopes of the film at the keys; of rotations the same, by components; of lenses the focal
    /// lengths.
    Bezier(Vec<KeySlopes>),
    /// Positions by that spline with a key's easing, keys counting as evenly spaced; rotations and lens straight.
    EasedSpline,
}

fn curve_of(format: Format, shot: &Shot) -> Result<Option<Curve>, ExportError> {
    Ok(match format {
        Format::Gltf | Format::Usd => Some(Curve::Linear),
        Format::Nerfstudio | Format::Supersplat => Some(Curve::Spline),
        Format::Lichtfeld => Some(Curve::EasedSpline),
        Format::Blender => Some(Curve::Bezier(key_slopes(shot)?)),
        // The rest holds poses alone.
        _ => None,
    })
}

/// A line about the largest difference between the film and the curve of a format's program through the keys alone; `None`
/// if the program draws no curve.
///
/// # Errors
/// [`ExportError::BadShot`] if the shot is not usable.
pub(super) fn line(format: Format, shot: &Shot) -> Result<Option<String>, ExportError> {
    let Some(curve) = curve_of(format, shot)? else { return Ok(None) };
    let film = PoseTrack::sampled(shot, None)?;
    let keys = PoseTrack::keyframes(shot);
    let (mut moved, mut turned, mut zoomed, mut worst_secs) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
    for frame in &film.frames {
        let after = keys.frames.partition_point(|key| key.time_secs <= frame.time_secs);
        let (Some(from), true) = (after.checked_sub(1), after < keys.frames.len()) else { continue };
        if keys.frames[after].cut {
            continue;
        }
        let (position, turn, fov) = between(&curve, &keys, from, frame.time_secs);
        let off = position.distance(frame.pose.position);
        if off > moved {
            (moved, worst_secs) = (off, frame.time_secs);
        }
        turned = turned.max(rotation::angle_between(turn, frame.pose.rotation));
        zoomed = zoomed.max((fov - frame.fov_y_rad.unwrap_or(fov)).abs());
    }
    let what = match curve {
        Curve::Linear => "lines",
        Curve::Spline | Curve::EasedSpline => "its own spline",
        Curve::Bezier(_) => "Bezier curves of the film's slopes",
    };
    let (program, exact) = match format {
        Format::Nerfstudio => {
            ("nerfstudio's viewer", "`ns-render` renders the film's frames, which the file holds, too")
        }
        _ => (format.into(), "export every frame for the path of the film"),
    };
    Ok(Some(format!(
        "{program} joins keyframes with {what}: up to {moved:.4} scene units (at {worst_secs:.2} s), {:.2} degrees and a \
         field of view {:.2} degrees off the film; {exact}",
        turned.to_degrees(),
        zoomed.to_degrees()
    )))
}

/// Position, rotation and field of view at a time between key `from` and the next.
fn between(curve: &Curve, keys: &PoseTrack, from: usize, time_secs: f64) -> (DVec3, glam::DQuat, f64) {
    let frames = &keys.frames;
    let (a, b) = (&frames[from], &frames[from + 1]);
    let span = b.time_secs - a.time_secs;
    let t = if span > 0.0 { (time_secs - a.time_secs) / span } else { 0.0 };
    let fov = |idx: usize| frames[idx].fov_y_rad.unwrap_or(1.0);
    match curve {
        Curve::Linear => {
            let pose = a.pose.between(&b.pose, t);
            (pose.position, pose.rotation, fov(from) + (fov(from + 1) - fov(from)) * t)
        }
        Curve::Bezier(slopes) => {
            let [low, high] = [(from, slopes[from].after), (from + 1, slopes[from + 1].before)]
                .map(|(idx, slope)| with_focal(&values(&frames[idx]), &slope));
            let v = cubic(low, high, span, t);
            let turn = glam::DQuat::from_xyzw(v[3], v[4], v[5], v[6]).normalize();
            let pose = from_opengl_rotation(DVec3::new(v[0], v[1], v[2]), turn);
            (pose.position, pose.rotation, 2.0 * (1.0 / v[7]).atan())
        }
        Curve::EasedSpline => {
            let t = lichtfeld::eased(a.easing, t);
            let at = |idx: usize| frames[idx.min(frames.len() - 1)].pose.position;
            let (before, after) = (at(from.saturating_sub(1)), at(from + 2));
            let (low, high) = (a.pose.position, b.pose.position);
            let point = low * (2.0 + t * t * (3.0 * t - 5.0))
                + high * (t * (1.0 + t * (4.0 - 3.0 * t)))
                + before * (t * (t * (2.0 - t) - 1.0))
                + after * (t * t * (t - 1.0));
            let turn = rotation::slerp(a.pose.rotation, b.pose.rotation, t);
            // The file holds focal lengths.
            let focal = |idx: usize| 1.0 / (fov(idx) / 2.0).tan();
            let lens = focal(from) + (focal(from + 1) - focal(from)) * t;
            (point / 2.0, turn, 2.0 * (1.0 / lens).atan())
        }
        Curve::Spline => {
            let turns = rotation::aligned(&frames.iter().map(|frame| frame.pose.rotation).collect::<Vec<_>>());
            let values = |idx: usize| -> [f64; 8] {
                let (p, q) = (frames[idx].pose.position, turns[idx]);
                [p.x, p.y, p.z, q.x, q.y, q.z, q.w, fov(idx)]
            };
            let v = hermite(&values, frames.len(), |idx| frames[idx].time_secs, from, t);
            (DVec3::new(v[0], v[1], v[2]), glam::DQuat::from_xyzw(v[3], v[4], v[5], v[6]).normalize(), v[7])
        }
    }
}

/// Numbers of a camera and their slopes, with focal lengths over half the frame's height in place of fields of view.
fn with_focal(values: &CameraValues, slopes: &CameraValues) -> (CameraValues, CameraValues) {
    let (mut values, mut slopes, half) = (*values, *slopes, values[7] / 2.0);
    slopes[7] *= -0.5 / half.sin().powi(2);
    values[7] = 1.0 / half.tan();
    (values, slopes)
}

/// The cubic curve between two keys, of which the values and their slopes per second are known, at a fraction of its time.
fn cubic(low: (CameraValues, CameraValues), high: (CameraValues, CameraValues), secs: f64, t: f64) -> CameraValues {
    let ((a, da), (mut b, mut db)) = (low, high);
    // The script turns the sign of a rotation to that of the one before.
    if (3..7).map(|k| a[k] * b[k]).sum::<f64>() < 0.0 {
        for k in 3..7 {
            (b[k], db[k]) = (-b[k], -db[k]);
        }
    }
    let (t2, t3) = (t * t, t * t * t);
    std::array::from_fn(|k| {
        a[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + secs * da[k] * (t3 - 2.0 * t2 + t)
            + b[k] * (3.0 * t2 - 2.0 * t3)
            + secs * db[k] * (t3 - t2)
    })
}

/// The cubic Hermite curve from key `from` to the next, with slopes between neighbors, at a fraction `t`.
fn hermite(
    values: &impl Fn(usize) -> [f64; 8],
    count: usize,
    time_of: impl Fn(usize) -> f64,
    from: usize,
    t: f64,
) -> [f64; 8] {
    let span = time_of(from + 1) - time_of(from);
    let slope = |idx: usize| -> [f64; 8] {
        let (low, high) = (idx.saturating_sub(1), (idx + 1).min(count - 1));
        let secs = time_of(high) - time_of(low);
        let (a, b) = (values(low), values(high));
        std::array::from_fn(|k| if secs > 0.0 { (b[k] - a[k]) / secs * span } else { 0.0 })
    };
    let (a, b, da, db) = (values(from), values(from + 1), slope(from), slope(from + 1));
    let (t2, t3) = (t * t, t * t * t);
    std::array::from_fn(|k| {
        a[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + da[k] * (t3 - 2.0 * t2 + t)
            + b[k] * (3.0 * t2 - 2.0 * t3)
            + db[k] * (t3 - t2)
    })
}
