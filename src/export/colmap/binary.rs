//! The binary form, little-endian: a u64 count, then the records; names end with a zero byte.

use glam::{DQuat, DVec3};

use super::super::ExportError;
use super::super::track::PoseTrack;
use super::model::{CameraModel, ModelCamera, ModelFiles, ModelImage, model, track};

pub(crate) fn write(track: &PoseTrack) -> ModelFiles {
    let (cameras, images) = model(track);
    let mut camera_bytes = (cameras.len() as u64).to_le_bytes().to_vec();
    for camera in &cameras {
        camera_bytes.extend(camera.id.to_le_bytes());
        camera_bytes.extend((CameraModel::Pinhole as i32).to_le_bytes());
        camera_bytes.extend(u64::from(camera.width).to_le_bytes());
        camera_bytes.extend(u64::from(camera.height).to_le_bytes());
        camera_bytes.extend(camera.pinhole_params().into_iter().flat_map(f64::to_le_bytes));
    }
    let mut image_bytes = (images.len() as u64).to_le_bytes().to_vec();
    for (idx, image) in images.iter().enumerate() {
        let [x, y, z, w] = image.rotation.to_array();
        image_bytes.extend((idx as u32 + 1).to_le_bytes());
        image_bytes.extend([w, x, y, z].into_iter().chain(image.translation.to_array()).flat_map(f64::to_le_bytes));
        image_bytes.extend(image.camera_id.to_le_bytes());
        image_bytes.extend(image.name.as_bytes());
        image_bytes.push(0);
        image_bytes.extend(0_u64.to_le_bytes());
    }
    vec![("cameras.bin", camera_bytes), ("images.bin", image_bytes), ("points3D.bin", 0_u64.to_le_bytes().to_vec())]
}

/// The track of `images.bin` and `cameras.bin`; without the latter the fields of view are unknown.
pub(crate) fn read(images: &[u8], cameras: Option<&[u8]>) -> Result<PoseTrack, ExportError> {
    let cameras = cameras.map(read_cameras).transpose()?.unwrap_or_default();
    let mut bytes = Bytes { bytes: images, offset: 0 };
    let num_images = bytes.u64("a number of images")?;
    let mut list = Vec::new();
    for _ in 0..num_images {
        list.push(read_image(&mut bytes)?);
    }
    track(list, &cameras)
}

fn read_image(bytes: &mut Bytes) -> Result<ModelImage, ExportError> {
    bytes.take::<4>("an image id")?;
    let start = bytes.offset;
    let mut v = [0.0; 7];
    for value in &mut v {
        *value = bytes.f64("a pose")?;
    }
    let rotation = DQuat::from_xyzw(v[1], v[2], v[3], v[0]);
    let translation = DVec3::new(v[4], v[5], v[6]);
    if !(rotation.length() > 1e-6 && rotation.is_finite() && translation.is_finite()) {
        let found = format!("rotation {rotation}, translation {translation}");
        return Err(ExportError::BadBytes { offset: start, found, expected: "a rigid pose".into() });
    }
    let camera_id = u32::from_le_bytes(bytes.take("a camera id")?);
    let name = bytes.text()?;
    let points = bytes.u64("a number of points")?;
    bytes.skip(points, 24)?;
    Ok(ModelImage { name, camera_id, rotation: rotation.normalize(), translation })
}

fn read_cameras(cameras: &[u8]) -> Result<Vec<ModelCamera>, ExportError> {
    let mut bytes = Bytes { bytes: cameras, offset: 0 };
    let num_cameras = bytes.u64("a number of cameras")?;
    let mut list = Vec::new();
    for _ in 0..num_cameras {
        let start = bytes.offset;
        let id = u32::from_le_bytes(bytes.take("a camera id")?);
        let number = u32::from_le_bytes(bytes.take("a camera model")?);
        let model = CameraModel::from_number(number);
        let (width, height) = (bytes.u64("a width")? as u32, bytes.u64("a height")? as u32);
        let num_params = model.map_or(0, CameraModel::num_params);
        let params = (0..num_params).map(|_| bytes.f64("a camera parameter")).collect::<Result<Vec<_>, _>>()?;
        let bad = || ExportError::BadBytes {
            offset: start,
            found: format!("model {number}, {width} x {height}"),
            expected: "a camera of a known model".into(),
        };
        let camera = model.and_then(|model| ModelCamera::new(id, model, (width, height), &params));
        list.push(camera.ok_or_else(bad)?);
    }
    Ok(list)
}

/// A reader that checks the length before each read, so that a hostile count allocates nothing.
struct Bytes<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl Bytes<'_> {
    fn end(&self, expected: &str) -> ExportError {
        ExportError::BadBytes { offset: self.offset, found: "the end of the file".into(), expected: expected.into() }
    }

    fn take<const N: usize>(&mut self, expected: &str) -> Result<[u8; N], ExportError> {
        let chunk = self.bytes.get(self.offset..).and_then(|rest| rest.first_chunk::<N>());
        let chunk = *chunk.ok_or_else(|| self.end(expected))?;
        self.offset += N;
        Ok(chunk)
    }

    fn u64(&mut self, expected: &str) -> Result<u64, ExportError> {
        self.take(expected).map(u64::from_le_bytes)
    }

    fn f64(&mut self, expected: &str) -> Result<f64, ExportError> {
        self.take(expected).map(f64::from_le_bytes)
    }

    fn text(&mut self) -> Result<String, ExportError> {
        let rest = self.bytes.get(self.offset..).unwrap_or_default();
        let len = rest.iter().position(|byte| *byte == 0).ok_or_else(|| self.end("a name"))?;
        self.offset += len + 1;
        Ok(String::from_utf8_lossy(&rest[..len]).into_owned())
    }

    fn skip(&mut self, count: u64, size: u64) -> Result<(), ExportError> {
        let end = count
            .checked_mul(size)
            .and_then(|len| usize::try_from(len).ok())
            .and_then(|len| self.offset.checked_add(len));
        self.offset = end.filter(|end| *end <= self.bytes.len()).ok_or_else(|| self.end("an image's points"))?;
        Ok(())
    }
}
