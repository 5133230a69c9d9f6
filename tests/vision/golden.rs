use std::path::Path;

use cinesplat::vision::Dino;

use super::{TINY, tensors};

/// Largest difference from PyTorch. Found: 2.4e-6.
const TOLERANCE: f32 = 1e-4;

/// The largest difference of the features of a picture of `expected.safetensors` from those of PyTorch.
fn largest_difference(dino: &Dino, picture: &str) -> f32 {
    let stored = tensors("expected.safetensors");
    let (rgb8, patches) = (&stored[&format!("{picture}.rgb8")], &stored[&format!("{picture}.patches")]);
    let (height, width, _) = rgb8.dims3().unwrap();
    let found = dino.patches(&rgb8.flatten_all().unwrap().to_vec1::<u8>().unwrap(), [width, height]).unwrap();
    assert_eq!(patches.dims(), [found.rows, found.columns, found.num_channels]);
    let expected: Vec<f32> = patches.flatten_all().unwrap().to_vec1().unwrap();
    assert_eq!(found.values.len(), expected.len());
    found.values.iter().zip(&expected).map(|(found, expected)| (found - expected).abs()).fold(0.0, f32::max)
}

#[test]
fn features_equal_those_of_transformers() {
    let dino = Dino::load(Path::new(TINY)).unwrap();
    assert_eq!(dino.patch_px(), 14);
    for picture in ["native", "other"] {
        let largest = largest_difference(&dino, picture);
        eprintln!("{picture}: largest difference from PyTorch {largest:e}");
        assert!(largest <= TOLERANCE, "{picture}: {largest}");
    }
}

#[test]
fn a_network_within_another_one_has_the_same_features() {
    let folder = tempfile::tempdir().unwrap();
    let classifier = tensors("model.safetensors").into_iter().map(|(name, tensor)| (format!("dinov2.{name}"), tensor));
    candle_core::safetensors::save(&classifier.collect(), folder.path().join("model.safetensors")).unwrap();
    std::fs::copy(Path::new(TINY).join("config.json"), folder.path().join("config.json")).unwrap();
    assert!(largest_difference(&Dino::load(folder.path()).unwrap(), "native") <= TOLERANCE);
}
