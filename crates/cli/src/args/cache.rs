//! The cache of steps on the command line.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{Format, size};

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
