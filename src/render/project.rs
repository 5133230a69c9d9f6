//! Gaussians to splats, 16 at a time.
//!
//! Enters: the Gaussians of one group and a view. Leaves: the splats that overlap the picture. Depth and center are
//! computed in `f64` and rounded once, so that the depth order equals that of the spec image. Shapes are computed in
//! `f32` by V = J W R S and the Cauchy-Binet determinant (see [`super::reference::project`]), which is exact for
//! needles.

use glam::{DVec3, Vec3};
use pulp::{Simd, WithSimd};

use super::batch::Batch;
use super::groups::{Group, LANES, Lane, Pack};
use super::logarithm::log2;
use super::splat::{EXPONENT_DIVISOR, Splat, whitening_unit};
use super::spread::Spread;
use super::sweep::{Reaches, ViewSweep, swept_px};
use super::tiles::{TILE_PX, TileGrid};
use super::{View, harmonics, reference};
use cinesplat_scene::Gaussians;

/// Upper bound of the dilation's share in the radius of a splat, in pixels: 5.3 standard deviations (for the smallest
/// allowed alpha cut) of sqrt(0.3) pixels, with slack.
const MARGIN_PX: f64 = 4.0;

/// The splats of 16 Gaussians, one array per attribute. `visibility` is 1 for a splat that is drawn, 0 for one that is
/// not, and NaN if `f32` overflowed.
#[derive(Default)]
struct Outputs {
    visibility: Lane,
    depth: Lane,
    mean_px: [Lane; 2],
    whiten: [Lane; 3],
    level: Lane,
    reach: Lane,
    half_px: [Lane; 2],
    skew_px: Lane,
    /// See [`Splat::tile_rect`].
    tile_rect: [[u16; LANES]; 4],
    /// Blur; see [`AddedVariance`]. Zeros without blur.
    disk_px2: [Lane; 2],
    smear_px: [Lane; 2],
    /// How far the splats move in a sweep. Zeros without one.
    reaches: Reaches,
}

/// Projects the members of one group, with or without blur, for one picture or for all pictures of a sweep; compiled for
/// every instruction set.
struct GroupMembers<'a, const IS_BLURRED: bool, const IS_SWEPT: bool> {
    projection: &'a Projection<'a>,
    gaussians: &'a Gaussians,
    packs: &'a [Pack],
    batch: &'a mut Batch,
}

impl<const IS_BLURRED: bool, const IS_SWEPT: bool> WithSimd for GroupMembers<'_, IS_BLURRED, IS_SWEPT> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.projection.project_packs::<IS_BLURRED, IS_SWEPT>(self.gaussians, self.packs, self.batch);
    }
}

/// A view and the tiles to render, in `f32` where that is precise enough.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projection<'a> {
    view: View,
    sweep: Option<&'a ViewSweep>,
    /// Rows of the rotation from world to camera.
    rows: [Vec3; 3],
    focal_px: [f32; 2],
    slope: [(f32, f32); 2],
    /// End of the picture for [`super::spec::reaches`], in pixels.
    end_px: [f32; 2],
    dilation_px2: f32,
    /// 1 if opacity compensates for the dilation, else 0.
    compensation: f32,
    cut_level: f32,
    spread: Spread,
    unit: f32,
    /// Width and height of the picture.
    size_px: [f32; 2],
    /// The tiles to render, their upper and lower end in pixels, their first and last column, and their first and last
    /// row.
    grid: TileGrid,
    grid_px: [f32; 2],
    columns: [f32; 2],
    rows_of_tiles: [f32; 2],
}

