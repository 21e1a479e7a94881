//! Tests of checking a recipe without running it.

use std::path::{Path, PathBuf};

use super::{checked, files, read_with, shown, steps};
use crate::Severity;
use crate::check::VISITED;
use op::Range;

#[track_caller]
fn has_one_error(text: &str, place: &str, message: &str, help: &str) {
    let forecast = checked(text, u64::MAX);
    assert_eq!(
        shown(text, &forecast.diagnostics),
        [(place, message, help)],
        "{text}"
    );
    assert!(forecast.has_errors());
}

#[test]
fn counts_are_forecast_after_each_step() {
    let forecast = checked(
        &steps("Sheet(columns: 2), (id: \"more\", run: Sheet(columns: 3, name: \"b\"))"),
        u64::MAX,
    );
    assert!(!forecast.has_errors());
    let [first, second] = &forecast.steps[..] else {
        panic!("two steps")
    };
    assert_eq!(
        (first.label.as_str(), first.faces),
        ("Sheet", Range::exactly(2))
    );
    assert_eq!(
        (second.label.as_str(), second.faces),
        ("more", Range::exactly(5))
    );
    assert_eq!(second.vertices, Range::exactly(6 + 8));
    assert_eq!(second.edges, Range::exactly(7 + 10));
}

#[test]
fn objects_in_on_must_exist() {
    has_one_error(
        &steps("Sheet(columns: 2), (run: Lift(by: 1), on: [\"shet\"])"),
        "\"shet\"",
        "no object is named \"shet\"",
        "objects at this point: \"sheet\"",
    );
}

#[test]
fn objects_in_selections_must_exist() {
    has_one_error(
        &steps("Sheet(columns: 2), Lift(by: 1, vertices: Not(InsideOf(\"shet\")))"),
        "\"shet\"",
        "no object is named \"shet\"",
        "objects at this point: \"sheet\"",
    );
}

#[test]
fn objects_in_expectations_must_exist_at_their_step() {
    let text = r#"(recipe: 1, steps: [
            (id: "first", run: Sheet(columns: 2)), Sheet(columns: 2, name: "late"),
        ], expect: [
            (after: "first", on: ["late"], that: Faces(eq: 2)),
            (on: ["late"], that: Same(as: Object("early"))),
            (on: ["late"], that: Not(DistanceTo(other: Object("sheet"), below: 1))),
        ])"#;
    let forecast = checked(text, u64::MAX);
    assert_eq!(
        shown(text, &forecast.diagnostics),
        [
            (
                "Faces(eq: 2)",
                "no object is named \"late\"",
                "objects at this point: \"sheet\""
            ),
            (
                "Same(as: Object(\"early\"))",
                "no object is named \"early\"",
                "objects at this point: \"sheet\", \"late\""
            ),
        ]
    );
}

#[test]
fn files_in_expectations_must_exist() {
    has_one_error(
        r#"(recipe: 1, steps: [Sheet(columns: 1)], expect: [Same(as: File("no/such.obj"))])"#,
        "Same(as: File(\"no/such.obj\"))",
        "the file no/such.obj does not exist",
        "",
    );
}

#[test]
fn a_problem_is_shown_at_its_parameter() {
    has_one_error(
        &steps("Sheet(columns: 1), Lift(by: 2e6)"),
        "2e6",
        "that is too high",
        "",
    );
    // A parameter that the recipe omits has no span. The problem is then shown at the name of the operation.
    has_one_error(
        &steps("Sheet(columns: 1), (id: \"again\", run: Sheet(columns: 1))"),
        "Sheet",
        "the scene already has an object named \"sheet\"",
        "",
    );
}

#[test]
fn a_warning_does_not_stop_a_recipe() {
    let forecast = checked(&steps("Sheet(columns: 1), Lift(by: 0)"), u64::MAX);
    assert_eq!(forecast.diagnostics[0].message, "nothing moves");
    assert_eq!(forecast.diagnostics[0].severity, Severity::Warning);
    assert!(!forecast.has_errors());
}

#[test]
fn a_step_without_a_mesh_to_change_is_an_error() {
    has_one_error(
        &steps("Lift(by: 1)"),
        "Lift",
        "Lift finds no mesh to change",
        "load or create a mesh in an earlier step; Tessellate converts patches to a mesh",
    );
}

