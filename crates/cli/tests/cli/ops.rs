//! `ops` and `schema`.

use crate::folder::Folder;

#[test]
fn operations_are_listed_with_their_summaries() {
    let listed = Folder::new().run("ops").with_code(0);
    for entry in ops_all::registry().entries() {
        let line = format!("{:<20} {}\n", entry.name, entry.summary);
        assert!(listed.stdout.contains(&line), "{line}");
    }
    let kinds = recipe::step_kinds();
    for (name, _) in &kinds {
        let line = format!("{name:<20} ");
        assert!(listed.stdout.contains(&line), "{line}");
    }
    let n = ops_all::registry().entries().len() + kinds.len();
    // An empty line and a hint follow the list.
    assert_eq!(listed.stdout.lines().count(), n + 2);
}

#[test]
fn one_operation_is_shown_with_its_parameters() {
    Folder::new().run("ops SplitEdges").with_code(0).prints(&[
        "SplitEdges (version 1): ",
        "Parameters:\n",
        "  edges: EdgeSelection",
        "  at: number above 0 and below 1, defaults to 0.5\n",
        "  on_refusal: ",
        "`meshwright ops --selections` lists the selections.",
        "To choose objects by name, write (on: [\"name\"], run: SplitEdges(..))\n",
        "Example: SplitEdges(",
    ]);
    Folder::new().run("ops Repeat").with_code(0).prints(&[
        "Repeat: Run steps several times",
        "  times: ",
        "  steps: ",
    ]);
}

#[test]
fn a_description_does_not_repeat_the_summary() {
    let shown = Folder::new().run("ops Cube").with_code(0).stdout;
    assert!(
        shown.starts_with("Cube (version 1): Create a cube\n\nThe cube has 8 vertices"),
        "{shown}"
    );
}

#[test]
fn selections_are_described_separately() {
    let folder = Folder::new();
    folder.run("ops --selections").with_code(0).prints(&[
        "EdgeSelection: ",
        "EdgeLoop(..)",
        // A description of several lines is printed completely.
        "At an interior\n",
        "vertex with four edges, an edge loop continues with the\n",
        "opposite edge. At all other vertices, the loop ends. An edge\n",
        "loop that starts at a boundary edge follows the boundary\n",
        "instead.\n",
        "VertexSelection: ",
    ]);
    let operation = folder.run("ops SplitEdges").stdout;
    assert!(!operation.contains("EdgeLoop"), "{operation}");
}

#[test]
fn an_expectation_is_shown_with_its_fields() {
    let folder = Folder::new();
    let list = folder.run("expectations").with_code(0);
    list.prints(&["Objects(", "Manifold ", "Not(..)"]);
    folder.run("expectations Area").with_code(0).prints(&[
        "Area(eq: .., min: .., max: .., tolerance: ..)\n",
        "Fields:\n",
        "  tolerance: number, at least 0, defaults to 1e-9\n",
    ]);
    let unknown = folder.run("expectations Aera").with_code(1);
    assert_eq!(
        unknown.stderr,
        "error: unknown expectation `Aera`: did you mean `Area`?\n"
    );
}

#[test]
fn completions_and_the_manual_page_name_the_commands() {
    let folder = Folder::new();
    for shell in ["bash", "fish", "zsh", "powershell", "elvish"] {
        let arguments = format!("completions {shell}");
        folder.run(&arguments).with_code(0).prints(&["picture"]);
    }
    folder
        .run("man")
        .with_code(0)
        .prints(&[".TH meshwright 1", "picture"]);
}

#[test]
fn every_operation_can_be_shown() {
    let folder = Folder::new();
    for entry in ops_all::registry().entries() {
        let shown = folder.run(&format!("ops {}", entry.name)).with_code(0);
        assert!(shown.stdout.starts_with(entry.name), "{shown:#?}");
    }
}

#[test]
fn every_type_of_a_parameter_is_described() {
    Folder::new().run("ops Picture").with_code(0).prints(&[
        "\nColorBy: ",
        "  of: Quantity (required)",
        "\nStyle: ",
        "  shading: Shading, defaults to Smooth",
        "\nTurntable: ",
    ]);
}

