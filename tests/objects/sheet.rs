use cinesplat::objects::{self, ObjectSet, SheetSettings, sheet};
use cinesplat::scene::{Gaussians, Scene, UpSource};
use glam::{DVec3, Vec3};

use super::{push_box, scene_of};

fn two_boxes() -> (Scene, ObjectSet) {
    let mut gaussians = Gaussians::default();
    push_box(&mut gaussians, DVec3::ZERO, DVec3::splat(0.5), 0.1, Vec3::new(0.7, 0.1, 0.1));
    let first = gaussians.len();
    push_box(&mut gaussians, DVec3::new(2.0, 0.0, 0.5), DVec3::splat(0.4), 0.1, Vec3::new(0.1, 0.2, 0.7));
    let labels = (0..gaussians.len()).map(|i| 3 + u16::from(i >= first)).collect();
    let scene = scene_of(gaussians);
    let set = objects::from_labels(&scene, labels);
    (scene, set)
}

#[test]
fn every_object_has_a_tile_with_its_color() {
    let (scene, set) = two_boxes();
    let settings = SheetSettings { num_columns: 2, tile_width_px: 120, ..SheetSettings::default() };
    let image = sheet(&scene, &set, &settings).unwrap().page(&settings);
    let (width, overview) = (2 * 126 + 6, (2 * 126 + 6) * 9 / 16);
    assert_eq!((image.width(), image.height()), (width, overview + 6 + 90 + 44 + 6));
    // The middle of a tile's picture shows its object: red in the left one, blue in the right one.
    let middle = |column: u32| image.get_pixel(6 + column * 126 + 60, overview + 6 + 45).0;
    let (left, right) = (middle(0), middle(1));
    assert!(left[0] > 80 && left[0] > 2 * left[2], "{left:?}");
    assert!(right[2] > 80 && right[2] > 2 * right[0], "{right:?}");
}

#[test]
fn the_id_is_written_in_the_corner_of_its_tile() {
    let (scene, set) = two_boxes();
    let settings = SheetSettings { num_columns: 2, tile_width_px: 120, ..SheetSettings::default() };
    let image = sheet(&scene, &set, &settings).unwrap().page(&settings);
    let top = 258 * 9 / 16 + 6 + 8;
    // The font's "4" (its 8 x 8 bits, drawn three times as large) in dark ink on a bright plate.
    let four = ["   ###  ", "  ####  ", " ## ##  ", "##  ##  ", "####### ", "    ##  ", "   #### "];
    for (row, bits) in (0_u32..).zip(four) {
        for (column, bit) in (0_u32..).zip(bits.chars()) {
            let pixel = image.get_pixel(6 + 126 + 8 + column * 3 + 1, top + row * 3 + 1).0;
            let dark = pixel.iter().all(|v| *v < 40);
            assert_eq!(dark, bit == '#', "row {row}, column {column}: {pixel:?}");
        }
    }
}

#[test]
fn a_tile_shows_its_object_alone_and_parts_follow_their_whole() {
    let (scene, mut set) = two_boxes();
    set.objects.swap(0, 1);
    set.objects[0].parent = Some(3);
    let settings = SheetSettings { tile_width_px: 120, ..SheetSettings::default() };
    let sheet = sheet(&scene, &set, &settings).unwrap();
    let order: Vec<(u32, usize)> = sheet.tiles.iter().map(|tile| (tile.id, tile.depth)).collect();
    assert_eq!(order, [(3, 0), (4, 1)]);
    let is_red = |p: &image::Rgb<u8>| p.0[0] > 60 && p.0[0] > 2 * p.0[2];
    let part = &sheet.tiles[1].picture;
    assert!(!part.enumerate_pixels().any(|(x, y, p)| (x > 40 || y > 40) && is_red(p)), "the other box is cut away");
}

#[test]
fn the_page_needs_no_network_and_escapes_names() {
    let (scene, mut set) = two_boxes();
    set.objects[0].label = "<b>\"mug\" & co".to_owned();
    let settings = SheetSettings { tile_width_px: 64, ..SheetSettings::default() };
    let page = sheet(&scene, &set, &settings).unwrap().html("a < b").unwrap();
    assert!(page.contains("&lt;b&gt;&quot;mug&quot; &amp; co") && page.contains("<title>a &lt; b</title>"));
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert!(!page.contains("http") && !page.contains("<b>\""));
}

#[test]
fn a_scene_without_objects_has_an_overview() {
    let (scene, mut set) = two_boxes();
    set.objects.clear();
    let settings = SheetSettings { tile_width_px: 64, ..SheetSettings::default() };
    let image = sheet(&scene, &set, &settings).unwrap().page(&settings);
    assert_eq!(image.width(), 5 * 70 + 6);
}

