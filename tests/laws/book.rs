//! Tests the book. Every recipe must run, and every example in the tables must be readable. Every selection and
//! expectation must have an example. Every link must lead to an existing file and heading.
//!
//! A code block marked `ron` is a whole recipe that runs in the folder `scenes/`. A code block marked `ron,step` is a
//! step, and a code block marked `ron,sweep` is a sweep.

use std::fs;
use std::path::PathBuf;

use engine::{Engine, Options, Run, Silent, Source};

use crate::{assert_none, root};

/// Returns the name and text of each chapter.
fn chapters() -> Vec<(String, String)> {
    let entries = fs::read_dir(root().join("book/src")).expect("the folder book/src exists");
    let paths = entries.map(|entry| entry.expect("the folder can be listed").path());
    let mut chapters: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .map(|path: PathBuf| {
            let name = path.file_name().expect("a file has a name");
            (
                name.to_string_lossy().into_owned(),
                fs::read_to_string(&path).expect("a chapter is text"),
            )
        })
        .collect();
    chapters.sort();
    chapters
}

/// Returns the code blocks of a kind, each with its file and line.
fn blocks(kind: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (name, text) in chapters() {
        let mut lines = text.lines().enumerate();
        while let Some((i, line)) = lines.next() {
            let Some(marker) = line.trim_start().strip_prefix("```") else {
                continue;
            };
            let block: Vec<&str> = lines
                .by_ref()
                .map(|(_, line)| line)
                .take_while(|line| line.trim() != "```")
                .collect();
            if marker == kind {
                all.push((format!("{name}:{}", i + 2), block.join("\n")));
            }
        }
    }
    assert!(
        !all.is_empty(),
        "the book has no code block of the kind {kind}"
    );
    all
}

/// Reads a recipe as if it were in the folder `scenes/`, and runs it unless `read_only` is true. Returns the problem,
/// if there is one.
fn problem(engine: &Engine, text: &str, read_only: bool) -> Option<String> {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let options = Options {
        out: folder.path(),
        ..Options::default()
    };
    let loaded = engine.load(&Source::new(root().join("scenes/book.ron"), text), &options);
    if !loaded.is_read || (!read_only && loaded.has_errors()) {
        return Some(loaded.render(&loaded.diagnostics, false));
    }
    if read_only {
        return None;
    }
    let outcome = loaded.run(Run::default(), &Silent);
    (!outcome.succeeded()).then(|| format!("{:?}", outcome.failures))
}

#[test]
fn every_recipe_of_the_book_runs() {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    let mut failures = Vec::new();
    for (place, text) in blocks("ron") {
        failures.extend(problem(&engine, &text, false).map(|why| format!("{place}: {why}")));
    }
    for (place, step) in blocks("ron,step") {
        let text = format!("(recipe: 1, steps: [\n{step}\n])");
        failures.extend(problem(&engine, &text, true).map(|why| format!("{place}: {why}")));
    }
    for (place, text) in blocks("ron,sweep") {
        let reading = recipe::read_sweep(&text);
        if reading.has_errors() {
            failures.push(format!("{place}: {:?}", reading.diagnostics));
        }
    }
    assert_none(&failures);
}

/// Returns the code examples in the first column of the tables of a chapter. Each example comes with the heading above
/// its table.
fn examples(chapter: &str) -> Vec<(String, String)> {
    let path = root().join("book/src").join(chapter);
    let text = fs::read_to_string(path).expect("the chapter exists");
    let mut heading = "";
    let mut all = Vec::new();
    for line in text.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            heading = title;
        }
        let code = line.strip_prefix("| `").and_then(|row| row.split_once('`'));
        if let Some((code, _)) = code {
            all.push((heading.to_owned(), code.to_owned()));
        }
    }
    all
}

#[test]
fn every_selection_and_expectation_has_an_example_that_can_be_read() {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    let mut failures = Vec::new();
    let mut check = |expectation: &str| {
        let text = format!("(recipe: 1, steps: [Cube(name: \"a\")], expect: [\n{expectation}\n])");
        failures.extend(problem(&engine, &text, true));
    };
    let selections = examples("selections.md");
    for (heading, code) in &selections {
        match heading.as_str() {
            kind @ ("Vertices" | "Edges" | "Faces") => {
                check(&format!("Count(of: {kind}({code}), min: 0)"));
            }
            _ if code.contains("Faces(") => check(&format!("Count(of: Faces({code}), min: 0)")),
            _ => check(&format!("Count(of: Edges({code}), min: 0)")),
        }
    }
    let expectations = examples("expectations.md");
    for (_, code) in &expectations {
        check(code);
    }
    for (kind, heading) in [
        ("VertexSelection", "Vertices"),
        ("EdgeSelection", "Edges"),
        ("FaceSelection", "Faces"),
    ] {
        let types = recipe::selections();
        let selection = types.iter().find(|t| t.name == kind);
        for variant in &selection.expect("the type of selection exists").variants {
            let is_example = |(table_heading, code): &(String, String)| {
                (table_heading == heading || table_heading.starts_with("For all"))
                    && code.starts_with(&variant.name)
            };
            if !selections.iter().any(is_example) {
                failures.push(format!("selections.md: missing {kind} {}", variant.name));
            }
        }
    }
    for variant in recipe::expectations() {
        let is_example = |(_, code): &(String, String)| code.starts_with(&variant.name);
        if !expectations.iter().any(is_example) {
            failures.push(format!("expectations.md: missing {}", variant.name));
        }
    }
    assert_none(&failures);
}

/// Returns the targets of the Markdown links in a text.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
}

#[test]
fn every_link_target_exists() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md exists");
    let mut pages = vec![(root().to_owned(), "README.md".to_owned(), readme)];
    let book = root().join("book/src");
    pages.extend(
        chapters()
            .into_iter()
            .map(|(name, text)| (book.clone(), name, text)),
    );
    let mut failures = Vec::new();
    for (folder, name, text) in &pages {
        for link in links(text).filter(|link| !link.contains("://")) {
            let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
            let file = if path.is_empty() { name } else { path };
            let Ok(target) = fs::read(folder.join(file)) else {
                failures.push(format!("{name}: the target of {link} does not exist"));
                continue;
            };
            let target = String::from_utf8_lossy(&target);
            // Makes the anchor of a heading as Markdown renderers do.
            let heading = |line: &str| {
                let text = line.trim_start_matches('#').trim().to_lowercase();
                let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
                text.chars()
                    .filter(kept)
                    .collect::<String>()
                    .replace(' ', "-")
            };
            let is_heading = |line: &&str| line.starts_with('#');
            if !anchor.is_empty()
                && !target
                    .lines()
                    .filter(is_heading)
                    .any(|line| heading(line) == anchor)
            {
                failures.push(format!("{name}: the heading of {link} does not exist"));
            }
        }
    }
    assert_none(&failures);
}
