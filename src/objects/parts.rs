//! Parts of single things: the neck and body of a guitar, the crown and pot of a plant.
//!
//! Enters: the voxels of a whole. Leaves: up to four parts along its longest upright or level axis, cut where its width or
//! color changes.

use glam::{Vec3, Vec4};

use super::groups::VoxelGroup;
use super::person;
use super::slices::Slice;
use super::standing::extent;
use super::voxels::VoxelGrid;

/// Least number of voxels of a thing with parts.
const MIN_VOXELS: usize = 400;

/// Limit on the parts of a thing.
const MAX_PARTS: usize = 4;

/// Least length of a part over that of the whole.
const MIN_LENGTH: f32 = 0.1;

/// Least share of a whole's voxels in a part; a smaller one joins the part below it.
const MIN_SHARE: f32 = 0.06;

/// Share of the deviation that a further part must take away.
const GAIN: f32 = 0.3;

/// Height over the longer level side from which a thing is divided along its height.
const UPRIGHT: f32 = 0.6;

/// Length over the other sides from which a lying thing is divided along its length.
const LONG: f32 = 2.5;

/// Height over width (standard deviation of the widest part) of a tall thing.
const TALL: f32 = 4.0;

/// Length of the neck of an instrument over its width (standard deviation), at least.
const LONG_NECK: f32 = 6.0;

/// Weight of a doubling of the width, and of a color difference of 30 units of CIE Lab, is 1 each.
const LAB_SCALE: f32 = 1.0 / 30.0;

/// Adds the parts of every whole that has no parts yet. Parts take all voxels of their whole.
pub(crate) fn divide(grid: &VoxelGrid, groups: &mut Vec<VoxelGroup>) {
    for whole in 0..groups.len() {
        let is_whole = groups[whole].parent.is_none() && groups.iter().all(|group| group.parent != Some(whole));
        if !is_whole || groups[whole].voxels.len() < MIN_VOXELS {
            continue;
        }
        let (axis, slices) = slices(grid, &groups[whole].voxels);
        if slices.len() < 2 * MAX_PARTS {
            continue;
        }
        let cuts = without_crumbs(cuts(&slices), &slices);
        if cuts.len() < 2 {
            continue;
        }
        let names = names((axis, 2.0 * grid.cell), &slices, &cuts);
        groups[whole].voxels.clear();
        for (&(start, end), name) in cuts.iter().zip(names) {
            let voxels = slices[start..end].iter().flat_map(|slice| slice.voxels.iter().copied()).collect();
            groups.push(VoxelGroup { voxels, is_surface: false, parent: Some(whole), name: Some(name) });
        }
    }
}

/// The ranges, with those of few voxels joined to their neighbors.
fn without_crumbs(cuts: Vec<(usize, usize)>, slices: &[Slice]) -> Vec<(usize, usize)> {
    let count = |(start, end): (usize, usize)| slices[start..end].iter().map(|slice| slice.voxels.len()).sum::<usize>();
    let least = (count((0, slices.len())) as f32 * MIN_SHARE) as usize;
    let mut kept: Vec<(usize, usize)> = Vec::new();
    for range in cuts {
        match kept.last_mut() {
            Some(below) if count(range) < least || count(*below) < least => below.1 = range.1,
            _ => kept.push(range),
        }
    }
    kept
}

/// The axis along which a thing is divided (1 = up), and its slices from the lower end on.
fn slices(grid: &VoxelGrid, voxels: &[usize]) -> (usize, Vec<Slice>) {
    let (low, high) = extent(grid, voxels);
    let sides = high - low;
    let level = if sides.x >= sides.z { 0 } else { 2 };
    let axis = if sides.y >= UPRIGHT * sides[level] { 1 } else { level };
    // What is neither upright nor long has no ends.
    if axis != 1 && sides[level] < LONG * sides[2 - level].max(sides.y) {
        return (axis, Vec::new());
    }
    let step = 2.0 * grid.cell;
    let count = (sides[axis] / step).floor() as usize + 1;
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
    for &voxel in voxels {
        let at = ((grid.voxels[voxel].position[axis] - low[axis]) / step) as usize;
        members[at.min(count - 1)].push(voxel);
    }
    members.retain(|members| !members.is_empty());
    (axis, members.into_iter().map(|voxels| slice(grid, voxels, axis)).collect())
}

