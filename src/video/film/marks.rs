//! The marks by which players know a film of all directions, or of one view per eye.
//!
//! Enters: a finished MP4 or MOV. Leaves: the same file with Spherical Video V1 metadata in its video track
//! (<https://github.com/google/spatial-media/blob/master/docs/spherical-video-rfc.md>), or with the `st3d` box of V2
//! (`spherical-video-v2-rfc.md` beside it) in its sample description. The index of the film grows into the free space that
//! the encoder reserved behind it, so that no frame moves.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use crate::EyePacking;

/// The identifier of the metadata's box.
const UUID: [u8; 16] = [0xff, 0xcc, 0x82, 0x63, 0xf8, 0x55, 0x4a, 0x93, 0x88, 0x14, 0x58, 0x7a, 0x02, 0x52, 0x1f, 0xdd];
/// The metadata.
const XML: &str = "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
    xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\"><GSpherical:Spherical>true</GSpherical:Spherical>\
    <GSpherical:Stitched>true</GSpherical:Stitched><GSpherical:StitchingSoftware>cinesplat</GSpherical:StitchingSoftware>\
    <GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType></rdf:SphericalVideo>";
/// Bytes of a box's size and name.
const HEAD: u64 = 8;

/// Boxes from the index of a film to the description of its pictures, but for the innermost, which has the codec's name.
const TO_DESCRIPTION: [&[u8; 4]; 6] = [b"moov", b"trak", b"mdia", b"minf", b"stbl", b"stsd"];

/// Marks a film of one video track as one of all directions.
///
/// # Errors
/// Those of the file; [`io::ErrorKind::InvalidData`] for a file without an index, or without space behind it.
pub(super) fn mark_panorama(file: &File) -> io::Result<()> {
    let mut mark = ((HEAD as usize + UUID.len() + XML.len()) as u32).to_be_bytes().to_vec();
    mark.extend(b"uuid");
    mark.extend(UUID);
    mark.extend(XML.bytes());
    append(file, &TO_DESCRIPTION[..2], &mark)
}

/// Marks a film of one video track as one of a view per eye. `codec` is the name of its sample description.
///
/// # Errors
/// As [`mark_panorama`].
pub(super) fn mark_eyes(file: &File, packing: EyePacking, codec: [u8; 4]) -> io::Result<()> {
    let mode = match packing {
        EyePacking::OverUnder => 1,
        EyePacking::SideBySide => 2,
    };
    let mut mark = 13_u32.to_be_bytes().to_vec();
    mark.extend(b"st3d");
    // Version and flags, then the mode.
    mark.extend([0, 0, 0, 0, mode]);
    append(file, &[&TO_DESCRIPTION[..], &[&codec]].concat(), &mark)
}

/// Appends a box to the innermost of nested boxes, the first of which is the index.
fn append(mut file: &File, path: &[&[u8; 4]], mark: &[u8]) -> io::Result<()> {
    let bad = |what: &str| io::Error::new(io::ErrorKind::InvalidData, what.to_owned());
    let len = file.seek(SeekFrom::End(0))?;
    let mut range = 0..len;
    let mut grown = Vec::new();
    for name in path {
        let (place, size) = find(file, **name, range)?.ok_or_else(|| bad("no index, or a part of it is missing"))?;
        grown.push((place, size));
        // The list of descriptions begins with its version and its length.
        let head = if *name == b"stsd" { HEAD + 8 } else { HEAD };
        range = place + head..place + size;
    }
    let more = mark.len() as u64;
    let (Some((moov, moov_len)), Some((inner, inner_len))) = (grown.first().copied(), grown.last().copied()) else {
        return Err(bad("no index"));
    };
    let end = moov + moov_len;
    // Behind the index: free space that shrinks, or the end of the file.
    let free = if end < len {
        Some(head(file, end)?).filter(|(name, size)| name == b"free" && *size >= more + HEAD)
    } else {
        None
    };
    if end < len && free.is_none() {
        return Err(bad("no space behind the index"));
    }
    let split = inner + inner_len;
    let mut rest = vec![0; (end - split) as usize];
    file.seek(SeekFrom::Start(split))?;
    file.read_exact(&mut rest)?;
    file.seek(SeekFrom::Start(split))?;
    file.write_all(mark)?;
    file.write_all(&rest)?;
    if let Some((_, size)) = free {
        file.write_all(&((size - more) as u32).to_be_bytes())?;
        file.write_all(b"free")?;
    }
    for (place, size) in grown {
        file.seek(SeekFrom::Start(place))?;
        file.write_all(&u32::try_from(size + more).map_err(|_| bad("an index of 4 GiB"))?.to_be_bytes())?;
    }
    Ok(())
}

/// Name and size of the box at a place.
fn head(mut file: &File, place: u64) -> io::Result<([u8; 4], u64)> {
    let (mut size, mut name) = ([0; 4], [0; 4]);
    file.seek(SeekFrom::Start(place))?;
    file.read_exact(&mut size)?;
    file.read_exact(&mut name)?;
    let mut size = u64::from(u32::from_be_bytes(size));
    if size == 1 {
        let mut long = [0; 8];
        file.read_exact(&mut long)?;
        size = u64::from_be_bytes(long);
    }
    Ok((name, size))
}

/// The first box of a name in a range: its place and size.
fn find(file: &File, wanted: [u8; 4], range: std::ops::Range<u64>) -> io::Result<Option<(u64, u64)>> {
    let mut place = range.start;
    while place + HEAD <= range.end {
        let (name, size) = head(file, place)?;
        if name == wanted {
            return Ok(Some((place, size)));
        }
        // A size of 0 means up to the end, and any other below its head is damaged.
        if size < HEAD {
            break;
        }
        place += size;
    }
    Ok(None)
}
