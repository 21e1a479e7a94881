//! Load: reads the objects of a file into the scene.

use std::ops::RangeInclusive;
use std::path::Path;

use mesh::{Domain, Elements, VertexId};
use mesh_io::{
    CleanupPolicy, NonManifold, Note, NoteKind, Orientation, Peek, PeekGeometry, PeekMesh,
    PeekObject, Placements, Policies, ReadError, ReadOptions,
};
use op::prelude::*;
use op::{Loss, Operation, ReadingChange, ReadingElements};

/// Reads the objects of a file into the scene.
///
/// Formats: `.obj`, `.gltf`, `.glb`, `.ply`, `.stl`, `.off`, `.dae`, `.bez` (Bezier patches), `.bzc` (a Bezier curve)
/// and `.mws` (a complete scene). Files in all of these formats except `.glb` and `.mws` can be compressed with gzip.
/// The name of a compressed file ends with `.gz`, as in `a.obj.gz`. An OBJ file becomes one object of the scene.
/// Objects and groups inside an OBJ file become tags (named sets) of faces. For example, a line `o hat` gives the tag
/// `o:hat`, and a line `g hat` gives the tag `hat`. With `placements: Keep` (the default), each mesh of a glTF file
/// becomes an object if at least one node references the mesh. If exactly one node references the mesh, the object gets
/// the name of the node. If several nodes reference the mesh, the object gets the name of the mesh. With `placements:
/// Keep`, the scene also keeps the nodes, cameras, lights, skins, morph targets and animations of the glTF file. In a
/// COLLADA file (`.dae`), each node with a mesh becomes an object. If the scene cannot store some of the content of the
/// file, the report lists and counts this content. The image files of materials are read from the folder that contains
/// the model or its material library. If two successive corners of a face are at the same vertex, the second of these
/// corners is removed. If the face then has fewer than three corners or still contains a vertex twice, the face is left
/// out.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// The file. A relative path is relative to the folder of the recipe.
    pub path: String,
    /// The name for objects that have no name in the file. If an `.mws` file contains a single object, the object gets
    /// this name even if the file already names it. If omitted, objects without a name get the name of the file without
    /// its extension.
    #[serde(default)]
    pub name: Option<String>,
    /// What to do if the faces do not form a manifold. This is the case if more than two faces share an edge, or if
    /// several groups of faces meet only at a vertex, like the tips of two cones.
    #[serde(default)]
    pub non_manifold: NonManifold,
    /// What to do if neighboring faces have opposite orientations.
    #[serde(default)]
    pub orientation: Orientation,
    /// What to do with a face that has the same vertices as an earlier face, in the same or in the opposite order.
    #[serde(default)]
    pub duplicates: CleanupPolicy,
    /// What to do with zero-area faces.
    #[serde(default)]
    pub degenerate: CleanupPolicy,
    /// What to do with vertices without a face.
    #[serde(default)]
    pub isolated: CleanupPolicy,
    /// What to do with the nodes of a glTF or `.mws` file. If the nodes are kept, later steps such as `Smooth` change a
    /// mesh in its own coordinate system, without the transforms of the nodes. The change is visible at every node that
    /// references the mesh.
    #[serde(default)]
    pub placements: Placements,
    /// Whether the step fails if it would leave out some content of the file. If false, the report lists the content
    /// that was left out.
    #[serde(default)]
    pub strict: bool,
}

impl Load {
    fn policies(&self) -> Policies {
        Policies {
            non_manifold: self.non_manifold,
            orientation: self.orientation,
            duplicates: self.duplicates,
            degenerate: self.degenerate,
            isolated: self.isolated,
        }
    }

    fn options(&self, budget: u64) -> ReadOptions {
        ReadOptions {
            name: self.name.clone(),
            policies: self.policies(),
            placements: self.placements,
            strict: self.strict,
            budget: Some(budget),
            ..ReadOptions::default()
        }
    }
}

