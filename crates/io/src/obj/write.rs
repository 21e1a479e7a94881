//! Writes the objects of a scene to an OBJ file and its material library.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use glam::DVec3;
use mesh::Mesh;
use scene::{Geometry, Object, Scene};
use store::Store;

use super::body::MeshBody;
use super::library::{Library, push_name, push_values, write_library};
use super::states::{TextState, fit_line};
use crate::decimal::push_whole;
use crate::error::{Unwritable, WriteError};
use crate::loss::Losses;
use crate::save::{Block, Content, save};
use crate::writing::{dense, push_comment};
use crate::{Format, WriteOptions, WriteReport, fail_if_lost, gzip};

/// Writes the image files in `images`, then the material library if there are materials, and finally the OBJ file with
/// `scene`.
///
/// # Errors
///
/// Returns an error if an object is neither a mesh nor polylines, or the files cannot be written.
pub(crate) fn write(
    store: &dyn Store,
    path: &Path,
    scene: &Scene,
    images: Vec<(PathBuf, Content<'static>)>,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let shapes = scene.objects().iter().map(Shape::of);
    let shapes: Result<Vec<Shape>, _> = shapes.collect();
    let shapes = shapes.map_err(|why| why.in_file(path))?;
    let mut losses = Vec::new();
    let mut library = Library::default();
    for object in scene.objects() {
        library.add(object, &mut Losses::of(&object.name, &mut losses));
    }
    let mut head = Vec::new();
    push_comment(&mut head, "#", options.provenance.as_deref());
    let library_path = gzip::plain(path).with_extension("mtl");
    if let (false, Some(file_name)) = (library.materials.is_empty(), library_path.file_name()) {
        push_name(&mut head, "mtllib", &file_name.to_string_lossy());
    }

    let several = scene.objects().len() > 1;
    let mut blocks: Vec<Block> = vec![Box::new(move |out| out.extend_from_slice(&head))];
    let mut before = TextState::default();
    for (i, object) in scene.objects().iter().enumerate() {
        let mut losses = Losses::of(&object.name, &mut losses);
        if several {
            let name = fit_line(&object.name);
            let renamed = usize::from(*name != object.name);
            losses.add(None, "name", renamed, format!("written as `{name}`"));
            let block = move |out: &mut Vec<u8>| push_name(out, "o", &name);
            blocks.push(Box::new(block));
        }
        match &shapes[i] {
            Shape::Mesh(mesh) => {
                let places = &library.indices[i];
                let body = MeshBody::new(mesh, places, several, &library, before, &mut losses);
                before = body.after();
                body.add_blocks(&mut blocks);
            }
            Shape::Polylines(lines) => polylines(lines, &mut before, &mut blocks),
        }
    }

    fail_if_lost(path, options, &losses)?;
    let mut files: Vec<(PathBuf, Content)> = Vec::new();
    files.extend(images);
    if !library.materials.is_empty() {
        let bytes = write_library(&library.materials, options.provenance.as_deref());
        files.push((library_path, Content::Bytes(bytes)));
    }
    files.push((path.to_path_buf(), Content::Blocks(blocks)));
    let (files, bytes) = save(store, files)?;
    Ok(WriteReport {
        files,
        bytes,
        losses,
        packing: None,
    })
}

/// The kinds of geometry that OBJ can store.
enum Shape<'a> {
    /// A mesh whose arrays have no gaps from removed elements.
    Mesh(Box<Cow<'a, Mesh>>),
    Polylines(&'a [Vec<DVec3>]),
}

impl<'a> Shape<'a> {
    fn of(object: &'a Object) -> Result<Self, Unwritable> {
        match &object.geometry {
            Geometry::Mesh(mesh) => Ok(Self::Mesh(Box::new(dense(mesh)))),
            Geometry::Polylines(lines) => Ok(Self::Polylines(lines)),
            Geometry::Patches(_) | Geometry::Curve(_) => Err(Unwritable::kind(Format::Obj, object)),
        }
    }
}

/// Adds the blocks of text for polylines.
fn polylines<'a>(lines: &'a [Vec<DVec3>], before: &mut TextState, blocks: &mut Vec<Block<'a>>) {
    /// The number of polylines in a block of the text.
    const BLOCK: usize = 1024;
    for lines in lines.chunks(BLOCK) {
        blocks.push(Box::new(move |out| {
            for point in lines.iter().flatten() {
                push_values(out, "v", &point.to_array());
            }
        }));
    }
    for lines in lines.chunks(BLOCK) {
        let first = before.counts[0];
        before.counts[0] += lines.iter().map(Vec::len).sum::<usize>();
        blocks.push(Box::new(move |out| {
            let mut number = first;
            for line in lines.iter().filter(|line| !line.is_empty()) {
                out.push(if line.len() < 2 { b'p' } else { b'l' });
                for _ in line {
                    number += 1;
                    out.push(b' ');
                    push_whole(out, number);
                }
                out.push(b'\n');
            }
        }));
    }
}
