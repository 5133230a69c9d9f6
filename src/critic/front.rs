//! The front of a lone thing, by the votes of what it shows, how it stands and where its face is.

use std::f64::consts::{FRAC_PI_4, TAU};

use cinesplat_geometry::LevelFrame;
use cinesplat_render::RenderError;
use glam::DVec3;

use super::face::face;
use super::profile::Profile;
use super::sides::{Side, Sides, small_cloud};
use super::subjects::{Subject, Subjects};

/// Directions from which a thing is looked at.
const NUM_SIDES: usize = 16;
/// Weight of brightness beside detail.
const BRIGHTNESS: f64 = 0.1;
/// Area of a side over that of the widest one from which it counts fully.
const WIDE_FRAC: f64 = 0.6;
/// Length of the sum of the votes from which a thing has a front: each piece of evidence has one vote where it is sure by
/// itself.
const LEAST_VOTES: f64 = 1.0;

impl Subjects {
    /// The fronts of the subjects that have one: the id of the object, and the level unit direction from its middle.
    ///
    /// Every thing is rendered alone from all around. Three pieces of evidence vote for a direction, each as much as it is
    /// sure: where the sides show the most detail (change of luminance from pixel to pixel), light and area, for a guitar has
    /// strings and its back is plain wood; how a thing stands, for backs rise behind seats and feet point forward; and
    /// where skin lies below hair. What they elect is turned to the thing's own plane of symmetry.
    ///
    /// # Errors
    /// Those of [`Renderer::render`](cinesplat_render::Renderer::render).
    pub fn fronts(&self, frame: &LevelFrame) -> Result<Vec<(u32, DVec3)>, RenderError> {
        let mut fronts = Vec::new();
        for subject in &self.subjects {
            fronts.extend(front(subject, frame)?.map(|direction| (subject.id, direction)));
        }
        Ok(fronts)
    }

    /// As [`Self::fronts`] of one subject; `None` where it has none.
    ///
    /// # Errors
    /// Those of [`Renderer::render`](cinesplat_render::Renderer::render).
    pub fn front(&self, id: u32, frame: &LevelFrame) -> Result<Option<DVec3>, RenderError> {
        self.subjects.iter().find(|subject| subject.id == id).map_or(Ok(None), |subject| front(subject, frame))
    }
}

fn front(subject: &Subject, frame: &LevelFrame) -> Result<Option<DVec3>, RenderError> {
    let cloud = small_cloud(subject);
    let sides = Sides::of((subject, &cloud), frame);
    let mut seen = Vec::with_capacity(NUM_SIDES);
    for side in 0..NUM_SIDES {
        seen.extend(sides.seen_from(frame.direction(TAU * side as f64 / NUM_SIDES as f64))?);
    }
    let profile = Profile::of(&sides)?;
    let standing = profile.as_ref().map_or(DVec3::ZERO, |profile| standing(profile, &seen));
    let votes = detail(&seen) + standing;
    let Some(toward) = votes.try_normalize().filter(|_| votes.length() >= LEAST_VOTES) else { return Ok(None) };
    if let Some(Profile { plane, planarity, .. }) = profile
        && planarity > LEAST_PLANARITY
        && toward.dot(plane).abs() > FRAC_PI_4.cos()
    {
        return Ok(Some(plane * toward.dot(plane).signum()));
    }
    Ok(Some(faced(&sides, toward)?))
}

/// Worth of the best side over the mean of all sides, beyond 1, by which detail is sure.
const SURE_CONTRAST: f64 = 0.12;
/// How much of the worth lies to one side, 0..=1, from which on it is a side's.
const ONE_SIDED: f64 = 0.8;
/// Largest vote of detail, and of the way a thing leans.
const MOST_VOTE: f64 = 3.0;

/// The vote of detail, light and area.
fn detail(seen: &[Side]) -> DVec3 {
    let shown: Vec<[f64; 2]> = seen.iter().map(shown).collect();
    // The edge of a guitar is none of its sides, whatever there is to see on it.
    let widest = shown.iter().map(|[_, area]| *area).fold(0.0, f64::max);
    let breadth = |area: f64| (area / (WIDE_FRAC * widest).max(1.0)).min(1.0).powi(2);
    let worths: Vec<f64> = shown.iter().map(|[worth, area]| worth * breadth(*area)).collect();
    let mean = worths.iter().sum::<f64>() / worths.len().max(1) as f64;
    let best = worths.iter().copied().fold(0.0, f64::max);
    // A face is seen from several sides: the front is the middle of those that show more than others.
    let excess: Vec<f64> = worths.iter().map(|worth| (worth - mean).max(0.0).powi(2)).collect();
    let total: f64 = excess.iter().sum();
    if total <= 0.0 {
        return DVec3::ZERO;
    }
    let toward = seen.iter().zip(&excess).map(|(side, excess)| side.level * *excess).sum::<DVec3>() / total;
    let sure = (best / mean - 1.0) / SURE_CONTRAST * (toward.length() / ONE_SIDED).min(1.0);
    toward.normalize_or_zero() * sure.min(MOST_VOTE)
}

