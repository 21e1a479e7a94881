//! Reads, checks and runs arbitrary strings as recipes, with all operations, selections and expectations. Files are in
//! memory. Either the recipe is refused, or its result is valid.

#![no_main]

use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, LazyLock};

use engine::{Engine, Listener, Memory, Options, Run, Store};
use libfuzzer_sys::fuzz_target;
use op::{Progress, Registry};

static REGISTRY: LazyLock<Registry> = LazyLock::new(ops_all::registry);

/// Cancels a run after some progress reports, so that no run takes long.
#[derive(Default)]
struct Limit(AtomicU32);

impl Progress for Limit {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) < 3000
    }
}

impl Listener for Limit {}

fuzz_target!(|text: &str| {
    let store = Arc::new(Memory::default());
    let path = "recipe.ron".as_ref();
    store.write(path, text.as_bytes()).expect("memory can be written");
    let engine = Engine::new(&REGISTRY).with_store(store);
    let source = engine.open(path).expect("the text is valid UTF-8");
    let options = Options {
        budget: 4 << 20,
        ..Options::default()
    };
    let loaded = engine.load(&source, &options);
    if loaded.has_errors() {
        assert!(loaded.diagnostics.iter().all(|d| !d.message.is_empty()));
        return;
    }
    let outcome = loaded.run(Run::default(), &Limit::default());
    let objects = outcome.scene.iter().flat_map(|scene| scene.objects());
    for mesh in objects.filter_map(|object| object.as_mesh()) {
        assert_eq!(mesh.defects(), []);
    }
});
