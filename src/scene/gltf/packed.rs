//! Primitives compressed as SPZ (`KHR_gaussian_splatting_compression_spz_2`). The numbers of the SPZ are coordinates of the
//! glTF's node, as in `CesiumJS` and in the files made for it. Drafts of the extension turn them by half a turn about +y.

use glam::Vec3;
use std::borrow::Cow;

use serde_json::Value;

use super::nodes::Placed;
use crate::decoded::DecodedScene;
use crate::error::SceneError;
use crate::gaussians::{Gaussians, NUM_SH_REST};
use crate::intake::{Intake, RawGaussian};
use crate::source_file::SourceFile;
use crate::spz;

/// Start of the names of the extension; drafts had other endings.
const EXTENSION: &str = "KHR_gaussian_splatting_compression_spz";
/// What is assumed of the axes.
pub(super) const AXES_NOTE: &str = "SPZ: its coordinates are taken as those of the glTF, as in CesiumJS; drafts of the extension turn them by 180 degrees about y";

/// Gaussians of a compressed primitive.
pub(super) struct Packed {
    pub(super) decoded: DecodedScene,
    placed: Placed,
}

/// The place of the SPZ among the buffer views, of the extensions inside a primitive's extension; `None` for others.
pub(super) fn view_of(inner: &Value) -> Option<u64> {
    let extensions = inner.as_object()?;
    let (_, spz) = extensions.iter().find(|(name, _)| name.starts_with(EXTENSION))?;
    spz.get("bufferView")?.as_u64()
}

impl Packed {
    /// The Gaussians of a buffer view.
    ///
    /// # Errors
    /// [`SceneError::Damaged`] for a view outside of its buffer, and the errors of SPZ.
    pub(super) fn read(
        source: &SourceFile,
        (json, buffers): (&Value, &[Cow<'_, [u8]>]),
        view: u64,
        placed: Placed,
    ) -> Result<Self, SceneError> {
        let outside = || SceneError::Damaged {
            path: source.path.to_path_buf(),
            byte: 0,
            reason: "an SPZ outside of its buffer".to_owned(),
        };
        let view = json.pointer(&format!("/bufferViews/{view}")).ok_or_else(outside)?;
        let number = |name: &str| view.get(name).and_then(Value::as_u64).unwrap_or(0) as usize;
        let (start, len) = (number("byteOffset"), number("byteLength"));
        let bytes = buffers.get(number("buffer")).and_then(|buffer| buffer.get(start..start.checked_add(len)?));
        let bytes = bytes.ok_or_else(outside)?;
        let decoded = spz::read(&SourceFile { bytes, ..*source })?;
        Ok(Self { decoded, placed })
    }

    fn gaussians(&self) -> &Gaussians {
        &self.decoded.collected.gaussians
    }

    /// Number of Gaussians in the SPZ, with those that were dropped.
    pub(super) fn len(&self) -> usize {
        self.decoded.collected.num_in_file()
    }

    /// Degree in the file, and the degree that is drawn: 0 under a rotated node.
    pub(super) fn degrees(&self) -> [u8; 2] {
        let degree = self.gaussians().sh_degree;
        [degree, if self.placed.is_upright() { degree } else { 0 }]
    }

    /// Adds the Gaussians with harmonics up to a degree.
    pub(super) fn push_all(&self, intake: &mut Intake, degree: u8) {
        let gaussians = self.gaussians();
        let mut rest = vec![Vec3::ZERO; NUM_SH_REST[usize::from(degree)]];
        let own = NUM_SH_REST[usize::from(self.degrees()[1])];
        let turn = self.placed.rotation;
        for kept in self.decoded.collected.in_file_order(0..self.len()) {
            let Some(idx) = kept else {
                intake.push_dropped();
                continue;
            };
            rest.iter_mut().zip(gaussians.sh_rest_of(idx)).take(own).for_each(|(to, value)| *to = *value);
            let turned = turn * gaussians.rotations[idx].as_dquat();
            let raw = RawGaussian {
                mean: self.placed.position + turn * (gaussians.mean_world(idx) * self.placed.scale),
                scale: gaussians.scales[idx].as_dvec3() * self.placed.scale,
                rotation_wxyz: [turned.w, turned.x, turned.y, turned.z],
                opacity: f64::from(gaussians.opacities[idx]),
                sh_dc: gaussians.sh_dc[idx].as_dvec3(),
            };
            intake.push(&raw, &rest);
        }
    }
}
