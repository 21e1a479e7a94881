//! From a scene to a glTF document and its bytes.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DVec2, DVec4};
use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Asset, Buffer, Index, Node, Root};
use mesh::triangulate::Cutter;
use mesh::{Domain, Mesh};
use scene::{Geometry, Material, Object, Scene};
use serde_json::json;

use super::split::{Corners, Split, SplitVertex, split};
use crate::dense::dense;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::{WriteOptions, Written};

/// The files that hold `scene`, to be renamed in this order, and what they do not hold.
///
/// # Errors
///
/// If an object is no mesh, or the scene does not fit the lengths of the format.
pub(crate) fn write(
    path: &Path,
    binary: bool,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<Written, Unwritable> {
    let mut losses = Vec::new();
    let mut writer = Writer::new(options);
    for object in scene.objects() {
        let Geometry::Mesh(mesh) = &object.geometry else {
            return Err(Unwritable::object(
                &object.name,
                format!("glTF files hold meshes, found {}", object.geometry.kind()),
            ));
        };
        writer.object(
            object,
            &dense(mesh),
            &mut Losses::of(&object.name, &mut losses),
        )?;
    }
    let Writer {
        mut root, bytes, ..
    } = writer;
    if u32::try_from(bytes.len()).is_err() {
        let message = format!(
            "a glTF file holds less than 4 GB, the scene needs {} bytes",
            bytes.len()
        );
        return Err(Unwritable::Scene { message });
    }
    if binary {
        add_buffer(&mut root, bytes.len(), None);
        let glb = container(&to_json(&root)?, &bytes)?;
        return Ok(Written {
            files: vec![(path.to_path_buf(), glb)],
            losses,
        });
    }
    let binary_path = path.with_extension("bin");
    let uri = binary_path
        .file_name()
        .map(|name| percent_encoded(&name.to_string_lossy()));
    add_buffer(&mut root, bytes.len(), uri);
    let mut files = vec![(path.to_path_buf(), to_json(&root)?)];
    if !bytes.is_empty() {
        files.insert(0, (binary_path, bytes));
    }
    Ok(Written { files, losses })
}

fn add_buffer(root: &mut Root, length: usize, uri: Option<String>) {
    if length > 0 {
        let byte_length = length.into();
        root.buffers.push(Buffer {
            byte_length,
            name: None,
            uri,
            extensions: None,
            extras: None,
        });
    }
}

fn to_json(root: &Root) -> Result<Vec<u8>, Unwritable> {
    serde_json::to_vec(root).map_err(|e| Unwritable::Scene {
        message: e.to_string(),
    })
}

/// A GLB file: a header, a chunk of JSON and a chunk of bytes, each filled up to a multiple of 4.
fn container(json: &[u8], binary: &[u8]) -> Result<Vec<u8>, Unwritable> {
    let mut out = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    let mut chunk = |kind: &[u8], data: &[u8], fill: u8| {
        let padded = data.len().next_multiple_of(4);
        out.extend_from_slice(&u32::try_from(padded).unwrap_or(u32::MAX).to_le_bytes());
        out.extend_from_slice(kind);
        out.extend_from_slice(data);
        out.resize(out.len() + padded - data.len(), fill);
    };
    chunk(b"JSON", json, b' ');
    if !binary.is_empty() {
        chunk(b"BIN\0", binary, 0);
    }
    let length = u32::try_from(out.len()).map_err(|_| Unwritable::Scene {
        message: format!(
            "a GLB file holds less than 4 GB, the scene needs {} bytes",
            out.len()
        ),
    })?;
    out[8..12].copy_from_slice(&length.to_le_bytes());
    Ok(out)
}

/// A file name as a URI reference (RFC 3986): all but the unreserved characters are escaped.
fn percent_encoded(name: &str) -> String {
    let encode = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(encode).collect()
}

// ---- The document ------------------------------------------------------------------------------

struct Writer {
    root: Root,
    bytes: Vec<u8>,
    /// The scene's materials that `root.materials` stand for.
    materials: Vec<Material>,
}

impl Writer {
    fn new(options: &WriteOptions) -> Self {
        let extras = options
            .provenance
            .as_ref()
            .and_then(|text| serde_json::value::to_raw_value(&json!({ "meshwright": text })).ok());
        let generator = Some(concat!("meshwright ", env!("CARGO_PKG_VERSION")).to_owned());
        let root = Root {
            asset: Asset {
                generator,
                extras,
                ..Asset::default()
            },
            scene: Some(Index::new(0)),
            scenes: vec![gltf_json::Scene {
                extensions: None,
                extras: None,
                name: None,
                nodes: Vec::new(),
            }],
            ..Root::default()
        };
        Self {
            root,
            bytes: Vec::new(),
            materials: Vec::new(),
        }
    }

    fn object(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        losses: &mut Losses,
    ) -> Result<(), Unwritable> {
        let corners = Corners::new(mesh, losses);
        let split = split(mesh, &corners);
        if split.vertices.len() >= u32::MAX as usize {
            let message = format!(
                "expected fewer than {} vertices, found {}",
                u32::MAX,
                split.vertices.len()
            );
            return Err(Unwritable::object(&object.name, message));
        }
        let isolated = mesh.n_isolated_vertices();
        losses.add(
            Domain::Vertex,
            "position",
            isolated,
            "isolated vertices: glTF holds triangles",
        );
        let polygons = mesh.faces().filter(|&f| !mesh.is_triangle(f)).count();
        losses.add(
            Domain::Face,
            "polygon",
            polygons,
            "glTF holds triangles: the polygons are cut",
        );
        if isolated == 0 && mesh.n_faces() == 0 {
            losses.add(
                None,
                "mesh",
                1,
                "an empty mesh is written as a node without one",
            );
        }
        let primitives = self.primitives(object, mesh, &corners, &split, losses)?;
        let index = if primitives.is_empty() {
            None
        } else {
            let mesh = gltf_json::Mesh {
                extensions: None,
                extras: None,
                name: Some(object.name.clone()),
                primitives,
                weights: None,
            };
            Some(self.root.push(mesh))
        };
        let name = Some(object.name.clone());
        let node = self.root.push(Node {
            mesh: index,
            name,
            ..Node::default()
        });
        self.root.scenes[0].nodes.push(node);
        Ok(())
    }

    /// One primitive for each material, in the order of the object's materials; they share their
    /// vertices.
    fn primitives(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        corners: &Corners,
        split: &Split,
        losses: &mut Losses,
    ) -> Result<Vec<Primitive>, Unwritable> {
        let triangles = triangles_by_material(object, mesh, split, losses);
        if triangles.is_empty() {
            return Ok(Vec::new());
        }
        let attributes = self.attributes(object, mesh, corners, split)?;
        let mut primitives = Vec::new();
        for (material, indices) in triangles {
            let material = usize::try_from(material)
                .ok()
                .and_then(|m| object.materials.get(m));
            let material = material.map(|material| self.material(material, losses));
            let indices = self.indices(&indices, split.vertices.len());
            primitives.push(Primitive {
                attributes: attributes.clone(),
                extensions: None,
                extras: None,
                indices: Some(indices),
                material,
                mode: Checked::Valid(Mode::Triangles),
                targets: None,
            });
        }
        Ok(primitives)
    }

    fn attributes(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        corners: &Corners,
        split: &Split,
    ) -> Result<BTreeMap<Checked<Semantic>, Index<Accessor>>, Unwritable> {
        let mut positions = Vec::with_capacity(split.vertices.len());
        for vertex in &split.vertices {
            let position = mesh.position(vertex.v).as_vec3().to_array();
            if !position.iter().all(|x| x.is_finite()) {
                let message = format!(
                    "the position of {}, {}, is too large for the 32 bits of glTF",
                    vertex.v,
                    mesh.position(vertex.v)
                );
                return Err(Unwritable::object(&object.name, message));
            }
            positions.push(position);
        }
        let mut attributes = BTreeMap::new();
        let accessor = self.floats(&positions, Type::Vec3);
        let bounds = |pick: fn(f32, f32) -> f32| {
            let all = positions.iter().copied();
            all.reduce(|a, b| std::array::from_fn(|i| pick(a[i], b[i])))
        };
        let with_bounds = &mut self.root.accessors[accessor.value()];
        with_bounds.min = bounds(|a, b| if b < a { b } else { a }).map(|min| json!(min));
        with_bounds.max = bounds(|a, b| if b > a { b } else { a }).map(|max| json!(max));
        attributes.insert(Checked::Valid(Semantic::Positions), accessor);
        if corners.normals.is_some() {
            let values: Vec<_> = split.vertices.iter().map(SplitVertex::normal).collect();
            let accessor = self.floats(&values, Type::Vec3);
            attributes.insert(Checked::Valid(Semantic::Normals), accessor);
        }
        if corners.uvs.is_some() {
            let values: Vec<_> = split.vertices.iter().map(SplitVertex::uv).collect();
            let accessor = self.floats(&values, Type::Vec2);
            attributes.insert(Checked::Valid(Semantic::TexCoords(0)), accessor);
        }
        if corners.colors.is_some() {
            let values: Vec<_> = split.vertices.iter().map(SplitVertex::color).collect();
            let accessor = self.floats(&values, Type::Vec4);
            attributes.insert(Checked::Valid(Semantic::Colors(0)), accessor);
        }
        Ok(attributes)
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], kind: Type) -> Index<Accessor> {
        let start = self.bytes.len();
        self.bytes
            .extend(values.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        self.accessor(
            start,
            values.len(),
            ComponentType::F32,
            kind,
            Target::ArrayBuffer,
        )
    }

    fn indices(&mut self, indices: &[u32], n_vertices: usize) -> Index<Accessor> {
        let start = self.bytes.len();
        // The highest number of each size is kept free: it restarts primitives on graphics cards.
        let component = if u16::try_from(n_vertices).is_ok() {
            self.bytes.extend(
                indices
                    .iter()
                    .flat_map(|&i| u16::try_from(i).unwrap_or(u16::MAX).to_le_bytes()),
            );
            ComponentType::U16
        } else {
            self.bytes
                .extend(indices.iter().flat_map(|i| i.to_le_bytes()));
            ComponentType::U32
        };
        self.accessor(
            start,
            indices.len(),
            component,
            Type::Scalar,
            Target::ElementArrayBuffer,
        )
    }

    /// An accessor of the bytes from `start` to the end, in a view of its own.
    fn accessor(
        &mut self,
        start: usize,
        count: usize,
        component: ComponentType,
        kind: Type,
        target: Target,
    ) -> Index<Accessor> {
        let view = self.root.push(View {
            buffer: Index::new(0),
            byte_length: (self.bytes.len() - start).into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            name: None,
            target: Some(Checked::Valid(target)),
            extensions: None,
            extras: None,
        });
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: count.into(),
            component_type: Checked::Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Checked::Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    /// The material in the document; objects share it if all of it is the same.
    fn material(&mut self, material: &Material, losses: &mut Losses) -> Index<gltf_json::Material> {
        if let Some(place) = self.materials.iter().position(|known| known == material) {
            return Index::new(u32::try_from(place).unwrap_or(u32::MAX));
        }
        let picture = usize::from(material.base_color_texture.is_some());
        losses.add(
            None,
            &material.name,
            picture,
            "the picture of the material is not written",
        );
        let unit = |x: f64| {
            if x.is_finite() {
                x.clamp(0.0, 1.0)
            } else {
                1.0
            }
        };
        let base_color = DVec4::from_array(material.base_color.map(unit))
            .as_vec4()
            .to_array();
        let [metallic, roughness] = DVec2::new(unit(material.metallic), unit(material.roughness))
            .as_vec2()
            .to_array();
        let alpha_mode = if material.alpha == scene::AlphaMode::Blend {
            AlphaMode::Blend
        } else {
            AlphaMode::Opaque
        };
        self.materials.push(material.clone());
        self.root.push(gltf_json::Material {
            alpha_mode: Checked::Valid(alpha_mode),
            name: Some(material.name.clone()),
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor(base_color),
                metallic_factor: StrengthFactor(metallic),
                roughness_factor: StrengthFactor(roughness),
                ..PbrMetallicRoughness::default()
            },
            ..gltf_json::Material::default()
        })
    }
}

/// The corners of the triangles of each material, -1 for none, each in the order of the faces.
fn triangles_by_material(
    object: &Object,
    mesh: &Mesh,
    split: &Split,
    losses: &mut Losses,
) -> BTreeMap<i32, Vec<u32>> {
    let materials = mesh.get(mesh::MATERIAL);
    let exists = |m: i32| usize::try_from(m).is_ok_and(|m| m < object.materials.len());
    let mut by_material: BTreeMap<i32, Vec<u32>> = BTreeMap::new();
    let mut unknown = 0;
    let mut cutter = Cutter::default();
    for f in mesh.faces() {
        let material = materials.map_or(-1, |materials| materials[f.index()]);
        let material = if exists(material) {
            material
        } else {
            unknown += usize::from(material != -1);
            -1
        };
        let indices = by_material.entry(material).or_default();
        let corners: Vec<u32> = mesh
            .face_half_edges(f)
            .map(|h| split.vertex_of[h.index()])
            .collect();
        if let &[a, b, c] = corners.as_slice() {
            indices.extend([a, b, c]);
            continue;
        }
        for triangle in cutter.cut(mesh, f).triangles() {
            indices.extend(triangle.map(|k| corners[k as usize]));
        }
    }
    losses.add(
        Domain::Face,
        "material",
        unknown,
        "the object has no such material",
    );
    for (i, material) in object.materials.iter().enumerate() {
        let used = i32::try_from(i).is_ok_and(|i| by_material.contains_key(&i));
        losses.add(
            None,
            &material.name,
            usize::from(!used),
            "no face has this material",
        );
    }
    by_material
}