impl<'a> Projection<'a> {
    /// The projection of a view, and of the pictures of a sweep around it, onto some of its tiles.
    pub(super) fn new(view: &View, sweep: Option<&'a ViewSweep>, grid: TileGrid) -> Self {
        let rows = view.camera_from_world.transpose();
        let (top, bottom) = (grid.first_row, grid.first_row + grid.down);
        let narrow = |(low, high): (f64, f64)| (low as f32, high as f32);
        Self {
            view: *view,
            sweep,
            rows: [rows.x_axis.as_vec3(), rows.y_axis.as_vec3(), rows.z_axis.as_vec3()],
            focal_px: view.focal_px.map(|focal| focal as f32),
            slope: [narrow(view.slope_x), narrow(view.slope_y)],
            end_px: [view.width, view.height].map(|size| size.next_multiple_of(16) as f32),
            dilation_px2: view.dilation_px2 as f32,
            compensation: f32::from(u8::from(view.is_compensated)),
            cut_level: (view.alpha_cut.log2() / EXPONENT_DIVISOR) as f32,
            spread: Spread::above(view.alpha_cut),
            unit: whitening_unit() as f32,
            size_px: [view.width, view.height].map(|size| size as f32),
            grid,
            grid_px: [top, bottom].map(|row| (row * TILE_PX) as f32),
            columns: [0.0, (grid.across - 1) as f32],
            rows_of_tiles: [top as f32, (bottom - 1) as f32],
        }
    }

    /// Whether any member of a group may overlap the tiles to render.
    ///
    /// A member extends to the number of standard deviations at which the largest opacity of the group falls to the
    /// alpha cut. A standard deviation in pixels is at most `max_scale` times the largest stretch of the projection
    /// along the axis. Every test is therefore a plane in camera space.
    pub(super) fn may_be_visible(&self, group: &Group) -> bool {
        let view = &self.view;
        let center = view.camera_from_world * (group.center.as_dvec3() - view.center);
        let radius = f64::from(group.radius) * 1.001;
        // NaN if even the center is below the alpha cut.
        let sigmas = (2.0 * (f64::from(group.max_opacity) / view.alpha_cut).ln()).sqrt() * 1.001;
        if center.z + radius <= view.near || sigmas.is_nan() {
            return false;
        }
        let blur_px = view.blur.map_or(0.0, |blur| sigmas * blur.max_deviation_px(center, radius));
        let sweep_px = self.sweep.map_or(0.0, |sweep| sweep.max_reach_px(center, radius));
        let margin_px = MARGIN_PX + blur_px + sweep_px;
        // Whether the group lies outside the strip between two lines across the picture.
        let is_beside = |focal: f64, bounds: (f64, f64), along: f64, [first_px, last_px]: [f64; 2]| {
            let stretch = focal * (1.0 + bounds.0.abs().max(bounds.1).powi(2)).sqrt();
            let reach = sigmas * f64::from(group.max_scale) * stretch;
            let (before, after) = ((focal, margin_px - first_px), (-focal, margin_px + last_px));
            [before, after].into_iter().any(|(a, b)| a * along + b * center.z + a.hypot(b) * radius + reach < 0.0)
        };
        let ([fx, fy], [px, py]) = (view.focal_px, view.principal_px);
        let [top, bottom] = self.grid_px.map(|line| f64::from(line) - py);
        !is_beside(fx, view.slope_x, center.x, [-px, f64::from(view.width) - px])
            && !is_beside(fy, view.slope_y, center.y, [top, bottom])
    }

    /// Appends the splats of a group's members.
    pub(super) fn project_group(&self, gaussians: &Gaussians, packs: &[Pack], batch: &mut Batch) {
        match (self.view.blur.is_some(), self.sweep.is_some()) {
            (false, false) => self.project_members::<false, false>(gaussians, packs, batch),
            (true, false) => self.project_members::<true, false>(gaussians, packs, batch),
            (false, true) => self.project_members::<false, true>(gaussians, packs, batch),
            (true, true) => self.project_members::<true, true>(gaussians, packs, batch),
        }
    }

    fn project_members<const IS_BLURRED: bool, const IS_SWEPT: bool>(
        &self,
        gaussians: &Gaussians,
        packs: &[Pack],
        batch: &mut Batch,
    ) {
        let members = GroupMembers::<IS_BLURRED, IS_SWEPT> { projection: self, gaussians, packs, batch };
        self.view.instructions.dispatch(members);
    }

