use cinesplat::evaluation::{MotionTag, TagSegment, Tagger, Trajectory, Turn};
use cinesplat::geometry::Pose;
use glam::{DMat3, DQuat, DVec3};
use strum::VariantArray;

use super::paths::{at_30_fps, through, track_of};

fn words(tagger: Tagger, path: &Trajectory) -> Vec<String> {
    tagger.segments(path).into_iter().map(|segment| segment.tag.to_string()).collect()
}

#[test]
fn gendops_example_has_the_tags_of_its_caption() {
    let Some(track) = track_of("data/gendop/case1_transforms_cleaning.json") else { return };
    let path = Trajectory::from(&track);
    // "The camera moves right while yawing left, then shifts right and forward, and finally remains static."
    assert_eq!(words(Tagger::Gendop, &path), ["right, yaw left", "right and forward", "static"]);
    assert_eq!(Tagger::Gendop.tags(&path).len(), 119);
}

#[test]
fn every_direction_has_its_word() {
    let moving = |direction: DVec3| through((0..80).map(move |k| direction * f64::from(k)), DQuat::IDENTITY);
    let cases = [
        (DVec3::X, "right"),
        (DVec3::NEG_X, "left"),
        (DVec3::NEG_Y, "up"),
        (DVec3::Y, "down"),
        (DVec3::Z, "forward"),
        (DVec3::NEG_Z, "back"),
        (DVec3::new(1.0, 0.0, 0.8), "right and forward"),
        // The slower axis is dropped below 0.6 of the faster one.
        (DVec3::new(1.0, 0.0, 0.5), "right"),
        (DVec3::ZERO, "static"),
    ];
    for (direction, word) in cases {
        for tagger in [Tagger::Et, Tagger::Gendop] {
            assert_eq!(words(tagger, &moving(direction * 0.01)), [word], "{tagger:?} {direction}");
        }
    }
}

#[test]
fn every_turn_has_its_word() {
    let turning = |axis: DVec3| {
        let poses: Vec<Pose> =
            (0..40).map(|k| Pose::new(DVec3::ONE, DQuat::from_scaled_axis(axis * 0.01 * f64::from(k)))).collect();
        at_30_fps(&poses)
    };
    // In OpenCV axes a rotation about x tilts the view up, about y (down) pans it right, about z dips the right side.
    let cases = [
        (DVec3::X, "pitch up"),
        (DVec3::NEG_X, "pitch down"),
        (DVec3::Y, "yaw right"),
        (DVec3::NEG_Y, "yaw left"),
        (DVec3::Z, "roll right"),
        (DVec3::NEG_Z, "roll left"),
    ];
    for (axis, word) in cases {
        assert_eq!(words(Tagger::Gendop, &turning(axis)), [word]);
        assert_eq!(words(Tagger::Et, &turning(axis)), ["static"]);
    }
}

#[test]
fn short_chunks_go_to_their_neighbors() {
    // 30 motions right, 9 up, 30 forward: the filter of 15 keeps the nine. They are split between the neighbors, with
    // the odd one in the first half.
    let steps = (0..69).map(|k| {
        if k < 30 {
            DVec3::X
        } else if k < 39 {
            DVec3::NEG_Y
        } else {
            DVec3::Z
        }
    });
    let mut at = DVec3::ZERO;
    let points: Vec<DVec3> = std::iter::once(at)
        .chain(steps.map(|step| {
            at += step;
            at
        }))
        .collect();
    let segments = Tagger::Gendop.segments(&through(points.into_iter(), DQuat::IDENTITY));
    let ends: Vec<(usize, usize)> = segments.iter().map(|segment| (segment.start, segment.end)).collect();
    assert_eq!(ends, [(0, 35), (35, 69)]);
    assert_eq!(segments[0].tag, MotionTag { right: 1, ..MotionTag::default() });
}

#[test]
fn at_most_four_segments_are_left() {
    let mut at = DVec3::ZERO;
    let directions = [DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::X, DVec3::Z];
    let steps = directions.into_iter().flat_map(|direction| vec![direction; 20]);
    let points: Vec<DVec3> = std::iter::once(at)
        .chain(steps.map(|step| {
            at += step;
            at
        }))
        .collect();
    assert!(Tagger::Gendop.segments(&through(points.into_iter(), DQuat::IDENTITY)).len() <= 4);
}

