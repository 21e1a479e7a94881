//! The commands on one recipe.

use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::{CacheArgs, Format, PictureErrorsArgs, assignment, size};

/// The values of a recipe's parameters.
#[derive(Clone, Debug, Default, ClapArgs)]
pub(crate) struct ValueArgs {
    /// Set a parameter of the recipe
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Take the values of one of the recipe's presets; --set goes before them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
}

impl ValueArgs {
    pub(crate) fn is_empty(&self) -> bool {
        self.set.is_empty() && self.preset.is_none()
    }
}

/// What commands that read one recipe share.
#[derive(Debug, ClapArgs)]
pub(crate) struct RecipeArgs {
    /// The recipe
    pub(crate) recipe: PathBuf,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
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
    pub(crate) picture_errors: PictureErrorsArgs,
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

#[derive(Debug, ClapArgs)]
pub(crate) struct UpgradeArgs {
    /// Recipes, or folders of recipes
    #[arg(required = true)]
    pub(crate) recipes: Vec<PathBuf>,
    /// Change nothing, and fail if there is something to rewrite
    #[arg(long)]
    pub(crate) check: bool,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ShrinkArgs {
    /// A recipe of which a step fails, such as that of a capsule
    pub(crate) recipe: PathBuf,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
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
