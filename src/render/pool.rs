use std::sync::{Mutex, PoisonError};

/// A pool of reusable buffers.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<T: Default> Pool<T> {
    /// Takes a free item out of the pool, or a new one if none is free.
    pub(super) fn take(&self) -> T {
        let free = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        free.unwrap_or_default()
    }

    /// Makes an item free.
    pub(super) fn give_back(&self, item: T) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(item);
    }

    /// Calls `work` with a free item of the pool, or with a new one if none is free.
    pub(super) fn with<R>(&self, work: impl FnOnce(&mut T) -> R) -> R {
        let mut item = self.take();
        let result = work(&mut item);
        self.give_back(item);
        result
    }

    /// Sum of `size` over all free items.
    pub(super) fn sum(&self, size: impl Fn(&T) -> u64) -> u64 {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().map(size).sum()
    }
}
