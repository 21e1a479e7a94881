//! Defines which content each format can store. The writers use these definitions, and the program uses them to check a
//! recipe before it runs the recipe.

use mesh::{COLOR, CORNER_NORMAL, Domain, MATERIAL, SMOOTHING, UV, VERTEX_NORMAL, Values, counted};

use crate::joined::Names;
use crate::off::COLOR_INDEX;
use crate::{Format, Rows, gltf};

/// How much of an attribute a format stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Nothing.
    Lost,
    /// All, some or none of the values. Which values are stored depends on their content.
    Partial,
    /// All finite values.
    Kept,
}

/// Determines which attributes of a mesh are stored in a file of a certain format.
#[derive(Clone, Copy)]
pub struct Stored<'a> {
    /// The format.
    pub format: Format,
    /// For `.csv` files: the kind of elements that the rows list, for example vertices.
    pub rows: Rows,
    /// Whether the mesh has an attribute with this domain and name.
    pub has: &'a dyn Fn(Domain, &str) -> bool,
}

impl Stored<'_> {
    /// The name of the format, for messages.
    pub fn name(&self) -> String {
        match self.format {
            Format::Csv => format!("CSV with a row for each {}", self.rows.domain()),
            Format::Glb => Format::Gltf.to_string(),
            format => format.to_string(),
        }
    }

    /// Returns how much of an attribute the format stores. Only the type of `values` matters. If `values` is `None`,
    /// the name of the attribute usually determines the type: for example, `color` has four numbers. A name without a
    /// known type can have any type. If the format stores such an attribute differently for different types, returns
    /// [`Storage::Partial`].
    pub fn storage(&self, domain: Domain, name: &str, values: Option<&Values>) -> Storage {
        let of_type = |values: &Values| self.storage_of(domain, name, values);
        if let Some(values) = values {
            return of_type(values);
        }
        let known = usual_type(domain, name);
        let all = types();
        let mut possible = match &known {
            Some(usual) => std::slice::from_ref(usual),
            None => &all[..],
        }
        .iter()
        .map(of_type);
        let first = possible.next().unwrap_or(Storage::Partial);
        if possible.all(|next| next == first) {
            first
        } else {
            Storage::Partial
        }
    }

    fn storage_of(&self, domain: Domain, name: &str, values: &Values) -> Storage {
        use Storage::{Kept, Lost, Partial};
        let has = self.has;
        let kept_if = |is_kept| if is_kept { Kept } else { Lost };
        match self.format {
            Format::Obj => match (domain, name, values) {
                (Domain::Corner, "uv", Values::Vec2(_))
                | (Domain::Corner, "normal", Values::Vec3(_))
                | (Domain::Face, "material" | "smoothing", Values::Int(_)) => Kept,
                (Domain::Vertex, "normal", Values::Vec3(_)) => {
                    kept_if(!has(Domain::Corner, CORNER_NORMAL.name))
                }
                // The alpha of a vertex color is lost. A face tag is lost if no face has it, and the name of a face tag
                // can change.
                (Domain::Vertex, "color", Values::Vec4(_)) | (Domain::Face, _, Values::Tag(_)) => {
                    Partial
                }
                _ => Lost,
            },
            Format::Gltf | Format::Glb => gltf::storage(domain, name, values, has),
            Format::Ply => kept_if(domain != Domain::Edge),
            Format::Off => match (domain, name, values) {
                (Domain::Vertex, "normal", Values::Vec3(_))
                | (Domain::Vertex, "color", Values::Vec4(_)) => Kept,
                // Texture coordinates are lost if they differ between corners of the same vertex. A file stores either
                // face colors or face color indices, but not both.
                (Domain::Corner, "uv", Values::Vec2(_))
                | (Domain::Face, "color", Values::Vec4(_))
                | (Domain::Face, COLOR_INDEX, Values::Int(_)) => Partial,
                _ => Lost,
            },
            Format::Csv => kept_if(domain == self.rows.domain()),
            Format::Npz | Format::Mws => Kept,
            Format::Stl | Format::Dae | Format::Bez | Format::Bzc => Lost,
        }
    }
}

