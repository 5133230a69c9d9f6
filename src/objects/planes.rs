//! The large level and upright planes of a scene: floor, ceiling, walls, and support planes such as table tops.
//!
//! Enters: voxels with normals. Leaves: planes with their voxels, by seeded RANSAC (Fischler and Bolles 1981). Up is
//! known, so that one voxel with its normal defines a candidate plane.

use glam::Vec3;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::voxels::{Voxel, VoxelGrid};

/// The role of a plane in the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlaneKind {
    /// Lowest level plane.
    Floor,
    /// Highest level plane.
    Ceiling,
    /// Upright plane with the scene on one side only.
    Wall,
    /// Any other level plane: a table, counter or shelf.
    Support,
}

/// A plane and the voxels on it.
#[derive(Debug, Clone)]
pub(crate) struct ScenePlane {
    pub(crate) kind: PlaneKind,
    /// Unit normal; that of floor, ceiling and walls points into the scene.
    pub(crate) normal: Vec3,
    /// `normal . p` for the points p on it.
    pub(crate) offset: f32,
    /// Extent in the plane: of a wall along `up x normal` (unbounded along up), of a level plane along x and z.
    pub(crate) extent: [(f32, f32); 2],
    pub(crate) voxels: Vec<usize>,
}

impl ScenePlane {
    /// Signed distance of a local position along the normal.
    pub(crate) fn height(&self, local: Vec3) -> f32 {
        self.normal.dot(local) - self.offset
    }

    /// The same plane with the opposite normal.
    fn flipped(&self) -> Self {
        let [run, other] = self.extent;
        let extent = if self.is_level() { self.extent } else { [(-run.1, -run.0), other] };
        Self { normal: -self.normal, offset: -self.offset, extent, ..self.clone() }
    }

    fn is_level(&self) -> bool {
        self.normal.y.abs() > 0.5
    }

    /// Whether a local position lies in the outer part of a level plane's extent.
    pub(crate) fn is_border(&self, local: Vec3) -> bool {
        let is_outer = |range: (f32, f32), value: f32| {
            (value - f32::midpoint(range.0, range.1)).abs() > (0.5 - BORDER_FRAC) * length(range)
        };
        is_outer(self.extent[0], local.x) || is_outer(self.extent[1], local.z)
    }

    /// Whether the projection of a local position onto the plane lies in the plane's extent.
    pub(crate) fn spans(&self, local: Vec3) -> bool {
        let along = if self.is_level() { Vec3::X } else { Vec3::Y.cross(self.normal) };
        let holds = |range: (f32, f32), value: f32| range.0 <= value && value <= range.1;
        holds(self.extent[0], along.dot(local)) && (!self.is_level() || holds(self.extent[1], local.z))
    }
}

/// Width of a level plane's border over its extent.
const BORDER_FRAC: f32 = 0.12;

/// An unbounded range.
const UNBOUNDED: (f32, f32) = (f32::NEG_INFINITY, f32::INFINITY);

/// Largest distance of an inlier from its plane, cells.
const ON_PLANE_CELLS: f32 = 1.2;

/// Least cosine between the normals of an inlier and its plane.
const MIN_NORMAL_COSINE: f32 = 0.85;

/// Limit on the planes per scene.
const MAX_PLANES: usize = 40;

/// Candidates per plane.
const NUM_CANDIDATES: usize = 160;

/// Voxels on which candidates are scored.
const NUM_SCORED: usize = 4000;

/// Largest share of voxels under a floor, over a ceiling or behind a wall.
const BEYOND_FRAC: f32 = 0.06;

/// Largest distance of a wall from the side of the room, over the room's extent.
const SIDE_FRAC: f32 = 0.05;

/// Largest share of voxels behind a wall at the side of a room with floor and ceiling: the recesses of its windows.
const BEYOND_SIDE_FRAC: f32 = 0.14;

/// The planes with at least `min_voxels` voxels, largest first. Upright planes that are not walls are dropped.
pub(crate) fn find_planes(grid: &VoxelGrid, min_voxels: usize, seed: u64) -> Vec<ScenePlane> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut free: Vec<usize> = (0..grid.voxels.len()).filter(|&v| gravity_normal(&grid.voxels[v]).is_some()).collect();
    let mut planes = Vec::new();
    for _ in 0..MAX_PLANES {
        if free.len() < min_voxels {
            break;
        }
        let Some((normal, offset)) = best_candidate(grid, &free, &mut random) else { break };
        let plane = refined(grid, &free, normal, offset);
        if plane.voxels.len() < min_voxels {
            break;
        }
        free.retain(|v| plane.voxels.binary_search(v).is_err());
        planes.push(plane);
    }
    classify(grid, planes)
}

