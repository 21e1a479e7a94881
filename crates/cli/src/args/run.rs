//! Arguments of the commands that run, check or rewrite one recipe.

use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::{CacheArgs, Format, PictureErrorsArgs, ValueArgs, size};

/// Arguments of the commands that read one recipe.
#[derive(Debug, ClapArgs)]
pub(crate) struct RecipeArgs {
    /// The recipe; `-` reads the recipe from standard input, with paths relative to the working directory
    pub(crate) recipe: PathBuf,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// The folder for outputs
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Memory budget for meshes, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
    /// Fail if a step loses data, unless the recipe allows the loss with `on_loss: Allow([..])`
    #[arg(long)]
    pub(crate) strict: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) recipe: RecipeArgs,
    /// Number of threads; defaults to the number of processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// If a step fails, write a capsule to this folder: the scene before the step, and a recipe with the remaining
    /// steps
    #[arg(long, value_name = "DIR")]
    pub(crate) capsule: Option<PathBuf>,
    /// Do not check the recipe's expectations
    #[arg(long)]
    pub(crate) no_expect: bool,
    /// Print where each parameter value comes from, the `note` of each step, and for each step that runs, why its
    /// result is not taken from the cache
    #[arg(long)]
    pub(crate) explain: bool,
    #[command(flatten)]
    pub(crate) picture_errors: PictureErrorsArgs,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) recipe: RecipeArgs,
    /// Print where each parameter value comes from, and the `note` of each step
    #[arg(long)]
    pub(crate) explain: bool,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct UpgradeArgs {
    /// Recipes, or folders of recipes
    #[arg(required = true)]
    pub(crate) recipes: Vec<PathBuf>,
    /// Change no files, and fail if a recipe would be rewritten
    #[arg(long)]
    pub(crate) check: bool,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ShrinkArgs {
    /// A recipe with a failing step, such as a recipe that `meshwright run --capsule` writes
    pub(crate) recipe: PathBuf,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// The folder for the reduced scene and its recipe
    #[arg(long, default_value = "shrunk", value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Maximum number of smaller scenes to try
    #[arg(long, default_value_t = 1000, value_name = "N")]
    pub(crate) tries: usize,
    /// Memory budget for meshes, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ReproduceArgs {
    /// Output files of recipes
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// The recipe that wrote the files; if omitted, the program searches for it
    #[arg(long, value_name = "RECIPE")]
    pub(crate) recipe: Option<PathBuf>,
    /// Memory budget for meshes, such as 512MiB or 8GiB
    #[arg(long, default_value = "8GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) budget: u64,
}
