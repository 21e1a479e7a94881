//! Opens the step cache according to the command line.

use std::path::{Path, PathBuf};

use ::cache::{Cache, Caching};
use anyhow::Context as _;
use etcetera::BaseStrategy as _;

use crate::args::{CacheArgs, CacheFolder};

/// Opens the step cache. Returns `None` with `--no-cache`.
///
/// # Errors
///
/// Returns an error if no folder is given and the user's cache folder cannot be determined.
pub(crate) fn open(args: &CacheArgs) -> anyhow::Result<Option<Cache>> {
    if args.no_cache {
        return Ok(None);
    }
    let folder = folder(&args.folder)?;
    Ok(Some(Cache::new(folder, args.cache_limit, program())))
}

/// Returns the folder of the cache: the given folder or, if none is given, `meshwright` in the user's cache folder.
pub(crate) fn folder(args: &CacheFolder) -> anyhow::Result<PathBuf> {
    if let Some(folder) = &args.cache {
        return Ok(folder.clone());
    }
    let user = etcetera::choose_base_strategy().context(
        "cannot determine the user's cache folder: set a folder with --cache, or use --no-cache",
    )?;
    Ok(user.cache_dir().join("meshwright"))
}

/// Returns cache settings for a run whose final scene is not needed.
pub(crate) fn caching_for<'a>(cache: &'a Cache, recipe: &'a Path) -> Caching<'a> {
    Caching {
        cache,
        recipe: Some(recipe),
        want_scene: false,
    }
}

/// Returns a warning that says why the cache cannot be used.
pub(crate) fn warning(problem: &str) -> String {
    format!("warning: {problem}; the program continues without the cache\n")
}

/// Returns the version of the program and the digest of its executable file. A stored result is used only if it was
/// computed by the same version and the same executable file. A different build can contain a changed operation.
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
