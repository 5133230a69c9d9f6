use cinesplat::files::Existing;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cinesplat::video::{AlphaPlanes, EyePacking, Planes420, VideoError, VideoSettings, VideoWriter};
use ffmpeg_next::{codec, color, format, frame, media};

use super::test_frame;
use crate::support::report_skip;

const SIZE: (usize, usize) = (320, 180);

fn settings(num_frames: usize) -> VideoSettings {
    VideoSettings { width: SIZE.0 as u32, height: SIZE.1 as u32, num_frames, ..Default::default() }
}

fn write_film(path: &Path, settings: &VideoSettings, num_frames: usize) -> Result<PathBuf, VideoError> {
    let mut writer = VideoWriter::create(path, settings)?;
    for frame_idx in 0..num_frames {
        writer.write_frame(&test_frame(settings.width as usize, settings.height as usize, frame_idx))?;
    }
    writer.finish()
}

/// A decoded film: pictures as luma and chroma planes, times in seconds, color tags.
struct Decoded {
    pictures: Vec<[Vec<u8>; 3]>,
    times_secs: Vec<f64>,
    duration_secs: f64,
    size: (u32, u32),
    tags: (color::Space, color::Range, color::Primaries, color::TransferCharacteristic),
}

fn decode(path: &Path) -> Decoded {
    let mut input = format::input(path).unwrap();
    let stream = input.streams().best(media::Type::Video).unwrap();
    let tick_secs = f64::from(stream.time_base());
    let duration_secs = input.duration() as f64 / 1e6;
    let mut decoder = codec::Context::from_parameters(stream.parameters()).unwrap().decoder().video().unwrap();
    let (mut pictures, mut times_secs) = (Vec::new(), Vec::new());
    let mut packets: Vec<_> = input.packets().map(|(_, packet)| Some(packet)).collect();
    packets.push(None);
    for packet in packets {
        match packet {
            Some(packet) => decoder.send_packet(&packet).unwrap(),
            None => decoder.send_eof().unwrap(),
        }
        let mut picture = frame::Video::empty();
        while decoder.receive_frame(&mut picture).is_ok() {
            times_secs.push(picture.pts().unwrap() as f64 * tick_secs);
            pictures.push([0, 1, 2].map(|plane| packed(&picture, plane)));
        }
    }
    let tags = (
        decoder.color_space(),
        decoder.color_range(),
        decoder.color_primaries(),
        decoder.color_transfer_characteristic(),
    );
    Decoded { pictures, times_secs, duration_secs, size: (decoder.width(), decoder.height()), tags }
}

fn packed(picture: &frame::Video, plane: usize) -> Vec<u8> {
    let (width, height) = (picture.plane_width(plane) as usize, picture.plane_height(plane) as usize);
    let rows = picture.data(plane).chunks(picture.stride(plane)).take(height);
    rows.flat_map(|row| &row[..width]).copied().collect()
}

/// PSNR in dB over r, g, b of a decoded picture against the frame that was written, by the equations of BT.709.
fn psnr_db(planes: &[Vec<u8>; 3], rgb8: &[u8], (width, height): (usize, usize)) -> f64 {
    let mut squares = 0.0;
    let stride = width.next_multiple_of(2);
    for y in 0..height {
        for x in 0..width {
            let chroma = |plane: usize| {
                // Chroma samples lie on even columns: odd columns take the mean of both neighbors.
                let row = &planes[plane][y / 2 * (stride / 2)..][..stride / 2];
                let (left, right) = (row[x / 2], row[(x.div_ceil(2)).min(stride / 2 - 1)]);
                (f64::midpoint(left.into(), right.into()) - 128.0) / 224.0
            };
            let luma = (f64::from(planes[0][y * stride + x]) - 16.0) / 219.0;
            let (blue, red) = (luma + 1.8556 * chroma(1), luma + 1.5748 * chroma(2));
            let green = (luma - 0.2126 * red - 0.0722 * blue) / 0.7152;
            for (found, &wanted) in [red, green, blue].into_iter().zip(&rgb8[(y * width + x) * 3..]) {
                squares += (found.clamp(0.0, 1.0) - f64::from(wanted) / 255.0).powi(2);
            }
        }
    }
    -10.0 * (squares / (width * height * 3) as f64).log10()
}

