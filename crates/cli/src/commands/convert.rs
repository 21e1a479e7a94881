//! `meshwright convert`: reads a file and writes it in another format.

use std::path::Path;

use crate::args::ReadArgs;
use crate::output::{STAMP, print};
use crate::scenes::read_file;

pub(crate) fn run(input: &Path, read: &ReadArgs, output: &Path) -> anyhow::Result<bool> {
    let (scene, notes) = read_file(input, &read.options())?;
    for note in &notes {
        print(&format!("{note}\n"))?;
    }
    let options = mesh_io::WriteOptions {
        provenance: Some(STAMP.to_owned()),
    };
    let report = mesh_io::write(&store::Disk, output, &scene, &options)
        .map_err(|error| anyhow::anyhow!("{error}"))?;
    for loss in &report.losses {
        print(&format!("{loss}\n"))?;
    }
    for path in &report.files {
        print(&format!("wrote {}\n", path.display()))?;
    }
    Ok(true)
}