/// The normal of a voxel, snapped to up or to horizontal where it is close to it; `None` for slanted ones.
fn gravity_normal(voxel: &Voxel) -> Option<Vec3> {
    let rise = voxel.normal.y.abs();
    if rise > 0.93 {
        return Some(Vec3::Y);
    }
    let level = Vec3::new(voxel.normal.x, 0.0, voxel.normal.z).try_normalize()?;
    (rise < 0.25).then_some(level)
}

fn on_plane(grid: &VoxelGrid, voxel: usize, normal: Vec3, offset: f32) -> bool {
    let voxel = &grid.voxels[voxel];
    let off = (normal.dot(voxel.position) - offset).abs();
    off <= ON_PLANE_CELLS * grid.cell && voxel.normal.dot(normal).abs() >= MIN_NORMAL_COSINE
}

fn best_candidate(grid: &VoxelGrid, free: &[usize], random: &mut Pcg64Mcg) -> Option<(Vec3, f32)> {
    let scored: Vec<usize> = free.iter().copied().step_by(free.len().div_ceil(NUM_SCORED)).collect();
    let mut best = (0, None);
    for _ in 0..NUM_CANDIDATES {
        let voxel = &grid.voxels[free[(random.next_u64() % free.len() as u64) as usize]];
        let Some(normal) = gravity_normal(voxel) else { continue };
        let offset = normal.dot(voxel.position);
        let num_inliers = scored.iter().filter(|&&v| on_plane(grid, v, normal, offset)).count();
        if num_inliers > best.0 {
            best = (num_inliers, Some((normal, offset)));
        }
    }
    best.1
}

/// The plane refitted to its inliers in three iterations: the offset, and the heading of an upright plane.
fn refined(grid: &VoxelGrid, free: &[usize], normal: Vec3, offset: f32) -> ScenePlane {
    let (mut normal, mut offset) = (normal, offset);
    for _ in 0..3 {
        let inliers: Vec<Vec3> =
            free.iter().filter(|&&v| on_plane(grid, v, normal, offset)).map(|&v| grid.voxels[v].position).collect();
        let mean = inliers.iter().sum::<Vec3>() / inliers.len().max(1) as f32;
        if normal.y.abs() < 0.5 {
            let along = Vec3::Y.cross(normal);
            let (spread, skew) = inliers.iter().fold((0.0, 0.0), |(spread, skew), p| {
                let (a, n) = (along.dot(*p - mean), normal.dot(*p - mean));
                (spread + a * a, skew + a * n)
            });
            let slope: f32 = if spread > 0.0 { skew / spread } else { 0.0 };
            normal = (normal - along * slope).normalize_or(normal);
        }
        offset = normal.dot(mean);
    }
    let voxels = free.iter().copied().filter(|&v| on_plane(grid, v, normal, offset)).collect();
    ScenePlane { kind: PlaneKind::Support, normal, offset, extent: [UNBOUNDED; 2], voxels }
}

/// Extent of some voxels along a direction, without the outer 2 % at both ends.
fn extent_along(grid: &VoxelGrid, voxels: impl Iterator<Item = usize>, direction: Vec3) -> (f32, f32) {
    extent_without(grid, voxels, direction, 50)
}

/// Extent of some voxels along a direction, where at both ends one of so many is `astray`.
pub(crate) fn extent_without(
    grid: &VoxelGrid,
    voxels: impl Iterator<Item = usize>,
    direction: Vec3,
    astray: usize,
) -> (f32, f32) {
    let mut values: Vec<f32> = voxels.map(|v| direction.dot(grid.voxels[v].position)).collect();
    values.sort_unstable_by(f32::total_cmp);
    let Some(last) = values.len().checked_sub(1) else { return (0.0, 0.0) };
    (values[last / astray], values[last - last / astray])
}

fn length((low, high): (f32, f32)) -> f32 {
    high - low
}

/// Determines the kind of each plane. Upright planes that are not walls are dropped.
fn classify(grid: &VoxelGrid, planes: Vec<ScenePlane>) -> Vec<ScenePlane> {
    let footprint = {
        let (x, z) =
            (extent_along(grid, 0..grid.voxels.len(), Vec3::X), extent_along(grid, 0..grid.voxels.len(), Vec3::Z));
        length(x) * length(z) / (grid.cell * grid.cell)
    };
    let (level, upright): (Vec<_>, Vec<_>) = planes.into_iter().partition(ScenePlane::is_level);
    let mut classified: Vec<ScenePlane> = level.into_iter().map(|plane| as_level(grid, plane, footprint)).collect();
    if room_box(&classified).is_none()
        && let Some(lid) = lid(grid, &classified)
    {
        classified.push(lid);
        let walls = room_box(&classified).map_or(Vec::new(), |room| walls_of_room(grid, &upright, room));
        if num_sides(&walls) >= MIN_SIDES {
            classified.extend(walls);
            return classified;
        }
        classified.pop();
    }
    if let Some(room) = room_box(&classified) {
        classified.extend(walls_of_room(grid, &upright, room));
    } else {
        let ends = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| extent_along(grid, 0..grid.voxels.len(), axis));
        let room = (Vec3::from_array(ends.map(|end| end.0)), Vec3::from_array(ends.map(|end| end.1)));
        classified.extend(upright.into_iter().filter_map(|plane| as_wall(grid, plane, room, BEYOND_FRAC)));
    }
    classified
}

