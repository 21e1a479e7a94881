//! How long the program takes before anything runs: starting, and checking a recipe of 1,000 steps.
//!
//! ```sh
//! cargo bench -p meshwright-cli --bench start
//! ```

use std::path::Path;
use std::process::{Command, Stdio};

use criterion::{Criterion, criterion_group, criterion_main};

fn run(folder: &Path, arguments: &[&str]) {
    let status = Command::new(env!("CARGO_BIN_EXE_meshwright"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .status();
    assert!(status.is_ok_and(|status| status.success()), "{arguments:?}");
}

/// Splits, flips and tags with selections, in turn.
fn many_steps() -> String {
    let mut steps = vec!["Cube(name: \"a\", triangles: true)".to_owned()];
    for i in 0..333 {
        let angle = i % 90;
        steps.push(format!(
            "SplitEdges(edges: Random(count: 2, of: And([Not(Boundary), Sharp(above: {angle})]), seed: {i}), on_refusal: Skip)"
        ));
        steps.push(format!(
            "(id: \"flip {i}\", run: FlipEdges(edges: Longest(count: 3), on_refusal: Skip))"
        ));
        steps.push("TagEdges(name: \"seam\", edges: All)".to_owned());
    }
    let steps = steps.join(",\n");
    format!("(recipe: 1, steps: [\n{steps}\n], expect: [Manifold])")
}

fn start(c: &mut Criterion) {
    let temporary = tempfile::tempdir().expect("a temporary folder");
    let folder = temporary.path();
    std::fs::write(folder.join("many.ron"), many_steps()).expect("a file");
    c.bench_function("--help", |b| b.iter(|| run(folder, &["--help"])));
    c.bench_function("check of 1,000 steps", |b| {
        b.iter(|| run(folder, &["check", "many.ron"]));
    });
}

criterion_group!(benches, start);
criterion_main!(benches);
