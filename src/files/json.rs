//! The size of JSON before it is parsed.
//!
//! Enters: the bytes of a text. Leaves: nothing, or the first limit that a parser of it would exceed. A byte of text may
//! become hundreds of bytes of memory (`{"":0}` is a tree with room for eleven entries), so the size of the file bounds little.

use crate::Limits;

/// Bytes of memory per value, per list and per object: those of `serde_json`, whose smallest object holds eleven entries.
const VALUE_BYTES: u64 = 32;
const LIST_BYTES: u64 = 32;
const OBJECT_BYTES: u64 = 640;
/// Bytes per key or text beyond its letters.
const TEXT_BYTES: u64 = 40;

/// What a parser of `text` would exceed, as found and expected; `None` where it stays within the limits. The text need not
/// be JSON. The letters of its texts take as much memory as in the file: they count against the limit on files of scenes.
pub fn json_excess(text: &[u8], limits: &Limits) -> Option<String> {
    let (mut depth, mut bytes, mut letters) = (0_usize, VALUE_BYTES, 0);
    let mut rest = text.iter();
    while let Some(byte) = rest.next() {
        bytes += match byte {
            b'[' => LIST_BYTES + VALUE_BYTES,
            b'{' => OBJECT_BYTES,
            b',' => VALUE_BYTES,
            b'"' => {
                letters += skip_text(&mut rest);
                TEXT_BYTES
            }
            _ => 0,
        };
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            _ => continue,
        }
        if depth > limits.json_depth {
            return Some(format!("lists nested over {0} deep, expected at most {0}", limits.json_depth));
        }
        if bytes > limits.json_bytes {
            break;
        }
    }
    if letters > limits.scene_bytes {
        return Some(format!("texts of {letters} bytes, expected at most {}", limits.scene_bytes));
    }
    let excess = || format!("values that take over {0} bytes of memory, expected at most {0}", limits.json_bytes);
    (bytes > limits.json_bytes).then(excess)
}

/// Moves behind the closing quote of a text; the number of its bytes.
fn skip_text(rest: &mut std::slice::Iter<u8>) -> u64 {
    let before = rest.len();
    while let Some(byte) = rest.next() {
        match byte {
            b'\\' => drop(rest.next()),
            b'"' => break,
            _ => {}
        }
    }
    (before - rest.len()) as u64
}
