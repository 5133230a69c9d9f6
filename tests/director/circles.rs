//! Turns all the way round.

use super::beats::program;

#[test]
fn a_turn_all_the_way_round_is_a_full_one() {
    for prompt in [
        "spin all the way round on the spot",
        "pan right around the whole room",
        "slowly turn all the way around, standing still",
    ] {
        let program = program(prompt);
        assert!(program.starts_with("pan-") && program.contains("360"), "{prompt}: {program}");
    }
}
