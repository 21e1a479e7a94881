//! Tests of the materials of glTF files: reading, writing and round trips.

use geometry::shapes;
use glam::DVec2;
use mesh::{Mesh, UV};
use scene::{AlphaMode, Filter, Image, Material, Object, Sampler, Texture, TextureTransform, Wrap};
use serde_json::{Value, json};

use crate::gltf_attributes::add_column;
use crate::gltf_read::{read_json, square};
use crate::{Folder, only, read, write};

/// A PNG image of one pixel.
pub(crate) const PNG: [u8; 70] = [
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0x1f, 0x15, 0xc4,
    0x89, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xfc, 0xcf, 0xc0, 0x50,
    0x0f, 0x00, 0x04, 0x85, 0x01, 0x80, 0x84, 0xa9, 0x8c, 0x21, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45,
    0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
];

fn picture() -> Image {
    Image::Embedded {
        mime: "image/png".into(),
        bytes: PNG.as_slice().into(),
    }
}

/// Returns a triangle mesh with two sets of texture coordinates, and with this material on all faces.
pub(crate) fn painted(name: &str, material: Material) -> Object {
    let mut mesh: Mesh = shapes::octahedron();
    let uvs = |k: usize| DVec2::new((k % 3) as f64 * 0.25, (k % 5) as f64 * 0.125);
    let values: Vec<DVec2> = (0..mesh.n_half_edges()).map(uvs).collect();
    mesh.set(UV, values.clone());
    add_column(&mut mesh, mesh::Domain::Corner, "uv1", values);
    mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
    Object {
        materials: vec![material],
        ..Object::mesh(name, mesh)
    }
}

/// Returns a material in which nearly all properties differ from their defaults.
pub(crate) fn rich() -> Material {
    let texture = |u: f64| Texture {
        uv_set: 1,
        sampler: Sampler {
            wrap: [Wrap::Clamp, Wrap::Mirror],
            magnify: Some(Filter::Nearest),
            minify: Some(Filter::Linear),
            mipmap: Some(Filter::Nearest),
        },
        transform: TextureTransform {
            offset: [u, 0.25],
            rotation: 0.7,
            scale: [2.0, -1.0],
        },
        ..Texture::new(picture())
    };
    Material {
        base_color: [0.1, 0.2, 0.3, 0.4],
        base_color_texture: Some(texture(0.1)),
        metallic: 0.6,
        roughness: 0.7,
        metallic_roughness_texture: Some(texture(0.2)),
        normal_texture: Some(texture(0.3)),
        normal_scale: 0.8,
        occlusion_texture: Some(texture(0.4)),
        occlusion_strength: 0.9,
        emissive: [0.3, 0.2, 0.1],
        emissive_strength: 4.5,
        emissive_texture: Some(Texture::new(picture())),
        alpha: AlphaMode::Mask(0.3),
        double_sided: true,
        ..Material::new("everything")
    }
}

fn json_of(path: &std::path::Path) -> Value {
    let bytes = std::fs::read(path).unwrap();
    let start = if bytes.starts_with(b"glTF") { 20 } else { 0 };
    let mut values = serde_json::Deserializer::from_slice(&bytes[start..]).into_iter();
    values.next().unwrap().unwrap()
}

#[test]
fn a_material_with_all_properties_survives_a_round_trip() {
    for name in ["a.glb", "a.gltf"] {
        let folder = Folder::new();
        let path = folder.path(name);
        let object = painted("thing", rich());
        assert_eq!(write(&path, [object.clone()]).losses, []);
        assert_eq!(only(&path).materials, object.materials);
    }
}

