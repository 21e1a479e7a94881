use std::sync::Mutex;

use super::*;

const CUBE: &str = r#"(recipe: 1, steps: [
    Cube(name: "cube"),
    (id: "poke", run: PokeFaces()),
    Save(path: "cube.obj"),
], expect: [Faces(eq: 24), Vertices(eq: 15)])"#;

fn run(session: &mut Session, text: &str) -> Json {
    session.run("a.ron", text, Values::default(), &|_| true)
}

#[test]
fn a_run_has_steps_expectations_files_and_a_digest() {
    let mut session = Session::new();
    let events = Mutex::new(Vec::new());
    let result = session.run("a.ron", CUBE, Values::default(), &|event| {
        events.lock().unwrap().push(event["event"].clone());
        true
    });
    assert_eq!(result["succeeded"], false);
    assert_eq!(result["steps"][1]["label"], "poke");
    assert_eq!(result["steps"][1]["faces"], 24);
    assert_eq!(result["expectations"][0]["met"], true);
    assert_eq!(result["expectations"][1]["met"], false);
    assert_eq!(result["expectations"][1]["line"], 5);
    assert_eq!(result["expectations"][1]["text"], "Vertices(eq: 15)");
    assert_eq!(result["objects"][0]["vertices"], 14);
    assert!(result["files"].as_array().unwrap().is_empty(), "{result}");
    assert_eq!(events.into_inner().unwrap()[..2], ["step", "done"]);

    let result = run(&mut session, &CUBE.replace("15", "14"));
    assert_eq!(result["succeeded"], true, "{result}");
    let path = result["files"][0].as_str().unwrap();
    assert!(session.read(path).unwrap().starts_with(b"# "));
}

#[test]
fn the_digest_is_that_of_the_engine_on_disk() {
    let result = run(&mut Session::new(), &CUBE.replace("15", "14"));
    let folder = std::env::temp_dir();
    let source = Source::new(folder.join("a.ron"), CUBE.replace("15", "14"));
    let loaded = Engine::new(&REGISTRY).load(&source, &Options::default());
    let digest = loaded.run(Run::default(), &engine::Silent).digest;
    assert_eq!(result["digest"], digest.to_string());
}

#[test]
fn files_are_read_from_memory() {
    let mut session = Session::new();
    session
        .write("models/a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        .unwrap();
    let text = r#"(recipe: 1, steps: [Load(path: "models/a.obj", name: "a")])"#;
    let result = run(&mut session, text);
    assert_eq!(result["succeeded"], true, "{result}");
    assert_eq!(session.arrays("a").unwrap().triangles, [0, 1, 2]);
    assert!(session.arrays("b").is_none());
    let missing = session.check(
        "a.ron",
        &text.replace("models", "elsewhere"),
        Values::default(),
    );
    assert_eq!(missing["problems"][0]["severity"], "error");
}

#[test]
fn ranges_count_utf_16_code_units() {
    let text = "// 𝄞\n(recipe: 1, steps: [Cubee(name: \"a\")])";
    let checked = Session::new().check("a.ron", text, Values::default());
    let problem = &checked["problems"][0];
    assert_eq!(
        (&problem["line"], &problem["column"]),
        (&json!(2), &json!(21))
    );
    let range = [0, 1].map(|i| usize::try_from(problem["range"][i].as_u64().unwrap()).unwrap());
    let units: Vec<u16> = text.encode_utf16().collect();
    assert_eq!(
        String::from_utf16(&units[range[0]..range[1]]).unwrap(),
        "Cubee"
    );
}

#[test]
fn parameters_take_values() {
    let text = r#"(recipe: 1, params: { "n": Int(default: 1, min: 1, max: 4) }, steps: [
        Cube(name: "a"), Triangulate(), LoopSubdivide(levels: arg("n"))])"#;
    let mut session = Session::new();
    let set = [("n".to_owned(), "2".to_owned())];
    let values = Values {
        set: &set,
        ..Values::default()
    };
    let checked = session.check("a.ron", text, values);
    let parameter = &checked["parameters"][0];
    assert_eq!(parameter["value"], "2");
    assert_eq!(
        (&parameter["min"], &parameter["max"]),
        (&json!(1), &json!(4))
    );
    assert_eq!(checked["steps"][2]["line"], 2);
    let result = session.run("a.ron", text, values, &|_| true);
    assert_eq!(result["objects"][0]["faces"], 12 * 16);
}