#[test]
fn names_of_selections_and_expectations_are_known() {
    let error = |name: &str| {
        let command = format!("ops {name}");
        Folder::new().run(&command).with_code(1).stderr
    };
    assert_eq!(
        error("Facing"),
        "error: `Facing` is a selection: `meshwright ops --selections` describes it\n"
    );
    assert_eq!(
        error("Closed"),
        "error: `Closed` is an expectation: `meshwright expectations Closed` describes it\n"
    );
}

#[test]
fn an_unknown_operation_gets_a_suggestion() {
    let ended = Folder::new().run("ops SplitEdge").with_code(1);
    assert_eq!(
        ended.stderr,
        "error: unknown operation `SplitEdge`: did you mean `SplitEdges`, `Separate`?\n"
    );
    for (word, help) in [
        ("decimate", "did you mean `Simplify`?"),
        (
            "merge_vertices",
            "did you mean `MoveVertices`, `Join`, `Weld`?",
        ),
        ("merge", "did you mean `Join`, `Weld`, `CollapseEdges`?"),
        ("Sphere", "did you mean `UvSphere`?"),
        ("xyzzy", "`meshwright ops` lists all operations"),
    ] {
        let error = Folder::new()
            .run(&format!("ops {word}"))
            .with_code(1)
            .stderr;
        assert_eq!(
            error,
            format!("error: unknown operation `{word}`: {help}\n")
        );
    }
}

#[test]
fn the_reference_has_a_chapter_for_each_operation() {
    let reference = Folder::new().run("ops --markdown").with_code(0).stdout;
    for entry in ops_all::registry().entries() {
        assert!(reference.contains(&format!("\n## {}\n", entry.name)));
    }
}

#[test]
fn the_schema_is_json_and_has_every_operation() {
    let schema = Folder::new().run("schema").with_code(0).json();
    assert_eq!(schema["title"], "Meshwright recipe");
    for entry in ops_all::registry().entries() {
        assert!(schema["$defs"].get(entry.name).is_some(), "{}", entry.name);
    }
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_not_a_failure() {
    let folder = Folder::new();
    let first = folder.shell("\"$0\" ops | head -1").with_code(0);
    assert_eq!(first.stdout.lines().count(), 1);
    assert_eq!(first.stderr, "");
    // The reader of the output closes the pipe before the first byte is written.
    for command in ["ops", "ops --markdown", "schema"] {
        let ended = folder.shell(&format!(
            "{{ sleep 0.3; \"$0\" {command}; echo \"exit code $?\" >&2; }} | true"
        ));
        assert_eq!(ended.stderr, "exit code 0\n", "{command}");
    }
}

#[cfg(unix)]
#[test]
fn an_error_with_a_closed_pipe_is_still_exit_code_1() {
    let folder = Folder::with_recipe("(recipe: 1, steps: [Cubee])");
    for command in ["run none.ron", "run recipe.ron", "ops Cubee"] {
        folder.shell(&format!(
            "{{ sleep 0.3; \"$0\" {command}; echo $? > code; }} 2>&1 | true"
        ));
        // The shell does not wait for the left side of the pipe.
        let code = (0..100).find_map(|_| {
            std::thread::sleep(std::time::Duration::from_millis(50));
            std::fs::read(folder.path("code"))
                .ok()
                .filter(|c| !c.is_empty())
        });
        assert_eq!(code.as_deref(), Some(&b"1\n"[..]), "{command}");
        std::fs::remove_file(folder.path("code")).unwrap();
    }
}

#[test]
fn operations_are_described_as_json() {
    let folder = Folder::new();
    let json = |command: &str| -> serde_json::Value {
        let ended = folder.run(command).with_code(0);
        serde_json::from_str(&ended.stdout).unwrap()
    };
    let list = json("ops --format json");
    let named = |name: &str| {
        let mut entries = list.as_array().unwrap().iter();
        entries.any(|entry| entry["name"] == name && entry["summary"].is_string())
    };
    assert!(named("Weld") && named("Repeat"));
    let weld = json("ops Weld --format json");
    assert_eq!(weld["name"], "Weld");
    assert!(weld["docs"].is_string() && weld["example"].is_string());
    assert!(weld["schema"]["properties"]["distance"].is_object());
    assert!(json("ops Repeat --format json")["schema"].is_object());
    folder.run("ops Nothing --format json").with_code(1);
    folder.run("ops --selections --format json").with_code(2);
}
