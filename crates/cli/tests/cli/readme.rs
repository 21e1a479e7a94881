//! Tests the README: the recipe with its output, the example of an error, and the table of commands.

use std::fs;
use std::path::Path;

use crate::folder::Folder;

fn repository(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::read_to_string(root.join(path)).unwrap()
}

/// Returns the contents of all code blocks that start with three backticks and `kind`.
fn blocks<'t>(text: &'t str, kind: &str) -> Vec<&'t str> {
    let opening = format!("```{kind}\n");
    let ends = |block: &'t str| block.split_once("```").unwrap().0;
    text.split(&opening).skip(1).map(ends).collect()
}

/// Returns the lines of a text without the column of times. Each sequence of spaces is replaced by a single space.
fn without_times(text: &str) -> Vec<String> {
    let words = |line: &str| {
        line.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let row = |line| {
        let mut words = words(line);
        if let Some(unit) = words.iter().position(|unit| unit == "ms") {
            words.drain(unit - 1..=unit);
        }
        words.join(" ")
    };
    text.lines().map(row).collect()
}

#[test]
fn the_recipe_of_the_readme_prints_what_the_readme_shows() {
    let readme = repository("README.md");
    let recipe = blocks(&readme, "ron")[0];
    let [printed, mistake, ..] = blocks(&readme, "text")[..] else {
        panic!("the README shows an output and a mistake");
    };
    let model = repository("scenes/assets/teapot.bez");
    let folder = Folder::new()
        .with("scenes/assets/teapot.bez", model)
        .with("teapot.ron", recipe);
    let ended = folder.run("run teapot.ron").with_code(0);
    assert_eq!(without_times(&ended.stdout), without_times(printed));

    let folder = folder.with("teapot.ron", recipe.replace("Longest", "Longst"));
    folder
        .run("run teapot.ron")
        .with_code(1)
        .complains(&[mistake.trim_end()]);
}

#[test]
fn the_readme_names_every_command_and_is_short() {
    let readme = repository("README.md");
    assert!(readme.len() <= 6 * 1024, "{} bytes", readme.len());
    let table: String = (readme.lines())
        .filter(|line| line.starts_with("| `"))
        .collect();
    let help = Folder::new().run("help").with_code(0).stdout;
    let commands = help.lines().filter_map(|line| {
        let rest = line.strip_prefix("  ")?;
        (rest.starts_with(char::is_lowercase)).then(|| rest.split_whitespace().next().unwrap())
    });
    for command in commands.filter(|c| *c != "help") {
        assert!(table.contains(&format!("`{command}`")), "{command}");
    }
}
