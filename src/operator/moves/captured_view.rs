//! Views of a room of which only a part was captured: from where the scan's own cameras may have stood, through the lens that
//! gives the wanted size. From there the picture is full and sharp; farther aside it ends in void.

use super::context::StepContext;
use crate::framing::{Fill, Target, extent_frac};
use crate::program::Framing;
use crate::view::{aimed, fill_in, lerp, with_fov};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::CameraState;

/// Value of parameter 0 below which a view is taken from a viewpoint of the capture.
const FROM_VIEWPOINT: f64 = 0.25;
/// Share of the way from the viewpoint to the subject that the camera goes.
const NEARER: (f64, f64) = (0.0, 0.5);
/// Vertical field of view of such a view, degrees.
const LENS_DEG: (f64, f64) = (11.0, 60.0);

/// A view of a target from a viewpoint of the capture; `None` in whole rooms, where the words say how the subject is seen,
/// where the lens would be an odd one, and for most values of the parameter.
pub(super) fn captured_view(
    context: &StepContext,
    target: &Target,
    framing: &Framing,
    fill: (f64, f64),
) -> Option<CameraState> {
    let (world, parameters) = (context.world, &context.parameters);
    let is_said = framing.angle.is_some() || framing.elevation_deg.is_some() || framing.height.is_some();
    let is_placed = framing.side.is_some() || framing.distance.is_some() || framing.lens.is_some() || framing.hidden;
    if parameters[0] >= FROM_VIEWPOINT || target.ids.is_empty() || is_said || is_placed || !world.is_partial() {
        return None;
    }
    let viewpoints = world.viewpoints();
    let pick = (parameters[0] / FROM_VIEWPOINT * viewpoints.len() as f64) as usize;
    let viewpoint = viewpoints.get(pick).copied()?;
    let position = viewpoint.lerp(target.aim, lerp(NEARER, parameters[3]));
    let any = CameraState {
        pose: Pose { position, rotation: glam::DQuat::IDENTITY },
        fov_y_rad: 40.0_f64.to_radians(),
        focus_distance: None,
    };
    let view = aimed(world, &any, target.aim);
    let extent = extent_frac(world, &view, &target.corners);
    let fill = fill_in(world, framing, parameters[2]).unwrap_or(Fill::Fit(lerp(fill, parameters[2])));
    let (now, wanted) = match fill {
        Fill::Height(wanted) => (extent.y, wanted),
        Fill::Fit(wanted) => (extent.max_element(), wanted),
    };
    let fov_y_rad = 2.0 * ((view.fov_y_rad / 2.0).tan() * now / wanted).atan();
    (LENS_DEG.0..=LENS_DEG.1).contains(&fov_y_rad.to_degrees()).then(|| with_fov(&view, fov_y_rad))
}
