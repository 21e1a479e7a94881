//! The command line.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use mesh_io::{NonManifold, Orientation, Policies, ReadOptions, Unwanted};
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeOwned, IntoDeserializer};
use serde::{Deserialize, Serialize};

/// Edit 3D meshes by recipe.
#[derive(Debug, Parser)]
#[command(name = "meshwright", version, max_term_width = 100)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a recipe
    Run(RunArgs),
    /// Run a recipe again whenever it or one of its inputs is saved
    Watch(RunArgs),
    /// Check a recipe without running it, and forecast what it will make
    Check(CheckArgs),
    /// Run recipes as tests: one line each, and a summary
    Test(TestArgs),
    /// Run one recipe on many files
    Batch(BatchArgs),
    /// Run one recipe with many values of its parameters, and measure what comes out
    Sweep(SweepArgs),
    /// List the operations, or show one of them
    Ops {
        /// The operation to show
        name: Option<String>,
        /// Print the whole reference as Markdown
        #[arg(long, conflicts_with = "name")]
        markdown: bool,
    },
    /// Show what a file holds
    Info {
        /// A mesh, patch or curve file
        file: PathBuf,
        #[command(flatten)]
        read: ReadArgs,
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Read a file and write it in another format
    Convert {
        /// The file to read
        input: PathBuf,
        #[command(flatten)]
        read: ReadArgs,
        /// The file to write; its ending chooses the format
        output: PathBuf,
    },
    /// Run the recipes that wrote files again, and compare the bytes
    ///
    /// A file says which recipe wrote it, with which parameters and from which inputs. The recipe is looked
    /// for below the working directory.
    Reproduce(ReproduceArgs),
    /// Show the elements of a mesh that a selection matches
    Select(SelectArgs),
    /// Hold two files, or what two recipes make, against each other: exit code 0 if they are equal, 1 if not
    Diff(DiffArgs),
    /// Rewrite older spellings in recipes; comments and layout stay
    Upgrade(UpgradeArgs),
    /// Show where the cache is and what it holds, or empty it
    Cache(CacheCommandArgs),
    /// Make the mesh smaller on which a step of a recipe fails, and write it with the step
    Shrink(ShrinkArgs),
    /// Print the JSON schema of recipes
    Schema,
    /// Write a new operation crate: its folder, a working sample with a test, and its line in ops/all
    NewOp {
        /// The name of the operation in camel case, such as `InflateFaces`
        name: String,
        /// The root of the workspace
        #[arg(long, default_value = ".")]
        dir: PathBuf,
    },
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people
    #[default]
    Human,
    /// One JSON object
    Json,
}

/// What commands that read a file of meshes share.
#[derive(Debug, ClapArgs)]
pub(crate) struct ReadArgs {
    /// Fail where something of the file would be left out
    #[arg(long)]
    strict: bool,
    /// Where faces form no manifold: Split or Refuse
    #[arg(long, default_value = "Split", value_name = "POLICY", value_parser = policy::<NonManifold>)]
    non_manifold: NonManifold,
    /// Where neighboring faces disagree about their orientation: Orient or Keep
    #[arg(long, default_value = "Orient", value_name = "POLICY", value_parser = policy::<Orientation>)]
    orientation: Orientation,
    /// Faces with the vertices of an earlier one: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<Unwanted>)]
    duplicates: Unwanted,
    /// Faces without area: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<Unwanted>)]
    degenerate: Unwanted,
    /// Vertices that no face uses: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<Unwanted>)]
    isolated: Unwanted,
}

impl ReadArgs {
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            name: None,
            policies: Policies {
                non_manifold: self.non_manifold,
                orientation: self.orientation,
                duplicates: self.duplicates,
                degenerate: self.degenerate,
                isolated: self.isolated,
            },
            strict: self.strict,
        }
    }
}

/// A policy by the name that it has in recipes.
fn policy<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let name: StrDeserializer<serde::de::value::Error> = text.into_deserializer();
    T::deserialize(name).map_err(|error| error.to_string())
}

/// What commands that read one recipe share.
#[derive(Debug, ClapArgs)]
pub(crate) struct RecipeArgs {
    /// The recipe
    pub(crate) recipe: PathBuf,
    /// Set a parameter of the recipe
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Take the values of one of the recipe's presets; --set goes before them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// The folder for outputs
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// The memory that meshes may take, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) recipe: RecipeArgs,
    /// The number of threads; by default one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// If a step fails, write the scene before it and a recipe of the rest into this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) capsule: Option<PathBuf>,
    /// Do not hold the recipe's expectations against the result
    #[arg(long)]
    pub(crate) no_expect: bool,
    /// Print where the value of each parameter comes from, and for each step why it ran
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) recipe: RecipeArgs,
    /// Print where the value of each parameter comes from
    #[arg(long)]
    pub(crate) explain: bool,
}

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
    /// Write the values that were found into the recipes, in place of recorded ones (eq, is, Bounds, Digest)
    #[arg(long)]
    pub(crate) update: bool,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

