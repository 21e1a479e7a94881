//! `meshwright convert`: converts a file to another format.

use crate::args::ConvertArgs;
use crate::output::{STAMP, print};
use crate::scenes::read_file;

pub(crate) fn run(args: &ConvertArgs) -> anyhow::Result<bool> {
    let (scene, notes) = read_file(&args.input, &args.read.options())?;
    for note in &notes {
        print(&format!("{note}\n"))?;
    }
    let options = mesh_io::WriteOptions {
        provenance: Some(STAMP.to_owned()),
        images: args.images,
    };
    let report = mesh_io::write(&store::Disk, &args.output, &scene, &options)
        .map_err(|error| anyhow::anyhow!("{error}"))?;
    for loss in &report.losses {
        print(&format!("{loss}\n"))?;
    }
    for path in &report.files {
        print(&format!("wrote {}\n", path.display()))?;
    }
    Ok(true)
}
