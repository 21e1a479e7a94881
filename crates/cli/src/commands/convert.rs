//! `meshwright convert`: reads a file and writes it in another format.

use std::path::Path;

use anyhow::Context as _;
use scene::Scene;

use crate::args::ReadArgs;
use crate::output::print;

pub(crate) fn run(input: &Path, read: &ReadArgs, output: &Path) -> anyhow::Result<bool> {
    let loaded = mesh_io::read(&store::Disk, input, &read.options())
        .map_err(|error| anyhow::anyhow!("{error}"))?;
    for note in &loaded.notes {
        print(&format!("{note}\n"))?;
    }
    let mut scene = Scene::new();
    for object in loaded.objects {
        scene
            .insert(object)
            .with_context(|| format!("cannot use {}", input.display()))?;
    }
    let provenance = format!("meshwright {}", env!("CARGO_PKG_VERSION"));
    let options = mesh_io::WriteOptions {
        provenance: Some(provenance),
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
