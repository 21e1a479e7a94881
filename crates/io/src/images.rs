//! Handles the images of materials. When a model is read, the reader searches for images in the folders of the material
//! libraries, and then in the folder of the model. When a scene is written, images are embedded or copied.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use scene::{Image, Material, Object, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use store::{Store, folder_of};

use crate::assets::{Assets, inside};
use crate::error::WriteError;
use crate::note::Notes;
use crate::save::Content;
use crate::text::quoted;
use crate::{Format, WriteOptions, gzip};

/// What to do with the images of materials when a scene is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Images {
    /// Store the images in the file or, for `.gltf`, in its `.bin` file. OBJ files cannot embed images, so with
    /// `Embed`, writing a scene with images to an OBJ file fails.
    Embed,
    /// Write the images to files in the folder of the written file. An image file keeps its path relative to the model.
    /// For example, `textures/a.png` in the folder of the original model becomes `textures/a.png` in the folder of the
    /// written file. An image that was embedded in the original model gets the name of the written file, with the
    /// extension of the image. If a file with different content already has this path, a number is appended to the name
    /// of the image.
    Copy,
    /// Write only the paths of the images, as in the original model. Images that are embedded in the original model
    /// stay embedded in glTF files and are lost in OBJ files.
    Keep,
}

/// The maximum number of different image files of a model that are loaded. Further images are left out, because
/// searching for very many files would be slow.
const MAX_IMAGES: usize = 4096;

/// Loads the image files that the materials refer to. If an image cannot be read, its path is kept, and a note is
/// added. `most` is the maximum total size of the images in bytes.
pub(crate) fn load(objects: &mut [Object], assets: &mut Assets, most: u64, notes: &mut Notes) {
    let mut known: BTreeMap<String, Option<Image>> = BTreeMap::new();
    let (mut room, mut n_further) = (most, 0);
    let materials = objects.iter_mut().flat_map(|object| &mut object.materials);
    for texture in materials.flat_map(Material::textures_mut) {
        let Image::File(path) = &texture.image else {
            continue;
        };
        let image = match known.get(path) {
            Some(image) => image.clone(),
            None if known.len() == MAX_IMAGES => {
                n_further += 1;
                continue;
            }
            None => {
                let image = find(path, assets, &mut room);
                let image = image.map_err(|why| note_left_out(path, &why, notes));
                known.insert(path.clone(), image.clone().ok());
                image.ok()
            }
        };
        if let Some(image) = image {
            texture.image = image;
        }
    }
    let what = "references to images left out: too many images";
    notes.left_out("image-missing", n_further, None, what);
}

/// Adds the same notes about missing images as [`load`], but does not read the images. `paths` are the paths of the
/// image files that materials refer to.
pub(crate) fn note_missing<'p>(
    paths: impl IntoIterator<Item = &'p str>,
    assets: &mut Assets,
    notes: &mut Notes,
) {
    let mut known = BTreeSet::new();
    for path in paths {
        if known.len() == MAX_IMAGES || !known.insert(path) {
            continue;
        }
        if let Err(why) = located(path, assets) {
            note_left_out(path, &why, notes);
        }
    }
}

fn note_left_out(path: &str, why: &str, notes: &mut Notes) {
    let what = format!("image {} left out: {why}", quoted(path.as_bytes()));
    notes.left_out("image-missing", 1, None, what);
}

/// Finds an image in a folder of [`Assets::image_folders`] or in the folder of the model. Returns its path relative to
/// the folder of the model.
///
/// # Errors
///
/// Returns the reason why the image file cannot be used.
fn located(path: &str, assets: &mut Assets) -> Result<PathBuf, String> {
    let mut folders = assets.image_folders.clone();
    folders.push(PathBuf::new());
    for folder in folders {
        let joined = folder.join(path);
        let name = joined.to_str().and_then(|path| inside(path).ok());
        if let Some(name) = name.filter(|name| assets.has(name)) {
            return Ok(name);
        }
    }
    let full = assets.place(&inside(path)?);
    Err(format!("the file {} does not exist", full.display()))
}

/// Reads an image from a folder of [`Assets::image_folders`] or the folder of the model.
///
/// # Errors
///
/// Returns the reason why the image is left out.
fn find(path: &str, assets: &mut Assets, room: &mut u64) -> Result<Image, String> {
    let name = located(path, assets)?;
    let bytes = assets.read(&name, room.saturating_add(1));
    let bytes = bytes.map_err(|error| error.to_string())?;
    let left = room.checked_sub(bytes.len() as u64);
    *room = left.ok_or("the images of the model exceed the memory budget")?;
    if media_type(&name, &bytes).is_none() {
        return Err("it is not an image".to_owned());
    }
    // If the image was found in the folder of the model, the path is kept as it is written in the model.
    let path = if inside(path).as_ref() == Ok(&name) {
        path.to_owned()
    } else {
        slashed(&name)
    };
    let bytes = bytes.into();
    Ok(Image::Loaded { path, bytes })
}

