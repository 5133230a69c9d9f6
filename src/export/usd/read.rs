use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::super::ExportError;
use super::super::opengl::{from_opengl_rotation, y_up_from_world};
use super::super::track::{PoseFrame, PoseTrack};
use super::super::which_camera::which;
use super::binary;
use super::curves::{Curves, SAMPLES, is_operation, quaternion};
use super::layer::{Prim, Value};
use super::package;
use super::parse::parse;
use super::write::HOLD_CODES;
use cinesplat_geometry::rotation;

/// USD's defaults for a camera, tenths of a scene unit.
const DEFAULT_FOCAL: f64 = 50.0;
const DEFAULT_FILM_WIDTH: f64 = 20.955;
const DEFAULT_FILM_HEIGHT: f64 = 15.2908;
const DEFAULT_CODES_PER_SECOND: f64 = 24.0;
/// What a layer without a camera is told.
const NO_CAMERA: &str = "no camera in this layer: `usdcat --flatten IN -o out.usda` joins the files that it refers to";

/// The track of the camera with a name or a path, or of the first one.
pub(crate) fn read(bytes: &[u8], wanted: Option<&str>) -> Result<PoseTrack, ExportError> {
    let not_readable = |reason: &str| ExportError::NotReadable { format: "usd", reason: reason.to_owned() };
    let unpacked;
    let bytes = if bytes.starts_with(b"PK") {
        unpacked = package::layer(bytes)?;
        &unpacked
    } else {
        bytes
    };
    let layer = if bytes.starts_with(binary::MAGIC) {
        binary::parse(bytes)?
    } else {
        parse(std::str::from_utf8(bytes).map_err(|_| not_readable("the text is not UTF-8"))?)?
    };
    let mut cameras = Vec::new();
    find_cameras(&layer, &[], &mut cameras);
    if cameras.is_empty() {
        return Err(not_readable(NO_CAMERA));
    }
    let (place, others) = which_of(&cameras, wanted)?;
    let (above, camera) = cameras.swap_remove(place);
    let lens = Curves::new(camera)?;
    let moving = above.iter().map(|prim| Curves::new(prim)).collect::<Result<Vec<_>, _>>()?;
    let meta = |name: &str| layer.meta(name).and_then(Value::number).filter(|v| *v > 0.0);
    let fps = meta("timeCodesPerSecond").or(meta("framesPerSecond")).unwrap_or(DEFAULT_CODES_PER_SECOND);
    let up = layer.meta("customLayerData").and_then(|data| data.get("cinesplat_world_up")?.numbers()?.try_into().ok());
    let up = up.map(DVec3::from_array).and_then(DVec3::try_normalize);
    let stage_up = if layer.meta("upAxis") == Some(&Value::Text("Z".into())) { DVec3::Z } else { DVec3::Y };
    let world_from_stage = y_up_from_world(up).conjugate();
    let codes = code_list(camera, &above);
    let frames = codes.iter().map(|code| {
        let code = *code;
        let placed = moving.iter().chain([&lens]).try_fold(DAffine3::IDENTITY, |world, prim| {
            let world = if prim.resets_stack { DAffine3::IDENTITY } else { world };
            Some(world * local(prim, code)?)
        });
        let placed = placed.ok_or_else(|| not_readable("an unknown transform operation"))?;
        frame(&lens, code, fps, DAffine3::from_quat(world_from_stage) * placed)
    });
    let frames = drop_holds(frames.collect::<Result<Vec<_>, _>>()?, fps);
    Ok(PoseTrack {
        size_px: resolution(&layer),
        stated_aspect: codes.first().and_then(|code| film_aspect(&lens, *code)),
        fps: Some(fps),
        up: up.or(Some(stage_up)),
        timed: true,
        unread: others.into_iter().chain(lens_losses(camera, &lens, &codes)).collect(),
        ..PoseTrack::untimed(frames)
    })
}

