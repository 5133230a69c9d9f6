//! Exposures whose pictures are so near each other that one projection and one depth order serve all of them.
//!
//! Enters: the camera in the middle of an exposure and the cameras around it. Leaves: where the mean of a splat is in the
//! pictures of these cameras. Shape, color and order of the splats are those of the middle: over a few pixels of motion, or
//! of a circle of confusion, they do not change. A tile whose splats hardly move takes fewer cameras than one in which they
//! move far.

use glam::{DMat3, DVec3};

use super::RenderError;
use super::blur::{SplatBlur, SubFrame};
use super::error::check_len;
use super::groups::{LANES, Lane};
use super::splat::Splat;
use cinesplat_geometry::Camera;

/// The share of the small splats of a tile that may move further than its pattern is made for.
const BEYOND_FRAC: f64 = 0.01;
/// Half a size from which on a splat is not small, pixels: a quarter of a tile.
const LARGE_PX: f32 = 4.0;
/// Pixels by which a splat may be further than the cameras at the ends of the exposure say: paths are no straight lines.
const SLACK_PX: f32 = 0.25;

/// An exposure around a camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// The camera in the middle.
    pub center: Camera,
    /// Blur of the splats of every picture.
    pub blur: SplatBlur,
    /// The cameras at the ends of the exposure. Between their pictures lies every other one.
    pub ends: Vec<Camera>,
    /// Samples of the exposure, the fewest first.
    pub patterns: Vec<SweepPattern>,
}

/// Samples of an exposure.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPattern {
    /// Largest motion over the whole exposure that the samples are made for, pixels; the last pattern serves any motion.
    pub up_to_px: f64,
    /// Share of the middle of the exposure in the light; may be 0.
    pub center_weight: f64,
    /// The other cameras, each with its share.
    pub around: Vec<(Camera, f64)>,
}

impl SweepPattern {
    /// Number of pictures with a share in the light.
    pub fn num_samples(&self) -> usize {
        self.around.len() + usize::from(self.center_weight > 0.0)
    }
}

impl Sweep {
    /// Number of pictures of the largest pattern, at least 1.
    pub fn num_samples(&self) -> usize {
        self.patterns.last().map_or(1, SweepPattern::num_samples).max(1)
    }

    /// The middle of the exposure.
    pub(super) fn middle(&self) -> SubFrame {
        SubFrame { camera: self.center, blur: self.blur }
    }

    /// The pictures of the largest pattern, each with its share.
    pub(super) fn subframes(&self) -> Vec<(SubFrame, f32)> {
        let middle = self.middle();
        let Some(last) = self.patterns.last() else { return vec![(middle, 1.0)] };
        let center = (last.center_weight > 0.0).then_some((self.center, last.center_weight));
        let cameras = center.into_iter().chain(last.around.iter().copied());
        cameras.map(|(camera, weight)| (SubFrame { camera, ..middle }, weight as f32)).collect()
    }
}

/// A sweep in the form that rendering needs.
#[derive(Debug)]
pub(super) struct ViewSweep {
    ends: Vec<Sample>,
    patterns: Vec<ViewPattern>,
    /// Largest distance of a camera from the middle, scene units, and largest sum of the lengths of the columns by which
    /// the rotations differ.
    apart: f64,
    turn: f64,
    /// Largest focal length, and largest differences of the focal lengths and of the principal points, pixels.
    focal_px: f64,
    zoom_px: f64,
    shift_px: f64,
    near: f64,
}

/// See [`SweepPattern`].
#[derive(Debug)]
pub(super) struct ViewPattern {
    up_to_px: f32,
    pub(super) center_weight: f32,
    pub(super) around: Vec<Sample>,
}

/// A camera of a sweep: with the pixel (x, y) and the depth z of a point in the middle picture, the rows times (x, y, 1, 1 /
/// z) are its homogeneous pixel in the camera's picture, and the last of them is also its depth over z.
#[derive(Debug)]
pub(super) struct Sample {
    rows: [[f32; 4]; 3],
    near: f32,
    pub(super) weight: f32,
}

/// How far splats move from their places in the middle picture: to the left, to the right, up and down, pixels. With slack.
pub(super) type Reaches = [Lane; 4];

