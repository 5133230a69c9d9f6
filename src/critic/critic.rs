use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};
use cinesplat_scene::{Bounds, Scene};
use cinesplat_trajectory::CameraState;
use glam::DVec2;

use super::film::Film;
use super::picture::{self, Picture, Sight, View};
use super::resolution::height_frac;
use super::review::Review;
use super::settings::CriticSettings;
use super::subjects::{Subject, Subjects, ThinMatter};

/// Distance below which matter counts as near, over the scene size.
const NEAR_FRAC: f64 = 0.05;
/// The same, over the distance to the nearest subject: a close-up has its subject close to the lens.
const NEAR_SUBJECT_FRAC: f64 = 0.4;
/// Largest share of the frame that one thin Gaussian covers.
const MAX_COVER: f64 = 0.25;
/// Weight of a subject in a pixel that counts as showing it.
const SHOWN: f32 = 0.5;

/// Looks at films of one scene.
#[derive(Debug)]
pub struct Critic<'a> {
    renderer: Renderer<'a>,
    subjects: &'a Subjects,
    painted: Vec<Renderer<'a>>,
    /// One renderer per subject, of its own Gaussians.
    alone: Vec<Renderer<'a>>,
    scene_size: f64,
    render: RenderSettings,
    settings: CriticSettings,
}

impl<'a> Critic<'a> {
    /// A critic of films of a scene.
    pub fn new((scene, bounds): (&Scene, &Bounds), subjects: &'a Subjects, settings: CriticSettings) -> Self {
        let render = RenderSettings {
            quality: Quality::Draft,
            filter: scene.filter.unwrap_or(RenderSettings::default().filter),
            near: bounds.default_near(),
            ..RenderSettings::default()
        };
        Self {
            renderer: Renderer::new(&subjects.scene),
            subjects,
            painted: subjects.painted.renderers(),
            alone: subjects.subjects.iter().map(|subject| Renderer::new(&subject.cloud)).collect(),
            scene_size: bounds.size(),
            render,
            settings,
        }
    }

    /// Looks at a film at a few moments and marks it.
    ///
    /// # Errors
    /// Those of [`Renderer::render`].
    pub fn glance(&self, film: &Film) -> Result<Review, RenderError> {
        self.reviewed(film, self.settings.num_first_moments, &[])
    }

    /// Looks at a film at many moments and marks it. Pictures of a glance at the same film are not rendered again.
    ///
    /// # Errors
    /// Those of [`Renderer::render`].
    pub fn review(&self, film: &Film, glance: Option<&Review>) -> Result<Review, RenderError> {
        self.reviewed(film, self.settings.num_moments, glance.map_or(&[], |review| &review.pictures))
    }

    fn reviewed(&self, film: &Film, num_moments: usize, known: &[Picture]) -> Result<Review, RenderError> {
        // One after the other: a picture takes all threads, and the next one reuses its buffers.
        let look = |&time: &f64| match known.iter().find(|picture| (picture.time_secs - time).abs() < 1e-9) {
            Some(picture) => Ok(picture.clone()),
            None => self.look(&film.path.sample(time), time, film.size_px),
        };
        let pictures: Vec<Picture> = film.moments(num_moments).iter().map(look).collect::<Result<_, _>>()?;
        Ok(Review::new(film, pictures))
    }

    /// Looks at one picture of a film whose frames have `size_px` pixels.
    ///
    /// # Errors
    /// Those of [`Renderer::render`].
    pub fn look(&self, state: &CameraState, time_secs: f64, size_px: [u32; 2]) -> Result<Picture, RenderError> {
        let camera = Camera { pose: state.pose, intrinsics: self.small(size_px, state.fov_y_rad) };
        let frame = self.renderer.render(&camera, &self.render)?;
        let shown = self.subjects.painted.show(&self.painted, frame, (&camera, &self.render))?;
        let subject_distance = self.nearest_subject(state);
        let near = (NEAR_FRAC * self.scene_size).min(NEAR_SUBJECT_FRAC * subject_distance);
        let view = View {
            shown: &shown,
            focal_px: f64::from(size_px[1]) / 2.0 / (state.fov_y_rad / 2.0).tan(),
            subject_distance,
            near,
            haze: self.haze(&camera, near),
        };
        let subjects = self.subjects.subjects.iter().zip(&self.alone).zip(&shown.subjects);
        let sights = subjects
            .map(|((subject, alone), weights)| self.sight(&camera, (subject, alone), weights, &view))
            .collect::<Result<_, _>>()?;
        Ok(picture::measured(time_secs, &view, sights))
    }

