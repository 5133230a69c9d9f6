/// A numpy file, version 1.0, of little-endian `f32` in C order.
pub(super) fn encode_f32(shape: &[u32], values: &[f32]) -> Vec<u8> {
    encode("'<f4'", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// As [`encode_f32`], of `u16`.
pub(super) fn encode_u16(shape: &[u32], values: &[u16]) -> Vec<u8> {
    encode("'<u2'", shape, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// As [`encode_f32`], of any type that numpy knows under `descr`.
pub(super) fn encode(descr: &str, shape: &[u32], data: impl Iterator<Item = u8>) -> Vec<u8> {
    let mut shape: Vec<String> = shape.iter().map(u32::to_string).collect();
    if shape.len() == 1 {
        // A tuple of one has a comma.
        shape.push(String::new());
    }
    let mut header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': ({}), }}", shape.join(", "));
    // Magic, version and length take 10 bytes; data begins at a multiple of 64, after a line end.
    let padding = (10 + header.len() + 1).next_multiple_of(64) - (10 + header.len() + 1);
    header.push_str(&" ".repeat(padding));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

/// The numbers of a numpy file of little-endian `f32` in C order with two axes, and the length of the second; or what
/// was found instead, in words.
pub(super) fn decode_rows(bytes: &[u8]) -> Result<(Vec<f32>, usize), String> {
    let rest = bytes.strip_prefix(b"\x93NUMPY").ok_or("no .npy signature")?;
    let ([major, _minor], rest) = rest.split_first_chunk::<2>().ok_or("a cut-off .npy header")?;
    let wide = if *major >= 2 { 4 } else { 2 };
    let (len, rest) = rest.split_at_checked(wide).ok_or("a cut-off .npy header")?;
    let len = len.iter().rev().fold(0_usize, |value, &byte| value << 8 | usize::from(byte));
    let (header, data) = rest.split_at_checked(len).ok_or("a cut-off .npy header")?;
    let header = String::from_utf8_lossy(header);
    if !header.contains("'<f4'") || header.contains("'fortran_order': True") {
        return Err("another type than '<f4' in C order".to_owned());
    }
    let shape = header.split_once('(').and_then(|(_, rest)| rest.split_once(')')).map_or("", |(shape, _)| shape);
    let sizes: Vec<usize> = shape.split(',').filter_map(|size| size.trim().parse().ok()).collect();
    let [num_rows, num_columns] = sizes[..] else { return Err(format!("an array of shape ({shape})")) };
    if num_rows.checked_mul(num_columns).and_then(|num| num.checked_mul(4)) != Some(data.len()) {
        return Err(format!("shape ({shape}) and {} bytes of data", data.len()));
    }
    Ok((data.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect(), num_columns))
}
