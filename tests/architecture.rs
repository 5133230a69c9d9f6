//! The table of layers: who may know whom. A broken row fails with the file, the line and what it names.

use std::fs;
use std::path::{Path, PathBuf};

/// Rows of the table from the bottom up. A folder of `src` may name folders of rows below its own, and itself.
const ROWS: [&[&str]; 11] = [
    &["geometry", "plot"],
    &["trajectory"],
    &["scene", "export"],
    &["render", "video"],
    &["objects"],
    &["lens"],
    &["evaluation"],
    &["operator"],
    &["director"],
    &["pipeline"],
    &["cli"],
];

/// Macros that print: `cli` alone, which writes to its streams without them.
const PRINTING: [&str; 5] = ["println", "eprintln", "print", "eprint", "dbg"];

/// Words of code that belong to some folders alone.
const OWNED: [(&[&str], &[&str]); 3] = [
    (&["clap", "anyhow", "indicatif", "ctrlc"], &["cli"]),
    (&["candle_core", "candle_nn", "tokenizers"], &["director"]),
    (&["ffmpeg_next"], &["video"]),
];

#[test]
fn every_folder_knows_only_what_lies_below_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut broken = Vec::new();
    for file in rust_files(&src) {
        let relative = file.strip_prefix(&src).unwrap().to_str().unwrap().replace('\\', "/");
        broken.extend(violations(&relative, &fs::read_to_string(&file).unwrap()));
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn every_folder_has_a_row() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in fs::read_dir(&src).unwrap().map(Result::unwrap).filter(|entry| entry.path().is_dir()) {
        let name = entry.file_name().into_string().unwrap();
        assert!(row(&name).is_some(), "src/{name} is in no row of the table");
    }
}

#[test]
fn a_broken_table_is_noticed() {
    let breaks = |file: &str, source: &str| !violations(file, source).is_empty();
    assert!(breaks("geometry/pose.rs", "use crate::trajectory::Shot;"));
    assert!(breaks("render/blend.rs", "use crate::{\n    geometry::Pose,\n    video::VideoWriter,\n};"));
    assert!(breaks("scene/ply/rows.rs", "fn f() { super::super::super::cli::run() }"));
    assert!(breaks("scene/mod.rs", "use super::render;"));
    assert!(breaks("objects/sheet.rs", "fn f() { println!(\"x\") }"));
    assert!(breaks("operator/mod.rs", "use candle_core::Tensor;"));
    assert!(breaks("pipeline/film.rs", "use ffmpeg_next as ffmpeg;"));

    assert!(!breaks("render/blend.rs", "use crate::{geometry::Pose, scene::{Gaussians, video_like}};"));
    assert!(!breaks("geometry/pose.rs", "// as crate::cli does\nconst S: &str = \"crate::cli println!\";"));
    assert!(!breaks("scene/ply/rows.rs", "use super::super::SceneError; use super::header::Header;"));
    assert!(!breaks("scene/paint.rs", "fn print(print: u8) -> u8 { print }"));
    assert!(!breaks("cli/info.rs", "use crate::pipeline; use clap::Args; fn f() { println!(\"{}\", '\"'); }"));
}

