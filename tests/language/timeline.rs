//! Timelines: which bytes are beats, and how long they last.

use cinesplat::language::{BeatLength, link_mentions};
use proptest::prelude::*;

/// The introduction, and each beat with its length; `no timeline` for other prompts.
fn beats(prompt: &str) -> Vec<String> {
    let linked = link_mentions(prompt, &[]).unwrap_or_else(|error| panic!("{prompt}: {error}"));
    let Some(timeline) = linked.timeline else { return vec!["no timeline".to_owned()] };
    let introduction = &prompt[timeline.introduction[0]..timeline.introduction[1]];
    let beat = |beat: &cinesplat::language::Beat| {
        let text = &prompt[beat.bytes[0]..beat.bytes[1]];
        match beat.length {
            Some(BeatLength::Secs(secs)) => format!("{text} ({secs} s)"),
            Some(BeatLength::Share(share)) => format!("{text} ({share:.2})"),
            None => text.to_owned(),
        }
    };
    let introduction = (!introduction.is_empty()).then(|| format!("[{introduction}]"));
    introduction.into_iter().chain(timeline.beats.iter().map(beat)).collect()
}

#[test]
fn spans_of_time_begin_beats() {
    let expected = ["static, drawers (3 s)", "tilt up to the rack (4 s)", "push in on it (3 s)"];
    assert_eq!(beats("0:00-0:03 static, drawers\n0:03-0:07 tilt up to the rack\n0:07-0:10 push in on it"), expected);
    assert_eq!(beats("0-3s static, drawers; 3-7s tilt up to the rack; 7-10s push in on it"), expected);
    assert_eq!(beats("0 to 3 s: static, drawers / 3 to 7 s: tilt up to the rack / 7 to 10 s: push in on it"), expected);
    assert_eq!(beats("(0-3s) static, drawers (3-7s) tilt up to the rack (7-10s) push in on it"), expected);
    assert_eq!(
        beats("TIME | CAMERA\n0-2 s | wall, locked off\n2-6 s | pan right\n6-8 s | zoom in"),
        ["[TIME | CAMERA]", "wall, locked off (2 s)", "pan right (4 s)", "zoom in (2 s)"]
    );
}

#[test]
fn time_codes_last_until_the_next_and_the_last_may_end_the_film() {
    let expected = ["on the mug (3 s)", "pan right (3 s)", "land on the teapot (2 s)"];
    assert_eq!(beats("T+0 on the mug | T+3 pan right | T+6 land on the teapot | T+8 out"), expected);
    assert_eq!(beats("0:00 on the mug. 0:03 pan right. 0:06 land on the teapot. 0:08 end."), expected);
    assert_eq!(beats("0:00 wide. 0:04 push in."), ["wide (4 s)", "push in"]);
    let moment = ["wide of the mug (4 s)", "close on it (0 s)", "hold (2 s)"];
    assert_eq!(beats("t=0s wide of the mug. t=4s close on it. t=4 to t=6 hold. end."), moment);
    assert_eq!(beats("0:00 wide of the mug, 0:04 close on it, 0:04-0:06 hold"), moment);
}

#[test]
fn lengths_shares_and_numbers_begin_beats() {
    assert_eq!(
        beats("3s orbit the chair to the right, 3s push in on it, 2s hold = 8s"),
        ["orbit the chair to the right (3 s)", "push in on it (3 s)", "hold = 8s (2 s)"]
    );
    assert_eq!(
        beats("first third: creep in. middle third: freeze. last third: pull out. nine seconds"),
        ["creep in (0.33)", "freeze (0.33)", "pull out. nine seconds (0.33)"]
    );
    assert_eq!(
        beats("One take.\n1) vase, ECU, 2s\n2) pull out, 5s\n3) hold, 1s"),
        ["[One take]", "vase, ECU, 2s", "pull out, 5s", "hold, 1s"]
    );
    assert_eq!(beats("Shot 1: the sofa. Shot two: orbit the lamp."), ["the sofa", "orbit the lamp"]);
}

#[test]
fn other_prompts_with_numbers_are_no_timelines() {
    for prompt in [
        "push in over 3 seconds, then hold for 2 seconds",
        "10 seconds, push in on the vase",
        "zoom from 24 to 70 on object 1, ratio 16:9",
        "orbit 90 degrees, tilt 20 degrees",
        "the 2nd chair, 3 times",
        "8 seconds total. slow.",
    ] {
        assert_eq!(beats(prompt), ["no timeline"], "{prompt}");
    }
}

proptest! {
    #[test]
    fn beats_lie_in_the_prompt_in_order(text in "([0-9]{1,2}[:)-]|T\\+|first third: |shot [1-3]: |[a-z]{1,6}|[ ,.|/\n]|[0-9] ?s ){1,40}") {
        prop_assume!(text.chars().any(char::is_alphanumeric));
        if let Some(timeline) = link_mentions(&text, &[]).unwrap().timeline {
            let mut before = timeline.introduction[1];
            prop_assert!(timeline.beats.len() > 1);
            for beat in timeline.beats {
                prop_assert!(before <= beat.bytes[0] && beat.bytes[0] < beat.bytes[1] && beat.bytes[1] <= text.len());
                prop_assert!(text.get(beat.bytes[0]..beat.bytes[1]).is_some());
                if let Some(BeatLength::Secs(secs)) = beat.length {
                    // A moment lasts no time.
                    prop_assert!(secs >= 0.0 && secs.is_finite());
                }
                before = beat.bytes[1];
            }
        }
    }
}

#[test]
fn labels_with_a_time_begin_beats() {
    assert_eq!(
        beats("Shot 1, 0:00-0:04: static wide of the room. CUT at 0:04. Shot 2, 0:04-0:08: close-up of the mug"),
        ["static wide of the room (4 s)", "close-up of the mug (4 s)"]
    );
    assert_eq!(
        beats("Shot list. A, 3 s: medium of the mug. B, 5 s: dolly back. C, 2 s: hold that frame."),
        ["[Shot list]", "medium of the mug (3 s)", "dolly back (5 s)", "hold that frame (2 s)"]
    );
    assert_eq!(
        beats("Panel 1 (0-3 s): static. Panel 2 (3-9 s): the camera descends. Step 3 (9-11 s): hold"),
        ["static (3 s)", "the camera descends (6 s)", "hold (2 s)"]
    );
    assert_eq!(beats("push in on a, 3 s later pan to b"), ["no timeline"]);
}

#[test]
fn frame_numbers_are_times() {
    let expected = ["static, drawers (2 s)", "tilt up to the rack (3 s)"];
    assert_eq!(beats("f0-f48 static, drawers; f48-f120 tilt up to the rack"), expected);
    assert_eq!(beats("frames 0-48: static, drawers\nframes 48-120: tilt up to the rack"), expected);
    let at_25 = ["static, drawers (2 s)", "tilt up to the rack (2 s)"];
    assert_eq!(beats("25 fps. f0-f50 static, drawers; f50-f100 tilt up to the rack")[1..], at_25);
}
