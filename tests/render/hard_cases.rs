//! Cases where rasterizers fail: needles, flat and huge splats, NaN, the near plane, opaque walls, files of all kinds.
//! The oracles are a second renderer in `f64` (`oracle`), Gaussians integrated along rays (`per_ray`), formulas, and
//! invariants. The cases and their tests:
//!
//! | # | case | tests |
//! |---|---|---|
//! | 1 | needles | `shapes::{needles_keep_their_opacity_up_to_a_hundred_thousand_pixels, determinants_of_needles_are_those_of_the_formula}` |
//! | 2 | flat and point Gaussians | `shapes::{flat_and_point_gaussians_are_the_limit_of_thin_ones, a_disk_seen_from_its_edge_is_a_line_as_wide_as_the_dilation}` |
//! | 3 | quaternions of any length | `inputs::{quaternions_of_any_length_and_sign_draw_alike, a_zero_quaternion_is_dropped_and_counted}`, `places::the_sign_of_a_quaternion_does_not_matter` |
//! | 4 | NaN, infinities, extremes | `inputs::{poisoned_gaussians_change_nothing, every_property_of_a_file_takes_any_number, extreme_but_valid_gaussians_stay_visible}` |
//! | 5 | a camera inside a splat | `places::{a_camera_that_flies_through_a_splat_sees_only_finite_numbers, a_camera_at_a_mean_sees_the_color_without_direction}` |
//! | 6 | behind the camera | `places::gaussians_behind_the_camera_are_not_drawn` |
//! | 7 | where the projection is linearized | `places::{a_principal_point_off_the_middle_is_a_crop_of_a_wider_picture, a_picture_with_an_extreme_principal_point_matches_the_second_renderer}`, `per_ray::the_affine_projection_is_close_to_exact_rays_for_small_splats` |
//! | 8 | splats larger than the picture | `limits::{a_hundred_thousand_full_screen_splats_lose_no_tile_and_stay_within_the_memory_limit, work_above_the_limits_is_an_error_before_any_allocation}` |
//! | 9 | opacity 1 | `color::one_opaque_wall_transmits_one_hundredth_and_two_one_ten_thousandth` |
//! | 10 | equal depths | `repeatable::{one_two_three_and_seven_threads_give_the_same_bits, shuffling_a_file_without_equal_depths_changes_nothing, equal_depths_blend_in_the_order_of_the_file}` |
//! | 11 | depth keys | `places::a_splat_a_million_units_away_changes_levels_by_at_most_one` |
//! | 12 | popping | `popping::{a_pan_pops_in_mode_z_and_not_in_mode_ray, a_crowd_pops_less_in_mode_ray_than_in_mode_z}`, `sort_modes` |
//! | 13 | large coordinates | `inputs::large_coordinates_in_double_precision_draw_the_picture_of_small_ones`, `repeatable::large_coordinates_give_the_picture_of_small_ones`, `scene::intake::single_precision_far_from_the_origin_reports_its_quantization` |
//! | 14 | half precision | `shapes::needles_survive_scales_and_rotations_in_half_precision` |
//! | 15 | color below 0 and above 1 | `color::{color_is_clamped_below_before_blending_and_above_after_it, color_clamped_in_every_gaussian_makes_bright_ones_white_before_blending}` |
//! | 16 | color space | `color::{layers_blend_as_trained, a_film_without_blur_has_the_levels_of_the_still}` |
//! | 17 | filters | `shapes::mip_keeps_the_light_of_a_splat_that_moves_away` |
//! | 18 | threads, instruction sets | `repeatable::{one_two_three_and_seven_threads_give_the_same_bits, every_instruction_set_gives_the_same_bits}` |
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
fn a_crowd_of_all_shapes_matches_the_second_renderer() {
    let scene = crowd(400, 1);
    // Width and height are no multiples of a tile or block; the principal point is off the middle.
    let mut view = camera(131, 77);
    view.intrinsics.cx_px += 9.25;
    for filter in [SplatFilter::Classic, SplatFilter::Mip, SplatFilter::MipSmall] {
        let (rgb, rest) = oracle::render(&scene, &view, filter, 0.01);
        for (quality, least_db) in [(Quality::Reference, 140.0), (Quality::Final, 100.0), (Quality::Standard, 55.0)] {
            let frame = Renderer::new(&scene).render(&view, &RenderSettings { filter, ..settings(quality) }).unwrap();
            let (color, transmittance) = (psnr_db(&frame.rgb, &rgb), psnr_db(&frame.transmittance, &rest));
            assert!(color > least_db && transmittance > least_db, "{filter:?} {quality:?}: {color} {transmittance}");
        }
    }
}
