//! Reads and writes OBJ, glTF, PLY, STL, OFF, Bezier and Meshwright scene files. Reads COLLADA files, and writes CSV
//! and NPZ files.
//!
//! [`read()`] reads the objects of a file, and [`write()`] writes a scene to files. [`peek()`] returns the objects in a
//! file with their kinds and element counts, without building meshes. The extension of the file name determines the
//! [`Format`]:
//!
//! | extension | content | module |
//! | --- | --- | --- |
//! | `.obj` (and `.mtl`) | polygons, polylines, groups, materials | `obj` |
//! | `.gltf`, `.glb` | triangles, materials, placed objects | `gltf` |
//! | `.ply` | polygons with any properties | `ply` |
//! | `.stl` | triangles | `stl` |
//! | `.off` | polygons | `off` |
//! | `.dae` (read only) | polygons, materials, placed objects | `dae` |
//! | `.mws` | a complete Meshwright scene | `mws` |
//! | `.bez` | Bezier patches | `bez` |
//! | `.bzc` | a Bezier curve | `bez` |
//! | `.csv` (write only) | a table of vertices, faces or corners | `csv` |
//! | `.npz` (write only) | the arrays of a mesh for `NumPy` | `npz` |
//! | `.gz` after one of these extensions, except `.glb`, `.mws` and `.npz` | the same, compressed with gzip | `gzip` |
//!
//! Every loss of content is reported, except the loss of comments and headers of files. Content that a reader leaves
//! out or changes is reported as a [`Note`] with a count. Content that a format cannot store is reported as a [`Loss`].
//! Errors in the syntax of a file have a position: the line and the column in a text file, the byte offset in a binary
//! file, or the JSON pointer in a glTF file. If a file refers to other files, their paths must not lead out of the
//! folder of this file. A file is written completely or not at all.
//!
//! The source code of each mesh format is in its own folder. The `mod.rs` of the folder lists how each part of a file
//! is converted. Most of these folders have a module `read`, which converts bytes to polygons, and a module `write`.
//! For example, the faces of an OBJ file are read in `obj/statement.rs`, and those of a glTF file in
//! `gltf/primitives.rs`. All formats use these modules:
//!
//! | module | purpose |
//! | --- | --- |
//! | `text` | words and numbers of a text file, with their positions; `decimal` reads and writes numbers |
//! | `fault` | errors in a file, with their positions |
//! | `note`, `loss` | the content that a reader left out or changed; the content that a written file does not store |
//! | `polygons`, `clean`, `weld`, `into_mesh` | building a mesh from polygons with attributes |
//! | `joined`, `corners`, `file_vertices`, `writing` | converting a scene to a form that a format can store |
//! | `assets`, `save` | the files that a file refers to; writing files atomically |
//!
//! # Examples
//!
//! ```
//! use scene::{Object, Scene};
//! use store::Disk;
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("cube.obj");
//! let mut scene = Scene::new();
//! scene.insert(Object::mesh("cube", geometry::shapes::cube()))?;
//!
//! let report = mesh_io::write(&Disk, &path, &scene, &mesh_io::WriteOptions::default())?;
//! assert!(report.losses.is_empty());
//!
//! let loaded = mesh_io::read(&Disk, &path, &mesh_io::ReadOptions::default())?;
//! assert!(loaded.notes.is_empty());
//! assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("kept.md")]

mod assets;
mod bez;
mod capability;
mod clean;
mod corners;
mod csv;
mod dae;
mod decimal;
mod error;
mod fault;
mod file_vertices;
mod format;
mod gltf;
mod gzip;
mod images;
mod into_mesh;
mod joined;
mod loss;
mod mws;
mod note;
mod npz;
mod obj;
mod off;
mod packing;
mod peek;
mod placed;
mod ply;
mod policy;
mod polygons;
mod provenance;
mod save;
mod stl;
mod text;
mod weld;
mod writing;

use std::path::{Path, PathBuf};

use scene::{Geometry, Graph, Object, Scene};
use store::Store;

pub use assets::FileDependency;
pub use capability::{Storage, Stored};
pub use error::{ReadError, WriteError};
pub use format::{Format, Rows};
pub use images::Images;
pub use loss::Loss;
pub use note::{Note, NoteKind};
pub use packing::{BadBits, Bits, Compression, PackingReport, Quantization};
pub use peek::{Peek, PeekGeometry, PeekMesh, PeekObject, PeekRanges};
pub use policy::{CleanupPolicy, NonManifold, Orientation, Placements, Policies};
pub use polygons::Polygons;
pub use provenance::provenance;

