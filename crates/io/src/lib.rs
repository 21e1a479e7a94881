//! Reading and writing OBJ, glTF, PLY, STL, OFF, COLLADA and Bezier files.
//!
//! [`read()`] takes a file and gives objects, [`write()`] takes a scene and makes files, [`peek()`] says
//! how large a file is without building it. The extension of the name chooses the [`Format`]:
//!
//! | extension | holds | module |
//! | --- | --- | --- |
//! | `.obj` (and `.mtl`) | polygons, polylines, groups, materials | `obj` |
//! | `.gltf`, `.glb` | triangles, materials, placed objects | `gltf` |
//! | `.ply` | polygons with any properties | `ply` |
//! | `.stl` | triangles | `stl` |
//! | `.off` | polygons | `off` |
//! | `.dae` (only read) | polygons, materials, placed objects | `dae` |
//! | `.bez` | Bezier patches | `bez` |
//! | `.bzc` | a Bezier curve | `bez` |
//!
//! Nothing is dropped silently: what a reader left out or changed is a [`Note`] with a count, what a
//! file cannot hold is a [`Loss`]. Errors say where: the line and column of a text, the JSON pointer
//! of a glTF file. Paths inside a file stay inside its folder. Files are written whole or not at all.
//!
//! The folder of a format has `read` (from bytes to polygons), `write` and `peek`, and its `mod.rs` says what becomes
//! of what: faces of OBJ are read in `obj/statement.rs`, those of glTF in `gltf/primitives.rs`. All formats share:
//!
//! | module | |
//! | --- | --- |
//! | `text` | words and numbers of a text with their lines; `decimal` is how numbers are read and written |
//! | `fault` | what is wrong with a file, and where |
//! | `note`, `loss` | what a reader left out or changed, what a file does not hold |
//! | `polygons`, `clean`, `weld` | from polygons with attributes to a mesh |
//! | `joined`, `corners`, `writing` | from a scene to what a file has room for |
//! | `assets`, `save` | the files beside the one that is read; writing files whole |
//! | `parallel` | work on all threads |
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
mod clean;
mod corners;
mod dae;
mod decimal;
mod error;
mod fault;
mod format;
mod gltf;
mod joined;
mod loss;
mod mws;
mod note;
mod obj;
mod off;
mod parallel;
mod peek;
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

use scene::{Geometry, Object, Scene};
use store::Store;

pub use assets::FileSeen;
pub use error::{ReadError, WriteError};
pub use format::Format;
pub use loss::Loss;
pub use note::{Note, NoteKind};
pub use peek::{Peek, PeekGeometry, PeekMesh, PeekObject};
pub use policy::{CleanupPolicy, NonManifold, Orientation, Policies};
pub use polygons::Polygons;
pub use provenance::provenance;

use assets::Assets;
use note::Notes;
use save::{Content, save};

/// How to read a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The name of the object, in files that hold one without a name; `None` for the name of the file
    /// without its extension. The objects of a glTF file have the names of their nodes; the name given
    /// here stands for those that have none.
    pub name: Option<String>,
    /// What to do with polygons that make no clean mesh.
    pub policies: Policies,
    /// Whether to fail where something of the file would be left out.
    pub strict: bool,
}

/// What was read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loaded {
    /// The objects in the order of the file. Their names are unique among themselves.
    pub objects: Vec<Object>,
    /// What was left out or changed.
    pub notes: Vec<Note>,
    /// The files that this depends on, each once, sorted by path.
    pub files: Vec<FileSeen>,
}

/// How to write a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Where the content comes from, such as the digest of a recipe: a comment in OBJ, MTL, PLY and OFF, in
    /// the header of STL, `asset.extras.meshwright` in glTF, the head of `.mws`. The Bezier formats have no place for it.
    pub provenance: Option<String>,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteReport {
    /// The files: the one that was asked for is the last.
    pub files: Vec<PathBuf>,
    /// How many bytes they have together.
    pub bytes: u64,
    /// What of the scene they do not hold.
    pub losses: Vec<Loss>,
}

