//! Batches that are divided between machines, and their merged reports.

use super::*;

#[test]
fn parts_are_disjoint_and_merged_they_are_the_whole() {
    let folder = with_models(20).with("models/broken.obj", "f 1 2 3\n");
    for i in 1..=3 {
        let ended = batch(&folder, &format!("--shard {i}/3 --report part{i}.jsonl"));
        assert!(
            ended
                .stdout
                .contains(&format!("; part {i}/3 of 21 files\n")),
            "{ended:#?}"
        );
    }
    let part = |i: usize| {
        let text = String::from_utf8(folder.read(&format!("part{i}.jsonl"))).unwrap();
        let rows = text.lines().skip(1);
        let input = |line: &str| serde_json::from_str::<Json>(line).unwrap()["input"].to_string();
        rows.map(input).collect::<BTreeSet<String>>()
    };
    let parts = [part(1), part(2), part(3)];
    assert_eq!(parts.iter().map(BTreeSet::len).sum::<usize>(), 21);
    assert_eq!(parts.concat_all().len(), 21);

    // `part1.jsonl` is given twice. The merged report contains each row of this file only once.
    folder
        .run("batch --merge part3.jsonl part1.jsonl part2.jsonl part1.jsonl --report all.json")
        .with_code(1)
        .prints(&["4 reports, 21 files: 20 ok, 1 failed, 0 not processed\n"]);
    fs::rename(folder.path("out"), folder.path("parts")).unwrap();
    batch(&folder, "--report whole.json").with_code(1);
    assert_eq!(report(&folder, "all.json"), report(&folder, "whole.json"));

    folder
        .run("batch --merge part3.jsonl part1.jsonl --report some.json")
        .with_code(1)
        .complains(&["error: the report of part 2/3 of the batch is missing\n"]);
    assert_eq!(
        report(&folder, "some.json")["missing_shards"],
        serde_json::json!([2])
    );
}

#[test]
fn a_batch_is_resumed_with_a_different_number_of_parts() {
    let folder = with_models(12).with("models/broken.obj", "f 1 2 3\n");
    let kept = |arguments: &str| {
        let ended = batch(&folder, arguments);
        assert!(!ended.stdout.contains("models/"), "{ended:#?}");
        assert!(ended.stdout.contains("finished in earlier runs"));
    };
    batch(&folder, "").with_code(1);
    for part in ["1/2", "2/2", "3/3"] {
        kept(&format!("--shard {part}"));
    }
    // A batch with `levels=2` replaces all outputs. Therefore, a later batch without `levels=2` processes all files
    // again.
    for part in ["1/2", "2/2"] {
        batch(&folder, &format!("--set levels=2 --shard {part}"));
    }
    kept("--set levels=2");
    let ended = batch(&folder, "").with_code(1);
    assert!(!ended.stdout.contains("earlier runs"), "{ended:#?}");
    kept("--shard 1/3");
    kept("");
}

trait ConcatAll {
    fn concat_all(&self) -> BTreeSet<String>;
}

impl ConcatAll for [BTreeSet<String>; 3] {
    fn concat_all(&self) -> BTreeSet<String> {
        self.iter().flatten().cloned().collect()
    }
}

#[test]
fn adding_a_file_moves_no_file_to_a_different_part() {
    let folder = with_models(20);
    let part = |folder: &Folder| {
        batch(folder, "--shard 1/3 --report p.json").with_code(0);
        let report = report(folder, "p.json");
        let inputs = column(&report, "state")
            .into_iter()
            .map(|(input, _)| input.to_owned());
        inputs.collect::<BTreeSet<String>>()
    };
    let before = part(&folder);
    let folder = folder
        .with("models/a.obj", tetrahedron(1))
        .with("models/m0005.obj", tetrahedron(1));
    let after = part(&folder);
    assert!(after.is_superset(&before) && after.len() <= before.len() + 2);
}

#[test]
fn contradicting_reports_are_not_merged() {
    let folder = with_models(2);
    batch(&folder, "--report a.json").with_code(0);
    let changed = String::from_utf8(folder.read("a.json")).unwrap();
    let changed = changed.replacen("\"faces\": 16", "\"faces\": 17", 1);
    let folder = folder.with("b.json", changed);
    folder
        .run("batch --merge a.json b.json --report c.json")
        .with_code(1)
        .complains(&[
            "error: models/m000.obj is ok (digest ",
            "a.json and ok",
            "b.json\n",
            "1 contradiction between the reports, so no merged report was written",
        ]);
    assert!(!folder.path("c.json").exists());

    batch(&folder, "--set levels=2 --report d.json").with_code(0);
    let differ = folder
        .run("batch --merge a.json d.json --report c.json")
        .with_code(1);
    assert!(
        differ.stderr.contains("a.json and d.json have different "),
        "{differ:#?}"
    );
    for (reports, message) in [
        ("a.csv", "cannot read"),
        (
            "recipe.ron",
            "expected a report with the extension .csv, .json or .jsonl",
        ),
        ("none.json", "cannot read none.json"),
    ] {
        let ended = folder
            .run(&format!("batch --merge {reports} --report c.json"))
            .with_code(1);
        let is_table =
            reports == "a.csv" && ended.stderr.contains("reports in .csv cannot be merged");
        assert!(is_table || ended.stderr.contains(message), "{ended:#?}");
    }
}
