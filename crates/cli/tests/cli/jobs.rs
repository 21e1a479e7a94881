//! Runs every command in the book's chapter about jobs.

#![cfg(unix)]

use std::fs;
use std::path::Path;

use crate::folder::{Ended, Folder};

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// The text of the chapter.
fn chapter() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/jobs.md");
    fs::read_to_string(path).unwrap()
}

/// Returns the content of the first code block that starts with three backticks and `kind`.
fn block<'t>(text: &'t str, kind: &str) -> Option<&'t str> {
    let (_, block) = text.split_once(&format!("```{kind}\n"))?;
    Some(block.split_once("```").unwrap().0)
}

/// A folder with the files that the chapter names.
fn folder(chapter: &str) -> Folder {
    let textured = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    let folder = Folder::new()
        .with("part.ron", block(chapter, "ron").unwrap())
        .with("levels.sweep.ron", block(chapter, "ron,sweep").unwrap())
        .with("assets/bunny.obj", CUBE)
        .with("products/a.obj", CUBE)
        .with("products/b.obj", CUBE)
        .with("textured.obj", textured);
    folder
        .run("convert products/a.obj scan.obj.gz")
        .with_code(0);
    folder
}

/// Runs commands, in which `meshwright` is the program that is tested.
fn run(folder: &Folder, commands: &str) -> Ended {
    folder.shell(&format!(
        "meshwright() {{ \"$0\" \"$@\"; }}\nset -e\n{commands}"
    ))
}

#[test]
fn every_job_of_the_book_does_what_it_says() {
    let chapter = chapter();
    let folder = folder(&chapter);
    // For each job, the files that the job writes and a part of its output.
    let expected: [(&str, &[&str], &str); 10] = [
        ("Convert a compressed scan", &["scan.glb"], "wrote scan.glb"),
        (
            "Process a folder of products",
            &["products.xml", "out/a.glb", "out/b.glb"],
            "2",
        ),
        ("Check the memory in a build", &[], "part.ron is valid"),
        (
            "See the result while editing",
            &["out/bunny.glb"],
            "wrote out/bunny.glb",
        ),
        ("Turn a model around", &["bunny.gif"], "wrote bunny.gif"),
        ("Show a change", &["change.png"], "wrote change.png"),
        ("Compare levels", &[], "MinAngle"),
        (
            "Convert without any loss",
            &["textured.glb"],
            "wrote textured.glb",
        ),
        ("Work in a pipe", &["scan.ply"], ""),
        ("Catch a regression", &["tests.xml"], "1"),
    ];
    let jobs: Vec<&str> = chapter.split("\n## ").skip(1).collect();
    assert_eq!(jobs.len(), expected.len());
    for (job, (title, files, printed)) in jobs.into_iter().zip(expected) {
        assert!(
            job.starts_with(title),
            "{title} is not the title of:\n{job}"
        );
        let commands = block(job, "sh").expect(title);
        let ended = if commands.contains("watch") {
            // The command `watch` waits for the next change until it is interrupted.
            let file = files[0];
            let ended = run(
                &folder,
                &format!(
                    "\"$0\" {} > printed & watch=$!\nuntil [ -e {file} ] && grep -q wrote printed; do sleep 0.1; done\n\
                     kill -INT $watch\nwait $watch || [ $? = 130 ]\ncat printed\n",
                    commands.trim().strip_prefix("meshwright").unwrap()
                ),
            );
            ended.with_code(0)
        } else {
            run(&folder, commands).with_code(0)
        };
        assert!(ended.stdout.contains(printed), "{title}: {ended:#?}");
        for file in files {
            assert!(folder.path(file).exists(), "{title}: {file}, {ended:#?}");
        }
    }
}

#[test]
fn the_jobs_fail_when_they_should() {
    let chapter = chapter();
    let folder = folder(&chapter);
    folder
        .run("run part.ron --set levels=4 --budget 64KiB")
        .with_code(1)
        .complains(&["budget"]);
    folder
        .run_with(
            "check - --budget 1MiB",
            "(recipe: 1, steps: [Cube(), CatmullClark(levels: 9)])",
        )
        .with_code(1)
        .complains(&["memory budget"]);
    // Without one face, the cube is not closed.
    let open = CUBE.rsplit_once("\nf").unwrap().0;
    let folder = folder
        .with("assets/bunny.obj", open)
        .with("products/b.obj", open);
    let ended = folder.run("test part.ron --junit tests.xml").with_code(1);
    let report = String::from_utf8(folder.read("tests.xml")).unwrap();
    assert!(report.contains("Closed"), "{report}\n{ended:#?}");
    folder
        .run_all(&[
            "batch",
            "part.ron",
            "--inputs",
            "products/*.obj",
            "--junit",
            "products.xml",
        ])
        .with_code(1);
    let report = String::from_utf8(folder.read("products.xml")).unwrap();
    assert!(report.contains("failures=\"1\""), "{report}");
    assert!(folder.path("out/a.glb").exists());
}