    #[inline(always)]
    fn project_packs<const IS_BLURRED: bool, const IS_SWEPT: bool>(
        &self,
        gaussians: &Gaussians,
        packs: &[Pack],
        batch: &mut Batch,
    ) {
        let mut outputs = Outputs::default();
        for pack in packs {
            self.centers(pack, &mut outputs);
            if IS_BLURRED {
                self.blurs(pack, &mut outputs);
            }
            if let Some(sweep) = self.sweep.filter(|_| IS_SWEPT) {
                sweep.reaches(&outputs.mean_px, &outputs.depth, &mut outputs.reaches);
            }
            self.shapes::<IS_BLURRED, IS_SWEPT>(pack, &mut outputs);
            for lane in 0..LANES {
                if outputs.visibility[lane] != 0.0
                    && let Some((splat, rect)) = self.finish_lane(gaussians, pack, &outputs, lane)
                {
                    batch.push(splat, rect);
                }
            }
        }
    }

    /// Computes depth and center in pixels; sets `visibility` to 1 if the Gaussian is in front of the near plane.
    #[inline(always)]
    fn centers(&self, inputs: &Pack, outputs: &mut Outputs) {
        let m = self.view.camera_from_world;
        let DVec3 { x: cx, y: cy, z: cz } = self.view.center;
        let ([fx, fy], [px, py], near) = (self.view.focal_px, self.view.principal_px, self.view.near);
        for lane in 0..LANES {
            let x = f64::from(inputs.mean[0][lane]) - cx;
            let y = f64::from(inputs.mean[1][lane]) - cy;
            let z = f64::from(inputs.mean[2][lane]) - cz;
            let depth = m.x_axis.z * x + m.y_axis.z * y + m.z_axis.z * z;
            let inverse = 1.0 / depth;
            let right = (m.x_axis.x * x + m.y_axis.x * y + m.z_axis.x * z) * inverse;
            let down = (m.x_axis.y * x + m.y_axis.y * y + m.z_axis.y * z) * inverse;
            outputs.depth[lane] = depth as f32;
            outputs.mean_px[0][lane] = (fx * right + px) as f32;
            outputs.mean_px[1][lane] = (fy * down + py) as f32;
            // Input of `shapes`, which clamps them to slopes and overwrites them.
            outputs.half_px[0][lane] = right as f32;
            outputs.half_px[1][lane] = down as f32;
            outputs.visibility[lane] = if depth > near { 1.0 } else { 0.0 };
        }
    }

    /// Computes what blur adds to the covariance.
    #[inline(always)]
    fn blurs(&self, inputs: &Pack, outputs: &mut Outputs) {
        let Some(blur) = self.view.blur else { return };
        for lane in 0..LANES {
            let mean = DVec3::from([0, 1, 2].map(|axis| f64::from(inputs.mean[axis][lane])));
            let added = blur.added(mean, f64::from(outputs.depth[lane]));
            for axis in 0..2 {
                outputs.disk_px2[axis][lane] = added.disk[axis] as f32;
                outputs.smear_px[axis][lane] = added.smear[axis] as f32;
            }
        }
    }

