//! Where rasterizers go wrong: needles, flat and huge splats, poison, the near plane, opaque walls, files of all kinds.
//! Judged by a second renderer in `f64` (`oracle`), by Gaussians integrated along rays (`per_ray`), by a formula, or by
//! a property that must hold. The cases and the tests of each:
//!
//! | # | case | tests |
//! |---|---|---|
//! | 1 | needles | `shapes::{needles_keep_their_opacity_up_to_a_hundred_thousand_pixels, determinants_of_needles_are_those_of_the_formula}` |
//! | 2 | flat and point Gaussians | `shapes::{flat_and_point_gaussians_are_the_limit_of_thin_ones, a_disk_seen_from_its_edge_is_a_line_as_wide_as_the_dilation}` |
//! | 3 | quaternions of any length | `inputs::{quaternions_of_any_length_and_sign_draw_alike, a_zero_quaternion_is_dropped_and_counted}`, `places::the_sign_of_a_quaternion_does_not_matter` |
//! | 4 | numbers that are none, extremes | `inputs::{poisoned_gaussians_change_nothing, every_property_of_a_file_takes_any_number, extreme_but_valid_gaussians_stay_visible}` |
//! | 5 | a camera inside a splat | `places::{a_camera_that_flies_through_a_splat_sees_only_finite_numbers, a_camera_at_a_mean_sees_the_color_without_direction}` |
//! | 6 | behind the camera | `places::what_is_behind_the_camera_leaves_no_ghost` |
//! | 7 | where the projection is linearized | `places::{a_principal_point_off_the_middle_is_a_crop_of_a_wider_picture, a_principal_point_far_off_the_middle_is_that_of_the_second_renderer}`, `per_ray::the_affine_projection_is_near_the_exact_rays_where_splats_are_small` |
//! | 8 | splats larger than the picture | `limits::{a_hundred_thousand_full_screen_splats_lose_no_tile_and_stay_under_the_cap, too_much_work_ends_in_one_error_before_anything_is_allocated}` |
//! | 9 | opacity 1 | `color::an_opaque_wall_lets_a_hundredth_through_and_two_a_ten_thousandth` |
//! | 10 | equal depths | `repeatable::{one_two_three_and_seven_threads_agree_to_the_bit, shuffling_a_file_without_equal_depths_changes_nothing, equal_depths_blend_in_the_order_of_the_file}` |
//! | 11 | depth keys | `places::a_splat_a_million_units_away_changes_no_level` |
//! | 12 | popping | `popping::{by_depth_a_pan_pops_and_by_distance_it_does_not, a_crowd_pops_less_by_distance_than_by_depth}`, `sort_modes` |
//! | 13 | large coordinates | `inputs::doubles_far_off_draw_the_picture_of_near_ones`, `repeatable::far_off_coordinates_give_the_picture_of_near_ones`, `scene::intake::single_precision_far_off_says_what_it_lost` |
//! | 14 | half precision | `shapes::needles_survive_scales_and_rotations_in_half_precision` |
//! | 15 | color below 0 and above 1 | `color::{color_is_clamped_below_before_blending_and_above_after_it, color_clamped_in_every_gaussian_makes_bright_ones_white_before_blending}` |
//! | 16 | color space | `color::{layers_blend_as_trained, a_film_without_blur_has_the_levels_of_the_composite}` |
//! | 17 | filters | `shapes::mip_keeps_the_light_of_a_splat_that_moves_away` |
//! | 18 | threads, instruction sets | `repeatable::{one_two_three_and_seven_threads_agree_to_the_bit, every_instruction_set_gives_the_same_picture_to_the_bit}` |
//! | 19 | many equal splats | `inputs::a_million_equal_splats_load_and_draw` |
//! | 20 | files of the same Gaussians | `inputs::files_of_the_same_gaussians_draw_the_same_picture`, `scene::inria` |

mod color;
mod inputs;
mod limits;
mod places;
mod popping;
mod shapes;

use cinesplat::geometry::Camera;
use cinesplat::render::{Frame, Quality, RenderSettings, Renderer};
use cinesplat::scene::{Gaussians, SplatFilter};

use super::oracle;
use super::pictures::psnr_db;
use super::scenes::{camera, crowd};

fn settings(quality: Quality) -> RenderSettings {
    RenderSettings { quality, near: 0.01, ..RenderSettings::default() }
}

fn picture(scene: &Gaussians, camera: &Camera, quality: Quality) -> Frame {
    Renderer::new(scene).render(camera, &settings(quality)).unwrap()
}

#[test]
fn a_crowd_of_all_shapes_is_that_of_the_second_renderer() {
    let scene = crowd(400, 1);
    // Neither side a multiple of a tile or block; principal point off the middle.
    let mut view = camera(131, 77);
    view.intrinsics.cx_px += 9.25;
    for filter in [SplatFilter::Classic, SplatFilter::Mip, SplatFilter::MipSmall] {
        let (rgb, rest) = oracle::render(&scene, &view, filter, 0.01);
        for (quality, least_db) in [(Quality::Reference, 80.0), (Quality::Final, 70.0), (Quality::Standard, 50.0)] {
            let frame = Renderer::new(&scene).render(&view, &RenderSettings { filter, ..settings(quality) }).unwrap();
            let (color, transmittance) = (psnr_db(&frame.rgb, &rgb), psnr_db(&frame.transmittance, &rest));
            assert!(color > least_db && transmittance > least_db, "{filter:?} {quality:?}: {color} {transmittance}");
        }
    }
}