/// Reads the objects of a file.
///
/// # Errors
///
/// [`ReadError`] if the file cannot be read or breaks the rules of its format, with the place.
pub fn read(store: &dyn Store, path: &Path, options: &ReadOptions) -> Result<Loaded, ReadError> {
    known_format(path)?;
    let mut loaded = read_bytes(store, path, store.read(path)?, options)?;
    let seen = FileSeen {
        path: path.to_path_buf(),
        is_read: true,
    };
    if let Err(place) = loaded.files.binary_search(&seen) {
        loaded.files.insert(place, seen);
    }
    Ok(loaded)
}

/// Reads the objects of a file whose bytes are given. `path` says which format it has, what errors call it
/// and where the files beside it are. Only these are among the [`files`](Loaded::files) then.
///
/// # Errors
///
/// As [`read()`].
pub fn read_bytes(
    store: &dyn Store,
    path: &Path,
    bytes: Vec<u8>,
    options: &ReadOptions,
) -> Result<Loaded, ReadError> {
    let mut notes = Notes::of(path);
    let mut assets = Assets::of(store, path);
    let mut objects = Vec::new();
    for Found { name, shape } in find(bytes, options, &mut assets, &mut notes)? {
        objects.push(match shape {
            Shape::Polygons(polygons) => {
                let (mesh, materials) = polygons.into_mesh(path, options, &mut notes)?;
                Object {
                    materials,
                    ..Object::mesh(name, mesh)
                }
            }
            Shape::Other(geometry) => Object::new(name, geometry),
            Shape::Whole(object) => *object,
        });
    }
    let notes = notes.into_vec();
    if options.strict {
        refuse_left_out(path, &notes)?;
    }
    Ok(Loaded {
        objects,
        notes,
        files: assets.into_files(),
    })
}

/// Reads the polygons of a file as they are, without building meshes: for programs that need no
/// connectivity. Curves, patches and polylines are left out.
///
/// # Errors
///
/// As [`read()`], but for what only building finds.
pub fn read_polygons(
    store: &dyn Store,
    path: &Path,
    options: &ReadOptions,
) -> Result<Vec<(String, Polygons)>, ReadError> {
    known_format(path)?;
    let mut assets = Assets::of(store, path);
    let found = find(
        store.read(path)?,
        options,
        &mut assets,
        &mut Notes::of(path),
    )?;
    let polygons = found.into_iter().filter_map(|found| match found.shape {
        Shape::Polygons(polygons) => Some((found.name, polygons)),
        Shape::Other(_) | Shape::Whole(_) => None,
    });
    Ok(polygons.collect())
}

/// What a reader finds in a file.
struct Found {
    name: String,
    shape: Shape,
}

enum Shape {
    Polygons(Polygons),
    Other(Geometry),
    /// An object with its name and its materials, as it was written.
    Whole(Box<Object>),
}

fn find(
    bytes: Vec<u8>,
    options: &ReadOptions,
    assets: &mut Assets,
    notes: &mut Notes,
) -> Result<Vec<Found>, ReadError> {
    let path = assets.path;
    let name = options.name_in(path);
    let one = |shape| {
        let name = name.clone();
        vec![Found { name, shape }]
    };
    let found = match known_format(path)? {
        Format::Obj => obj::read(&bytes, assets, notes).map(one),
        Format::Gltf | Format::Glb => gltf::read(bytes, &name, assets, notes),
        Format::Ply => ply::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Stl => stl::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Off => off::read(&bytes, notes).map(Shape::Polygons).map(one),
        Format::Dae => dae::read(&bytes, &name, notes),
        Format::Mws => mws::read(&bytes, options.name.as_deref()),
        Format::Bez => bez::read_patches(&bytes).map(Shape::Other).map(one),
        Format::Bzc => bez::read_curve(&bytes).map(Shape::Other).map(one),
    };
    found.map_err(|fault| fault.in_file(path))
}

