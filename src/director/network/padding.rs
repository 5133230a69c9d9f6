//! Lists filled up to one length.

/// The items, then `None` up to `length` items.
pub(super) fn padded<T>(items: &[T], length: usize) -> impl Iterator<Item = Option<&T>> {
    items.iter().map(Some).chain(std::iter::repeat(None)).take(length)
}
