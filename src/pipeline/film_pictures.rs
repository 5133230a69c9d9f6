use cinesplat_lens::EffectChoice;
use cinesplat_render::{RenderSettings, Renderer, Rgb8Frame};
use cinesplat_trajectory::Shot;

use super::error::PipelineError;
use super::film::Filmed;

/// Small pictures of a shot's film, with its effects: `num` frames at even times in 8 bits (r, g, b), the first and the last
/// frame included.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::Render`].
pub fn film_pictures(
    (renderer, settings): (&Renderer<'_>, &RenderSettings),
    shot: &Shot,
    [width, height]: [u32; 2],
    num: usize,
) -> Result<Vec<Vec<u8>>, PipelineError> {
    let small = Shot { width, height, ..shot.clone() };
    let filmed = Filmed::new(&small, &EffectChoice::Auto, settings)?;
    let last = small.num_frames() - 1;
    let picture = |idx: usize| {
        let frame_idx = idx * last / (num.max(2) - 1);
        let plan = filmed.plan(frame_idx..frame_idx + 1, (renderer, settings))?;
        let mut frame = Rgb8Frame::default();
        filmed.render_rgb8(&plan, frame_idx, (renderer, settings), &mut frame)?;
        Ok(frame.rgb8)
    };
    (0..num).map(picture).collect()
}
