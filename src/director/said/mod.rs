//! What the words of a step say plainly, over what the network read into them.

mod amounts;
mod arrivals;
mod asides;
mod backdrops;
mod bans;
mod between_them;
mod briefs;
mod called;
mod carriers;
mod circles;
mod contents;
mod denied;
mod directions;
mod dolly_zoom;
mod encores;
mod endings;
mod entries;
mod facing;
mod fills;
mod first_pictures;
mod fixed;
#[cfg(test)]
pub(crate) mod fixture;
mod foot_ends;
mod frame_sides;
mod goes_on;
mod headlines;
mod heights;
mod joined_moves;
mod kept_aims;
mod kept_back;
mod lengths;
mod levels;
mod looks;
mod meanwhile;
mod moods;
mod named_moves;
mod named_times;
mod narrated;
mod nearings;
mod open;
mod openings;
mod overheads;
mod pans;
mod places;
mod postures;
mod purposes;
mod ranges;
mod rates;
mod relative;
mod repeats;
mod rests;
mod scanned;
mod senses;
mod set_off;
mod sides;
mod slides;
mod small_moves;
mod specified;
mod splits;
mod stands;
mod still_briefs;
mod stillness;
mod sweeps;
mod taken_back;
mod together;
mod told_ends;
mod told_places;
mod travels;
mod unsaid_parts;
mod until;
mod visits;
mod whole_film;
mod wishes;

use cinesplat_language::{Linked, Senses};
use cinesplat_objects::Object;
use cinesplat_operator::Step;

pub(crate) use bans::asks_for;
pub(crate) use briefs::directs;
pub(crate) use directions::is_form;
pub use levels::take_levels;
pub(crate) use open::as_orbit;
pub(crate) use openings::abbreviated_size;
pub(crate) use pans::pan_from_first_to_last;
pub(crate) use scanned::frame_parts;

use crate::direction::Direction;
use crate::error::DirectorError;

