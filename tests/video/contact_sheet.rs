use cinesplat::files::Existing;
use cinesplat::video::{ContactSheet, VideoSettings};

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
fn planes_look_like_their_pixels() {
    let (width, height) = (321, 181);
    let settings = VideoSettings { width, height, ..VideoSettings::default() };
    let rgb8 = super::test_frame(width as usize, height as usize, 0);
    let folder = tempfile::tempdir().unwrap();
    let [of_pixels, of_planes] = ["a.png", "b.png"].map(|name| folder.path().join(name));
    let mut sheet = ContactSheet::new(width, height, 1);
    let mut other = sheet.clone();
    sheet.add_frame(0, &rgb8);
    sheet.write(&of_pixels, Existing::Keep).unwrap();
    other.add_planes(0, &settings.planes_of(&rgb8));
    other.write(&of_planes, Existing::Keep).unwrap();
    other.write(&of_planes, Existing::Keep).unwrap();
    let [a, b] = [of_pixels, of_planes].map(|path| image::open(path).unwrap().into_rgb8());
    assert_eq!(a.dimensions(), b.dimensions());
    let sum: f64 = a.iter().zip(b.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    assert!(sum / (a.len() as f64) < 2.0, "mean difference {}", sum / a.len() as f64);
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
