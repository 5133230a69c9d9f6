//! What Cargo cannot say about the layers: which row of the table a crate stands on, who may depend on the expensive
//! packages, and that no two files import each other.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rows of the table from the bottom up. A crate depends only on crates of rows below its own.
const ROWS: [&[&str]; 15] = [
    &["files", "geometry"],
    &["trajectory", "plot"],
    &["scene", "export"],
    &["render", "video"],
    &["objects"],
    &["synth", "map"],
    &["lens"],
    &["evaluation"],
    &["operator"],
    &["critic"],
    &["language"],
    &["director", "reader", "vision"],
    &["training"],
    &["bench"],
    &["cinesplat"],
];

/// Packages that some crates alone depend on.
const OWNED: [(&[&str], &[&str]); 6] = [
    (&["clap", "anyhow", "indicatif", "ctrlc"], &["cinesplat"]),
    (&["candle-core"], &["director", "reader", "training", "vision"]),
    (&["tokenizers"], &["director", "reader", "training"]),
    (&["candle-nn"], &["director", "training", "vision"]),
    (&["candle-transformers"], &["reader"]),
    (&["ffmpeg-next"], &["video"]),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every crate's short name with its folder.
fn crates() -> Vec<(String, PathBuf)> {
    let folders = fs::read_dir(root().join("src")).unwrap().map(|entry| entry.unwrap().path());
    let mut crates: Vec<_> = folders
        .filter(|folder| folder.join("Cargo.toml").exists())
        .map(|folder| (folder.file_name().unwrap().to_str().unwrap().to_owned(), folder))
        .collect();
    crates.push(("cinesplat".to_owned(), root().to_owned()));
    crates.sort();
    crates
}

/// Names in the section `[dependencies]` of a manifest.
fn dependencies(manifest: &str) -> Vec<String> {
    let section = manifest.split("\n[dependencies]\n").nth(1).unwrap_or_default();
    let section = section.split("\n[").next().unwrap_or_default();
    let lines = section.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_alphabetic()));
    lines.map(|line| line.split(['.', ' ', '=']).next().unwrap_or_default().to_owned()).collect()
}

/// What a crate depends on against the table, one line each.
fn violations(name: &str, dependencies: &[String]) -> Vec<String> {
    let row = |name: &str| ROWS.iter().position(|crates| crates.contains(&name));
    let Some(own_row) = row(name) else { return vec![format!("{name} is in no row of the table")] };
    let mut found = Vec::new();
    for dependency in dependencies {
        if let Some(below) = dependency.strip_prefix("cinesplat-")
            && row(below).is_none_or(|row| row >= own_row)
        {
            found.push(format!("{name} depends on {below}, which is not below it"));
        }
        for (packages, owners) in OWNED {
            if packages.contains(&dependency.as_str()) && !owners.contains(&name) {
                found.push(format!("{name} depends on {dependency}, which belongs to {} alone", owners.join(", ")));
            }
        }
    }
    found
}

#[test]
fn every_crate_depends_only_on_rows_below_its_own() {
    let broken: Vec<String> = crates()
        .into_iter()
        .flat_map(|(name, folder)| {
            violations(&name, &dependencies(&fs::read_to_string(folder.join("Cargo.toml")).unwrap()))
        })
        .collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert_eq!(crates().len(), ROWS.iter().map(|row| row.len()).sum::<usize>(), "the table names every crate");
}

#[test]
fn a_broken_table_is_noticed() {
    let of = |name: &str, dependency: &str| violations(name, &[dependency.to_owned()]).len();
    assert_eq!(of("geometry", "cinesplat-trajectory"), 1);
    assert_eq!(of("video", "cinesplat-render"), 1, "two crates of one row do not know each other");
    assert_eq!(of("operator", "candle-core"), 1);
    assert_eq!(of("scene", "clap"), 1);
    assert_eq!(of("attic", "glam"), 1);
    assert_eq!(of("operator", "cinesplat-scene") + of("director", "candle-core") + of("cinesplat", "clap"), 0);
    let manifest = "[package]\nname = \"x\"\n\n[dependencies]\n# why\nglam.workspace = true\nclap = { workspace = true }\n\n[lints]\nclippy = 1\n";
    assert_eq!(dependencies(manifest), ["glam", "clap"]);
}

