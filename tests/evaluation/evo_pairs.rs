//! Pairs of relative errors against evo 1.38.1: the results of `evo.core.metrics.RPE` for
//! `freiburg1_xyz-rgbdslam_drift.txt` against the ground truth after a Sim3 alignment, for every unit of delta.

use cinesplat::evaluation::{Align, Delta, DeltaUnit, EvalSettings, EvaluationError, Metric, PairSettings, evaluate};
use glam::{DQuat, DVec3};

use super::paths::{recorded, through};

/// Unit, delta, all pairs, pairs from the reference, relation, number of pairs, [rmse, median, max].
type Row = (&'static str, f64, bool, bool, &'static str, usize, [f64; 3]);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("f", 10.0, false, false, "full", 78, [0.022_673_129_318_980_287, 0.019_882_466_866_703_516, 0.051_509_463_665_103_98]),
    ("f", 10.0, false, false, "trans", 78, [0.014_635_787_716_899_128, 0.011_636_932_963_190_277, 0.043_802_142_576_728_75]),
    ("f", 10.0, false, false, "angle_deg", 78, [0.701_577_033_065_784_5, 0.596_742_069_084_909_6, 1.593_892_104_902_574_5]),
    ("f", 10.0, false, false, "point_distance", 78, [0.010_634_885_184_628_164, 0.006_729_885_304_616_476, 0.035_387_190_368_631_05]),
    ("f", 10.0, false, false, "point_distance_ratio", 78, [15.732_907_553_340_802, 7.846_501_355_470_874, 62.759_228_386_409_28]),
    ("f", 10.0, false, true, "trans", 78, [0.014_635_787_716_899_128, 0.011_636_932_963_190_277, 0.043_802_142_576_728_75]),
    ("f", 10.0, true, false, "full", 775, [0.021_816_578_999_304_3, 0.017_817_537_952_762_075, 0.052_528_500_444_797_22]),
    ("f", 10.0, true, false, "trans", 775, [0.014_091_457_895_609_727, 0.010_872_576_817_827_806, 0.048_297_669_791_830_505]),
    ("f", 10.0, true, false, "angle_deg", 775, [0.674_778_947_755_531, 0.536_097_619_303_937_2, 1.722_245_668_859_448_7]),
    ("f", 10.0, true, false, "point_distance", 775, [0.009_840_166_515_400_482, 0.005_994_560_636_756_047, 0.042_094_285_817_647_72]),
    ("f", 10.0, true, false, "point_distance_ratio", 775, [20.977_954_448_036_62, 6.966_806_671_633_19, 235.233_480_570_635_2]),
    ("f", 10.0, true, true, "trans", 775, [0.014_091_457_895_609_727, 0.010_872_576_817_827_806, 0.048_297_669_791_830_505]),
    ("m", 0.1, false, false, "full", 80, [0.021_906_982_318_657_297, 0.019_207_251_594_747_42, 0.040_129_471_312_787_865]),
    ("m", 0.1, false, false, "trans", 80, [0.013_567_855_159_809_168, 0.010_416_735_187_094_798, 0.038_916_766_836_008_8]),
    ("m", 0.1, false, false, "angle_deg", 80, [0.696_840_868_361_221_4, 0.555_780_521_626_889_2, 1.431_179_478_831_110_5]),
    ("m", 0.1, false, false, "point_distance", 80, [0.009_598_758_806_831_17, 0.005_399_449_147_330_163, 0.028_495_222_226_290_64]),
    ("m", 0.1, false, false, "point_distance_ratio", 80, [17.313_160_073_454_38, 6.282_925_686_575_285, 112.270_040_691_737_96]),
    ("m", 0.1, false, true, "trans", 75, [0.013_936_785_041_295_318, 0.011_207_541_813_504_153, 0.041_802_497_453_832_68]),
    ("m", 0.1, true, false, "full", 726, [0.020_912_145_709_069_713, 0.016_917_522_511_602_473, 0.054_969_440_577_185_19]),
    ("m", 0.1, true, false, "trans", 726, [0.013_220_062_898_158_238, 0.010_515_529_330_120_427, 0.044_835_826_473_519_34]),
    ("m", 0.1, true, false, "angle_deg", 726, [0.656_473_140_431_019_3, 0.528_290_767_449_573_2, 1.876_827_203_379_148_2]),
    ("m", 0.1, true, false, "point_distance", 726, [0.009_458_869_019_345_098, 0.005_857_114_507_824_161, 0.038_977_104_896_812_61]),
    ("m", 0.1, true, false, "point_distance_ratio", 726, [19.432_397_307_978_65, 7.564_667_842_816_132, 162.813_511_557_139_6]),
    ("m", 0.1, true, true, "trans", 726, [0.013_792_256_857_554_294, 0.010_771_862_190_489_813, 0.054_272_308_440_116_98]),
    ("d", 5.0, false, false, "full", 85, [0.023_053_500_330_374_326, 0.018_821_717_314_196_806, 0.045_491_836_157_142_05]),
    ("d", 5.0, false, false, "trans", 85, [0.014_840_775_572_947_886, 0.011_323_795_637_894_572, 0.030_302_550_774_938_136]),
    ("d", 5.0, false, false, "angle_deg", 85, [0.714_733_253_424_814_3, 0.548_612_097_035_771_5, 1.412_133_281_723_282]),
    ("d", 5.0, false, false, "point_distance", 85, [0.011_115_455_824_695_723, 0.007_102_015_598_033_834, 0.025_194_247_550_448_62]),
    ("d", 5.0, false, false, "point_distance_ratio", 85, [17.641_674_225_245_43, 9.386_114_240_343_261, 87.321_314_306_658_17]),
    ("d", 5.0, false, true, "trans", 84, [0.014_189_499_230_850_574, 0.011_249_708_025_873_138, 0.037_480_483_466_958_96]),
    ("d", 5.0, true, false, "full", 25194, [0.025_711_447_020_734_96, 0.021_185_727_114_034_72, 0.079_721_553_953_454_5]),
    ("d", 5.0, true, false, "trans", 25194, [0.016_166_882_385_044_78, 0.013_443_197_335_678_472, 0.049_061_622_691_161_26]),
    ("d", 5.0, true, false, "angle_deg", 25194, [0.810_006_159_828_107_9, 0.636_825_641_513_258, 2.678_217_868_856_162_6]),
    ("d", 5.0, true, false, "point_distance", 25194, [0.011_200_924_364_983_681, 0.006_971_123_683_880_212, 0.044_608_103_091_329_09]),
    ("d", 5.0, true, false, "point_distance_ratio", 25194, [12.670_687_969_731_706, 4.605_196_570_497_988, 359.760_494_017_860_5]),
    ("d", 5.0, true, true, "trans", 27494, [0.016_864_328_622_479_746, 0.013_846_622_901_086_153, 0.055_555_094_188_659_684]),
    ("r", 0.1, false, false, "full", 74, [0.021_511_087_232_211_512, 0.019_087_990_783_027_79, 0.040_143_319_071_315_915]),
    ("r", 0.1, false, false, "trans", 74, [0.014_023_958_764_145_953, 0.011_668_301_111_770_672, 0.037_480_483_466_958_96]),
    ("r", 0.1, false, false, "angle_deg", 74, [0.660_842_727_973_532_2, 0.555_423_385_762_647_8, 1.359_056_123_968_888]),
    ("r", 0.1, false, false, "point_distance", 74, [0.009_909_587_340_510_843, 0.006_420_989_535_322_281_5, 0.030_283_780_038_878_355]),
    ("r", 0.1, false, false, "point_distance_ratio", 74, [30.305_228_130_853_09, 6.954_177_746_722_717, 231.146_956_361_275_3]),
    ("r", 0.1, false, true, "trans", 75, [0.015_285_945_549_275_53, 0.010_752_383_307_471_738, 0.033_554_419_972_818_154]),
    ("r", 0.1, true, false, "full", 30472, [0.026_782_127_347_374_424, 0.022_119_368_082_446_49, 0.086_699_391_952_868_17]),
    ("r", 0.1, true, false, "trans", 30472, [0.016_919_256_933_415_54, 0.014_069_221_592_715_276, 0.051_042_849_355_827_37]),
    ("r", 0.1, true, false, "angle_deg", 30472, [0.841_134_041_398_668_9, 0.670_285_590_058_677_6, 2.850_425_667_306_879]),
    ("r", 0.1, true, false, "point_distance", 30472, [0.011_673_645_132_712_473, 0.007_284_483_542_680_312, 0.044_608_103_091_329_09]),
    ("r", 0.1, true, false, "point_distance_ratio", 30472, [11.388_252_978_100_548, 4.518_309_376_188_194, 406.890_855_542_951_6]),
    ("r", 0.1, true, true, "trans", 32178, [0.017_446_581_453_921_865, 0.014_573_248_755_947_309, 0.057_535_471_065_666_41]),
];

