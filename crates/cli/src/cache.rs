//! The cache of steps as the command line asks for it.

use std::path::{Path, PathBuf};

use ::cache::{Cache, Caching};
use anyhow::Context as _;
use etcetera::BaseStrategy as _;

use crate::args::{CacheArgs, CacheFolder};

/// The cache of a command; `None` if it is to run without one.
///
/// # Errors
///
/// If no folder is given and the user has none for caches.
pub(crate) fn open(args: &CacheArgs) -> anyhow::Result<Option<Cache>> {
    if args.no_cache {
        return Ok(None);
    }
    let folder = folder(&args.folder)?;
    Ok(Some(Cache::new(folder, args.cache_limit, program())))
}

/// The folder of the cache: the one that is given, or `meshwright` in the user's folder for caches.
pub(crate) fn folder(args: &CacheFolder) -> anyhow::Result<PathBuf> {
    if let Some(folder) = &args.cache {
        return Ok(folder.clone());
    }
    let user = etcetera::choose_base_strategy().context(
        "cannot tell where the user's caches are: say it with --cache, or use --no-cache",
    )?;
    Ok(user.cache_dir().join("meshwright"))
}

/// How a run of a recipe uses the cache: no scene is wanted for its own sake.
pub(crate) fn using<'a>(cache: &'a Cache, recipe: &'a Path) -> Caching<'a> {
    Caching {
        cache,
        recipe: Some(recipe),
        want_scene: false,
    }
}

pub(crate) fn warning(problem: &str) -> String {
    format!("warning: {problem}; going on without it\n")
}

/// The version of the program and the digest of its file: whoever changes an operation and builds the program anew
/// is not given results of before.
fn program() -> String {
    let version = env!("CARGO_PKG_VERSION");
    let file = std::env::current_exe().and_then(std::fs::read);
    let build = file.map_or_else(
        |_| "unknown".to_owned(),
        |bytes| {
            let digest = blake3::Hasher::new().update_rayon(&bytes).finalize();
            digest.to_hex()[..32].to_owned()
        },
    );
    format!("meshwright {version}, build {build}")
}
