//! The binary form, little-endian: counts as u64, then records; names end with a zero byte.

use glam::{DQuat, DVec3};

use super::super::ExportError;
use super::super::track::PoseTrack;
use super::{Image, Lens, MODELS, ModelFiles, PINHOLE, model, non_empty, track};

pub(crate) fn write(track: &PoseTrack) -> ModelFiles {
    let (lenses, images) = model(track);
    let mut cameras = (lenses.len() as u64).to_le_bytes().to_vec();
    for lens in &lenses {
        cameras.extend(lens.id.to_le_bytes());
        cameras.extend((PINHOLE as i32).to_le_bytes());
        cameras.extend(u64::from(lens.width).to_le_bytes());
        cameras.extend(u64::from(lens.height).to_le_bytes());
        cameras.extend(lens.params().into_iter().flat_map(f64::to_le_bytes));
    }
    let mut list = (images.len() as u64).to_le_bytes().to_vec();
    for (idx, image) in images.iter().enumerate() {
        let [x, y, z, w] = image.rotation.to_array();
        list.extend((idx as u32 + 1).to_le_bytes());
        list.extend([w, x, y, z].into_iter().chain(image.translation.to_array()).flat_map(f64::to_le_bytes));
        list.extend(image.lens_id.to_le_bytes());
        list.extend(image.name.as_bytes());
        list.push(0);
        list.extend(0_u64.to_le_bytes());
    }
    vec![("cameras.bin", cameras), ("images.bin", list), ("points3D.bin", 0_u64.to_le_bytes().to_vec())]
}

/// The track of `images.bin` and `cameras.bin`; without the latter, fields of view stay unknown.
pub(crate) fn read(images: &[u8], cameras: Option<&[u8]>) -> Result<PoseTrack, ExportError> {
    let lenses = cameras.map(read_lenses).transpose()?.unwrap_or_default();
    let mut bytes = Bytes { bytes: images, offset: 0 };
    let num_images = bytes.u64("a number of images")?;
    let mut list = Vec::new();
    for _ in 0..num_images {
        list.push(read_image(&mut bytes)?);
    }
    Ok(track(non_empty(list)?, &lenses))
}

fn read_image(bytes: &mut Bytes) -> Result<Image, ExportError> {
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
    let lens_id = u32::from_le_bytes(bytes.take("a camera id")?);
    let name = bytes.text()?;
    let points = bytes.u64("a number of points")?;
    bytes.skip(points, 24)?;
    Ok(Image { name, lens_id, rotation: rotation.normalize(), translation })
}

fn read_lenses(cameras: &[u8]) -> Result<Vec<Lens>, ExportError> {
    let mut bytes = Bytes { bytes: cameras, offset: 0 };
    let num_lenses = bytes.u64("a number of cameras")?;
    let mut lenses = Vec::new();
    for _ in 0..num_lenses {
        let start = bytes.offset;
        let id = u32::from_le_bytes(bytes.take("a camera id")?);
        let model = u32::from_le_bytes(bytes.take("a camera model")?) as usize;
        let (width, height) = (bytes.u64("a width")? as u32, bytes.u64("a height")? as u32);
        let num_params = MODELS.get(model).map_or(0, |(_, num_params, _)| *num_params);
        let params = (0..num_params).map(|_| bytes.f64("a camera parameter")).collect::<Result<Vec<_>, _>>()?;
        let bad = || ExportError::BadBytes {
            offset: start,
            found: format!("model {model}, {width} x {height}"),
            expected: "a camera of a known model".into(),
        };
        lenses.push(Lens::new(id, model, (width, height), &params).ok_or_else(bad)?);
    }
    Ok(lenses)
}

/// A reader that checks before it takes, so that a count in a hostile file allocates nothing.
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
