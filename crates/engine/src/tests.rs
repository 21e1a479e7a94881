mod faults;

use std::sync::Mutex;

use op::{Progress, Registry};
use scene::Scene;

use super::*;

const RECIPE: &str = "(recipe: 1, steps: [
    Cube(name: \"cube\"),
    (id: \"poke\", run: PokeFaces()),
    Repeat(times: 2, steps: [(id: \"again\", run: PokeFaces(distance: 0.1))]),
], expect: [Faces(eq: 216), (after: \"poke\", that: Faces(eq: 24))])";

fn registry() -> Registry {
    Registry::new()
        .with_group(ops_files::register)
        .with_group(ops_shapes::register)
        .with_group(ops_faces::register)
}

fn loaded(text: &str) -> Loaded {
    let registry = registry();
    let engine = Engine::new(&registry).with_store(Arc::new(Memory::default()));
    let loaded = engine.load(&Source::new("a.ron", text), &Options::default());
    assert_eq!(loaded.diagnostics, [], "{text}");
    loaded
}

/// A listener that collects the scene after each step.
#[derive(Default)]
struct SceneCollector(Mutex<Vec<Scene>>);

impl Progress for SceneCollector {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

impl Listener for SceneCollector {
    fn step_begins(&self, _: usize, _: &str) {}
    fn step_done(&self, _: usize, _: &StepDone) {}

    fn wants_scenes(&self) -> bool {
        true
    }

    fn scene_after(&self, number: usize, scene: &Scene) {
        let mut scenes = self.0.lock().unwrap();
        assert_eq!(scenes.len(), number);
        scenes.push(scene.clone());
    }
}

#[test]
fn a_run_from_any_step_has_the_same_result_as_the_whole_run() {
    let recipe = loaded(RECIPE);
    let collector = SceneCollector::default();
    let whole = recipe.run(Run::default(), &collector);
    assert!(whole.succeeded());
    let scenes = collector.0.into_inner().unwrap();
    assert_eq!(scenes.len(), recipe.recipe.steps.len());
    for (i, scene) in scenes.into_iter().enumerate() {
        let rest = recipe.run_from(i + 1, scene, Run::default(), &Silent);
        assert!(rest.succeeded());
        assert_eq!((rest.digest, rest.first), (whole.digest, i + 1));
        assert_eq!(rest.steps.len(), whole.steps.len() - i - 1);
    }
}

#[test]
fn cancel_cancels_a_run() {
    let cancel = Cancel::new();
    assert!(loaded(RECIPE).run(Run::default(), &cancel).succeeded());
    assert!(!cancel.set() && cancel.set());
    let outcome = loaded(RECIPE).run(Run::default(), &cancel);
    assert!(outcome.cancelled && outcome.steps.is_empty());
}

#[test]
fn a_recipe_stops_after_or_before_the_given_step() {
    let faces = |stop: Stop| {
        let mut recipe = loaded(RECIPE);
        let stream = recipe.stop(stop).unwrap();
        let scene = recipe.run(Run::default(), &Silent).scene.unwrap();
        let mesh = scene
            .objects()
            .first()
            .map(|o| o.as_mesh().unwrap().n_faces());
        (mesh, stream)
    };
    let after = |id| Stop {
        after: Some(id),
        before: None,
    };
    let before = |id| Stop {
        after: None,
        before: Some(id),
    };
    assert_eq!(faces(Stop::default()), (Some(216), String::new()));
    assert_eq!(faces(after("poke")), (Some(24), String::new()));
    assert_eq!(faces(before("poke")), (Some(6), "poke".to_owned()));
    assert_eq!(faces(after("again")), (Some(216), String::new()));
    assert_eq!(faces(before("Cube")), (None, "Cube".to_owned()));
    let error = loaded(RECIPE).stop(after("pok")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no step of a.ron has the id \"pok\": did you mean `poke`?"
    );
}

#[test]
fn scene_before_leaves_the_recipe_unchanged() {
    let mut recipe = loaded(RECIPE);
    let scene = recipe.scene_before(2, &Silent).unwrap();
    assert_eq!(scene.objects()[0].as_mesh().unwrap().n_faces(), 24);
    assert!(recipe.run(Run::default(), &Silent).succeeded());
}

#[test]
fn called_recipes_are_read_from_the_store() {
    let store = Arc::new(Memory::default());
    let registry = registry();
    let engine = Engine::new(&registry).with_store(store.clone());
    let text = "(recipe: 1, steps: [Call(recipe: \"lib/part.ron\")])";
    store.write("a.ron".as_ref(), text.as_bytes()).unwrap();
    let source = engine.open("a.ron".as_ref()).unwrap();
    let missing = engine.load(&source, &Options::default());
    assert!(
        missing.diagnostics[0]
            .message
            .starts_with("cannot read lib/part.ron: ")
    );
    let part = b"(recipe: 1, steps: [Cube(name: \"cube\")])";
    store.write("lib/part.ron".as_ref(), part).unwrap();
    let found = engine.load(&source, &Options::default());
    assert_eq!(found.diagnostics, []);
    assert_eq!(found.run(Run::default(), &Silent).steps.len(), 1);
}

#[test]
fn steps_read_and_write_files_in_the_store() {
    let store = Arc::new(Memory::default());
    let registry = registry();
    let engine = Engine::new(&registry).with_store(store.clone());
    let model = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    store.write("a.obj".as_ref(), model).unwrap();
    store
        .write("a.mtl".as_ref(), b"newmtl red\nKd 1 0 0\n")
        .unwrap();
    let text = "(recipe: 1, steps: [Load(path: \"a.obj\"), PokeFaces(), Save(path: \"new/b.obj\")],
        expect: [Faces(eq: 3), Same(as: File(\"out/new/b.obj\"))])";
    let run = Run {
        keep_outputs: true,
        cache: None,
    };
    // The first run writes a file. The second run compares its scene with this file.
    let load = |text: &str| engine.load(&Source::new("a.ron", text), &Options::default());
    let first = text.replace(", Same(as: File(\"out/new/b.obj\"))", "");
    for text in [first.as_str(), text] {
        let recipe = load(text);
        assert_eq!(recipe.diagnostics, []);
        let outcome = recipe.run(run, &Silent);
        assert_eq!(outcome.failures, []);
        let written = ["out/new/b.mtl", "out/new/b.obj"].map(std::path::PathBuf::from);
        assert_eq!(outcome.written, written);
        assert_eq!(
            store::files_below(&*store, "out".as_ref()).unwrap(),
            written
        );
    }
}