/// The walls of a room with a floor and a ceiling.
fn walls_of_room(grid: &VoxelGrid, upright: &[ScenePlane], room: (Vec3, Vec3)) -> Vec<ScenePlane> {
    let walls = upright.iter().filter_map(|plane| as_wall(grid, plane.clone(), room, BEYOND_SIDE_FRAC));
    let walls: Vec<ScenePlane> = walls.filter(|wall| is_at_side(wall, room)).collect();
    walls.iter().filter(|wall| walls.iter().all(|other| !hangs_before(grid, (wall, other), room))).cloned().collect()
}

/// Largest distance of curtains from their wall, over the room's extent, and least size of the wall over theirs.
const HANGING_FRAC: f32 = 0.1;
const LARGER: usize = 2;

/// Least height by which a wall is higher than wardrobes or shelves before it, over the room's.
const HIGHER_FRAC: f32 = 0.1;

/// Whether an upright plane is that of curtains, wardrobes or the backs of shelves just before a wall.
fn hangs_before(grid: &VoxelGrid, (plane, wall): (&ScenePlane, &ScenePlane), (low, high): (Vec3, Vec3)) -> bool {
    let gap = plane.offset - wall.offset;
    let is_near = gap > 0.0 && gap < HANGING_FRAC * plane.normal.abs().dot(high - low);
    let top = |plane: &ScenePlane| extent_along(grid, plane.voxels.iter().copied(), Vec3::Y).1;
    let is_larger =
        || wall.voxels.len() >= LARGER * plane.voxels.len() || top(wall) - top(plane) >= HIGHER_FRAC * (high - low).y;
    is_near && plane.normal.dot(wall.normal) > 0.95 && is_larger()
}

/// Least number of sides with walls of a room whose ceiling was not captured.
const MIN_SIDES: usize = 4;

/// Number of directions in which walls face, of four.
fn num_sides(walls: &[ScenePlane]) -> usize {
    let faces = |direction: Vec3| walls.iter().any(|wall| wall.normal.dot(direction) > 0.9);
    [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z].into_iter().filter(|&direction| faces(direction)).count()
}

/// Share of the voxels over a floor that may lie above the lid of its room: lamps, floaters.
const OVER_LID_FRAC: f64 = 0.002;

/// The ceiling of a room that was captured without one: a plane without voxels just over the walls that stand on the
/// largest floor; `None` without a floor.
fn lid(grid: &VoxelGrid, planes: &[ScenePlane]) -> Option<ScenePlane> {
    let floors = planes.iter().filter(|plane| plane.kind == PlaneKind::Floor);
    let floor = floors.max_by_key(|plane| plane.voxels.len())?;
    let grown = |range: (f32, f32)| {
        let margin = SIDE_FRAC * length(range) + 2.0 * grid.cell;
        (range.0 - margin, range.1 + margin)
    };
    let reach = ScenePlane { extent: floor.extent.map(grown), voxels: Vec::new(), ..floor.clone() };
    let over = grid.voxels.iter().map(|voxel| voxel.position).filter(|&p| reach.spans(p));
    let mut heights: Vec<f32> = over.map(|p| p.y).collect();
    let at = heights.len().checked_sub(1 + (heights.len() as f64 * OVER_LID_FRAC) as usize)?;
    let top = *heights.select_nth_unstable_by(at, f32::total_cmp).1 + 2.0 * grid.cell;
    let extent = floor.extent;
    Some(ScenePlane { kind: PlaneKind::Ceiling, normal: Vec3::NEG_Y, offset: -top, extent, voxels: Vec::new() })
}

/// A level plane with its extent and kind.
fn as_level(grid: &VoxelGrid, mut plane: ScenePlane, footprint: f32) -> ScenePlane {
    let ends = |axis| extent_along(grid, plane.voxels.iter().copied(), axis);
    plane.extent = [ends(Vec3::X), ends(Vec3::Z)];
    plane.kind = level_kind(grid, &plane, footprint);
    plane.normal = if plane.kind == PlaneKind::Ceiling { Vec3::NEG_Y } else { Vec3::Y };
    plane.offset = plane.voxels.iter().map(|&v| plane.normal.dot(grid.voxels[v].position)).sum::<f32>()
        / plane.voxels.len() as f32;
    plane
}