#[test]
fn pairs_and_errors_of_every_unit() {
    let Some(reference) = recorded("freiburg1_xyz-groundtruth.txt") else { return };
    let estimate = recorded("freiburg1_xyz-rgbdslam_drift.txt").unwrap();
    for (unit, delta, all_pairs, pairs_from_reference, relation, count, wanted) in ROWS.iter().copied() {
        let delta = Delta::new(delta, unit.parse().unwrap()).unwrap();
        let pairs = PairSettings { delta, all_pairs, ..PairSettings::default() };
        let settings = EvalSettings {
            metric: Metric::Rpe { pairs, pairs_from_reference },
            relation: relation.parse().unwrap(),
            align: Align::Sim3,
            ..EvalSettings::default()
        };
        let result = evaluate(&reference, &estimate, &settings).unwrap();
        let case = format!("{delta:?} all {all_pairs} reference {pairs_from_reference} {relation}");
        assert_eq!(result.errors.len(), count, "{case}");
        let got = [result.statistics.rmse, result.statistics.median, result.statistics.max];
        for (got, wanted) in got.into_iter().zip(wanted) {
            assert!((got / wanted - 1.0).abs() < 1e-9, "{case}: got {got}, evo {wanted}");
        }
    }
}

#[test]
fn a_path_too_short_for_the_delta_says_how_long_it_is() {
    let reference = through((0..5).map(|k| DVec3::X * f64::from(k)), DQuat::IDENTITY);
    let pairs = PairSettings { delta: Delta::new(100.0, DeltaUnit::Distance).unwrap(), ..PairSettings::default() };
    let settings =
        EvalSettings { metric: Metric::Rpe { pairs, pairs_from_reference: false }, ..EvalSettings::default() };
    let error = evaluate(&reference, &reference, &settings).unwrap_err();
    assert!(
        matches!(error, EvaluationError::NoPairs { delta: 100.0, unit: "scene units", num_poses: 5, available: 4.0 }),
        "{error}"
    );
}

#[test]
fn deltas_out_of_range_are_refused() {
    let refused = |value: f64, unit: DeltaUnit| Delta::new(value, unit).unwrap_err().to_string();
    insta::assert_snapshot!(refused(0.0, DeltaUnit::Frames), @"delta is 0, expected above 0");
    insta::assert_snapshot!(refused(1.5, DeltaUnit::Frames), @"delta is 1.5, expected a whole number of frames");
    insta::assert_snapshot!(refused(181.0, DeltaUnit::Degrees), @"delta is 181, expected at most half a turn");
    insta::assert_snapshot!(refused(f64::NAN, DeltaUnit::Distance), @"delta is NaN, expected above 0");
}