/// The path with `/` as separator.
fn slashed(path: &Path) -> String {
    let parts = path.iter().map(|part| part.to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}

/// Extensions of image files with their media types. A new image file gets the first extension in this list that has
/// the media type of the image.
const KINDS: [(&str, &str); 16] = [
    ("png", "image/png"),
    ("jpg", "image/jpeg"),
    ("jpeg", "image/jpeg"),
    ("webp", "image/webp"),
    ("gif", "image/gif"),
    ("bmp", "image/bmp"),
    ("tga", "image/x-tga"),
    ("tif", "image/tiff"),
    ("tiff", "image/tiff"),
    ("dds", "image/vnd-ms.dds"),
    ("ktx", "image/ktx"),
    ("ktx2", "image/ktx2"),
    ("exr", "image/x-exr"),
    ("hdr", "image/vnd.radiance"),
    ("avif", "image/avif"),
    ("svg", "image/svg+xml"),
];

/// Returns the media type of an image file. The first bytes of the file determine the type. If these bytes do not
/// belong to a known type, the extension of the file determines the type. Returns `None` if the file does not seem to
/// be an image. Such a file is never embedded or copied.
fn media_type(path: &Path, bytes: &[u8]) -> Option<&'static str> {
    let extension = path.extension().unwrap_or_default();
    let of_bytes = sniffed(bytes);
    let of_name = || {
        KINDS
            .iter()
            .find(|(e, _)| extension.eq_ignore_ascii_case(e))
    };
    of_bytes.or_else(|| Some(of_name()?.1))
}

/// Returns the media type of a PNG or JPEG file from its first bytes.
pub(crate) fn sniffed(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xff, 0xd8, 0xff, ..] => Some("image/jpeg"),
        _ => None,
    }
}

/// A scene, and the image files that must be written with it. For OBJ and glTF, each image of the scene is either
/// [`Image::Embedded`] or [`Image::File`], never [`Image::Loaded`].
pub(crate) struct Settled<'a> {
    pub(crate) scene: Cow<'a, Scene>,
    pub(crate) files: Vec<(PathBuf, Content<'static>)>,
}

/// Decides for each image of a scene whether it is embedded or copied, or whether only its path is written. Creates the
/// folders of copied images.
///
/// # Errors
///
/// Returns an error if an image would be embedded in an OBJ file. Also returns an error if a folder for images cannot
/// be created or is outside the folder of the file.
pub(crate) fn settle<'a>(
    store: &dyn Store,
    path: &Path,
    format: Format,
    scene: &'a Scene,
    options: &WriteOptions,
) -> Result<Settled<'a>, WriteError> {
    let keeps_materials = matches!(format, Format::Obj | Format::Gltf | Format::Glb);
    let materials = scene.objects().iter().flat_map(|object| &object.materials);
    let mut textures = materials.flat_map(Material::textures);
    if !keeps_materials || textures.all(|texture| matches!(texture.image, Image::File(_))) {
        let scene = Cow::Borrowed(scene);
        let files = Vec::new();
        return Ok(Settled { scene, files });
    }
    if (format, options.images) == (Format::Obj, Some(Images::Embed)) {
        return Err(WriteError::Scene {
            path: path.to_path_buf(),
            message: "OBJ files cannot embed images: use `Copy`".to_owned(),
        });
    }
    let mut copies = Copies::new(store, path);
    let mut settled = Scene::new();
    for object in scene.objects() {
        let mut object = object.clone();
        for texture in object.materials.iter_mut().flat_map(Material::textures_mut) {
            texture.image = match (options.images, format, &texture.image) {
                (Some(Images::Embed), _, Image::Loaded { path, bytes })
                | (None, Format::Glb, Image::Loaded { path, bytes }) => Image::Embedded {
                    mime: media_type(path.as_ref(), bytes)
                        .unwrap_or("application/octet-stream")
                        .to_owned(),
                    bytes: bytes.clone(),
                },
                (Some(Images::Keep), _, Image::Loaded { path, .. }) => Image::File(path.clone()),
                (_, _, Image::Loaded { path, bytes }) => {
                    let name = inside(path).ok();
                    Image::File(copies.copy(name, bytes)?)
                }
                (Some(Images::Copy), _, Image::Embedded { mime, bytes })
                | (None, Format::Obj, Image::Embedded { mime, bytes }) => {
                    Image::File(copies.copy(new_name(path, mime), bytes)?)
                }
                (_, _, Image::File(_) | Image::Embedded { .. }) => continue,
            };
        }
        let inserted = settled.insert(object);
        inserted.expect("the names of the objects are those of the scene");
    }
    settled.graph_mut().clone_from(scene.graph());
    Ok(Settled {
        scene: Cow::Owned(settled),
        files: copies.files,
    })
}

