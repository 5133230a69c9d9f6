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
        "use a 35mm lens in 4k at 24 fps",
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
