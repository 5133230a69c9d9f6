use cinesplat::language::{NamedObject, QuantityKind, link};

/// The only quantity of a prompt; `skull` is object 1.
fn only(prompt: &str) -> (QuantityKind, f64) {
    let objects = [NamedObject { id: 1, label: "skull".to_owned() }];
    let found = link(prompt, &objects).unwrap();
    assert_eq!(found.quantities.len(), 1, "{prompt}: {found:?}");
    (found.quantities[0].kind, found.quantities[0].value)
}

fn assert_quantity(kind: QuantityKind, cases: &[(&str, f64)]) {
    for (prompt, value) in cases {
        let (found_kind, found) = only(prompt);
        assert_eq!(found_kind, kind, "{prompt}");
        assert!((found - value).abs() < 1e-9, "{prompt}: {found}, expected {value}");
    }
}

#[test]
fn times() {
    assert_quantity(
        QuantityKind::Seconds,
        &[
            ("over 8 seconds", 8.0),
            ("for two seconds", 2.0),
            ("hold a second, then go", 1.0),
            ("2.5s", 2.5),
            ("wait half a second", 0.5),
            ("in one and a half seconds", 1.5),
            ("five to seven secs", 6.0),
            ("cam 3 - 9 sec", 9.0),
            ("shot 4 - 6 sec: push in", 6.0),
            ("push in, 3 - 5 sec", 4.0),
            ("a 10-second shot", 10.0),
            ("a ten second take", 10.0),
            ("a couple of seconds", 2.0),
            ("for about 4 sec", 4.0),
            ("half a minute", 30.0),
            ("twenty-five seconds", 25.0),
        ],
    );
}

#[test]
fn angles() {
    assert_quantity(
        QuantityKind::Degrees,
        &[
            ("orbit by 45 degrees", 45.0),
            ("45\u{B0}", 45.0),
            ("a 90-degree arc", 90.0),
            ("a quarter turn", 90.0),
            ("a quarter of a circle", 90.0),
            ("half a circle", 180.0),
            ("a semicircle", 180.0),
            ("three quarters of a turn", 270.0),
            ("full circle", 360.0),
            ("a full orbit", 360.0),
            ("once around", 360.0),
            ("circle the skull once", 360.0),
            ("orbit the skull twice.", 720.0),
            ("halfway around the skull", 180.0),
            ("do a 360", 360.0),
            ("a hundred and eighty degrees", 180.0),
            ("two full turns", 720.0),
            ("1.5 turns", 540.0),
            ("orbit the skull to the other side", 180.0),
        ],
    );
}

#[test]
fn lengths_and_factors() {
    assert_quantity(
        QuantityKind::Units,
        &[
            ("two meters", 2.0),
            ("half a metre", 0.5),
            ("50cm", 0.5),
            ("3 feet", 0.9144),
            ("1.5 units", 1.5),
            ("10 inches", 0.254),
        ],
    );
    assert_quantity(
        QuantityKind::Factor,
        &[
            ("push in halfway", 0.5),
            ("get twice as close", 0.5),
            ("half the distance", 0.5),
            ("pull back to twice the distance", 2.0),
            ("three times as far away", 3.0),
            ("push in a third of the way", 2.0 / 3.0),
            ("push in until it is twice as big", 0.5),
            ("zoom in until it is twice as big", 2.0),
            ("zoom in 2x", 2.0),
            ("zoom in by a factor of 3", 3.0),
        ],
    );
}

#[test]
fn words_that_only_look_like_a_quantity_stay_words() {
    for prompt in [
        "a second orbit of the skull",
        "then once there, stop",
        "the film is in 4k at 24 fps",
        "minus six seconds",
        "move in an S between the walls",
        "pan at six degrees a second",
        "fly at 2 m/s",
        "30 cm per second",
        "at 5 km/h",
        "30% slower",
        "30% off teapots this weekend",
        "200% of the screen",
        "the 3 chairs",
        "bottle 2",
        "scene 12, shot 3, take 2, step 1",
        "1. orbit 2) stop",
        "in 16:9 or 9:16",
        "1080p at f/2.8, iso 800",
        "fill the frame",
        "it fills the frame",
        "a 16-35",
        "a 16-35mm zoom",
        "0:00",
        "the fifth of them",
        "the last one",
        "the half-open door of the room",
        "an orbit of the skull",
        "a turn to the left",
        "around the skull",
        "once we see the skull, tilt up",
        "0 degrees",
        "a close up",
    ] {
        let objects = [NamedObject { id: 1, label: "skull".to_owned() }];
        let found = link(prompt, &objects).map(|linked| linked.quantities).unwrap_or_default();
        assert!(found.is_empty(), "{prompt}: {found:?}");
    }
}

