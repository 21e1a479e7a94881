//! Expectations against small scenes: what holds, and the message of what does not.

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

/// A scene with these meshes.
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

fn of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    Mesh::from_polygons(positions.to_vec(), polygons).unwrap().0
}

/// A polyline of three points.
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

/// Holds an expectation against some objects of a scene. The file `octahedron.obj` holds one, every
/// other file is broken.
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
    };
    expectation(text)
        .hold(subject)
        .map_err(|broken| broken.message)
}

fn check(scene: &Scene, text: &str) -> Result<(), String> {
    check_on(scene, None, text)
}

/// One expectation holds, another fails with a message.
#[track_caller]
fn holds_and_fails(scene: &Scene, holds: &str, fails: &str, message: &str) {
    assert_eq!(check(scene, holds), Ok(()), "{holds}");
    assert_eq!(check(scene, fails), Err(message.to_owned()), "{fails}");
}