    /// Computes shape and opacity; clears `visibility` if the splat is below the alpha cut or outside the picture.
    #[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch, which prevents vectorization")]
    #[inline(always)]
    fn shapes<const IS_BLURRED: bool, const IS_SWEPT: bool>(&self, inputs: &Pack, out: &mut Outputs) {
        let [r0, r1, r2] = self.rows;
        for lane in 0..LANES {
            let inverse_depth = 1.0 / out.depth[lane];
            let slope_x = out.half_px[0][lane].max(self.slope[0].0).min(self.slope[0].1);
            let slope_y = out.half_px[1][lane].max(self.slope[1].0).min(self.slope[1].1);
            let (stretch_x, stretch_y) = (self.focal_px[0] * inverse_depth, self.focal_px[1] * inverse_depth);
            let axis_x = [r0.x - slope_x * r2.x, r0.y - slope_x * r2.y, r0.z - slope_x * r2.z].map(|v| v * stretch_x);
            let axis_y = [r1.x - slope_y * r2.x, r1.y - slope_y * r2.y, r1.z - slope_y * r2.z].map(|v| v * stretch_y);

            let [qx, qy, qz, qw] = [0, 1, 2, 3].map(|part| inputs.rotation[part][lane]);
            let scale = 2.0 / (qx * qx + qy * qy + qz * qz + qw * qw);
            let columns = [
                [1.0 - scale * (qy * qy + qz * qz), scale * (qx * qy + qw * qz), scale * (qx * qz - qw * qy)],
                [scale * (qx * qy - qw * qz), 1.0 - scale * (qx * qx + qz * qz), scale * (qy * qz + qw * qx)],
                [scale * (qx * qz + qw * qy), scale * (qy * qz - qw * qx), 1.0 - scale * (qx * qx + qy * qy)],
            ];
            let s = [inputs.scale[0][lane], inputs.scale[1][lane], inputs.scale[2][lane]];
            let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let v1 = [dot(axis_x, columns[0]) * s[0], dot(axis_x, columns[1]) * s[1], dot(axis_x, columns[2]) * s[2]];
            let v2 = [dot(axis_y, columns[0]) * s[0], dot(axis_y, columns[1]) * s[1], dot(axis_y, columns[2]) * s[2]];
            let cross = [v1[1] * v2[2] - v1[2] * v2[1], v1[2] * v2[0] - v1[0] * v2[2], v1[0] * v2[1] - v1[1] * v2[0]];
            let (raw_x, raw_y, raw, dilation) = (dot(v1, v1), dot(v2, v2), dot(cross, cross), self.dilation_px2);
            let (mut a, mut b, mut c) = (raw_x + dilation, dot(v1, v2), raw_y + dilation);
            let mut det = raw + dilation * (raw_x + raw_y) + dilation * dilation;

            let kept_frac = (raw / det).sqrt() * self.compensation + (1.0 - self.compensation);
            let mut opacity = inputs.opacity[lane] * kept_frac;
            if IS_BLURRED {
                // The smear is a fourth column of V, the disk dilates.
                let [smear_x, smear_y] = [out.smear_px[0][lane], out.smear_px[1][lane]];
                let [disk_x, disk_y] = [dilation + out.disk_px2[0][lane], dilation + out.disk_px2[1][lane]];
                let minors = [0, 1, 2].map(|column| v1[column] * smear_y - v2[column] * smear_x);
                let (wide_x, wide_y) = (raw_x + smear_x * smear_x, raw_y + smear_y * smear_y);
                let sharp = det;
                det = raw + dot(minors, minors) + disk_y * wide_x + disk_x * wide_y + disk_x * disk_y;
                (a, b, c) = (wide_x + disk_x, b + smear_x * smear_y, wide_y + disk_y);
                opacity = self.spread.opacity(opacity, (sharp / det).sqrt());
            }
            let level = log2(opacity).min(0.0) * (1.0 / EXPONENT_DIVISOR as f32);
            let reach = level - self.cut_level;
            let sigmas = reach.max(0.0).sqrt() / self.unit;
            let (sd_x, sd_y) = (a.sqrt(), c.sqrt());
            let half_difference = (a - c) * 0.5;
            let spread = (half_difference * half_difference + b * b).max(0.1).sqrt();
            let radius_px = (3.0 * ((a + c) * 0.5 + spread).sqrt()).ceil();
            let ux = self.unit * sd_y / det.sqrt();

            out.whiten[0][lane] = ux;
            out.whiten[1][lane] = -b / c * ux;
            out.whiten[2][lane] = self.unit / sd_y;
            out.level[lane] = level;
            out.reach[lane] = reach;
            out.half_px[0][lane] = sigmas * sd_x;
            out.half_px[1][lane] = sigmas * sd_y;
            out.skew_px[lane] = sigmas * sd_x * b / a;

            let (x, y) = (out.mean_px[0][lane] - 0.5, out.mean_px[1][lane] - 0.5);
            let (x_px, y_px) = (out.mean_px[0][lane], out.mean_px[1][lane]);
            // From the leftmost place of the center to the rightmost, and from the uppermost to the lowest.
            let (mut x_ends, mut y_ends, mut reach_px) = ([x_px, x_px], [y_px, y_px], radius_px);
            if IS_SWEPT {
                // One by one: a copy of the arrays does not vectorize.
                let (left, right) = (out.reaches[0][lane], out.reaches[1][lane]);
                let (up, down) = (out.reaches[2][lane], out.reaches[3][lane]);
                (x_ends, y_ends) = ([x_px - left, x_px + right], [y_px - up, y_px + down]);
                reach_px += left.max(right).max(up).max(down);
            }
            let is_near = (x + reach_px >= 1.0)
                & (y + reach_px >= 1.0)
                & (x - reach_px < self.end_px[0])
                & (y - reach_px < self.end_px[1])
                & (reach >= 0.0);
            let (half_x, half_y) = (out.half_px[0][lane], out.half_px[1][lane]);
            let (x_ends, y_ends) = ([x_ends[0] - half_x, x_ends[1] + half_x], [y_ends[0] - half_y, y_ends[1] + half_y]);
            let ([width, height], [top, bottom]) = (self.size_px, self.grid_px);
            let is_inside = (x_ends[1] > 0.0) & (x_ends[0] < width) & (y_ends[1] > 0.0) & (y_ends[0] < height);
            let is_in_grid = (y_ends[1] >= top) & (y_ends[0] < bottom);
            out.tile_rect[0][lane] = tile(x_ends[0], self.columns);
            out.tile_rect[1][lane] = tile(x_ends[1], self.columns);
            out.tile_rect[2][lane] = tile(y_ends[0], self.rows_of_tiles);
            out.tile_rect[3][lane] = tile(y_ends[1], self.rows_of_tiles);
            // 0 if all are finite, else NaN: the splat is then computed in `f64`.
            let nan_if_infinite = (det + ux + x + y + radius_px) * 0.0;
            let front = out.visibility[lane];
            let is_visible = is_near & is_inside & is_in_grid;
            out.visibility[lane] =
                if front > 0.0 { if is_visible { 1.0 + nan_if_infinite } else { nan_if_infinite } } else { 0.0 };
        }
    }

