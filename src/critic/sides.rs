//! Small pictures of a lone thing from its sides.

use cinesplat_geometry::{Camera, Intrinsics, LevelFrame, Pose};
use cinesplat_render::{Frame, Quality, RenderError, RenderSettings, Renderer};
use cinesplat_scene::Gaussians;
use glam::DVec3;

use super::picture;
use super::subjects::Subject;
use super::thinned::thinned;

/// Pixels of a picture's side.
const SIZE_PX: u32 = 96;
/// Transmittance below which a pixel shows the thing.
const SOLID: f32 = 0.3;
/// Distance of the camera that looks at a thing, over the thing's radius, its height above the thing's middle over that
/// distance, and the field of view that holds the thing.
const DISTANCE: f64 = 3.0;
const RISE: f64 = 0.15;
const FOV_DEG: f64 = 40.0;
/// The same of the level camera with a long lens that takes a profile: a row of its picture is one height.
const FAR_DISTANCE: f64 = 20.0;
const FAR_FOV_DEG: f64 = 6.2;

/// Gaussians of a thing that small pictures show.
const MAX_GAUSSIANS: usize = 30_000;

/// The Gaussians of a thing, or fewer and larger ones that look the same in small pictures.
pub(super) fn small_cloud(subject: &Subject) -> Gaussians {
    let (kept, growth) = thinned(&subject.cloud, &vec![0; subject.cloud.len()], MAX_GAUSSIANS);
    let mut cloud = subject.cloud.plain_subset(&kept);
    cloud.scales.iter_mut().for_each(|scale| *scale *= growth);
    cloud
}

/// A thing alone and the frame that it stands in.
pub(super) struct Sides<'a> {
    renderer: Renderer<'a>,
    subject: &'a Subject,
    pub(super) frame: &'a LevelFrame,
}

impl<'a> Sides<'a> {
    /// `cloud` is that of the subject, see [`small_cloud`].
    pub(super) fn of((subject, cloud): (&'a Subject, &'a Gaussians), frame: &'a LevelFrame) -> Self {
        Self { renderer: Renderer::new(cloud), subject, frame }
    }

    /// The picture from a level direction as a person sees it; `None` where there is no such view.
    pub(super) fn seen_from(&self, toward: DVec3) -> Result<Option<Side>, RenderError> {
        self.side(toward, RISE, [DISTANCE, FOV_DEG])
    }

    /// The picture from a level direction in which every row is one height; `None` where there is no such view.
    pub(super) fn profile_from(&self, toward: DVec3) -> Result<Option<Side>, RenderError> {
        self.side(toward, 0.0, [FAR_DISTANCE, FAR_FOV_DEG])
    }

    fn side(&self, level: DVec3, rise: f64, [distance, fov_deg]: [f64; 2]) -> Result<Option<Side>, RenderError> {
        let toward = (level + self.frame.up * rise).normalize_or_zero();
        let (center, distance) = (self.subject.center, distance * self.subject.radius);
        let Ok(pose) = Pose::look_at(center + toward * distance, center, self.frame.up, None) else { return Ok(None) };
        let intrinsics = Intrinsics::from_fov_y(SIZE_PX, SIZE_PX, fov_deg.to_radians());
        let settings = RenderSettings { quality: Quality::Draft, near: 0.01 * distance, ..RenderSettings::default() };
        let frame = self.renderer.render(&Camera { pose, intrinsics }, &settings)?;
        Ok(Some(Side { level, right: pose.right(), frame }))
    }
}

/// The picture of a thing from one side.
pub(super) struct Side {
    /// Level direction to the camera, world, unit.
    pub(super) level: DVec3,
    /// Direction to the right of the picture, world, unit.
    pub(super) right: DVec3,
    frame: Frame,
}

impl Side {
    /// Rows and columns of the picture.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.frame.height as usize, self.frame.width as usize]
    }

    /// Whether a pixel shows the thing.
    pub(super) fn is_solid(&self, x: usize, y: usize) -> bool {
        self.frame.transmittance[y * self.frame.width as usize + x] < SOLID
    }

    /// Columns of a row that show the thing.
    pub(super) fn solid_columns(&self, y: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.frame.width as usize).filter(move |&x| self.is_solid(x, y))
    }

    /// Color of the thing at a pixel, without the background.
    pub(super) fn color(&self, x: usize, y: usize) -> [f32; 3] {
        let i = y * self.frame.width as usize + x;
        let cover = (1.0 - self.frame.transmittance[i]).max(0.05);
        [0, 1, 2].map(|channel| self.frame.rgb[3 * i + channel] / cover)
    }

    /// Luminance of a pixel.
    pub(super) fn luminance(&self, x: usize, y: usize) -> f64 {
        let i = y * self.frame.width as usize + x;
        picture::luminance([self.frame.rgb[3 * i], self.frame.rgb[3 * i + 1], self.frame.rgb[3 * i + 2]])
    }
}

/// First and last row of what pictures show, without what floats above and below it; `None` where they show nothing.
pub(super) fn solid_rows(sides: &[Side]) -> Option<[usize; 2]> {
    let num_rows = sides.first()?.size()[0];
    let counts: Vec<usize> =
        (0..num_rows).map(|y| sides.iter().map(|side| side.solid_columns(y).count()).sum()).collect();
    let total: usize = counts.iter().sum();
    let mut rows = (0..num_rows).scan(0, |above, y| {
        *above += counts[y];
        Some((y, *above))
    });
    let beyond = total.div_ceil(FLOATING_SHARE);
    let (first, _) = rows.clone().find(|(_, above)| *above > beyond)?;
    let (last, _) = rows.find(|(_, above)| above + beyond >= total)?;
    (last > first).then_some([first, last])
}

/// One part in this many of what pictures show may float above a thing, and as much below.
const FLOATING_SHARE: usize = 500;
