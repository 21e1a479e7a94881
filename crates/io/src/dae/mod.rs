//! Reads COLLADA 1.4 and 1.5 (`.dae`). The program does not write COLLADA files.
//!
//! ```text
//! visual_scene --- node --- node --- instance_geometry --- geometry --- mesh --- polylist --- source
//!                  transforms         bind_material                                material symbol
//!                                         `- material --- effect --- image
//! ```
//!
//! | in the file | in the scene |
//! | --- | --- |
//! | `node` with `instance_geometry` | an object with the name of the node, transformed by the node and its ancestors |
//! | `instance_controller` | an object with the controlled geometry in its rest pose |
//! | `instance_node` | another instance of the referenced node |
//! | `matrix`, `translate`, `rotate`, `scale`, `lookat` | a part of the transform; reflections reverse the faces |
//! | `triangles`, `polylist`, `polygons`, `tristrips`, `trifans` | faces; holes (`ph`) are left out |
//! | input `POSITION` | vertices, in the order of the file and not merged |
//! | input `NORMAL` | vertex attribute `normal` if the corners of each vertex agree, otherwise corner attribute |
//! | input `COLOR` | vertex attribute `color` if the corners of each vertex agree, otherwise corner attribute; alpha defaults to 1 |
//! | input `TEXCOORD` | corner attributes `uv`, `uv1`, `uv2` and so on, in the order of the set numbers; at most 8 sets |
//! | material of a list of polygons | face attribute `material`, and a material of the object |
//! | effect: `diffuse` (`emission` of `constant`) | the base color, or its texture with the path of the image file |
//! | effect: `transparent`, `transparency` | the alpha of the base color |
//! | `unit`, `up_axis` | ignored with a note: coordinates are neither scaled nor rotated |
//! | lines, splines, skins, morphs, animations, cameras, lights, physics, `skew` | left out, with a note |
//!
//! Corners without a normal or a texture coordinate get zero, and corners without a color get white. If a file has no
//! scene, each of its geometries becomes an object. If a file refers to other files, only the images among them are
//! read.
//!
//! Document type declarations are refused, because they can define entities that expand to a huge text. A file can
//! instantiate the same content several times. The total memory for this content is limited to 64 times the size of the
//! file. The limit is never less than 16 MiB.

mod cost;
mod document;
mod geometry;
mod materials;
mod nodes;
mod outline;
mod sources;

use std::collections::BTreeMap;

use mesh::{CORNER_NORMAL, Domain, MATERIAL, UV};
use scene::{Material, Texture};

use crate::fault::Fault;
use crate::note::{Names, Notes};
use crate::peek::{PeekGeometry, PeekMesh, PeekObject};
use crate::{ParsedObject, Polygons, Shape};

use document::{Document, elements, error_at, line, number_of, text};
use geometry::{Geometries, Surface};
use nodes::{PlacedGeometry, placed};

/// Reads the objects of a file from its bytes.
///
/// # Errors
///
/// Returns the first error in the file.
pub(crate) fn read(
    bytes: &[u8],
    name: &str,
    notes: &mut Notes,
) -> Result<Vec<ParsedObject>, Fault> {
    each_object(bytes, name, notes, |name, object| {
        let shape = Shape::Polygons(object.polygons()?);
        Ok(ParsedObject { name, shape })
    })
}

/// Returns the objects that would be read from a file, with their element counts.
///
/// # Errors
///
/// Returns an error in the same cases as [`read`], except that materials are not checked.
pub(crate) fn peek(bytes: &[u8], name: &str, notes: &mut Notes) -> Result<Vec<PeekObject>, Fault> {
    each_object(bytes, name, notes, |name, object| {
        let geometry = PeekGeometry::Mesh(object.counts());
        Ok(PeekObject::new(name, geometry))
    })
}

/// Reads the file and calls `make` for each object.
fn each_object<T>(
    bytes: &[u8],
    name: &str,
    notes: &mut Notes,
    mut make: impl FnMut(String, Object) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let text = document::decoded(bytes)?;
    let xml = document::parsed(&text)?;
    let document = Document::new(&xml)?;
    note_asset(&document, notes)?;
    note_libraries(&document);
    let placed = placed(&document, notes)?;
    let mut geometries = Geometries::new(&document);
    let mut surfaces: BTreeMap<u32, Option<Surface>> = BTreeMap::new();
    let mut materials = BTreeMap::new();
    let mut names = Names::default();
    let mut objects = Vec::new();
    for placed in &placed {
        let id = number_of(placed.geometry);
        let known = surfaces.contains_key(&id);
        if !known {
            let surface = geometries.surface(placed.geometry)?;
            surfaces.insert(id, surface);
        }
        let Some(Some(surface)) = surfaces.get(&id) else {
            let what = ("meshes-empty", "geometries without polygons left out");
            document.left_out(1, placed.geometry, what);
            continue;
        };
        if known && let Some(instance) = placed.instance {
            document.take(instance, surface.cost())?;
        }
        let object = Object {
            document: &document,
            placed,
            surface,
            materials: &mut materials,
        };
        let name = names.unique(placed.name(name), notes);
        objects.push(make(name, object)?);
    }
    document.note_all(notes);
    Ok(objects)
}

