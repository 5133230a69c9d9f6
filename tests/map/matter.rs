use cinesplat::map::draw;
use cinesplat::map::drawing::Mark;
use cinesplat::objects::ObjectSet;
use cinesplat::scene::Gaussians;
use glam::{DVec3, Vec3};

use super::{mapped, room, travel};
use crate::objects::{push, scene_of};

/// Color in the middle of the picture of the plan.
fn plan_color(gaussians: Gaussians) -> [u8; 3] {
    let drawing = draw(&scene_of(gaussians), &ObjectSet::default(), &travel()).unwrap();
    let picture = drawing.marks.iter().find_map(|mark| match mark {
        Mark::Picture { picture, .. } => Some(picture),
        _ => None,
    });
    let picture = picture.unwrap();
    let [width, height] = picture.size.map(|size| size as usize);
    let at = (height / 2 * width + width / 2) * 3;
    picture.rgb8[at..at + 3].try_into().unwrap()
}

/// A level square of Gaussians.
fn level(gaussians: &mut Gaussians, height: f64, color: Vec3) {
    for i in 0..60 {
        for j in 0..60 {
            let at = DVec3::new(f64::from(i) - 29.5, 0.0, f64::from(j) - 29.5) * 0.06;
            push(gaussians, at + DVec3::Y * height, 0.05, color);
        }
    }
}

#[test]
fn a_ceiling_does_not_hide_the_room() {
    let (red, blue) = (Vec3::new(0.9, 0.1, 0.1), Vec3::new(0.1, 0.1, 0.9));
    let mut gaussians = Gaussians::default();
    level(&mut gaussians, 0.0, red);
    level(&mut gaussians, 2.5, blue);
    let [r, _, b] = plan_color(gaussians);
    assert!(r > b + 40, "the floor is red: {r} {b}");
    let mut open = Gaussians::default();
    level(&mut open, 0.0, blue);
    let [r, _, b] = plan_color(open);
    assert!(b > r + 40, "a floor alone is no ceiling: {r} {b}");
}

#[test]
fn two_drawings_have_the_same_bytes_for_any_number_of_threads() {
    let draw_with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| mapped(&travel()))
    };
    let (one, four) = (draw_with(1), draw_with(4));
    assert_eq!(one.to_svg(), four.to_svg());
    assert_eq!(one.to_png(1.0).unwrap(), four.to_png(1.0).unwrap());
}

#[test]
fn svg_and_png_show_the_same_marks() {
    let drawing = mapped(&travel());
    let svg = drawing.to_svg();
    assert!(svg.starts_with("<svg") && svg.contains("data:image/png;base64,"));
    let png = image::load_from_memory(&drawing.to_png(2.0).unwrap()).unwrap().into_rgb8();
    assert_eq!([png.width(), png.height()].map(f64::from), (drawing.size_px * 2.0).to_array());
    // The rim of the first key's disc is black in the PNG where the display list has it.
    let at = super::first_key_px(&drawing) + glam::DVec2::new(-6.0, 0.0);
    let pixel = png.get_pixel((at.x * 2.0) as u32, (at.y * 2.0) as u32).0;
    assert!(pixel.iter().all(|level| *level < 60), "{pixel:?}");
    let corner = png.get_pixel(1, 1).0;
    assert_eq!(corner, [255; 3]);
}

#[test]
fn the_room_is_in_both_views() {
    let (scene, objects) = room();
    let drawing = draw(&scene, &objects, &travel()).unwrap();
    for mark in &drawing.marks {
        if let Mark::Picture { picture, .. } = mark {
            let dark = picture.rgb8.chunks_exact(3).filter(|pixel| pixel.iter().any(|level| *level < 250)).count();
            let all = picture.size[0] as usize * picture.size[1] as usize;
            assert!(dark * 2 > all, "{dark} of {all} pixels show matter");
        }
    }
}
