//! The choice among films.

use cinesplat::critic::{Candidate, Film, Review, TERMS, Term, Weights, ranked, report_lines, trade};
use cinesplat::objects::Object;
use cinesplat::scene::Gaussians;
use glam::{DVec3, Vec3};
use rayon::ThreadPoolBuilder;
use strum::VariantArray;

use super::{SIZE_PX, Stage, film, sheet, wall};

/// A subject with a checkered wall behind it, and a post that hides it from the right.
fn stage() -> Stage {
    let checks = |column: i64, row: i64| Vec3::splat(if (column / 6 + row / 6) % 2 == 0 { 0.3 } else { 0.7 });
    let mut scene = Gaussians::default();
    wall(&mut scene, (-8.0, 8.0), 6.0, checks);
    sheet(&mut scene, ([-0.4, -0.4], [0.4, 0.4]), (4.0, 0.99), checks);
    sheet(&mut scene, ([0.4, -1.0], [1.0, 1.0]), (2.0, 0.99), checks);
    Stage::new(scene, vec![Object::from_box(3, "panel", DVec3::new(0.0, 0.0, 4.0), DVec3::new(0.4, 0.4, 0.1))])
}

fn clear_film() -> Film {
    film(DVec3::new(-1.5, 0.0, 0.0), DVec3::new(-1.0, 0.0, 0.0), &[3])
}

fn hidden_film() -> Film {
    film(DVec3::new(1.2, 0.0, 0.0), DVec3::new(1.7, 0.0, 0.0), &[3])
}

fn candidate(num_unmet: usize, film: &Film) -> Candidate {
    Candidate { num_unmet, review: stage().review(film, 8) }
}

#[test]
fn the_clear_film_wins_over_the_hidden_one_wherever_it_stands() {
    let (clear, hidden) = (candidate(0, &clear_film()), candidate(0, &hidden_film()));
    let weights = Weights::default();
    assert_eq!(ranked(&[hidden.clone(), clear.clone()], &weights), [1, 0]);
    assert_eq!(ranked(&[clear.clone(), hidden.clone()], &weights), [0, 1]);
    assert!(clear.review.score(&weights) > hidden.review.score(&weights));
    assert!(clear.review.value(Term::Visible) > hidden.review.value(Term::Visible));
}

#[test]
fn a_film_that_violates_a_requirement_never_wins_on_taste() {
    let (clear, hidden) = (candidate(1, &clear_film()), candidate(0, &hidden_film()));
    assert_eq!(ranked(&[clear.clone(), hidden.clone()], &Weights::default()), [1, 0]);
    let words = trade(&hidden, &clear, &Weights::default());
    assert_eq!(words, "It leaves 0 requirements unmet, the runner-up 1; requirements rank above pictures.");
}

#[test]
fn films_that_are_alike_stay_in_their_order() {
    let same = candidate(0, &clear_film());
    assert_eq!(ranked(&[same.clone(), same.clone(), same], &Weights::default()), [0, 1, 2]);
}

#[test]
fn the_trade_names_what_was_won_and_what_was_given_up() {
    let better = |term: Term, value: f64, review: &Review| {
        let mut review = review.clone();
        review.marks.iter_mut().filter(|mark| mark.term == term).for_each(|mark| mark.value = Some(value));
        review
    };
    let base = candidate(0, &clear_film()).review;
    let sharp = Candidate { num_unmet: 0, review: better(Term::Sharp, 1.0, &better(Term::Depth, 0.1, &base)) };
    let deep = Candidate { num_unmet: 0, review: better(Term::Sharp, 0.2, &better(Term::Depth, 0.9, &base)) };
    let words = trade(&sharp, &deep, &Weights::default());
    assert!(
        words.starts_with("It is sharper (+") && words.contains("In return the runner-up has more depth (+"),
        "{words}"
    );
}

#[test]
fn a_review_is_the_same_on_any_number_of_threads() {
    let stage = stage();
    let with = |num_threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(num_threads).build().unwrap();
        pool.install(|| stage.review(&hidden_film(), 12))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn the_table_has_one_row_per_term_and_a_term_can_be_switched_off() {
    assert_eq!(TERMS.map(|row| row.term), Term::VARIANTS);
    for row in &TERMS {
        assert!(row.weight > 0.0 && !row.punishes.is_empty() && !row.source.is_empty());
        assert_eq!(Weights::default().of(row.term), row.weight);
        assert_eq!(Weights::default().without(row.term).of(row.term), 0.0);
    }
    let review = candidate(0, &clear_film()).review;
    let sum = |skipped: Option<Term>| {
        let marks = review.marks.iter().filter(|mark| Some(mark.term) != skipped);
        let rated = marks.filter_map(|mark| Some((mark.term.row().weight, mark.value?)));
        let (total, weighted) = rated.fold((0.0, 0.0), |(a, b), (weight, value)| (a + weight, b + weight * value));
        weighted / total
    };
    assert!((review.score(&Weights::default()) - sum(None)).abs() < 1e-12);
    assert!((review.score(&Weights::default().without(Term::Sharp)) - sum(Some(Term::Sharp))).abs() < 1e-12);
}

#[test]
fn soft_pictures_are_reported_and_met() {
    // The panel's splats of 0.08 at depth 4 have 15 px of 720; a picture holds 8.
    let review = candidate(0, &clear_film()).review;
    let lines = report_lines(&review, SIZE_PX, 2);
    let sharpness = lines.iter().find(|line| line.clause == "picture: sharpness").unwrap();
    assert!(sharpness.met && (14.0..17.0).contains(&sharpness.got), "{}", sharpness.got);
    assert_eq!(sharpness.note, "holds to an extreme long: splats of 15 px");
    assert!(lines.iter().any(|line| line.clause == "picture: taste" && line.note.contains("from 2 films")));
}

#[test]
fn a_closer_look_adds_to_a_glance_what_a_look_from_the_start_sees() {
    let stage = stage();
    let (glance, closer) = stage.judged(13, |critic| {
        let glance = critic.glance(&hidden_film()).unwrap();
        let closer = critic.review(&hidden_film(), Some(&glance)).unwrap();
        (glance, closer)
    });
    assert_eq!((glance.pictures.len(), closer.pictures.len()), (5, 13));
    assert_eq!(closer, stage.review(&hidden_film(), 13));
}
