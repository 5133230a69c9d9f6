//! Figures by evo's conventions against evo 1.38.1: repeated stamps, a pose matched twice, interpolation, a straight start,
//! fewer poses. `tests/evaluation/golden/conventions.py` writes the paths and prints the rows.

use std::path::Path;

use cinesplat::evaluation::{
    Convention, Delta, EvalSettings, Matching, Metric, MotionFilter, PairSettings, Reduction, Role, Trajectory,
    evaluate,
};
use cinesplat::export::read;

/// Reference, estimate, largest time difference, whether interpolated, alignment, number of aligned poses, relation,
/// largest number of poses, motion filter (distance, degrees), span of time; frames of a relative error, number of errors,
/// [rmse, median, max].
type Row = (
    &'static str,
    &'static str,
    f64,
    bool,
    &'static str,
    Option<usize>,
    &'static str,
    Option<usize>,
    Option<(f64, f64)>,
    Option<(f64, f64)>,
    (Option<usize>, usize, [f64; 3]),
);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("repeated_reference", "repeated_estimate", 0.01, false, "sim3", None, "trans", None, None, None, (None, 14, [0.036_198_368_912_294_61, 0.035_072_636_341_406_574, 0.056_419_527_212_988_37])),
    ("repeated_reference", "repeated_estimate", 0.01, false, "sim3", None, "angle_deg", None, None, None, (None, 14, [1.056_658_644_432_881_2, 0.945_712_768_154_995_4, 1.733_001_480_705_016_3])),
    ("repeated_reference", "repeated_estimate", 0.03, false, "sim3", None, "trans", None, None, None, (None, 41, [0.041_404_982_380_734_444, 0.038_484_000_930_108_18, 0.082_438_324_449_077_8])),
    ("repeated_reference", "repeated_estimate", 0.03, false, "sim3", None, "angle_deg", None, None, None, (None, 41, [1.158_117_024_285_629_6, 0.991_918_129_159_878_5, 2.278_842_681_425_912_6])),
    ("repeated_reference", "repeated_estimate", 0.5, false, "sim3", None, "trans", None, None, None, (None, 43, [0.067_750_866_815_394_62, 0.039_683_146_807_903_06, 0.345_710_399_832_969_9])),
    ("repeated_reference", "repeated_estimate", 0.5, false, "sim3", None, "angle_deg", None, None, None, (None, 43, [1.988_894_005_155_676_3, 1.094_199_459_504_295_6, 10.250_985_725_741_1])),
    ("repeated_reference", "repeated_estimate", 0.03, true, "none", None, "full", None, None, None, (None, 41, [3.633_321_522_874_835, 3.621_452_326_779_683_4, 3.871_170_853_292_875_7])),
    ("repeated_reference", "repeated_estimate", 0.01, true, "se3", None, "trans", None, None, None, (None, 14, [0.312_604_764_442_186_3, 0.337_576_768_445_877_36, 0.463_355_598_036_088_6])),
    ("repeated_reference", "repeated_estimate", 0.03, true, "sim3", None, "angle_deg", None, None, None, (None, 41, [1.049_172_671_692_869, 1.042_563_316_001_688, 1.794_399_414_055_458_9])),
    ("repeated_estimate", "repeated_reference", 0.03, true, "sim3", None, "trans", None, None, None, (None, 41, [0.029_765_684_920_091_833, 0.028_437_588_528_683_763, 0.052_862_926_762_281_05])),
    ("repeated_reference", "repeated_estimate", 0.5, false, "se3", None, "trans", Some(20), None, None, (None, 20, [0.328_026_390_637_108_6, 0.333_847_486_014_337_45, 0.484_722_476_353_199_6])),
    ("repeated_reference", "repeated_estimate", 0.1, false, "se3", None, "trans", None, Some((0.3, 15.0)), None, (None, 12, [0.239_114_900_227_759_7, 0.242_379_143_376_662_9, 0.378_356_717_567_251_26])),
    ("repeated_reference", "repeated_estimate", 0.1, false, "se3", None, "trans", Some(37), Some((0.2, 40.0)), None, (None, 16, [0.264_755_151_756_107_03, 0.228_315_513_284_153_56, 0.410_108_459_040_399])),
    ("repeated_reference", "repeated_estimate", 0.03, false, "none", None, "trans", None, None, None, (Some(3), 13, [0.137_374_245_233_606_28, 0.116_393_769_631_290_08, 0.214_503_053_955_917_65])),
    ("repeated_reference", "repeated_estimate", 0.03, false, "sim3", None, "full", None, None, Some((1.0, 5.5)), (None, 25, [0.051_092_031_640_147_32, 0.047_409_414_485_727_28, 0.087_945_566_221_666_22])),
    // The reference alone is trimmed, so that it is the shorter path.
    ("repeated_reference", "repeated_estimate", 0.1, false, "se3", None, "trans", None, None, Some((1.0, 2.5)), (None, 30, [0.072_690_852_453_818_79, 0.057_856_147_758_572_02, 0.144_008_473_448_863_94])),
    ("repeated_reference", "repeated_estimate", 0.1, false, "se3", None, "trans", Some(37), None, Some((1.0, 5.5)), (None, 17, [0.247_993_216_491_638_47, 0.204_866_161_476_762_1, 0.493_286_596_998_688_54])),
    ("straight_reference", "straight_estimate", 0.01, false, "se3", Some(20), "trans", None, None, None, (None, 60, [0.041_565_601_233_264_284, 0.000_319_506_222_609_783_47, 0.128_148_801_894_723_97])),
    ("straight_reference", "straight_estimate", 0.01, false, "se3", Some(20), "angle_deg", None, None, None, (None, 60, [2.914_531_695_552_925_2, 2.914_539_422_290_291_6, 2.914_576_579_970_799_7])),
    ("straight_reference", "straight_estimate", 0.01, false, "se3", None, "trans", None, None, None, (None, 60, [0.000_162_888_784_296_089_88, 0.000_150_849_419_283_918_83, 0.000_357_049_167_974_293_9])),
];

