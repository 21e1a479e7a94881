//! Checks expectations against small scenes, and the messages of those that do not hold.

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

/// Checks an expectation against some objects of a scene. The file `octahedron.obj` contains an octahedron;
/// every other file cannot be read.
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

/// Asserts that the expectation `holds` holds, and that `fails` fails with the message.
#[track_caller]
fn holds_and_fails(scene: &Scene, holds: &str, fails: &str, message: &str) {
    assert_eq!(check(scene, holds), Ok(()), "{holds}");
    assert_eq!(check(scene, fails), Err(message.to_owned()), "{fails}");
}