impl Operation for Load {
    const NAME: &'static str = "Load";
    const VERSION: u32 = 3;
    const SUMMARY: &'static str = "Read the objects of a file";
    const EXAMPLE: &'static str = r#"Load(path: "teapot.bez")"#;
    const WORDS: &'static [&'static str] = &["import", "open", "read"];

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let path = cx.files.to_read(&self.path);
        plan.inputs.push(path.clone());
        match mesh_io::peek(&*cx.files.store, &path, &self.options(cx.budget)) {
            Ok(peek) => {
                plan.losses.extend(peek.left_out.iter().map(loss));
                plan.possible_losses.extend(dropped_faces(&peek, &path));
                self.plan_objects(&peek, plan)
            }
            Err(error) => {
                plan.incomplete = true;
                let field = match error {
                    ReadError::Strict { .. } => "strict",
                    _ => "path",
                };
                vec![Problem::error(error.to_string()).at([field])]
            }
        }
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("read", 0, 1)?;
        let path = cx.files().to_read(&self.path);
        let loaded = mesh_io::read(&*cx.files().store, &path, &self.options(cx.budget))
            .map_err(|error| OpError::File(error.to_string()))?;
        for file in loaded.files {
            cx.files().has_used(file.path, file.is_read);
        }
        let mut report = Report::changed(loaded.objects.len());
        for object in &loaded.objects {
            let bytes = object.as_mesh().map_or(0, |mesh| mesh.bytes() as u64);
            if bytes > cx.budget {
                let message = format!(
                    "the object \"{}\" needs {} of memory, which exceeds the memory budget of {}",
                    object.name,
                    op::readable_bytes(bytes),
                    op::readable_bytes(cx.budget)
                );
                return Err(OpError::Budget(message));
            }
        }
        let appended = scene.append(loaded.objects, loaded.graph);
        let left_out = appended.map_err(|error| OpError::Object(error.to_string()))?;
        if left_out > 0 {
            let what = "properties of the whole file left out, because an earlier file has different values for them";
            report = report.count(what, left_out);
        }
        for note in &loaded.notes {
            match note.kind {
                NoteKind::LeftOut => report.losses.push(loss(note)),
                NoteKind::Changed => report.changes.push(change(note)),
            }
        }
        cx.advance("read", 1, 1)?;
        Ok(report)
    }
}

impl Load {
    fn plan_objects(&self, peek: &Peek, plan: &mut Plan) -> Vec<Problem> {
        let mut problems = Vec::new();
        for object in &peek.objects {
            let geometry = match object.geometry {
                PeekGeometry::Mesh(mesh) => {
                    PlannedGeometry::Mesh(planned(object, &mesh, self.policies()))
                }
                PeekGeometry::Patches { patches } => {
                    PlannedGeometry::Patches(Range::exactly(patches))
                }
                PeekGeometry::Curve { points } => PlannedGeometry::Curve(Range::exactly(points)),
                PeekGeometry::Polylines { .. } => PlannedGeometry::Polylines,
            };
            // The parameter `name` does not replace the names that objects have in the file.
            let is_named_here = self.name.as_ref() == Some(&object.name);
            let field = if is_named_here { "name" } else { "path" };
            let taken = plan.insert(&object.name, geometry);
            let help = if self.name.is_none() || is_named_here {
                "give the object a different name with `name`, or rename the existing object"
            } else {
                "the name comes from the file, and the parameter `name` does not replace it: rename the existing object with `Rename`"
            };
            problems.extend(taken.map(|p| p.at([field]).help(help)));
        }
        if problems.is_empty() {
            plan.append_graph(peek.graph.clone());
        }
        problems
    }
}

