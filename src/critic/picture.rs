//! What one picture of a film shows, in numbers.

use glam::DVec2;

use super::painted::Shown;

/// Transmittance above which a pixel is void.
const VOID: f32 = 0.5;
/// Luminance below which a pixel is black, and above which all of its channels are clipped.
const BLACK: f64 = 0.02;
const CLIPPED: f32 = 0.99;
/// Matter in front of this share of the subject's distance, or of the median depth, is foreground.
const FOREGROUND_FRAC: f64 = 0.5;
/// Cells of the grid on which detail is measured: columns, rows.
const CELLS: (usize, usize) = (8, 6);
/// Standard deviation of the luminance in a cell from which it has detail.
const DETAIL: f64 = 0.025;
/// Percentiles of depth between which a picture's depth is measured.
const DEPTH_RANGE: (f64, f64) = (0.1, 0.9);

/// What one picture shows. Shares are of the frame, 0..=1.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Time in the film.
    pub time_secs: f64,
    /// Share without matter.
    pub void_frac: f64,
    /// Share covered by matter close to the lens, subjects excepted.
    pub blocked_frac: f64,
    /// Share that thin matter close to the lens covers, each Gaussian by itself.
    pub haze: f64,
    /// Share in front of half the distance to the subject (without one: of half the median depth).
    pub foreground_frac: f64,
    /// Share that is black, void included.
    pub black_frac: f64,
    /// Share clipped to white.
    pub clipped_frac: f64,
    /// Mean luminance of what is not void, 0..=1.
    pub brightness: f64,
    /// Far over near depth, at the 90th and the 10th percentile; 1 in a void.
    pub depth_ratio: f64,
    /// Middle of the detail, from the frame's middle over its width and height; right and down positive.
    pub balance: DVec2,
    /// Share of the frame's cells that have detail.
    pub interest_frac: f64,
    /// Median size of the splats in pixels of the film; 0 in a void.
    pub splat_px: f64,
    /// The size that the coarsest seventh of the picture exceeds, pixels of the film; 0 in a void.
    pub coarse_px: f64,
    /// Every subject.
    pub sights: Vec<Sight>,
}

/// How a picture shows a subject.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Id of the object.
    pub object: u32,
    /// Share of the frame that it would cover if nothing hid it.
    pub area_frac: f64,
    /// Share of that area on which it is visible.
    pub seen_frac: f64,
    /// Share of the box about it in the picture, and of a margin to the sides and above, that nearer matter takes.
    pub crowded_frac: f64,
    /// Median size of its splats in pixels of the film, where it is visible.
    pub splat_px: Option<f64>,
    /// Mean cosine between its surfaces' normals and the direction to the camera.
    pub facing: Option<f64>,
    /// Height of its projected box over the frame's; `None` where a corner is behind the camera.
    pub height_frac: Option<f64>,
}

/// Share of a picture that is no coarser than its coarse size.
const COARSE_SHARE: f64 = 6.0 / 7.0;

/// A rendered picture with what is known of its film.
pub(super) struct View<'a> {
    pub(super) shown: &'a Shown,
    /// Focal length of the film in pixels.
    pub(super) focal_px: f64,
    /// Distance to the nearest subject; infinite without one.
    pub(super) subject_distance: f64,
    /// Depth below which matter is close to the lens.
    pub(super) near: f64,
    pub(super) haze: f64,
}

impl View<'_> {
    /// Median size of the splats in some pixels, pixels of the film; `None` without such pixels.
    pub(super) fn splat_px(&self, pixels: impl Iterator<Item = usize>) -> Option<f64> {
        self.size_px(pixels, 0.5)
    }

    /// Size of the splats that a share of some pixels does not exceed, pixels of the film; `None` without such pixels.
    fn size_px(&self, pixels: impl Iterator<Item = usize>, share: f64) -> Option<f64> {
        let size = |pixel: usize| f64::from(self.shown.size[pixel] / self.shown.depth[pixel]) * self.focal_px;
        let mut sizes: Vec<f64> = pixels.map(size).filter(|size| size.is_finite()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get(((sizes.len() as f64 * share) as usize).min(sizes.len().saturating_sub(1))).copied()
    }
}

