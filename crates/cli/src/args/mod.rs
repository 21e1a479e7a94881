//! The command line.

mod cache;
pub(crate) mod help;
mod look;
mod many;
mod picture;
mod read;
mod run;
mod values;

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use mesh_io::{Bits, Compression, Images, Quantization, Rows};

pub(crate) use cache::{CacheAction, CacheArgs, CacheCommandArgs, CacheFolder};
pub(crate) use look::{DiffArgs, Kind, SelectArgs};
pub(crate) use many::{BatchArgs, ManyArgs, Shard, SweepArgs, TestArgs};
pub(crate) use picture::{DrawArgs, PictureArgs, PictureErrorsArgs};
pub(crate) use read::ReadArgs;
pub(crate) use run::{CheckArgs, RecipeArgs, ReproduceArgs, RunArgs, ShrinkArgs, UpgradeArgs};
pub(crate) use values::ValueArgs;

/// Edit 3D meshes with recipes.
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
    /// Check a recipe without running it, and forecast mesh sizes and memory use
    Check(CheckArgs),
    /// Run a recipe again whenever it or one of its inputs is saved
    Watch(RunArgs),
    /// Run recipes as tests
    Test(TestArgs),
    /// Show what a file contains
    Info(InfoArgs),
    /// Draw files or the results of recipes as an image
    Picture(PictureArgs),
    /// Show the mesh elements that a selection matches
    Select(SelectArgs),
    /// Compare two files, or the results of two recipes
    ///
    /// The exit code is 0 if the files or results are equal, 1 if they differ and 2 if they cannot be compared.
    Diff(DiffArgs),
    /// Convert a file to another format
    Convert(ConvertArgs),
    /// Run one recipe on many files
    Batch(BatchArgs),
    /// Run one recipe with many parameter values and tabulate the results
    Sweep(SweepArgs),
    /// Open the editor, a window that turns every edit into a step of a recipe
    ///
    /// The editor is a separate program, `meshwright-viewer`.
    Edit(EditArgs),
    /// Serve Meshwright's web page to browsers on this computer
    ///
    /// The server sends the headers that a browser requires before a page can use threads. Other computers cannot
    /// connect. Ctrl-C ends the server.
    Web(WebArgs),
    /// Write a small recipe with comments, as a starting point
    New(NewArgs),
    /// List the operations or the selections, or describe one operation
    Ops(OpsArgs),
    /// List the expectations (conditions that recipes check), or describe one
    Expectations {
        /// The expectation to describe
        name: Option<String>,
    },
    /// Print the JSON schema of recipes
    Schema,
    /// Replace outdated names (such as renamed parameters) in recipes; comments and layout are kept
    Upgrade(UpgradeArgs),
    /// Check that files are reproducible: run their recipes again and compare the bytes
    ///
    /// An output file records the recipe, the parameters and the inputs that it was made from. The command searches for
    /// this recipe below the working directory.
    Reproduce(ReproduceArgs),
    /// Reduce the scene before a failing step to a small scene on which the step still fails
    Shrink(ShrinkArgs),
    /// Show or clear the step cache, which stores the results of steps for later runs
    Cache(CacheCommandArgs),
    /// Write the source of a new operation, with a test and a picture
    ///
    /// Writes a new crate. With `--in`, the command instead writes a file into a group of operations (a folder of
    /// `ops`) in Meshwright's workspace.
    NewOp(NewOpArgs),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page
    Man,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct EditArgs {
    /// A recipe, or a model that a new recipe loads
    pub(crate) file: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct WebArgs {
    /// The folder that contains the page
    #[arg(default_value = "target/web/page")]
    pub(crate) folder: PathBuf,
    /// The port; if 0, a free port is chosen
    #[arg(long, default_value_t = 8000)]
    pub(crate) port: u16,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct NewArgs {
    /// The name of the recipe, or of a model that the recipe loads. With `part` or `part.obj`, the command writes
    /// `part.ron`
    pub(crate) name: PathBuf,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct OpsArgs {
    /// The operation to describe
    pub(crate) name: Option<String>,
    /// List the selections instead of the operations
    #[arg(long, conflicts_with = "name")]
    pub(crate) selections: bool,
    /// Print the whole reference as Markdown
    #[arg(long, conflicts_with = "name")]
    pub(crate) markdown: bool,
    /// A folder with pictures for the Markdown reference: `NAME/before.png` and `NAME/after.png`, and the recipe
    /// `NAME.ron` that draws them, where NAME is the name of an operation in snake case
    #[arg(long, requires = "markdown", value_name = "FOLDER")]
    pub(crate) pictures: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t, conflicts_with_all = ["markdown", "selections"])]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct InfoArgs {
    /// A mesh, patch or curve file; `-` reads standard input
    pub(crate) file: PathBuf,
    /// The format of standard input, such as `obj` or `obj.gz`
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<String>,
    /// Also show a small picture: an image if the terminal can display images, and otherwise a drawing of characters
    #[arg(long)]
    pub(crate) picture: bool,
    #[command(flatten)]
    pub(crate) picture_errors: PictureErrorsArgs,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

// A conversion repairs nothing unless an option requests a repair.
#[derive(Debug, ClapArgs)]
#[command(mut_arg("orientation", |arg| arg.default_value("Keep")))]
pub(crate) struct ConvertArgs {
    /// The file to read; `-` reads standard input
    pub(crate) input: PathBuf,
    /// The format of standard input, such as `obj` or `obj.gz`
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<String>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// The file to write; its extension determines the format. With `-`, the file is written to standard output and the
    /// report to standard error
    pub(crate) output: PathBuf,
    /// The format of standard output, such as `ply`
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<String>,
    /// How the images of materials are written: Embed, Copy (next to the file) or Keep (only the paths); defaults to
    /// Embed for .glb files and to Copy for other files
    #[arg(long, value_name = "POLICY", value_parser = read::policy::<Images>)]
    pub(crate) images: Option<Images>,
    /// Compress the geometry of .glb and .gltf files without loss; the only codec is Meshopt
    #[arg(long, value_name = "CODEC", value_parser = read::policy::<Compression>)]
    pub(crate) compress: Option<Compression>,
    /// Store the geometry of .glb and .gltf files with fewer bits
    ///
    /// The numbers of bits default to position=16,normal=8,uv=16,color=8. Each number must be from 8 to 16.
    #[arg(
        long,
        value_name = "ATTRIBUTE=BITS,...",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "",
        value_parser = bits
    )]
    pub(crate) quantize: Option<Quantization>,
    /// The elements that the rows of a .csv file describe: Vertices, Faces or Corners; defaults to Vertices
    #[arg(long, value_name = "ELEMENTS", value_parser = read::policy::<Rows>)]
    pub(crate) rows: Option<Rows>,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct NewOpArgs {
    /// The name of the operation in camel case, such as `InflateFaces`
    pub(crate) name: String,
    /// Write a file into this group of operations, such as `faces`, instead of writing a new crate
    #[arg(long = "in", value_name = "GROUP")]
    pub(crate) group: Option<String>,
    /// The folder to write the crate to; with `--in`, the root of Meshwright's workspace
    #[arg(long, default_value = ".")]
    pub(crate) dir: PathBuf,
    /// The root of the Meshwright workspace that the new crate depends on
    #[arg(
        long,
        default_value = ".",
        conflicts_with = "group",
        value_name = "DIR"
    )]
    pub(crate) meshwright: PathBuf,
}