#[test]
fn every_container_holds_all_frames_at_their_times_with_their_colors() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["film.mp4", "film.mkv", "film.mov", "film.webm", "FILM.MP4"] {
        let path = folder.path().join(name).with_file_name(format!("{name}.{name}"));
        assert_eq!(write_film(&path, &settings(24), 24).unwrap(), path);
        let film = decode(&path);
        assert_eq!((film.pictures.len(), film.size), (24, (320, 180)), "{name}");
        assert!((film.duration_secs - 0.8).abs() < 2e-3, "{name}: {} s", film.duration_secs);
        for (frame_idx, time_secs) in film.times_secs.iter().enumerate() {
            assert!((time_secs - frame_idx as f64 / 30.0).abs() < 1e-3, "{name}: frame {frame_idx} at {time_secs} s");
        }
        let bt709 =
            (color::Space::BT709, color::Range::MPEG, color::Primaries::BT709, color::TransferCharacteristic::BT709);
        assert_eq!(film.tags, bt709, "{name}");
        for frame_idx in [0, 11, 23] {
            let db = psnr_db(&film.pictures[frame_idx], &test_frame(SIZE.0, SIZE.1, frame_idx), SIZE);
            assert!(db > 28.0, "{name}: frame {frame_idx} is {db:.1} dB from the frame that was written");
        }
    }
}

#[test]
fn a_film_is_read_back_as_another_decoder_reads_it() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["film.mp4", "film.webm"] {
        let path = folder.path().join(name);
        write_film(&path, &settings(24), 24).unwrap();
        let mut pictures = Vec::new();
        cinesplat::video::read_film(&path, &mut |planes| pictures.push([planes.y, planes.cb, planes.cr])).unwrap();
        assert!(pictures == decode(&path).pictures, "{name}");
    }
    let missing = cinesplat::video::read_film(&folder.path().join("none.mp4"), &mut |_| ());
    assert_eq!(missing.unwrap_err().code(), "FILE-READ");
}

#[test]
fn a_smooth_picture_is_decoded_closely() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("smooth.mp4");
    let (width, height) = SIZE;
    let smooth: Vec<u8> = (0..width * height)
        .flat_map(|i| [(200 * (i % width) / width) as u8 + 20, (200 * (i / width) / height) as u8 + 20, 128])
        .collect();
    let mut writer = VideoWriter::create(&path, &settings(3)).unwrap();
    (0..3).for_each(|_| writer.write_frame(&smooth).unwrap());
    writer.finish().unwrap();
    let db = psnr_db(&decode(&path).pictures[2], &smooth, SIZE);
    assert!(db > 42.0, "{db:.1} dB");
}

#[test]
fn the_same_frames_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.mp4", "a.mkv", "a.mov", "a.webm"] {
        let bytes = |run: &str| {
            let path = folder.path().join(format!("{run}{name}"));
            write_film(&path, &settings(8), 8).unwrap();
            fs::read(path).unwrap()
        };
        let first = bytes("0");
        for run in ["1", "2", "3"] {
            assert!(first == bytes(run), "{name}, run {run}");
        }
    }
}

#[test]
fn an_mp4_of_known_length_has_its_index_in_front() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    write_film(&path, &settings(300), 300).unwrap();
    let bytes = fs::read(&path).unwrap();
    let at = |name: &[u8; 4]| bytes.windows(4).position(|window| window == name).unwrap();
    assert!(at(b"moov") < at(b"mdat"));
}

#[test]
fn odd_sizes_are_padded_to_even() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["odd.mp4", "odd.webm"] {
        let path = folder.path().join(name);
        let odd = VideoSettings { width: 101, height: 57, ..settings(4) };
        write_film(&path, &odd, 4).unwrap();
        let film = decode(&path);
        assert_eq!(film.size, (102, 58), "{name}");
        let db = psnr_db(&film.pictures[3], &test_frame(101, 57, 3), (101, 57));
        assert!(db > 24.0, "{name}: {db:.1} dB");
    }
}

#[test]
fn films_at_fractional_rates_have_their_duration() {
    let folder = tempfile::tempdir().unwrap();
    for (rate_fps, seconds) in [(29.97, 30.0 * 1001.0 / 30000.0), (12.5, 2.4), (1000.0, 0.03), (0.5, 60.0)] {
        let path = folder.path().join(format!("{rate_fps}.mp4"));
        write_film(&path, &VideoSettings { rate_fps, ..settings(30) }, 30).unwrap();
        let film = decode(&path);
        assert_eq!(film.pictures.len(), 30);
        assert!((film.duration_secs - seconds).abs() < 2e-3, "{rate_fps} fps: {} s", film.duration_secs);
    }
}

#[test]
fn a_file_states_its_frame_rate_as_the_expected_fraction() {
    let folder = tempfile::tempdir().unwrap();
    let known = [
        (30.0, (30, 1)),
        (23.976, (24000, 1001)),
        (29.97, (30000, 1001)),
        (59.94, (60000, 1001)),
        (12.5, (25, 2)),
        (0.5, (1, 2)),
        (1000.0, (1000, 1)),
    ];
    for (rate_fps, (numerator, denominator)) in known {
        let path = folder.path().join(format!("{rate_fps}.mp4"));
        write_film(&path, &VideoSettings { rate_fps, ..settings(3) }, 3).unwrap();
        let input = format::input(&path).unwrap();
        let rate = input.streams().best(media::Type::Video).unwrap().avg_frame_rate().reduce();
        assert_eq!((rate.numerator(), rate.denominator()), (numerator, denominator), "{rate_fps} fps");
    }
}

