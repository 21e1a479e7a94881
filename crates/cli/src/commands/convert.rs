//! `meshwright convert`: converts a file to another format.

use mesh_io::Orientation;
use serde_json::json;

use crate::args::{ConvertArgs, Format};
use crate::commands::info::note_json;
use crate::output::{STAMP, print, print_json};
use crate::scenes::read_file;

pub(crate) fn run(args: &ConvertArgs) -> anyhow::Result<bool> {
    let mut options = args.read.options();
    // A conversion repairs nothing unless an option asks for it.
    options.policies.orientation = args.read.orientation.unwrap_or(Orientation::Keep);
    options.keep_vertices = true;
    let (scene, mut notes) = read_file(&args.input, &options)?;
    if mesh_io::keeps_vertices(&args.output) {
        // The file is written with the vertices and edges that were read.
        notes.retain(|note| !matches!(note.code, "edges-split" | "vertices-split"));
    }
    let human = args.format == Format::Human;
    for note in notes.iter().filter(|_| human) {
        print(&format!("{note}\n"))?;
    }
    let options = mesh_io::WriteOptions {
        provenance: Some(STAMP.to_owned()),
        images: args.images,
        compression: args.compress,
        quantization: args.quantize,
        strict: args.read.strict,
    };
    let report = mesh_io::write(&store::Disk, &args.output, &scene, &options)
        .map_err(|error| anyhow::anyhow!("{error}"))?;
    if !human {
        let losses = report.losses.iter().map(|loss| {
            json!({
                "object": loss.object, "name": loss.attribute, "count": loss.count,
                "domain": loss.domain.map(|d| d.to_string()), "message": loss.to_string(),
            })
        });
        print_json(&json!({
            "notes": notes.iter().map(note_json).collect::<Vec<_>>(),
            "losses": losses.collect::<Vec<_>>(),
            "wrote": report.files.iter().map(|p| p.display().to_string()).collect::<Vec<_>>(),
            "bytes": report.bytes,
            "packing": report.packing,
        }))?;
        return Ok(true);
    }
    for loss in &report.losses {
        print(&format!("{loss}\n"))?;
    }
    if let Some(packing) = &report.packing {
        print(&format!("{packing}\n"))?;
    }
    for path in &report.files {
        print(&format!("wrote {}\n", path.display()))?;
    }
    Ok(true)
}
