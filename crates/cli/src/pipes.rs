//! Standard input and standard output in place of files: the path `-`.

use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context as _;
use engine::Source;
use mesh::{Domain, MATERIAL, counted};
use mesh_io::{Format, Loss, ReadOptions, WriteOptions, WriteReport};
use ron_tree::MAX_BYTES;
use scene::{Geometry, Scene};
use store::{Disk, Memory, Store as _};

use crate::args::WrongUsage;

/// The maximum size of a mesh file on standard input, in bytes. The size of the data is not known before all data is
/// read. Without a limit, the data could fill the memory.
const MAX_INPUT: u64 = 1 << 32;

/// Whether a path stands for standard input or standard output. The path of a file that has the name `-` is `./-`.
pub(crate) fn is_pipe(path: &Path) -> bool {
    path == Path::new("-")
}

/// Returns the path of a recipe for messages and for the names of output files. If the recipe is read from standard
/// input, this is `stdin.ron`.
pub(crate) fn recipe_name(path: &Path) -> &Path {
    if is_pipe(path) {
        Path::new("stdin.ron")
    } else {
        path
    }
}

/// Reads a recipe from standard input. Paths in the recipe are relative to the working directory.
pub(crate) fn read_recipe() -> anyhow::Result<Source> {
    let name = recipe_name(Path::new("-"));
    let mut bytes = Vec::new();
    let read = io::stdin()
        .take(MAX_BYTES as u64 + 1)
        .read_to_end(&mut bytes);
    read.context("cannot read standard input")?;
    Ok(Source::from_bytes(name, bytes)?)
}

/// Fails if the path is `-`. `command` is the name of the command, which accepts only files.
pub(crate) fn refuse(path: &Path, command: &str) -> anyhow::Result<()> {
    if is_pipe(path) {
        let message = format!(
            "`{command}` cannot use standard input or output: write the path of a file instead of `-`"
        );
        return Err(WrongUsage(message).into());
    }
    Ok(())
}

/// Returns a path that names a mesh file in messages. The extension of this path determines the format of the file. For
/// a file, the result is `path` itself. For a stream, the result is a name that stands for the stream, such as
/// `stdin.obj` for the arguments `- --from obj`. `pipe` is the name of the stream. `option` is the command-line option
/// that sets the format of the stream.
///
/// # Errors
///
/// Returns [`WrongUsage`] if the format of a stream is missing or unknown, or if a format is given although the path is
/// a file.
pub(crate) fn mesh_name(
    path: &Path,
    format: Option<&str>,
    pipe: &str,
    option: &str,
) -> anyhow::Result<PathBuf> {
    let message = match (is_pipe(path), format) {
        (false, None) => return Ok(path.to_owned()),
        (false, Some(_)) => format!(
            "{option} applies only to `-`: the extension of {} determines its format",
            path.display()
        ),
        (true, None) => format!(
            "`-` has no extension that determines the file format: name the format with an option, such as {option} obj"
        ),
        (true, Some(format)) => {
            let extension = format.trim_start_matches('.').to_ascii_lowercase();
            let name = PathBuf::from(format!("{pipe}.{extension}"));
            if Format::from_path(&name).is_some() {
                return Ok(name);
            }
            let known = Format::readable_extensions().replace('.', "");
            format!("{option} {format}: expected one of {known}, or one of them with `.gz`")
        }
    };
    Err(WrongUsage(message).into())
}

/// Reads a mesh file from standard input. `name` is the path that [`mesh_name`] returned. It determines the format and
/// is used in messages.
pub(crate) fn read_mesh(name: &Path, options: &ReadOptions) -> anyhow::Result<mesh_io::Loaded> {
    let bytes = read_up_to(io::stdin(), MAX_INPUT).context("cannot read standard input")?;
    mesh_io::read_bytes(&Disk, name, bytes, options).map_err(|error| anyhow::anyhow!("{error}"))
}

/// Reads a stream to its end.
///
/// # Errors
///
/// Returns an error if reading the stream fails, or if the stream has more than `most` bytes.
fn read_up_to(stream: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let message = format!("it has more than {}", op::readable_bytes(most));
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// Writes a scene to standard output. `name` is the path that [`mesh_name`] returned, and determines the format. If the
/// format is OBJ, materials are lost, because they need a second file.
///
/// # Errors
///
/// Returns an error if the scene cannot be written in this format, or would need several files.
pub(crate) fn write_mesh(
    name: &Path,
    scene: &Scene,
    options: &WriteOptions,
) -> anyhow::Result<WriteReport> {
    let format = Format::from_path(name);
    if format == Some(Format::Gltf) {
        let message = "a glTF file needs a second file, but standard output takes only one file: use --to glb";
        return Err(WrongUsage(message.to_owned()).into());
    }
    let mut scene = scene.clone();
    let mut losses = Vec::new();
    if format == Some(Format::Obj) {
        losses = remove_materials(&mut scene);
        let lost: Vec<String> = losses.iter().map(ToString::to_string).collect();
        anyhow::ensure!(
            !options.strict || losses.is_empty(),
            "{}: strict writing does not allow any loss: {}",
            name.display(),
            lost.join("; ")
        );
    }
    let memory = Memory::default();
    let mut report = mesh_io::write(&memory, name, &scene, options)
        .map_err(|error| anyhow::anyhow!("{error}"))?;
    let n = report.files.len();
    anyhow::ensure!(
        n == 1,
        "the output needs {}, but standard output takes only one file: \
         write to a file, or use --to glb without --images",
        counted(n, "file")
    );
    let bytes = memory.read(name)?;
    let mut out = io::stdout().lock();
    out.write_all(&bytes)?;
    out.flush()?;
    report.losses.splice(..0, losses);
    report.files.clear();
    Ok(report)
}

/// Removes the materials of all objects, and returns a loss for each object that had materials.
fn remove_materials(scene: &mut Scene) -> Vec<Loss> {
    let names: Vec<String> = scene.objects().iter().map(|o| o.name.clone()).collect();
    let mut losses = Vec::new();
    for object in names {
        let Some((geometry, materials)) = scene.parts_mut(&object) else {
            continue;
        };
        if materials.is_empty() {
            continue;
        }
        let count = std::mem::take(materials).len();
        if let Geometry::Mesh(mesh) = geometry {
            Arc::make_mut(mesh).remove_column(Domain::Face, MATERIAL.name);
        }
        losses.push(Loss {
            object,
            domain: None,
            attribute: "materials".to_owned(),
            count,
            reason:
                "OBJ stores materials in a second file, but standard output takes only one file"
                    .to_owned(),
        });
    }
    losses
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_read_up_to_a_limit() {
        assert_eq!(read_up_to(&b"abc"[..], 3).unwrap(), b"abc");
        let error = read_up_to(io::repeat(0), 1000).unwrap_err();
        assert_eq!(error.to_string(), "it has more than 1000 bytes");
    }
}