/// Lean over the height by which it is sure, and beyond which a thing is not upright, up to where it leans altogether.
const SURE_LEAN: f64 = 0.04;
const UPRIGHT_LEAN: f64 = 0.05;
const LEANING: f64 = 0.09;
/// Width over height up to which a thing stands on feet as people do.
const MOST_SLENDER: f64 = 0.45;
/// Reach of feet before ankles over the height by which it is sure, and their largest vote.
const SURE_TOES: f64 = 0.02;
const MOST_TOES_VOTE: f64 = 1.5;
/// Share by which the middles of all heights lie in one plane from which the front does too.
const LEAST_PLANARITY: f64 = 0.5;

/// The votes of how a thing stands, and of the face and the feet of what stands upright as people do.
fn standing(profile: &Profile, seen: &[Side]) -> DVec3 {
    let lean = profile.lean.length();
    // What is not alike on both sides, such as a plant, leans by chance.
    let leans = profile.lean.normalize_or_zero() * (profile.planarity * lean / SURE_LEAN).min(MOST_VOTE);
    let upright = ((LEANING - lean) / (LEANING - UPRIGHT_LEAN)).clamp(0.0, 1.0);
    let reach = if profile.width < MOST_SLENDER { profile.toes.length() / SURE_TOES } else { 0.0 };
    let toes = profile.toes.normalize_or_zero() * reach.min(MOST_TOES_VOTE);
    leans + (face(seen, profile.width) + toes) * upright
}

/// Largest angle between the side that is elected and the front, degrees, and the step between the sides that are tried.
const MOST_TURN_DEG: i32 = 60;
const TURN_STEP_DEG: usize = 6;
/// Share of its symmetry that a side loses that is as far from the elected one as any that is tried, and the area of a side
/// over that one's below which it is an edge.
const FAR_LOSS: f64 = 0.1;
const LEAST_AREA: f64 = 0.8;
/// Symmetry of the front over the median of the sides that are tried: what is alike from everywhere faces nowhere.
const LEAST_SYMMETRY: f64 = 1.06;

/// The direction near the elected side from which a thing is its own mirror image, as faces are; that side itself where none
/// is.
fn faced(sides: &Sides<'_>, toward: DVec3) -> Result<DVec3, RenderError> {
    let azimuth = sides.frame.azimuth(toward);
    // Turn, symmetry, area and direction of every side; the one without a turn is the elected one.
    let mut tried = Vec::new();
    for turn_deg in (-MOST_TURN_DEG..=MOST_TURN_DEG).step_by(TURN_STEP_DEG) {
        let direction = sides.frame.direction(azimuth + f64::from(turn_deg).to_radians());
        if let Some(side) = sides.seen_from(direction)? {
            let near = 1.0 - FAR_LOSS * f64::from(turn_deg.abs()) / f64::from(MOST_TURN_DEG);
            let [_, area] = shown(&side);
            tried.push((turn_deg, symmetry(&side) * near, area, direction));
        }
    }
    let most_area = tried.iter().find(|(turn_deg, ..)| *turn_deg == 0).map_or(0.0, |(_, _, area, _)| *area);
    let broad = tried.into_iter().filter(|(_, _, area, _)| *area >= LEAST_AREA * most_area);
    let mut alike: Vec<(f64, DVec3)> = broad.map(|(_, symmetry, _, direction)| (symmetry, direction)).collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (Some((most, direction)), Some((median, _))) = (alike.first(), alike.get(alike.len() / 2)) else {
        return Ok(toward);
    };
    Ok(if *most > LEAST_SYMMETRY * median { *direction } else { toward })
}

/// How alike a picture of a thing and its mirror image are, 0..=1: the share of the pixels of either that show the thing in
/// both, each by how alike its luminances are.
fn symmetry(side: &Side) -> f64 {
    let [height, width] = side.size();
    let solid: Vec<[usize; 2]> = (0..height).flat_map(|y| side.solid_columns(y).map(move |x| [x, y])).collect();
    let count = solid.len();
    if count == 0 {
        return 0.0;
    }
    // Twice the column of the middle.
    let axis = 2 * solid.iter().map(|[x, _]| x).sum::<usize>() / count;
    let alike = solid.into_iter().filter_map(|[x, y]| {
        let mirrored = axis.checked_sub(x).filter(|mirrored| *mirrored < width && side.is_solid(*mirrored, y))?;
        let (a, b) = (side.luminance(x, y), side.luminance(mirrored, y));
        Some(1.0 - (a - b).abs() / (a + b).max(1e-6))
    });
    let alike: Vec<f64> = alike.collect();
    alike.iter().sum::<f64>() / (2 * count - alike.len()).max(1) as f64
}

/// Detail and light of one side, over the pixels that show the thing, and the number of these pixels.
fn shown(side: &Side) -> [f64; 2] {
    let [height, width] = side.size();
    let (mut num, mut change, mut light) = (0.0, 0.0, 0.0);
    for y in 0..height - 1 {
        for x in 0..width - 1 {
            if side.is_solid(x, y) && side.is_solid(x + 1, y) && side.is_solid(x, y + 1) {
                let here = side.luminance(x, y);
                num += 1.0;
                change += (side.luminance(x + 1, y) - here).abs() + (side.luminance(x, y + 1) - here).abs();
                light += here;
            }
        }
    }
    [if num > 0.0 { (change + BRIGHTNESS * light) / num } else { 0.0 }, num]
}
