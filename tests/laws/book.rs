//! The manual: every recipe in it runs, every example in its tables can be read, and none is missing.
//!
//! A block `ron` is a whole recipe of the folder `scenes/`, `ron,step` a step, and `ron,sweep` a sweep.

use std::fs;
use std::path::PathBuf;

use engine::{Engine, Options, Run, Silent, Source};

use crate::{assert_none, root};

/// The name and text of each chapter.
fn chapters() -> Vec<(String, String)> {
    let entries = fs::read_dir(root().join("book/src")).expect("there is a folder book/src");
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

/// The code blocks of a kind, each with its place.
fn blocks(kind: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (name, text) in chapters() {
        let mut lines = text.lines().enumerate();
        while let Some((i, line)) = lines.next() {
            let Some(given) = line.trim_start().strip_prefix("```") else {
                continue;
            };
            let block: Vec<&str> = lines
                .by_ref()
                .map(|(_, line)| line)
                .take_while(|line| line.trim() != "```")
                .collect();
            if given == kind {
                all.push((format!("{name}:{}", i + 2), block.join("\n")));
            }
        }
    }
    assert!(!all.is_empty(), "no block is of the kind {kind}");
    all
}

/// What is wrong with a recipe of the folder `scenes/`, if anything. Runs it unless it is only to be `read`.
fn problem(engine: &Engine, text: &str, read: bool) -> Option<String> {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let options = Options {
        out: folder.path(),
        ..Options::default()
    };
    let loaded = engine.load(&Source::new(root().join("scenes/book.ron"), text), &options);
    if !loaded.is_read || (!read && loaded.has_errors()) {
        return Some(loaded.render(&loaded.diagnostics, false));
    }
    if read {
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

/// The code in the first column of the tables of a chapter, each with the heading above it.
fn examples(chapter: &str) -> Vec<(String, String)> {
    let path = root().join("book/src").join(chapter);
    let text = fs::read_to_string(path).expect("the chapter is there");
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
    let mut try_one = |expectation: &str| {
        let text = format!("(recipe: 1, steps: [Cube(name: \"a\")], expect: [\n{expectation}\n])");
        failures.extend(problem(&engine, &text, true));
    };
    let selections = examples("selections.md");
    for (heading, code) in &selections {
        match heading.as_str() {
            kind @ ("Vertices" | "Edges" | "Faces") => {
                try_one(&format!("Count(of: {kind}({code}), min: 0)"));
            }
            _ if code.contains("Faces(") => try_one(&format!("Count(of: Faces({code}), min: 0)")),
            _ => try_one(&format!("Count(of: Edges({code}), min: 0)")),
        }
    }
    let expectations = examples("expectations.md");
    for (_, code) in &expectations {
        try_one(code);
    }
    for (kind, heading) in [
        ("VertexSelection", "Vertices"),
        ("EdgeSelection", "Edges"),
        ("FaceSelection", "Faces"),
    ] {
        let types = recipe::selections();
        let selection = types.iter().find(|t| t.name == kind);
        for variant in &selection.expect("a kind of selections").variants {
            let is_there = |(at, code): &(String, String)| {
                (at == heading || at.starts_with("For all")) && code.starts_with(&variant.name)
            };
            if !selections.iter().any(is_there) {
                failures.push(format!("selections.md: no {kind} {}", variant.name));
            }
        }
    }
    for variant in recipe::expectations() {
        let is_there = |(_, code): &(String, String)| code.starts_with(&variant.name);
        if !expectations.iter().any(is_there) {
            failures.push(format!("expectations.md: no {}", variant.name));
        }
    }
    assert_none(&failures);
}

/// The targets of the links in a text.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
}

#[test]
fn every_link_leads_to_a_file() {
    let readme = fs::read_to_string(root().join("README.md")).expect("there is a README");
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
                failures.push(format!("{name}: {link} leads nowhere"));
                continue;
            };
            let target = String::from_utf8_lossy(&target);
            // As the pages make anchors of headings.
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
                failures.push(format!("{name}: {link} leads to no heading"));
            }
        }
    }
    assert_none(&failures);
}