/// The quantities of a prompt, in order.
fn all(prompt: &str) -> Vec<(QuantityKind, f64)> {
    let objects = [NamedObject { id: 1, label: "skull".to_owned() }];
    let round = |value: f64| (value * 1e6).round() / 1e6;
    link(prompt, &objects).unwrap().quantities.iter().map(|found| (found.kind, round(found.value))).collect()
}

#[test]
fn times_as_people_type_them() {
    assert_quantity(
        QuantityKind::Seconds,
        &[
            ("8s", 8.0),
            ("8 sec", 8.0),
            ("an 8-sec shot", 8.0),
            ("a couple of secs", 2.0),
            ("sec and a half", 1.5),
            ("a second and a half", 1.5),
            ("two and a half seconds", 2.5),
            ("5-6 s", 5.5),
            ("1m30", 90.0),
            ("1 min 30", 90.0),
            ("1:30 min", 90.0),
            ("quarter of a minute", 15.0),
            ("three slow seconds", 3.0),
            ("10ish seconds", 10.0),
            ("wait...5 seconds", 5.0),
            ("2,5 s", 2.5),
            ("hold 3", 3.0),
            ("hold on it for 3, then stop", 3.0),
            ("count three", 3.0),
            ("12 total", 12.0),
            ("be there at second 6", 6.0),
            ("at 0:05 be there", 5.0),
            ("at 00:04", 4.0),
            ("in the last second", 1.0),
            ("sixteen counts", 16.0),
        ],
    );
}

#[test]
fn a_span_of_time_is_one_duration() {
    assert_quantity(
        QuantityKind::Seconds,
        &[
            ("0:00-0:03 static", 3.0),
            ("0:02 - 0:05 static", 3.0),
            ("00:00-00:04: static", 4.0),
            ("0:00\u{2013}0:03 static", 3.0),
            ("0:02 to 0:05 static", 3.0),
            ("between 0:03 and 0:05 hold", 2.0),
            ("00:00:04 to 00:00:09 hold", 5.0),
            ("0-3s hold", 3.0),
            ("0 to 3 sec hold", 3.0),
            ("3s-7s hold", 4.0),
            ("from 2 to 5 seconds hold", 3.0),
            ("hold (2-5s)", 3.0),
            ("t=0..4 hold", 4.0),
            ("0-3: hold", 3.0),
        ],
    );
    let secs = |values: &[f64]| values.iter().map(|value| (QuantityKind::Seconds, *value)).collect::<Vec<_>>();
    assert_eq!(all("0-3s pan, 3-6 stay there, 6-10 boom up"), secs(&[3.0, 3.0, 4.0]));
    assert_eq!(all("From 0 to 3 s still, 3 to 10 drifting up"), secs(&[3.0, 7.0]));
    assert_eq!(all("At 0:00 wide, by 0:05 closer, by 0:09 close"), secs(&[5.0, 4.0]));
    assert_eq!(all("push in for 3, hold for 2"), secs(&[3.0, 2.0]));
    assert_eq!(all("16 seconds: 6 in to the skull, 4 holding"), secs(&[16.0, 6.0, 4.0]));
}

#[test]
fn angles_as_people_type_them() {
    assert_quantity(
        QuantityKind::Degrees,
        &[
            ("90\u{B0}", 90.0),
            ("90 deg", 90.0),
            ("half circle", 180.0),
            ("three-quarters of the way round", 270.0),
            ("go round the skull three quarters of the way, rising", 270.0),
            ("turn 180", 180.0),
            ("a 180", 180.0),
            ("full 360", 360.0),
            ("one and a half times around", 540.0),
            ("1 1/2 turns", 540.0),
            ("a turn and a half", 540.0),
            ("twice round", 720.0),
            ("1/3 of the way around", 120.0),
            ("2 laps", 720.0),
            ("a couple of orbits", 720.0),
            ("circle the skull three times", 1080.0),
            ("orbit the skull 2x", 720.0),
            ("spin one time", 360.0),
            ("a lap of the skull", 360.0),
            ("tilt up 10", 10.0),
            ("go round sixty the other way", 60.0),
            ("gimbal -30", 30.0),
            ("circle it one third", 120.0),
            ("come round it by a right angle", 90.0),
            ("turn around and stop", 180.0),
            ("a u-turn", 180.0),
            ("fov 60", 60.0),
            ("60 degree fov", 60.0),
            ("a field of view of 60", 60.0),
        ],
    );
}

