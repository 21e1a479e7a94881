//! Reading and writing OBJ, glTF and Bezier files.
//!
//! [`read()`] takes a file and gives objects, [`write()`] takes a scene and makes files, [`peek()`] says
//! how large a file is without building it. The extension of the name chooses the [`Format`]:
//!
//! | extension | holds | module |
//! | --- | --- | --- |
//! | `.obj` (and `.mtl`) | polygons, polylines, groups, materials | `obj` |
//! | `.gltf`, `.glb` | triangles, materials, placed objects | `gltf` |
//! | `.bez` | Bezier patches | `bez` |
//! | `.bzc` | a Bezier curve | `bez` |
//!
//! Nothing is dropped silently: what a reader left out or changed is a [`Note`] with a count, what a
//! file cannot hold is a [`Loss`]. Errors say where: the line and column of a text, the JSON pointer
//! of a glTF file. Paths inside a file stay inside its folder. Files are written whole or not at all.
//!
//! # Examples
//!
//! ```
//! use scene::{Object, Scene};
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("cube.obj");
//! let mut scene = Scene::new();
//! scene.insert(Object::mesh("cube", mesh::shapes::cube()))?;
//!
//! let report = mesh_io::write(&path, &scene, &mesh_io::WriteOptions::default())?;
//! assert!(report.losses.is_empty());
//!
//! let loaded = mesh_io::read(&path, &mesh_io::ReadOptions::default())?;
//! assert!(loaded.notes.is_empty());
//! assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod asset_path;
mod bez;
mod build;
mod corners;
mod dense;
mod error;
mod format;
mod gltf;
mod loss;
mod note;
mod obj;
mod peek;
mod save;
mod text;

use std::path::{Path, PathBuf};

use mesh::NonManifold;
use scene::{Geometry, Object, Scene};

pub use error::{ReadError, WriteError};
pub use format::Format;
pub use note::{Loss, Note, NoteKind};
pub use peek::{Peek, PeekGeometry, PeekMesh, PeekObject};

use error::Unwritable;
use note::Notes;

/// How to read a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The name of the object, in files that hold one without a name; `None` for the name of the file
    /// without its extension. The objects of a glTF file have the names of their nodes; the name given
    /// here stands for those that have none.
    pub name: Option<String>,
    /// What to do where faces do not form a manifold.
    pub non_manifold: NonManifold,
}

/// What was read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loaded {
    /// The objects in the order of the file. Their names are unique among themselves.
    pub objects: Vec<Object>,
    /// What was left out or changed.
    pub notes: Vec<Note>,
}