use assets::Assets;
use file_vertices::without_marks;
use note::Notes;
use placed::{Placed, placed};
use save::{Content, save};

/// How to read a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The name for objects that have no name in the file. If the file is an `.mws` file with a single object, this
    /// name replaces the name of the object. If `None`, objects without a name get the name of the file without its
    /// extension, and all objects of an `.mws` file keep their names. In glTF and COLLADA files, an object has the name
    /// of its node. If the node has no name, the object has the name of its mesh. If several nodes of a glTF file share
    /// an object, the name of the mesh takes precedence over the names of the nodes.
    pub name: Option<String>,
    /// How to handle polygons that do not form a clean mesh, for example duplicate faces.
    pub policies: Policies,
    /// How nodes place meshes. COLLADA files are always read with [`Placements::Bake`].
    pub placements: Placements,
    /// Whether reading fails if anything in the file would be left out.
    pub strict: bool,
    /// When a mesh is not a manifold, reading splits vertices into copies. This option decides whether reading marks
    /// these copies. If the mesh is then written to an `.obj`, `.ply`, `.off`, `.gltf` or `.glb` file, the writer
    /// merges the marked copies again. The written file then has the same vertices as the original file. Use this
    /// option to convert a file to another format without editing its mesh.
    pub keep_vertices: bool,
    /// The memory budget in bytes. The budget is the maximum size of all images together, and also the maximum size of
    /// the decompressed content of a `.gz` file. Defaults to 4 GiB.
    pub budget: Option<u64>,
}

/// The content of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loaded {
    /// The objects in the order of the file. The names of the objects are unique within the file.
    pub objects: Vec<Object>,
    /// The nodes that place the objects. Empty if the file has no nodes.
    pub graph: Graph,
    /// The content that reading left out or changed.
    pub notes: Vec<Note>,
    /// The files on which the result of reading depends, without duplicates, sorted by path.
    pub files: Vec<FileDependency>,
}

/// How to write a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// The origin of the content, such as the digest of a recipe. OBJ, MTL, PLY and OFF files store the origin as a
    /// comment, STL and `.mws` files in their header, and glTF files as `asset.extras.meshwright`. The Bezier formats
    /// and tables (`.csv`, `.npz`) cannot store the origin.
    pub provenance: Option<String>,
    /// How the images of materials are written. If `None`, images are embedded in `.glb` files. For `.gltf` and `.obj`
    /// files, images in the folder of the original model are copied to the folder of the written file. OBJ files cannot
    /// embed images. Therefore, for `.obj` files, images that are embedded in the original model are also written to
    /// separate files.
    pub images: Option<Images>,
    /// How to compress the geometry of glTF files. If `None`, the geometry is not compressed. If this option is set,
    /// writing a file of any other format fails.
    pub compression: Option<Compression>,
    /// How to quantize the geometry of glTF files. If `None`, numbers have 32 bits. If this option is set, writing a
    /// file of any other format fails.
    pub quantization: Option<Quantization>,
    /// For glTF, the maximum number of joint sets of a skinned mesh. In each set, a vertex has four joints. If `None`,
    /// the maximum is the number of sets in the original file of the mesh. For a mesh that was not read from a file, it
    /// is 1.
    pub weight_sets: Option<u32>,
    /// The kind of elements of a `.csv` file. Each element has a row. If `None`, the rows list vertices. If this option
    /// is set, writing a file of any other format fails.
    pub rows: Option<Rows>,
    /// Whether writing fails if the file would not store everything.
    pub strict: bool,
}

/// The files that were written, and the content that they do not store.
#[derive(Clone, Debug, PartialEq)]
pub struct WriteReport {
    /// The files that were written. The last file in the list is the file that the caller asked to write.
    pub files: Vec<PathBuf>,
    /// The total size of the files in bytes.
    pub bytes: u64,
    /// The content that the files do not store.
    pub losses: Vec<Loss>,
    /// The effects of compression and quantization. `None` if neither compression nor quantization was requested.
    pub packing: Option<PackingReport>,
}

/// Reads the objects of a file.
///
/// # Errors
///
/// Returns a [`ReadError`] if the file cannot be read or breaks the rules of its format. Errors in the syntax of the
/// file have a position.
pub fn read(store: &dyn Store, path: &Path, options: &ReadOptions) -> Result<Loaded, ReadError> {
    known_format(path)?;
    let mut loaded = read_bytes(store, path, store.read(path)?, options)?;
    let seen = FileDependency {
        path: path.to_path_buf(),
        is_read: true,
    };
    if let Err(place) = loaded.files.binary_search(&seen) {
        loaded.files.insert(place, seen);
    }
    Ok(loaded)
}