    /// How a subject is seen, against a picture of it alone.
    fn sight(
        &self,
        camera: &Camera,
        (subject, alone): (&Subject, &Renderer<'_>),
        weights: &[f32],
        view: &View<'_>,
    ) -> Result<Sight, RenderError> {
        let whole = alone.render(camera, &self.render)?;
        let wanted: f64 = whole.transmittance.iter().map(|&rest| f64::from(1.0 - rest)).sum();
        let seen: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        let pixels = weights.iter().enumerate().filter(|(_, weight)| **weight > SHOWN).map(|(pixel, _)| pixel);
        Ok(Sight {
            object: subject.id,
            area_frac: wanted / whole.transmittance.len().max(1) as f64,
            seen_frac: if wanted > 0.0 { (seen / wanted).min(1.0) } else { 0.0 },
            crowded_frac: crowded_frac(camera, subject, (weights, view), BEFORE_FRAC * self.scene_size),
            splat_px: view.splat_px(pixels),
            facing: subject.facing(camera.pose.position),
            height_frac: height_frac(camera, &subject.corners),
        })
    }

    /// Share of the frame that thin matter nearer than `near` covers, each Gaussian by itself; at most 1.
    fn haze(&self, camera: &Camera, near: f64) -> f64 {
        let image = camera.intrinsics;
        let size_px = f64::from(image.width) * f64::from(image.height);
        let cover = |matter: &ThinMatter| {
            let is_near = matter.mean.distance_squared(camera.pose.position) < near * near;
            let (at, depth) = camera.project(matter.mean).filter(|_| is_near)?;
            let is_inside =
                at.cmpge(DVec2::ZERO).all() && at.x < f64::from(image.width) && at.y < f64::from(image.height);
            let area_px = matter.cover * image.fx_px * image.fy_px / (depth * depth);
            // One Gaussian at the lens never counts for the whole frame.
            is_inside.then_some((area_px / size_px).min(MAX_COVER))
        };
        self.subjects.thin.iter().filter_map(cover).sum::<f64>().min(1.0)
    }

    /// Intrinsics of a small picture with the film's aspect.
    fn small(&self, [width, height]: [u32; 2], fov_y_rad: f64) -> Intrinsics {
        let shrink = (f64::from(self.settings.num_pixels.max(64)) / (f64::from(width) * f64::from(height))).sqrt();
        let side = |length: u32| ((f64::from(length) * shrink).round() as u32).max(1);
        Intrinsics::from_fov_y(side(width), side(height), fov_y_rad)
    }

    /// Distance from the camera to the nearest subject in front of it; infinite where there is none.
    fn nearest_subject(&self, state: &CameraState) -> f64 {
        let ahead = |subject: &&Subject| (subject.center - state.pose.position).dot(state.pose.forward()) > 0.0;
        let distance = |subject: &Subject| {
            (subject.center.distance(state.pose.position) - subject.radius).max(0.1 * subject.radius)
        };
        self.subjects.subjects.iter().filter(ahead).map(distance).fold(f64::INFINITY, f64::min)
    }
}

/// Margins about a subject that should be free, over its width to the sides and over its height above it; and the part of
/// its height above its foot where what it stands on may be nearer than the subject.
const BESIDE: f64 = 0.12;
const ABOVE: f64 = 0.1;
const FOOT: f64 = 0.2;
/// Distance before the nearest corner of a subject from which matter stands before it, over the scene size: more than the
/// height of what stands on a table.
const BEFORE_FRAC: f64 = 0.035;

/// Share of the box about a subject, and of a margin, that matter before the subject takes in the picture; 0 where a corner is
/// behind the camera. `gap` is the distance from which matter stands before it, scene units.
fn crowded_frac(camera: &Camera, subject: &Subject, (weights, view): (&[f32], &View<'_>), gap: f64) -> f64 {
    let (mut low, mut high, mut near) = (DVec2::INFINITY, DVec2::NEG_INFINITY, f64::INFINITY);
    for &corner in &subject.corners {
        let Some((at, depth)) = camera.project(corner) else { return 0.0 };
        (low, high, near) = (low.min(at), high.max(at), near.min(depth));
    }
    let size = high - low;
    let low = low - size * DVec2::new(BESIDE, ABOVE);
    let high = high + size * DVec2::new(BESIDE, -FOOT);
    let width = camera.intrinsics.width as usize;
    let before = (near - gap) as f32;
    let (mut inside, mut taken) = (0.0_f64, 0.0);
    for (pixel, &weight) in weights.iter().enumerate() {
        let at = DVec2::new((pixel % width) as f64 + 0.5, (pixel / width) as f64 + 0.5);
        if at.cmpge(low).all() && at.cmple(high).all() {
            inside += 1.0;
            taken += f64::from(u8::from(weight <= SHOWN && view.shown.depth[pixel] < before));
        }
    }
    taken / inside.max(1.0)
}