#[test]
fn no_two_files_import_each_other() {
    let mut circles = Vec::new();
    for (name, folder) in crates() {
        let folder = if name == "cinesplat" { root().join("src") } else { folder };
        let files = rust_files(&folder, name == "cinesplat");
        let read = |file: &PathBuf| {
            let text = fs::read_to_string(file).unwrap();
            let without_tests = text.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
            (module_of(file.strip_prefix(&folder).unwrap()), without_tests)
        };
        let sources = files.iter().map(read).collect();
        circles
            .extend(circles_of(&imports(&sources)).into_iter().map(|circle| format!("{name}: {}", circle.join(" "))));
    }
    assert!(circles.is_empty(), "files that import each other:\n{}", circles.join("\n"));
}

/// The program itself is compiled without a test harness: unit tests in its files would never run.
#[test]
fn the_command_line_has_no_unit_tests() {
    let files = rust_files(&root().join("src/cli"), false);
    assert!(files.len() > 20, "{} files", files.len());
    let tested = files.iter().filter(|file| fs::read_to_string(file).unwrap().contains("#[cfg(test)]"));
    assert_eq!(tested.collect::<Vec<&PathBuf>>(), Vec::<&PathBuf>::new());
}

#[test]
fn a_circle_of_files_is_noticed() {
    let circles = |files: &[(&str, &str)]| {
        let sources = files.iter().map(|(module, text)| (path_of(module), (*text).to_owned())).collect();
        circles_of(&imports(&sources))
    };
    let two = [("", "mod a; mod b;"), ("a", "use super::b::B; pub struct A;"), ("b", "use crate::a::A; pub struct B;")];
    assert_eq!(circles(&two), [["a", "b"]]);
    let through_parent = [("", "mod a; use a::A; pub struct P;"), ("a", "use super::P; pub struct A;")];
    assert_eq!(circles(&through_parent), [["lib", "a"]]);
    let re_exported = [
        ("", "mod a; mod b; pub use a::A; pub use b::{B, C};"),
        ("a", "pub struct A;"),
        ("b", "use super::{A}; pub struct B; pub struct C;"),
    ];
    assert!(circles(&re_exported).is_empty());
    let one_way = [("", "mod a; mod b;"), ("a", "fn f() { super::b::g() }"), ("b", "pub fn g() {} // use super::a::A")];
    assert!(circles(&one_way).is_empty());
}

/// A file's place among the modules of its crate; empty for the root.
type Module = Vec<String>;

