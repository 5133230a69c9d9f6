use cinesplat_scene::Gaussians;
use glam::{DQuat, DVec3};

/// An object of a generated scene: an exact box and a unique name.
#[derive(Debug, Clone, PartialEq)]
pub struct SynthObject {
    /// Id from 1 up: the value in [`SynthScene::labels`].
    pub id: u32,
    /// Name, unique in the scene, such as `green armchair`.
    pub label: String,
    /// Center of the box, world, m.
    pub center: DVec3,
    /// Half extents along the axes of the box, m: the smallest box around the one-sigma ellipsoids of the object's
    /// Gaussians. It matches the outline of the shape to a fraction of a surface cell.
    pub half_extents: DVec3,
    /// World from box: a rotation about the up axis.
    pub rotation: DQuat,
}

/// A generated scene with exact objects. World: y up, lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct SynthScene {
    /// The Gaussians, with display-encoded colors of degree 0 or 1.
    pub gaussians: Gaussians,
    /// Objects in order of their ids.
    pub objects: Vec<SynthObject>,
    /// Object id per Gaussian; 0 = floor, walls, ceiling and the view through the windows.
    pub labels: Vec<u16>,
    /// World up, unit.
    pub up: DVec3,
    /// Center and half extents of an empty axis-aligned box in the world: space for a camera.
    pub free_space: [DVec3; 2],
}
