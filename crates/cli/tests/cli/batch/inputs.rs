//! The files that a batch processes, and the files that it refuses.

use super::*;

#[test]
fn unusual_file_names_are_processed() {
    let mut names = vec![
        "a b",
        "ünïcödé ✓",
        "a,b",
        "it's",
        "[x]",
        "{y}",
        "-dash",
        "a;b=c",
        "$HOME `x`",
    ];
    if cfg!(unix) {
        names.extend(["quote\"d", "new\nline", "tab\t", "star*", "<&>"]);
    }
    let folder = names
        .iter()
        .fold(Folder::with_recipe(RECIPE), |folder, name| {
            folder.with(&format!("models/{name}.obj"), tetrahedron(1))
        });
    let ended = batch(&folder, "--report r.csv").with_code(0);
    // The output has one line per file, even if the name of the file contains line breaks.
    assert_eq!(ended.stdout.lines().count(), names.len() + 1, "{ended:#?}");
    let bytes = folder.read("r.csv");
    let mut table = csv::Reader::from_reader(bytes.as_slice());
    let listed: BTreeSet<String> = table.records().map(|r| r.unwrap()[0].to_owned()).collect();
    let expected: BTreeSet<String> = names.iter().map(|n| format!("models/{n}.obj")).collect();
    assert_eq!(listed, expected);
    for name in names {
        assert!(
            folder.path(&format!("out/{name}.obj")).is_file(),
            "{name:?}"
        );
        // A file whose name looks like a pattern can be given by its name.
        let path = format!("models/{name}.obj");
        let one = folder.run_all(&[
            "batch",
            "recipe.ron",
            &format!("--inputs={path}"),
            "--out",
            "one",
        ]);
        assert_eq!(one.code, Some(0), "{one:#?}");
        assert!(one.stdout.contains("1 ok, 0 failed"), "{one:#?}");
    }
}

#[test]
fn two_files_that_would_write_one_output_are_refused_before_anything_runs() {
    let folder = Folder::with_recipe(RECIPE)
        .with("models/a/cow.obj", tetrahedron(1))
        .with("models/b/cow.obj", tetrahedron(2));
    batch(&folder, "").with_code(1).complains(&[
        "error: models/a/cow.obj and models/b/cow.obj would both write out/cow.obj: use `{model.stem}`",
        "--folders\n",
    ]);
    assert!(!folder.path("out").exists());
    batch(&folder, "--folders").with_code(0);
    assert_eq!(folder.entries("out/a/cow.obj"), ["cow.obj"]);
    assert_eq!(folder.entries("out/b/cow.obj"), ["cow.obj"]);
}

#[test]
fn a_file_that_would_be_overwritten_is_refused_before_anything_runs() {
    let folder = with_models(2);
    batch(&folder, "--out models").with_code(1).complains(&[
        "error: the input file models/m000.obj would be overwritten by the output of models/m000.obj",
    ]);
    assert_eq!(folder.entries("models"), ["m000.obj", "m001.obj"]);
}

#[test]
fn invalid_batches_are_refused_with_a_reason() {
    let fixed = RECIPE.replace("Path(default: \"none.obj\")", "Text(default: \"a.obj\")");
    let fixed = fixed.replace("{model.stem}.obj", "a.glb");
    let two = RECIPE.replace(
        "\"levels\":",
        "\"other\": Path(default: \"x\"), \"levels\":",
    );
    let folder = with_models(1)
        .with("fixed.ron", fixed)
        .with("two.ron", two)
        .with("broken.ron", "(recipe: 1, steps: [Cubee])");
    let models = "--inputs models/*.obj";
    for (arguments, message) in [
        (
            "recipe.ron --inputs models/*.ply".to_owned(),
            "no file matches models/*.ply",
        ),
        (
            "recipe.ron --inputs models".to_owned(),
            "models is a folder, expected files: use 'models/*.obj'",
        ),
        (
            "recipe.ron --inputs nowhere/*.obj".to_owned(),
            "no file matches nowhere/*.obj",
        ),
        (
            "recipe.ron --inputs models/[.obj".to_owned(),
            "models/[.obj is not a valid file pattern",
        ),
        (
            format!("fixed.ron {models}"),
            "the recipe has no parameter of type Path",
        ),
        (
            format!("two.ron {models}"),
            "choose one of model, other with --param",
        ),
        (
            format!("two.ron {models} --param mode"),
            "no parameter `mode`: did you mean `model`?",
        ),
        (
            format!("recipe.ron {models} --param levels"),
            "`levels` is of type Int, expected Path",
        ),
        (
            format!("recipe.ron {models} --set model=x"),
            "it cannot be set with --set",
        ),
        (
            format!("recipe.ron {models} --set levels=x"),
            "the value that was set for the parameter `levels` is not allowed",
        ),
        (
            format!("recipe.ron {models} --set level=1"),
            "the recipe has no parameter `level`",
        ),
        (
            format!("recipe.ron {models} --report r.txt"),
            "expected a report with the extension",
        ),
        (format!("broken.ron {models}"), "unknown operation `Cubee`"),
        (format!("none.ron {models}"), "cannot read none.ron"),
    ] {
        let ended = folder.run(&format!("batch {arguments}")).with_code(1);
        assert!(ended.stderr.contains(message), "{arguments}: {ended:#?}");
        assert!(!folder.path("out").exists(), "{arguments}");
    }
    for wrong in ["--shard 0/3", "--shard 4/3", "--shard 1", "--jobs 0"] {
        folder
            .run(&format!("batch recipe.ron {models} {wrong}"))
            .with_code(2);
    }
    folder.run("batch recipe.ron").with_code(2);
    folder.run("batch --merge a.json").with_code(2);
}

#[test]
fn several_patterns_are_one_list_without_duplicates() {
    let folder = with_models(3)
        .with("models/x.ply", "no ply")
        .with("models/.hidden.obj", tetrahedron(1))
        .with("more/deep/er/z.obj", tetrahedron(1));
    folder
        .run("batch recipe.ron --inputs models/m00?.obj models/m001.obj more/** models/*.{ply,stl}")
        .with_code(1)
        .prints(&[
            "ok     models/m000.obj",
            "ok     models/m001.obj",
            "ok     models/m002.obj",
            "FAILED models/x.ply",
            "ok     more/deep/er/z.obj",
            "4 ok, 1 failed",
        ]);
}

#[cfg(unix)]
#[test]
fn cyclic_links_do_not_hang() {
    let folder = with_models(2);
    for name in ["one", "two"] {
        std::os::unix::fs::symlink(
            folder.path("models"),
            folder.path(&format!("models/{name}")),
        )
        .unwrap();
    }
    batch(&folder, "")
        .with_code(0)
        .prints(&["2 ok, 0 failed\n"]);
}