#[test]
fn a_recipe_with_errors_does_not_run() {
    let mut session = Session::new();
    run(&mut session, &CUBE.replace("15", "14"));
    let result = run(&mut session, "(recipe: 1, steps: [");
    assert_eq!(result["succeeded"], false);
    assert_eq!(result["digest"], Json::Null);
    assert!(session.arrays("cube").is_none(), "the old scene is gone");
}

#[test]
fn a_run_is_canceled_by_its_listener() {
    let text = r#"(recipe: 1, steps: [Cube(name: "a"), Triangulate(), LoopSubdivide(levels: 9)])"#;
    let result = Session::new().run("a.ron", text, Values::default(), &|event| {
        event["event"] != "progress"
    });
    assert_eq!(result["cancelled"], true, "{result}");
}

#[test]
fn a_scene_that_exceeds_the_budget_is_refused() {
    let text = r#"(recipe: 1, steps: [Cube(name: "a"), Triangulate(), LoopSubdivide(levels: 12)])"#;
    let checked = Session::new().check("a.ron", text, Values::default());
    assert_eq!(checked["problems"][0]["severity"], "error", "{checked}");
}

#[test]
fn a_picture_is_a_png_file() {
    let mut session = Session::new();
    run(&mut session, &CUBE.replace("15", "14"));
    for wireframe in [false, true] {
        let png = session.picture([64, 48], wireframe, Up::Auto).unwrap();
        assert!(png.starts_with(b"\x89PNG"));
    }
    assert!(session.picture([u32::MAX, 1], false, Up::Z).is_err());
}

#[test]
fn operations_and_schema_are_objects() {
    let session = Session::new();
    let operations = session.operations();
    assert!(operations.as_array().unwrap().len() > 50);
    assert!(operations[0]["example"].is_string());
    assert!(session.schema().is_object());
}

#[test]
fn each_instance_of_a_mesh_has_a_placement() {
    let mut session = Session::new();
    let text = r#"(recipe: 1, steps: [
        Grid(name: "ground", columns: 4, rows: 4), Cube(name: "tree"), Cube(name: "alone"),
        Scatter(surface: "ground", object: "tree", count: 5, seed: 1),
    ])"#;
    let result = run(&mut session, text);
    assert_eq!(result["succeeded"], true, "{result}");
    let trees = session.placements("tree");
    assert_eq!(trees.len(), 5 * 16);
    let places = trees.chunks(16).map(|m| [m[12], m[13], m[14]]);
    let nodes = session.scene.graph().to_scene().into_iter();
    assert!(places.eq(nodes.map(|map| map.translation.to_array())));
    let alone = session.placements("alone");
    assert_eq!(alone, DMat4::IDENTITY.to_cols_array());
    assert!(session.placements("none").is_empty());
}

/// Returns, for each step of a run, whether its result was taken from the last run.
fn cached(result: &Json) -> Vec<bool> {
    let steps = result["steps"].as_array().unwrap();
    steps.iter().map(|step| step["cached"] == true).collect()
}

