//! Hard limits on whole films.

use cinesplat::critic::{Limit, LimitCheck, Review, Term};
use cinesplat::objects::Object;
use cinesplat::scene::Gaussians;
use glam::{DVec3, Vec3};

use super::{Stage, film, gray, sheet, wall};

fn check(review: &Review, limit: Limit) -> LimitCheck {
    review.limits.iter().find(|check| check.limit == limit).copied().unwrap()
}

/// A small ball of a subject at depth 4, and a post of half width 0.5 at depth 2.
fn hidden_by_a_post() -> Stage {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-8.0, 8.0), 6.0, gray);
    sheet(&mut scene, ([-0.1, -0.1], [0.1, 0.1]), (4.0, 0.99), gray);
    sheet(&mut scene, ([-0.5, -1.0], [0.5, 1.0]), (2.0, 0.99), gray);
    Stage::new(scene, vec![Object::from_box(3, "ball", DVec3::new(0.0, 0.0, 4.0), DVec3::splat(0.15))])
}

#[test]
fn a_subject_behind_a_post_is_lost_on_the_frames_that_geometry_says() {
    // The ray from x = c to the ball crosses the post's depth at c / 2: hidden at |c| of 0, 0.4 and 0.8, free from 1.2 on.
    let film = film(DVec3::new(-2.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0), &[3]);
    let review = hidden_by_a_post().review(&film, 11);
    let lost = check(&review, Limit::Lost);
    assert!((lost.got - 5.0 / 11.0).abs() < 1e-9, "{}", lost.got);
    assert!(!lost.is_kept());
    assert!((lost.at_secs.unwrap() - 3.0).abs() < 1e-9, "{:?}", lost.at_secs);
}

#[test]
fn a_subject_that_need_not_be_seen_is_not_lost() {
    let mut film = film(DVec3::new(-2.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0), &[3]);
    film.sightings[0].to_secs = 2.0;
    let review = hidden_by_a_post().review(&film, 11);
    assert!(check(&review, Limit::Lost).is_kept());
    film.sightings.clear();
    assert!(hidden_by_a_post().review(&film, 11).limits.iter().all(|check| check.limit != Limit::Lost));
}

#[test]
fn the_worst_moment_counts_for_void_and_only_in_rooms() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-8.0, 0.0), 4.0, gray);
    let stage = Stage::new(scene, Vec::new());
    let mut away = film(DVec3::new(-4.0, 0.0, 0.0), DVec3::ZERO, &[]);
    let void = check(&stage.review(&away, 9), Limit::Void);
    assert!((void.got - 0.5).abs() < 0.03 && !void.is_kept(), "{}", void.got);
    assert!((void.at_secs.unwrap() - 10.0).abs() < 1e-9);
    away.is_indoor = false;
    assert!(stage.review(&away, 9).limits.iter().all(|check| check.limit != Limit::Void));
}

#[test]
fn a_foreground_breaks_the_limit_unless_the_words_ask_for_it() {
    let mut scene = Gaussians::default();
    wall(&mut scene, (-8.0, 8.0), 6.0, gray);
    sheet(&mut scene, ([0.0, -0.6], [1.2, 0.6]), (0.35, 0.99), gray);
    let stage = Stage::new(scene, Vec::new());
    let mut still = film(DVec3::ZERO, DVec3::new(0.01, 0.0, 0.0), &[]);
    let blocked = check(&stage.review(&still, 5), Limit::Blocked);
    assert!(!blocked.is_kept() && blocked.got > 0.4, "{}", blocked.got);
    still.foregrounds = vec![[0.0, 10.0]];
    assert!(check(&stage.review(&still, 5), Limit::Blocked).is_kept());
}

#[test]
fn a_foreground_that_fills_half_of_every_frame_is_marked_down() {
    let mark = |half_width: f64| {
        let mut scene = Gaussians::default();
        wall(&mut scene, (-8.0, 8.0), 6.0, gray);
        sheet(&mut scene, ([-0.1, -0.1], [0.1, 0.1]), (4.0, 0.99), gray);
        sheet(&mut scene, ([0.3, -2.0], [0.3 + half_width, 2.0]), (1.5, 0.99), gray);
        let ball = Object::from_box(3, "ball", DVec3::new(0.0, 0.0, 4.0), DVec3::splat(0.15));
        let still = film(DVec3::ZERO, DVec3::new(0.01, 0.0, 0.0), &[3]);
        Stage::new(scene, vec![ball]).review(&still, 5).value(Term::Wipe).unwrap()
    };
    assert!(mark(0.1) > 0.95, "a post at the side: {}", mark(0.1));
    assert!(mark(2.0) < 0.6, "a curtain over the right half: {}", mark(2.0));
}

#[test]
fn a_single_black_frame_is_found() {
    let mut scene = Gaussians::default();
    // A dark half and a gray one; the camera ends where it sees the dark one alone.
    wall(&mut scene, (-12.0, 0.0), 3.0, gray);
    wall(&mut scene, (0.1, 12.0), 3.0, |_, _| Vec3::ZERO);
    let stage = Stage::new(scene, Vec::new());
    let black = check(&stage.review(&film(DVec3::ZERO, DVec3::new(6.0, 0.0, 0.0), &[]), 3), Limit::Black);
    assert!(black.got > 0.3 && !black.is_kept(), "{}", black.got);
    let gray = check(&stage.review(&film(DVec3::ZERO, DVec3::new(-6.0, 0.0, 0.0), &[]), 3), Limit::Black);
    assert!(gray.is_kept());
}
