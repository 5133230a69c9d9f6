//! Placement of assets in a room: on the floor, at walls, on walls, on other assets, under the ceiling.
//!
//! Enters: assets, in the order of importance. Leaves: placed assets. Invariant: no two of them overlap, except for an asset
//! and the one it stands on. A method returns the index of the placed asset, or `None` if no free position was found.

use glam::{DVec2, DVec3};
use strum::VariantArray;

use super::asset::Asset;
use super::color::Palette;
use super::footprint::Footprint;
use super::placement::Placement;
use super::rng::SceneRng;
use super::shell::{Shell, Wall};

/// Distance between the back of furniture and the wall, m: more than the depth of the skirting board.
const WALL_GAP: f64 = 0.03;

/// Minimum distance between objects on the floor, m.
const FLOOR_GAP: f64 = 0.03;

/// An asset with its placement in the scene.
pub(super) struct PlacedAsset {
    /// The asset.
    pub(super) asset: Asset,
    /// World from object.
    pub(super) world_from_object: Placement,
}

/// Position of an asset.
#[derive(Debug, Clone, Copy)]
struct Spot {
    /// World position of its base.
    at: DVec3,
    /// Rotation about the up axis.
    yaw_rad: f64,
}

/// A room that is being furnished.
pub(super) struct SceneBuilder<'a> {
    /// The room.
    pub(super) shell: &'a Shell,
    /// Colors of the room.
    pub(super) palette: Palette,
    /// Random numbers of the furnishing.
    pub(super) rng: SceneRng,
    /// Assets placed so far.
    pub(super) placed: Vec<PlacedAsset>,
    /// Volumes that stay free.
    pub(super) reserved: Vec<Footprint>,
    /// Footprints of `placed`.
    footprints: Vec<Footprint>,
}

impl<'a> SceneBuilder<'a> {
    /// An empty room.
    pub(super) fn new(shell: &'a Shell, palette: &Palette, rng: SceneRng) -> Self {
        Self { shell, palette: *palette, rng, placed: Vec::new(), reserved: Vec::new(), footprints: Vec::new() }
    }

    /// Reserves an aisle over the whole width, from `low` to `high` along z. Only rugs may lie in it.
    pub(super) fn reserve_aisle(&mut self, low: f64, high: f64) {
        let (center, half) =
            (DVec2::new(0.0, f64::midpoint(low, high)), DVec2::new(self.shell.half.x - 0.4, (high - low) / 2.0));
        self.reserve(center, half);
    }

    /// Reserves a rectangle of the floor. Only rugs may lie in it.
    pub(super) fn reserve(&mut self, center: DVec2, half: DVec2) {
        self.reserved.push(Footprint { center, half, yaw_rad: 0.0, low: 0.05, high: 2.1 });
    }

    /// Places an asset if the position is free; it may overlap the asset with the index `ignore`.
    fn try_place(&mut self, asset: Asset, spot: Spot, ignore: Option<usize>) -> Option<usize> {
        let (low, high) = asset.bounds();
        let mut footprint = Footprint::of_box([low, high], spot.at, spot.yaw_rad);
        // The lowest 2 cm do not count, so that furniture can stand on rugs.
        footprint.low = footprint.low.max(if spot.at.y == 0.0 && footprint.high > 0.05 { 0.02 } else { footprint.low });
        let half_extents = footprint.half_extents() - 1e-9;
        if (footprint.center.abs() + half_extents).cmpgt(self.shell.half - 1e-6).any()
            || footprint.high > self.shell.height + 1e-6
        {
            return None;
        }
        let gap = if spot.at.y > 0.0 { 0.012 } else { FLOOR_GAP };
        let others = self.footprints.iter().enumerate().filter(|(i, _)| Some(*i) != ignore).map(|(_, other)| other);
        if others.chain(&self.reserved).any(|other| footprint.overlaps(other, gap)) {
            return None;
        }
        self.footprints.push(footprint);
        self.placed.push(PlacedAsset { asset, world_from_object: Placement::facing(spot.at, spot.yaw_rad) });
        Some(self.placed.len() - 1)
    }

    /// Places an asset on the floor at (x, z).
    pub(super) fn place_on_floor(&mut self, asset: Asset, at: DVec2, yaw_rad: f64) -> Option<usize> {
        self.try_place(asset, Spot { at: DVec3::new(at.x, 0.0, at.y), yaw_rad }, None)
    }

    /// Places an asset with its back to a wall, `along` m from the wall's middle, to the right as seen from inside.
    pub(super) fn place_at_wall(&mut self, asset: Asset, wall: Wall, along: f64) -> Option<usize> {
        let off = DVec3::new(along, 0.0, asset.size().z / 2.0 + WALL_GAP);
        let at = self.shell.world_from_wall(wall).apply(off);
        self.try_place(asset, Spot { at, yaw_rad: wall.yaw_rad() }, None)
    }