/// Measures a picture.
pub(super) fn measured(time_secs: f64, view: &View<'_>, sights: Vec<Sight>) -> Picture {
    let shown = view.shown;
    let (rgb, rest) = (&shown.frame.rgb, &shown.frame.transmittance);
    let num = rest.len();
    let share = |test: &dyn Fn(usize) -> bool| (0..num).filter(|&pixel| test(pixel)).count() as f64 / num.max(1) as f64;
    let luminance: Vec<f64> =
        rgb.as_chunks().0.iter().map(|rgb| luminance(rgb.map(|value| value.clamp(0.0, 1.0)))).collect();
    let is_solid = |pixel: &usize| rest[*pixel] <= VOID;
    let (mut depths, solid): (Vec<f64>, Vec<usize>) = (0..num)
        .filter(is_solid)
        .filter(|&pixel| shown.depth[pixel].is_finite())
        .map(|pixel| (f64::from(shown.depth[pixel]), pixel))
        .unzip();
    depths.sort_by(f64::total_cmp);
    let percentile = |frac: f64| depths.get(((depths.len().saturating_sub(1)) as f64 * frac) as usize).copied();
    let distance = if view.subject_distance.is_finite() { Some(view.subject_distance) } else { percentile(0.5) };
    let front = (FOREGROUND_FRAC * distance.unwrap_or(0.0)) as f32;
    let of_subject = |pixel: usize| shown.subjects.iter().any(|plane| plane[pixel] > 0.5);
    let brightness = solid.iter().map(|&pixel| luminance[pixel]).sum::<f64>() / solid.len().max(1) as f64;
    let (balance, interest_frac) = detail(&luminance, shown.frame.width as usize);
    Picture {
        time_secs,
        void_frac: share(&|pixel| rest[pixel] > VOID),
        blocked_frac: share(&|pixel| {
            f64::from(shown.depth[pixel]) < view.near && rest[pixel] <= VOID && !of_subject(pixel)
        }),
        haze: view.haze,
        foreground_frac: share(&|pixel| shown.depth[pixel] < front && !of_subject(pixel)),
        black_frac: share(&|pixel| luminance[pixel] < BLACK),
        clipped_frac: share(&|pixel| rgb[pixel * 3..pixel * 3 + 3].iter().all(|&value| value >= CLIPPED)),
        brightness,
        depth_ratio: percentile(DEPTH_RANGE.1).zip(percentile(DEPTH_RANGE.0)).map_or(1.0, |(far, near)| far / near),
        balance,
        interest_frac,
        splat_px: view.splat_px(solid.iter().copied()).unwrap_or(0.0),
        coarse_px: view.size_px(solid.into_iter(), COARSE_SHARE).unwrap_or(0.0),
        sights,
    }
}

/// Luminance of an encoded color (BT.709).
pub(super) fn luminance(rgb: [f32; 3]) -> f64 {
    let [r, g, b] = rgb.map(f64::from);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The middle of the detail, from the frame's middle, and the share of the cells that have detail. A cell's detail is the
/// standard deviation of its luminance.
fn detail(luminance: &[f64], width: usize) -> (DVec2, f64) {
    let height = luminance.len() / width.max(1);
    let (mut weighted, mut total, mut num_detailed) = (DVec2::ZERO, 0.0, 0);
    for row in 0..CELLS.1 {
        for column in 0..CELLS.0 {
            let (xs, ys) = (span(column, CELLS.0, width), span(row, CELLS.1, height));
            let values = ys.flat_map(|y| xs.clone().map(move |x| luminance[y * width + x]));
            let deviation = standard_deviation(values);
            let at = DVec2::new((column as f64 + 0.5) / CELLS.0 as f64, (row as f64 + 0.5) / CELLS.1 as f64) - 0.5;
            weighted += at * deviation;
            total += deviation;
            num_detailed += usize::from(deviation > DETAIL);
        }
    }
    let middle = if total > 0.0 { weighted / total } else { DVec2::ZERO };
    (middle, num_detailed as f64 / (CELLS.0 * CELLS.1) as f64)
}

/// The `idx`-th of `num` even parts of `0..length`.
fn span(idx: usize, num: usize, length: usize) -> std::ops::Range<usize> {
    idx * length / num..(idx + 1) * length / num
}

fn standard_deviation(values: impl Iterator<Item = f64>) -> f64 {
    let (mut num, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        num += 1.0;
        sum += value;
        squares += value * value;
    }
    if num > 0.0 { ((squares - sum * sum / num) / num).max(0.0).sqrt() } else { 0.0 }
}
