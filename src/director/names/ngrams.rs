//! Words as sets of hashed character n-grams, so that a misspelled or unknown word still resembles others.

/// Rows of the table of n-grams.
pub(super) const NUM_BUCKETS: usize = 6144;
/// Most n-grams of a word; longer words lose their last ones.
const MAX_NGRAMS: usize = 28;
/// Lengths of the n-grams, letters with the borders of the word.
const LENGTHS: std::ops::RangeInclusive<usize> = 3..=5;

/// Rows of the table for a word: the whole word, then its n-grams.
pub(super) fn rows_of(word: &str) -> Vec<u32> {
    let letters: Vec<char> = format!("<{word}>").chars().collect();
    let mut rows = vec![bucket(word.chars())];
    for length in LENGTHS {
        rows.extend(letters.windows(length).map(|window| bucket(window.iter().copied())));
    }
    rows.truncate(MAX_NGRAMS);
    rows
}

/// FNV-1a hash of letters, as a row.
fn bucket(letters: impl Iterator<Item = char>) -> u32 {
    let hash = letters.fold(0xcbf2_9ce4_8422_2325_u64, |hash, letter| {
        (hash ^ u64::from(u32::from(letter))).wrapping_mul(0x0000_0100_0000_01b3)
    });
    ((hash ^ (hash >> 29)) % NUM_BUCKETS as u64) as u32
}