    /// The splat of one lane with its color; computed in `f64` if `f32` overflowed.
    fn finish_lane(&self, gaussians: &Gaussians, pack: &Pack, out: &Outputs, lane: usize) -> Option<(Splat, [u16; 4])> {
        let gaussian_idx = pack.gaussian_idx[lane];
        let (splat, rect) = if out.visibility[lane] > 0.5 {
            let splat = Splat {
                mean_px: [out.mean_px[0][lane], out.mean_px[1][lane]],
                whiten: [out.whiten[0][lane], out.whiten[1][lane], out.whiten[2][lane]],
                level: out.level[lane],
                reach: out.reach[lane],
                half_px: [out.half_px[0][lane], out.half_px[1][lane]],
                skew_px: out.skew_px[lane],
                depth: out.depth[lane],
                color: [0.0; 3],
                gaussian_idx,
                swept_px: swept_px(&out.reaches, lane),
            };
            (splat, [0, 1, 2, 3].map(|side| out.tile_rect[side][lane]))
        } else {
            let exact = reference::project(gaussians, gaussian_idx as usize, &self.view)?;
            let splat = Splat::from_exact(&exact, &self.view);
            (splat, splat.tile_rect(self.grid, &self.view)?)
        };
        let sh_dc = Vec3::from(pack.sh_dc.map(|channel| channel[lane]));
        let color = if gaussians.sh_degree == 0 {
            harmonics::base_color(sh_dc)
        } else {
            let mean = DVec3::from(pack.mean.map(|axis| f64::from(axis[lane])));
            harmonics::color_f32(mean - self.view.center, sh_dc, gaussians.sh_rest_of(gaussian_idx as usize))
        };
        let color = match &self.view.fog {
            None => color,
            Some(fog) => {
                let mean = DVec3::from(pack.mean.map(|axis| f64::from(axis[lane])));
                fog.tinted(color.as_dvec3(), mean - self.view.center).as_vec3()
            }
        };
        Some((splat.with_source(gaussian_idx, color.min(Vec3::splat(self.view.max_color))), rect))
    }
}

/// The tile that contains a position, clamped to `first..=last`. The addition moves the integer part into the lowest
/// bits of the mantissa; a cast does not vectorize.
#[inline(always)]
fn tile(position_px: f32, [first, last]: [f32; 2]) -> u16 {
    const SHIFT: f32 = 8_388_608.0;
    ((position_px * (1.0 / TILE_PX as f32)).max(first).min(last).floor() + SHIFT).to_bits() as u16
}