/// How to write a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Where the content comes from, such as the digest of a recipe: a comment in OBJ and MTL,
    /// `asset.extras.meshwright` in glTF. The Bezier formats have no place for it.
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
pub fn read(path: &Path, options: &ReadOptions) -> Result<Loaded, ReadError> {
    let format = known_format(path)?;
    let name = options.name.clone().unwrap_or_else(|| name_of(path));
    let mut notes = Notes::of(path);
    let bytes = read_whole(path)?;
    let objects = match format {
        Format::Obj => vec![obj::read(path, &bytes, name, options, &mut notes)?],
        Format::Gltf | Format::Glb => gltf::read(path, bytes, &name, options, &mut notes)?,
        Format::Bez => {
            let patches = bez::read_patches(&bytes).map_err(|error| error.in_file(path))?;
            vec![Object::new(name, Geometry::Patches(patches))]
        }
        Format::Bzc => {
            let curve = bez::read_curve(&bytes).map_err(|error| error.in_file(path))?;
            vec![Object::new(name, Geometry::Curve(curve))]
        }
    };
    Ok(Loaded {
        objects,
        notes: notes.into_vec(),
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
pub fn peek(path: &Path, options: &ReadOptions) -> Result<Peek, ReadError> {
    let format = known_format(path)?;
    let name = options.name.clone().unwrap_or_else(|| name_of(path));
    let geometry = match format {
        Format::Obj => obj::peek(&read_whole(path)?),
        Format::Gltf | Format::Glb => {
            return Ok(Peek {
                format,
                objects: gltf::peek(path, &name)?,
            });
        }
        Format::Bez => {
            let patches = bez::read_patches(&read_whole(path)?).map_err(|e| e.in_file(path))?;
            PeekGeometry::Patches {
                patches: patches.len() as u64,
            }
        }
        Format::Bzc => {
            let curve = bez::read_curve(&read_whole(path)?).map_err(|e| e.in_file(path))?;
            PeekGeometry::Curve {
                points: curve.points().len() as u64,
            }
        }
    };
    Ok(Peek {
        format,
        objects: vec![PeekObject { name, geometry }],
    })
}

/// Writes a scene to a file and, where the format needs them, to files beside it: `a.obj` comes with
/// `a.mtl` if there are materials, `a.gltf` with `a.bin`. Files of these names are replaced.
///
/// # Errors
///
/// [`WriteError`] if the format cannot hold the scene or the files cannot be written. Files of these
/// names are then as they were.
pub fn write(
    path: &Path,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<WriteReport, WriteError> {
    let format = Format::from_path(path).ok_or_else(|| WriteError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::known(),
    })?;
    let written = match format {
        Format::Obj => obj::write(path, scene, options),
        Format::Gltf => gltf::write(path, false, scene, options),
        Format::Glb => gltf::write(path, true, scene, options),
        Format::Bez => write_bez(path, scene),
        Format::Bzc => write_bzc(path, scene),
    };
    let Written { files, losses } = written.map_err(|why| why.in_file(path))?;
    let bytes = files.iter().map(|(_, bytes)| bytes.len() as u64).sum();
    Ok(WriteReport {
        files: save::save_all(files)?,
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

fn write_bez(path: &Path, scene: &Scene) -> Result<Written, Unwritable> {
    let mut all = Vec::new();
    let mut losses = Vec::new();
    for object in scene.objects() {
        let Geometry::Patches(patches) = &object.geometry else {
            let message = format!(
                "a .bez file holds Bezier patches, found {}",
                object.geometry.kind()
            );
            return Err(Unwritable::object(&object.name, message));
        };
        all.extend_from_slice(patches);
        let mut losses = loss::Losses::of(&object.name, &mut losses);
        losses.add(
            None,
            "materials",
            object.materials.len(),
            "a .bez file has no materials",
        );
        let others = scene.objects().len() - 1;
        losses.add(
            None,
            "name",
            others.min(1),
            "the patches of all objects are written as one list",
        );
    }
    Ok(Written {
        files: vec![(path.to_path_buf(), bez::write_patches(&all))],
        losses,
    })
}

fn write_bzc(path: &Path, scene: &Scene) -> Result<Written, Unwritable> {
    let [object] = scene.objects() else {
        let message = format!(
            "a .bzc file holds one curve, found {} objects",
            scene.objects().len()
        );
        return Err(Unwritable::Scene { message });
    };
    let Geometry::Curve(curve) = &object.geometry else {
        let message = format!(
            "a .bzc file holds a curve, found {}",
            object.geometry.kind()
        );
        return Err(Unwritable::object(&object.name, message));
    };
    let mut losses = Vec::new();
    let count = object.materials.len();
    loss::Losses::of(&object.name, &mut losses).add(
        None,
        "materials",
        count,
        "a .bzc file has no materials",
    );
    Ok(Written {
        files: vec![(path.to_path_buf(), bez::write_curve(curve))],
        losses,
    })
}

fn known_format(path: &Path) -> Result<Format, ReadError> {
    Format::from_path(path).ok_or_else(|| ReadError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::known(),
    })
}

fn read_whole(path: &Path) -> Result<Vec<u8>, ReadError> {
    asset_path::read_plain(path, u64::MAX).map_err(|source| ReadError::io(path, source))
}

/// The name of a file without its extension.
fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(
        || "object".to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}