/// Some faces of the file may contain a vertex twice. Returns the loss that reports how many faces could be dropped for
/// this reason. Returns `None` if there are no such faces, or if `peek` did not examine the faces.
fn dropped_faces(peek: &Peek, path: &Path) -> Option<Loss> {
    let count = |object: &PeekObject| match object.geometry {
        PeekGeometry::Mesh(mesh) if mesh.keeps_vertices || mesh.simple_faces > 0 => {
            mesh.faces.saturating_sub(mesh.simple_faces)
        }
        _ => 0,
    };
    let n: u64 = peek.objects.iter().map(count).sum();
    let path = path.display().to_string();
    (n > 0).then(|| Loss {
        code: "faces-dropped".to_owned(),
        count: Some(n),
        ..Loss::part(
            &path,
            "faces-dropped",
            format!("up to {n} of its faces"),
            "they may contain a vertex twice",
        )
    })
}

/// Converts a note to the record of a loss. In the note, the reader of the file reports that it left out some content.
fn loss(note: &Note) -> Loss {
    Loss::reading(
        &note.path.display().to_string(),
        note.code,
        note.count as u64,
        note.to_string(),
    )
}

/// Converts a note to the record of a change. In the note, the reader of the file reports that it changed a mesh, for
/// example by splitting a vertex.
fn change(note: &Note) -> ReadingChange {
    let vertex = |v: &VertexId| v.index() as u64;
    let elements = note.elements.as_ref().map(|elements| match elements {
        Elements::Vertices(list) => ReadingElements::Vertices(list.iter().map(vertex).collect()),
        Elements::Edges(list) => ReadingElements::Edges(
            list.iter()
                .map(|ends| ends.each_ref().map(vertex))
                .collect(),
        ),
        Elements::Faces(list) => ReadingElements::Faces(list.iter().map(|&f| f as u64).collect()),
    });
    ReadingChange {
        code: note.code.to_owned(),
        count: note.count as u64,
        elements,
        message: note.to_string(),
    }
}

/// The plan of a mesh contains at most this number of joints, and at most this number of morph targets.
const MAX_PLANNED: u64 = 1 << 12;

/// Returns the plan of a mesh that is read from a file. The plan predicts the counts and attributes of the mesh. `peek`
/// contains the number of elements of each kind in the file.
fn planned(object: &PeekObject, peek: &PeekMesh, policies: Policies) -> MeshPlan {
    let range = |range: RangeInclusive<u64>| Range::between(*range.start(), *range.end());
    let ranges = peek.ranges(policies);
    let mut plan = MeshPlan {
        vertices: range(ranges.vertices),
        edges: range(ranges.edges),
        faces: range(ranges.faces),
        degrees: range(ranges.degrees),
        attributes: Vec::new(),
        has_unlisted_attributes: object.attributes.is_none(),
        materials: object.materials.clone(),
    };
    let others = object.attributes.iter().flatten();
    if peek.is_exact {
        for (domain, name) in others {
            plan.provide(*domain, name);
        }
        return plan;
    }
    let mut provide_uncertain = |may_exist: bool, domain, name: &str| {
        if may_exist {
            plan.provide(domain, name);
            if let Some(attribute) = plan.attributes.last_mut() {
                attribute.certain = false;
            }
        }
    };
    provide_uncertain(peek.uvs, Domain::Corner, mesh::UV.name);
    provide_uncertain(peek.normals, Domain::Vertex, mesh::VERTEX_NORMAL.name);
    provide_uncertain(peek.normals, Domain::Corner, mesh::CORNER_NORMAL.name);
    provide_uncertain(peek.colors, Domain::Vertex, mesh::COLOR.name);
    provide_uncertain(peek.materials, Domain::Face, mesh::MATERIAL.name);
    // It is not certain that the attributes of joints and morph targets exist. The reader can leave out morph targets,
    // and a joint has weights only if a vertex uses the joint.
    let deformers = |n: u64, name: fn(usize) -> String| {
        let n = usize::try_from(n.min(MAX_PLANNED)).unwrap_or(0);
        (0..n).map(name)
    };
    let joints = deformers(peek.joints, mesh::joint_name);
    for name in joints.chain(deformers(peek.targets, mesh::morph_name)) {
        provide_uncertain(true, Domain::Vertex, &name);
    }
    for (domain, name) in others {
        provide_uncertain(true, *domain, name);
    }
    plan
}

