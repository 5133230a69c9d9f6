//! From a model file to a program: the library's path and the command's.

use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::sync::OnceLock;

use candle_core::quantized::gguf_file::Content;
use candle_core::{Device, Tensor};
use candle_transformers::models::{quantized_llama, quantized_qwen2};
use cinesplat::director::{Director, SceneContext};
use cinesplat::language::{NamedObject, program_to_notation};
use cinesplat::objects::Object;
use cinesplat::pipeline::{self, Interpreter, Reading};
use cinesplat::reader::{Question, Reader};
use glam::DVec3;
use tempfile::TempDir;

use super::tiny_model::{Family, TinyModel};
use crate::cli;

/// Sentences about a sofa (1) and a floor lamp (2) with the answers that the tiny models learn.
const LESSONS: [(&str, &str); 3] = [
    ("Push in on the sofa.", "1-5 push-in end=1"),
    ("Orbit the lamp to the left, then crane up.", "1-6 orbit-left end=2 / 7-9 crane-up"),
    ("Five seconds, pull back slowly.", "3-5 pull-out slow | total=5s"),
];

fn objects() -> Vec<NamedObject> {
    [(1, "sofa"), (2, "floor lamp")].map(|(id, label)| NamedObject { id, label: label.to_owned() }).to_vec()
}

fn lessons() -> Vec<(Question, &'static str)> {
    LESSONS.iter().map(|(prompt, answer)| (Question::new(prompt, &objects(), &[]), *answer)).collect()
}

fn trained(family: Family) -> TinyModel {
    let lessons = lessons();
    let questions: Vec<Question> = lessons.iter().map(|(question, _)| question.clone()).collect();
    let mut model = TinyModel::new(family, &questions);
    let loss = model.train(&lessons);
    assert!(loss < 0.05, "loss {loss}");
    model
}

/// The bytes of a Qwen2 model that has learned the lessons.
pub fn qwen2() -> &'static [u8] {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| trained(Family::Qwen2).gguf())
}

/// A folder with a model in it.
pub fn saved(bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tiny.gguf");
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

/// What a model reads a prompt about the two objects as.
fn read(interpreter: &Interpreter, prompt: &str) -> Reading {
    let objects: Vec<Object> = objects()
        .iter()
        .map(|object| Object::from_box(object.id, &object.label, DVec3::splat(object.id.into()), DVec3::splat(0.3)))
        .collect();
    let linked = interpreter.director.link(prompt, &self::objects()).unwrap();
    let scene = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size: 4.0 };
    pipeline::read(prompt, linked, interpreter, &scene).unwrap()
}

#[test]
fn a_trained_model_reads_its_lessons_with_words_and_certainty() {
    let (_folder, path) = saved(qwen2());
    let reader = Some(Reader::load(&path).unwrap());
    let interpreter = Interpreter { director: Director::embedded().unwrap(), reader };
    let expected = ["push-in end=1", "orbit-left end=2 / crane-up", "pull-out slow | total=5s"];
    for ((prompt, _), expected) in LESSONS.iter().zip(expected) {
        let reading = read(&interpreter, prompt);
        assert_eq!(program_to_notation(&reading.direction.program), expected, "{prompt}");
        assert!(reading.problems.is_empty(), "{prompt}: {:?}", reading.problems);
        for certainty in &reading.direction.certainty {
            assert!(certainty.probability > 0.5 && certainty.probability <= certainty.weakest.1, "{certainty:?}");
        }
    }
    let orbit = read(&interpreter, LESSONS[1].0);
    let words: Vec<&str> =
        orbit.direction.program.steps.iter().map(|step| orbit.words_of(step, LESSONS[1].0)).collect();
    assert_eq!(words, ["Orbit the lamp to the left", "then crane up"]);
}

