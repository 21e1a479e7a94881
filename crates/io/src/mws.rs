//! Reads and writes `.mws` files, which store a complete Meshwright scene without any loss.
//!
//! ```text
//! MWS1            4 bytes
//! u64             length of the provenance in bytes, little-endian
//! ..              the provenance, UTF-8
//! ..              the canonical form of the scene; the digest of the scene is computed from it
//! ```
//!
//! Reading restores everything: the order of all elements, names, materials with their content, and every attribute.
//! The rule that computes the values of an attribute at new elements is also restored. Other programs do not read this
//! format.

use scene::{Graph, NoArrays, Scene};

use crate::fault::Fault;
use crate::{
    Parsed, ParsedObject, PeekGeometry, PeekObject, Placements, Shape, SingleFile, WriteOptions,
};

const MAGIC: &[u8; 4] = b"MWS1";
const HEADER: usize = MAGIC.len() + size_of::<u64>();

/// Reads the scene of a file. If the file contains a single object, `name` replaces the name of this object.
pub(crate) fn read(
    bytes: &[u8],
    name: Option<&str>,
    placements: Placements,
) -> Result<Parsed, Fault> {
    let scene = scene_of(bytes, name, placements)?;
    let objects = scene.objects().iter().map(|object| ParsedObject {
        name: object.name.clone(),
        shape: Shape::Object(object.clone().into()),
    });
    Ok(Parsed {
        objects: objects.collect(),
        graph: scene.graph().clone(),
    })
}

/// Returns the objects that would be read from a file, with their element counts. The whole file is decoded, because
/// reading refuses a file with an invalid part.
pub(crate) fn peek(
    bytes: &[u8],
    name: Option<&str>,
    placements: Placements,
    graph: &mut Graph,
) -> Result<Vec<PeekObject>, Fault> {
    let scene = scene_of(bytes, name, placements)?;
    let objects = scene.objects().iter().map(|object| {
        let geometry = PeekGeometry::of(&object.geometry);
        let attributes = object
            .as_mesh()
            .into_iter()
            .flat_map(|m| m.attributes().iter());
        let attributes = attributes.map(|(domain, column)| (domain, column.name.clone()));
        PeekObject::new(object.name.clone(), geometry)
            .with_materials(&object.materials)
            .with_attributes(attributes.collect())
    });
    graph.clone_from(scene.graph());
    Ok(objects.collect())
}

fn scene_of(bytes: &[u8], name: Option<&str>, placements: Placements) -> Result<Scene, Fault> {
    let (provenance, form) =
        split(bytes).ok_or_else(|| Fault::byte(0, "expected a Meshwright scene (MWS1)"))?;
    let fault = |why: String| Fault::byte(HEADER + provenance.len(), why);
    let mut scene =
        Scene::decode(form, usize::MAX, &mut NoArrays).map_err(|why| fault(why.to_string()))?;
    if let (Some(name), [object]) = (name, scene.objects()) {
        let old = object.name.clone();
        scene
            .rename(&old, name)
            .map_err(|why| fault(why.to_string()))?;
    }
    if placements == Placements::Bake {
        scene = scene.placed().into_owned();
    }
    Ok(scene)
}

/// Writes a scene. Nothing is lost.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> SingleFile {
    let provenance = options.provenance.as_deref().unwrap_or_default();
    let mut bytes = MAGIC.to_vec();
    bytes.extend_from_slice(&(provenance.len() as u64).to_le_bytes());
    bytes.extend_from_slice(provenance.as_bytes());
    scene.encode(&mut |piece| bytes.extend_from_slice(piece));
    (bytes, Vec::new())
}

/// Returns the provenance (a text about the origin) of an `.mws` file. Returns `None` if the file has no provenance or
/// is not an `.mws` file.
pub(crate) fn provenance(bytes: &[u8]) -> Option<String> {
    let (provenance, _) = split(bytes)?;
    let text = std::str::from_utf8(provenance).ok()?;
    (!text.is_empty()).then(|| text.to_owned())
}

/// Splits a file into the provenance and the encoded scene. Returns `None` if the file is not an `.mws` file.
fn split(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (length, rest) = rest.split_first_chunk()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    rest.split_at_checked(length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, peek as peek_file, read as read_file, write as write_file};
    use geometry::shapes;
    use mesh::{Column, DVec3, Domain, Rule, Values};
    use scene::{Geometry, Material, Object};
    use store::Memory;

    fn scene() -> Scene {
        let mut mesh = shapes::torus(5, 4, 2.0, 0.5);
        mesh.positions_mut()[3] = DVec3::new(-0.0, f64::MIN_POSITIVE, 1.0 / 3.0);
        let weights = (0..mesh.n_faces()).map(|i| i as f64 / 7.0).collect();
        let column = Column {
            name: "weight".to_owned(),
            rule: Rule::Copy,
            values: Values::Float(weights),
        };
        mesh.insert_column(Domain::Face, column);
        let mut scene = Scene::new();
        let object = Object {
            materials: vec![Material::new("brass")],
            ..Object::mesh("ring", mesh)
        };
        scene.insert(object).unwrap();
        let lines = Geometry::Polylines(vec![vec![DVec3::X, DVec3::Y]]);
        scene.insert(Object::new("line", lines)).unwrap();
        scene
    }

    #[test]
    fn reading_restores_a_written_scene_bit_for_bit() {
        let (store, path) = (Memory::default(), "a.mws".as_ref());
        let report = write_file(&store, path, &scene(), &WriteOptions::default()).unwrap();
        assert_eq!(report.losses, []);
        let mut back = Scene::new();
        for object in read_file(&store, path, &ReadOptions::default())
            .unwrap()
            .objects
        {
            back.insert(object).unwrap();
        }
        assert_eq!(back.digest(), scene().digest());
        let peek = peek_file(&store, path, &ReadOptions::default()).unwrap();
        let [ring, line] = &peek.objects[..] else {
            panic!("two objects")
        };
        assert_eq!(ring.name, "ring");
        assert!(
            matches!(ring.geometry, PeekGeometry::Mesh(m) if (m.vertices, m.faces) == (20, 20))
        );
        let one = PeekGeometry::Polylines {
            lines: 1,
            points: 2,
        };
        assert_eq!(line.geometry, one);
    }

    #[test]
    fn shortened_files_fail_and_changed_files_fail_or_give_valid_meshes() {
        let (whole, _) = write(&scene(), &WriteOptions::default());
        for n in 0..whole.len() {
            assert!(
                scene_of(&whole[..n], None, Placements::Keep).is_err(),
                "{n} bytes"
            );
        }
        for i in 0..whole.len() {
            let mut changed = whole.clone();
            changed[i] ^= 1 << (i % 8);
            // A file with a changed bit can be refused. If it is not refused, the decoded meshes must be valid.
            if let Ok(scene) = scene_of(&changed, None, Placements::Keep) {
                for mesh in scene.objects().iter().filter_map(|o| o.as_mesh()) {
                    assert_eq!(mesh.defects(), [], "byte {i}");
                }
            }
        }
    }
}