#[cfg(test)]
mod tests {
    use super::*;
    use op::{FileUse, Files, NoProgress};

    fn files(folder: &Path) -> Files {
        Files {
            input: folder.into(),
            ..Files::default()
        }
    }

    fn load(text: &str) -> Load {
        op::test::read(text).unwrap()
    }

    #[test]
    fn a_file_is_planned_and_read() {
        let folder = tempfile::tempdir().unwrap();
        let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        std::fs::write(folder.path().join("a.obj"), obj).unwrap();
        let files = files(folder.path());
        let operation = load("(path: \"a.obj\", name: Some(\"quad\"))");

        let mut plan = Plan::default();
        let cx = PlanContext::new(&files);
        assert_eq!(operation.plan(&mut plan, &cx), []);
        let Some(PlannedGeometry::Mesh(planned)) = plan.object("quad").map(|o| &o.geometry) else {
            panic!("a mesh is planned");
        };

        let mut scene = Scene::new();
        operation
            .apply(&mut scene, &mut Context::new(&NoProgress, &files))
            .unwrap();
        let mesh = scene.object("quad").and_then(|o| o.as_mesh()).unwrap();
        assert!(planned.vertices.contains(mesh.n_vertices() as u64));
        assert!(planned.edges.contains(mesh.n_edges() as u64));
        assert!(planned.faces.contains(mesh.n_faces() as u64));
        assert!(planned.degrees.contains(4));
    }