/// The name of the file to which an embedded image is written: the name of the model with the extension of the image.
fn new_name(path: &Path, mime: &str) -> Option<PathBuf> {
    let (extension, _) = KINDS.iter().find(|(_, known)| *known == mime)?;
    Some(
        gzip::plain(path)
            .with_extension(extension)
            .file_name()?
            .into(),
    )
}

/// The images that are written to files in the folder of a model.
struct Copies<'a> {
    store: &'a dyn Store,
    /// The file of the model.
    path: &'a Path,
    /// The image at each path that is already used. Paths are relative to the folder of the model. The value is `None`
    /// if the path belongs to the model itself, such as the path of its `.mtl` file.
    taken: BTreeMap<PathBuf, Option<Arc<[u8]>>>,
    files: Vec<(PathBuf, Content<'static>)>,
    folders: BTreeSet<PathBuf>,
}

impl<'a> Copies<'a> {
    fn new(store: &'a dyn Store, path: &'a Path) -> Self {
        let names = ["mtl", "bin"].map(|extension| gzip::plain(path).with_extension(extension));
        let names = names.iter().map(PathBuf::as_path).chain([path]);
        let own = names.filter_map(|path| Some((path.file_name()?.into(), None)));
        Self {
            store,
            path,
            taken: own.collect(),
            files: Vec::new(),
            folders: BTreeSet::new(),
        }
    }

    /// Chooses the path of an image, relative to the folder of the model, with `/` as separator. The path is `name`,
    /// unless a different file already has this path.
    fn copy(&mut self, name: Option<PathBuf>, bytes: &Arc<[u8]>) -> Result<String, WriteError> {
        let first = name.unwrap_or_else(|| "image".into());
        let mut name = first.clone();
        for number in 2.. {
            let known = self.taken.get(&name).cloned();
            match known {
                Some(Some(known)) if Arc::ptr_eq(&known, bytes) || known == *bytes => {
                    return Ok(slashed(&name));
                }
                None if self.is_free(&name, bytes)? => break,
                _ => {}
            }
            let stem = first.file_stem().unwrap_or_default().to_string_lossy();
            let extension = first.extension().map(|e| e.to_string_lossy());
            let extension = extension.map(|e| format!(".{e}")).unwrap_or_default();
            name = first.with_file_name(format!("{stem}.{number}{extension}"));
        }
        self.taken.insert(name.clone(), Some(bytes.clone()));
        Ok(slashed(&name))
    }

    /// Whether the image can have this path: no file has this path, or the file with this path has the same content as
    /// the image. If no file has this path, the image is added to the list of files to write.
    fn is_free(&mut self, name: &Path, bytes: &Arc<[u8]>) -> Result<bool, WriteError> {
        let target = folder_of(self.path).join(name);
        if self.store.exists(&target) {
            let existing = self.store.read_up_to(&target, bytes.len() as u64 + 1);
            return Ok(existing.is_ok_and(|existing| existing[..] == bytes[..]));
        }
        let folder = folder_of(&target).to_path_buf();
        if self.folders.insert(folder.clone()) {
            self.check_links(&folder)?;
            self.store.make_folder(&folder)?;
        }
        self.files.push((target, Content::Shared(bytes.clone())));
        Ok(true)
    }

    /// Returns an error if a link in the path leads out of the folder of the model.
    fn check_links(&self, folder: &Path) -> Result<(), WriteError> {
        let Ok(root) = self.store.canonical(folder_of(self.path)) else {
            // If the folder does not exist, writing the image fails later.
            return Ok(());
        };
        let existing = folder
            .ancestors()
            .find_map(|folder| self.store.canonical(folder).ok());
        match existing {
            Some(real) if !real.starts_with(&root) => Err(WriteError::Scene {
                path: self.path.to_path_buf(),
                message: format!(
                    "the image folder {} must be inside the folder of the written file, but a symbolic link leads out of that folder",
                    folder.display()
                ),
            }),
            _ => Ok(()),
        }
    }
}
