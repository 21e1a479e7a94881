//! `meshwright convert`: converts a file to another format. The path `-` stands for standard input or standard output.

use serde_json::json;

use crate::args::{ConvertArgs, Format};
use crate::commands::info::note_json;
use crate::output::{STAMP, print, print_error};
use crate::pipes;
use crate::scenes::read_file_or_input;

pub(crate) fn run(args: &ConvertArgs) -> anyhow::Result<bool> {
    let mut options = args.read.options();
    options.keep_vertices = true;
    let input = pipes::mesh_name(&args.input, args.from.as_deref(), "stdin", "--from")?;
    let output = pipes::mesh_name(&args.output, args.to.as_deref(), "stdout", "--to")?;
    let to_stdout = pipes::is_pipe(&args.output);
    // If the converted file goes to standard output, the report goes to standard error.
    let report = |text: &str| {
        if to_stdout {
            print_error(text);
            Ok(())
        } else {
            print(text)
        }
    };
    let (scene, mut notes) = read_file_or_input(&args.input, &input, &options)?;
    if mesh_io::keeps_vertices(&output) {
        // The reader has split non-manifold edges and vertices. In this format, the file is written with the original
        // vertices, so the user is not told about the splits.
        notes.retain(|note| !matches!(note.code, "edges-split" | "vertices-split"));
    }
    let human = args.format == Format::Human;
    for note in notes.iter().filter(|_| human) {
        report(&format!("{note}\n"))?;
    }
    let options = mesh_io::WriteOptions {
        provenance: Some(STAMP.to_owned()),
        images: args.images,
        compression: args.compress,
        quantization: args.quantize,
        weight_sets: None,
        rows: args.rows,
        strict: args.read.strict,
    };
    let written = if to_stdout {
        pipes::write_mesh(&output, &scene, &options)?
    } else {
        mesh_io::write(&store::Disk, &output, &scene, &options)
            .map_err(|error| anyhow::anyhow!("{error}"))?
    };
    if !human {
        let losses = written.losses.iter().map(|loss| {
            json!({
                "code": loss.code(),
                "object": (!loss.object.is_empty()).then_some(&loss.object), "name": loss.attribute, "count": loss.count,
                "domain": loss.domain.map(|d| d.to_string()), "message": loss.to_string(),
            })
        });
        let json = json!({
            "notes": notes.iter().map(note_json).collect::<Vec<_>>(),
            "losses": losses.collect::<Vec<_>>(),
            "wrote": written.files.iter().map(|p| p.display().to_string()).collect::<Vec<_>>(),
            "bytes": written.bytes,
            "packing": written.packing,
        });
        report(&format!("{json:#}\n"))?;
        return Ok(true);
    }
    for loss in &written.losses {
        report(&format!("{loss}\n"))?;
    }
    if let Some(packing) = &written.packing {
        report(&format!("{packing}\n"))?;
    }
    for path in &written.files {
        report(&format!("wrote {}\n", path.display()))?;
    }
    Ok(true)
}
