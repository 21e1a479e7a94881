//! Tests of reading and writing whole files. Some tests check general properties of the results. Other tests compare
//! the results with those of other readers.

mod broken;
mod compressed;
mod dae_broken;
mod dae_nodes;
mod dae_read;
mod gltf_attributes;
mod gltf_broken;
mod gltf_draco;
mod gltf_left_out;
mod gltf_limits;
mod gltf_materials;
mod gltf_meshopt;
mod gltf_morph_normals;
mod gltf_morph_tangents;
mod gltf_morph_values;
mod gltf_nodes;
mod gltf_packed;
mod gltf_read;
mod gltf_rig;
mod gltf_rig_broken;
mod gltf_rig_losses;
mod gltf_valid;
mod gltf_written;
mod images;
mod obj_dialects;
mod obj_files;
mod obj_limits;
mod obj_oracle;
mod off_files;
mod oracles;
mod peeks;
mod ply_broken;
mod ply_dialects;
mod ply_files;
mod ply_layouts;
mod round_trips;
mod stl_files;
mod tables;

use std::fmt::Debug;
use std::path::{Path, PathBuf};

use mesh::{Column, Domain, Mesh, Rule, Values, VertexId};
use mesh_io::{Loaded, Polygons, ReadError, ReadOptions, WriteOptions, WriteReport};
use scene::{Object, Scene};

/// A folder that is removed after the test.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn with(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, content).unwrap();
        path
    }

    /// The number of files and folders in this folder.
    fn count(&self) -> usize {
        std::fs::read_dir(self.0.path()).unwrap().count()
    }
}

fn read(path: &Path) -> Result<Loaded, ReadError> {
    mesh_io::read(&store::Disk, path, &ReadOptions::default())
}

fn write(path: &Path, objects: impl IntoIterator<Item = Object>) -> WriteReport {
    mesh_io::write(
        &store::Disk,
        path,
        &scene(objects),
        &WriteOptions::default(),
    )
    .unwrap()
}

fn scene(objects: impl IntoIterator<Item = Object>) -> Scene {
    let mut scene = Scene::new();
    for object in objects {
        scene.insert(object).unwrap();
    }
    scene
}

/// Reads a file with this content. Returns the polygons and the notes.
fn found(name: &str, content: impl AsRef<[u8]>) -> (Polygons, Vec<String>) {
    let folder = Folder::new();
    let path = folder.with(name, content);
    let mut all = mesh_io::read_polygons(&store::Disk, &path, &ReadOptions::default()).unwrap();
    let notes = read(&path).unwrap().notes;
    let notes = notes
        .iter()
        .map(|note| format!("{} {}", note.count, note.what))
        .collect();
    (all.remove(0).1, notes)
}

/// Returns the only object of a file. Reading the file must not give notes, except about missing images.
fn only(path: &Path) -> Object {
    let Loaded {
        mut objects, notes, ..
    } = read(path).unwrap();
    // The image files of some materials do not exist, which gives notes.
    let is_other = |note: &&mesh_io::Note| !note.what.starts_with("image ");
    assert_eq!(notes.iter().find(is_other), None);
    assert_eq!(objects.len(), 1);
    objects.remove(0)
}

/// Returns the faces of a mesh as lists of vertex ids.
fn polygons(mesh: &Mesh) -> Vec<Vec<usize>> {
    let polygon = |f| mesh.face_vertices(f).map(VertexId::index).collect();
    mesh.faces().map(polygon).collect()
}

/// Checks that two meshes have the same polygons, positions and attributes. Corner values are compared in the order of
/// the faces, so the ids of half-edges do not matter.
fn assert_same(a: &Mesh, b: &Mesh) {
    assert_eq!(a.positions(), b.positions());
    assert_eq!(polygons(a), polygons(b));
    for domain in [Domain::Vertex, Domain::Face] {
        assert_eq!(a.attributes().of(domain), b.attributes().of(domain));
    }
    assert_eq!(by_face(a), by_face(b));
}

fn by_face(mesh: &Mesh) -> Vec<(String, Vec<String>)> {
    fn pick<T: Debug>(mesh: &Mesh, values: &[T]) -> Vec<String> {
        let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
        corners
            .map(|h| format!("{:?}", values[h.index()]))
            .collect()
    }
    let column = |column: &Column| {
        let values = match &column.values {
            Values::Vec2(values) => pick(mesh, values),
            Values::Vec3(values) => pick(mesh, values),
            Values::Vec4(values) => pick(mesh, values),
            Values::Float(values) => pick(mesh, values),
            Values::Int(values) => pick(mesh, values),
            Values::Tag(values) => pick(mesh, values),
        };
        (column.name.clone(), values)
    };
    mesh.attributes()
        .of(Domain::Corner)
        .iter()
        .map(column)
        .collect()
}

fn tag(mesh: &mut Mesh, domain: Domain, name: &str, marks: Vec<bool>) {
    let column = Column {
        name: name.to_owned(),
        rule: Rule::Copy,
        values: Values::Tag(marks),
    };
    mesh.insert_column(domain, column);
}
