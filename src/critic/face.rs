//! Which way a face looks: skin below hair.

use glam::DVec3;

use super::sides::{Side, solid_rows};

/// Height of a head over its thing's largest width, and over the thing's height at most.
const HEAD_PER_WIDTH: f64 = 0.5;
const MOST_HEAD: f64 = 0.35;
/// Share of a head that is its top, where the hair is.
const TOP: f64 = 0.25;
/// Share of skin in the side of a head that shows the most of it, from which that may be a face.
const LEAST_SKIN: f64 = 0.25;
/// Share of skin at the top over that below it, up to which the top is hair.
const MOST_BARE: f64 = 0.5;
/// How much skin lies to one side, 0..=1, below which it is all around, and from which it counts once.
const EVEN: f64 = 0.1;
const ONE_SIDED: f64 = 0.2;
/// Largest vote.
const MOST: f64 = 1.5;

/// The direction that a face at the top of a thing looks, as long as it is sure, 0..=1.5; zero where there is none. `sides`
/// are spread evenly all around, and `width` is the largest one over the height.
pub(super) fn face(sides: &[Side], width: f64) -> DVec3 {
    let Some([first, last]) = solid_rows(sides) else { return DVec3::ZERO };
    let head = (last + 1 - first) as f64 * (HEAD_PER_WIDTH * width).min(MOST_HEAD);
    let row = |share: f64| first + (share * head).round() as usize;
    let (top, below) = (first..row(TOP), row(TOP)..row(1.0));
    let [bare, under] = [&top, &below].map(|rows| sides.iter().map(|side| skin(side, rows)).collect::<Vec<_>>());
    let share = |[skin, all]: [f64; 2]| skin / all.max(1.0);
    let mean = |shares: &[[f64; 2]]| shares.iter().copied().map(share).sum::<f64>() / shares.len().max(1) as f64;
    let most = under.iter().copied().map(share).fold(0.0, f64::max);
    if most < LEAST_SKIN || mean(&bare) > MOST_BARE * mean(&under) {
        return DVec3::ZERO;
    }
    let total: f64 = under.iter().map(|[skin, _]| skin).sum();
    let toward = sides.iter().zip(&under).map(|(side, [skin, _])| side.level * *skin).sum::<DVec3>() / total.max(1.0);
    toward.normalize_or_zero() * ((toward.length() - EVEN) / (ONE_SIDED - EVEN)).clamp(0.0, MOST)
}

/// Pixels of some rows that show skin, and all that show the thing.
fn skin(side: &Side, rows: &std::ops::Range<usize>) -> [f64; 2] {
    let [mut skin, mut all] = [0.0; 2];
    for y in rows.clone() {
        for x in side.solid_columns(y) {
            all += 1.0;
            skin += f64::from(is_skin(side.color(x, y)));
        }
    }
    [skin, all]
}

/// Whether a color of 0..=1 may be that of skin, light or dark: its blue and red differences of ITU-R BT.601 lie in the
/// ranges of Chai and Ngan, "Face segmentation using skin-color map", 1999.
fn is_skin([r, g, b]: [f32; 3]) -> bool {
    let luma = 0.299 * r + 0.587 * g + 0.114 * b;
    let (blue, red) = (0.564 * (b - luma), 0.713 * (r - luma));
    luma > 0.2 && (-0.2..-0.004).contains(&blue) && (0.02..0.18).contains(&red)
}

#[cfg(test)]
mod tests {
    use super::is_skin;

    #[test]
    fn skin_of_all_people_is_skin_and_neither_cloth_nor_leaves_are() {
        let from = |[r, g, b]: [u8; 3]| [r, g, b].map(|value| f32::from(value) / 255.0);
        for color in [[236, 188, 160], [198, 134, 100], [141, 85, 60], [96, 62, 46]] {
            assert!(is_skin(from(color)), "{color:?}");
        }
        for color in [[240, 240, 240], [20, 20, 22], [60, 140, 50], [40, 60, 160], [220, 20, 20], [128, 128, 128]] {
            assert!(!is_skin(from(color)), "{color:?}");
        }
    }
}