#[test]
fn a_sentence_that_the_model_has_not_learned_is_still_a_program_about_the_objects() {
    let (_folder, path) = saved(qwen2());
    let reader = Reader::load(&path).unwrap();
    for prompt in ["drift past the window", "<|im_end|> none", "...", "\u{1F3A5}", "5 5 5 5 5 5 5 5 5"] {
        let first = reader.read(&Question::new(prompt, &objects(), &[])).unwrap();
        assert!(first.program.object_ids().iter().all(|id| [1, 2].contains(id)), "{prompt}");
        assert_eq!(first, reader.read(&Question::new(prompt, &objects(), &[])).unwrap(), "{prompt}");
    }
    let endless = "pan left ".repeat(900);
    let error = reader.read(&Question::new(&endless, &objects(), &[])).unwrap_err();
    assert_eq!(error.code(), "READER-TOO-LONG", "{error}");
}

#[test]
fn the_forward_pass_of_the_training_is_that_of_the_quantized_models() {
    let question = Question::new(LESSONS[0].0, &objects(), &[]);
    let compare = |model: &TinyModel, forward: &mut dyn FnMut(&Tensor) -> Vec<f32>| {
        let tokens = model.prompt(&question);
        let own = model.last_scores(&tokens);
        let input = Tensor::new(tokens, &Device::Cpu).unwrap().unsqueeze(0).unwrap();
        let other = forward(&input);
        let worst = own.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(own.len() == other.len() && worst < 1e-3, "{worst}");
        assert!(own.iter().map(|score| score.abs()).fold(0.0, f32::max) > 0.5, "scores differ from zero");
    };
    let qwen2 = TinyModel::new(Family::Qwen2, std::slice::from_ref(&question));
    let mut file = Cursor::new(qwen2.gguf());
    let content = Content::read(&mut file).unwrap();
    let mut network = quantized_qwen2::ModelWeights::from_gguf(content, &mut file, &Device::Cpu).unwrap();
    compare(&qwen2, &mut |input| network.forward(input, 0).unwrap().squeeze(0).unwrap().to_vec1().unwrap());
    let llama = TinyModel::new(Family::Llama, std::slice::from_ref(&question));
    let mut file = Cursor::new(llama.gguf());
    let content = Content::read(&mut file).unwrap();
    let mut network = quantized_llama::ModelWeights::from_gguf(content, &mut file, &Device::Cpu).unwrap();
    compare(&llama, &mut |input| network.forward(input, 0).unwrap().squeeze(0).unwrap().to_vec1().unwrap());
}

#[test]
fn a_llama_model_reads_too() {
    let (_folder, path) = saved(&trained(Family::Llama).gguf());
    let reader = Reader::load(&path).unwrap();
    for ((question, _), expected) in lessons().iter().zip(["push-in end=1", "orbit-left end=2 / crane-up"]) {
        assert_eq!(program_to_notation(&reader.read(question).unwrap().program), expected);
    }
}

#[test]
fn the_command_reads_with_a_model_and_a_plan_names_it() {
    let (folder, path) = saved(qwen2());
    let arguments = ["read", "-p", LESSONS[1].0, "--names", "sofa,floor lamp", "--reader", "tiny.gguf", "--json"];
    let read: serde_json::Value = serde_json::from_str(&cli::data(folder.path(), &arguments)).unwrap();
    assert_eq!(read["program"], "orbit-left end=2 / crane-up");
    assert_eq!(read["steps"][1]["text"], "then crane up");
    let objects = r#"{"format":"cinesplat.objects","version":1,"objects":[
        {"id":1,"label":"sofa","center":[0,0.8,0],"half_extents":[0.3,0.3,0.3]},
        {"id":2,"label":"floor lamp","center":[1,0.8,0],"half_extents":[0.2,0.2,0.2]}]}"#;
    fs::write(folder.path().join("objects.json"), objects).unwrap();
    let plan = ["plan", cli::SMALL_SCENE, "-p", LESSONS[0].0, "--objects", "objects.json", "--solve", "off", "--json"];
    let plan = cli::data(folder.path(), &[&plan[..], &["--reader", "tiny.gguf"]].concat());
    let shot: serde_json::Value = serde_json::from_str(&plan).unwrap();
    assert_eq!(shot["model"]["name"], "tiny.gguf");
    assert_eq!(shot["model"]["sha256"], cinesplat::files::sha256_hex(&fs::read(path).unwrap()));
    assert_eq!(shot["keyframes"][1]["intent"]["move"], "push-in");
    assert_eq!(shot["keyframes"][1]["intent"]["words"], serde_json::json!([0, 19]));
}
