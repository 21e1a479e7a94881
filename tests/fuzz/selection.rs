//! Reads arbitrary strings as selections, and evaluates them on a torus.

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use scene::{Object, Scene};

static SCENE: LazyLock<Scene> = LazyLock::new(|| {
    let mut scene = Scene::new();
    let torus = geometry::shapes::torus(8, 6, 2.0, 1.0);
    scene.insert(Object::mesh("a", torus)).expect("the first object");
    scene
});

fuzz_target!(|text: &str| {
    let Ok(elements) = recipe::read_selection(text, None) else {
        return;
    };
    let object = &SCENE.objects()[0];
    let mesh = object.as_mesh().expect("a torus is a mesh");
    let _ = recipe::resolve(&elements, &SCENE, object, mesh, "step");
});
