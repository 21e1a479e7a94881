//! The command line.

mod cache;
mod look;
mod many;
mod picture;
mod read;
mod run;

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

pub(crate) use cache::{CacheAction, CacheArgs, CacheCommandArgs, CacheFolder};
pub(crate) use look::{DiffArgs, Kind, SelectArgs};
pub(crate) use many::{BatchArgs, Shard, SweepArgs, TestArgs};
pub(crate) use picture::{DrawArgs, PictureArgs, PictureErrorsArgs};
pub(crate) use read::ReadArgs;
pub(crate) use run::{
    CheckArgs, RecipeArgs, ReproduceArgs, RunArgs, ShrinkArgs, UpgradeArgs, ValueArgs,
};

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
    Ops(OpsArgs),
    /// Show what a file holds
    Info(InfoArgs),
    /// Read a file and write it in another format
    Convert(ConvertArgs),
    /// Run the recipes that wrote files again, and compare the bytes
    ///
    /// A file says which recipe wrote it, with which parameters and from which inputs. The recipe is looked
    /// for below the working directory.
    Reproduce(ReproduceArgs),
    /// Draw files, or what recipes make, as an image
    Picture(PictureArgs),
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
    /// Write a new operation, a working sample with its test and its picture: a crate of its own, or with `--in` a file of
    /// a group
    NewOp(NewOpArgs),
}

#[derive(Debug, ClapArgs)]
pub(crate) struct OpsArgs {
    /// The operation to show
    pub(crate) name: Option<String>,
    /// Print the whole reference as Markdown
    #[arg(long, conflicts_with = "name")]
    pub(crate) markdown: bool,
    /// With what the recipes in this folder draw: `NAME/before.png` and `NAME/after.png` of `NAME.ron`
    #[arg(long, requires = "markdown", value_name = "FOLDER")]
    pub(crate) pictures: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct InfoArgs {
    /// A mesh, patch or curve file
    pub(crate) file: PathBuf,
    /// Show a small picture too: in pixels where the terminal can, else in characters
    #[arg(long)]
    pub(crate) picture: bool,
    #[command(flatten)]
    pub(crate) picture_errors: PictureErrorsArgs,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ConvertArgs {
    /// The file to read
    pub(crate) input: PathBuf,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// The file to write; its ending chooses the format
    pub(crate) output: PathBuf,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct NewOpArgs {
    /// The name of the operation in camel case, such as `InflateFaces`
    pub(crate) name: String,
    /// Write a file into this group of operations, such as `faces`, in place of a crate
    #[arg(long = "in", value_name = "GROUP")]
    pub(crate) group: Option<String>,
    /// Where to write the crate; for a group the root of Meshwright's workspace
    #[arg(long, default_value = ".")]
    pub(crate) dir: PathBuf,
    /// The root of Meshwright's workspace, which the crate depends on
    #[arg(
        long,
        default_value = ".",
        conflicts_with = "group",
        value_name = "DIR"
    )]
    pub(crate) meshwright: PathBuf,
}

/// An invalid combination of arguments, found after they were read: exit code 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(crate) struct WrongUsage(pub(crate) String);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people
    #[default]
    Human,
    /// One JSON object
    Json,
}

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("expected NAME=VALUE".to_owned()),
    }
}

fn size(text: &str) -> Result<u64, String> {
    let digits = text.find(|c: char| !c.is_ascii_digit());
    let (number, unit) = text.split_at(digits.unwrap_or(text.len()));
    let shift = match unit.trim() {
        "" | "B" => Some(0),
        "KiB" | "K" => Some(10),
        "MiB" | "M" => Some(20),
        "GiB" | "G" => Some(30),
        "TiB" | "T" => Some(40),
        _ => None,
    };
    let number = number.parse::<u64>().ok();
    let size = number
        .zip(shift)
        .and_then(|(n, shift)| n.checked_mul(1 << shift));
    size.ok_or_else(|| "expected a size such as 512MiB or 8GiB".to_owned())
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
    fn sizes_have_units() {
        assert_eq!(size("2KiB"), Ok(2048));
        assert_eq!(size("3G"), Ok(3 << 30));
        assert_eq!(size("17"), Ok(17));
        assert!(size("much").is_err() && size("-1").is_err() && size("99999999T").is_err());
    }
}