/// How far one of 16 splats moves altogether, pixels.
pub(super) fn swept_px([left, right, up, down]: &Reaches, lane: usize) -> f32 {
    let [across, downwards] =
        [left[lane] + right[lane], up[lane] + down[lane]].map(|way| (way - 2.0 * SLACK_PX).max(0.0));
    (across * across + downwards * downwards).sqrt()
}

impl ViewSweep {
    /// A sweep in pictures with this near plane.
    ///
    /// # Errors
    /// [`RenderError::Camera`] for an unusable camera.
    pub(super) fn new(sweep: &Sweep, near: f64) -> Result<Self, RenderError> {
        let Sweep { center, ends, patterns, .. } = sweep;
        let sample = |camera: &Camera, weight: f64| Sample::new((center, camera), near, weight);
        let pattern = |pattern: &SweepPattern| {
            let around =
                pattern.around.iter().map(|(camera, weight)| sample(camera, *weight)).collect::<Result<_, _>>();
            let (up_to_px, center_weight) = (pattern.up_to_px as f32, pattern.center_weight as f32);
            Ok(ViewPattern { up_to_px, center_weight, around: around? })
        };
        let largest = |of: &dyn Fn(&Camera) -> f64| ends.iter().map(of).fold(0.0, f64::max);
        let focal = |camera: &Camera| camera.intrinsics.fx_px.max(camera.intrinsics.fy_px);
        let turn = |camera: &Camera| {
            let apart = DMat3::from_quat(camera.pose.rotation) - DMat3::from_quat(center.pose.rotation);
            apart.x_axis.length() + apart.y_axis.length() + apart.z_axis.length()
        };
        let (own, difference) = (center.intrinsics, |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]));
        Ok(Self {
            ends: ends.iter().map(|camera| sample(camera, 0.0)).collect::<Result<_, _>>()?,
            patterns: patterns.iter().map(pattern).collect::<Result<_, RenderError>>()?,
            apart: largest(&|camera| camera.pose.position.distance(center.pose.position)),
            turn: largest(&turn),
            focal_px: largest(&focal).max(focal(center)),
            zoom_px: largest(&|Camera { intrinsics: i, .. }| difference([i.fx_px, i.fy_px], [own.fx_px, own.fy_px])),
            shift_px: largest(&|Camera { intrinsics: i, .. }| difference([i.cx_px, i.cy_px], [own.cx_px, own.cy_px])),
            near,
        })
    }

    /// Upper bound of the way of any member of a group from its place in the middle picture, pixels. `center` is the
    /// center of the group's sphere in the axes of the middle camera.
    pub(super) fn max_reach_px(&self, center: DVec3, radius: f64) -> f64 {
        let size = center.length() + radius;
        let apart = self.apart + self.turn * size;
        let depth = (center.z - radius - apart).max(self.near).max(f64::MIN_POSITIVE);
        let slope = (size + apart) / depth;
        self.focal_px * apart * (1.0 + slope) / depth + self.zoom_px * slope + self.shift_px
    }

    /// Writes how far each of 16 splats moves.
    #[inline(always)]
    pub(super) fn reaches(&self, mean_px: &[Lane; 2], depth: &Lane, reaches: &mut Reaches) {
        let [left, right, up, down] = reaches;
        [&mut *left, right, up, down].into_iter().for_each(|side| side.fill(SLACK_PX));
        for end in &self.ends {
            let [[ux, uy, u1, uz], [vx, vy, v1, vz], [wx, wy, w1, wz]] = end.rows;
            for lane in 0..LANES {
                let (x, y, depth) = (mean_px[0][lane], mean_px[1][lane], depth[lane]);
                let inverse_depth = 1.0 / depth;
                let w = wx * x + wy * y + w1 + wz * inverse_depth;
                let is_seen = w * depth > end.near;
                let scale = 1.0 / w;
                let right_px = (ux * x + uy * y + u1 + uz * inverse_depth) * scale - x;
                let down_px = (vx * x + vy * y + v1 + vz * inverse_depth) * scale - y;
                let (right_px, down_px) = (if is_seen { right_px } else { 0.0 }, if is_seen { down_px } else { 0.0 });
                left[lane] = left[lane].max(SLACK_PX - right_px);
                right[lane] = right[lane].max(SLACK_PX + right_px);
                up[lane] = up[lane].max(SLACK_PX - down_px);
                down[lane] = down[lane].max(SLACK_PX + down_px);
            }
        }
    }

    /// The pattern of a tile with these splats; `None` where the middle picture is enough.
    pub(super) fn pattern_of<'a>(&self, splats: impl Iterator<Item = &'a Splat>) -> Option<&ViewPattern> {
        let mut beyond = vec![0_usize; self.patterns.len()];
        let (mut num, mut furthest_px) = (0_usize, 0.0_f32);
        for splat in splats {
            let swept = splat.swept_px;
            num += 1;
            if splat.half_px[0].max(splat.half_px[1]) > LARGE_PX {
                furthest_px = furthest_px.max(swept);
            }
            // Patterns grow with the motion.
            beyond
                .iter_mut()
                .zip(&self.patterns)
                .take_while(|(_, pattern)| swept > pattern.up_to_px)
                .for_each(|(count, _)| *count += 1);
        }
        let allowed = (num as f64 * BEYOND_FRAC) as usize;
        let is_enough = |(count, pattern): (&usize, &ViewPattern)| *count <= allowed && furthest_px <= pattern.up_to_px;
        let fits = beyond.iter().zip(&self.patterns).position(is_enough);
        fits.map_or(self.patterns.last(), |idx| self.patterns.get(idx))
    }
}