fn path_of(module: &str) -> Module {
    module.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

fn module_of(file: &Path) -> Module {
    let mut module: Module =
        file.with_extension("").components().map(|part| part.as_os_str().to_str().unwrap().to_owned()).collect();
    if module.last().is_some_and(|name| ["mod", "lib", "main", "no_film"].contains(&name.as_str())) {
        module.pop();
    }
    module
}

/// Rust files of a folder; of the root package only those that are in no other crate.
fn rust_files(folder: &Path, skips_crates: bool) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() && !(skips_crates && path.join("Cargo.toml").exists()) {
            files.extend(rust_files(&path, skips_crates));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// For every file the files whose definitions it names. What a file only hands on (`pub use`) is not counted; a name that
/// a parent hands on counts as one of the file that defines it.
fn imports(sources: &BTreeMap<Module, String>) -> BTreeMap<Module, BTreeSet<Module>> {
    let statements: BTreeMap<&Module, Vec<Named>> =
        sources.iter().map(|(module, text)| (module, named_paths(module, &tokens(text), sources))).collect();
    let handed_on = |module: &Module, name: &str| {
        let of_name =
            statements[module].iter().find(|named| named.is_public_use && named.item.as_deref() == Some(name));
        of_name.map(|named| named.module.clone())
    };
    let defining = |named: &Named| {
        let mut module = named.module.clone();
        for _ in 0..sources.len() {
            let Some(item) = &named.item else { break };
            match handed_on(&module, item).filter(|next| *next != module) {
                Some(next) => module = next,
                None => break,
            }
        }
        module
    };
    let of_file = |module: &&Module| {
        let named = statements[*module].iter().filter(|named| !named.is_public_use);
        named.map(defining).filter(|other| other != *module).collect()
    };
    sources.keys().map(|module| (module.clone(), of_file(&module))).collect()
}

/// A path in a file: the module that it leads to, and the name in it.
struct Named {
    module: Module,
    item: Option<String>,
    is_public_use: bool,
}

/// Paths from `crate`, `self`, `super` or a child module, in `use` statements and elsewhere.
fn named_paths(own: &Module, tokens: &[(usize, String)], sources: &BTreeMap<Module, String>) -> Vec<Named> {
    let word = |at: usize| tokens.get(at).map_or("", |(_, word)| word.as_str());
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let starts = word(at + 1) == "::" && (at == 0 || word(at - 1) != "::");
        let child: Module = own.iter().cloned().chain([word(at).to_owned()]).collect();
        let base = match word(at) {
            "crate" if starts => Some(Module::new()),
            "self" if starts => Some(own.clone()),
            "super" if starts => Some(own[..own.len().saturating_sub(1)].to_vec()),
            _ if starts && sources.contains_key(&child) => Some(child),
            _ => None,
        };
        let Some(base) = base else {
            at += 1;
            continue;
        };
        let is_public_use = (at > 0 && word(at - 1) == "use") && at > 1 && matches!(word(at - 2), "pub" | ")");
        let mut paths = Vec::new();
        at = expand(tokens, at + 2, &base, &mut paths);
        for path in paths {
            let depth = (0..=path.len()).rev().find(|depth| sources.contains_key(&path[..*depth])).unwrap_or(0);
            let item = path.get(depth).filter(|name| *name != "self").cloned();
            found.push(Named { module: path[..depth].to_vec(), item, is_public_use });
        }
    }
    found
}

/// Reads the rest of a path from `at`: `super` climbs from `path`, braces branch. Returns where it ends.
fn expand(tokens: &[(usize, String)], mut at: usize, path: &Module, found: &mut Vec<Module>) -> usize {
    let word = |at: usize| tokens.get(at).map_or("", |(_, word)| word.as_str());
    let mut path = path.clone();
    loop {
        match word(at) {
            "super" => {
                path.pop();
            }
            "{" => {
                at += 1;
                while !matches!(word(at), "}" | "") {
                    at = expand(tokens, at, &path, found);
                    at += if word(at) == "as" { 2 } else { 0 };
                    at += usize::from(word(at) == ",");
                }
                return at + 1;
            }
            name => path.push(name.to_owned()),
        }
        if word(at + 1) != "::" {
            found.push(path);
            return at + 1;
        }
        at += 2;
    }
}

/// Groups of modules that lead back to themselves.
fn circles_of(imports: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<Vec<String>> {
    let reached = |from: &Module| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&Module> = imports[from].iter().collect();
        while let Some(module) = open.pop() {
            if seen.insert(module.clone()) {
                open.extend(imports.get(module).into_iter().flatten());
            }
        }
        seen
    };
    let reach: BTreeMap<&Module, BTreeSet<Module>> = imports.keys().map(|module| (module, reached(module))).collect();
    let name = |module: &Module| if module.is_empty() { "lib".to_owned() } else { module.join("::") };
    let circle = |module: &&Module| -> Vec<String> {
        let members = imports.keys().filter(|other| reach[*module].contains(*other) && reach[other].contains(*module));
        members.map(name).collect()
    };
    let circles: BTreeSet<Vec<String>> = imports.keys().map(|module| circle(&module)).filter(|c| c.len() > 1).collect();
    circles.into_iter().collect()
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