/// An object of the file, and the data that its polygons are built from.
struct Object<'a, 'd> {
    document: &'d Document<'a>,
    placed: &'d PlacedGeometry<'a>,
    surface: &'d Surface<'a>,
    /// The materials that were read before. The key is the index of a `<material>` or `<effect>` element.
    materials: &'d mut BTreeMap<u32, Material>,
}

impl Object<'_, '_> {
    fn counts(&self) -> PeekMesh {
        let polygons = &self.surface.polygons;
        let has = |name| polygons.attributes.column(Domain::Corner, name).is_some();
        let mut counts = PeekMesh {
            vertices: polygons.positions.len() as u64,
            uvs: has(UV.name),
            normals: has(CORNER_NORMAL.name),
            colors: has(mesh::COLOR.name),
            materials: !self.surface.symbols.is_empty(),
            ..PeekMesh::default()
        };
        for ends in polygons.offsets.windows(2) {
            counts.add_faces(1, u64::from(ends[1] - ends[0]));
        }
        counts
    }

    /// Returns the polygons in scene coordinates, with their materials.
    fn polygons(self) -> Result<Polygons, Fault> {
        let mut polygons = self.surface.polygons.clone();
        let lost = polygons.apply_transform(&self.placed.to_scene);
        let what = (
            "normals",
            "normals left out: the transform of the node is singular",
        );
        self.document.left_out(lost, self.placed.geometry, what);
        if self.surface.symbols.is_empty() {
            return Ok(polygons);
        }
        let mut places: BTreeMap<u32, i32> = BTreeMap::new();
        let mut place_of_symbol = Vec::new();
        for symbol in &self.surface.symbols {
            let next = i32::try_from(polygons.materials.len()).unwrap_or(i32::MAX);
            // Some programs do not bind material symbols to materials, but use the id of a material as its symbol.
            let same_id = self.document.ids.get(symbol);
            let same_id = same_id.filter(|node| document::is(**node, "material"));
            let node = self.placed.materials.get(symbol).or(same_id);
            let Some(&node) = node else {
                let what = (
                    "material-missing",
                    "materials that the file does not define: replaced by white materials",
                );
                self.document.changed(1, self.placed.geometry, what);
                place_of_symbol.push(next);
                polygons.materials.push(Material::new(*symbol));
                continue;
            };
            place_of_symbol.push(*places.entry(number_of(node)).or_insert(next));
            if places[&number_of(node)] == next {
                let material = materials::material(self.document, node, self.materials)?;
                polygons.materials.push(material);
            }
        }
        for material in &polygons.materials {
            let path = material.base_color_texture.as_ref().and_then(Texture::path);
            let text = material.name.len() + path.map_or(0, str::len);
            self.document.take(self.placed.geometry, text)?;
        }
        let place = |&symbol: &i32| {
            let symbol = usize::try_from(symbol).ok();
            symbol.map_or(-1, |symbol| place_of_symbol[symbol])
        };
        let values = self.surface.symbol_of.iter().map(place).collect();
        polygons.insert_known(MATERIAL, values);
        Ok(polygons)
    }
}

// ---- Notes -------------------------------------------------------------------------------------

/// Adds a note if the unit or the up axis is not the default.
fn note_asset(document: &Document, notes: &mut Notes) -> Result<(), Fault> {
    let asset = document::child(document.root, "asset");
    let unit = asset.and_then(|asset| document::child(asset, "unit"));
    let axis = asset.and_then(|asset| document::child(asset, "up_axis"));
    let mut meter = 1.0;
    if let Some(unit) = unit
        && let Some(given) = unit.attribute("meter")
    {
        let parsed = given.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        meter = parsed.ok_or_else(|| {
            error_at(unit, "expected the attribute `meter` to be a finite number")
        })?;
    }
    let up = axis.map_or("Y_UP", text);
    if meter != 1.0 || up != "Y_UP" {
        let up = up.chars().take(20).collect::<String>();
        let what =
            format!("coordinate system kept as in the file: up_axis {up}, one unit is {meter} m");
        notes.changed("coordinate-system", 1, unit.or(axis).map(line), what);
    }
    Ok(())
}

/// Counts the library elements that the reader leaves out, such as cameras.
fn note_libraries(document: &Document) {
    for library in elements(document.root) {
        let what = match library.tag_name().name() {
            "library_animations" | "library_animation_clips" => {
                ("animations", "animations left out")
            }
            "library_cameras" => ("cameras", "cameras left out"),
            "library_lights" => ("lights", "lights left out"),
            "library_controllers" => (
                "skins",
                "skins and morphs left out: geometries have their rest pose",
            ),
            name if name.starts_with("library_physics") || name == "library_force_fields" => {
                ("physics", "physics elements left out")
            }
            "library_joints" | "library_articulated_systems" => ("joints", "joints left out"),
            name if name.starts_with("library_kinematics") => {
                ("kinematics", "kinematics elements left out")
            }
            _ => continue,
        };
        let parts = elements(library).filter(|part| !document::is(*part, "asset"));
        document.left_out(parts.count(), library, what);
    }
}
