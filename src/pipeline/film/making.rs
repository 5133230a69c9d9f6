use std::collections::{BTreeMap, BTreeSet};
use std::mem;
use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use super::effects::Filmed;
use super::form::Form;
use super::report::FilmReport;
use super::watch::QualityWatch;
use crate::pipeline::error::PipelineError;
use crate::pipeline::job::{Kept, Picture};
use crate::pipeline::panic_point::panic_point;
use crate::pipeline::promise::Level;
use cinesplat_geometry::Camera;
use cinesplat_lens::EffectPlan;
use cinesplat_render::{Quality, RenderSettings, Renderer, Rgb8Frame};
use cinesplat_video::{AlphaPlanes, ContactSheet, planes_from_rgb8};

/// Makes the frames of a film in order: takes those that a job folder holds and renders the others.
pub(super) struct FrameMaker<'a> {
    renderer: &'a Renderer<'a>,
    filmed: &'a Filmed<'a>,
    effects: &'a EffectPlan,
    settings: &'a RenderSettings,
    form: Form,
    /// Pictures whose memory is free.
    used: Receiver<Arc<Picture>>,
    kept: Option<Kept>,
    /// Places in the output that the contact sheet shows.
    sheet: BTreeSet<usize>,
    /// The last frame with its picture and its camera.
    last: Option<(usize, Arc<Picture>, Camera)>,
    rendered: Rgb8Frame,
    num_kept: usize,
    num_damaged: usize,
    render_time: Duration,
    /// Decides the quality of every frame; `None` = that of the settings.
    watch: Option<QualityWatch<'a>>,
    qualities: Vec<(usize, Quality)>,
    /// How the last frame was rendered.
    level: Level,
    /// Frames whose effects took the samples of `reference` at another quality.
    num_finest: usize,
    /// Plans of the effects at other levels than that of the settings, from their first frame on, by rank.
    plans: BTreeMap<(u8, bool), EffectPlan>,
}

/// A finished frame.
pub(super) struct Made {
    /// The picture; `None` where nobody needs it, because it is in its place already.
    pub(super) picture: Option<Arc<Picture>>,
    /// Whether the job folder holds it.
    pub(super) is_kept: bool,
    /// Whether it is the picture of the frame before.
    pub(super) is_repeated: bool,
}

