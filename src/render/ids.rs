use pulp::Simd;

use super::payload::{Payload, Sink, TileArea, TileRows};
use super::pixels::{BlockValues, HALF_LEN};
use super::pool::Pool;
use super::record::{RECORDS_LEN, Record};
use super::tiles::{NUM_BLOCKS, TILE_LEN};

/// The object in each pixel.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct IdMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The label with the largest sum of weights in the pixel, the lowest one on ties; 0 = none. `[row * width +
    /// column]`.
    pub ids: Vec<u16>,
}

/// The payload of an [`IdMap`].
pub(super) struct IdPayload<'a> {
    /// One label per Gaussian.
    labels: &'a [u16],
    /// Sums of finished tiles, whose memory the next ones take.
    sums: Pool<IdSums>,
}

/// Sums of one tile: for each block, one array per label that occurs in it.
#[derive(Debug, Default)]
struct IdSums {
    /// Label of each plane; a plane is a label that occurs in the tile.
    label_from_plane: Vec<u16>,
    /// Plane of each label, counted from 1; 0 = none. Ends with the largest label that occurred in any tile.
    plane_from_label: Vec<u32>,
    /// Array of each plane in each block; 0 = none.
    arrays: Vec<[u32; NUM_BLOCKS]>,
    /// Sums of weights. Array 0 stays 0.
    weights: Vec<BlockValues>,
    /// Number of arrays in use; the next one is 0.
    num_arrays: usize,
}

/// Arrays by which the list of sums grows.
const ARRAYS_STEP: usize = 1024;

/// Running sums of one tile.
pub(super) struct IdSink<'a> {
    payload: &'a IdPayload<'a>,
    /// Plane of each record.
    plane_from_record: [u32; RECORDS_LEN],
    sums: IdSums,
    /// The label with the largest sum in each pixel.
    strongest: Vec<u16>,
}

impl<'a> IdPayload<'a> {
    /// The payload for one label per Gaussian.
    pub(super) fn new(labels: &'a [u16]) -> Self {
        Self { labels, sums: Pool::default() }
    }
}

impl<'a> Payload for &'a IdPayload<'a> {
    type Sink = IdSink<'a>;
    type TileOutput = TileRows<u16>;

    fn sink(&self, _: TileArea) -> IdSink<'a> {
        let mut sums = self.sums.take();
        sums.clear();
        IdSink { payload: self, plane_from_record: [0; RECORDS_LEN], sums, strongest: Vec::new() }
    }

    fn finish(&self, sink: IdSink<'a>, area: TileArea) -> TileRows<u16> {
        self.sums.give_back(sink.sums);
        area.in_rows(&sink.strongest, 1)
    }
}

impl IdSums {
    fn clear(&mut self) {
        for label in self.label_from_plane.drain(..) {
            self.plane_from_label[usize::from(label)] = 0;
        }
        self.arrays.clear();
        self.num_arrays = 1;
        self.weights.resize(self.weights.len().max(ARRAYS_STEP), BlockValues::ZERO);
        self.weights[1] = BlockValues::ZERO;
    }

    /// The plane of a label; adds one if there is none yet.
    #[inline(always)]
    fn plane_of(&mut self, label: u16) -> u32 {
        match self.plane_from_label.get(usize::from(label)) {
            Some(&plane) if plane > 0 => plane - 1,
            _ => self.add_plane(label),
        }
    }

    #[cold]
    fn add_plane(&mut self, label: u16) -> u32 {
        let num_labels = self.plane_from_label.len().max(usize::from(label) + 1);
        self.plane_from_label.resize(num_labels, 0);
        self.label_from_plane.push(label);
        self.arrays.push([0; NUM_BLOCKS]);
        self.plane_from_label[usize::from(label)] = self.arrays.len() as u32;
        self.arrays.len() as u32 - 1
    }

    /// The label with the largest sum in each pixel of a block, the first on ties; 0 where all are 0. `planes` are all
    /// planes with their labels, each of which is exact in `f32`.
    #[inline(always)]
    fn strongest<S: Simd>(&self, simd: S, block: usize, planes: &[(usize, f32)]) -> BlockValues {
        let mut labels = BlockValues::ZERO;
        let zero = simd.splat_f32s(0.0);
        for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
            let (mut most, mut best) = ([zero; 2], [zero; 2]);
            for &(plane, label) in planes {
                let array = self.arrays[plane][block % NUM_BLOCKS] as usize;
                let (weights, label) = (self.weights[array].load(simd, first_lane), simd.splat_f32s(label));
                for half in 0..2 {
                    let is_more = simd.greater_than_f32s(weights[half], most[half]);
                    most[half] = simd.select_f32s(is_more, weights[half], most[half]);
                    best[half] = simd.select_f32s(is_more, label, best[half]);
                }
            }
            // The sum with 0 is a value of its own: else the compiler keeps the labels in memory during the loop.
            labels.store(simd, first_lane, best.map(|label| simd.add_f32s(label, zero)));
        }
        labels
    }
}

impl Sink for IdSink<'_> {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, records: &[Record]) {
        let mut labels = [0_u16; RECORDS_LEN];
        // Read first: these loads overlap; the search for a plane would wait for each.
        for (label, record) in labels.iter_mut().zip(records) {
            *label = self.payload.labels[record.gaussian_idx as usize];
        }
        for (plane, &label) in self.plane_from_record.iter_mut().zip(&labels[..records.len().min(RECORDS_LEN)]) {
            *plane = self.sums.plane_of(label);
        }
    }

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let IdSums { arrays, weights: sums, num_arrays, .. } = &mut self.sums;
        if sums.len() <= *num_arrays + list.len() {
            sums.resize(sums.len() + ARRAYS_STEP.max(list.len()), BlockValues::ZERO);
        }
        let (arrays, sums, mut next) = (arrays.as_mut_slice(), sums.as_mut_slice(), *num_arrays);
        for (&position, weights) in list.iter().zip(weights) {
            // Without a branch, which would be unpredictable: the next array is 0, whether this splat takes it or not.
            let array = &mut arrays[self.plane_from_record[usize::from(position)] as usize][block % NUM_BLOCKS];
            let is_new = *array == 0;
            *array = if is_new { next as u32 } else { *array };
            let sum = &mut sums[*array as usize];
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                let ([a, b], [c, d]) = (sum.load(simd, first_lane), weights.load(simd, first_lane));
                sum.store(simd, first_lane, [simd.add_f32s(a, c), simd.add_f32s(b, d)]);
            }
            next += usize::from(is_new);
            sums[next] = BlockValues::ZERO;
        }
        *num_arrays = next;
    }

    #[inline(always)]
    fn end_tile<S: Simd>(&mut self, simd: S) {
        // Lowest label first: it wins on ties.
        let mut planes: Vec<(u16, usize)> = self.sums.label_from_plane.iter().copied().zip(0..).collect();
        planes.sort_unstable();
        let planes: Vec<(usize, f32)> = planes.into_iter().map(|(label, plane)| (plane, f32::from(label))).collect();
        self.strongest.reserve_exact(TILE_LEN);
        for block in 0..NUM_BLOCKS {
            let labels = self.sums.strongest(simd, block, &planes);
            self.strongest.extend(labels.0.as_flattened().iter().map(|&label| label as u16));
        }
    }
}

impl IdMap {
    /// Assembles the map from its tiles.
    pub(super) fn assemble(width: u32, height: u32, tiles: &[TileRows<u16>]) -> Self {
        let mut map = Self { width, height, ids: vec![0; width as usize * height as usize] };
        tiles.iter().for_each(|tile| tile.write(&mut map.ids, 1, 0));
        map
    }
}
