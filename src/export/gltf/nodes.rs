//! The nodes above a camera: how each is placed in its parent.

use glam::{DAffine3, DMat4, DQuat, DVec3};

use super::super::ExportError;
use super::super::json_read::Node;

/// Deepest chain of nodes above a camera.
const MAX_DEPTH: usize = 64;

/// Transform of a node into its parent.
#[derive(Debug, Clone, Copy)]
pub(super) enum NodeTransform {
    /// Translation, rotation and scale, each of which may be animated.
    Parts(DVec3, DQuat, DVec3),
    /// A matrix.
    Matrix(DAffine3),
}

/// Values of a node that are animated, at one time.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moved {
    pub(super) position: Option<DVec3>,
    pub(super) rotation: Option<DQuat>,
    pub(super) scale: Option<DVec3>,
}

impl NodeTransform {
    pub(super) fn read(node: &Node) -> Result<Self, ExportError> {
        if let Some(matrix) = node.optional("matrix") {
            return Ok(Self::Matrix(DAffine3::from_mat4(DMat4::from_cols_array(&matrix.numbers()?))));
        }
        let position = node.optional("translation").map_or(Ok(DVec3::ZERO), |v| v.vector())?;
        let rotation = node.optional("rotation").map_or(Ok(DQuat::IDENTITY), |v| v.numbers().map(DQuat::from_array))?;
        let scale = node.optional("scale").map_or(Ok(DVec3::ONE), |v| v.vector())?;
        if !(rotation.length() > 1e-6) {
            return Err(node.error("a rotation that is not 0"));
        }
        Ok(Self::Parts(position, rotation.normalize(), scale))
    }

    /// The transform with animated values in place of its own.
    pub(super) fn affine(&self, moved: &Moved) -> DAffine3 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts(position, rotation, scale) => DAffine3::from_scale_rotation_translation(
                moved.scale.unwrap_or(scale),
                moved.rotation.unwrap_or(rotation),
                moved.position.unwrap_or(position),
            ),
        }
    }
}

/// The nodes from the root to the camera's.
pub(super) fn chain_to(nodes: &[Node], camera_node: usize) -> Vec<usize> {
    let mut chain = vec![camera_node];
    for _ in 0..MAX_DEPTH {
        let child = chain[chain.len() - 1];
        let is_parent = |node: &Node| {
            node.optional("children")
                .and_then(|list| list.number_list().ok())
                .is_some_and(|ids| ids.contains(&(child as f64)))
        };
        let Some(parent) = nodes.iter().position(is_parent) else { break };
        chain.push(parent);
    }
    chain.reverse();
    chain
}

/// The up of the scene's own world that a node above the camera states; `None` in files of other programs.
pub(super) fn scene_up(nodes: &[Node], chain: &[usize]) -> Result<Option<DVec3>, ExportError> {
    let stated = |idx: &usize| nodes[*idx].optional("extras").and_then(|extras| extras.optional("cinesplat_world_up"));
    let up = chain.iter().rev().skip(1).find_map(stated).map(|up| up.vector()).transpose()?;
    Ok(up.and_then(DVec3::try_normalize))
}