/// Returns an empty list of values for each type.
fn types() -> [Values; 6] {
    [
        Values::Float(Vec::new()),
        Values::Vec2(Vec::new()),
        Values::Vec3(Vec::new()),
        Values::Vec4(Vec::new()),
        Values::Int(Vec::new()),
        Values::Tag(Vec::new()),
    ]
}

/// Returns the type that attributes with this domain and name usually have, as an empty list of values. For example,
/// the vertex attribute `color` has four numbers. Returns `None` if this function does not know the name.
fn usual_type(domain: Domain, name: &str) -> Option<Values> {
    let [_, vec2, vec3, vec4, int, _] = types();
    match domain {
        Domain::Corner if name == UV.name => Some(vec2),
        Domain::Corner if name == CORNER_NORMAL.name => Some(vec3),
        Domain::Corner if name == mesh::CORNER_TANGENT.name => Some(vec4),
        Domain::Vertex if name == VERTEX_NORMAL.name || name == mesh::TANGENT.name => Some(vec3),
        Domain::Vertex | Domain::Face if name == COLOR.name => Some(vec4),
        Domain::Face if name == MATERIAL.name || name == SMOOTHING.name => Some(int),
        _ => None,
    }
}

impl Format {
    /// Returns the reason why files of this format cannot store an object with this [kind](scene::Geometry::kind) of
    /// geometry. Returns `None` if files of this format can store such an object.
    pub fn refused_kind(self, kind: &str) -> Option<String> {
        let (kinds, stores): (&[&str], _) = match self {
            Self::Mws => return None,
            Self::Obj => (
                &["mesh", "polylines"],
                "OBJ files store meshes and polylines",
            ),
            Self::Gltf | Self::Glb => (&["mesh"], "glTF files store meshes"),
            Self::Ply => (&["mesh"], "PLY files store meshes"),
            Self::Stl => (&["mesh"], "STL files store meshes"),
            Self::Off => (&["mesh"], "OFF files store meshes"),
            Self::Csv => (&["mesh"], "CSV files store meshes"),
            Self::Npz => (&["mesh"], "NPZ files store meshes"),
            Self::Dae => (&[], "COLLADA files cannot be written"),
            Self::Bez => (&["patches"], "a .bez file stores Bezier patches"),
            Self::Bzc => (&["curve"], "a .bzc file stores a curve"),
        };
        (!kinds.contains(&kind)).then(|| format!("{stores}, found {kind}"))
    }

    /// Returns the reason why files of this format cannot store `n` objects. Returns `None` if such files can store `n`
    /// objects.
    pub fn refused_count(self, n: usize) -> Option<String> {
        (self == Self::Bzc && n != 1).then(|| {
            format!(
                "a .bzc file stores one curve, found {}",
                counted(n, "object")
            )
        })
    }

    /// Whether files of this format store nodes, cameras, lights, skins and animations.
    pub const fn has_nodes(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb | Self::Mws)
    }

    /// Whether files of this format store materials.
    pub const fn has_materials(self) -> bool {
        matches!(self, Self::Obj | Self::Gltf | Self::Glb | Self::Mws)
    }

    /// Whether files of this format store only triangles.
    pub const fn has_only_triangles(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb | Self::Stl)
    }

    /// Whether files of this format store the names of several objects. The result is false for PLY files, although the
    /// PLY writer gives each face a tag with the name of its object.
    pub const fn keeps_names(self) -> bool {
        !matches!(
            self,
            Self::Ply | Self::Stl | Self::Off | Self::Npz | Self::Bez
        )
    }

    /// What happens to the names of objects when a writer of this format joins the meshes of all objects into one mesh.
    pub(crate) const fn joined_names(self) -> Names {
        match self {
            Self::Ply => Names::Tags,
            _ if self.keeps_names() => Names::Kept,
            _ => Names::Lost,
        }
    }
}