/// Reads the objects of a file from its bytes. `path` determines the format and appears in errors. If this file refers
/// to other files, their paths are relative to the folder of `path`. [`Loaded::files`] lists only the files that this
/// file refers to, whereas [`read()`] also lists `path`.
///
/// # Errors
///
/// Returns an error in the same cases as [`read()`].
pub fn read_bytes(
    store: &dyn Store,
    path: &Path,
    bytes: Vec<u8>,
    options: &ReadOptions,
) -> Result<Loaded, ReadError> {
    let bytes = gzip::unpacked(path, bytes, options.budget())?;
    let mut notes = Notes::of(path);
    let mut assets = Assets::of(store, path);
    let mut objects = Vec::new();
    let parsed = parse_format(bytes, options, &mut assets, &mut notes)?;
    for ParsedObject { name, shape } in parsed.objects {
        objects.push(match shape {
            Shape::Polygons(polygons) => {
                let (mesh, materials) = polygons.into_mesh(path, options, &mut notes)?;
                Object {
                    materials,
                    ..Object::mesh(name, mesh)
                }
            }
            Shape::Geometry(geometry) => Object::new(name, geometry),
            Shape::Object(object) => *object,
        });
    }
    if known_format(path)? != Format::Mws {
        images::load(&mut objects, &mut assets, options.budget(), &mut notes);
    }
    let notes = notes.into_vec();
    if options.strict {
        fail_if_left_out(path, &notes)?;
    }
    Ok(Loaded {
        objects,
        graph: parsed.graph,
        notes,
        files: assets.into_files(),
    })
}

/// Reads the polygons of a file without building meshes, for programs that need no connectivity. Curves, patches,
/// polylines and all objects of `.mws` files are left out. The transforms of nodes are applied to the points, as with
/// [`Placements::Bake`].
///
/// # Errors
///
/// Returns an error in the same cases as [`read()`], except for errors that are found only when a mesh is built.
pub fn read_polygons(
    store: &dyn Store,
    path: &Path,
    options: &ReadOptions,
) -> Result<Vec<(String, Polygons)>, ReadError> {
    known_format(path)?;
    let mut assets = Assets::of(store, path);
    let options = ReadOptions {
        placements: Placements::Bake,
        ..options.clone()
    };
    let found = parse_format(
        gzip::unpacked(path, store.read(path)?, options.budget())?,
        &options,
        &mut assets,
        &mut Notes::of(path),
    )?;
    let polygons = found
        .objects
        .into_iter()
        .filter_map(|found| match found.shape {
            Shape::Polygons(polygons) => Some((found.name, polygons)),
            Shape::Geometry(_) | Shape::Object(_) => None,
        });
    Ok(polygons.collect())
}

/// The content of a file, as the reader of its format returns it.
struct Parsed {
    objects: Vec<ParsedObject>,
    graph: Graph,
}

impl From<Vec<ParsedObject>> for Parsed {
    fn from(objects: Vec<ParsedObject>) -> Self {
        let graph = Graph::default();
        Self { objects, graph }
    }
}

/// An object of a file, as the reader of its format returns it.
struct ParsedObject {
    name: String,
    shape: Shape,
}

enum Shape {
    Polygons(Polygons),
    Geometry(Geometry),
    /// A complete object of an `.mws` file, with its name and materials.
    Object(Box<Object>),
}

fn parse_format(
    bytes: Vec<u8>,
    options: &ReadOptions,
    assets: &mut Assets,
    notes: &mut Notes,
) -> Result<Parsed, ReadError> {
    let path = assets.path;
    let name = options.name_in(path);
    let one = |shape| {
        let name = name.clone();
        Parsed::from(vec![ParsedObject { name, shape }])
    };
    let placements = options.placements;
    let found = match known_format(path)? {
        Format::Obj => obj::read(&bytes, assets, notes).map(one),
        Format::Gltf | Format::Glb => gltf::read(bytes, &name, placements, assets, notes),
        Format::Ply => ply::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Stl => stl::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Off => off::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Dae => dae::read(&bytes, &name, notes).map(Parsed::from),
        Format::Mws => mws::read(&bytes, options.name.as_deref(), placements),
        Format::Bez => bez::read_patches(&bytes).map(Shape::Geometry).map(one),
        Format::Bzc => bez::read_curve(&bytes).map(Shape::Geometry).map(one),
        // `known_format` refuses these formats.
        Format::Csv | Format::Npz => Ok(Vec::new().into()),
    };
    found.map_err(|fault| fault.in_file(path))
}

