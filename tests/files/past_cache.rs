//! Files past the system's cache.

use std::fs::File;

use cinesplat::files::PastCache;

#[test]
fn files_past_the_cache_have_the_bytes_of_their_parts() {
    let folder = tempfile::tempdir().unwrap();
    let mut past_cache = PastCache::default();
    for lens in [[0, 0], [1, 0], [4096, 0], [4000, 96], [5000, 9000], [1 << 20, 77], [3, 1 << 16]] {
        let parts = lens.map(|len| (0..len).map(|i| (i % 251) as u8).collect::<Vec<u8>>());
        let path = folder.path().join("file");
        past_cache.write(&File::create(&path).unwrap(), &[&parts[0], &parts[1]]).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), parts.concat(), "{lens:?}");
    }
}
