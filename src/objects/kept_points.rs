//! The points of an object that are kept: few, and where its silhouettes need them.
//!
//! Enters: candidates and silhouettes. Leaves: points whose alpha shapes cover the masks up to a tolerance, or as many as
//! the budget allows.

use glam::{DVec2, DVec3};

use super::candidates::Candidate;
use super::radius_search::RadiusOptimizer;
use super::sampling::farthest_indices;
use super::silhouettes::{Fit, Silhouettes};

/// Points to start with.
const NUM_FIRST: usize = 48;

/// Growth of the number of points per round.
const GROWTH: f64 = 1.5;

/// Least number of pixels of a mismatch that asks for a point.
const MIN_MISMATCH_PX: usize = 2;

/// Chooses points: first far apart from each other, then in rounds one for each of the largest connected mismatches of
/// shape and mask. Ends at an overlap of `1 - tolerance`, at `budget` points, or where no candidate helps. Returns the
/// points of the round with the largest overlap, and their fit.
pub(crate) fn keep(
    candidates: &[Candidate],
    silhouettes: &Silhouettes,
    (budget, tolerance): (usize, f64),
    optimizer: RadiusOptimizer,
) -> (Vec<DVec3>, Fit) {
    let all: Vec<DVec3> = candidates.iter().map(|candidate| candidate.point).collect();
    let by_view = by_view(candidates, silhouettes.views.len());
    let mut is_kept = vec![false; candidates.len()];
    let mut kept = farthest_indices(&all, NUM_FIRST.min(budget));
    kept.iter().for_each(|&i| is_kept[i] = true);
    let points = |kept: &[usize]| kept.iter().map(|&i| all[i]).collect::<Vec<DVec3>>();
    let mut best = (kept.len(), silhouettes.fit(&points(&kept), optimizer));
    let mut last: Option<Fit> = None;
    while kept.len() < budget && best.1.mask_iou < 1.0 - tolerance {
        let fit = last.as_ref().unwrap_or(&best.1);
        let room = (((kept.len() as f64) * GROWTH) as usize).min(budget) - kept.len();
        let wanted = wanted(silhouettes, fit);
        let before = kept.len();
        for miss in wanted {
            if kept.len() == before + room {
                break;
            }
            let free = by_view[miss.view_idx].iter().copied().filter(|&i| !is_kept[i]);
            let distance = |i: usize| candidates[i].position_px.distance_squared(miss.middle_px);
            if let Some(i) = free.min_by(|&a, &b| distance(a).total_cmp(&distance(b))) {
                is_kept[i] = true;
                kept.push(i);
            }
        }
        if kept.len() == before {
            break;
        }
        let next = silhouettes.fit(&points(&kept), optimizer);
        if next.mask_iou > best.1.mask_iou {
            best = (kept.len(), next);
            last = None;
        } else {
            last = Some(next);
        }
    }
    kept.truncate(best.0);
    (points(&kept), best.1)
}

/// Indices of the candidates of every view.
fn by_view(candidates: &[Candidate], num_views: usize) -> Vec<Vec<usize>> {
    let mut by_view = vec![Vec::new(); num_views];
    for (i, candidate) in candidates.iter().enumerate() {
        by_view[candidate.view_idx].push(i);
    }
    by_view
}

/// A connected mismatch of shape and mask.
struct Miss {
    view_idx: usize,
    /// Its innermost pixel.
    middle_px: DVec2,
    area: usize,
}

/// Ratio of the radius at which points are missed to the best one. At the best radius the shape has no holes, and only
/// more points inside let a smaller radius, which opens hollows, become the best one.
const AIM: f64 = 0.75;

/// The mismatches of all views, largest first.
fn wanted(silhouettes: &Silhouettes, fit: &Fit) -> Vec<Miss> {
    let mut misses: Vec<Miss> = Vec::new();
    for (view_idx, view) in silhouettes.views.iter().enumerate() {
        let radius_px = (AIM * fit.minimum.radius_px).min(view.mask.size as f64 / 4.0);
        let covered = fit.covered(view_idx, radius_px);
        let wrong: Vec<bool> =
            view.mask.inside.iter().zip(&covered).map(|(inside, covered)| inside != covered).collect();
        let found = pieces(&wrong, view.mask.size);
        misses.extend(found.into_iter().map(|(middle_px, area)| Miss { view_idx, middle_px, area }));
    }
    misses.retain(|miss| miss.area >= MIN_MISMATCH_PX);
    misses.sort_by_key(|miss| std::cmp::Reverse(miss.area));
    misses
}

/// Longest run of a piece, px. Longer mismatches, such as a missing rim, ask for several points.
const MAX_PIECE_PX: usize = 24;

/// The connected pieces of a picture, each at most [`MAX_PIECE_PX`] large, with their innermost pixels and areas.
fn pieces(wrong: &[bool], size: usize) -> Vec<(DVec2, usize)> {
    let depth = depths(wrong, size);
    let mut is_seen = vec![false; wrong.len()];
    let mut pieces = Vec::new();
    for start in 0..wrong.len() {
        if !wrong[start] || is_seen[start] {
            continue;
        }
        is_seen[start] = true;
        let mut piece = vec![start];
        let mut at = 0;
        while at < piece.len() && piece.len() < MAX_PIECE_PX {
            for next in around(piece[at], size) {
                if wrong[next] && !is_seen[next] {
                    is_seen[next] = true;
                    piece.push(next);
                }
            }
            at += 1;
        }
        let deepest = piece.iter().copied().max_by_key(|&i| (depth[i], std::cmp::Reverse(i))).unwrap_or(start);
        pieces.push((DVec2::new((deepest % size) as f64 + 0.5, (deepest / size) as f64 + 0.5), piece.len()));
    }
    pieces
}

/// Steps from each wrong pixel to the nearest right one, up to four.
fn depths(wrong: &[bool], size: usize) -> Vec<u8> {
    let mut depths: Vec<u8> = wrong.iter().map(|wrong| u8::from(*wrong)).collect();
    for depth in 1..4 {
        let inner = |i: usize| {
            depths[i] == depth && around(i, size).count() == 4 && around(i, size).all(|j| depths[j] >= depth)
        };
        let inner: Vec<usize> = (0..wrong.len()).filter(|&i| inner(i)).collect();
        inner.into_iter().for_each(|i| depths[i] = depth + 1);
    }
    depths
}

/// The pixels beside, above and below a pixel.
fn around(pixel: usize, size: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (pixel % size, pixel / size);
    let beside = [(x > 0, -1), (x + 1 < size, 1), (y > 0, -(size as isize)), (y + 1 < size, size as isize)];
    beside.into_iter().filter(|(is_in, _)| *is_in).map(move |(_, step)| pixel.wrapping_add_signed(step))
}
