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
    let steps = group_digits(size.steps);
    let s = if size.steps == 1 { "" } else { "s" };
    let blobs = match size.blobs {
        1 => "1 array or file".to_owned(),
        n => format!("{} arrays and files", group_digits(n)),
    };
    let bytes = readable_bytes(size.bytes);
    print(&format!(
        "folder  {shown}\n{word}  {bytes}: {steps} step{s}, {blobs}\n"
    ))?;
    Ok(true)
}
