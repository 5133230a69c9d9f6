//! The meshes of the scene and where its nodes put them.

use glam::{DMat4, DQuat, DVec3};
use serde_json::Value;

/// Deepest chain of nodes.
const MAX_DEPTH: usize = 64;

/// A mesh with its place in the world.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) mesh: u64,
    pub(super) position: DVec3,
    pub(super) rotation: DQuat,
    /// Uniform; of a stretched node the mean.
    pub(super) scale: f64,
}

impl Placed {
    /// Whether the axes are those of the world, so that harmonics keep their meaning.
    pub(super) fn is_upright(&self) -> bool {
        self.rotation.abs_diff_eq(DQuat::IDENTITY, 1e-9)
    }
}

/// The meshes that the file's scene shows, in order of its nodes.
pub(super) fn placed_meshes(json: &Value) -> Vec<Placed> {
    let nodes = json.get("nodes").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let scene = json.get("scene").and_then(Value::as_u64).unwrap_or(0);
    let roots = json.pointer(&format!("/scenes/{scene}/nodes")).and_then(Value::as_array);
    let roots: Vec<u64> = roots.map_or_else(|| (0..nodes.len() as u64).collect(), |roots| ids(roots));
    let mut stack: Vec<(u64, DMat4, usize)> = roots.into_iter().rev().map(|root| (root, DMat4::IDENTITY, 0)).collect();
    // The nodes of a glTF are a tree: each is visited once.
    let (mut found, mut seen) = (Vec::new(), vec![false; nodes.len()]);
    while let Some((idx, above, depth)) = stack.pop() {
        let Some(node) = nodes.get(idx as usize).filter(|_| depth < MAX_DEPTH && !seen[idx as usize]) else { continue };
        seen[idx as usize] = true;
        let world = above * local(node);
        if let Some(mesh) = node.get("mesh").and_then(Value::as_u64) {
            let (scale, rotation, position) = world.to_scale_rotation_translation();
            let scale = scale.abs().element_sum() / 3.0;
            found.push(Placed { mesh, position, rotation: upright(rotation), scale });
        }
        let children = node.get("children").and_then(Value::as_array).map(|children| ids(children)).unwrap_or_default();
        let unseen = children.into_iter().rev().filter(|&child| seen.get(child as usize) == Some(&false));
        stack.extend(unseen.take(nodes.len()).map(|child| (child, world, depth + 1)));
    }
    found
}

/// The same rotation with w >= 0.
fn upright(rotation: DQuat) -> DQuat {
    let unit = rotation.normalize();
    if unit.w < 0.0 { -unit } else { unit }
}

fn ids(list: &[Value]) -> Vec<u64> {
    list.iter().filter_map(Value::as_u64).collect()
}

/// The transform of a node into its parent.
fn local(node: &Value) -> DMat4 {
    let numbers = |name: &str| -> Vec<f64> {
        node.get(name).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_f64).collect()
    };
    if let Ok(matrix) = <[f64; 16]>::try_from(numbers("matrix")) {
        return DMat4::from_cols_array(&matrix);
    }
    let vector = |name: &str, default: DVec3| <[f64; 3]>::try_from(numbers(name)).map_or(default, DVec3::from_array);
    let rotation = <[f64; 4]>::try_from(numbers("rotation")).map_or(DQuat::IDENTITY, DQuat::from_array);
    let rotation = if rotation.length() > 1e-6 { rotation.normalize() } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(vector("scale", DVec3::ONE), rotation, vector("translation", DVec3::ZERO))
}