/// A curtain as long as the room counted as the only thing of its scan, which the overview showed from outside.
#[test]
fn a_room_with_a_long_curtain_is_seen_from_inside() {
    let mut gaussians = Gaussians::default();
    let pale = Vec3::new(0.8, 0.78, 0.74);
    push_box(&mut gaussians, DVec3::ZERO, DVec3::new(2.5, 0.0, 2.0), 0.06, pale);
    push_box(&mut gaussians, DVec3::new(0.0, 1.2, -2.0), DVec3::new(2.5, 1.2, 0.0), 0.06, pale);
    for x in [-2.5, 2.5] {
        push_box(&mut gaussians, DVec3::new(x, 1.2, 0.0), DVec3::new(0.0, 1.2, 2.0), 0.06, pale);
    }
    let mut labels = vec![0; gaussians.len()];
    let curtain = DVec3::new(0.0, 1.2, -1.9);
    push_box(&mut gaussians, curtain, DVec3::new(2.3, 1.1, 0.04), 0.1, Vec3::new(0.2, 0.3, 0.6));
    labels.resize(gaussians.len(), 1);
    for (id, x) in [(2, -1.4), (3, 0.0), (4, 1.4)] {
        push_box(&mut gaussians, DVec3::new(x, 0.4, -1.0), DVec3::splat(0.35), 0.03, Vec3::new(0.7, 0.1, 0.1));
        labels.resize(gaussians.len(), id);
    }
    let scene = scene_of(gaussians);
    let set = objects::from_labels(&scene, labels);
    let settings = SheetSettings { tile_width_px: 64, ..SheetSettings::default() };
    let overview = sheet(&scene, &set, &settings).unwrap().overviews.remove(0);
    let num_void = overview.pixels().filter(|pixel| pixel.0.iter().all(|value| *value < 3)).count();
    let num_pixels = (overview.width() * overview.height()) as usize;
    assert!(num_void * 5 < 2 * num_pixels, "{num_void} of {num_pixels} pixels show nothing");
}

#[test]
fn a_closed_room_is_seen_from_inside_and_its_picture_from_the_front() {
    let mut gaussians = Gaussians::default();
    let pale = Vec3::new(0.8, 0.78, 0.74);
    push_box(&mut gaussians, DVec3::new(0.0, 1.25, 0.0), DVec3::new(2.5, 1.25, 2.0), 0.06, pale);
    let mut labels = vec![0; gaussians.len()];
    // A picture on the wall: red to the room, and blue to the wall.
    push_box(&mut gaussians, DVec3::new(0.0, 1.4, -1.9), DVec3::new(0.4, 0.3, 0.0), 0.03, Vec3::new(0.8, 0.1, 0.1));
    push_box(&mut gaussians, DVec3::new(0.0, 1.4, -1.96), DVec3::new(0.4, 0.3, 0.0), 0.03, Vec3::new(0.1, 0.1, 0.8));
    labels.resize(gaussians.len(), 1);
    push_box(&mut gaussians, DVec3::new(1.0, 0.4, 0.5), DVec3::splat(0.35), 0.03, Vec3::new(0.1, 0.7, 0.1));
    labels.resize(gaussians.len(), 2);
    let scene = scene_of(gaussians);
    let set = objects::from_labels(&scene, labels);
    let sheet = sheet(&scene, &set, &SheetSettings { tile_width_px: 64, ..SheetSettings::default() }).unwrap();
    let count = |image: &image::RgbImage, is: &dyn Fn([i32; 3]) -> bool| {
        image.pixels().filter(|pixel| is(pixel.0.map(i32::from))).count()
    };
    // From above the ceiling neither would be seen.
    let is_red = |[r, g, b]: [i32; 3]| r > 90 && r > 2 * g && r > 2 * b;
    let is_green = |[r, g, b]: [i32; 3]| g > 90 && g > 2 * r && g > 2 * b;
    let seen_in_all =
        |is: &dyn Fn([i32; 3]) -> bool| sheet.overviews.iter().map(|image| count(image, is)).sum::<usize>();
    assert!(seen_in_all(&is_red) > 100 && seen_in_all(&is_green) > 100, "the overviews stand in the room");
    let is_blue = |[r, g, b]: [i32; 3]| b > 90 && b > 2 * r && b > 2 * g;
    let tile = &sheet.tiles[0].picture;
    assert!(count(tile, &is_red) > 500 && count(tile, &is_blue) < 20, "the picture is seen from the room");
}

#[test]
fn a_scene_without_extent_is_an_error() {
    let error = sheet(&scene_of(Gaussians::default()), &ObjectSet::default(), &SheetSettings::default()).unwrap_err();
    assert_eq!(error.code(), "OBJ-PICTURE");
}

#[test]
fn a_sheet_of_a_scene_whose_up_is_a_guess_shows_the_candidates() {
    let (mut scene, set) = two_boxes();
    let settings = SheetSettings { tile_width_px: 120, ..SheetSettings::default() };
    scene.up_source = UpSource::Estimated(79);
    let guessed = sheet(&scene, &set, &settings).unwrap();
    assert!(!guessed.up_views.is_empty() && guessed.up_views.is_sorted_by_key(|view| 100 - view.percent));
    for view in &guessed.up_views {
        // The scene is in the middle of its picture: not the gray of the background.
        let middle = view.picture.get_pixel(view.picture.width() / 2, view.picture.height() / 2).0;
        let colors = view.picture.pixels().filter(|p| p.0[0].abs_diff(p.0[2]) > 20).count();
        assert!(colors > 50, "{} shows nothing: {middle:?}", view.up);
    }
    let page = guessed.html("boxes").unwrap();
    assert!(page.contains("Which way is up?") && page.contains("<code>--up "));
    scene.up_source = UpSource::Estimated(80);
    let sure = sheet(&scene, &set, &settings).unwrap();
    assert!(sure.up_views.is_empty() && !sure.html("boxes").unwrap().contains("Which way is up?"));
    assert!(sure.page(&settings).height() < guessed.page(&settings).height());
}