/// Corrects a direction by what the words say plainly. `senses` has one entry per word.
///
/// # Errors
/// [`DirectorError::Language`] for a damaged list of senses.
pub(crate) fn take_said(linked: &Linked, senses: &[Senses], direction: &mut Direction) -> Result<(), DirectorError> {
    let steps = &mut direction.program.steps;
    directions::take_said_directions(linked, steps);
    directions::turn_to_sides(linked, steps);
    directions::tilt_as_said(linked, steps);
    directions::part_twins(linked, steps);
    directions::reveal_sideways(linked, steps);
    dolly_zoom::take_said_dolly_zooms(linked, steps);
    dolly_zoom::keep_said_lens(linked, steps);
    open::reverse_retraced(linked, steps);
    open::open_unstated_directions(linked, senses, steps)?;
    places::drop_descriptions(linked, steps);
    places::begin_at_source(linked, steps);
    places::pass_pairs(linked, steps);
    places::pass_across(linked, steps);
    places::stand_above(steps);
    places::crane_from_above(steps);
    places::rise_to_above(steps);
    places::complete_framings(steps);
    places::place_ends(linked, steps);
    moods::drop_statements(linked, direction);
    purposes::drop_purposes(linked, direction);
    repeats::merge_repeated(linked, senses, direction)?;
    amounts::leave_to_owner(linked, &mut direction.program.steps);
    repeats::pass_one_after_another(linked, direction);
    until::join_until(linked, direction);
    sweeps::join_sweeps(linked, direction);
    sweeps::land_on(linked, direction);
    repeats::drop_restated(direction);
    repeats::join_opening(linked, direction);
    repeats::join_told_circles(linked, direction);
    splits::split_moves(linked, direction);
    together::complete_lists(linked, &mut direction.program);
    let steps = &mut direction.program.steps;
    together::show_both(linked, steps);
    together::show_named_pair(linked, steps);
    together::keep_always(linked, steps);
    openings::take_sizes(linked, steps);
    openings::size_rests(linked, steps);
    openings::open_as_said(linked, steps);
    openings::rest_on_first_picture(linked, senses, steps)?;
    openings::rise_from_ground(linked, steps);
    openings::rise_overhead(linked, steps);
    specified::rise_to_overhead(linked, steps);
    specified::show_what_fills(linked, steps);
    specified::skim_past(linked, steps);
    openings::temper_closeness(linked, senses, steps)?;
    stillness::drop_unsaid_shake(linked, senses, steps)?;
    stillness::hold_tripods(linked, &mut direction.program);
    let steps = &mut direction.program.steps;
    stillness::turn_gazes(linked, steps);
    stillness::hold_slants(linked, steps);
    stillness::turn_tripods(linked, steps);
    stillness::move_without_focus(linked, steps);
    stillness::travel_ways(linked, steps);
    stillness::hold_arrivals(linked, steps);
    take_said_of_ends(linked, steps);
    // What the rules above read from the words is taken back with the rest.
    taken_back::drop_taken_back(linked, direction);
    let steps = &mut direction.program.steps;
    places::rise_by_lengths(linked, steps);
    asides::drop_camera_heights(linked, direction);
    asides::join_compared_heights(linked, direction);
    asides::drop_lenses(linked, direction);
    asides::drop_height_subjects(linked, direction);
    asides::drop_light(linked, direction);
    fills::rise_by_own_height(linked, &mut direction.program.steps);
    visits::visit_in_turn(linked, direction);
    rests::rest_on_each(linked, direction);
    visits::visit_listed(linked, direction);
    ranges::zoom_between_lenses(linked, direction);
    circles::end_behind_circles(linked, direction);
    circles::begin_before_circles(direction);
    circles::close_circles(linked, direction);
    circles::join_said_again(linked, direction);
    take_said_of_pictures(linked, &mut direction.program.steps);
    looks::roll_back(linked, &mut direction.program.steps);
    take_said_of_moves(linked, direction);
    named_moves::take_named_moves(linked, direction);
    Ok(())
}

/// Corrects how steps end by what their words say plainly.
fn take_said_of_ends(linked: &Linked, steps: &mut [Step]) {
    endings::glide_in_and_out(linked, steps);
    endings::travel_at_distance(steps);
    endings::near_to_size(linked, steps);
    endings::close_onto(linked, steps);
    contents::look_into(linked, steps);
    endings::show_whole(linked, steps);
    fills::show_completely(linked, steps);
    endings::end_on_place(linked, steps);
    endings::notice_place(linked, steps);
    endings::widen_again(linked, steps);
    stillness::circle_spirals(linked, steps);
}

/// Corrects the pictures of steps by what the words say plainly of how they look.
fn take_said_of_pictures(linked: &Linked, steps: &mut [Step]) {
    circles::turn_all_round(linked, steps);
    splits::walk_as_far(linked, steps);
    sides::go_round_to_sides(linked, steps);
    ranges::take_ranges(linked, steps);
    ranges::take_field_of_view(linked, steps);
    asides::hold_what_is_there(linked, steps);
    looks::face_symmetric(linked, steps);
    asides::move_by_share(linked, steps);
    looks::show_subjects(linked, steps);
    looks::roll_as_said(linked, steps);
    looks::reveal_by_leaving(linked, steps);
    looks::rest_where_nothing_leads(steps);
    looks::lead_between_sizes(steps);
    looks::look_down_from_above(linked, steps);
    looks::show_bearer(linked, steps);
    open::return_to_first(linked, steps);
    open::turn_by_parts(linked, steps);
    take_said_of_views(linked, steps);
}

