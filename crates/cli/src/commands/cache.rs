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
    let (size, word) = match args.action {
        CacheAction::Info => (cache.size(), "holds"),
        CacheAction::Clear => (cache.clear(), "removed"),
    };
    let size = size.with_context(|| format!("cannot access the cache folder {shown}"))?;
    if args.format == Format::Json {
        print_json(&serde_json::json!({
            "folder": shown,
            "action": if word == "holds" { "info" } else { "clear" },
            "bytes": size.bytes,
            "steps": size.steps,
            "blobs": size.blobs,
        }))?;
        return Ok(true);
    }
    let [steps, blobs] = [size.steps, size.blobs].map(group_digits);
    let s = if size.steps == 1 { "" } else { "s" };
    let bytes = readable_bytes(size.bytes);
    print(&format!(
        "folder  {shown}\n{word}  {bytes}: {steps} step{s}, {blobs} arrays and files\n"
    ))?;
    Ok(true)
}
