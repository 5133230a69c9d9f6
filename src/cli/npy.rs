/// A numpy file, version 1.0, of little-endian `f32` in C order.
pub(super) fn encode_f32(shape: &[u32], values: &[f32]) -> Vec<u8> {
    let shape: Vec<String> = shape.iter().map(u32::to_string).collect();
    let mut header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", shape.join(", "));
    // Magic, version and length take 10 bytes; data begins at a multiple of 64, after a line end.
    let padding = (10 + header.len() + 1).next_multiple_of(64) - (10 + header.len() + 1);
    header.push_str(&" ".repeat(padding));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}