/// Corrects the sides and rests of steps by what the words say plainly.
fn take_said_of_views(linked: &Linked, steps: &mut [Step]) {
    openings::level_frontal_views(linked, steps);
    openings::hide_at_first(linked, steps);
    openings::square_to_walls(linked, steps);
    openings::slide_square(linked, steps);
    openings::begin_straight_above(linked, steps);
    directions::rise_to_things(linked, steps);
    facing::begin_face_to_face(linked, steps);
    facing::rest_on_openings(linked, steps);
    facing::rest_up_close(linked, steps);
    facing::look_down_on_tops(linked, steps);
    directions::lead_between_ends(linked, steps);
    unsaid_parts::drop_unsaid_parts(linked, steps);
    unsaid_parts::drop_unsaid_amounts(linked, steps);
    first_pictures::begin_at_named(linked, steps);
    first_pictures::size_named(linked, steps);
    frame_sides::leave_sides_to_owners(linked, steps);
}

/// Corrects the moves of a direction, whose pictures are settled, by what the words say plainly.
fn take_said_of_moves(linked: &Linked, direction: &mut Direction) {
    lengths::take_film_length(linked, &mut direction.program);
    lengths::share_film_length(&mut direction.program);
    rates::take_rates(linked, direction);
    bans::drop_misplaced_bans(linked, &mut direction.program);
    bans::rule_out_turns(linked, &mut direction.program);
    specified::keep_level(linked, &mut direction.program);
    travels::travel_instead_of_turning(linked, &mut direction.program);
    travels::go_along(linked, &mut direction.program.steps);
    travels::slide_along_to(linked, &mut direction.program.steps);
    set_off::begin_as_set_off(linked, &mut direction.program.steps);
    nearings::come_nearer_round(linked, direction);
    fixed::stay_put(linked, &mut direction.program);
    fixed::turn_in_place(linked, &mut direction.program.steps);
    endings::stop_short(linked, &mut direction.program.steps);
    endings::end_on_wide(linked, &mut direction.program.steps);
    endings::keep_shown(linked, &mut direction.program.steps);
    fills::fill_with_only(linked, &mut direction.program.steps);
    fills::fill_to_edges(linked, &mut direction.program.steps);
    fills::close_on_only(linked, &mut direction.program.steps);
    fills::close_on_parts(linked, &mut direction.program.steps);
    fills::end_on_parts(linked, &mut direction.program.steps);
    small_moves::move_rests(linked, &mut direction.program.steps);
    small_moves::turn_only(linked, &mut direction.program.steps);
    carriers::carry_as_said(linked, &mut direction.program.steps);
    arrivals::go_between_stops(linked, &mut direction.program.steps);
    goes_on::go_on(linked, &mut direction.program.steps);
    goes_on::slide_on(&mut direction.program.steps);
    between_them::pass_between_them(linked, &mut direction.program.steps);
    goes_on::drop_wordless(linked, &mut direction.program.steps);
    goes_on::join_arrivals(linked, &mut direction.program.steps);
    goes_on::finish_on_picture(linked, direction);
    goes_on::join_rises(linked, direction);
    told_places::drop_told_places(linked, direction);
    stillness::show_needed(linked, direction);
    stands::stand_at_opening(linked, &mut direction.program.steps);
    stands::stand_where_wide(linked, &mut direction.program.steps);
    stands::stand_at_side(linked, &mut direction.program.steps);
    stands::begin_at_side(linked, &mut direction.program.steps);
    stands::see_from_own_end(linked, &mut direction.program.steps);
    stands::open_on_sides(linked, &mut direction.program.steps);
    postures::stand_low(linked, direction);
    postures::stay_up_and_down(linked, &mut direction.program.steps);
    places::crane_from_above(&mut direction.program.steps);
    postures::rise_from_floor(linked, &mut direction.program.steps);
    kept_aims::stay_aimed(linked, &mut direction.program.steps);
    kept_aims::slide_straight(linked, &mut direction.program.steps);
    kept_back::reveal_from_behind(linked, &mut direction.program.steps);
    kept_back::rise_from_behind(linked, direction);
    heights::begin_at_height(linked, &mut direction.program.steps);
    heights::hold_height(linked, direction);
}

