//! Measures the whole program with and without the step cache. The recipe loads a million triangles, changes them in
//! two steps, and saves the result.
//!
//! ```sh
//! cargo bench -p meshwright-cli --bench cache
//! ```

mod common;

use common::{measure, run};

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

fn main() {
    let temporary = tempfile::tempdir().expect("a temporary folder");
    let folder = temporary.path();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
    write("make.ron", MAKE);
    run(folder, &["run", "make.ron", "--no-cache", "--out", "."]);
    for ending in ["glb", "obj"] {
        write("recipe.ron", &recipe(ending));
        let measure = |name: &str, prepare: &dyn Fn(), arguments: &[&str]| {
            let name = format!("1 M triangles of {ending}, {name}");
            measure(&name, 11, prepare, || run(folder, arguments));
        };
        let clear = || {
            let _ = std::fs::remove_dir_all(folder.join("cache"));
        };
        let cached = ["run", "recipe.ron", "--cache", "cache"];
        measure(
            "without a cache",
            &|| (),
            &["run", "recipe.ron", "--no-cache"],
        );
        measure("first run with a cache", &clear, &cached);
        measure("everything cached", &|| (), &cached);
    }
}
