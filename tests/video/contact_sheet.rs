use cinesplat::files::Existing;
use cinesplat::video::ContactSheet;

#[test]
fn a_sheet_shows_first_and_last_frame_and_ten_between() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sheet.png");
    let mut sheet = ContactSheet::new(640, 360, 111);
    for frame_idx in 0..111 {
        sheet.add_frame(frame_idx, &vec![frame_idx as u8 * 2; 640 * 360 * 3]);
    }
    sheet.write(&path, Existing::Keep).unwrap();
    let picture = image::open(&path).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (4 * 324 + 4, 3 * 184 + 4));
    let gray = |column: u32, row: u32| picture.get_pixel(4 + column * 324 + 160, 4 + row * 184 + 90).0[0];
    let grays: Vec<u8> = (0..12).map(|cell| gray(cell % 4, cell / 4)).collect();
    assert_eq!(grays, (0..12).map(|i| i * 20).collect::<Vec<u8>>());
}

#[test]
fn small_and_short_films_have_sheets_too() {
    for (width, height, num_frames) in [(1, 1, 1), (3, 500, 2), (321, 7, 5), (5, 5, 0)] {
        let mut sheet = ContactSheet::new(width, height, num_frames);
        for frame_idx in 0..num_frames {
            sheet.add_frame(frame_idx, &vec![200; (width * height * 3) as usize]);
        }
        let folder = tempfile::tempdir().unwrap();
        sheet.write(&folder.path().join("sheet.png"), Existing::Replace).unwrap();
    }
}
