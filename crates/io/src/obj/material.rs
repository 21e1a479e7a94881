//! Reads MTL files, the material libraries of OBJ files. The crate `tobj` parses the statements.

use std::collections::BTreeSet;
use std::path::Path;

use scene::{AlphaMode, Material, Texture};
use tobj::LoadError;

use super::file::ObjFile;
use super::picture::Picture;
use crate::assets::{Assets, inside};
use crate::fault::Fault;
use crate::note::Notes;
use crate::text::{check_encoding, name, quoted};

/// The maximum total size in bytes of the material libraries of a file. Bytes beyond this size are not read.
const MAX_LIBRARY_BYTES: u64 = 1 << 28;
/// The maximum number of library names that the reader looks up, including repeated names. Further names are left out,
/// because searching for very many files would be slow.
const MAX_NAMES: usize = 512;
/// The maximum length in bytes of a file name that is looked up.
const MAX_PATH_BYTES: usize = 1024;

/// Reads the materials of an OBJ file. The materials of the libraries come first, in the order of the libraries. Then,
/// for each material name that the OBJ file uses but no library defines, a default material follows.
///
/// # Errors
///
/// Returns an error if the path of a library is not inside the folder of the file. A missing library becomes a note.
pub(super) fn read_libraries(
    assets: &mut Assets,
    file: &ObjFile,
    notes: &mut Notes,
) -> Result<Vec<Material>, Fault> {
    let mut materials: Vec<Material> = Vec::new();
    let mut known = BTreeSet::new();
    let mut libraries = BTreeSet::new();
    let (mut n_names, mut further) = (0, 0);
    let mut room = MAX_LIBRARY_BYTES;
    for (place, words) in &file.libraries {
        let most = MAX_NAMES - n_names;
        let (names, rest) = library_names(words, most, assets);
        n_names += names.len();
        further += rest;
        for library in &names {
            let relative = inside(library).map_err(|why| {
                let message = format!("the material library {} {why}", quoted(library.as_bytes()));
                place.error(message)
            })?;
            if !libraries.insert(relative.clone()) {
                continue;
            }
            match assets.read(&relative, room) {
                Ok(bytes) => {
                    room -= bytes.len() as u64;
                    let folder = relative.parent().unwrap_or(Path::new("")).to_path_buf();
                    if !assets.image_folders.contains(&folder) && !folder.as_os_str().is_empty() {
                        assets.image_folders.push(folder);
                    }
                    let mut library_notes = Notes::of(&assets.place(&relative));
                    for material in read_library(&bytes, &mut library_notes) {
                        if known.insert(material.name.clone()) {
                            materials.push(material);
                        } else {
                            let what = format!("duplicate material `{}` left out", material.name);
                            library_notes.left_out("materials-repeated", 1, None, what);
                        }
                    }
                    notes.append(library_notes);
                }
                Err(error) => {
                    let what = format!("material library `{library}` left out: {error}");
                    notes.left_out("material-library-missing", 1, place.line, what);
                }
            }
        }
    }
    let what = "names of material libraries left out: too many";
    notes.left_out("too-many-names", further, None, what);
    for used in &file.material_names {
        if known.insert(used.clone()) {
            let what =
                format!("material `{used}` not found in any library: replaced by a white material");
            notes.changed("material-missing", 1, None, what);
            materials.push(Material::new(used));
        }
    }
    Ok(materials)
}

