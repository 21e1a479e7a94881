//! The law: with a cache, whatever it holds, everything is as it is without one.

use proptest::prelude::*;

use super::damage::all_files;
use super::*;

/// A step of a random recipe.
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
    let first = (1..3_u32, any::<bool>()).prop_map(|(n, tells)| {
        format!(
            "FromFile(path: \"n.txt\", tells: {tells}), Sheet(columns: {}, name: \"b\"),",
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
            .scan(false, |named, step| {
                // An id is there once.
                let is_named = step.contains("id:");
                Some((
                    is_named && std::mem::replace(named, *named || is_named),
                    step,
                ))
            })
            .filter(|(again, _)| !again)
            .map(|(_, step)| step)
            .collect();
        format!(
            "(recipe: 1, steps: [{first} {}], expect: [{expect}])",
            steps.join(", ")
        )
    })
}

/// Something that happens between two runs.
#[derive(Clone, Debug)]
enum Event {
    Input(u32),
    NoInput,
    Flip(prop::sample::Index, usize),
    Cut(prop::sample::Index),
    Remove(prop::sample::Index),
    Exchange(prop::sample::Index, prop::sample::Index),
    Nothing,
}

fn event() -> impl Strategy<Value = Event> {
    let index = any::<prop::sample::Index>;
    prop_oneof![
        (1..4_u32).prop_map(Event::Input),
        Just(Event::NoInput),
        (index(), any::<usize>()).prop_map(|(file, at)| Event::Flip(file, at)),
        index().prop_map(Event::Cut),
        index().prop_map(Event::Remove),
        (index(), index()).prop_map(|(a, b)| Event::Exchange(a, b)),
        Just(Event::Nothing),
    ]
}

fn happen(place: &Place, event: &Event) {
    let files = all_files(&place.path("cache"));
    match event {
        Event::Input(n) => return place.write("n.txt", &n.to_string()),
        Event::NoInput => {
            let _ = fs::remove_file(place.path("n.txt"));
            return;
        }
        Event::Nothing => return,
        _ if files.is_empty() => return,
        _ => {}
    }
    match event {
        Event::Flip(file, at) => {
            let path = file.get(&files);
            let mut bytes = fs::read(path).unwrap();
            let n = bytes.len().max(1);
            if let Some(byte) = bytes.get_mut(at % n) {
                *byte ^= 1 << (at % 8);
            }
            fs::write(path, bytes).unwrap();
        }
        Event::Cut(file) => {
            let bytes = fs::read(file.get(&files)).unwrap();
            fs::write(file.get(&files), &bytes[..bytes.len() / 2]).unwrap();
        }
        Event::Remove(file) => fs::remove_file(file.get(&files)).unwrap(),
        Event::Exchange(a, b) => _ = fs::copy(a.get(&files), b.get(&files)),
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn runs_with_a_cache_are_runs_without_one(
        recipes in prop::collection::vec(recipe(), 1..3),
        events in prop::collection::vec((event(), any::<prop::sample::Index>()), 1..8),
    ) {
        let place = Place::new();
        place.write("n.txt", "2");
        for (event, recipe) in &events {
            happen(&place, event);
            place.run(recipe.get::<String>(&recipes));
        }
    }
}

#[test]
fn two_runs_at_once_are_as_one() {
    let place = Place::new();
    place.write("n.txt", "2");
    let text = |n: usize| {
        steps(&format!(
            "FromFile(path: \"n.txt\", tells: true), Sheet(columns: 700), Lift(by: 1), Lift(by: {}), Write(path: \"a.txt\")",
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
                // A place of its own over the same folder; only the cache is shared.
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
                        // In the middle of what the others do.
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