fn path(name: &str, reduction: &Reduction) -> Trajectory {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/evaluation/golden");
    let track = read(&folder.join(format!("{name}.tum")), None).unwrap().track;
    reduction.apply(&Trajectory::from(&track)).unwrap()
}

#[test]
fn the_conventions_of_evo_give_its_figures() {
    for row in ROWS {
        let (reference, estimate, max_diff_secs, interpolated, align, align_poses, relation, ..) = *row;
        let (.., max_poses, motion, span, (frames, count, wanted)) = *row;
        let reduction = Reduction {
            start_secs: span.map(|span| span.0),
            end_secs: span.map(|span| span.1),
            max_poses,
            motion: motion.map(|(distance, degrees)| MotionFilter { distance, angle_rad: degrees.to_radians() }),
        };
        let metric = frames.map_or(Metric::Ape, |frames| Metric::Rpe {
            pairs: PairSettings { delta: Delta::Frames(frames), ..PairSettings::default() },
            pairs_from_reference: false,
        });
        let settings = EvalSettings {
            metric,
            max_diff_secs,
            align: align.parse().unwrap(),
            align_poses,
            relation: relation.parse().unwrap(),
            matching: if interpolated { Matching::Interpolated } else { Matching::Nearest },
            convention: Convention::Evo,
            ..EvalSettings::default()
        };
        let [reference, estimate] = [(reference, Role::Reference), (estimate, Role::Estimate)]
            .map(|(name, role)| reduction.apply_as(&path(name, &Reduction::default()), role, Convention::Evo).unwrap());
        let found = evaluate(&reference, &estimate, &settings).unwrap();
        assert_eq!(found.errors.len(), count, "{row:?}");
        let got = [found.statistics.rmse, found.statistics.median, found.statistics.max];
        for (got, wanted) in got.into_iter().zip(wanted) {
            assert!((got / wanted - 1.0).abs() < 1e-9, "got {got}, evo {wanted}: {row:?}");
        }
    }
}

#[test]
fn a_note_says_where_the_own_convention_matches_otherwise() {
    let (whole, settings) = (Reduction::default(), EvalSettings { max_diff_secs: 0.5, ..EvalSettings::default() });
    let [reference, estimate] = ["repeated_reference", "repeated_estimate"].map(|name| path(name, &whole));
    let found = evaluate(&reference, &estimate, &settings).unwrap();
    assert!(found.notes.iter().any(|note| note.contains("convention of evo")), "{:?}", found.notes);
    let narrow = EvalSettings { max_diff_secs: 0.03, ..settings };
    // Poses that share one stamp share its match in both conventions.
    let found = evaluate(&reference, &estimate, &narrow).unwrap();
    assert_eq!((found.errors.len(), found.notes.len()), (41, 0), "{:?}", found.notes);
}

#[test]
fn a_span_of_time_trims_both_paths_and_by_the_convention_of_evo_the_reference_alone() {
    let span = Reduction { start_secs: Some(1.0), end_secs: Some(2.5), ..Reduction::default() };
    let estimate = path("repeated_estimate", &Reduction::default());
    let kept = |role, convention| span.apply_as(&estimate, role, convention).unwrap().len();
    assert_eq!(kept(Role::Estimate, Convention::Evo), estimate.len());
    assert!(kept(Role::Reference, Convention::Evo) < estimate.len());
    assert_eq!(kept(Role::Estimate, Convention::Cinesplat), kept(Role::Reference, Convention::Evo));
}

#[test]
fn poses_on_a_straight_start_do_not_choose_the_turn_about_it() {
    let [reference, estimate] =
        ["straight_reference", "straight_estimate"].map(|name| path(name, &Reduction::default()));
    let settings = EvalSettings { align: "se3".parse().unwrap(), align_poses: Some(20), ..EvalSettings::default() };
    let own = evaluate(&reference, &estimate, &settings).unwrap();
    let evo = evaluate(&reference, &estimate, &EvalSettings { convention: Convention::Evo, ..settings }).unwrap();
    assert!(10.0 * own.statistics.rmse < evo.statistics.rmse, "{} {}", own.statistics.rmse, evo.statistics.rmse);
}
