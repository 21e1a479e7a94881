//! Batches with several parameter sets, and estimates of memory.

use super::*;

/// A recipe without an input file.
const BALL: &str = r#"(
    recipe: 1,
    params: { "levels": Int(default: 1, max: 5), "center": Vector(default: (0, 0, 0)) },
    steps: [
        Icosahedron(name: "ball", center: arg("center")),
        LoopSubdivide(levels: arg("levels")),
        Save(path: "ball.obj"),
    ],
)"#;

const SETS: &str = r#"[{"levels": 1}, {"levels": "2", "center": [0, 0.5, 1]}, {"levels": 9}]"#;

#[test]
fn every_parameter_set_is_a_row_and_finished_sets_are_not_run_again() {
    let folder = Folder::with_recipe(BALL).with("sets.json", SETS);
    let run = || folder.run("batch recipe.ron --sets sets.json --report r.json --junit j.xml");
    run().with_code(1).prints(&[
        "ok     levels = 1 (",
        "ok     center = (0, 0.5, 1), levels = 2 (",
        "FAILED levels = 9: ",
        "2 ok, 1 failed (see out/failed)\n",
    ]);
    let first = report(&folder, "r.json");
    assert_eq!(first["listed"], 3);
    let of = |name: &str| -> Vec<Json> { rows(&first).iter().map(|r| r[name].clone()).collect() };
    assert_eq!(of("set"), [1, 2, 3]);
    assert_eq!(of("faces"), [80.into(), 320.into(), Json::Null]);
    assert_eq!(
        of("values")[1],
        serde_json::json!({"center": "(0, 0.5, 1)", "levels": "2"})
    );
    assert_eq!(of("outputs")[0][0]["path"], "out/1/ball.obj");
    assert_eq!(
        names(&folder.path("out")),
        ["1", "2", "batch.jsonl", "failed"]
    );
    let note = &folder.entries("out/failed")[0];
    let note = String::from_utf8(folder.read(&format!("out/failed/{note}"))).unwrap();
    assert!(note.contains("--set levels=9 --out out/3"), "{note}");
    run()
        .with_code(1)
        .prints(&["; 3 of them finished in earlier runs\n"]);
    assert_eq!(report(&folder, "r.json"), first);

    // After a change of one parameter set, the recipe is run again only for this set.
    let folder = folder.with("sets.json", SETS.replace('9', "3"));
    let ended = folder.run("batch recipe.ron --sets sets.json").with_code(0);
    ended.prints(&[
        "ok     levels = 3 (",
        "3 ok, 0 failed; 2 of them finished in earlier runs\n",
    ]);
}

#[test]
fn the_merged_parts_of_files_and_sets_are_the_whole() {
    let sets = r#"[{"levels": 2}, {"levels": 1}, {"levels": 0}]"#;
    let folder = with_models(8).with("sets.json", sets);
    for i in 1..=4 {
        let part = format!("--sets sets.json --shard {i}/4 --report part{i}.json");
        assert!(batch(&folder, &part).code.is_some());
    }
    folder
        .run("batch --merge part4.json part1.json part3.json part2.json --report all.json")
        .with_code(1)
        .prints(&["4 reports, 24 files: 16 ok, 8 failed, 0 not processed\n"]);
    batch(&folder, "--sets sets.json --report whole.json").with_code(1);
    let [all, whole] = ["all.json", "whole.json"].map(|path| report(&folder, path));
    assert_eq!(all, whole);
    let row = &rows(&whole)[3];
    assert_eq!(
        (&row["input"], &row["set"]),
        (&"models/m001.obj".into(), &1.into())
    );
    assert_eq!(row["outputs"][0]["path"], "out/1/m001.obj");
}

#[test]
fn wrong_parameter_sets_are_refused_before_anything_runs() {
    for (sets, more, error) in [
        (
            "[{\"level\": 1}]",
            "",
            "set 1: the recipe has no parameter `level`: did you mean `levels`?",
        ),
        (
            "[{}, {\"levels\": [[1]]}]",
            "",
            "set 2: `levels` is [[1]], expected a number, a text",
        ),
        (
            "[{\"levels\": 1}]",
            "--set levels=2",
            "set 1: the parameter `levels` already has a value from the command line",
        ),
        ("[]", "", "sets.json is empty: expected a list of objects"),
        (
            "{\"levels\": 1}",
            "",
            "sets.json: expected a list of objects with values of parameters",
        ),
    ] {
        let folder = Folder::with_recipe(BALL).with("sets.json", sets);
        let ended = folder.run(&format!("batch recipe.ron --sets sets.json {more}"));
        ended.with_code(1).complains(&[error]);
        assert!(!folder.path("out").exists(), "{sets}");
    }
    let folder = with_models(1).with("sets.json", "[{\"model\": \"a.obj\"}]");
    let ended = batch(&folder, "--sets sets.json").with_code(1);
    ended.complains(&["set 1: the parameter `model` already has a value from the command line"]);
}

#[test]
fn the_memory_of_parts_is_estimated_without_a_run() {
    let sets = r#"[{"levels": 0}, {"levels": 1}, {"levels": 5}, {"levels": 9}]"#;
    let folder = Folder::with_recipe(BALL).with("sets.json", sets);
    let estimate = |n: usize| {
        let arguments = format!("batch recipe.ron --sets sets.json --estimate {n} --report e.json");
        folder.run(&arguments).with_code(0);
        let found: Json = serde_json::from_slice(&folder.read("e.json")).unwrap();
        let parts = found["parts"].as_array().unwrap().clone();
        assert_eq!(parts.len(), n);
        assert_eq!(
            parts
                .iter()
                .map(|p| p["runs"].as_u64().unwrap())
                .sum::<u64>(),
            4
        );
        parts
            .iter()
            .map(|p| p["bytes"].as_u64().unwrap())
            .max()
            .unwrap()
    };
    let whole = estimate(1);
    // The largest mesh has 20,480 triangles. The last set has an invalid value of `levels`. The run with this set is
    // never started, so it counts as 0 bytes.
    assert!((1 << 20..1 << 24).contains(&whole), "{whole}");
    assert_eq!(estimate(3), whole);
    assert!(!folder.path("out").exists());
    let ended = folder
        .run("batch recipe.ron --sets sets.json --estimate 2")
        .with_code(0);
    assert!(ended.stdout.starts_with("part 1/2: "), "{ended:#?}");
}
