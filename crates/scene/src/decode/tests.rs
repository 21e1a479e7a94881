use super::*;
use crate::{Filter, Wrap};
use geometry::shapes;
use glam::{DVec2, DVec4};
use mesh::{FaceId, HalfEdgeId, Rule, VertexId};
use proptest::prelude::*;
use std::collections::VecDeque;

/// The arrays that [`Scene::encode_with_separate_arrays`] separated, in order.
struct SeparateArrays(VecDeque<Vec<u8>>);

impl ArraySource for SeparateArrays {
    fn next_len(&self) -> Option<u64> {
        self.0.front().map(|array| array.len() as u64)
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<(), DecodeError> {
        let array = self.0.pop_front().ok_or(DecodeError::Array("no array"))?;
        bytes.copy_from_slice(&array);
        Ok(())
    }
}

fn encoded(scene: &Scene) -> Vec<u8> {
    let mut bytes = Vec::new();
    scene.encode(&mut |piece| bytes.extend_from_slice(piece));
    bytes
}

fn encoded_with_separate_arrays(scene: &Scene, min_long: usize) -> (Vec<u8>, SeparateArrays) {
    let mut arrays = VecDeque::new();
    let rest =
        scene.encode_with_separate_arrays(min_long, &mut |array| arrays.push_back(array.to_vec()));
    (rest, SeparateArrays(arrays))
}

fn insert(scene: &mut Scene, name: &str, geometry: Geometry, materials: Vec<Material>) {
    let object = Object {
        materials,
        ..Object::new(name, geometry)
    };
    scene.insert(object).unwrap();
}

/// Returns a scene with each kind of geometry, attribute and material property.
fn full_scene() -> Scene {
    let mut scene = Scene::new();
    let mut mesh = shapes::grid(3, 2);
    let n = |domain| mesh.domain_len(domain);
    let (vertices, corners, edges, faces) = (
        n(Domain::Vertex),
        n(Domain::Corner),
        n(Domain::Edge),
        n(Domain::Face),
    );
    mesh.set(mesh::UV, vec![DVec2::new(0.5, -0.0); corners]);
    mesh.set(mesh::VERTEX_NORMAL, vec![DVec3::Z; vertices]);
    mesh.set(mesh::COLOR, vec![DVec4::new(0.1, 0.2, 0.3, 1.0); vertices]);
    mesh.set(mesh::CREASE, vec![2.5; edges]);
    mesh.set(mesh::MATERIAL, vec![-1; faces]);
    let tag = Column {
        name: "two words".into(),
        rule: Rule::Drop,
        values: Values::Tag((0..faces).map(|i| i % 2 == 0).collect()),
    };
    mesh.insert_column(Domain::Face, tag);
    let mut glass = Material::new("glass");
    glass.base_color = [0.5, 0.25, 1.0, 0.5];
    glass.alpha = AlphaMode::Mask(0.25);
    glass.base_color_texture = Some(Texture::file("wood.png"));
    glass.emissive = [0.5, 0.0, 0.125];
    glass.emissive_strength = 3.0;
    glass.normal_scale = 0.5;
    glass.occlusion_strength = 0.25;
    glass.double_sided = true;
    glass.unlit = true;
    let mut texture = Texture::new(Image::Embedded {
        mime: "image/png".into(),
        bytes: vec![7; 100].into(),
    });
    texture.uv_set = 2;
    texture.sampler = Sampler {
        wrap: [Wrap::Mirror, Wrap::Clamp],
        magnify: Some(Filter::Nearest),
        minify: Some(Filter::Linear),
        mipmap: Some(Filter::Nearest),
    };
    texture.transform.rotation = 0.5;
    glass.normal_texture = Some(texture);
    glass.occlusion_texture = Some(Texture::new(Image::Loaded {
        path: "textures/soot.png".into(),
        bytes: vec![9; 50].into(),
    }));
    let mut opaque = Material::new("opaque");
    opaque.base_color[3] = 0.5;
    opaque.alpha = AlphaMode::Opaque;
    opaque.base_color_texture = Some(Texture::file(""));
    let materials = vec![Material::new("plain"), glass, opaque];
    insert(
        &mut scene,
        "grid",
        Geometry::Mesh(Arc::new(mesh)),
        materials,
    );
    insert(&mut scene, "empty", Geometry::Mesh(Arc::default()), vec![]);
    let cube = shapes::cube();
    insert(&mut scene, "cube", Geometry::Mesh(Arc::new(cube)), vec![]);
    let patch = Patch::new([[DVec3::X; 4]; 4]).unwrap();
    insert(&mut scene, "patch", Geometry::Patches(vec![patch]), vec![]);
    let curve = Curve::new(vec![DVec2::X, DVec2::Y]).unwrap();
    insert(&mut scene, "curve", Geometry::Curve(curve), vec![]);
    let lines = vec![vec![DVec3::X, DVec3::Y], vec![]];
    insert(&mut scene, "lines", Geometry::Polylines(lines), vec![]);
    scene
}

#[test]
fn decoding_restores_the_encoded_scene() {
    let scene = full_scene();
    let decoded = Scene::decode(&encoded(&scene), usize::MAX, &mut NoArrays).unwrap();
    assert_eq!(decoded, scene);
    assert_eq!(encoded(&decoded), encoded(&scene));
    for min_long in [0, 1, 48, 200, 1000] {
        let (rest, mut arrays) = encoded_with_separate_arrays(&scene, min_long);
        let decoded = Scene::decode(&rest, min_long, &mut arrays).unwrap();
        assert_eq!(decoded, scene, "separate arrays of {min_long} bytes");
        assert_eq!(decoded.digest(), scene.digest());
    }
}

#[test]
fn truncated_bytes_and_trailing_data_are_refused() {
    let bytes = encoded(&full_scene());
    for n in 0..bytes.len() {
        assert!(
            Scene::decode(&bytes[..n], usize::MAX, &mut NoArrays).is_err(),
            "{n}"
        );
    }
    let longer = [&bytes[..], b"x"].concat();
    assert_eq!(
        Scene::decode(&longer, usize::MAX, &mut NoArrays),
        Err(DecodeError::TrailingData)
    );
}

#[test]
fn a_length_that_exceeds_the_memory_is_refused() {
    let mut bytes = encoded(&Scene::new());
    let start = bytes.len() - 8;
    bytes[start..].copy_from_slice(&u64::MAX.to_le_bytes());
    assert_eq!(
        Scene::decode(&bytes, usize::MAX, &mut NoArrays),
        Err(DecodeError::Truncated)
    );
    // If the declared length of the first array of a mesh is too large, decoding also fails.
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", shapes::cube())).unwrap();
    let (mut rest, mut arrays) = encoded_with_separate_arrays(&scene, 1);
    let n = 24_u64.to_le_bytes();
    let start = rest.windows(8).position(|w| w == n).unwrap();
    rest[start..start + 8].copy_from_slice(&(1_u64 << 60).to_le_bytes());
    assert!(Scene::decode(&rest, 1, &mut arrays).is_err());
}

/// Changes the arrays of a grid, and tries to create a mesh from the changed arrays. If the mesh cannot be created,
/// returns the defect of the arrays.
fn defect_after(change: impl FnOnce(&mut Connectivity, &mut Vec<DVec3>)) -> Option<Defect> {
    let mesh = shapes::grid(2, 2);
    let (mut c, mut positions) = (mesh.connectivity().clone(), mesh.positions().to_vec());
    assert!(mesh.is_valid());
    change(&mut c, &mut positions);
    Mesh::try_from_arrays(c, positions).err()
}

#[test]
fn arrays_that_do_not_form_a_mesh_are_refused() {
    assert!(defect_after(|c, _| assert!(c.origin.pop().is_some())).is_some());
    assert!(defect_after(|c, _| c.next[3] = HalfEdgeId::new(999)).is_some());
    assert!(defect_after(|c, _| c.next[0] = c.next[2]).is_some());
    assert!(defect_after(|c, _| c.face[0] = FaceId::new(3)).is_some());
    assert!(defect_after(|c, _| c.origin[1] = c.origin[0]).is_some());
    assert!(defect_after(|c, _| c.face_half_edge[1] = c.face_half_edge[0]).is_some());
    assert!(defect_after(|c, _| c.face_half_edge[1] = HalfEdgeId::NONE).is_some());
    assert!(defect_after(|c, _| c.vertex_half_edge[4] = HalfEdgeId::NONE).is_some());
    assert!(
        defect_after(|c, _| c.vertex_half_edge[0] = c.next[c.vertex_half_edge[0].index()])
            .is_some()
    );
    assert!(defect_after(|_, p| p[3].x = f64::NAN).is_some());
    let origin = VertexId::new(8);
    assert!(defect_after(|c, _| c.origin[5] = origin).is_some());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// `is_valid` and `defects` agree for a mesh whose arrays have some changed entries.
    #[test]
    fn a_mesh_is_valid_exactly_if_it_has_no_defects(
        changes in prop::collection::vec((0..5_usize, 0..200_usize, 0..60_usize), 0..4),
        shape in 0..3,
    ) {
        let mesh = match shape {
            0 => shapes::grid(2, 2),
            1 => shapes::tetrahedron(),
            _ => shapes::square(),
        };
        let mut c = mesh.connectivity().clone();
        for (array, index, id) in changes {
            // Most of the random ids are ids of existing elements.
            match array {
                0 => { let n = c.next.len(); c.next[index % n] = HalfEdgeId::new(id % (n + 1)); }
                1 => { let n = c.origin.len(); c.origin[index % n] = VertexId::new(id % (mesh.n_vertices() + 1)); }
                2 => { let n = c.face.len(); c.face[index % n] = if id == 0 { FaceId::NONE } else { FaceId::new(id % mesh.n_faces()) }; }
                3 => { let n = c.vertex_half_edge.len(); c.vertex_half_edge[index % n] = HalfEdgeId::new(id % c.next.len()); }
                _ => { let n = c.face_half_edge.len(); c.face_half_edge[index % n] = HalfEdgeId::new(id % c.next.len()); }
            }
        }
        let mesh = Mesh::from_arrays(c, mesh.positions().to_vec());
        prop_assert_eq!(mesh.is_valid(), mesh.defects().is_empty());
    }

    /// Corrupted bytes never cause a panic, and a decoded scene is always valid.
    #[test]
    fn changed_bytes_give_an_error_or_a_valid_scene(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = encoded(&full_scene());
        for (index, byte) in changes {
            let index = index.index(bytes.len());
            bytes[index] = byte;
        }
        if let Ok(scene) = Scene::decode(&bytes, usize::MAX, &mut NoArrays) {
            for mesh in scene.objects().iter().filter_map(Object::as_mesh) {
                prop_assert_eq!(mesh.defects(), []);
            }
        }
    }
}
