//! What a picture takes in memory, held against the cap before it is allocated.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{Limits, RenderError, View};

/// What a picture is to take at most beyond the loaded scene, in bytes, where bands can help.
const BYTES_PER_GAUSSIAN: u64 = 100;
const BYTES_PER_PIXEL: u64 = 64;

/// What is left of the caps of one picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Budget {
    limits: Limits,
    taken_bytes: u64,
    num_pairs: u64,
}

impl Budget {
    /// The caps less the picture itself: color and transmittance of every pixel.
    ///
    /// # Errors
    /// [`RenderError::Memory`].
    pub(super) fn of_picture(view: &View, limits: &Limits) -> Result<Self, RenderError> {
        let mut budget = Self { limits: *limits, taken_bytes: 0, num_pairs: 0 };
        budget.take("the picture", u64::from(view.width) * u64::from(view.height) * 4 * size_of::<f32>() as u64)?;
        Ok(budget)
    }

    /// Takes memory for something.
    ///
    /// # Errors
    /// [`RenderError::Memory`] where that would be more than the cap.
    pub(super) fn take(&mut self, what: &'static str, bytes: u64) -> Result<(), RenderError> {
        let (found_bytes, limit_bytes) = (self.taken_bytes.saturating_add(bytes), self.limits.max_memory_bytes);
        if found_bytes > limit_bytes {
            return Err(RenderError::Memory { what, found_bytes, limit_bytes });
        }
        self.taken_bytes = found_bytes;
        Ok(())
    }

    /// Takes the list of splat-tile pairs.
    ///
    /// # Errors
    /// [`RenderError::Cost`] or [`RenderError::Memory`].
    pub(super) fn take_pairs(&mut self, num_pairs: u64) -> Result<(), RenderError> {
        let (found, limit) = (self.num_pairs.saturating_add(num_pairs), self.limits.max_pairs);
        if found > limit {
            return Err(RenderError::Cost { found, limit });
        }
        self.take("the list of splat-tile pairs", num_pairs.saturating_mul(size_of::<u32>() as u64))
    }

    /// Counts pairs whose list has been given back.
    pub(super) fn count_pairs(&mut self, num_pairs: u64) {
        self.num_pairs += num_pairs;
    }

    /// Bytes that may be taken before the picture is better rendered in bands.
    pub(super) fn bytes_before_bands(&self, num_gaussians: usize, num_pixels: u64) -> u64 {
        let wanted = BYTES_PER_GAUSSIAN * num_gaussians as u64 + BYTES_PER_PIXEL * num_pixels;
        let wanted = wanted.min(self.limits.max_memory_bytes);
        // A fiftieth for small lists that nobody counts.
        (wanted - wanted / 50).saturating_sub(self.taken_bytes)
    }

    /// Bytes that may still be taken.
    pub(super) fn left_bytes(&self) -> u64 {
        self.limits.max_memory_bytes - self.taken_bytes
    }
}

/// Memory that the sinks of a payload share while they grow on several threads. Whether it suffices does not depend on
/// the threads: what would go beyond it is counted as well, and never allocated.
#[derive(Debug, Default)]
pub(super) struct SharedBudget {
    limit_bytes: AtomicU64,
    wanted_bytes: AtomicU64,
}

impl SharedBudget {
    /// Sets what is allowed.
    pub(super) fn set_limit(&self, limit_bytes: u64) {
        self.limit_bytes.store(limit_bytes, Ordering::Relaxed);
    }

    /// Asks for memory; false where there is no more.
    pub(super) fn take(&self, bytes: u64) -> bool {
        let before = self.wanted_bytes.fetch_add(bytes, Ordering::Relaxed);
        before.saturating_add(bytes) <= self.limit_bytes.load(Ordering::Relaxed)
    }

    /// Whether all that was asked for was there.
    ///
    /// # Errors
    /// [`RenderError::Memory`].
    pub(super) fn check(&self, what: &'static str) -> Result<(), RenderError> {
        let found_bytes = self.wanted_bytes.load(Ordering::Relaxed);
        let limit_bytes = self.limit_bytes.load(Ordering::Relaxed);
        if found_bytes > limit_bytes { Err(RenderError::Memory { what, found_bytes, limit_bytes }) } else { Ok(()) }
    }
}

/// Bytes that a list holds on to.
pub(super) fn bytes_of<T>(list: &Vec<T>) -> u64 {
    (list.capacity() * size_of::<T>()) as u64
}
