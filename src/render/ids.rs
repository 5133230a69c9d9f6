use super::payload::{Payload, Sink, TileArea, TileRows};
use super::record::Record;
use super::tiles::TILE_LEN;

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
    pub(super) labels: &'a [u16],
}

/// Sums of one tile: one plane per label that occurs in it.
pub(super) struct IdSink<'a> {
    labels: &'a [u16],
    /// Plane of each record.
    plane_from_record: Vec<usize>,
    /// Label of each plane.
    label_from_plane: Vec<u16>,
    /// Sums of weights: `[plane * TILE_LEN + pixel]`.
    weights: Vec<f32>,
}

impl<'a> Payload for IdPayload<'a> {
    type Sink = IdSink<'a>;
    type TileOutput = TileRows<u16>;

    fn sink(&self, _: TileArea) -> IdSink<'a> {
        IdSink { labels: self.labels, plane_from_record: Vec::new(), label_from_plane: Vec::new(), weights: Vec::new() }
    }

    fn finish(&self, sink: IdSink<'a>, area: TileArea) -> TileRows<u16> {
        area.in_rows(&sink.strongest(), 1)
    }
}

impl IdSink<'_> {
    /// The label with the largest sum in each pixel.
    fn strongest(&self) -> Vec<u16> {
        let (mut most, mut labels) = (vec![0.0_f32; TILE_LEN], vec![0_u16; TILE_LEN]);
        for (plane, &label) in self.weights.chunks_exact(TILE_LEN).zip(&self.label_from_plane) {
            for ((most, best), &weight) in most.iter_mut().zip(&mut labels).zip(plane) {
                if weight > *most || (weight > 0.0 && weight >= *most && label < *best) {
                    (*most, *best) = (weight, label);
                }
            }
        }
        labels
    }

    /// The plane of a label; adds one if there is none yet.
    fn plane_of(&mut self, label: u16) -> usize {
        self.label_from_plane.iter().position(|&known| known == label).unwrap_or_else(|| {
            self.label_from_plane.push(label);
            self.weights.resize(self.label_from_plane.len() * TILE_LEN, 0.0);
            self.label_from_plane.len() - 1
        })
    }
}

impl Sink for IdSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin_chunk(&mut self, records: &[Record]) {
        self.plane_from_record.clear();
        for record in records {
            let plane = self.plane_of(self.labels[record.gaussian_idx as usize]);
            self.plane_from_record.push(plane);
        }
    }

    #[inline(always)]
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let start = self.plane_from_record[position] * TILE_LEN + first_pixel;
        for (sum, weight) in self.weights[start..][..weights.len()].iter_mut().zip(weights) {
            *sum += weight;
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