#[test]
fn names_that_look_like_protocols_or_options_are_file_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut names: Vec<std::ffi::OsString> =
        ["concat:a|b.mp4", "-x.mp4", "pipe:1.mp4", "%d.mp4", "a b\n.mkv"].map(Into::into).to_vec();
    #[cfg(unix)]
    names.push(std::os::unix::ffi::OsStringExt::from_vec(b"not\xffutf8.mp4".to_vec()));
    for name in names {
        let path = folder.path().join(&name);
        assert_eq!(write_film(&path, &settings(2), 2).unwrap(), path);
        assert!(fs::metadata(&path).unwrap().len() > 1000, "{}", path.display());
    }
}

#[test]
fn a_dropped_writer_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let mut writer = VideoWriter::create(&path, &settings(9)).unwrap();
    writer.write_frame(&test_frame(SIZE.0, SIZE.1, 0)).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "one file under a temporary name");
    drop(writer);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn planes_and_pixels_give_the_same_film() {
    let folder = tempfile::tempdir().unwrap();
    // An odd size: the planes are one column wider.
    let settings = VideoSettings { width: 65, height: 35, num_frames: 4, ..VideoSettings::default() };
    let path = folder.path().join("planes.mp4");
    let mut writer = VideoWriter::create(&path, &settings).unwrap();
    for frame_idx in 0..4 {
        let planes = settings.planes_of(&test_frame(65, 35, frame_idx));
        let bytes = planes.parts().concat();
        assert_eq!(bytes.len(), settings.planes_bytes());
        assert_eq!(Planes420::from_bytes(&bytes, 66, 36), Some(planes.clone()));
        writer.write_planes(&planes).unwrap();
    }
    let small = VideoSettings { width: 64, ..settings.clone() }.planes_of(&test_frame(64, 35, 0));
    assert!(matches!(writer.write_planes(&small), Err(VideoError::FrameSize { .. })));
    writer.finish().unwrap();
    let pixels = folder.path().join("pixels.mp4");
    write_film(&pixels, &settings, 4).unwrap();
    assert!(fs::read(path).unwrap() == fs::read(pixels).unwrap());
}

#[test]
fn impossible_outputs_are_rejected_before_any_frame() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("there.mp4"), b"mine").unwrap();
    fs::create_dir(folder.path().join("dir.mp4")).unwrap();
    let rejected = |name: &str, settings: VideoSettings| {
        let error = VideoWriter::create(&folder.path().join(name), &settings).err().unwrap();
        error.code()
    };
    assert_eq!(rejected("there.mp4", settings(1)), "OUTPUT-EXISTS");
    assert_eq!(rejected("dir.mp4", VideoSettings { existing: Existing::Replace, ..settings(1) }), "OUTPUT-CREATE");
    assert_eq!(rejected("no/such/folder.mp4", settings(1)), "OUTPUT-CREATE");
    assert_eq!(rejected("film.avi", settings(1)), "VIDEO-FORMAT");
    assert_eq!(rejected("film", settings(1)), "VIDEO-FORMAT");
    assert_eq!(rejected("a.mp4", VideoSettings { width: 0, ..settings(1) }), "VIDEO-SETTING");
    assert_eq!(rejected("a.mp4", VideoSettings { rate_fps: f64::NAN, ..settings(1) }), "VIDEO-SETTING");
    assert_eq!(rejected("a.mp4", VideoSettings { crf: 52, ..settings(1) }), "VIDEO-SETTING");
    assert_eq!(fs::read(folder.path().join("there.mp4")).unwrap(), b"mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "no other file was left");
    write_film(&folder.path().join("there.mp4"), &VideoSettings { existing: Existing::Replace, ..settings(2) }, 2)
        .unwrap();
    assert_eq!(decode(&folder.path().join("there.mp4")).pictures.len(), 2);
}

#[test]
fn frames_of_another_size_are_rejected() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = VideoWriter::create(&folder.path().join("a.mp4"), &settings(1)).unwrap();
    let error = writer.write_frame(&[0; 12]).unwrap_err();
    assert_eq!((error.code(), writer.num_written()), ("VIDEO-FRAME", 0));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_as_the_reason() {
    // /dev/full can be opened and fails every write; a link to it simulates a full disk.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mkv");
    if std::os::unix::fs::symlink("/dev/full", &path).is_err() || fs::write(&path, b"x").is_ok() {
        report_skip("/dev/full");
        return;
    }
    let error = write_film(&path, &settings(40), 40).unwrap_err();
    assert_eq!(error.code(), "FILE-WRITE", "{error}");
    assert!(error.to_string().contains("No space left"), "{error}");
}