    /// Places an asset at a random position of a section of a wall.
    pub(super) fn place_along_wall(&mut self, asset: &Asset, wall: Wall, [low, high]: [f64; 2]) -> Option<usize> {
        (0..14).find_map(|_| {
            let along = self.rng.range(low, high);
            self.place_at_wall(asset.clone(), wall, along)
        })
    }

    /// Places an asset at a random position of any wall.
    pub(super) fn place_at_any_wall(&mut self, asset: &Asset) -> Option<usize> {
        let first = self.rng.index(4);
        (0..4).find_map(|i| {
            let wall = Wall::VARIANTS[(first + i) % 4];
            let half = self.shell.half_length(wall) - 0.1;
            self.place_along_wall(asset, wall, [-half, half])
        })
    }

    /// Hangs an asset on a wall with its lower edge at a height.
    pub(super) fn hang_on_wall(&mut self, asset: Asset, wall: Wall, [along, height]: [f64; 2]) -> Option<usize> {
        let off = DVec3::new(along, height, asset.size().z / 2.0 + 0.004);
        let at = self.shell.world_from_wall(wall).apply(off);
        self.try_place(asset, Spot { at, yaw_rad: wall.yaw_rad() }, None)
    }

    /// Hangs an asset at a random position of a wall.
    pub(super) fn hang_along_wall(&mut self, asset: &Asset, wall: Wall, height: f64) -> Option<usize> {
        let half = self.shell.half_length(wall) - asset.size().x / 2.0 - 0.15;
        (0..12).find_map(|_| {
            let along = self.rng.range(-half, half);
            self.hang_on_wall(asset.clone(), wall, [along, height])
        })
    }

    /// Hangs an asset from the ceiling.
    pub(super) fn hang_from_ceiling(&mut self, asset: Asset, at: DVec2) -> Option<usize> {
        let at = DVec3::new(at.x, self.shell.height - asset.size().y, at.y);
        self.try_place(asset, Spot { at, yaw_rad: 0.0 }, None)
    }

    /// Places an asset at a random position and rotation on another.
    pub(super) fn place_on(&mut self, host: Option<usize>, asset: &Asset) -> Option<usize> {
        let turn = self.rng.range(-0.5, 0.5);
        self.place_on_rotated(host, asset, turn)
    }

    /// As [`Self::place_on`], with a rotation of `turn` rad against the host.
    pub(super) fn place_on_rotated(&mut self, host: Option<usize>, asset: &Asset, turn: f64) -> Option<usize> {
        let host = host?;
        let world_from_host = self.placed[host].world_from_object;
        let supports = self.placed[host].asset.supports.clone();
        let (low, high) = asset.bounds();
        let half_extents = Footprint::of_box([low, high], DVec3::ZERO, turn).half_extents();
        for _ in 0..16 {
            let support = *supports.get(self.rng.index(supports.len()))?;
            let free = support.half - half_extents;
            if free.min_element() < 0.0 || high.y > support.headroom {
                continue;
            }
            let shift = DVec3::new(self.rng.range(-free.x, free.x), 0.0, self.rng.range(-free.y, free.y));
            let yaw_rad = turn + yaw_of(&world_from_host);
            let spot = Spot { at: world_from_host.apply(support.center + shift), yaw_rad };
            if let Some(index) = self.try_place(asset.clone(), spot, Some(host)) {
                return Some(index);
            }
        }
        None
    }

    /// Places an asset on another at fractions -1..=1 of the half extents of the first support surface, turned by
    /// `turn` rad.
    pub(super) fn place_on_at(
        &mut self,
        host: Option<usize>,
        asset: Asset,
        frac: [f64; 2],
        turn: f64,
    ) -> Option<usize> {
        let host = host?;
        let world_from_host = self.placed[host].world_from_object;
        let support = *self.placed[host].asset.supports.first()?;
        let shift = DVec3::new(support.half.x * frac[0], 0.0, support.half.y * frac[1]);
        let spot = Spot { at: world_from_host.apply(support.center + shift), yaw_rad: turn + yaw_of(&world_from_host) };
        self.try_place(asset, spot, Some(host))
    }

    /// Footprint of a placed asset.
    pub(super) fn footprint_of(&self, index: Option<usize>) -> Option<Footprint> {
        index.and_then(|i| self.footprints.get(i).copied())
    }
}

/// Rotation of a placement about the up axis, rad.
fn yaw_of(placement: &Placement) -> f64 {
    let front = placement.rotation * DVec3::Z;
    front.x.atan2(front.z)
}
