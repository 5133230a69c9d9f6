//! View cones: the part of space that a camera sees, up to a depth, projected onto the page.

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::CameraState;
use glam::{DVec2, DVec3};

use crate::panel::Panel;

/// Outline of the cone on the page, px: the convex hull of the camera's position and of the frame's corners at a depth (scene
/// units). Seen from above, the cone of a level camera opens by its horizontal field of view.
pub(crate) fn outline_px(panel: &Panel, state: &CameraState, frame_size: [u32; 2], depth: f64) -> Vec<DVec2> {
    let [width, height] = frame_size;
    let intrinsics = Intrinsics::from_fov_y(width, height, state.fov_y_rad);
    let camera = Camera { pose: state.pose, intrinsics };
    let forward = state.pose.rotation * DVec3::Z;
    let (right, bottom) = (f64::from(width), f64::from(height));
    let corners = [(0.0, 0.0), (right, 0.0), (right, bottom), (0.0, bottom)].map(|(x, y)| {
        let ray = camera.ray(DVec2::new(x, y));
        state.pose.position + ray * (depth / ray.dot(forward))
    });
    hull(corners.into_iter().chain([state.pose.position]).map(|point| panel.to_px(point)).collect())
}

/// Convex hull of points, counter-clockwise in a frame with y upward (Andrew 1979).
pub(crate) fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(point - a) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}
