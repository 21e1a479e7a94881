//! What the cache of steps costs and gives, for the whole program: loading a million triangles, two steps, saving.
//!
//! ```sh
//! cargo bench -p meshwright-cli --bench cache
//! ```

use std::path::Path;
use std::process::{Command, Stdio};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

const MAKE: &str = r#"(recipe: 1, steps: [
    Torus(name: "torus", around: 1000, across: 500), Triangulate, Save(path: "big.glb"), Save(path: "big.obj"),
])"#;

fn recipe(ending: &str) -> String {
    format!(
        r#"(recipe: 1, steps: [
            Load(path: "big.{ending}"), VertexNormals(weight: Area), Transform(move: (0, 0, 1)), Save(path: "out.{ending}"),
        ], expect: [Faces(eq: 1_000_000)])"#
    )
}

fn run(folder: &Path, arguments: &[&str]) {
    let status = Command::new(env!("CARGO_BIN_EXE_meshwright"))
        .arg("run")
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .status();
    assert!(status.is_ok_and(|status| status.success()), "{arguments:?}");
}

fn a_million_triangles(c: &mut Criterion) {
    let temporary = tempfile::tempdir().expect("a temporary folder");
    let folder = temporary.path();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
    write("make.ron", MAKE);
    run(folder, &["make.ron", "--no-cache", "--out", "."]);
    for ending in ["glb", "obj"] {
        write("recipe.ron", &recipe(ending));
        let mut group = c.benchmark_group(format!("1 M triangles of {ending}"));
        group.sample_size(10);
        group.bench_function("without a cache", |b| {
            b.iter(|| run(folder, &["recipe.ron", "--no-cache"]));
        });
        let empty = || {
            let _ = std::fs::remove_dir_all(folder.join("cache"));
        };
        group.bench_function("first run with a cache", |b| {
            let first = |()| run(folder, &["recipe.ron", "--cache", "cache"]);
            b.iter_batched(empty, first, BatchSize::PerIteration);
        });
        group.bench_function("everything cached", |b| {
            b.iter(|| run(folder, &["recipe.ron", "--cache", "cache"]));
        });
        group.finish();
    }
}

criterion_group!(benches, a_million_triangles);
criterion_main!(benches);