/// Returns the file names on an `mtllib` line. A name is one word, or several words if it is in quotes or if an
/// existing file has this name. Returns at most `most` names, and the number of words after them.
fn library_names(words: &str, most: usize, assets: &mut Assets) -> (Vec<String>, usize) {
    let mut is_file = |name: &str| {
        let short = Some(name).filter(|name| name.len() <= MAX_PATH_BYTES);
        let inside = short.and_then(|name| inside(name).ok());
        inside.is_some_and(|name| assets.has(&name))
    };
    let mut names = Vec::new();
    let mut rest = words.trim();
    while !rest.is_empty() && names.len() < most {
        let quoted = rest.strip_prefix('"').and_then(|rest| rest.split_once('"'));
        let (name, behind) = quoted.unwrap_or_else(|| {
            // A file name can contain blanks. The file name is the longest prefix of the text that is the name of an
            // existing file. If no prefix is the name of an existing file, the name is the first word of the text.
            let blanks = rest.rmatch_indices(char::is_whitespace).take(MAX_BLANKS);
            let ends = std::iter::once(rest.len()).chain(blanks.map(|(at, _)| at));
            let first = rest.find(char::is_whitespace).unwrap_or(rest.len());
            let end = ends.into_iter().find(|&end| is_file(&rest[..end]));
            rest.split_at(end.unwrap_or(first))
        });
        if !name.is_empty() {
            names.push(name.to_owned());
        }
        rest = behind.trim_start();
    }
    (names, rest.split_whitespace().count())
}

/// The reader tries to end a file name at this many blanks at most. It begins with the last blank of the line.
const MAX_BLANKS: usize = 16;

