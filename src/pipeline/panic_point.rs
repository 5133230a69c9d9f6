/// Panics at the place that the environment variable `CINESPLAT_PANIC_AT` names, such as `render:20`, in programs that are
/// built with the feature `panic-points`. `make faults` builds one and checks what is left. Does nothing in all others.
#[cfg_attr(feature = "panic-points", allow(clippy::panic, reason = "it is there to be survived"))]
pub(super) fn panic_point(place: &str, frame_idx: usize) {
    #[cfg(feature = "panic-points")]
    if std::env::var("CINESPLAT_PANIC_AT").is_ok_and(|wanted| wanted == format!("{place}:{frame_idx}")) {
        panic!("asked for, in {place} at frame {frame_idx}");
    }
    #[cfg(not(feature = "panic-points"))]
    let _ = (place, frame_idx);
}
