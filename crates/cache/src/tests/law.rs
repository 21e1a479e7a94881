//! Property tests: for any content of the cache, a run with the cache has the same outcome as a run without it.

use proptest::prelude::*;

use super::damage::all_files;
use super::*;

/// Generates a step of a random recipe.
fn step() -> impl Strategy<Value = String> {
    let by = (1..4_u32).prop_map(|by| format!("Lift(by: {by})"));
    prop_oneof![
        4 => by,
        1 => (1..3_u32).prop_map(|by| format!("(id: \"some\", run: Lift(by: {by}, vertices: Random(count: 2, seed: {by})))")),
        1 => Just("(run: Lift(by: 1), on: [\"b\"])".to_owned()),
        1 => Just("(run: Lift(by: 1, fails: Seam), refused: Seam)".to_owned()),
        1 => Just("Lift(by: 1, fails: Seam)".to_owned()),
        1 => Just("Write(path: \"a.txt\")".to_owned()),
    ]
}

fn recipe() -> impl Strategy<Value = String> {
    let first = (1..3_u32, any::<bool>()).prop_map(|(n, reports)| {
        format!(
            "FromFile(path: \"n.txt\", reports: {reports}), Sheet(columns: {}, name: \"b\"),",
            n * 350
        )
    });
    let expect = prop_oneof![
        Just("Faces(min: 1), Not(Closed)"),
        Just("Same(as: File(\"n.txt\"))"),
        Just("(on: [\"file\"], that: Same(as: File(\"n.txt\")))"),
    ];
    (first, prop::collection::vec(step(), 0..5), expect).prop_map(|(first, steps, expect)| {
        let mut written = false;
        let steps: Vec<String> = steps
            .into_iter()
            .filter(|step| !step.contains("Write") || !std::mem::replace(&mut written, true))
            .scan(false, |has_id, step| {
                // Ids of steps must be unique. If several steps have the same id, only the first of them is kept.
                let is_named = step.contains("id:");
                Some((
                    is_named && std::mem::replace(has_id, *has_id || is_named),
                    step,
                ))
            })
            .filter(|(is_duplicate, _)| !is_duplicate)
            .map(|(_, step)| step)
            .collect();
        format!(
            "(recipe: 1, steps: [{first} {}], expect: [{expect}])",
            steps.join(", ")
        )
    })
}

/// A change of the input file or of the cache between two runs.
#[derive(Clone, Debug)]
enum Event {
    WriteInput(u32),
    RemoveInput,
    FlipBit(prop::sample::Index, usize),
    Truncate(prop::sample::Index),
    Remove(prop::sample::Index),
    Overwrite(prop::sample::Index, prop::sample::Index),
    Nothing,
}

fn event() -> impl Strategy<Value = Event> {
    let index = any::<prop::sample::Index>;
    prop_oneof![
        (1..4_u32).prop_map(Event::WriteInput),
        Just(Event::RemoveInput),
        (index(), any::<usize>()).prop_map(|(file, at)| Event::FlipBit(file, at)),
        index().prop_map(Event::Truncate),
        index().prop_map(Event::Remove),
        (index(), index()).prop_map(|(a, b)| Event::Overwrite(a, b)),
        Just(Event::Nothing),
    ]
}

fn apply_event(place: &Place, event: &Event) {
    let files = all_files(&place.path("cache"));
    match event {
        Event::WriteInput(n) => return place.write("n.txt", &n.to_string()),
        Event::RemoveInput => {
            let _ = fs::remove_file(place.path("n.txt"));
            return;
        }
        Event::Nothing => return,
        _ if files.is_empty() => return,
        _ => {}
    }
    match event {
        Event::FlipBit(file, at) => {
            let path = file.get(&files);
            let mut bytes = fs::read(path).unwrap();
            let n = bytes.len().max(1);
            if let Some(byte) = bytes.get_mut(at % n) {
                *byte ^= 1 << (at % 8);
            }
            fs::write(path, bytes).unwrap();
        }
        Event::Truncate(file) => {
            let bytes = fs::read(file.get(&files)).unwrap();
            fs::write(file.get(&files), &bytes[..bytes.len() / 2]).unwrap();
        }
        Event::Remove(file) => fs::remove_file(file.get(&files)).unwrap(),
        Event::Overwrite(a, b) => _ = fs::copy(a.get(&files), b.get(&files)),
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn runs_with_and_without_a_cache_have_the_same_outcome(
        recipes in prop::collection::vec(recipe(), 1..3),
        events in prop::collection::vec((event(), any::<prop::sample::Index>()), 1..8),
    ) {
        let place = Place::new();
        place.write("n.txt", "2");
        for (event, recipe) in &events {
            apply_event(&place, event);
            place.run(recipe.get::<String>(&recipes));
        }
    }
}

#[test]
fn concurrent_runs_can_share_a_cache() {
    let place = Place::new();
    place.write("n.txt", "2");
    let text = |n: usize| {
        steps(&format!(
            "FromFile(path: \"n.txt\", reports: true), Sheet(columns: 700), Lift(by: 1), Lift(by: {}), Write(path: \"a.txt\")",
            n % 3 + 1
        ))
    };
    let plain: Vec<Outcome> = (0..3)
        .map(|n| place.run_with(&text(n), None, &format!("plain{n}")))
        .collect();
    let (cache, recipe) = (&place.cache, place.recipe.as_deref());
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (plain, text) = (&plain, &text);
            let folder = place.folder.path();
            scope.spawn(move || {
                // Each thread has its own output folder; only the cache is shared.
                for n in 0..12 {
                    let caching = Caching {
                        cache,
                        recipe,
                        want_scene: n % 2 == 0,
                    };
                    let out = format!("out{thread}");
                    let outcome = run_in(folder, &text(n), caching, &out);
                    assert_same(&plain[n % 3], &outcome);
                    assert_eq!(
                        fs::read(folder.join(out).join("a.txt")).unwrap(),
                        b"file\nsheet"
                    );
                    if thread == 0 && n % 4 == 3 {
                        // The other threads use the cache at the same time.
                        let _ = cache.clear();
                    }
                }
            });
        }
    });
}

fn run_in(folder: &Path, text: &str, caching: Caching, out: &str) -> Outcome {
    let registry = registry().with::<FromFile>();
    let source = recipe::Source::new(folder.join("recipe.ron"), text);
    let reading = recipe::read(&source, &registry, recipe::Values::default());
    let files = Files {
        input: folder.into(),
        output: folder.join(out),
        provenance: Some(reading.recipe.digest()),
        ..Files::default()
    };
    let settings = Settings {
        files: &files,
        budget: u64::MAX,
        reader: &GridReader,
        keep_outputs: true,
        writes: true,
        cache: Some(&caching),
    };
    recipe::run(&reading.recipe, settings, &Silent)
}