fn slice(grid: &VoxelGrid, voxels: Vec<usize>, axis: usize) -> Slice {
    let count = voxels.len() as f32;
    let mut across = Vec3::ONE;
    across[axis] = 0.0;
    let middle = voxels.iter().map(|&v| grid.voxels[v].position).sum::<Vec3>() / count;
    let square = |&v: &usize| ((grid.voxels[v].position - middle) * across).length_squared();
    let width = (voxels.iter().map(square).sum::<f32>() / count).sqrt().max(0.5 * grid.cell);
    let color_lab = voxels.iter().map(|&v| grid.voxels[v].color_lab).sum::<Vec3>() / count;
    let features = (color_lab * LAB_SCALE * Vec3::new(0.5, 1.0, 1.0)).extend((width / grid.cell).log2());
    let skin = voxels.iter().filter(|&&v| person::is_skin(grid.voxels[v].color_lab)).count();
    Slice { features, width, color_lab, skin_frac: skin as f32 / count, voxels }
}

/// Ranges of slices, one per part: the division of least squared deviation, with as many parts as pay.
fn cuts(slices: &[Slice]) -> Vec<(usize, usize)> {
    let count = slices.len();
    let least = ((count as f32 * MIN_LENGTH).ceil() as usize).max(2);
    // Sums of the first slices give the deviation of any range.
    let mut sums = vec![(Vec4::ZERO, 0.0_f32)];
    for slice in slices {
        let (sum, square) = sums[sums.len() - 1];
        sums.push((sum + slice.features, square + slice.features.length_squared()));
    }
    let deviation = |start: usize, end: usize| {
        let (sum, square) = (sums[end].0 - sums[start].0, sums[end].1 - sums[start].1);
        (square - sum.length_squared() / (end - start) as f32).max(0.0)
    };
    let first = |end: usize| (if end > 0 { deviation(0, end) } else { f32::INFINITY }, vec![(0, end)]);
    let mut best: Vec<(f32, Vec<(usize, usize)>)> = (0..=count).map(first).collect();
    let mut chosen = (best[count].0, vec![(0, count)]);
    for _ in 1..MAX_PARTS {
        let mut next: Vec<(f32, Vec<(usize, usize)>)> = vec![(f32::INFINITY, Vec::new()); count + 1];
        for (end, split) in next.iter_mut().enumerate().skip(2 * least) {
            for (start, (cost, ranges)) in best.iter().enumerate().take(end - least + 1).skip(least) {
                let total = cost + deviation(start, end);
                if total < split.0 {
                    *split = (total, ranges.iter().copied().chain([(start, end)]).collect());
                }
            }
        }
        if next[count].0 < (1.0 - GAIN) * chosen.0 {
            chosen = next[count].clone();
        } else {
            break;
        }
        best = next;
    }
    chosen.1
}