#[test]
fn each_material_property_survives_a_round_trip_separately() {
    let parts: [fn(&mut Material); 14] = [
        |m| m.base_color = [0.5, 0.5, 0.5, 0.5],
        |m| m.base_color_texture = Some(Texture::file("pictures/rote Bälle.png")),
        |m| m.metallic_roughness_texture = Some(Texture::file("../up.jpg")),
        |m| m.normal_texture = Some(Texture::file("https://example.com/a%20b.png?x=1")),
        |m| m.occlusion_texture = Some(Texture::file("a#b?c%d.png")),
        |m| m.emissive_texture = Some(Texture::new(picture())),
        |m| m.emissive = [1.0, 0.0, 0.5],
        |m| m.emissive_strength = 10.0,
        |m| m.alpha = AlphaMode::Blend,
        |m| m.alpha = AlphaMode::Mask(0.5),
        |m| m.double_sided = true,
        |m| m.unlit = true,
        |m| m.metallic = 1.0,
        |m| m.roughness = 0.0,
    ];
    for part in parts {
        let mut material = Material::new("a");
        part(&mut material);
        let folder = Folder::new();
        let path = folder.path("a.glb");
        assert_eq!(write(&path, [painted("a", material.clone())]).losses, []);
        assert_eq!(only(&path).materials, [material]);
    }
}

#[test]
fn unlit_materials_lose_their_emissive_strength() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let material = Material {
        unlit: true,
        emissive_strength: 4.5,
        ..Material::new("a")
    };
    let report = write(&path, [painted("a", material.clone())]);
    assert_eq!((report.losses.len(), report.losses[0].count), (1, 1));
    let expected = Material {
        emissive_strength: 1.0,
        ..material
    };
    assert_eq!(only(&path).materials, [expected]);
}

#[test]
fn every_sampler_survives_a_round_trip() {
    let filters = [None, Some(Filter::Nearest), Some(Filter::Linear)];
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        for magnify in filters {
            for minify in filters {
                for mipmap in filters
                    .into_iter()
                    .filter(|m| m.is_none() || minify.is_some())
                {
                    let sampler = Sampler {
                        wrap: [wrap, Wrap::Repeat],
                        magnify,
                        minify,
                        mipmap,
                    };
                    let mut material = Material::new("a");
                    material.base_color_texture = Some(Texture {
                        sampler,
                        ..Texture::file("a.png")
                    });
                    let folder = Folder::new();
                    let path = folder.path("a.glb");
                    write(&path, [painted("a", material.clone())]);
                    assert_eq!(only(&path).materials, [material]);
                }
            }
        }
    }
}

#[test]
fn images_and_materials_are_written_once() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let other = Material {
        name: "other".into(),
        ..rich()
    };
    let objects = [
        painted("a", rich()),
        painted("b", rich()),
        painted("c", other),
    ];
    write(&path, objects.clone());
    let json = json_of(&path);
    let count = |key: &str| json[key].as_array().unwrap().len();
    assert_eq!(
        (count("images"), count("samplers"), count("textures")),
        (1, 1, 2)
    );
    assert_eq!(count("materials"), 2);
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(bytes.windows(8).filter(|w| *w == &PNG[..8]).count(), 1);
    let loaded = read(&path).unwrap();
    for (object, back) in objects.iter().zip(&loaded.objects) {
        assert_eq!(object.materials, back.materials);
    }
    // After reading, all textures with this image share the same bytes in memory.
    let image = |i: usize| {
        &loaded.objects[i].materials[0]
            .normal_texture
            .as_ref()
            .unwrap()
            .image
    };
    match (image(0), image(2)) {
        (Image::Embedded { bytes: a, .. }, Image::Embedded { bytes: b, .. }) => {
            assert!(std::sync::Arc::ptr_eq(a, b));
            assert_eq!(**a, PNG);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn textures_without_texture_coordinates_are_losses() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mut mesh = shapes::octahedron();
    mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
    let object = Object {
        materials: vec![rich()],
        ..Object::mesh("a", mesh)
    };
    let report = write(&path, [object]);
    assert_eq!(report.losses.len(), 1);
    assert_eq!(report.losses[0].count, 5);
    assert_eq!(only(&path).materials[0].normal_texture, None);
}

#[test]
fn images_of_unsupported_types_are_losses() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mut material = Material::new("a");
    material.base_color_texture = Some(Texture::new(Image::Embedded {
        mime: "image/tiff".into(),
        bytes: b"II*".as_slice().into(),
    }));
    let losses = write(&path, [painted("a", material)]).losses;
    assert!(losses[0].reason.contains("PNG and JPEG"), "{losses:?}");
    assert_eq!(only(&path).materials, [Material::new("a")]);
}

