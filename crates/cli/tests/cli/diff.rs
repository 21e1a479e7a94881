//! `diff`: compares two files, recipes or runs.

use serde_json::json;

use crate::folder::Folder;

fn square(z: f64) -> String {
    format!("v 0 0 0\nv 1 0 0\nv 1 1 {z}\nv 0 1 0\nf 1 2 3 4\n")
}

const CUBE: &str = "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")])";
const CUT: &str = "(recipe: 1, steps: [Cube(name: \"a\"), Triangulate, Save(path: \"a.obj\")])";

#[test]
fn the_exit_code_is_0_for_equal_and_1_for_different_files() {
    let folder = Folder::new()
        .with("a.obj", square(0.0))
        .with("b.obj", square(0.0))
        .with("c.obj", square(0.25));
    folder
        .run("diff a.obj b.obj")
        .with_code(0)
        .prints(&["identical bit for bit\n"]);
    folder.run("diff a.obj c.obj").with_code(1).prints(&[
        "a.obj",
        "c.obj",
        "vertices",
        "area",
        "connectivity   the same\n",
        "positions      1 of 4 differ; the largest difference is 0.25 at v2\n",
        "distance       ",
        "mean distance  ",
        "different\n",
    ]);
    folder
        .run("diff a.obj c.obj --tolerance 0.25")
        .with_code(0)
        .prints(&["equal within 0.25\n"]);
    folder.run("diff a.obj c.obj --tolerance 0.2").with_code(1);
}

#[test]
fn files_that_cannot_be_compared_are_exit_code_2() {
    let folder = Folder::new()
        .with("a.obj", square(0.0))
        .with("bad.ron", "(recipe: 1, steps: [Cubee])");
    for arguments in [
        "diff a.obj",
        "diff a.obj nowhere.obj",
        "diff a.obj bad.ron",
        "diff a.obj a.obj --tolerance -1",
        "diff a.obj a.obj --tolerance nan",
        "diff --runs a.obj a.obj",
    ] {
        folder.run(arguments).with_code(2);
    }
}

#[test]
fn recipes_are_compared_by_their_results() {
    let folder = Folder::new()
        .with("a.ron", CUBE)
        .with("b.ron", CUT)
        .with("c.ron", format!("// The same again.\n{CUBE}"));
    folder.run("diff a.ron c.ron").with_code(0);
    folder.run("diff a.ron b.ron").with_code(1).prints(&[
        "a: mesh\n",
        "faces",
        "6",
        "12",
        "connectivity   different\n",
        "distance       4.71028e-16\n",
    ]);
    assert_eq!(folder.entries("."), ["a.ron", "b.ron", "c.ron"]);
    let json = folder
        .run("diff a.ron b.ron --format json")
        .with_code(1)
        .json();
    assert_eq!(json["equal"], json!(false));
    let mesh = &json["objects"][0]["mesh"];
    assert_eq!(mesh["connectivity"], json!("different"));
    assert_eq!(mesh["counts"][1]["faces"], json!(12));
    assert_eq!(
        mesh["distance"]["at_most"].as_f64().map(|d| d < 1e-12),
        Some(true)
    );
}

#[test]
fn runs_are_compared_step_by_step() {
    let folder = Folder::new().with("a.ron", CUBE).with("b.ron", CUT);
    let record = |recipe: &str| {
        let ended = folder
            .run(&format!("run {recipe} --format json"))
            .with_code(0);
        ended.stdout
    };
    let (a, again, b) = (record("a.ron"), record("a.ron"), record("b.ron"));
    let folder = Folder::new()
        .with("a.json", &a)
        .with("again.json", &again)
        .with("b.json", &b)
        .with("half.json", a.lines().next().unwrap())
        .with("newer.json", a.replace("\"format\":1", "\"format\":2"))
        .with("other.json", a.replace("\"edges\":12", "\"edges\":13"));
    folder
        .run("diff --runs a.json again.json")
        .with_code(0)
        .prints(&["the runs are equal\n"]);
    folder
        .run("diff --runs a.json b.json")
        .with_code(1)
        .prints(&[
            "first difference: step 2, Save\n",
            "  label\n    \"Save\"\n    \"Triangulate\"\n",
        ]);
    let json = folder
        .run("diff --runs a.json other.json --format json")
        .with_code(1)
        .json();
    assert_eq!(json["at"], json!("step 1, Cube"));
    assert_eq!(
        json["differs"][0],
        json!({ "what": "edges", "first": 12, "second": 13 })
    );
    folder
        .run("diff --runs a.json half.json")
        .with_code(2)
        .complains(&["half.json is not a complete record of a run"]);
    folder
        .run("diff --runs a.json newer.json")
        .with_code(2)
        .complains(&["newer.json has version 2, expected at most 1"]);
}

#[test]
fn different_parameters_of_runs_are_shown() {
    let recipe = "(recipe: 1, params: { \"size\": Float(default: 2) },
        steps: [Cube(name: \"a\", size: arg(\"size\"))])";
    let folder = Folder::with_recipe(recipe);
    let record = |set: &str| {
        let run = format!("run recipe.ron --format json --set size={set}");
        folder.run(&run).with_code(0).stdout
    };
    let records = Folder::new()
        .with("a.json", record("2"))
        .with("b.json", record("3"));
    records
        .run("diff --runs a.json b.json")
        .with_code(1)
        .prints(&["parameter size: \"2.0\" and \"3.0\"\n", "  digest\n"]);
}