#[test]
fn ffprobe_agrees() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    write_film(&path, &settings(60), 60).unwrap();
    let entries = "stream=codec_name,pix_fmt,color_range,color_space,color_transfer,color_primaries,chroma_location,\
                   r_frame_rate,nb_read_frames,duration";
    let mut ffprobe = Command::new("ffprobe");
    ffprobe.args(["-v", "error", "-count_frames", "-of", "default=nw=1", "-show_entries", entries]).arg(&path);
    let Ok(output) = ffprobe.output() else {
        report_skip("ffprobe");
        return;
    };
    insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap(), @r"
    codec_name=h264
    pix_fmt=yuv420p
    color_range=tv
    color_space=bt709
    color_transfer=bt709
    color_primaries=bt709
    chroma_location=left
    r_frame_rate=30/1
    duration=2.000000
    nb_read_frames=60
    ");
}

/// Alpha out of a film with opacity: decoded, every pixel has the opacity and the color that it was given.
#[test]
fn prores_4444_keeps_colors_and_opacity() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("alpha.mov");
    // An odd size, which 4:4:4 holds as it is. Opacity grows to the right, red downward.
    let (width, height) = (65, 35);
    let settings = VideoSettings { has_alpha: true, width: 65, height: 35, ..settings(3) };
    let rgba: Vec<[f32; 4]> =
        (0..width * height).map(|at| [(at / width) as f32 / 34.0, 0.5, 0.25, (at % width) as f32 / 64.0]).collect();
    let planes = AlphaPlanes::new(&rgba, width, height);
    assert_eq!(AlphaPlanes::from_bytes(&planes.to_bytes(), width, height), Some(planes.clone()));
    let mut writer = VideoWriter::create(&path, &settings).unwrap();
    (0..3).for_each(|_| writer.write_alpha_planes(&planes).unwrap());
    assert!(matches!(writer.write_planes(&settings.planes_of(&[0; 65 * 35 * 3])), Err(VideoError::FrameSize { .. })));
    writer.finish().unwrap();
    let mut input = format::input(&path).unwrap();
    let stream = input.streams().best(media::Type::Video).unwrap();
    let mut decoder = codec::Context::from_parameters(stream.parameters()).unwrap().decoder().video().unwrap();
    let packets: Vec<_> = input.packets().map(|(_, packet)| packet).collect();
    assert_eq!(packets.len(), 3);
    decoder.send_packet(&packets[0]).unwrap();
    decoder.send_eof().unwrap();
    let mut picture = frame::Video::empty();
    decoder.receive_frame(&mut picture).unwrap();
    assert_eq!((picture.width(), picture.height(), picture.planes()), (65, 35, 4));
    // FFmpeg decodes to 10 or 12 bits.
    let most = if picture.format() == format::Pixel::YUVA444P10LE { 1023.0 } else { 4095.0 };
    let code = |plane: usize, at: usize| {
        let row = &picture.data(plane)[at / width * picture.stride(plane)..];
        f64::from(u16::from_le_bytes([row[at % width * 2], row[at % width * 2 + 1]])) / most
    };
    for (at, pixel) in rgba.iter().enumerate() {
        let alpha = code(3, at);
        assert!((alpha - f64::from(pixel[3])).abs() < 2.0 / 255.0, "pixel {at}: opacity {alpha}");
        let luma = (code(0, at) * 1023.0 - 64.0) / 876.0;
        let red = luma + 1.5748 * (code(2, at) * 1023.0 - 512.0) / 896.0;
        assert!((red - f64::from(pixel[0])).abs() < 0.03, "pixel {at}: red {red}");
    }
}

#[test]
fn a_film_of_two_eyes_says_how_its_frames_hold_them() {
    let folder = tempfile::tempdir().unwrap();
    for packing in [EyePacking::SideBySide, EyePacking::OverUnder] {
        let path = folder.path().join("eyes.mp4");
        // With an index in front, and with one at the end.
        for num_frames in [4, 0] {
            let existing = Existing::Replace;
            let settings = VideoSettings { eyes: Some(packing), existing, ..settings(num_frames) };
            write_film(&path, &settings, 4).unwrap();
            assert_eq!(decode(&path).pictures.len(), 4);
            let bytes = fs::read(&path).unwrap();
            let at = bytes.windows(4).position(|window| window == b"st3d").unwrap();
            let mode = if packing == EyePacking::SideBySide { 2 } else { 1 };
            assert_eq!(bytes[at - 4..at + 9], [0, 0, 0, 13, b's', b't', b'3', b'd', 0, 0, 0, 0, mode]);
        }
    }
}
