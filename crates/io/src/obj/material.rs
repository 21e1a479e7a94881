//! MTL, the material libraries of OBJ files. `tobj` reads the statements.

use std::collections::BTreeSet;
use std::path::Path;

use scene::{AlphaMode, Material, Texture};
use tobj::LoadError;

use super::file::ObjFile;
use crate::asset_path::{folder_of, inside, read_beside};
use crate::decimal::push_number;
use crate::error::ReadError;
use crate::note::Notes;
use crate::text::{name, quoted};

/// No material library is larger than this, in bytes.
const LARGEST: u64 = 1 << 28;

/// The materials of an OBJ file: those of its libraries in their order, then plain ones for the names
/// that no library defines.
///
/// # Errors
///
/// If a library's path leaves the folder of `path`. A missing library is a note.
pub(super) fn read_libraries(
    path: &Path,
    file: &ObjFile,
    notes: &mut Notes,
) -> Result<Vec<Material>, ReadError> {
    let mut materials: Vec<Material> = Vec::new();
    let mut known = BTreeSet::new();
    for (place, words) in &file.libraries {
        // A name may hold blanks, and a line may hold several names.
        let whole = inside(words).is_ok_and(|name| folder_of(path).join(name).is_file());
        let names = if whole {
            vec![words.as_str()]
        } else {
            words.split_whitespace().collect()
        };
        for library in names {
            let relative = inside(library).map_err(|why| {
                let message = format!("the material library {} {why}", quoted(library.as_bytes()));
                place.error(message).in_file(path)
            })?;
            match read_beside(path, &relative, LARGEST) {
                Ok(bytes) => {
                    let mut library_notes = Notes::of(&folder_of(path).join(&relative));
                    for material in read_library(&bytes, &mut library_notes) {
                        if known.insert(material.name.clone()) {
                            materials.push(material);
                        } else {
                            let what = format!("repeated material `{}` left out", material.name);
                            library_notes.left_out(1, None, what);
                        }
                    }
                    notes.append(library_notes);
                }
                Err(error) => notes.left_out(
                    1,
                    place.line,
                    format!("material library `{library}` left out: {error}"),
                ),
            }
        }
    }
    for wanted in &file.material_names {
        if known.insert(wanted.clone()) {
            let what = format!("material `{wanted}` is in no library: taken as plain white");
            notes.changed(1, None, what);
            materials.push(Material::new(wanted));
        }
    }
    Ok(materials)
}

/// The materials of one library. Lines that cannot be read are left out, with a note.
fn read_library(bytes: &[u8], notes: &mut Notes) -> Vec<Material> {
    // Three kinds of line ends and names in Latin-1: tobj knows LF and UTF-8.
    let text = name(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let materials = statements(&without_broken_lines(&text, notes)).unwrap_or_default();
    let mut ignored = Ignored::default();
    let materials = materials
        .into_iter()
        .map(|m| converted(m, &mut ignored))
        .collect();
    notes.left_out(ignored.0, None, "values of materials left out: only color, alpha, roughness (Pr), metalness (Pm) and the color picture are kept");
    materials
}

fn statements(text: &str) -> Result<Vec<tobj::Material>, LoadError> {
    tobj::load_mtl_buf(&mut text.as_bytes()).map(|(materials, _)| materials)
}

/// Tries each line by itself: tobj stops at the first broken one and does not say where.
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
                notes.left_out(1, i + 1, what);
            }
        }
    }
    kept
}

fn check_line(line: &str) -> Result<(), String> {
    let mut words = line.split_whitespace();
    let is_color = matches!(words.next(), Some("Ka" | "Kd" | "Ks" | "Ke"));
    // tobj 4.0.5 panics here.
    if is_color && words.count() < 3 {
        return Err("expected 3 numbers".to_owned());
    }
    statements(line)
        .map(|_| ())
        .map_err(|error| error.to_string())
}

/// How many values of materials were left out.
#[derive(Default)]
struct Ignored(usize);

