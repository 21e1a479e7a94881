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
//! # Examples
//!
//! ```
//! use scene::{Object, Scene};
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("cube.obj");
//! let mut scene = Scene::new();
//! scene.insert(Object::mesh("cube", geometry::shapes::cube()))?;
//!
//! let report = mesh_io::write(&path, &scene, &mesh_io::WriteOptions::default())?;
//! assert!(report.losses.is_empty());
//!
//! let loaded = mesh_io::read(&path, &mesh_io::ReadOptions::default())?;
//! assert!(loaded.notes.is_empty());
//! assert_eq!(loaded.objects[0].as_mesh().unwrap().n_faces(), 6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("kept.md")]

mod asset_path;
mod bez;
mod build;
mod clean;
mod color;
mod corners;
mod dae;
mod decimal;
mod dense;
mod error;
mod format;
mod gltf;
mod joined;
mod lines;
mod loss;
mod mws;
mod names;
mod note;
mod obj;
mod off;
mod peek;
mod ply;
mod policy;
mod polygons;
mod provenance;
mod save;
mod stl;
mod text;
mod vertex_uvs;
mod weld;

use std::path::{Path, PathBuf};

use scene::{Geometry, Object, Scene};

pub use error::{ReadError, WriteError};
pub use format::Format;
pub use note::{Loss, Note, NoteKind};
pub use peek::{Peek, PeekGeometry, PeekMesh, PeekObject};
pub use policy::{NonManifold, Orientation, Policies, Unwanted};
pub use polygons::Polygons;
pub use provenance::provenance;

use note::Notes;

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

/// A file that a reader has looked at.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileSeen {
    /// Its path.
    pub path: PathBuf,
    /// Whether its content was wanted, be it there or not; otherwise only whether there is such a file.
    pub is_read: bool,
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
pub fn read(path: &Path, options: &ReadOptions) -> Result<Loaded, ReadError> {
    known_format(path)?;
    let mut loaded = read_bytes(path, read_whole(path)?, options)?;
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
pub fn read_bytes(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<Loaded, ReadError> {
    let mut notes = Notes::of(path);
    let mut objects = Vec::new();
    for Found { name, shape } in find(path, bytes, options, &mut notes)? {
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
    let files = notes.take_files();
    let notes = notes.into_vec();
    if options.strict {
        refuse_left_out(path, &notes)?;
    }
    Ok(Loaded {
        objects,
        notes,
        files,
    })
}

/// Reads the polygons of a file as they are, without building meshes: for programs that need no
/// connectivity. Curves, patches and polylines are left out.
///
/// # Errors
///
/// As [`read()`], but for what only building finds.
pub fn read_polygons(
    path: &Path,
    options: &ReadOptions,
) -> Result<Vec<(String, Polygons)>, ReadError> {
    known_format(path)?;
    let found = find(path, read_whole(path)?, options, &mut Notes::of(path))?;
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

impl Found {
    fn polygons(name: impl Into<String>, polygons: Polygons) -> Self {
        Self {
            name: name.into(),
            shape: Shape::Polygons(polygons),
        }
    }

    fn other(name: impl Into<String>, geometry: Geometry) -> Self {
        Self {
            name: name.into(),
            shape: Shape::Other(geometry),
        }
    }
}

fn find(
    path: &Path,
    bytes: Vec<u8>,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Vec<Found>, ReadError> {
    let name = options.name.clone().unwrap_or_else(|| name_of(path));
    let found = match known_format(path)? {
        Format::Obj => obj::read(path, &bytes, name, notes)?,
        Format::Gltf | Format::Glb => return gltf::read(path, bytes, &name, notes),
        Format::Ply => ply::read(path, &bytes, name, notes)?,
        Format::Stl => stl::read(path, &bytes, name, notes)?,
        Format::Off => off::read(path, &bytes, name, notes)?,
        Format::Dae => return dae::read(path, &bytes, &name, notes),
        Format::Mws => {
            let objects = mws::read(path, &bytes, options.name.as_deref())?;
            let found = objects.into_iter().map(|object| Found {
                name: object.name.clone(),
                shape: Shape::Whole(object.into()),
            });
            return Ok(found.collect());
        }
        Format::Bez => {
            let patches = bez::read_patches(&bytes).map_err(|error| error.in_file(path))?;
            Found::other(name, Geometry::Patches(patches))
        }
        Format::Bzc => {
            let curve = bez::read_curve(&bytes).map_err(|error| error.in_file(path))?;
            Found::other(name, Geometry::Curve(curve))
        }
    };
    Ok(vec![found])
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
        Format::Ply => ply::peek(path, &read_whole(path)?)?,
        Format::Stl => stl::peek(path, &read_whole(path)?)?,
        Format::Off => off::peek(path, &read_whole(path)?)?,
        Format::Dae => {
            return Ok(Peek {
                format,
                objects: dae::peek(path, &read_whole(path)?, &name)?,
            });
        }
        Format::Mws => {
            return Ok(Peek {
                format,
                objects: mws::peek(path, &read_whole(path)?, options.name.as_deref())?,
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
    let unknown = || WriteError::UnknownFormat {
        path: path.to_path_buf(),
        known: Format::known_to_write(),
    };
    let written = match Format::from_path(path).ok_or_else(unknown)? {
        Format::Obj => return obj::write(path, scene, options),
        Format::Gltf => gltf::write(path, false, scene, options),
        Format::Glb => gltf::write(path, true, scene, options),
        Format::Ply => ply::write(path, scene, options),
        Format::Stl => stl::write(path, scene, options),
        Format::Off => off::write(path, scene, options),
        Format::Dae => return Err(unknown()),
        Format::Mws => Ok(mws::write(path, scene, options)),
        Format::Bez => bez::write_bez(path, scene),
        Format::Bzc => bez::write_bzc(path, scene),
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