    #[test]
    fn a_name_of_the_file_that_is_taken_is_not_blamed_on_the_step() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = Scene::new();
        let object = scene::Object::mesh("spot", geometry::shapes::tetrahedron());
        scene.insert(object).unwrap();
        let path = folder.path().join("a.glb");
        let options = mesh_io::WriteOptions::default();
        mesh_io::write(&store::Disk, &path, &scene, &options).unwrap();
        let files = files(folder.path());
        let mut plan = Plan::default();
        let step = load("(path: \"a.glb\", name: Some(\"new\"))");
        let cx = PlanContext::new(&files);
        assert_eq!(step.plan(&mut plan, &cx), []);
        let problems = step.plan(&mut plan, &cx);
        assert_eq!(problems.len(), 1);
        assert!(
            format!("{problems:?}").contains("the name comes from the file"),
            "{problems:?}"
        );
    }

    #[test]
    fn a_mesh_that_two_nodes_show_is_one_object_unless_it_is_baked() {
        let folder = tempfile::tempdir().unwrap();
        let mut twice = Scene::new();
        let object = scene::Object::mesh("wheel", geometry::shapes::tetrahedron());
        twice.insert(object).unwrap();
        let plain = scene::Object::mesh("plain", geometry::shapes::square());
        twice.insert(plain).unwrap();
        for name in ["left", "right"] {
            twice.graph_mut().push(scene::Node {
                name: Some(name.to_owned()),
                object: Some("wheel".to_owned()),
                ..scene::Node::default()
            });
        }
        let path = folder.path().join("a.glb");
        let options = mesh_io::WriteOptions::default();
        mesh_io::write(&store::Disk, &path, &twice, &options).unwrap();
        let files = files(folder.path());
        for (text, expected) in [
            ("(path: \"a.glb\")", &["wheel", "plain"][..]),
            (
                "(path: \"a.glb\", placements: Bake)",
                &["left", "right", "plain"],
            ),
        ] {
            let mut plan = Plan::default();
            let cx = PlanContext::new(&files);
            assert_eq!(load(text).plan(&mut plan, &cx), []);
            let mut scene = Scene::new();
            let mut cx = Context::new(&NoProgress, &files);
            load(text).apply(&mut scene, &mut cx).unwrap();
            let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
            let planned: Vec<_> = plan.objects().iter().map(|o| o.name.as_str()).collect();
            assert_eq!((&names[..], &planned[..]), (expected, expected));
            let instances: u64 = names.iter().map(|name| plan.instances(name)).sum();
            assert_eq!(instances, 3);
            assert_eq!(scene.instances().len(), 3);
            assert_eq!(plan.graph(), scene.graph(), "{text}");
        }
    }

    #[test]
    fn a_missing_file_is_a_problem_of_the_parameter_path() {
        let files = files(Path::new("nowhere"));
        let cx = PlanContext::new(&files);
        let problems = load("(path: \"a.obj\")").plan(&mut Plan::default(), &cx);
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].path, ["path"]);
        assert!(
            problems[0].message.contains("nowhere"),
            "{}",
            problems[0].message
        );
    }

    #[test]
    fn unclean_faces_and_vertices_are_kept_or_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nv 9 9 9\nf 1 2 3\nf 3 1 2\nf 1 2 4\np 5\n";
        std::fs::write(folder.path().join("a.obj"), obj).unwrap();
        let files = files(folder.path());
        let counts = |text: &str| {
            let mut scene = Scene::new();
            let mut cx = Context::new(&NoProgress, &files);
            let done = load(text)
                .apply(&mut scene, &mut cx)
                .map_err(|e| e.to_string())?;
            let mesh = scene.object("a").and_then(|o| o.as_mesh()).unwrap();
            Ok::<_, String>((
                mesh.n_vertices(),
                mesh.n_faces(),
                done.changes.len() + done.losses.len(),
            ))
        };
        assert_eq!(counts("(path: \"a.obj\")").unwrap().1, 3);
        let all = "(path: \"a.obj\", duplicates: Drop, degenerate: Drop, isolated: Drop)";
        assert_eq!(counts(all), Ok((3, 1, 4)));
        let strict = counts("(path: \"a.obj\", strict: true)").unwrap_err();
        assert!(strict.contains("1 point (`p`) left out"), "{strict}");
    }

    #[test]
    fn all_accessed_files_are_logged() {
        let folder = tempfile::tempdir().unwrap();
        let obj = "mtllib there.mtl\nmtllib not there.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
        std::fs::write(folder.path().join("a.obj"), obj).unwrap();
        std::fs::write(folder.path().join("there.mtl"), "newmtl x\n").unwrap();
        let files = files(folder.path());
        let mut cx = Context::new(&NoProgress, &files);
        load("(path: \"a.obj\")")
            .apply(&mut Scene::new(), &mut cx)
            .unwrap();
        let path = |name| folder.path().join(name);
        assert_eq!(
            files.log.take(),
            [
                FileUse::Requested {
                    path: "a.obj".into(),
                    full: path("a.obj"),
                },
                FileUse::Read(path("a.obj")),
                FileUse::ExistenceChecked(path("not")),
                FileUse::Read(path("not")),
                FileUse::ExistenceChecked(path("not there.mtl")),
                FileUse::ExistenceChecked(path("there.mtl")),
                FileUse::Read(path("there.mtl")),
            ]
        );
    }

    #[test]
    fn non_manifold_faces_can_be_refused() {
        let folder = tempfile::tempdir().unwrap();
        let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
        std::fs::write(folder.path().join("a.obj"), obj).unwrap();
        let files = files(folder.path());
        let mut scene = Scene::new();
        let mut cx = Context::new(&NoProgress, &files);
        let refused = load("(path: \"a.obj\", non_manifold: Refuse)").apply(&mut scene, &mut cx);
        assert!(refused.is_err());
        let report = load("(path: \"a.obj\")")
            .apply(&mut scene, &mut cx)
            .unwrap();
        let change = &report.changes[0];
        assert_eq!((change.code.as_str(), change.count), ("edges-split", 1));
        assert_eq!(change.elements, Some(ReadingElements::Edges(vec![[0, 1]])));
    }
}
