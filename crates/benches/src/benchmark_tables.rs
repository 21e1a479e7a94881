//! Reads the results of criterion from `target/criterion`, and prints the tables for the book's chapter on benchmarks.
//! `book/benchmarks.sh` runs the benchmarks with one thread and with two threads, and then runs this program.

#![expect(clippy::print_stdout, reason = "the program prints the tables")]

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

/// A benchmark: its name, its time in seconds with one thread and with two threads, and the number of elements or bytes
/// that one run processes.
struct Row {
    name: String,
    seconds: [Option<f64>; 2],
    throughput: Value,
}

fn main() -> std::io::Result<()> {
    let mut groups: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for group in folders(Path::new("target/criterion"))? {
        for benchmark in folders(&group)? {
            let Some(id) = json(&benchmark.join("two/benchmark.json")) else {
                continue;
            };
            let text = |key: &str| id[key].as_str().unwrap_or_default().to_owned();
            let row = Row {
                name: text("function_id"),
                seconds: ["one", "two"].map(|threads| median(&benchmark.join(threads))),
                throughput: id["throughput"].clone(),
            };
            groups.entry(text("group_id")).or_default().push(row);
        }
    }
    for (group, rows) in &groups {
        println!("\n## {group}\n");
        let references: Vec<Option<f64>> = rows.iter().map(|row| reference(row, rows)).collect();
        let mut table = vec![
            [
                "benchmark",
                "one thread",
                "two threads",
                "scaling",
                "throughput, two threads",
            ]
            .map(str::to_owned)
            .to_vec(),
        ];
        for row in rows {
            let [one, two] = row.seconds;
            let ratio = |(a, b): (f64, f64)| format!("{:.1}", a / b);
            table.push(vec![
                row.name.clone(),
                one.map(milliseconds).unwrap_or_default(),
                two.map(milliseconds).unwrap_or_default(),
                one.zip(two).map(ratio).unwrap_or_default(),
                two.map(|two| rate(&row.throughput, two))
                    .unwrap_or_default(),
            ]);
        }
        if references.iter().any(Option::is_some) {
            table[0].push("time relative to copying the bytes".to_owned());
            for ((row, reference), line) in rows.iter().zip(&references).zip(&mut table[1..]) {
                let relative = row.seconds[0]
                    .zip(*reference)
                    .map(|(one, bytes)| format!("{:.1}", one / bytes));
                line.push(relative.unwrap_or_default());
            }
        }
        table.insert(1, vec!["---".to_owned(); table[0].len()]);
        for line in table {
            println!("| {} |", line.join(" | "));
        }
    }
    Ok(())
}

/// Returns the reference time of `row`: the seconds that one thread takes to copy, read or write the same bytes,
/// without other work. This time is stored in another row of the same group, which is called the reference row. The
/// name of the reference row contains `bytes alone`, and starts with `bytes` or with the first word of the name of
/// `row`. Returns `None` if there is no reference time, or if `row` is itself a reference row.
fn reference(row: &Row, rows: &[Row]) -> Option<f64> {
    let is_bytes = |row: &Row| row.name.contains("bytes alone");
    let word = row.name.split([' ', ',']).next()?;
    let bytes = |other: &&Row| {
        is_bytes(other) && (other.name.starts_with(word) || other.name.starts_with("bytes"))
    };
    rows.iter().find(bytes).filter(|_| !is_bytes(row))?.seconds[0]
}

/// Returns the folders in a folder, sorted by name.
fn folders(path: &Path) -> std::io::Result<Vec<std::path::PathBuf>> {
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(path)? {
        let path = entry?.path();
        if path.is_dir() {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

fn json(path: &Path) -> Option<Value> {
    serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()
}

/// Reads the median time of a benchmark, in seconds.
fn median(folder: &Path) -> Option<f64> {
    let nanoseconds = json(&folder.join("estimates.json"))?["median"]["point_estimate"].as_f64()?;
    Some(nanoseconds / 1e9)
}

/// Formats a time in milliseconds, with three significant digits.
fn milliseconds(seconds: f64) -> String {
    let ms = seconds * 1e3;
    let decimals = if ms < 10.0 {
        2
    } else {
        usize::from(ms < 100.0)
    };
    format!("{ms:.decimals$} ms")
}

/// Formats a rate: millions of elements per second, or megabytes per second.
fn rate(throughput: &Value, seconds: f64) -> String {
    let per_second = |key: &str| Some(throughput[key].as_f64()? / seconds / 1e6);
    match (per_second("Elements"), per_second("Bytes")) {
        (Some(elements), _) => format!("{elements:.1} M/s"),
        (_, Some(bytes)) => format!("{bytes:.0} MB/s"),
        _ => String::new(),
    }
}
