//! Memory accounting: every allocation of a picture is checked against the limits before it is made.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{Limits, RenderError, View};

/// Target of memory beyond the loaded scene, in bytes.
const BYTES_PER_GAUSSIAN: u64 = 100;
const BYTES_PER_PIXEL: u64 = 64;

/// Bytes that the renderer aims to hold at most beyond the loaded scene: 100 per Gaussian and 64 per pixel. It renders
/// a picture that would take more in bands.
pub fn memory_target_bytes(num_gaussians: u64, num_pixels: u64) -> u64 {
    BYTES_PER_GAUSSIAN * num_gaussians + BYTES_PER_PIXEL * num_pixels
}

/// Memory and work that one picture has used, and its limits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget {
    limits: Limits,
    taken_bytes: u64,
    num_pairs: u64,
}

impl Budget {
    /// The budget of a picture, less the picture itself: color and transmittance of every pixel.
    ///
    /// # Errors
    /// [`RenderError::Memory`].
    pub(super) fn of_picture(view: &View, limits: &Limits) -> Result<Self, RenderError> {
        let mut budget = Self { limits: *limits, taken_bytes: 0, num_pairs: 0 };
        budget.take("the picture", u64::from(view.width) * u64::from(view.height) * 4 * size_of::<f32>() as u64)?;
        Ok(budget)
    }

    /// Reserves memory for `what`.
    ///
    /// # Errors
    /// [`RenderError::Memory`] if the sum would exceed the limit.
    pub(super) fn take(&mut self, what: &'static str, bytes: u64) -> Result<(), RenderError> {
        let (found_bytes, limit_bytes) = (self.taken_bytes.saturating_add(bytes), self.limits.max_memory_bytes);
        if found_bytes > limit_bytes {
            return Err(RenderError::Memory { what, found_bytes, limit_bytes });
        }
        self.taken_bytes = found_bytes;
        Ok(())
    }

    /// Reserves memory for the list of splat-tile pairs.
    ///
    /// # Errors
    /// [`RenderError::Cost`] if there are too many pairs, [`RenderError::Memory`] if the list would exceed the limit.
    pub(super) fn take_pairs(&mut self, num_pairs: u64) -> Result<(), RenderError> {
        let (found, limit) = (self.num_pairs.saturating_add(num_pairs), self.limits.max_pairs);
        if found > limit {
            return Err(RenderError::Cost { found, limit });
        }
        self.take("the list of splat-tile pairs", num_pairs.saturating_mul(size_of::<u32>() as u64))
    }

    /// Counts the pairs of a finished band, whose list is free again.
    pub(super) fn count_pairs(&mut self, num_pairs: u64) {
        self.num_pairs += num_pairs;
    }

    /// Bytes that may still be reserved before the picture is rendered in bands.
    pub(super) fn bytes_before_bands(&self, num_gaussians: usize, num_pixels: u64) -> u64 {
        let target = memory_target_bytes(num_gaussians as u64, num_pixels).min(self.limits.max_memory_bytes);
        // One fiftieth is left for small lists that are not counted.
        (target - target / 50).saturating_sub(self.taken_bytes)
    }

    /// Bytes that may still be reserved.
    pub(super) fn left_bytes(&self) -> u64 {
        self.limits.max_memory_bytes - self.taken_bytes
    }
}

/// A memory budget that the sinks of a payload share while they grow on several threads. A request that exceeds the
/// limit is counted, too, so that the outcome does not depend on the number of threads.
#[derive(Debug, Default)]
pub(super) struct SharedBudget {
    limit_bytes: AtomicU64,
    requested_bytes: AtomicU64,
}

impl SharedBudget {
    /// Sets the limit.
    pub(super) fn set_limit(&self, limit_bytes: u64) {
        self.limit_bytes.store(limit_bytes, Ordering::Relaxed);
    }

    /// Requests memory; false if the limit is exceeded.
    pub(super) fn take(&self, bytes: u64) -> bool {
        let before = self.requested_bytes.fetch_add(bytes, Ordering::Relaxed);
        before.saturating_add(bytes) <= self.limit_bytes.load(Ordering::Relaxed)
    }

    /// Checks that all requests together are within the limit.
    ///
    /// # Errors
    /// [`RenderError::Memory`].
    pub(super) fn check(&self, what: &'static str) -> Result<(), RenderError> {
        let found_bytes = self.requested_bytes.load(Ordering::Relaxed);
        let limit_bytes = self.limit_bytes.load(Ordering::Relaxed);
        if found_bytes > limit_bytes { Err(RenderError::Memory { what, found_bytes, limit_bytes }) } else { Ok(()) }
    }
}

/// Bytes that a vector has allocated.
pub(super) fn bytes_of<T>(list: &Vec<T>) -> u64 {
    (list.capacity() * size_of::<T>()) as u64
}
