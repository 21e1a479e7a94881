//! The table of formats: their names, their extensions, and whether files can be read and written.

use std::fmt;
use std::path::Path;

use mesh::Domain;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::gzip;

/// A file format, which is determined by the extension of the file name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Format {
    /// Wavefront OBJ: polygons as text, materials in a separate MTL file.
    Obj,
    /// glTF 2.0 as JSON text. Binary data is inside the text or in a separate file.
    Gltf,
    /// glTF 2.0 as one binary file.
    Glb,
    /// Stanford PLY: polygons with any properties, in text or binary files.
    Ply,
    /// STL: triangles without connectivity, in text or binary files.
    Stl,
    /// Object file format (Geomview): polygons as text.
    Off,
    /// COLLADA: polygons, materials and objects with transforms, as XML. Read only.
    Dae,
    /// A whole Meshwright scene, stored without any loss.
    Mws,
    /// Bicubic Bezier patches as text.
    Bez,
    /// A planar Bezier curve as text.
    Bzc,
    /// A table of the elements of a mesh as text. Write only.
    Csv,
    /// The arrays of a mesh for `NumPy`. Write only.
    Npz,
}

/// Every format with its extension and its name, in the order in which messages list them.
const TABLE: [(Format, &str, &str); 12] = [
    (Format::Obj, "obj", "OBJ"),
    (Format::Gltf, "gltf", "glTF"),
    (Format::Glb, "glb", "GLB"),
    (Format::Ply, "ply", "PLY"),
    (Format::Stl, "stl", "STL"),
    (Format::Off, "off", "OFF"),
    (Format::Dae, "dae", "COLLADA"),
    (Format::Mws, "mws", "Meshwright scene"),
    (Format::Bez, "bez", "Bezier patches"),
    (Format::Bzc, "bzc", "Bezier curve"),
    (Format::Csv, "csv", "CSV"),
    (Format::Npz, "npz", "NPZ"),
];

impl Format {
    /// All formats, in the order in which messages list them.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.into_iter().map(|(format, ..)| format)
    }

    /// The file extension of the format, in lower case and without the dot.
    pub fn extension(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// Returns the format with the extension of `path`, in upper or lower case. Returns `None` if the extension is
    /// unknown or missing. The name of a file compressed with gzip ends in `.gz` after the extension of its format.
    /// Files of the formats `.glb`, `.mws` and `.npz` cannot be compressed.
    pub fn from_path(path: &Path) -> Option<Self> {
        let plain = gzip::plain(path);
        let extension = plain.extension()?;
        let format = Self::all().find(|f| extension.eq_ignore_ascii_case(f.extension()))?;
        let is_binary = matches!(format, Self::Glb | Self::Mws | Self::Npz);
        (!is_binary || !gzip::is_compressed(path)).then_some(format)
    }

    /// Whether files of this format can be read.
    pub const fn can_read(self) -> bool {
        !matches!(self, Self::Csv | Self::Npz)
    }

    /// Whether files of this format can be written.
    pub const fn can_write(self) -> bool {
        !matches!(self, Self::Dae)
    }

    /// Whether the writer of this format can compress and quantize meshes. True for `.gltf` and `.glb`.
    pub const fn packs(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb)
    }

    /// The extensions of the formats that can be read, as messages list them: `.obj, .gltf, ...`.
    pub fn readable_extensions() -> String {
        list(Self::all().filter(|format| format.can_read()))
    }

    /// The extensions of the formats that can be written, as messages list them: `.obj, .gltf, ...`.
    pub fn writable_extensions() -> String {
        list(Self::all().filter(|format| format.can_write()))
    }
}

fn list(formats: impl Iterator<Item = Format>) -> String {
    let extensions = formats.map(|f| format!(".{}", f.extension()));
    extensions.collect::<Vec<_>>().join(", ")
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(TABLE[*self as usize].2)
    }
}

/// The kind of elements that a `.csv` file lists. Each of these elements has a row.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Rows {
    /// Vertices.
    #[default]
    Vertices,
    /// Faces. The position of a face is the mean of its corners.
    Faces,
    /// The corners of the faces, face by face.
    Corners,
}

impl Rows {
    pub(crate) const fn domain(self) -> Domain {
        match self {
            Self::Vertices => Domain::Vertex,
            Self::Faces => Domain::Face,
            Self::Corners => Domain::Corner,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_determines_the_format_in_upper_or_lower_case() {
        assert_eq!(
            Format::from_path(Path::new("a/Teapot.OBJ")),
            Some(Format::Obj)
        );
        assert_eq!(Format::from_path(Path::new("x.tar.glb")), Some(Format::Glb));
        assert_eq!(Format::from_path(Path::new("x.PLY.Gz")), Some(Format::Ply));
        for name in ["x.gz", "x.glb.gz", "x.mws.gz", "obj.gz", "x.obj.gz.gz"] {
            assert_eq!(Format::from_path(Path::new(name)), None, "{name}");
        }
        assert_eq!(Format::from_path(Path::new("obj")), None);
        assert_eq!(Format::from_path(Path::new("x.xyz")), None);
    }

    #[test]
    fn every_extension_maps_back_to_its_format() {
        for format in Format::all() {
            assert_eq!(TABLE[format as usize].0, format);
            let path = format!("x.{}", format.extension());
            assert_eq!(Format::from_path(Path::new(&path)), Some(format));
        }
    }
}