fn row(folder: &str) -> Option<usize> {
    ROWS.iter().position(|folders| folders.contains(&folder))
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries
        .flat_map(|path| if path.is_dir() { rust_files(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    files.sort();
    files
}

/// What a file of `src` (path relative to it) names against the table, one line each.
fn violations(file: &str, source: &str) -> Vec<String> {
    let Some((folder, inside)) = file.split_once('/') else { return Vec::new() };
    let tokens = tokens(source);
    let depth = inside.matches('/').count() + if inside.ends_with("mod.rs") { 1 } else { 2 };
    let mut found = Vec::new();
    for (line, named) in folders_named(&tokens, depth) {
        let Some(their_row) = row(&named) else { continue };
        if named != folder && row(folder).is_none_or(|own_row| their_row >= own_row) {
            found.push(format!("src/{file}:{line}: {folder} names {named}, which is not below it"));
        }
    }
    for (at, (line, word)) in tokens.iter().enumerate() {
        let is_macro = tokens.get(at + 1).is_some_and(|(_, mark)| mark == "!");
        if folder != "cli" && is_macro && PRINTING.contains(&word.as_str()) {
            found.push(format!("src/{file}:{line}: {word}! prints, which cli alone may"));
        }
        for (words, owners) in OWNED {
            if words.contains(&word.as_str()) && !owners.contains(&folder) {
                found.push(format!("src/{file}:{line}: {word} belongs to {} alone", owners.join(", ")));
            }
        }
    }
    found
}

/// First names of all paths that start at the crate's root: `crate::x`, `crate::{x, y::z}`, enough `super::`.
fn folders_named(tokens: &[(usize, String)], depth: usize) -> Vec<(usize, String)> {
    let word = |i: usize| tokens.get(i).map_or("", |(_, word)| word.as_str());
    let mut named = Vec::new();
    for start in 0..tokens.len() {
        let mut at = start;
        if word(at) == "crate" && word(at + 1) == "::" {
            at += 2;
        } else if word(at) == "super" && (start < 2 || word(start - 2) != "super") {
            let mut num_up = 0;
            while word(at) == "super" && word(at + 1) == "::" {
                num_up += 1;
                at += 2;
            }
            if num_up < depth {
                continue;
            }
        } else {
            continue;
        }
        if word(at) != "{" {
            named.push((tokens[start].0, word(at).to_owned()));
            continue;
        }
        let mut nesting = 0;
        while at < tokens.len() {
            match word(at) {
                "{" => nesting += 1,
                "}" => nesting -= 1,
                name if nesting == 1 && matches!(word(at - 1), "{" | ",") => {
                    named.push((tokens[at].0, name.to_owned()));
                }
                _ => {}
            }
            at += 1;
            if nesting == 0 {
                break;
            }
        }
    }
    named
}

/// Words and marks of code with their lines; comments, strings and character literals are left out.
fn tokens(source: &str) -> Vec<(usize, String)> {
    let chars: Vec<char> = source.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let (mut i, mut line, mut tokens) = (0, 1, Vec::new());
    while i < chars.len() {
        let start = i;
        let c = chars[i];
        if c == '/' && at(i + 1) == '/' {
            while i < chars.len() && at(i) != '\n' {
                i += 1;
            }
        } else if c == '/' && at(i + 1) == '*' {
            i += 2;
            while i < chars.len() && !(at(i - 1) == '*' && at(i) == '/' && i > start + 2) {
                i += 1;
            }
            i += 1;
        } else if c == '"' {
            i = end_of_string(&chars, i);
        } else if c == 'r' && raw_hashes(&chars, i).is_some() {
            let num_hashes = raw_hashes(&chars, i).unwrap();
            let ends = |i: usize| at(i) == '"' && (1..=num_hashes).all(|k| at(i + k) == '#');
            i += num_hashes + 2;
            while i < chars.len() && !ends(i) {
                i += 1;
            }
            i += num_hashes + 1;
        } else if c == '\'' && (at(i + 1) == '\\' || at(i + 2) == '\'') {
            i += if at(i + 1) == '\\' { 3 } else { 2 };
            while i < chars.len() && at(i) != '\'' {
                i += 1;
            }
            i += 1;
        } else if c.is_alphanumeric() || c == '_' {
            while at(i).is_alphanumeric() || at(i) == '_' {
                i += 1;
            }
            tokens.push((line, chars[start..i].iter().collect()));
        } else if c == ':' && at(i + 1) == ':' {
            i += 2;
            tokens.push((line, "::".to_owned()));
        } else {
            i += 1;
            if !c.is_whitespace() {
                tokens.push((line, c.to_string()));
            }
        }
        line += chars[start..i.min(chars.len())].iter().filter(|&&c| c == '\n').count();
    }
    tokens
}

/// Index after the closing quote of the string that opens at `start`.
fn end_of_string(chars: &[char], start: usize) -> usize {
    let mut i = start + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// Number of `#` of a raw string that starts at `start` (`r"`, `r#"`); `None` when none does.
fn raw_hashes(chars: &[char], start: usize) -> Option<usize> {
    let num_hashes = chars[start + 1..].iter().take_while(|&&c| c == '#').count();
    let in_word = start > 0 && (chars[start - 1].is_alphanumeric() && chars[start - 1] != 'b');
    (chars.get(start + 1 + num_hashes) == Some(&'"') && !in_word).then_some(num_hashes)
}