/// Whether a wall lies at a side of the room or outside: the fronts of wardrobes and shelves lie inside.
fn is_at_side(wall: &ScenePlane, (low, high): (Vec3, Vec3)) -> bool {
    let half = wall.normal.abs().dot(high - low) / 2.0;
    wall.height((low + high) / 2.0) > (1.0 - 2.0 * SIDE_FRAC) * half
}

/// Whether planes are those of a closed room: a floor, a ceiling and walls.
pub(crate) fn is_closed_room(planes: &[ScenePlane]) -> bool {
    planes.iter().any(|plane| plane.kind == PlaneKind::Wall) && room_box(planes).is_some()
}

/// Corners of the box between the largest floor and the largest ceiling; `None` without both. What is seen through windows
/// lies outside.
pub(crate) fn room_box(planes: &[ScenePlane]) -> Option<(Vec3, Vec3)> {
    let largest =
        |kind: PlaneKind| planes.iter().filter(|plane| plane.kind == kind).max_by_key(|plane| plane.voxels.len());
    let (floor, ceiling) = (largest(PlaneKind::Floor)?, largest(PlaneKind::Ceiling)?);
    let span = |axis: usize| {
        let (a, b) = (floor.extent[axis], ceiling.extent[axis]);
        (a.0.min(b.0), a.1.max(b.1))
    };
    let (x, z) = (span(0), span(1));
    Some((Vec3::new(x.0, floor.offset, z.0), Vec3::new(x.1, -ceiling.offset, z.1)))
}

/// Share of the voxels over the plane's extent that lie just behind the plane, on the side of `-normal`: from two cells
/// to an eighth of the scene's longest side behind it. Voxels farther behind may be the view through a window.
fn share_behind(grid: &VoxelGrid, plane: &ScenePlane) -> f32 {
    let sides = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| length(extent_along(grid, 0..grid.voxels.len(), axis)));
    let near = -2.0 * grid.cell;
    let far = near.min(-sides.into_iter().fold(0.0, f32::max) / 8.0);
    let heights = || grid.voxels.iter().filter(|v| plane.spans(v.position)).map(|v| plane.height(v.position));
    let behind = heights().filter(|height| (far..near).contains(height)).count();
    behind as f32 / heights().count().max(1) as f32
}

/// A level plane is a floor with most of the scene over it, or a ceiling with most of it below, where few voxels lie beyond
/// it and it covers a seventh of the scene's footprint.
fn level_kind(grid: &VoxelGrid, plane: &ScenePlane, footprint: f32) -> PlaneKind {
    let wide = plane.voxels.len() as f32 > footprint / 7.0;
    let off = |v: &Voxel| plane.height(v.position) / grid.cell;
    let num_over = grid.voxels.iter().filter(|v| off(v) > ON_PLANE_CELLS).count();
    let num_under = grid.voxels.iter().filter(|v| off(v) < -ON_PLANE_CELLS).count();
    let is_low = num_over >= num_under;
    if wide && is_low && share_behind(grid, plane) < BEYOND_FRAC {
        PlaneKind::Floor
    } else if wide && !is_low && share_behind(grid, &plane.flipped()) < BEYOND_FRAC {
        PlaneKind::Ceiling
    } else {
        PlaneKind::Support
    }
}

/// An upright plane is a wall where few voxels lie behind it, it is at least half as high as the room and a quarter as
/// long, and the room before it is at least a third as deep as the plane is long. Sides of objects do not meet this.
fn as_wall(grid: &VoxelGrid, plane: ScenePlane, room: (Vec3, Vec3), max_behind: f32) -> Option<ScenePlane> {
    let along = Vec3::Y.cross(plane.normal);
    let on = || plane.voxels.iter().copied();
    let ends = extent_along(grid, on(), along);
    let (height, run) = (length(extent_along(grid, on(), Vec3::Y)), length(ends));
    let room = [Vec3::Y, along, plane.normal].map(|direction| (room.1 - room.0).dot(direction.abs()));
    let covered = plane.voxels.len() as f32 * grid.cell * grid.cell > 0.2 * height * run;
    let large = height >= 0.5 * room[0] && run >= 0.25 * room[1] && room[2] >= run / 3.0;
    if !(large && covered) {
        return None;
    }
    // `extent_along` drops the outer 2 %: the margin extends the wall to its corners.
    let margin = 0.03 * run + 2.0 * grid.cell;
    let facing = ScenePlane { kind: PlaneKind::Wall, extent: [(ends.0 - margin, ends.1 + margin), UNBOUNDED], ..plane };
    let away = facing.flipped();
    let (behind, before) = (share_behind(grid, &facing), share_behind(grid, &away));
    (behind.min(before) < max_behind).then_some(if behind <= before { facing } else { away })
}
