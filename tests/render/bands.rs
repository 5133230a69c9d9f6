//! Pictures that are rendered in bands to stay within the memory limit.

use cinesplat::render::{Frame, Limits, Quality, RenderSettings, Renderer, Rgb8Frame};

use super::scenes::{camera, crowd};

/// Settings with memory limits that lead to bands, and their frames. With bands more Gaussians are projected, because
/// groups that are visible in two bands count twice.
fn with_bands(renderer: &Renderer<'_>, settings: &RenderSettings, whole: &Frame) -> Vec<(RenderSettings, Frame)> {
    let limits = (0..60).map(|step| (f64::from(15 << 20) * 0.996_f64.powi(step)) as u64);
    let rendered = limits.filter_map(|max_memory_bytes| {
        let limits = Limits { max_memory_bytes, ..Limits::default() };
        let settings = RenderSettings { limits, ..*settings };
        Some((settings, renderer.render(&camera(640, 360), &settings).ok()?))
    });
    rendered.filter(|(_, frame)| frame.stats.counts.num_projected > whole.stats.counts.num_projected).collect()
}

#[test]
fn a_picture_in_bands_equals_the_whole_picture_bit_by_bit() {
    let scene = crowd(60_000, 23);
    let renderer = Renderer::new(&scene);
    let labels: Vec<u16> = (0..scene.len()).map(|idx| (idx % 5) as u16).collect();
    for quality in [Quality::Standard, Quality::Final] {
        let settings = RenderSettings { quality, ..RenderSettings::default() };
        let view = camera(640, 360);
        let whole = renderer.render(&view, &settings).unwrap();
        let (depth, ids) = (renderer.depth(&view, &settings).unwrap(), renderer.object_ids(&view, &settings, &labels));
        let banded = with_bands(&renderer, &settings, &whole);
        assert!(!banded.is_empty(), "no limit led to bands");
        for (_, frame) in &banded {
            assert!(frame.rgb == whole.rgb && frame.transmittance == whole.transmittance, "{}", quality.as_ref());
            assert_eq!(frame.stats.counts.num_pairs, whole.stats.counts.num_pairs);
            assert_eq!(frame.stats.counts.num_block_blends, whole.stats.counts.num_block_blends);
        }
        let settings = &banded[0].0;
        let mut rgb8 = Rgb8Frame::default();
        renderer.render_rgb8_into(&view, settings, &mut rgb8).unwrap();
        assert_eq!(rgb8.rgb8, whole.to_rgb8());
        assert_eq!(renderer.depth(&view, settings).unwrap(), depth);
        assert_eq!(renderer.object_ids(&view, settings, &labels), ids);
    }
}

#[test]
fn a_picture_takes_at_most_100_bytes_per_gaussian_and_64_per_pixel() {
    let scene = crowd(150_000, 24);
    let renderer = Renderer::new(&scene);
    let (width, height) = (640, 360);
    for quality in [Quality::Standard, Quality::Final] {
        let settings = RenderSettings { quality, ..RenderSettings::default() };
        let frame = renderer.render(&camera(width, height), &settings).unwrap();
        assert!(frame.stats.counts.num_splats > 100_000, "most of the scene is visible");
        let num_pixels = u64::from(width * height);
        let held_bytes = renderer.memory_bytes() + num_pixels * 16;
        assert!(held_bytes <= 100 * scene.len() as u64 + 64 * num_pixels, "{held_bytes} bytes");
    }
}