/// Runs a recipe in two sessions: the given session, which has kept results, and a new session. Checks that the results
/// are equal, and returns the result of the given session.
fn run_as_new(session: &mut Session, text: &str) -> Json {
    let result = run(session, text);
    let mut new = Session::new();
    let whole = run(&mut new, text);
    for field in [
        "succeeded",
        "digest",
        "expectations",
        "problems",
        "files",
        "objects",
    ] {
        assert_eq!(result[field], whole[field], "{field}");
    }
    for (step, expected) in
        (result["steps"].as_array().unwrap().iter()).zip(whole["steps"].as_array().unwrap())
    {
        for field in ["label", "vertices", "faces", "notes", "changes"] {
            assert_eq!(step[field], expected[field]);
        }
    }
    for path in result["files"].as_array().unwrap() {
        let path = path.as_str().unwrap();
        assert_eq!(session.read(path).unwrap(), new.read(path).unwrap());
    }
    result
}

#[test]
fn a_changed_parameter_of_the_last_step_runs_one_step() {
    let text = r#"(recipe: 1, steps: [
        Cube(name: "a"), (id: "cut", run: Triangulate()), LoopSubdivide(levels: 2), Twist(axis: Y, angle: 10),
    ], expect: [(after: "cut", that: Faces(eq: 12)), Closed])"#;
    let mut session = Session::new();
    assert_eq!(cached(&run_as_new(&mut session, text)), [false; 4]);
    let other = text.replace("10", "20");
    assert_eq!(
        cached(&run_as_new(&mut session, &other)),
        [true, true, true, false]
    );
    // Layout and comments are not part of a step.
    let other = other.replace("Twist", "/* turn */ Twist");
    assert_eq!(cached(&run_as_new(&mut session, &other)), [true; 4]);
    let other = other.replace("levels: 2", "levels: 1");
    assert_eq!(
        cached(&run_as_new(&mut session, &other)),
        [true, true, false, false]
    );
    // If an expectation changes, the step before it runs again. An unmet expectation is reported again.
    let other = other.replace("eq: 12", "eq: 13");
    for _ in 0..2 {
        let result = run_as_new(&mut session, &other);
        assert_eq!(cached(&result), [true, false, false, false]);
        assert_eq!(result["expectations"][0]["met"], false);
    }
}

#[test]
fn a_step_that_writes_a_file_runs_again() {
    let text = r#"(recipe: 1, params: { "a": Float(default: 10) }, steps: [
        Cube(name: "a"), Triangulate(), Save(path: "a.obj"), Twist(axis: Y, angle: arg("a")), Save(path: "b.obj"),
    ])"#;
    let mut session = Session::new();
    run_as_new(&mut session, text);
    let result = run_as_new(&mut session, &text.replace("10", "20"));
    assert_eq!(cached(&result), [true, true, false, false, false]);
}

#[test]
fn a_changed_file_is_read_again() {
    let mut session = Session::new();
    let text = r#"(recipe: 1, steps: [Load(path: "a.obj", name: "a")])"#;
    let model = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    session.write("a.obj", model).unwrap();
    let digest = run(&mut session, text)["digest"].clone();
    let again = run(&mut session, text);
    assert_eq!((cached(&again), &again["digest"]), (vec![true], &digest));
    session
        .write("a.obj", b"v 0 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\n")
        .unwrap();
    let changed = run(&mut session, text);
    assert_eq!(cached(&changed), [false]);
    assert_ne!(changed["digest"], digest);
    session.remove("a.obj");
    assert_eq!(run(&mut session, text)["digest"], Json::Null);
}

#[test]
fn the_values_of_a_preset_are_those_of_its_parameters() {
    let text = r#"(recipe: 1, params: { "n": Int(default: 1, min: 1, max: 4) }, presets: { "fine": { "n": 3 } }, steps: [
        Cube(name: "a"), Triangulate(), LoopSubdivide(levels: arg("n"))])"#;
    let values = Values {
        preset: Some("fine"),
        ..Values::default()
    };
    let checked = Session::new().check("a.ron", text, values);
    assert_eq!(checked["presets"], json!(["fine"]));
    assert_eq!(checked["parameters"][0]["value"], "3");
    let result = Session::new().run("a.ron", text, values, &|_| true);
    assert_eq!(result["objects"][0]["faces"], 12 * 64);
}