/// Parses the number of bits of each attribute, such as `position=14,uv=12`.
fn bits(text: &str) -> Result<Quantization, String> {
    let mut bits = Quantization::default();
    for part in text.split(',').filter(|part| !part.is_empty()) {
        let (name, number) = part
            .split_once('=')
            .ok_or_else(|| format!("expected ATTRIBUTE=BITS, found `{part}`"))?;
        let place = match name {
            "position" => &mut bits.position,
            "normal" => &mut bits.normal,
            "uv" => &mut bits.uv,
            "color" => &mut bits.color,
            _ => {
                return Err(format!(
                    "expected the attribute position, normal, uv or color, found `{name}`"
                ));
            }
        };
        let number: u32 = number
            .parse()
            .map_err(|_| format!("expected a number of bits, found `{number}`"))?;
        *place = Bits::try_from(number).map_err(|error| error.to_string())?;
    }
    Ok(bits)
}

/// An error for arguments that can be parsed but are invalid. The exit code is 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(crate) struct WrongUsage(pub(crate) String);

/// An error for invalid arguments whose problems have already been printed. The exit code is 2.
#[derive(Debug, thiserror::Error)]
#[error("invalid arguments")]
pub(crate) struct ReportedUsage;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Text for people
    #[default]
    Human,
    /// JSON for programs
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