impl<'a> FrameMaker<'a> {
    pub(super) fn new(
        (renderer, filmed, effects): (&'a Renderer<'a>, &'a Filmed<'a>, &'a EffectPlan),
        settings: &'a RenderSettings,
        (form, used): (Form, Receiver<Arc<Picture>>),
        kept: Option<Kept>,
    ) -> Self {
        Self {
            renderer,
            filmed,
            effects,
            settings,
            form,
            used,
            kept,
            sheet: BTreeSet::new(),
            last: None,
            rendered: Rgb8Frame::default(),
            num_kept: 0,
            num_damaged: 0,
            render_time: Duration::ZERO,
            watch: None,
            qualities: Vec::new(),
            level: Level::of(settings.quality),
            num_finest: 0,
            plans: BTreeMap::new(),
        }
    }

    /// Lets a watch decide the quality of every frame.
    pub(super) fn watched_by(mut self, watch: Option<QualityWatch<'a>>) -> Self {
        self.watch = watch;
        self
    }

    /// Makes pictures for a contact sheet available, even those that nothing else needs.
    pub(super) fn show_on(&mut self, sheet: &ContactSheet) {
        self.sheet.extend(sheet.shown_frames());
    }

    /// Number of frames that the job folder lists.
    pub(super) fn num_listed(&self, frames: &Range<usize>) -> usize {
        self.kept.as_ref().map_or(0, |kept| kept.num_listed(frames))
    }

    /// Frame `frame_idx` of the shot, which is picture `idx` of the output.
    pub(super) fn make(&mut self, frame_idx: usize, idx: usize) -> Result<Made, PipelineError> {
        let camera = self.filmed.camera(frame_idx);
        if let Some(made) = self.take_kept(frame_idx, idx, camera) {
            self.num_kept += 1;
            return Ok(made);
        }
        // The same camera gives the same picture, unless an effect changes it with time or begins or ends here.
        let effects = self.plans.get(&self.level.rank()).unwrap_or(self.effects);
        let may_repeat = |last: usize| effects.repeats(frame_idx, last);
        let is_same = |(last, _, seen): &(usize, _, Camera)| *seen == camera && may_repeat(*last);
        let repeated = self.last.take().filter(is_same).map(|(_, picture, _)| picture);
        let is_repeated = repeated.is_some();
        let picture = repeated.map_or_else(|| self.render(frame_idx), Ok)?;
        self.last = Some((frame_idx, Arc::clone(&picture), camera));
        Ok(Made { picture: Some(picture), is_kept: false, is_repeated })
    }

    /// Adds what was done to a report.
    pub(super) fn report_to(&self, report: &mut FilmReport) {
        (report.num_kept, report.num_damaged) = (self.num_kept, self.num_damaged);
        report.render_time = self.render_time;
        report.qualities.clone_from(&self.qualities);
        report.num_finest = self.num_finest;
    }

    /// The frame, if the job folder holds it undamaged.
    fn take_kept(&mut self, frame_idx: usize, idx: usize, camera: Camera) -> Option<Made> {
        let kept = self.kept.as_ref().filter(|kept| kept.is_listed(frame_idx))?;
        let needs_picture = matches!(self.form, Form::Planes | Form::AlphaPlanes) || self.sheet.contains(&idx);
        let picture = if needs_picture { kept.picture(frame_idx).map(Arc::new) } else { None };
        if (needs_picture && picture.is_none()) || (!needs_picture && !kept.is_whole(frame_idx)) {
            self.num_damaged += 1;
            return None;
        }
        self.last = picture.clone().map(|picture| (frame_idx, picture, camera));
        Some(Made { picture, is_kept: true, is_repeated: false })
    }

    fn render(&mut self, frame_idx: usize) -> Result<Arc<Picture>, PipelineError> {
        panic_point("render", frame_idx);
        rayon::join(|| (), || panic_point("worker", frame_idx));
        let mut frame = self.free_frame();
        let allowed = Level::of(self.settings.quality);
        let level = self.watch.as_mut().map_or(Ok(allowed), |watch| watch.level_of(frame_idx))?;
        let quality = level.quality;
        self.level = level;
        self.num_finest += usize::from(level.is_finest);
        self.qualities.push((frame_idx, quality));
        let start = Instant::now();
        let (renderer, settings) = (self.renderer, &RenderSettings { quality, ..*self.settings });
        if let Some(watch) = self.watch.as_ref().filter(|_| level != allowed)
            && !self.effects.effects.is_empty()
            && !self.plans.contains_key(&level.rank())
        {
            let plan = if level.is_finest { Filmed::plan_finest } else { Filmed::plan };
            let plan = plan(self.filmed, watch.rest_from(frame_idx), (renderer, settings))?;
            self.plans.insert(level.rank(), plan);
        }
        let effects = self.plans.get(&level.rank()).unwrap_or(self.effects);
        let picture = match self.form {
            Form::Planes => {
                self.filmed.render_rgb8(effects, frame_idx, (renderer, settings), &mut frame)?;
                let planes = planes_from_rgb8(&frame.rgb8, frame.width as usize, frame.height as usize);
                self.rendered = frame;
                Picture::Planes(planes)
            }
            Form::Rgb8 => {
                self.filmed.render_rgb8(effects, frame_idx, (renderer, settings), &mut frame)?;
                Picture::Rgb8(frame)
            }
            Form::AlphaPlanes => {
                let developed = self.filmed.expose(effects, frame_idx, (renderer, settings))?;
                let size = [developed.frame().width, developed.frame().height].map(|len| len as usize);
                Picture::AlphaPlanes(AlphaPlanes::new(&developed.to_rgba(), size[0], size[1]))
            }
            Form::Alpha | Form::Exr => {
                let developed = self.filmed.expose(effects, frame_idx, (renderer, settings))?;
                let bytes = self.form.file_of(&developed, effects.is_transparent())?;
                developed.into_rgb8(&mut frame);
                Picture::File(bytes, frame)
            }
        };
        self.render_time += start.elapsed();
        if let Some(watch) = &mut self.watch {
            watch.rendered(frame_idx, quality, start.elapsed());
        }
        Ok(Arc::new(picture))
    }

    /// A frame whose memory is free: for a film the last one, because only its planes are passed on.
    fn free_frame(&mut self) -> Rgb8Frame {
        let written = self.used.try_iter().find_map(Arc::into_inner);
        match written {
            Some(Picture::Rgb8(frame)) => frame,
            _ => mem::take(&mut self.rendered),
        }
    }
}
