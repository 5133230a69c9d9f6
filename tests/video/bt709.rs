use cinesplat::video::planes_from_rgb8;

/// 8-bit limited-range codes (Y, Cb, Cr) of full-intensity colors, from published tables of BT.709 color bars.
const BARS: [([u8; 3], [u8; 3]); 8] = [
    ([255, 255, 255], [235, 128, 128]),
    ([255, 255, 0], [219, 16, 138]),
    ([0, 255, 255], [188, 154, 16]),
    ([0, 255, 0], [173, 42, 26]),
    ([255, 0, 255], [78, 214, 230]),
    ([255, 0, 0], [63, 102, 240]),
    ([0, 0, 255], [32, 240, 118]),
    ([0, 0, 0], [16, 128, 128]),
];

#[test]
fn color_bars_have_the_codes_of_the_standard() {
    for (rgb, ycbcr) in BARS {
        let planes = planes_from_rgb8(&rgb.repeat(16), 4, 4);
        assert_eq!(planes.y, [ycbcr[0]; 16], "{rgb:?}");
        assert_eq!((planes.cb.as_slice(), planes.cr.as_slice()), (&[ycbcr[1]; 4][..], &[ycbcr[2]; 4][..]), "{rgb:?}");
    }
}

#[test]
fn pixels_come_back_from_planes() {
    for (rgb, _) in BARS {
        let back = planes_from_rgb8(&rgb.repeat(16), 4, 4).to_rgb8();
        let farthest = back.iter().zip(rgb.repeat(16)).map(|(found, exact)| found.abs_diff(exact)).max();
        assert!(farthest <= Some(2), "{rgb:?}: {:?}", &back[..3]);
    }
}

#[test]
fn every_gray_stays_gray() {
    for gray in 0..=255_u8 {
        let planes = planes_from_rgb8(&[gray; 12], 2, 2);
        let exact = 16.0 + 219.0 * f64::from(gray) / 255.0;
        assert!((f64::from(planes.y[0]) - exact).abs() <= 0.5 + 1e-3, "{gray}");
        assert_eq!((planes.cb[0], planes.cr[0]), (128, 128), "{gray}");
    }
}

#[test]
fn every_color_is_within_half_a_code_of_the_equations() {
    for step in 0..4096_usize {
        let rgb = [(step % 16 * 17) as u8, (step / 16 % 16 * 17) as u8, (step / 256 * 17) as u8];
        let planes = planes_from_rgb8(&rgb.repeat(4), 2, 2);
        let [r, g, b] = rgb.map(|v| f64::from(v) / 255.0);
        let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let exact = [16.0 + 219.0 * luma, 128.0 + 224.0 * (b - luma) / 1.8556, 128.0 + 224.0 * (r - luma) / 1.5748];
        for (found, exact) in [planes.y[0], planes.cb[0], planes.cr[0]].into_iter().zip(exact) {
            assert!((f64::from(found) - exact).abs() < 0.51, "{rgb:?}: {found} against {exact}");
        }
    }
}

#[test]
fn chroma_sits_on_the_left_column_between_the_rows() {
    // A red column at x = 2 of a black picture gets half of the weight of the chroma sample at 2 and none of those at 0
    // and 4. A red column at x = 3 gets a quarter of the weight of the samples at 2 and 4.
    let redness = |red_column: usize| {
        let rgb8: Vec<u8> = (0..16).flat_map(|i| [if i % 8 == red_column { 255 } else { 0 }, 0, 0]).collect();
        planes_from_rgb8(&rgb8, 8, 2).cr.iter().map(|&code| f64::from(code - 128) / 112.0).collect::<Vec<_>>()
    };
    for (red_column, expected) in [(2, [0.0, 0.5, 0.0, 0.0]), (3, [0.0, 0.25, 0.25, 0.0])] {
        for (found, expected) in redness(red_column).into_iter().zip(expected) {
            assert!((found - expected).abs() < 0.01, "column {red_column}: {found} against {expected}");
        }
    }
}

#[test]
fn odd_sizes_repeat_the_last_column_and_row() {
    let rgb8: Vec<u8> = (0..15).flat_map(|i| [i * 17; 3]).collect();
    let planes = planes_from_rgb8(&rgb8, 5, 3);
    assert_eq!((planes.width, planes.height), (6, 4));
    let row = |y: usize| &planes.y[y * 6..(y + 1) * 6];
    assert_eq!(row(2), row(3));
    assert!((0..4).all(|y| row(y)[4] == row(y)[5]));
}
