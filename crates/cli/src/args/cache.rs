//! Options for the step cache.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{Format, size};

/// Cache options of the commands that run recipes.
#[derive(Debug, ClapArgs)]
pub(crate) struct CacheArgs {
    #[command(flatten)]
    pub(crate) folder: CacheFolder,
    /// Run every step, and neither read nor write the cache
    #[arg(long)]
    pub(crate) no_cache: bool,
    /// Maximum size of the cache, such as 512MiB or 8GiB; if the cache is larger, the least recently used results are
    /// removed
    #[arg(long, default_value = "4GiB", value_name = "SIZE", value_parser = size)]
    pub(crate) cache_limit: u64,
}

/// The location of the cache.
#[derive(Debug, ClapArgs)]
pub(crate) struct CacheFolder {
    /// The folder of the step cache, which stores the results of steps for later runs; defaults to the folder
    /// `meshwright` in the user's cache folder
    #[arg(long, env = "MESHWRIGHT_CACHE", value_name = "DIR")]
    pub(crate) cache: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct CacheCommandArgs {
    /// What to do with the cache
    #[arg(value_enum, default_value_t)]
    pub(crate) action: CacheAction,
    #[command(flatten)]
    pub(crate) folder: CacheFolder,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CacheAction {
    /// Show the folder, its size and the number of stored steps
    #[default]
    Info,
    /// Remove all stored results
    Clear,
}