/// The filter used to grow with the path, and every growth to cost the square of it: hours for a path of this length.
#[test]
fn a_path_of_30_000_poses_is_tagged() {
    let mut random = Lcg(5);
    let mut at = DVec3::ZERO;
    let points: Vec<DVec3> = (0..30_000)
        .map(|_| {
            at += DVec3::new(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5) * 0.1;
            at
        })
        .collect();
    let segments = Tagger::Gendop.segments(&through(points.into_iter(), DQuat::IDENTITY));
    assert!((1..=4).contains(&segments.len()));
    assert_eq!((segments[0].start, segments[segments.len() - 1].end), (0, 29_999));
}

#[test]
fn nothing_to_tag_gives_no_segments() {
    assert!(Tagger::Gendop.segments(&Trajectory::default()).is_empty());
    assert!(Tagger::Et.segments(&through(std::iter::once(DVec3::ONE), DQuat::IDENTITY)).is_empty());
}

/// The random numbers of the script that made the golden tags: the upper bits of a linear congruential generator.
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random path of pieces with constant motion and a little noise, as in `tests/evaluation/golden/tags.py`.
fn random_path(seed: u64) -> Trajectory {
    let mut random = Lcg(seed);
    for _ in 0..8 {
        random.next();
    }
    let num_poses = 30 + (random.next() * 270.0) as usize;
    let (mut rotation, mut position, mut left) = (DMat3::IDENTITY, DVec3::ZERO, 0);
    let (mut moved, mut turned) = ([0.0; 3], [0.0; 3]);
    let mut path = Trajectory::default();
    for _ in 0..num_poses {
        path.positions.push(position);
        path.rotations.push(rotation);
        path.fov_y_rad.push(None);
        if left == 0 {
            left = 3 + (random.next() * 57.0) as usize;
            for (motion, share, scale) in [(&mut moved, 0.5, 0.4), (&mut turned, 0.4, 0.06)] {
                for axis in motion {
                    let is_on = random.next() < share;
                    let value = random.next();
                    *axis = if is_on { (value - 0.5) * scale } else { 0.0 };
                }
            }
        }
        left -= 1;
        let mut noisy = |motion: [f64; 3], scale: f64| motion.map(|axis| axis + (random.next() - 0.5) * scale);
        let step = DVec3::from_array(noisy(moved, 0.03)) / 25.0;
        let turn = DVec3::from_array(noisy(turned, 0.004));
        position += rotation * step;
        rotation *= DMat3::from_quat(DQuat::from_scaled_axis(turn));
    }
    path
}

/// A segment as the published systems number it.
fn numbered(tagger: Tagger, segment: &TagSegment) -> String {
    let TagSegment { start, end, tag } = segment;
    let digit = |sign: i8| match sign {
        1 => 1,
        -1 => 2,
        _ => 0,
    };
    let turn = Turn::VARIANTS.iter().position(|turn| *turn == tag.turn).unwrap();
    let class = match tagger {
        Tagger::Et => 9 * digit(tag.right) + 3 * digit(-tag.up) + digit(tag.forward),
        Tagger::Gendop => 7 * (9 * digit(tag.right) + 3 * digit(tag.up) + digit(-tag.forward)) + turn,
    };
    format!("{start}-{end}:{class}")
}

#[test]
fn the_tags_of_200_random_paths_are_those_of_the_published_systems() {
    let golden = include_str!("golden/tags.txt");
    let mut compared = 0;
    for line in golden.lines() {
        let (seed, rest) = line.split_once(' ').unwrap();
        let (name, wanted) = rest.split_once(' ').unwrap();
        let tagger = if name == "et" { Tagger::Et } else { Tagger::Gendop };
        let segments = tagger.segments(&random_path(seed.parse().unwrap()));
        let got: Vec<String> = segments.iter().map(|segment| numbered(tagger, segment)).collect();
        assert_eq!(got.join(" "), wanted, "{name} of path {seed}");
        compared += 1;
    }
    assert_eq!(compared, 400);
}
