//! `.ksplat` of GaussianSplats3D: sections of records, plain or in buckets. Enters: bytes. Leaves: Gaussians of degree 0 to 2.
//! Reference: mkkellogg/GaussianSplats3D, `SplatBuffer`.

use glam::{DVec3, Vec3};
use half::f16;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::gaussians::NUM_SH_REST;
use super::intake::{Intake, RawGaussian, SH_C0};
use super::source_file::SourceFile;

const HEADER: usize = 4096;
const SECTION_HEADER: usize = 1024;
/// Bytes of a bucket's center.
const CENTER: usize = 12;
/// Range of coefficients stored as bytes, in files that state none.
const DEFAULT_SH_RANGE: (f32, f32) = (-1.5, 1.5);
/// Range of quantized positions, in files that state none.
const DEFAULT_POSITION_RANGE: u32 = 32767;

/// How numbers are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    /// f32.
    Plain,
    /// Positions as u16 inside buckets, the rest f16.
    Halves,
    /// As `Halves`, with spherical harmonics as bytes.
    Bytes,
}

/// One section: where its parts start, and how its positions are stored.
struct Section {
    count: usize,
    degree: u8,
    /// Start of the lengths of partly filled buckets, of the centers, and of the records.
    starts: [usize; 3],
    record: usize,
    bucket_size: usize,
    full_buckets: usize,
    partial_buckets: usize,
    /// Scene units per step of a quantized position.
    step: f64,
    range: f64,
}

/// Gaussians of a `.ksplat`.
///
/// # Errors
/// [`SceneError::Damaged`] for counts that the file has no room for, [`SceneError::TooManyGaussians`],
/// [`SceneError::OutOfMemory`], [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let bytes = source.bytes;
    let level = match half_word(bytes, 20) {
        Some(0) => Level::Plain,
        Some(1) => Level::Halves,
        Some(2) => Level::Bytes,
        found => return Err(damaged(source, 20, format!("compression level {found:?}, expected 0, 1 or 2"))),
    };
    let sections = sections(source, level, word(bytes, 4).unwrap_or(0) as usize)?;
    let count = source.check_count(sections.iter().map(|section| section.count as u64).sum())?;
    let degree = sections.iter().map(|section| section.degree).max().unwrap_or(0);
    let sh_range = match (float(bytes, 36), float(bytes, 40)) {
        (Some(low), Some(high)) if low < high => (low, high),
        _ => DEFAULT_SH_RANGE,
    };
    let mut intake = Intake::new(source, count, degree)?;
    let mut rest = vec![Vec3::ZERO; NUM_SH_REST[usize::from(degree)]];
    for section in &sections {
        let mut buckets = Buckets::new(bytes, section);
        for idx in 0..section.count {
            let record = &bytes[section.starts[2] + idx * section.record..][..section.record];
            let center = if level == Level::Plain { DVec3::ZERO } else { buckets.center_of(idx) };
            read_rest(record, level, section.degree, sh_range, &mut rest);
            intake.push(&gaussian(record, level, section, center), &rest);
        }
    }
    Ok(DecodedScene {
        format: format!("ksplat (compression {})", level as u8),
        collected: intake.finish(source.path)?,
        filter: None,
        up: None,
        further_sha256: Vec::new(),
    })
}

fn damaged(source: &SourceFile, byte: usize, reason: String) -> SceneError {
    SceneError::Damaged { path: source.path.to_path_buf(), byte: byte as u64, reason }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|chunk| u32::from_le_bytes(*chunk))
}

fn half_word(bytes: &[u8], at: usize) -> Option<u16> {
    bytes.get(at..)?.first_chunk().map(|chunk| u16::from_le_bytes(*chunk))
}

fn float(bytes: &[u8], at: usize) -> Option<f32> {
    word(bytes, at).map(f32::from_bits)
}