/// Corrects steps by what the words say in relation to what was said before.
fn take_said_in_relation(linked: &Linked, steps: &mut [Step]) {
    relative::take_relative_amounts(linked, steps);
    relative::come_closer_by(linked, steps);
    meanwhile::move_aside_meanwhile(linked, steps);
    relative::tilt_from_floor(linked, steps);
    relative::climb_from_below(linked, steps);
    relative::pan_clockwise(linked, steps);
    relative::travel_above(linked, steps);
    relative::stay_in_place(linked, steps);
    relative::turn_from_elsewhere(steps);
    relative::end_in_corner(linked, steps);
    relative::rise_from_low(steps);
    relative::begin_at_passed(steps);
    relative::stop_on_only(linked, steps);
}

/// Corrects a direction by what the words say plainly of several of its parts.
pub(crate) fn take_said_of_all(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    moods::drop_stories(linked, direction);
    told_ends::move_told_ends(linked, direction);
    openings::drop_unnamed_starts(linked, &mut direction.program.steps);
    openings::drop_unnamed_passes(linked, &mut direction.program.steps);
    places::leave_from(linked, direction);
    entries::come_in_at_doors(linked, objects, direction);
    specified::skim_tops(linked, objects, &mut direction.program.steps);
    specified::slide_along_rows(objects, &mut direction.program.steps);
    repeats::drop_restated(direction);
    encores::repeat_all(linked, direction);
    meanwhile::sway_to_each(linked, direction);
    meanwhile::join_simultaneous(linked, direction);
    take_said_in_relation(linked, &mut direction.program.steps);
    open::go_other_way(linked, &mut direction.program.steps);
    open::come_back_either_way(&mut direction.program.steps);
    directions::rise_or_sink(linked, &mut direction.program.steps);
    lengths::take_total(linked, direction);
    asides::time_title(linked, &mut direction.program);
    arrivals::end_at_stops(linked, &mut direction.program.steps);
    if !narrated::film_narrated(linked, direction) && !wishes::film_wishes(linked, objects, direction) {
        briefs::film_briefs(linked, objects, direction);
    }
    briefs::film_moods(linked, direction);
    briefs::show_many(linked, direction);
    headlines::drop_headline(linked, direction);
    headlines::cut_as_headlined(linked, &mut direction.program);
    headlines::cut_shots(linked, &mut direction.program);
    carriers::flow_without_cuts(&mut direction.program);
    circles::go_round_in_one(linked, direction);
    carriers::show_all_sides(linked, direction);
    let steps = &mut direction.program.steps;
    endings::include_named(linked, steps);
    endings::show_also(linked, steps);
    whole_film::keep_uncut(linked, steps);
    whole_film::keep_or_avoid(linked, steps);
    whole_film::take_pace(linked, steps);
    whole_film::size_each(linked, steps);
    whole_film::keep_throughout(linked, &mut direction.program);
    whole_film::never_lose(linked, &mut direction.program);
    whole_film::avoid_throughout(linked, &mut direction.program);
    named_times::take_named_times(linked, &mut direction.program);
    named_times::merge_named_speeds(linked, direction);
    fixed::lock_off(linked, &mut direction.program.steps);
    denied::drop_denied(linked, direction);
    endings::join_listed(linked, direction);
    slides::join_slides(linked, direction);
    still_briefs::move_still_films(linked, direction);
    arrivals::arrive_at_passed(linked, direction);
    kept_back::keep_for_end(linked, direction);
    foot_ends::see_from_foot(linked, objects, &mut direction.program.steps);
    overheads::rise_from_above(linked, direction);
    wishes::turn_evenly(linked, &mut direction.program.steps);
    sides::see_obliquely(linked, &mut direction.program.steps);
    relative::level_lifts(&mut direction.program);
    relative::lift_straight(linked, &mut direction.program);
    bans::keep_travel_bans_to_turns(linked, &mut direction.program);
    backdrops::set_backdrops(linked, &mut direction.program.steps);
}
