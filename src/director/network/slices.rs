//! Tensors as slices, for hand-written operations.

use candle_core::{CpuStorage, Layout, Result, Storage, Tensor};

/// The values of a contiguous `f32` tensor.
pub(super) fn contiguous<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let Some((start, end)) = layout.contiguous_offsets() else {
        candle_core::bail!("expected contiguous numbers, found {layout:?}");
    };
    Ok(&storage.as_slice::<f32>()?[start..end])
}

/// Calls `with` with the values of a CPU tensor, copied if they are not contiguous.
pub(super) fn read<T>(tensor: &Tensor, with: impl FnOnce(&[f32]) -> Result<T>) -> Result<T> {
    let tensor = tensor.contiguous()?;
    let (storage, layout) = tensor.storage_and_layout();
    match &*storage {
        Storage::Cpu(storage) => with(contiguous(storage, layout)?),
        _ => candle_core::bail!("expected a tensor on the CPU"),
    }
}
