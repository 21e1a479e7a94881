//! Measures how long the program takes to start, and to check a recipe of 1,000 steps.
//!
//! ```sh
//! cargo bench -p meshwright-cli --bench start
//! ```

mod common;

use common::{measure, run};

/// Returns a recipe whose steps split, flip and tag edges in turn.
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

fn main() {
    let temporary = tempfile::tempdir().expect("a temporary folder");
    let folder = temporary.path();
    std::fs::write(folder.join("many.ron"), many_steps()).expect("a file");
    measure("--help", 101, || (), || run(folder, &["--help"]));
    let check = || run(folder, &["check", "many.ron"]);
    measure("check of 1,000 steps", 31, || (), check);
}
