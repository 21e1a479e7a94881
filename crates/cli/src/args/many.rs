//! Arguments of the commands `test`, `batch` and `sweep`.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args as ClapArgs;
use serde::{Deserialize, Serialize};

use super::{CacheArgs, DrawArgs, Format, PictureErrorsArgs, ValueArgs, size};

/// Options of the commands that run several recipes at the same time.
#[derive(Debug, ClapArgs)]
pub(crate) struct ManyArgs {
    /// Number of threads; defaults to the number of processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Maximum number of simultaneous runs, at most the number of threads; defaults to the number of threads
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Memory budget for the meshes of all simultaneous runs together, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
    /// Fail if a step loses data, unless the recipe allows the loss with `on_loss: Allow([..])`
    #[arg(long)]
    pub(crate) strict: bool,
}

impl ManyArgs {
    pub(crate) fn limits(&self) -> recipe::JobLimits {
        recipe::JobLimits {
            threads: self.threads.map_or(0, usize::from),
            jobs: self.jobs.map_or(0, usize::from),
            budget: self.budget,
        }
    }
}

#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example: meshwright test scenes --filter cube --junit tests.xml

Folders are searched recursively, except hidden folders and folders named `assets`. Two kinds of recipes
are read and listed, but not run and not counted as passed: recipes without expectations, and recipes that
other tested recipes call. If the text of such a recipe has an error, the recipe counts as failed. A
recipe whose own path is given on the command line is run even if other recipes call it."
)]
pub(crate) struct TestArgs {
    /// Recipes, or folders of recipes
    #[arg(default_value = "scenes")]
    pub(crate) paths: Vec<PathBuf>,
    /// Test only recipes whose path contains TEXT
    #[arg(long, value_name = "TEXT")]
    pub(crate) filter: Option<String>,
    /// Keep the outputs of each recipe. Each recipe has its own folder below DIR, named after the recipe
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Also write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Update the expectations in the recipes: replace the expected values (eq, is, Bounds, Digest) with the actual
    /// values, and replace the reference files of `Output` with the written files
    #[arg(long)]
    pub(crate) update: bool,
    #[command(flatten)]
    pub(crate) picture_errors: PictureErrorsArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples:
  meshwright batch clean.ron --inputs 'models/**/*.obj' --out clean --report clean/report.csv
  meshwright batch clean.ron --inputs 'models/*' --out clean --shard 1/3 --report one.json
  meshwright batch --merge one.json two.json three.json --report all.csv

If a batch was interrupted or has crashed, run the command again to resume the batch. A finished input file
is not processed again if its outputs exist, and if the recipe, the parameters, the program and the files
that the recipe reads are unchanged. The number of parts N in --shard I/N can differ from that of the earlier
command. The state of the batch is kept in DIR/batch.jsonl, where DIR is the folder given by --out. With
--shard I/N, the state is kept in DIR/batch-I-of-N.jsonl.")]
pub(crate) struct BatchArgs {
    /// The recipe
    #[arg(required_unless_present = "merge")]
    pub(crate) recipe: Option<PathBuf>,
    /// Input files, as paths or patterns: `*` and `?` match within one folder, `**` matches any number of folders
    #[arg(long, value_name = "PATTERN", num_args = 1.., required_unless_present_any = ["merge", "sets"])]
    pub(crate) inputs: Vec<String>,
    /// A file with parameter sets, as a JSON list of objects such as [{"levels": 1}, {"levels": 2}]. The recipe runs
    /// once for each set or, with --inputs, for each combination of a set and an input file. The outputs of each set
    /// are in a folder named after the number of the set
    #[arg(long, value_name = "FILE.json")]
    pub(crate) sets: Option<PathBuf>,
    /// The parameter that receives the path of the input file; required if the recipe has several parameters of type
    /// Path
    #[arg(long, value_name = "NAME", requires = "inputs")]
    pub(crate) param: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// The folder for outputs
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Write the outputs of each input file to a separate folder, named after the file
    #[arg(long)]
    pub(crate) folders: bool,
    /// Write a report with a row for each input file, as CSV, JSON or JSON Lines
    #[arg(long, value_name = "FILE.csv|.json|.jsonl")]
    pub(crate) report: Option<PathBuf>,
    /// Also write the results as JUnit XML, with a test case for each input file
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    /// Divide the input files into N parts, and process only part I. Only the path of a file (with --sets, also the
    /// number of the parameter set) decides which part processes the file
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Estimate the memory that each of N parts of the batch needs, and run nothing
    #[arg(
        long,
        value_name = "N",
        conflicts_with_all = ["junit", "shard", "retry_failed"],
        value_parser = clap::value_parser!(u32).range(1..=1_000_000),
    )]
    pub(crate) estimate: Option<u32>,
    /// Also retry files that failed in an earlier run, even if nothing has changed since that run
    #[arg(long)]
    pub(crate) retry_failed: bool,
    /// Merge the reports (.json or .jsonl) of several parts into the file that --report names, and run nothing
    #[arg(
        long,
        value_name = "REPORT",
        num_args = 1..,
        requires = "report",
        conflicts_with_all = [
            "recipe", "inputs", "sets", "param", "set", "preset", "folders", "junit", "shard", "retry_failed",
            "estimate"
        ],
    )]
    pub(crate) merge: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
}