/// Which elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    Vertices,
    Edges,
    Faces,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct SelectArgs {
    /// A file of meshes, or a recipe (*.ron): then the scene at its end
    pub(crate) file: PathBuf,
    /// A selection as in recipes, such as 'Sharp(above: 30)'
    pub(crate) selection: String,
    /// What it selects, where the selection does not tell
    #[arg(long, value_enum, value_name = "ELEMENTS")]
    pub(crate) of: Option<Kind>,
    /// Only on the object of this name; may be given more than once
    #[arg(long, value_name = "OBJECT")]
    pub(crate) on: Vec<String>,
    /// The scene of a recipe after the step of this id
    #[arg(long, value_name = "ID", conflicts_with = "before")]
    pub(crate) after: Option<String>,
    /// The scene of a recipe before the step of this id, with its random choices
    #[arg(long, value_name = "ID")]
    pub(crate) before: Option<String>,
    /// Set a parameter of the recipe
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Show so many elements of each object
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub(crate) first: usize,
    /// Show all elements
    #[arg(long)]
    pub(crate) all: bool,
    /// Print only how many there are
    #[arg(long)]
    pub(crate) count: bool,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct DiffArgs {
    /// A file of meshes, or a recipe (*.ron)
    pub(crate) first: PathBuf,
    /// Another one
    pub(crate) second: PathBuf,
    /// By how much positions and values of attributes may differ
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = not_negative)]
    pub(crate) tolerance: f64,
    /// The files are records of runs, as run --format json prints them
    #[arg(long)]
    pub(crate) runs: bool,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct UpgradeArgs {
    /// Recipes, or folders of recipes
    #[arg(required = true)]
    pub(crate) recipes: Vec<PathBuf>,
    /// Change nothing, and fail if there is something to rewrite
    #[arg(long)]
    pub(crate) check: bool,
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x >= 0.0 => Ok(x),
        _ => Err("expected a number that is not negative".to_owned()),
    }
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ShrinkArgs {
    /// A recipe of which a step fails, such as that of a capsule
    pub(crate) recipe: PathBuf,
    /// Set a parameter of the recipe
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Take the values of one of the recipe's presets; --set goes before them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// The folder for the smaller scene and its recipe
    #[arg(long, default_value = "shrunk", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// How many smaller scenes to try
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub(crate) tries: usize,
    /// The memory that meshes may take, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ReproduceArgs {
    /// Files that recipes have written
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// The recipe that has written them
    #[arg(long, value_name = "RECIPE")]
    pub(crate) recipe: Option<PathBuf>,
    /// The memory that meshes may take, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
}

/// What commands that run recipes share.
#[derive(Debug, ClapArgs)]
pub(crate) struct CacheArgs {
    #[command(flatten)]
    pub(crate) folder: CacheFolder,
    /// Run every step anew, and keep nothing
    #[arg(long)]
    pub(crate) no_cache: bool,
    /// The size below which the cache is kept, such as 512MiB or 8GiB
    #[arg(long, default_value = "4GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) cache_limit: u64,
}

/// Where the cache is.
#[derive(Debug, ClapArgs)]
pub(crate) struct CacheFolder {
    /// The folder that keeps the results of steps; by default one of the user's caches
    #[arg(long, env = "MESHWRIGHT_CACHE", value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct CacheCommandArgs {
    /// What to do
    #[arg(value_enum, default_value_t)]
    pub(crate) action: CacheAction,
    #[command(flatten)]
    pub(crate) folder: CacheFolder,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CacheAction {
    /// Show the folder, its size and the number of results
    #[default]
    Info,
    /// Remove everything that is stored
    Clear,
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
    /// Set another parameter of the recipe
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Take the values of one of the recipe's presets; --set goes before them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
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
with its error."
)]
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
}

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("expected NAME=VALUE".to_owned()),
    }
}

fn size(text: &str) -> Result<u64, String> {
    let digits = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let shift = match unit.trim() {
        "" | "B" => 0,
        "KiB" | "K" => 10,
        "MiB" | "M" => 20,
        "GiB" | "G" => 30,
        "TiB" | "T" => 40,
        _ => return Err("expected a size such as 512MiB or 8GiB".to_owned()),
    };
    number
        .parse::<u64>()
        .ok()
        .and_then(|n| n.checked_mul(1 << shift))
        .ok_or_else(|| "expected a size such as 512MiB or 8GiB".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Args::command().debug_assert();
    }

    #[test]
    fn parts_of_a_list_count_from_1() {
        assert_eq!("2/3".parse(), Ok(Shard { index: 2, of: 3 }));
        for wrong in ["0/3", "4/3", "1", "1/", "/1", "1/0", "-1/3", "a/b", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_have_units() {
        assert_eq!(size("2KiB"), Ok(2048));
        assert_eq!(size("3G"), Ok(3 << 30));
        assert_eq!(size("17"), Ok(17));
        assert!(size("much").is_err() && size("-1").is_err() && size("99999999T").is_err());
    }
}