fn converted(from: tobj::Material, ignored: &mut Ignored) -> Material {
    let parameter = |key: &str| {
        let value = from.unknown_param.get(key)?.parse::<f64>().ok()?;
        value.is_finite().then_some(value)
    };
    let (roughness, metallic, transparency) = (parameter("Pr"), parameter("Pm"), parameter("Tr"));
    let alpha = from.dissolve.or(transparency.map(|t| 1.0 - t));
    let used = [roughness, metallic, transparency].iter().flatten().count();
    let ignored_now = [
        from.ambient.is_some(),
        from.specular.is_some(),
        from.emissive.is_some(),
        from.shininess.is_some(),
        from.optical_density.is_some(),
        from.illumination_model.is_some(),
        from.ambient_texture.is_some(),
        from.specular_texture.is_some(),
        from.normal_texture.is_some(),
        from.shininess_texture.is_some(),
        from.dissolve_texture.is_some(),
    ];
    // tobj takes a comment without a blank after its `#` for a parameter.
    let others = from
        .unknown_param
        .keys()
        .filter(|key| !key.starts_with('#'))
        .count();
    ignored.0 += ignored_now.into_iter().filter(|&is| is).count() + others.saturating_sub(used);
    let [red, green, blue] = from.diffuse.unwrap_or([1.0; 3]).map(|x| unit(x, 1.0));
    let alpha = unit(alpha.unwrap_or(1.0), 1.0);
    Material {
        base_color: [red, green, blue, alpha],
        alpha: alpha_mode(alpha),
        metallic: unit(metallic.unwrap_or(0.0), 0.0),
        roughness: unit(roughness.unwrap_or(1.0), 1.0),
        base_color_texture: from.diffuse_texture.map(Texture::file),
        ..Material::new(from.name)
    }
}

/// A dissolved surface lets through what is behind it.
fn alpha_mode(alpha: f64) -> AlphaMode {
    if alpha < 1.0 {
        AlphaMode::Blend
    } else {
        AlphaMode::Opaque
    }
}

/// `x` between 0 and 1, `otherwise` if it is no number.
fn unit(x: f64, otherwise: f64) -> f64 {
    if x.is_finite() {
        x.clamp(0.0, 1.0)
    } else {
        otherwise
    }
}

/// The text of a library with these materials. Their names must fit a line.
pub(super) fn write_library(materials: &[Material], comment: Option<&str>) -> Vec<u8> {
    let mut out = Vec::new();
    if let Some(comment) = comment {
        super::write::push_comment(&mut out, comment);
    }
    for material in materials {
        out.extend_from_slice(format!("newmtl {}\n", material.name).as_bytes());
        let [red, green, blue, alpha] = material.base_color;
        push_values(&mut out, "Kd", &[red, green, blue]);
        push_values(&mut out, "d", &[alpha]);
        push_values(&mut out, "Pm", &[material.metallic]);
        push_values(&mut out, "Pr", &[material.roughness]);
        if let Some(picture) = material.base_color_texture.as_ref().and_then(Texture::path) {
            out.extend_from_slice(format!("map_Kd {picture}\n").as_bytes());
        }
    }
    out
}

pub(super) fn push_values(out: &mut Vec<u8>, keyword: &str, values: &[f64]) {
    out.extend_from_slice(keyword.as_bytes());
    for &value in values {
        out.push(b' ');
        push_number(out, value);
    }
    out.push(b'\n');
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn read(bytes: &[u8]) -> (Vec<Material>, Vec<crate::Note>) {
        let mut notes = Notes::of(Path::new("a.mtl"));
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

    #[test]
    fn written_materials_read_back_the_same() {
        let materials = vec![red(), Material::new("plain")];
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
    fn other_values_are_counted() {
        let (_, notes) = read(b"#x\nnewmtl a\nKa 1 1 1\nNs 10\nillum 2\naniso 0.5\nTr 0.25\n");
        assert_eq!(notes[0].count, 4);
    }

    #[test]
    fn names_in_latin1_and_missing_alpha_are_understood() {
        let (materials, _) = read(b"newmtl caf\xe9\nKd 2 nan -1\nTr 0.25");
        assert_eq!(materials[0].name, "café");
        assert_eq!(materials[0].base_color, [1.0, 1.0, 0.0, 0.75]);
    }

    proptest! {
        #[test]
        fn any_bytes_are_read(
            bytes: Vec<u8>,
            text in "((newmtl|Kd|d|map_Kd|illum|Tr|bump|x)[ \t]?[a-z0-9.é ]{0,8}\n){0,20}",
        ) {
            read(&bytes);
            read(text.as_bytes());
        }
    }
}