/// The sections, each checked to lie inside the file.
fn sections(source: &SourceFile, level: Level, num_sections: usize) -> Result<Vec<Section>, SceneError> {
    let bytes = source.bytes;
    let mut start = SECTION_HEADER.saturating_mul(num_sections).saturating_add(HEADER);
    let mut found = Vec::new();
    for idx in 0..num_sections {
        let at = HEADER + idx * SECTION_HEADER;
        let header = bytes.get(at..at + SECTION_HEADER);
        let header = header.ok_or_else(|| damaged(source, at, "the file ends in a section's header".to_owned()))?;
        let number = |offset: usize| word(header, offset).unwrap_or(0) as usize;
        let [count, max_count, bucket_size, num_buckets] = [0, 4, 8, 12].map(number);
        let [full_buckets, partial_buckets] = [32, 36].map(number);
        let degree = half_word(header, 40).unwrap_or(0);
        if degree > 2 {
            return Err(damaged(source, at + 40, format!("spherical harmonics of degree {degree}, expected 0 to 2")));
        }
        let degree = degree as u8;
        let num_sh = 3 * NUM_SH_REST[usize::from(degree)];
        let record = match level {
            Level::Plain => 44 + 4 * num_sh,
            Level::Halves => 24 + 2 * num_sh,
            Level::Bytes => 24 + num_sh,
        };
        let range = f64::from(match word(header, 24).unwrap_or(0) {
            0 => DEFAULT_POSITION_RANGE,
            stated => stated,
        });
        let storage = usize::from(half_word(header, 20).unwrap_or(0));
        let centers = partial_buckets.checked_mul(4).and_then(|len| len.checked_add(start));
        let records = num_buckets.checked_mul(storage).and_then(|len| len.checked_add(centers?));
        let end = max_count.checked_mul(record).and_then(|len| len.checked_add(records?));
        let (Some(centers), Some(records), Some(end)) = (centers, records, end.filter(|end| *end <= bytes.len()))
        else {
            let reason = format!("section {idx} holds {max_count} records, expected as many as the file has room for");
            return Err(damaged(source, at, reason));
        };
        let has_buckets = level == Level::Plain || (storage >= CENTER && bucket_size > 0);
        let filled = full_buckets.checked_add(partial_buckets).is_some_and(|filled| filled <= num_buckets);
        // Writers reserve sections that they leave empty.
        let count = if max_count == 0 { 0 } else { count };
        if count > max_count || !(has_buckets || count == 0) || !(filled || level == Level::Plain) {
            return Err(damaged(source, at, format!("section {idx}: {count} records in {num_buckets} buckets")));
        }
        let step = f64::from(float(header, 16).unwrap_or(0.0)) / 2.0 / range;
        let starts = [start, centers, records];
        found.push(Section { count, degree, starts, record, bucket_size, full_buckets, partial_buckets, step, range });
        start = end;
    }
    Ok(found)
}

/// The bucket of each record, in order.
struct Buckets<'a> {
    bytes: &'a [u8],
    section: &'a Section,
    bucket: usize,
    /// Index after the last record of the bucket.
    end: usize,
}

impl<'a> Buckets<'a> {
    fn new(bytes: &'a [u8], section: &'a Section) -> Self {
        Self { bytes, section, bucket: 0, end: 0 }
    }

    /// The center of the bucket of record `idx`, which is asked for in order.
    fn center_of(&mut self, idx: usize) -> DVec3 {
        let Section { bucket_size, full_buckets, partial_buckets, starts, .. } = *self.section;
        while idx >= self.end && self.bucket < full_buckets + partial_buckets {
            let len = if self.bucket < full_buckets {
                bucket_size
            } else {
                word(self.bytes, starts[0] + 4 * (self.bucket - full_buckets)).unwrap_or(0) as usize
            };
            self.end = self.end.saturating_add(len);
            self.bucket += 1;
        }
        let at = starts[1] + self.bucket.saturating_sub(1) * CENTER;
        let axis = |axis: usize| f64::from(float(self.bytes, at + 4 * axis).unwrap_or(0.0));
        DVec3::new(axis(0), axis(1), axis(2))
    }
}

fn gaussian(record: &[u8], level: Level, section: &Section, center: DVec3) -> RawGaussian {
    let real = |at: usize| f64::from(float(record, at).unwrap_or(f32::NAN));
    let half = |at: usize| half_word(record, at).map_or(f64::NAN, |bits| f16::from_bits(bits).to_f64());
    let whole = |at: usize| f64::from(half_word(record, at).unwrap_or(0));
    let (mean, scale, rotation_wxyz, color) = if level == Level::Plain {
        let vector = |at: usize| DVec3::new(real(at), real(at + 4), real(at + 8));
        (vector(0), vector(12), [24, 28, 32, 36].map(real), 40)
    } else {
        let offset = DVec3::new(whole(0), whole(2), whole(4)) - section.range;
        (center + offset * section.step, DVec3::new(half(6), half(8), half(10)), [12, 14, 16, 18].map(half), 20)
    };
    let byte = |idx: usize| f64::from(record[color + idx]);
    RawGaussian {
        mean,
        scale,
        rotation_wxyz,
        opacity: byte(3) / 255.0,
        sh_dc: (DVec3::new(byte(0), byte(1), byte(2)) / 255.0 - 0.5) / SH_C0,
    }
}

/// The coefficients above degree 0: band by band, in each band all of red, then green, then blue.
fn read_rest(record: &[u8], level: Level, degree: u8, (low, high): (f32, f32), rest: &mut [Vec3]) {
    rest.fill(Vec3::ZERO);
    let value = |idx: usize| match level {
        Level::Plain => float(record, 44 + 4 * idx).unwrap_or(f32::NAN),
        Level::Halves => half_word(record, 24 + 2 * idx).map_or(f32::NAN, |bits| f16::from_bits(bits).to_f32()),
        Level::Bytes => low + (high - low) * f32::from(record[24 + idx]) / 255.0,
    };
    let (mut coefficient, mut stored) = (0, 0);
    for band in 1..=usize::from(degree) {
        let len = 2 * band + 1;
        for idx in 0..len {
            let rgb = [0, 1, 2].map(|channel| value(stored + channel * len + idx));
            rest[coefficient + idx] = Vec3::from_array(rgb);
        }
        coefficient += len;
        stored += 3 * len;
    }
}