fn refuse_left_out(path: &Path, notes: &[Note]) -> Result<(), ReadError> {
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

/// Says what reading a file will give, from its headers where it has some.
///
/// Bezier files are checked whole, glTF files as far as their JSON, OBJ files not at all: their
/// statements are counted.
///
/// # Errors
///
/// [`ReadError`] if the file cannot be read, or breaks the rules of its format where they were checked.
pub fn peek(store: &dyn Store, path: &Path, options: &ReadOptions) -> Result<Peek, ReadError> {
    let format = known_format(path)?;
    let bytes = match format {
        Format::Gltf | Format::Glb => gltf::document_of(store, path)?,
        _ => store.read(path)?,
    };
    let name = options.name_in(path);
    let one = |geometry| {
        let name = name.clone();
        vec![PeekObject { name, geometry }]
    };
    let of = |geometry: Geometry| one(PeekGeometry::of(&geometry));
    let objects = match format {
        Format::Obj => Ok(one(obj::peek(&bytes))),
        Format::Gltf | Format::Glb => gltf::peek(&bytes, &name),
        Format::Ply => ply::peek(&bytes).map(PeekGeometry::Mesh).map(one),
        Format::Stl => stl::peek(&bytes).map(PeekGeometry::Mesh).map(one),
        Format::Off => off::peek(&bytes).map(PeekGeometry::Mesh).map(one),
        Format::Dae => dae::peek(&bytes, &name),
        Format::Mws => mws::peek(&bytes, options.name.as_deref()),
        Format::Bez => bez::read_patches(&bytes).map(of),
        Format::Bzc => bez::read_curve(&bytes).map(of),
    };
    let objects = objects.map_err(|fault| fault.in_file(path))?;
    Ok(Peek { format, objects })
}

/// Writes a scene to a file and, where the format needs them, to files beside it: `a.obj` comes with
/// `a.mtl` if there are materials, `a.gltf` with `a.bin`. Files of these names are replaced.
///
/// # Errors
///
/// [`WriteError`] if the format cannot hold the scene or the files cannot be written. Files of these
/// names are then as they were.
pub fn write(
    store: &dyn Store,
    path: &Path,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let unknown = || WriteError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::known_to_write(),
    };
    let one = |(bytes, losses)| Written {
        files: vec![(path.to_path_buf(), bytes)],
        losses,
    };
    let written = match Format::from_path(path).ok_or_else(unknown)? {
        Format::Obj => return obj::write(store, path, scene, options),
        Format::Gltf => gltf::write(path, false, scene, options),
        Format::Glb => gltf::write(path, true, scene, options),
        Format::Ply => ply::write(scene, options).map(one),
        Format::Stl => stl::write(scene, options).map(one),
        Format::Off => off::write(scene, options).map(one),
        Format::Dae => return Err(unknown()),
        Format::Mws => Ok(one(mws::write(scene, options))),
        Format::Bez => bez::write_bez(scene).map(one),
        Format::Bzc => bez::write_bzc(scene).map(one),
    };
    let Written { files, losses } = written.map_err(|why| why.in_file(path))?;
    let files = files
        .into_iter()
        .map(|(path, bytes)| (path, Content::Bytes(bytes)));
    let (files, bytes) = save(store, files.collect())?;
    Ok(WriteReport {
        files,
        bytes,
        losses,
    })
}

/// The bytes of files before they are saved, and what they do not hold.
struct Written {
    /// In the order in which they appear in their folder.
    files: Vec<(PathBuf, Vec<u8>)>,
    losses: Vec<Loss>,
}

/// The bytes of one file, and what it does not hold.
type One = (Vec<u8>, Vec<Loss>);

fn known_format(path: &Path) -> Result<Format, ReadError> {
    Format::from_path(path).ok_or_else(|| ReadError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::known(),
    })
}

impl ReadOptions {
    /// The name of an object without one.
    fn name_in(&self, path: &Path) -> String {
        let given = self.name.clone();
        let stem = || {
            path.file_stem()
                .map(|stem| stem.to_string_lossy().into_owned())
        };
        given.or_else(stem).unwrap_or_else(|| "object".to_owned())
    }
}