#[test]
fn lengths_as_people_type_them() {
    assert_quantity(
        QuantityKind::Units,
        &[
            ("1.5m", 1.5),
            ("1,5 m", 1.5),
            ("half a metre", 0.5),
            ("a metre and a half", 1.5),
            ("2 ft", 0.6096),
            ("up 6'", 1.8288),
            ("at 6'2\"", 1.8796),
            ("18 inches", 0.4572),
            ("in 18\"", 0.4572),
            ("one metre eighty", 1.8),
            ("at 1m80", 1.8),
            ("30mm closer", 0.03),
            ("truck 1200 mm", 1.2),
            ("camera height 1.6", 1.6),
            ("eye height, about 1.65", 1.65),
            ("a hand's breadth", 0.1),
        ],
    );
    let units = |values: &[f64]| values.iter().map(|value| (QuantityKind::Units, *value)).collect::<Vec<_>>();
    assert_eq!(all("rise from 1 to 4 m"), units(&[1.0, 4.0]));
    assert_eq!(all("start at 10 m, then from 5, then from 1"), units(&[10.0, 5.0, 1.0]));
}

#[test]
fn factors_as_people_type_them() {
    assert_quantity(
        QuantityKind::Factor,
        &[
            ("x2", 2.0),
            ("2 x closer", 0.5),
            ("double the distance", 2.0),
            ("three times further", 3.0),
            ("50% closer", 0.5),
            ("25 percent further away", 1.25),
            ("zoom 3x", 3.0),
            ("zoom in 30%", 1.3),
            ("closer by half", 0.5),
            ("a third of the distance", 1.0 / 3.0),
        ],
    );
}

#[test]
fn shares_of_the_frame() {
    assert_quantity(
        QuantityKind::Percent,
        &[
            ("40%", 40.0),
            ("40 percent", 40.0),
            ("40 per cent of the frame", 40.0),
            ("half the frame", 50.0),
            ("half of the screen", 50.0),
            ("a third of the picture", 100.0 / 3.0),
            ("two thirds of the frame height", 200.0 / 3.0),
            ("a quarter of the height", 25.0),
            ("filling half the width", 50.0),
            ("3/4 of the image height", 75.0),
            ("small in the picture, like a tenth", 10.0),
            ("the full frame height", 100.0),
        ],
    );
    let shares = [(QuantityKind::Percent, 20.0), (QuantityKind::Percent, 50.0)];
    assert_eq!(all("grow from a fifth to half of the frame"), shares);
}

#[test]
fn focal_lengths() {
    assert_quantity(
        QuantityKind::Millimeters,
        &[
            ("35mm", 35.0),
            ("35 mm", 35.0),
            ("use a 50", 50.0),
            ("a 50mm lens", 50.0),
            ("on the 85", 85.0),
            ("24 mil", 24.0),
            ("35 mm equiv", 35.0),
            ("the nifty fifty", 50.0),
            ("steep, on a 24", 24.0),
            ("lens 27", 27.0),
        ],
    );
    let ends = [(QuantityKind::Millimeters, 35.0), (QuantityKind::Millimeters, 70.0)];
    assert_eq!(all("zoom from 35 to 70"), ends);
}

/// "for 5e9 seconds" used to be read as 9 seconds.
#[test]
fn a_number_with_an_exponent_is_unread_and_a_warning() {
    let objects = [NamedObject { id: 1, label: "skull".to_owned() }];
    let found = link("orbit the skull for 5e9 seconds", &objects).unwrap();
    assert!(found.quantities.is_empty(), "{found:?}");
    assert_eq!(found.warnings.len(), 1, "{:?}", found.warnings);
}