/// All cameras, depth first, each with the prims above it.
fn find_cameras<'a>(prim: &'a Prim, above: &[&'a Prim], found: &mut Vec<(Vec<&'a Prim>, &'a Prim)>) {
    for child in &prim.children {
        if child.kind == "Camera" {
            found.push((above.to_vec(), child));
        }
        find_cameras(child, &[above, &[child]].concat(), found);
    }
}

/// The place of the camera with a name or a path in the layer, or 0, and a line about the others.
fn which_of(cameras: &[(Vec<&Prim>, &Prim)], wanted: Option<&str>) -> Result<(usize, Option<String>), ExportError> {
    let path = |(above, camera): &(Vec<&Prim>, &Prim)| {
        above.iter().chain([camera]).fold(String::new(), |path, prim| path + "/" + &prim.name)
    };
    let paths: Vec<String> = cameras.iter().map(path).collect();
    let by_name = cameras.iter().position(|(_, camera)| Some(camera.name.as_str()) == wanted);
    match by_name {
        Some(place) => Ok((place, None)),
        None => which(&paths.iter().map(String::as_str).collect::<Vec<_>>(), wanted),
    }
}

/// Width over height of the film at a time code, if the camera states either.
fn film_aspect(lens: &Curves<'_>, code: f64) -> Option<f64> {
    let number = |name: &str| lens.numbers_at(name, code).and_then(|v| v.first().copied()).filter(|v| *v > 0.0);
    let (width, height) = (number("horizontalAperture"), number("verticalAperture"));
    let is_stated = width.is_some() || height.is_some();
    is_stated.then(|| width.unwrap_or(DEFAULT_FILM_WIDTH) / height.unwrap_or(DEFAULT_FILM_HEIGHT))
}

/// What a film with a perspective lens does not have of a camera: shifts of the lens, and a lens without perspective.
fn lens_losses(camera: &Prim, lens: &Curves<'_>, codes: &[f64]) -> Vec<String> {
    let shift = |(name, film, default): (&str, &str, f64)| {
        let at = |code: &f64| {
            let number = |name: &str| lens.numbers_at(name, *code).and_then(|v| v.first().copied());
            number(name).unwrap_or(0.0).abs() / number(film).filter(|v| *v > 0.0).unwrap_or(default)
        };
        codes.iter().map(at).fold(0.0, f64::max)
    };
    let most = [
        ("horizontalApertureOffset", "horizontalAperture", DEFAULT_FILM_WIDTH),
        ("verticalApertureOffset", "verticalAperture", DEFAULT_FILM_HEIGHT),
    ]
    .map(shift)
    .into_iter()
    .fold(0.0, f64::max);
    let mut lines = Vec::new();
    if most > 1e-6 {
        lines.push(format!("the shift of the lens, up to {:.2} % of the film, is not read", 100.0 * most));
    }
    if camera.attribute("projection") == Some(&Value::Text("orthographic".into())) {
        lines.push("the camera is orthographic: its path is read, with a perspective lens".to_owned());
    }
    lines
}

/// All time codes with a sample of the camera, or of a transform of the prims above it; 0 alone without samples.
fn code_list(camera: &Prim, above: &[&Prim]) -> Vec<f64> {
    let own = camera.attributes.iter();
    let of_above = above.iter().flat_map(|prim| prim.attributes.iter().filter(|(name, _)| is_operation(name)));
    let samples = own.chain(of_above).filter(|(name, _)| name.ends_with(SAMPLES));
    let keys = samples.flat_map(|(_, value)| if let Value::Map(entries) = value { entries.as_slice() } else { &[] });
    let mut codes: Vec<f64> =
        keys.filter_map(|(key, _)| key.parse().ok()).filter(|code: &f64| code.is_finite()).collect();
    codes.sort_by(f64::total_cmp);
    codes.dedup();
    if codes.is_empty() { vec![0.0] } else { codes }
}

/// A prim's transform into its parent at a time code; `None` for an unknown operation.
fn local(prim: &Curves<'_>, code: f64) -> Option<DAffine3> {
    prim.order.as_ref()?.iter().try_fold(DAffine3::IDENTITY, |placed, (name, is_inverse)| {
        let done = operation(name, &prim.numbers_at(name, code)?)?;
        Some(placed * if *is_inverse { done.inverse() } else { done })
    })
}