fn fail_if_left_out(path: &Path, notes: &[Note]) -> Result<(), ReadError> {
    let left_out = notes.iter().filter(|note| note.kind == NoteKind::LeftOut);
    let list: Vec<String> = left_out.map(ToString::to_string).collect();
    if list.is_empty() {
        return Ok(());
    }
    Err(ReadError::Strict {
        path: path.to_path_buf(),
        left_out: list.join("; "),
    })
}

/// Returns the objects that would be read from a file, with their element counts. If the file has a header with these
/// counts, the counts are taken from the header.
///
/// Also returns notes about the content that reading would leave out. Content that can be found only by building the
/// objects has no note.
///
/// Bezier and `.mws` files are checked completely. In glTF files, only the JSON is checked. OBJ files are not checked,
/// but their statements are counted.
///
/// # Errors
///
/// Returns a [`ReadError`] if the file cannot be read, or if the checked part breaks the rules of its format. Also
/// returns an error if [`ReadOptions::strict`] is set and some of the content would be left out.
pub fn peek(store: &dyn Store, path: &Path, options: &ReadOptions) -> Result<Peek, ReadError> {
    let format = known_format(path)?;
    let bytes = match format {
        Format::Gltf | Format::Glb if !gzip::is_compressed(path) => gltf::document_of(store, path)?,
        _ => gzip::unpacked(path, store.read(path)?, options.budget())?,
    };
    let name = options.name_in(path);
    let one = |geometry| {
        let name = name.clone();
        vec![PeekObject::new(name, geometry)]
    };
    let of = |geometry: Geometry| one(PeekGeometry::of(&geometry));
    let mut notes = Notes::of(path);
    let mut assets = Assets::of(store, path);
    let mut graph = Graph::default();
    let plain = |mesh, attributes| {
        let object = PeekObject::new(name.clone(), PeekGeometry::Mesh(mesh)).with_materials(&[]);
        vec![PeekObject {
            attributes,
            ..object
        }]
    };
    let objects = match format {
        Format::Obj => obj::peek(&bytes, &name, &mut assets, &mut notes).map(|object| vec![object]),
        Format::Gltf | Format::Glb => gltf::peek(
            &bytes,
            &name,
            options.placements,
            &mut assets,
            &mut graph,
            &mut notes,
        ),
        Format::Ply => ply::peek(&bytes, &mut notes).map(|(mesh, names)| plain(mesh, Some(names))),
        Format::Stl => stl::peek(&bytes, &mut notes).map(|(mesh, names)| plain(mesh, names)),
        Format::Off => off::peek(&bytes, &mut notes).map(|(mesh, names)| plain(mesh, Some(names))),
        Format::Dae => dae::peek(&bytes, &name, &mut notes),
        Format::Mws => mws::peek(
            &bytes,
            options.name.as_deref(),
            options.placements,
            &mut graph,
        ),
        Format::Bez => bez::read_patches(&bytes).map(of),
        Format::Bzc => bez::read_curve(&bytes).map(of),
        // `known_format` refuses these formats.
        Format::Csv | Format::Npz => Ok(Vec::new()),
    };
    let objects = objects.map_err(|fault| fault.in_file(path))?;
    let mut left_out = notes.into_vec();
    left_out.retain(|note| note.kind == NoteKind::LeftOut);
    if options.strict {
        fail_if_left_out(path, &left_out)?;
    }
    Ok(Peek {
        format,
        objects,
        graph,
        left_out,
    })
}

/// Writes a scene to a file, and to the additional files that the format needs. A file `a.obj` comes with `a.mtl` if
/// there are materials, and `a.gltf` comes with `a.bin`. Existing files with these names are replaced. Images of
/// materials are embedded or copied according to [`WriteOptions::images`].
///
/// # Errors
///
/// Returns a [`WriteError`] if the format cannot store the scene or the files cannot be written. If writing fails,
/// existing files are unchanged, with one exception: if the system fails to rename one of several files, the files
/// before it have already been replaced.
pub fn write(
    store: &dyn Store,
    path: &Path,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let unknown = || WriteError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::writable_extensions(),
    };
    let format = Format::from_path(path)
        .filter(|f| f.can_write())
        .ok_or_else(unknown)?;
    if !format.packs() && (options.compression.is_some() || options.quantization.is_some()) {
        let message = "only .glb and .gltf files can be compressed or quantized".to_owned();
        return Err(WriteError::Scene {
            path: path.to_path_buf(),
            message,
        });
    }
    if format != Format::Csv && options.rows.is_some() {
        let message = "only .csv files have rows".to_owned();
        return Err(WriteError::Scene {
            path: path.to_path_buf(),
            message,
        });
    }
    let Placed { scene, losses } = placed(scene, format, path)?;
    fail_if_lost(path, options, &losses)?;
    let mut report = write_placed(store, path, format, &scene, options)?;
    report.losses.splice(..0, losses);
    Ok(report)
}