/// Names of the parts, from the lower end on. `scale`: the axis, and the thickness of a slice.
fn names(scale: (usize, f32), slices: &[Slice], cuts: &[(usize, usize)]) -> Vec<&'static str> {
    let (axis, step) = scale;
    if axis != 1 {
        return match cuts.len() {
            2 => vec!["one end", "other end"],
            3 => vec!["one end", "middle", "other end"],
            _ => vec!["one end", "first half", "second half", "other end"],
        };
    }
    let length = |part: usize| (cuts[part].1 - cuts[part].0) as f32 / slices.len() as f32;
    let mean = |part: usize, value: &dyn Fn(&Slice) -> f32| {
        let (start, end) = cuts[part];
        slices[start..end].iter().map(value).sum::<f32>() / (end - start) as f32
    };
    let width = |part: usize| mean(part, &|slice| slice.width);
    let green = |part: usize| mean(part, &|slice| -slice.color_lab.y);
    let top = cuts.len() - 1;
    let widest = (0..cuts.len()).map(width).fold(0.0, f32::max);
    let is_tall = slices.len() as f32 * step > TALL * widest;
    let is_long = |part: usize| length(part) * slices.len() as f32 * step > LONG_NECK * width(part);
    let has_head = cuts.len() < 4 && person::has_head(step, slices, cuts[top]);
    match cuts.len() {
        2 if green(top) > 3.0 && green(0) < 0.5 * green(top) => vec!["pot", "crown"],
        2 if has_head => vec!["body", "head"],
        2 if is_tall && width(1) < 0.5 * width(0) && length(1) > 0.3 && is_long(1) => vec!["body", "neck"],
        2 => vec!["base", "top"],
        3 if has_head && length(0) < 0.55 => vec!["legs", "trunk", "head"],
        3 => vec!["base", "middle", "top"],
        _ => vec!["base", "lower part", "upper part", "top"],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slices 5 units thick of so many units of width (standard deviation) and of a color.
    fn stack(parts: &[(usize, f32, Vec3)]) -> (Vec<Slice>, Vec<(usize, usize)>) {
        let mut slices = Vec::new();
        let mut cuts = Vec::new();
        for &(count, width, color_lab) in parts {
            cuts.push((slices.len(), slices.len() + count));
            let skin_frac = f32::from(u8::from(person::is_skin(color_lab)));
            let slice = |_| Slice { voxels: Vec::new(), features: Vec4::ZERO, width, color_lab, skin_frac };
            slices.extend((0..count).map(slice));
        }
        (slices, cuts)
    }

    const SKIN: Vec3 = Vec3::new(60.0, 15.0, 20.0);
    const CLOTH: Vec3 = Vec3::new(40.0, 2.0, -10.0);
    const WHITE: Vec3 = Vec3::new(80.0, 0.0, 3.0);

    fn named(parts: &[(usize, f32, Vec3)], joined: &[(usize, usize)]) -> Vec<&'static str> {
        let (slices, _) = stack(parts);
        names((1, 5.0), &slices, joined)
    }

    #[test]
    fn only_a_person_has_a_head() {
        // Legs and trunk, a neck, a head: a standing person of 180 units.
        let person = [(24, 16.0, CLOTH), (5, 18.0, CLOTH), (2, 6.0, SKIN), (5, 8.5, SKIN)];
        assert_eq!(named(&person, &[(0, 29), (29, 36)]), ["body", "head"]);
        let bust = [(10, 18.0, CLOTH), (1, 6.0, SKIN), (5, 8.5, SKIN)];
        assert_eq!(named(&bust, &[(0, 10), (10, 16)]), ["body", "head"]);
        // A kettle on a cloth, and a statue without skin.
        let kettle = [(2, 24.0, CLOTH), (12, 14.0, WHITE), (2, 12.0, WHITE)];
        assert_eq!(named(&kettle, &[(0, 2), (2, 14), (14, 16)]), ["base", "middle", "top"]);
        let pawn = [(10, 18.0, WHITE), (1, 6.0, WHITE), (5, 8.5, WHITE)];
        assert_eq!(named(&pawn, &[(0, 10), (10, 16)]), ["base", "top"]);
    }

    #[test]
    fn a_guitar_keeps_its_neck() {
        let wood = Vec3::new(40.0, 15.0, 25.0);
        let guitar = [(12, 16.0, wood), (18, 3.0, wood)];
        assert_eq!(named(&guitar, &[(0, 12), (12, 30)]), ["body", "neck"]);
    }
}