fn operation(name: &str, v: &[f64]) -> Option<DAffine3> {
    let kind = name.strip_prefix("xformOp:")?.split(':').next()?;
    let vector = || v.try_into().ok().map(DVec3::from_array);
    let about = |axis: char, degrees: f64| match axis {
        'X' => DQuat::from_rotation_x(degrees.to_radians()),
        'Y' => DQuat::from_rotation_y(degrees.to_radians()),
        _ => DQuat::from_rotation_z(degrees.to_radians()),
    };
    match kind {
        "translate" => Some(DAffine3::from_translation(vector()?)),
        "scale" => Some(DAffine3::from_scale(vector()?)),
        "orient" => Some(DAffine3::from_quat(quaternion(v)?)),
        // USD multiplies row vectors from the left: rows of the text are columns here.
        "transform" => v.try_into().ok().map(|m: [f64; 16]| DAffine3::from_mat4(DMat4::from_cols_array(&m))),
        "rotateX" | "rotateY" | "rotateZ" => Some(DAffine3::from_quat(about(kind.chars().last()?, *v.first()?))),
        _ if kind.len() == 9 && kind.starts_with("rotate") && v.len() == 3 => {
            // rotateXYZ rotates about x first, which is the last factor for column vectors.
            let turn = kind[6..].chars().fold(DQuat::IDENTITY, |turn, axis| {
                let idx = "XYZ".find(axis).unwrap_or(2);
                about(axis, v[idx]) * turn
            });
            Some(DAffine3::from_quat(turn))
        }
        _ => None,
    }
}

fn frame(camera: &Curves<'_>, code: f64, fps: f64, placed: DAffine3) -> Result<PoseFrame, ExportError> {
    // A scale above the camera changes its position, not its field of view.
    let axes = placed.matrix3;
    let unit = DMat3::from_cols(
        axes.x_axis.normalize_or_zero(),
        axes.y_axis.normalize_or_zero(),
        axes.z_axis.normalize_or_zero(),
    );
    let turn = rotation::from_matrix(unit).map_err(|error| ExportError::BadField {
        place: format!("the camera at time code {code}"),
        found: error.to_string(),
        expected: "a rigid pose".into(),
    })?;
    let number = |name: &str| camera.numbers_at(name, code).and_then(|v| v.first().copied()).filter(|v| *v > 0.0);
    let focal = number("focalLength").unwrap_or(DEFAULT_FOCAL);
    let film_height = number("verticalAperture").unwrap_or(DEFAULT_FILM_HEIGHT);
    let pose = from_opengl_rotation(placed.translation, turn);
    let fov_y_rad = Some(2.0 * (film_height / 2.0 / focal).atan());
    Ok(PoseFrame { fov_y_rad, focus_distance: number("focusDistance"), ..PoseFrame::new(code / fps, pose) })
}

/// Frames without those that only hold a pose up to a cut; the frame after such a hold is marked as a cut.
fn drop_holds(frames: Vec<PoseFrame>, fps: f64) -> Vec<PoseFrame> {
    let mut kept: Vec<PoseFrame> = Vec::with_capacity(frames.len());
    for frame in frames {
        let cut = kept.pop_if(|held| (frame.time_secs - held.time_secs) * fps < 2.0 * HOLD_CODES).is_some();
        kept.push(PoseFrame { cut, ..frame });
    }
    kept
}

/// Image size of the first render settings.
fn resolution(layer: &Prim) -> Option<(u32, u32)> {
    fn settings(prim: &Prim) -> Option<&Prim> {
        prim.children
            .iter()
            .find_map(|child| if child.kind == "RenderSettings" { Some(child) } else { settings(child) })
    }
    let [width, height] = settings(layer)?.attribute("resolution")?.numbers()?.try_into().ok()?;
    let in_range = |v: f64| (1.0..=65536.0).contains(&v);
    (in_range(width) && in_range(height)).then_some((width as u32, height as u32))
}
