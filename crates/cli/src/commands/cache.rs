//! `meshwright cache`: shows or clears the step cache.

use ::cache::{Cache, DEFAULT_LIMIT};
use anyhow::Context as _;
use op::readable_bytes;

use crate::args::{CacheAction, CacheCommandArgs, Format};
use crate::cache::folder;
use crate::output::{group_digits, print, print_json};

pub(crate) fn run(args: &CacheCommandArgs) -> anyhow::Result<bool> {
    let cache = Cache::new(folder(&args.folder)?, DEFAULT_LIMIT, "");
    let shown = cache.folder().display().to_string();
    let (size, action) = match args.action {
        CacheAction::Info => (cache.size(), "info"),
        CacheAction::Clear => (cache.clear(), "clear"),
    };
    let size = size.with_context(|| format!("cannot access the cache folder {shown}"))?;
    if args.format == Format::Json {
        print_json(&serde_json::json!({
            "folder": shown,
            "action": action,
            "bytes": size.bytes,
            "steps": size.steps,
            "blobs": size.blobs,
        }))?;
        return Ok(true);
    }
    let steps = match size.steps {
        1 => "1 step".to_owned(),
        n => format!("{} steps", group_digits(n)),
    };
    let blobs = match size.blobs {
        1 => "1 array or file".to_owned(),
        n => format!("{} arrays and files", group_digits(n)),
    };
    let bytes = readable_bytes(size.bytes);
    print(&match args.action {
        CacheAction::Info => {
            format!("the cache folder {shown} holds {bytes}: {steps}, {blobs}\n")
        }
        CacheAction::Clear => {
            format!("removed {bytes} from the cache folder {shown}: {steps}, {blobs}\n")
        }
    })?;
    Ok(true)
}
