//! Several films of one program.

use std::iter::zip;

use cinesplat::operator::{Framing, Program, Solution, SolveLevel, SolveSettings, Step, finalists, realize};
use cinesplat::trajectory::Move;

use super::{film, world};

fn program(movement: Move) -> Program {
    let step = Step { start: Framing { subjects: vec![1], ..Framing::default() }, ..Step::of(movement) };
    Program { steps: vec![step], ..Program::default() }
}

const FAST: SolveSettings = SolveSettings { level: SolveLevel::Fast, seed: 3, tries_factor: 1.0, slant: None };

/// Largest distance and largest angle between the views of two films, over their course.
fn apart(a: &Solution, b: &Solution) -> (f64, f64) {
    let (a, b) = (film(a), film(b));
    let shares = (0..=20).map(|i| f64::from(i) / 20.0);
    let of = |share: f64| {
        let at = |film: &[_]| (share * (film.len() - 1) as f64).round() as usize;
        let (a, b) = (a[at(&a)].pose, b[at(&b)].pose);
        (a.position.distance(b.position), a.forward().angle_between(b.forward()).to_degrees())
    };
    shares.map(of).fold((0.0, 0.0), |most, now| (f64::max(most.0, now.0), f64::max(most.1, now.1)))
}

#[test]
fn finalists_clearly_differ_and_the_first_is_the_film_of_the_search() {
    let world = world();
    for movement in [Move::PushIn, Move::OrbitLeft, Move::Static] {
        let program = program(movement);
        let films = finalists(&world, (&program, ""), &[], &FAST, 4);
        assert!((2..=4).contains(&films.len()), "{movement}: {} films", films.len());
        assert_eq!(films[0], realize(&world, &program, "", &[], &FAST), "{movement}");
        assert!(films[1..].is_sorted_by(|a, b| a.cost <= b.cost), "{movement}");
        for (i, film) in films.iter().enumerate() {
            assert!(film.report.iter().all(|line| line.met), "{movement}: {:?}", film.report);
            for other in &films[..i] {
                let (distance, angle) = apart(film, other);
                assert!(distance > 0.07 * world.bounds.size() || angle > 22.0, "{movement}: {distance}, {angle}");
            }
        }
    }
}

#[test]
fn finalists_are_the_same_on_any_number_of_threads() {
    let world = world();
    let program =
        Program { steps: vec![program(Move::PushIn).steps[0].clone(), Step::of(Move::PanLeft)], ..Program::default() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| finalists(&world, (&program, ""), &[], &FAST, 3))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn without_a_search_there_is_one_film() {
    let settings = SolveSettings { level: SolveLevel::Off, ..FAST };
    assert_eq!(finalists(&world(), (&program(Move::Static), ""), &[], &settings, 5).len(), 1);
}

#[test]
fn a_film_about_a_subject_says_when_it_should_be_seen() {
    let solution = realize(&world(), &program(Move::OrbitLeft), "", &[], &FAST);
    let [sighting] = solution.sightings[..] else { panic!("{:?}", solution.sightings) };
    assert_eq!(sighting.object, 1);
    for (found, expected) in zip([sighting.from_secs, sighting.to_secs], [0.0, solution.duration_secs]) {
        assert!((found - expected).abs() < 1e-9, "{found}, expected {expected}");
    }
}