#[test]
fn errors_that_follow_from_a_broken_step_are_not_reported() {
    let text = steps(
        "Sheet(columns: 1, name: \"a\"), Sheet(columns: 1, name: \"a\"), (run: Lift(by: 1), on: [\"b\"])",
    );
    has_one_error(
        &text,
        "\"a\"",
        "the scene already has an object named \"a\"",
        "",
    );
}

#[test]
fn a_step_that_must_be_refused_has_no_errors_and_changes_no_forecast() {
    let forecast = checked(
        &steps(
            "Sheet(columns: 1), (run: Sheet(columns: 9), refused: Missing), (run: Lift(by: 2e6), refused: Boundary)",
        ),
        u64::MAX,
    );
    assert_eq!(forecast.diagnostics, []);
    assert!(forecast.steps.iter().all(|s| s.faces == Range::exactly(1)));
}

#[test]
fn exceeding_the_budget_is_one_error_at_the_first_step_that_does() {
    let text = steps("Sheet(columns: 1), Sheet(columns: 100000, name: \"b\"), Lift(by: 1)");
    let forecast = checked(&text, 1 << 20);
    assert_eq!(
        shown(&text, &forecast.diagnostics),
        [(
            "Sheet",
            "the meshes take 13 MiB after this step, more than the memory budget of 1.0 MiB",
            "raise the budget with --budget"
        )]
    );
    let start = forecast.diagnostics[0].span.unwrap().start;
    assert_eq!(start, text.rfind("Sheet").unwrap());
}

#[test]
fn two_steps_cannot_write_one_file() {
    let text = steps(
        "Sheet(columns: 1), Write(path: \"a.txt\"), Write(path: \"b.txt\"), Write(path: \"a.txt\")",
    );
    let forecast = checked(&text, u64::MAX);
    assert_eq!(
        shown(&text, &forecast.diagnostics),
        [("\"a.txt\"", "an earlier step writes \"a.txt\" too", "")]
    );
    let start = forecast.diagnostics[0].span.unwrap().start;
    assert_eq!(start, text.rfind("\"a.txt\"").unwrap());
}

#[test]
fn outputs_are_listed_with_their_placeholders_filled_in() {
    let text = r#"(recipe: 1, params: {"input": Path(default: "models/cow.obj")},
        steps: [Sheet(columns: 1), Write(path: "new/{input.stem}.txt")])"#;
    assert_eq!(
        checked(text, u64::MAX).outputs,
        [PathBuf::from("out/new/cow.txt")]
    );
    let reading = read_with(text, &[("input", "pig.obj")]);
    let forecast = crate::check(
        &reading.recipe,
        &files(&reading, Path::new("out")),
        u64::MAX,
    );
    assert_eq!(forecast.outputs, [PathBuf::from("out/new/pig.txt")]);
    has_one_error(
        &text.replace("input.stem", "inptu.stem"),
        "\"new/{inptu.stem}.txt\"",
        "unknown placeholder {inptu.stem} in \"new/{inptu.stem}.txt\"; known placeholders, which stand for the file names of path parameters: {input.stem}, {input.name}",
        "",
    );
}

#[test]
fn outputs_stay_in_the_output_folder() {
    for path in ["../a.txt", "/a.txt", "a/../../b.txt"] {
        let text = steps(&format!("Sheet(columns: 1), Write(path: \"{path}\")"));
        has_one_error(
            &text,
            &format!("\"{path}\""),
            &format!(
                "the output path \"{path}\" must stay inside the output folder: use a \
                 relative path without the folders \".\" and \"..\" and without the characters \"\\\" and \":\""
            ),
            "",
        );
    }
}

#[test]
fn unchanged_objects_are_not_visited_again() {
    let steps: Vec<String> = (0..2000)
        .map(|i| format!("Sheet(columns: 1, name: \"{i}\")"))
        .collect();
    let text = super::steps(&steps.join(", "));
    let recipe = read_with(&text, &[]).recipe;
    VISITED.set(0);
    let forecast = crate::check(&recipe, &op::Files::default(), u64::MAX);
    assert!(!forecast.has_errors());
    assert_eq!(forecast.steps[1999].faces, Range::exactly(2000));
    // Each step visits only its own object. If each step visited all objects, there would be two million visits.
    assert_eq!(VISITED.get(), 2000);
}
