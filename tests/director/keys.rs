//! Programs to keys and back.

use cinesplat::director::keys::{MAX_KEYS, Next, boundaries_of, keys_of, steps_of};
use cinesplat::language::program_from_notation;
use cinesplat::operator::{Framing, Program, Step};
use cinesplat::training::PromptSampler;
use cinesplat::trajectory::Move;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// A framing of one subject.
fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

#[test]
fn n_steps_make_n_plus_one_keys_and_a_cut_adds_one() {
    let step = |cut| Step { cut, ..Step::of(Move::PushIn) };
    let program = Program { steps: vec![step(false), step(false), step(true)], ..Program::default() };
    let keys = keys_of(&program);
    assert_eq!(keys.len(), 5);
    assert_eq!(keys[2].next, Next::Cut);
    assert_eq!(keys[4].next, Next::Stop);
    assert_eq!(boundaries_of(&keys), vec![[0, 1], [1, 2], [3, 4]]);
}

#[test]
fn framings_of_neighboring_steps_stay_separate() {
    let first = Step { start: about(1), end: about(2), ..Step::of(Move::PanRight) };
    let second = Step { start: about(3), end: about(4), cut: true, ..Step::of(Move::PushIn) };
    let third = Step { start: about(5), ..Step::of(Move::ZoomIn) };
    let steps = vec![first, second, third];
    assert_eq!(steps_of(&keys_of(&Program { steps: steps.clone(), ..Program::default() })), steps);
}

#[test]
fn sampled_programs_survive_their_keys() {
    let sampler = PromptSampler::embedded().unwrap();
    let mut rng = Pcg64::seed_from_u64(3);
    for _ in 0..500 {
        let objects = sampler.invent_objects(6, &mut rng);
        let labeled = sampler.sample(&objects, &mut rng);
        let keys = keys_of(&labeled.program);
        assert!(keys.len() <= MAX_KEYS, "{}: {} keys", labeled.prompt, keys.len());
        assert_eq!(steps_of(&keys), labeled.program.steps, "{}", labeled.prompt);
    }
}

#[test]
fn a_cut_and_a_return_survive_their_keys() {
    let program =
        program_from_notation("push-in end=1:close-up slow / pan-left start=2 end=3 cut / orbit-right end=3 returns");
    let program = program.unwrap();
    assert_eq!(steps_of(&keys_of(&program)), program.steps);
}

#[test]
fn keys_that_no_program_makes_give_steps_too() {
    let program = Program { steps: vec![Step::of(Move::PushIn)], ..Program::default() };
    let keys = keys_of(&program);
    // A segment without a key after it, a cut without a step before it, keys behind a stop.
    assert_eq!(steps_of(&keys[..1]), program.steps);
    let cut_first =
        [vec![cinesplat::director::keys::Key { next: Next::Cut, ..Default::default() }], keys.clone()].concat();
    assert_eq!(steps_of(&cut_first), program.steps);
    assert_eq!(steps_of(&[keys.clone(), keys].concat()), program.steps);
    assert!(steps_of(&[]).is_empty());
}
