//! What the lenses in a file have that a pinhole with a centered principal point has not: one lens of all images is kept
//! whole, of several that differ the losses are said.

use cinesplat_trajectory::LensModel;

/// The largest losses of the lenses of a file so far.
#[derive(Debug, Clone, Default)]
pub(super) struct LensLosses {
    /// Distance of the principal point from the image's center, px.
    off_center_px: f64,
    /// The same over the image's size.
    off_center_frac: f64,
    /// Name and value of the largest distortion coefficient.
    distortion: Option<(String, f64)>,
    /// Horizontal over vertical focal length, minus 1.
    stretch: f64,
    /// A lens model that is no pinhole, even without distortion.
    model: Option<String>,
    /// The lens of the images so far.
    lens: SoFar,
}

/// The lens of some images.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
enum SoFar {
    #[default]
    None,
    One(LensModel),
    Several,
    /// One of them cannot be shown.
    Unknown,
}

/// Offsets and ratios below this are rounding.
const ROUNDING: f64 = 1e-6;

/// Coefficients below this bend a picture by less than about half a pixel in a thousand.
const MIN_DISTORTION: f64 = 1e-3;

impl LensLosses {
    /// Notes a principal point at an offset from the image's center, px.
    pub(super) fn principal_point_px(&mut self, offset: [f64; 2]) {
        self.off_center_px = self.off_center_px.max(offset[0].hypot(offset[1]));
    }

    /// Notes a principal point at an offset from the image's center, over the image's size.
    pub(super) fn principal_point_frac(&mut self, offset: [f64; 2]) {
        self.off_center_frac = self.off_center_frac.max(offset[0].hypot(offset[1]));
    }

    /// Notes a distortion coefficient.
    pub(super) fn distortion(&mut self, name: &str, value: f64) {
        if value.abs() > self.distortion.as_ref().map_or(0.0, |(_, largest)| largest.abs()) {
            self.distortion = Some((name.to_owned(), value));
        }
    }

    /// Notes the name of a lens model.
    pub(super) fn model(&mut self, name: &str) {
        let name = name.to_ascii_uppercase();
        let is_bent =
            ["FISHEYE", "EQUIRECT", "PANORAMA", "SPHERICAL", "ORTHO", "FOV"].iter().any(|part| name.contains(part));
        self.model = self.model.take().or(is_bent.then_some(name));
    }

    /// Notes different focal lengths.
    pub(super) fn focal_px(&mut self, horizontal: f64, vertical: f64) {
        let stretch = horizontal / vertical - 1.0;
        if stretch.abs() > self.stretch.abs() {
            self.stretch = stretch;
        }
    }

    /// Notes the lens of an image; `None` for one that no [`LensModel`] shows.
    pub(super) fn lens(&mut self, lens: Option<LensModel>) {
        self.lens = match (self.lens, lens) {
            (SoFar::Unknown, _) | (_, None) => SoFar::Unknown,
            (SoFar::None, Some(lens)) => SoFar::One(lens),
            (SoFar::One(known), Some(lens)) if known == lens => self.lens,
            _ => SoFar::Several,
        };
    }

    /// The lens of all images, if it is distorted and each one has the same.
    pub(super) fn lens_model(&self) -> Option<LensModel> {
        match self.lens {
            SoFar::One(lens) if lens.is_bent() && lens.fault().is_none() => Some(lens),
            _ => None,
        }
    }

    /// Whether pixels lie elsewhere than those of a pinhole.
    pub(super) fn is_distorted(&self) -> bool {
        self.model.is_some() || self.distortion.as_ref().is_some_and(|(_, value)| value.abs() > MIN_DISTORTION)
    }

    /// One line per loss, with its amount; none where the lens is kept.
    pub(super) fn into_lines(self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.lens_model().is_some() {
            return lines;
        }
        if self.lens == SoFar::Several && self.is_distorted() {
            lines.push("the images have different lenses, and a path without cuts has one".to_owned());
        }
        if let Some(name) = self.model {
            lines.push(format!("the lens model {name:.40} is read as a pinhole of the same focal length"));
        }
        if self.off_center_px > ROUNDING {
            lines.push(format!(
                "the principal point, up to {:.2} px from the image's center, is not read",
                self.off_center_px
            ));
        }
        if self.off_center_frac > ROUNDING {
            let percent = 100.0 * self.off_center_frac;
            lines.push(format!("the principal point, up to {percent:.2} % of the image from its center, is not read"));
        }
        if let Some((name, value)) = self.distortion {
            lines.push(format!("the lens distortion is not read (largest coefficient: {name} {value:.4})"));
        }
        if self.stretch.abs() > ROUNDING {
            let percent = 100.0 * self.stretch;
            lines.push(format!("the horizontal focal length, {percent:+.3} % off the vertical one, is not read"));
        }
        lines
    }
}
