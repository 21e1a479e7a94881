//! The commands that run many recipes, or one many times.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args as ClapArgs;
use serde::{Deserialize, Serialize};

use super::{CacheArgs, DrawArgs, Format, PictureErrorsArgs, ValueArgs, size};

/// What commands that run many recipes at once share.
#[derive(Debug, ClapArgs)]
pub(crate) struct ManyArgs {
    /// The number of threads; by default one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Most runs at once; by default one for each thread, and never more
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// The memory that the meshes of all runs at once may take, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
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

Folders are searched with all folders in them, but for hidden ones and those named `assets`. Recipes
without expectations, and parts that other recipes there call, are read and listed, but neither run nor
counted as passed. A recipe that is named itself is run, whoever calls it."
)]
pub(crate) struct TestArgs {
    /// Recipes, or folders of recipes
    #[arg(default_value = "scenes")]
    pub(crate) paths: Vec<PathBuf>,
    /// Only recipes with this text in their path
    #[arg(long, value_name = "TEXT")]
    pub(crate) filter: Option<String>,
    /// Keep outputs, each recipe's in a folder of its name below this one
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write the results as JUnit XML too
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Write the values that were found into the recipes, in place of recorded ones (eq, is, Bounds, Digest), and
    /// the files that outputs are held against (Output)
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

A batch that was ended, even by a crash, goes on where it was when it is called again: files that are
done, and did not change, are not done again. The journal of that is FOLDER/batch.jsonl.")]
pub(crate) struct BatchArgs {
    /// The recipe
    #[arg(required_unless_present = "merge")]
    pub(crate) recipe: Option<PathBuf>,
    /// The files, as paths or patterns: `*` and `?` stay within a folder, `**` goes into folders
    #[arg(long, value_name = "PATTERN", num_args = 1.., required_unless_present = "merge")]
    pub(crate) inputs: Vec<String>,
    /// The parameter of type Path that gets the files, if the recipe has several
    #[arg(long, value_name = "NAME")]
    pub(crate) param: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// The folder for outputs
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Put the outputs of each file into a folder of its own, named as the file
    #[arg(long)]
    pub(crate) folders: bool,
    /// Write a row for each file, as a table or as JSON
    #[arg(long, value_name = "FILE.csv|.json|.jsonl")]
    pub(crate) report: Option<PathBuf>,
    /// Do the I-th of N parts of the files; a file is always in the same part
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Try files again that failed before
    #[arg(long)]
    pub(crate) retry_failed: bool,
    /// Join the reports (.json or .jsonl) of parts, and run nothing
    #[arg(
        long,
        value_name = "REPORT",
        num_args = 1..,
        requires = "report",
        conflicts_with_all = ["recipe", "inputs", "param", "set", "preset", "folders", "shard", "retry_failed"],
    )]
    pub(crate) merge: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
}

/// One of several parts of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub(crate) struct Shard {
    /// Which part, from 1.
    pub(crate) index: u32,
    /// Of how many.
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
      keep: [Faces, Area, MinAngle, DistanceTo(File(\"cow.obj\")), Seconds],
  )

Every value of the first parameter meets every value of the second, and so on; the last one changes
first. Lists under `zip` in place of `over` go together, value by value. A cell that fails is a row
with its error.

  meshwright sweep levels.sweep.ron --sheet levels.png --wireframe --from Front

draws the scene at the end of each cell. Where two parameters change, the values of the first stand beside
rows and those of the second above columns; else each cell has its values below it. All cells are seen by
one camera in one scale, and numbers in the same colors. A cell that fails is an empty place with its error."
)]
#[command(mut_group("DrawArgs", |group| group.requires("sheet")))]
pub(crate) struct SweepArgs {
    /// The sweep
    pub(crate) sweep: PathBuf,
    /// Write the table to a file too
    #[arg(long, value_name = "FILE.csv|.json")]
    pub(crate) out: Option<PathBuf>,
    /// Keep the outputs of each cell in a folder of its number below this one
    #[arg(long, value_name = "DIR")]
    pub(crate) keep_outputs: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) many: ManyArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Draw the scenes of all cells into one image (.png), with what is kept of each if that fits
    #[arg(long, value_name = "FILE", help_heading = SHEET)]
    pub(crate) sheet: Option<PathBuf>,
    /// How many cells stand in a row, each with its values below it
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

const SHEET: &str = "The sheet, as `meshwright picture` draws";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_list_count_from_1() {
        assert_eq!("2/3".parse(), Ok(Shard { index: 2, of: 3 }));
        for wrong in ["0/3", "4/3", "1", "1/", "/1", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