/// Writes a scene. If the format cannot store nodes, the caller has already replaced the nodes by separate objects.
fn write_placed(
    store: &dyn Store,
    path: &Path,
    format: Format,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let one = |(bytes, losses)| Written {
        files: vec![(path.to_path_buf(), bytes)],
        losses,
        packing: None,
    };
    let images::Settled {
        scene,
        files: mut all,
    } = images::settle(store, path, format, scene, options)?;
    // If the polygons of a file do not form a manifold, the reader splits vertices into copies. In the scene, these
    // copies are marked. The writers of OBJ, PLY, OFF and glTF use these marks to merge the copies again. For all other
    // formats, the marks are removed, and the written file contains all copies.
    let scene = &*if keeps_vertices(path) {
        scene
    } else {
        without_marks(scene)
    };
    let written = match format {
        Format::Obj => return obj::write(store, path, scene, all, options),
        Format::Gltf => gltf::write(path, false, scene, options),
        Format::Glb => gltf::write(path, true, scene, options),
        Format::Ply => return ply::write(store, path, scene, all, options),
        Format::Stl => stl::write(scene, options).map(one),
        Format::Off => off::write(scene, options).map(one),
        // The function `write` refuses to write COLLADA files.
        Format::Dae => Ok(one(Default::default())),
        Format::Mws => Ok(one(mws::write(scene, options))),
        Format::Bez => bez::write_bez(scene).map(one),
        Format::Bzc => bez::write_bzc(scene).map(one),
        Format::Csv => csv::write(scene, options).map(one),
        Format::Npz => npz::write(scene).map(one),
    };
    let Written {
        files,
        losses,
        packing,
    } = written.map_err(|why| why.in_file(path))?;
    fail_if_lost(path, options, &losses)?;
    let files = files
        .into_iter()
        .map(|(path, bytes)| (path, Content::Bytes(bytes)));
    all.extend(files);
    let (files, bytes) = save(store, all)?;
    Ok(WriteReport {
        files,
        bytes,
        losses,
        packing,
    })
}

/// Whether files with the format of `path` can store a mesh that is not a manifold. For other formats,
/// [`ReadOptions::keep_vertices`] has no effect on the written file.
pub fn keeps_vertices(path: &Path) -> bool {
    let format = Format::from_path(path);
    matches!(
        format,
        Some(Format::Obj | Format::Ply | Format::Off | Format::Gltf | Format::Glb)
    )
}

fn fail_if_lost(path: &Path, options: &WriteOptions, losses: &[Loss]) -> Result<(), WriteError> {
    if !options.strict || losses.is_empty() {
        return Ok(());
    }
    let list: Vec<String> = losses.iter().map(ToString::to_string).collect();
    Err(WriteError::Strict {
        path: path.to_path_buf(),
        losses: list.join("; "),
    })
}

/// The bytes of files before they are saved, and the content that the files do not store.
struct Written {
    /// The files in the order in which they are saved.
    files: Vec<(PathBuf, Vec<u8>)>,
    losses: Vec<Loss>,
    packing: Option<PackingReport>,
}

/// The bytes of one file, and the content that the file does not store.
type SingleFile = (Vec<u8>, Vec<Loss>);

fn known_format(path: &Path) -> Result<Format, ReadError> {
    let known = Format::from_path(path).filter(|format| format.can_read());
    known.ok_or_else(|| ReadError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::readable_extensions(),
    })
}

impl ReadOptions {
    fn budget(&self) -> u64 {
        self.budget.unwrap_or(1 << 32)
    }

    /// Returns the name for objects that have no name in the file.
    fn name_in(&self, path: &Path) -> String {
        let given = self.name.clone();
        given.unwrap_or_else(|| match store::stem(path).to_string_lossy() {
            stem if stem.is_empty() => "object".to_owned(),
            stem => stem.into_owned(),
        })
    }
}