#[test]
fn values_outside_of_the_range_are_clamped_with_a_loss() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let material = Material {
        base_color: [2.0, f64::NAN, 0.0, 1.0],
        emissive: [-1.0, 0.0, 0.0],
        alpha: AlphaMode::Mask(-1.0),
        ..Material::new("a")
    };
    let losses = write(&path, [painted("a", material)]).losses;
    assert_eq!(losses[0].count, 4, "{losses:?}");
    assert_eq!(only(&path).materials[0].base_color, [1.0, 1.0, 0.0, 1.0]);
}

/// The square with a material.
fn with_material(material: &Value) -> Value {
    let mut json = square(&[0, 1, 2, 0, 2, 3], 4);
    json["materials"] = json!([material]);
    json["meshes"][0]["primitives"][0]["material"] = json!(0);
    json
}

#[test]
fn images_in_views_and_data_uris_are_read_with_their_media_type() {
    let mut json = with_material(&json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
        "normalTexture": { "index": 1 },
        "occlusionTexture": { "index": 2, "strength": 0.25 },
        "emissiveTexture": { "index": 3, "texCoord": 1,
            "extensions": { "KHR_texture_transform": { "offset": [0.1, 0], "texCoord": 2 } } },
    }));
    json["textures"] = json!([{ "source": 0 }, { "source": 1 }, { "source": 2 }, { "source": 3 }]);
    json["images"] = json!([
        { "bufferView": 0 },
        { "bufferView": 0, "mimeType": "image/jpeg" },
        { "uri": "data:image/png;base64,iVBORw==" },
        { "uri": "pictures/a%20b.png" },
    ]);
    let material = read_json(&json).unwrap().objects[0].materials[0].clone();
    let kinds = [
        &material.base_color_texture,
        &material.normal_texture,
        &material.occlusion_texture,
        &material.emissive_texture,
    ]
    .map(|texture| match &texture.as_ref().unwrap().image {
        Image::Embedded { mime, bytes } => (mime.clone(), bytes.len()),
        Image::File(path) | Image::Loaded { path, .. } => (path.clone(), 0),
    });
    let expected = [
        ("application/octet-stream", 60),
        ("image/jpeg", 60),
        ("image/png", 4),
        ("pictures/a b.png", 0),
    ];
    assert_eq!(kinds, expected.map(|(kind, n)| (kind.to_owned(), n)));
    assert_eq!(material.occlusion_strength, 0.25);
    let emissive = material.emissive_texture.unwrap();
    assert_eq!(
        (emissive.uv_set, emissive.transform.offset),
        (2, [0.1, 0.0])
    );
}

#[test]
fn errors_in_materials_name_the_pointer() {
    let texture = json!({ "normalTexture": { "index": 0 } });
    for (change, to, pointer) in [
        (
            "/materials/0",
            json!({ "alphaMode": "GLASS" }),
            "/materials/0",
        ),
        (
            "/materials/0/normalTexture/index",
            json!(3),
            "/materials/0/normalTexture/index",
        ),
        ("/textures/0", json!({ "source": 7 }), "/textures/0/source"),
        (
            "/textures/0",
            json!({ "source": 0, "sampler": 1 }),
            "/textures/0/sampler",
        ),
        (
            "/textures/0",
            json!({ "source": 0, "sampler": 0 }),
            "/samplers/0/wrapS",
        ),
        (
            "/images/0",
            json!({ "bufferView": 9 }),
            "/images/0/bufferView",
        ),
        (
            "/images/0",
            json!({ "uri": "data:image/png;base64,A" }),
            "/images/0/uri",
        ),
        (
            "/materials/0/normalTexture",
            json!({ "index": 0, "extensions": { "KHR_texture_transform": { "offset": 1 } } }),
            "/materials/0/normalTexture/extensions/KHR_texture_transform",
        ),
    ] {
        let mut json = with_material(&texture);
        json["textures"] = json!([{ "source": 0 }]);
        json["samplers"] = json!([{ "wrapS": 5 }]);
        json["images"] = json!([{ "uri": "a.png" }]);
        *json.pointer_mut(change).unwrap() = to;
        match read_json(&json) {
            Err(mesh_io::ReadError::Json { pointer: found, .. }) => assert_eq!(found, pointer),
            other => panic!("{change}: {other:?}"),
        }
    }
}