/// One of the parts into which a list of files is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(expecting = "an object")]
pub(crate) struct Shard {
    /// The number of the part, from 1.
    pub(crate) index: u32,
    /// The number of parts.
    pub(crate) of: u32,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (index, of) = text.split_once('/').unwrap_or((text, ""));
        match (index.parse(), of.parse()) {
            (Ok(index), Ok(of)) if 1 <= index && index <= of => Ok(Self { index, of }),
            _ => Err("expected I/N with I from 1 to N, such as 1/3".to_owned()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example: meshwright sweep levels.sweep.ron --out levels.csv, with the file

  (
      sweep: 1,
      recipe: \"cow.ron\",
      over: { \"levels\": [0, 1, 2], \"ratio\": Range(from: 0.1, to: 0.5, steps: 5) },
      set: { \"smooth\": true },
      keep: [Faces, Area, MinAngle, DistanceTo(other: File(\"cow.obj\")), Seconds],
  )

The recipe runs once for each combination of the values in `over`. From run to run, the value of the last
parameter changes fastest. The field `zip` can have further lists of values, which must all have the same
length. The first values of these lists are used together, then their second values, and so on. Each
combination is a cell of the sweep. In the table, the row of a failed cell contains its error.

  meshwright sweep levels.sweep.ron --sheet levels.png --wireframe --from Front

draws the final scene of each cell. If exactly two parameters vary (all lists in `zip` count as one), the
rows are labeled with the values of the first parameter, and the columns with the values of the second.
Otherwise, the parameter values of each cell are shown below the cell. All cells share one camera, one scale
and one color range. A failed cell shows its error instead of a scene."
)]
#[command(mut_group("DrawArgs", |group| group.requires("sheet")))]
pub(crate) struct SweepArgs {
    /// The sweep file (*.sweep.ron)
    pub(crate) sweep: PathBuf,
    /// Also write the table to a file
    #[arg(long, value_name = "FILE.csv|.json")]
    pub(crate) out: Option<PathBuf>,
    /// Keep the outputs of each cell (a run with one combination of values). Each cell has its own folder below DIR,
    /// named after the number of the cell
    #[arg(long, value_name = "DIR")]
    pub(crate) keep_outputs: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Draw one image (.png) that shows the final scene of each cell (a run with one combination of values). Below each
    /// scene are the values that the sweep file lists in `keep`, as many as fit
    #[arg(long, value_name = "FILE", help_heading = SHEET)]
    pub(crate) sheet: Option<PathBuf>,
    /// Number of cells in each row; with this option, the parameter values of each cell are shown below the cell
    #[arg(
        long,
        value_name = "N",
        requires = "sheet",
        help_heading = SHEET,
        value_parser = clap::value_parser!(u32).range(1..=64),
    )]
    pub(crate) columns: Option<u32>,
    #[command(flatten, next_help_heading = SHEET)]
    pub(crate) draw: DrawArgs,
}

const SHEET: &str = "Options for drawing the sheet, as in `meshwright picture`";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_numbered_from_1() {
        assert_eq!("2/3".parse(), Ok(Shard { index: 2, of: 3 }));
        for wrong in ["0/3", "4/3", "1", "1/", "/1", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