impl Sample {
    fn new((center, camera): (&Camera, &Camera), near: f64, weight: f64) -> Result<Self, RenderError> {
        let (from, to) = (center.intrinsics.validated()?, camera.intrinsics.validated()?);
        check_len("pixels across a sub-frame", to.width as usize, from.width as usize)?;
        check_len("pixels down a sub-frame", to.height as usize, from.height as usize)?;
        let ray_from_px = DMat3::from_cols(
            DVec3::new(1.0 / from.fx_px, 0.0, 0.0),
            DVec3::new(0.0, 1.0 / from.fy_px, 0.0),
            DVec3::new(-from.cx_px / from.fx_px, -from.cy_px / from.fy_px, 1.0),
        );
        let px_from_ray = DMat3::from_cols(
            DVec3::new(to.fx_px, 0.0, 0.0),
            DVec3::new(0.0, to.fy_px, 0.0),
            DVec3::new(to.cx_px, to.cy_px, 1.0),
        );
        let rotation = DMat3::from_quat(camera.pose.rotation.conjugate() * center.pose.rotation);
        let offset = camera.pose.rotation.conjugate() * (center.pose.position - camera.pose.position);
        let rows = (px_from_ray * rotation * ray_from_px).transpose();
        let offset = px_from_ray * offset;
        let row = |row: DVec3, offset: f64| {
            let [x, y, one] = row.as_vec3().to_array();
            [x, y, one, offset as f32]
        };
        let rows = [row(rows.x_axis, offset.x), row(rows.y_axis, offset.y), row(rows.z_axis, offset.z)];
        if !rows.as_flattened().iter().all(|value| value.is_finite()) {
            return Err(RenderError::Setting { name: "camera pose", found: f64::NAN, expected: "finite numbers" });
        }
        Ok(Self { rows, near: near as f32, weight: weight as f32 })
    }

    /// The pixel of a point, and whether it is in front of the near plane.
    #[inline(always)]
    fn place(&self, [x, y]: [f32; 2], depth: f32) -> ([f32; 2], bool) {
        let inverse_depth = 1.0 / depth;
        let [u, v, w] = self.rows.map(|row| row[0] * x + row[1] * y + row[2] + row[3] * inverse_depth);
        ([u / w, v / w], w * depth > self.near)
    }

    /// Moves a splat of the middle picture to its place in this one; behind the near plane it covers nothing.
    #[inline(always)]
    pub(super) fn move_splat(&self, splat: &mut Splat) {
        let (place, is_seen) = self.place(splat.mean_px, splat.depth);
        if is_seen {
            splat.mean_px = place;
        } else {
            splat.half_px[1] = f32::NEG_INFINITY;
        }
    }
}