/// Reads the materials of one library. Lines that cannot be read are left out, with a note.
fn read_library(bytes: &[u8], notes: &mut Notes) -> Vec<Material> {
    // Normalizes line ends and encoding, because `tobj` only accepts LF and UTF-8.
    let text = name(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    if let Err(error) = check_encoding(bytes) {
        notes.left_out(
            "material-library-unreadable",
            1,
            1,
            format!("material library left out: {}", error.message),
        );
        return Vec::new();
    }
    let materials = statements(&without_broken_lines(&text, notes)).unwrap_or_default();
    let mut ignored = Ignored::default();
    let materials = materials.into_iter().map(|m| converted(m, &mut ignored));
    let materials = materials.collect();
    notes.left_out("material-values", ignored.0, None, "material values left out: the supported values are Kd, d, Tr, Pr, Pm, Ke, map_Kd, map_Ke, norm, and a texture that map_Pr and map_Pm share");
    materials
}

fn statements(text: &str) -> Result<Vec<tobj::Material>, LoadError> {
    tobj::load_mtl_buf(&mut text.as_bytes()).map(|(materials, _)| materials)
}

/// Parses each line separately and leaves out invalid lines, because `tobj` stops at the first invalid line and does
/// not report which line it is.
fn without_broken_lines(text: &str, notes: &mut Notes) -> String {
    let mut kept = String::with_capacity(text.len());
    for (i, line) in text.lines().enumerate() {
        match check_line(line) {
            Ok(()) => {
                kept.push_str(line);
                kept.push('\n');
            }
            Err(why) => {
                let what = format!("line {} left out: {why}", quoted(line.trim().as_bytes()));
                notes.left_out("material-lines", 1, i + 1, what);
            }
        }
    }
    kept
}

fn check_line(line: &str) -> Result<(), String> {
    let mut words = line.split_whitespace();
    let is_color = matches!(words.next(), Some("Ka" | "Kd" | "Ks" | "Ke"));
    // Without this check, `tobj` 4.0.5 panics on a color with fewer than 3 numbers.
    if is_color && words.count() < 3 {
        return Err("expected 3 numbers".to_owned());
    }
    statements(line)
        .map(|_| ())
        .map_err(|error| error.to_string())
}

/// The number of material values that are left out.
#[derive(Default)]
struct Ignored(usize);

impl Ignored {
    fn picture(&mut self, text: Option<String>) -> Option<Picture> {
        let picture = Picture::of(&text?);
        self.0 += picture.as_ref().map_or(1, |picture| picture.n_options);
        picture
    }

    /// Parses the declaration of a texture. If it has a multiplier (the option `-bm`), the multiplier is left out.
    fn plain(&mut self, text: Option<String>) -> Option<Texture> {
        let picture = self.picture(text)?;
        self.0 += usize::from(picture.multiplier.is_some());
        Some(picture.texture)
    }
}

fn converted(from: tobj::Material, ignored: &mut Ignored) -> Material {
    let mut unknown = from.unknown_param;
    // If a comment has no blank after `#`, `tobj` treats the comment as a parameter. Such parameters are removed.
    unknown.retain(|key, _| !key.starts_with('#'));
    let mut number = |key: &str| {
        let value = unknown.get(key)?.parse::<f64>().ok()?;
        unknown.remove(key);
        value.is_finite().then_some(value)
    };
    let (roughness, metallic, transparency) = (number("Pr"), number("Pm"), number("Tr"));
    let base_color_texture = ignored.plain(from.diffuse_texture);
    let emissive_texture = ignored.plain(unknown.remove("map_Ke"));
    let [rough, metal] = ["map_Pr", "map_Pm"].map(|key| ignored.plain(unknown.remove(key)));
    // In the scene, as in glTF, one texture stores both roughness and metalness. In MTL, roughness and metalness have
    // separate textures. These textures are read only if both of them are the same file.
    let metallic_roughness_texture = if rough == metal {
        rough
    } else {
        ignored.0 += usize::from(rough.is_some()) + usize::from(metal.is_some());
        None
    };
    let normals = ignored.picture(unknown.remove("norm"));
    let normal_scale = normals.as_ref().and_then(|picture| picture.multiplier);
    let ignored_now = [
        from.ambient.is_some(),
        from.specular.is_some(),
        from.shininess.is_some(),
        from.optical_density.is_some(),
        from.illumination_model.is_some(),
        from.ambient_texture.is_some(),
        from.specular_texture.is_some(),
        from.normal_texture.is_some(),
        from.shininess_texture.is_some(),
        from.dissolve_texture.is_some(),
    ];
    ignored.0 += ignored_now.into_iter().filter(|&is| is).count() + unknown.len();
    let [red, green, blue] = from.diffuse.unwrap_or([1.0; 3]).map(|x| unit(x, 1.0));
    let alpha = from.dissolve.or(transparency.map(|t| 1.0 - t));
    let alpha = unit(alpha.unwrap_or(1.0), 1.0);
    let default = emissive_texture.is_some().then_some([1.0; 3]);
    let emitted = from.emissive.or(default);
    let (emissive, emissive_strength) = light(emitted.unwrap_or_default());
    Material {
        base_color: [red, green, blue, alpha],
        base_color_texture,
        metallic: unit(metallic.unwrap_or(0.0), 0.0),
        roughness: unit(roughness.unwrap_or(1.0), 1.0),
        metallic_roughness_texture,
        normal_texture: normals.map(|picture| picture.texture),
        normal_scale: normal_scale.unwrap_or(1.0),
        emissive,
        emissive_strength,
        emissive_texture,
        alpha: alpha_mode(alpha),
        ..Material::new(from.name)
    }
}

/// Converts emitted light to a color with components from 0 to 1, and a strength of at least 1.
fn light(values: [f64; 3]) -> ([f64; 3], f64) {
    let values = values.map(|x| if x.is_finite() { x.max(0.0) } else { 0.0 });
    let strength = values.iter().copied().fold(1.0, f64::max);
    (values.map(|x| x / strength), strength)
}

/// Returns the alpha mode that readers of MTL files assume: materials with an alpha below 1 are blended.
pub(super) fn alpha_mode(alpha: f64) -> AlphaMode {
    if alpha < 1.0 {
        AlphaMode::Blend
    } else {
        AlphaMode::Opaque
    }
}

/// Clamps `x` to the range from 0 to 1. Returns `otherwise` if `x` is not finite.
fn unit(x: f64, otherwise: f64) -> f64 {
    if x.is_finite() {
        x.clamp(0.0, 1.0)
    } else {
        otherwise
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::library::write_library;
    use super::*;

    fn read(bytes: &[u8]) -> (Vec<Material>, Vec<crate::Note>) {
        let mut notes = Notes::of("a.mtl".as_ref());
        let materials = read_library(bytes, &mut notes);
        (materials, notes.into_vec())
    }

    fn red() -> Material {
        Material {
            base_color: [0.8, 0.1, 0.1, 0.5],
            metallic: 0.25,
            roughness: 0.3,
            base_color_texture: Some(Texture::file("pictures/red one.png")),
            alpha: AlphaMode::Blend,
            ..Material::new("red paint")
        }
    }

    fn lamp() -> Material {
        Material {
            metallic_roughness_texture: Some(Texture::file("rm.png")),
            normal_texture: Some(Texture::file("bumps.png")),
            normal_scale: 0.5,
            emissive: [1.0, 0.25, 0.0],
            emissive_strength: 4.0,
            emissive_texture: Some(Texture::file("glow.png")),
            ..Material::new("lamp")
        }
    }

    #[test]
    fn written_materials_are_read_unchanged() {
        let materials = vec![red(), lamp(), Material::new("plain")];
        assert_eq!(
            read(&write_library(&materials, Some("made by hand"))),
            (materials, vec![])
        );
    }

    #[test]
    fn a_broken_line_is_left_out_with_its_number() {
        let (materials, notes) = read(b"newmtl a\r\nKd 1 0\r\nKd spectral x.rfl 1\nPr 0.5\n");
        assert_eq!(materials.len(), 1);
        assert_eq!(materials[0].roughness, 0.5);
        assert_eq!(
            notes.iter().map(|note| note.line).collect::<Vec<_>>(),
            [Some(2), Some(3)]
        );
    }

    #[test]
    fn values_left_out_are_counted() {
        let (_, notes) = read(b"#x\nnewmtl a\nKa 1 1 1\nNs 10\nillum 2\naniso 0.5\nTr 0.25\n");
        assert_eq!(notes[0].count, 4);
    }

    #[test]
    fn texture_options_are_counted_and_are_not_part_of_the_name() {
        let (materials, notes) = read(
            b"newmtl a\nmap_Kd -s 2 2 1 -clamp on my file.png\nnorm -bm 0.5 n.png\nmap_Pr r.png\n\
              map_Pm m.png\nmap_bump b.png\nmap_Ke -s 1 1 1\n",
        );
        let expected = Material {
            base_color_texture: Some(Texture::file("my file.png")),
            normal_texture: Some(Texture::file("n.png")),
            normal_scale: 0.5,
            ..Material::new("a")
        };
        assert_eq!(materials, [expected]);
        assert_eq!(notes[0].count, 6);
    }

    #[test]
    fn emission_above_one_becomes_a_strength() {
        let (materials, _) = read(b"newmtl a\nKe 2 1 -1\nnewmtl b\nmap_Ke b.png\n");
        assert_eq!(materials[0].emissive, [1.0, 0.5, 0.0]);
        assert_eq!(materials[0].emissive_strength, 2.0);
        assert_eq!(materials[1].emissive, [1.0; 3]);
    }

    #[test]
    fn names_in_latin1_and_out_of_range_values_are_read() {
        let (materials, _) = read(b"newmtl caf\xe9\nKd 2 nan -1\nTr 0.25");
        assert_eq!(materials[0].name, "café");
        assert_eq!(materials[0].base_color, [1.0, 1.0, 0.0, 0.75]);
    }

    proptest! {
        #[test]
        fn random_bytes_do_not_panic(
            bytes: Vec<u8>,
            text in "((newmtl|Kd|d|map_Kd|illum|Tr|bump|x)[ \t]?[a-z0-9.é ]{0,8}\n){0,20}",
        ) {
            read(&bytes);
            read(text.as_bytes());
        }
    }
}
