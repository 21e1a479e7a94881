//! Runs recipes with different memory limits. Every run must end, either with success or with an error message.
#![cfg(target_os = "linux")]

use crate::folder::Folder;

#[test]
fn every_run_ends_under_a_limit_of_memory() {
    let (mut succeeded, mut refused) = (0, 0);
    let subdivision =
        r#"Torus(name: "a", around: 8, across: 6), Triangulate, LoopSubdivide(levels: 7)"#;
    let simplification = "Torus(around: 500, across: 300), Triangulate, Simplify(ratio: 0.1)";
    for steps in [subdivision, simplification] {
        for (mebibytes, backtrace) in [(80, 0), (150, 1), (250, 0), (400, 1), (4000, 0)] {
            let folder = Folder::with_recipe(&format!(
                r#"(recipe: 1, steps: [{steps}, Save(path: "a.stl")])"#
            ));
            let ended = folder.shell(&format!(
                "ulimit -v $(({mebibytes} * 1024)); RUST_BACKTRACE={backtrace} \
                 exec timeout -s KILL 100 \"$0\" run recipe.ron --no-cache --threads 2"
            ));
            let what = format!("{mebibytes} MiB, backtrace {backtrace}: {ended:#?}");
            assert!(!ended.stderr.contains("internal error"), "{what}");
            match ended.code {
                Some(0) => succeeded += 1,
                // The exit code 127 means that the system could not load the program. The exit code 134 and `None`
                // (killed by a signal) mean that a small allocation failed. Only failed allocations of large arrays are
                // reported as errors, with the exit code 1.
                Some(1 | 127 | 134) | None => {
                    refused += 1;
                    let sentence = ["memory", "Resource temporarily unavailable", "cannot"];
                    assert!(sentence.iter().any(|s| ended.stderr.contains(s)), "{what}");
                    assert_eq!(
                        folder.entries("out").iter().find(|n| !n.starts_with('.')),
                        None
                    );
                }
                // The exit code 137 means that `timeout` killed the program because it did not end.
                _ => panic!("{what}"),
            }
        }
    }
    assert!(succeeded > 0 && refused > 0, "{succeeded} {refused}");
}
