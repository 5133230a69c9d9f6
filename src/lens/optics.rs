//! One frame through a lens, while the shutter is open.
//!
//! Enters: the cameras over the exposure, the lens and the samples. Leaves: the sub-frames to average. Each sub-frame
//! takes one moment and one point of the aperture. Where these are few, its splats are blurred by what lies between it and
//! its neighbors.

use super::samples::{Between, lens_points, moments};
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{SplatBlur, SubFrame, ThinLens};

/// The longer side of the sensor that f-stops refer to, meters: full frame, 36 mm x 24 mm.
pub const SENSOR_M: f64 = 0.036;

/// Focal length of the lens that gives this field of view on the sensor, meters.
pub fn focal_length_m(intrinsics: &Intrinsics) -> f64 {
    SENSOR_M * intrinsics.fx_px / f64::from(intrinsics.width.max(intrinsics.height))
}

/// The aperture of a lens, on a sensor of [`SENSOR_M`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aperture {
    /// Focal length over the diameter of the aperture; infinite = a pinhole.
    pub f_stop: f64,
    /// Meters per scene unit.
    pub meters_per_unit: f64,
}

impl Aperture {
    /// The lens with this aperture and field of view that is focused at a distance along the view axis, scene units.
    pub fn lens(&self, intrinsics: &Intrinsics, focus_distance: f64) -> ThinLens {
        let aperture_diameter = focal_length_m(intrinsics) / self.f_stop / self.meters_per_unit;
        ThinLens { aperture_diameter, focus_distance, squeeze: 1.0 }
    }
}

/// The shutter and the lens of one frame.
#[derive(Clone, Copy)]
pub struct LensAndShutter<'a> {
    /// The camera at a fraction 0..=1 of the time that the shutter is open.
    pub camera_at: &'a dyn Fn(f64) -> Camera,
    /// The lens; `None` = a pinhole.
    pub lens: Option<ThinLens>,
}

impl LensAndShutter<'_> {
    /// The sharp camera of the frame: in the middle of the exposure, at the center of the lens.
    pub fn camera(&self) -> Camera {
        (self.camera_at)(0.5)
    }

    /// All blur of the frame, as blur of splats.
    pub fn blur(&self) -> SplatBlur {
        SplatBlur { lens: self.lens, motion: Some([(self.camera_at)(0.0), (self.camera_at)(1.0)]) }
    }

    /// The sub-frames of `num_samples` samples, at least one.
    ///
    /// Moments are the midpoints of equal parts of the exposure: samples at its ends would blur more than it does.
    /// Neighboring moments see far points of the aperture.
    pub fn subframes(&self, num_samples: usize, between: Between) -> Vec<SubFrame> {
        let num_samples = num_samples.max(1);
        let points = lens_points(num_samples, between);
        let stride = coprime_stride(num_samples);
        let frame = |(idx, [start, middle, end]): (usize, [f64; 3])| {
            let pinhole = |moment: f64| {
                let camera = (self.camera_at)(moment);
                self.lens.map_or(camera, |lens| lens.pinhole(&camera, points[idx * stride % num_samples]))
            };
            let camera = pinhole(middle);
            if between == Between::Sharp {
                return SubFrame::from(camera);
            }
            // A part of the aperture with its share of the area.
            let aperture = |lens: ThinLens| lens.aperture_diameter / (num_samples as f64).sqrt();
            let lens = self.lens.map(|lens| ThinLens { aperture_diameter: aperture(lens), ..lens });
            SubFrame { camera, blur: SplatBlur { lens, motion: Some([pinhole(start), pinhole(end)]) } }
        };
        moments(num_samples).enumerate().map(frame).collect()
    }
}

/// A step near the golden section of `num` that visits all of `0..num`.
fn coprime_stride(num: usize) -> usize {
    let divisor = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let first = ((num as f64 * 0.618) as usize).max(1);
    (first..=num.max(2)).find(|&stride| divisor(stride, num) == 1).unwrap_or(1)
}
