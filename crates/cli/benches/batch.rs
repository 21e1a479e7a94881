//! Measures two things for a batch of 200 small files: how busy the processors are, and how much of the time is spent
//! in runs of the recipe.
//!
//! The input files are wavy grids of 1,600 quadrilaterals (about 100 kB of OBJ). The recipe triangulates each grid,
//! subdivides it once, computes normals and writes it as GLB. The batch runs five times with one thread, and five times
//! with all threads of the machine. Prints medians:
//!
//! - the wall time of the whole program,
//! - busy: the user and system time, divided by the product of the wall time and the number of threads,
//! - in jobs: the total time of all runs, divided by the product of the wall time and the number of threads. This total
//!   does not include the time to read and check the recipe, to compute digests, and to write the journal and the
//!   report.
//!
//! ```text
//! cargo bench -p meshwright-cli --bench batch
//! ```

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

const PROGRAM: &str = env!("CARGO_BIN_EXE_meshwright");

const RECIPE: &str = r#"(
    recipe: 1,
    params: { "model": Path(default: "none.obj") },
    steps: [
        Load(path: arg("model")),
        Triangulate,
        LoopSubdivide(levels: 1),
        VertexNormals(),
        Save(path: "{model.stem}.glb"),
    ],
)"#;

const FILES: u32 = 200;

/// Returns the text of an OBJ file with a wavy grid.
fn grid(seed: u32) -> String {
    const SIDE: u32 = 40;
    let mut text = String::new();
    for y in 0..=SIDE {
        for x in 0..=SIDE {
            let z = f64::from((x * x + 3 * y + seed) % 17) / 31.0;
            let _ = writeln!(
                text,
                "v {} {} {z:.6}",
                f64::from(x) / 7.0,
                f64::from(y) / 7.0
            );
        }
    }
    for y in 0..SIDE {
        for x in 0..SIDE {
            let a = y * (SIDE + 1) + x + 1;
            let _ = writeln!(text, "f {a} {} {} {}", a + 1, a + SIDE + 2, a + SIDE + 1);
        }
    }
    text
}

/// Returns three durations in seconds: the wall time of the batch, its processor time, and the total time of its runs.
fn measured(folder: &Path, threads: usize) -> [f64; 3] {
    let out = folder.join("out");
    let _ = std::fs::remove_dir_all(&out);
    let script = "\"$0\" batch recipe.ron --inputs 'models/*.obj' --report r.json --threads \"$1\" > log && times";
    let begin = Instant::now();
    let output = Command::new("sh")
        .args(["-c", script, PROGRAM, &threads.to_string()])
        .current_dir(folder)
        .output()
        .expect("a shell");
    let wall = begin.elapsed().as_secs_f64();
    assert!(output.status.success(), "{output:?}");
    // The shell command `times` prints the user and system time of child processes in its second line:
    // `0m1.250s 0m0.120s`.
    let text = String::from_utf8(output.stdout).expect("text");
    let seconds = |word: &str| {
        let (minutes, rest) = word.split_once('m')?;
        let seconds: f64 = rest.trim_end_matches('s').parse().ok()?;
        Some(minutes.parse::<f64>().ok()? * 60.0 + seconds)
    };
    let children = text.lines().nth(1).expect("the times of children");
    let busy = children.split_whitespace().filter_map(seconds).sum();
    let report = std::fs::read(folder.join("r.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("JSON");
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), FILES as usize);
    let in_jobs = rows.iter().filter_map(|row| row["seconds"].as_f64()).sum();
    [wall, busy, in_jobs]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    let models = folder.path().join("models");
    std::fs::create_dir(&models).expect("a folder");
    for i in 0..FILES {
        std::fs::write(models.join(format!("m{i:03}.obj")), grid(i)).expect("a file");
    }
    std::fs::write(folder.path().join("recipe.ron"), RECIPE).expect("a file");
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    for threads in [1, all] {
        let runs: Vec<[f64; 3]> = (0..5).map(|_| measured(folder.path(), threads)).collect();
        let of = |what: fn(&[f64; 3]) -> f64| median(runs.iter().map(what).collect());
        let share = 100.0 / threads as f64;
        println!(
            "{FILES} files, {threads} threads: {:.0} ms, busy {:.1} %, in jobs {:.1} %",
            1e3 * of(|[wall, _, _]| *wall),
            share * of(|[wall, busy, _]| busy / wall),
            share * of(|[wall, _, jobs]| jobs / wall),
        );
    }
}
