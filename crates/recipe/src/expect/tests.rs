//! Checks expectations against small scenes. If an expectation does not hold, its message is checked, too.

mod counts;
mod logic;
mod measures;
mod places;
mod same;

use std::path::Path;

use geometry::shapes;
use mesh::{DVec3, Mesh};
use op::Files;
use scene::{Geometry, Object, Scene};

use super::{Expectation, Subject};
use crate::tests::objects;

/// Returns a scene with these meshes.
fn scene(meshes: impl IntoIterator<Item = (&'static str, Mesh)>) -> Scene {
    let mut scene = Scene::new();
    for (name, mesh) in meshes {
        scene.insert(Object::mesh(name, mesh)).unwrap();
    }
    scene
}

fn cube() -> Scene {
    scene([("cube", shapes::cube())])
}

fn mesh_from(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    Mesh::from_polygons(positions.to_vec(), polygons).unwrap().0
}

/// Returns a scene with one polyline of three points.
fn lines() -> Scene {
    let line = vec![DVec3::ZERO, DVec3::X, DVec3::new(3.0, 1.0, 0.0)];
    let mut scene = Scene::new();
    let lines = Geometry::Polylines(vec![line]);
    scene.insert(Object::new("lines", lines)).unwrap();
    scene
}

fn expectation(text: &str) -> Expectation {
    ron_tree::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Checks an expectation against some objects of a scene. The file `octahedron.obj` contains an octahedron; no other
/// file can be read.
fn check_on(scene: &Scene, on: Option<&[String]>, text: &str) -> Result<(), String> {
    let files = Files {
        input: "folder".into(),
        ..Files::default()
    };
    let reader = objects(|path, _| {
        if path == Path::new("folder/octahedron.obj") {
            Ok(vec![Object::mesh("octahedron", shapes::octahedron())])
        } else {
            Err(format!("{} is broken", path.display()))
        }
    });
    let subject = Subject {
        scene,
        on,
        files: &files,
        reader: &reader,
        progress: &op::NoProgress,
    };
    expectation(text)
        .check(subject)
        .map_err(|violation| violation.message)
}

fn check(scene: &Scene, text: &str) -> Result<(), String> {
    check_on(scene, None, text)
}

#[test]
fn measures_in_space_see_every_instance_and_counts_see_each_object_once() {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("square", shapes::square()))
        .unwrap();
    scene
        .insert(Object::mesh("flat", shapes::square()))
        .unwrap();
    for (i, x) in [(0, 0.0), (1, 10.0)] {
        scene.graph_mut().push(scene::Node {
            name: Some(format!("node {i}")),
            placement: scene::Placement::Parts {
                translation: [x, 0.0, 0.0],
                rotation: [0.0, 0.0, 0.0, 1.0],
                scale: [1.0, 2.0, 1.0],
            },
            object: Some("square".to_owned()),
            ..scene::Node::default()
        });
    }
    assert_eq!(check(&scene, "Faces(eq: 2)"), Ok(()));
    assert_eq!(check(&scene, "Objects(eq: 2)"), Ok(()));
    assert_eq!(check(&scene, "Area(eq: 5)"), Ok(()));
    assert_eq!(check(&scene, "Not(Area(eq: 3))"), Ok(()));
    assert_eq!(
        check(&scene, "Bounds(min: (0, 0, 0), max: (11, 2, 0))"),
        Ok(())
    );
    let on = ["square".to_owned()];
    assert_eq!(check_on(&scene, Some(&on), "Area(eq: 4)"), Ok(()));
    assert_eq!(check_on(&scene, Some(&on), "Faces(eq: 1)"), Ok(()));
    let on = ["flat".to_owned()];
    let several = "expected 1 instance of \"square\", found 2".to_owned();
    let distance = r#"DistanceTo(other: Object("square"), below: 1)"#;
    assert_eq!(check_on(&scene, Some(&on), distance), Err(several));
    let unknown = ["door".to_owned()];
    let missing = Err("no object is named \"door\"".to_owned());
    assert_eq!(check_on(&scene, Some(&unknown), "Area(eq: 4)"), missing);
    // If a node references the object, the mesh is checked at the position of the node.
    scene.graph_mut().push(scene::Node {
        object: Some("flat".to_owned()),
        placement: scene::Placement::Parts {
            translation: [0.0, 0.0, 3.0],
            rotation: [0.0, 0.0, 0.0, 1.0],
            scale: [1.0; 3],
        },
        ..scene::Node::default()
    });
    let at = "Position(of: Vertices([0]), is: (0, 0, 3))";
    assert_eq!(check_on(&scene, Some(&["flat".to_owned()]), at), Ok(()));
}

/// Asserts that the first expectation holds, and that the second one fails with this message.
#[track_caller]
fn holds_and_fails(scene: &Scene, holds: &str, fails: &str, message: &str) {
    assert_eq!(check(scene, holds), Ok(()), "{holds}");
    assert_eq!(check(scene, fails), Err(message.to_owned()), "{fails}");
}
