//! Runs every recipe in `scenes/` as several tests.
//!
//! ```text
//! teapot                          all expectations hold, and the digest equals the digest in digests.txt
//! teapot: any number of threads   runs with 1, 2 and 8 threads give the same digest and the same files
//! teapot: from every step         a run that starts at a step, from the scene before the step, gives the same digest
//! teapot: every step is needed    the recipe fails if any one of its steps is removed
//! ```
//!
//! The test `from every step` skips recipes that need much memory. The test `every step is needed` keeps two kinds of
//! steps: steps that only write files, and steps that must be refused. If the environment variable `MESHWRIGHT_UPDATE`
//! is set, digests.txt is rewritten before the tests run.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, Mutex};

use engine::{Engine, Listener, Loaded, Options, Outcome, Silent, Source, StepDone};
use libtest_mimic::{Arguments, Failed, Trial};
use op::Progress;
use ron_tree::{Lexer, Span, TokenKind, Value};
use tempfile::TempDir;

/// The memory budget in bytes.
const BUDGET: u64 = 4 << 30;

/// The test `from every step` skips a recipe if its predicted memory peak is above this number of bytes.
const MAX_BYTES_FROM_EVERY_STEP: u64 = 16 << 20;

/// The operations that only write files. A recipe without these steps still succeeds, unless it has expectations about
/// the written files.
const OUTPUTS: [&str; 5] = [
    "CurveFigure",
    "HalfEdgeFigure",
    "Picture",
    "Save",
    "UvPicture",
];

const DIGESTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/digests.txt");

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments = Arguments::from_args();
    let recipes = Scene::all()?;
    if std::env::var_os("MESHWRIGHT_UPDATE").is_some() {
        update(&recipes)?;
    }
    let digests = Arc::new(digests()?);
    let mut trials = vec![has_recipes(recipes.len())];
    trials.push(digests_name_recipes(&recipes, &digests));
    trials.push(Trial::test(
        "unneeded steps are found",
        unneeded_steps_are_found,
    ));
    for recipe in recipes {
        let recipe = Arc::new(recipe);
        let name = recipe.name.clone();
        let (r, d) = (recipe.clone(), digests.clone());
        trials.push(Trial::test(&name, move || holds(&r, &d)));
        let r = recipe.clone();
        let threads = format!("{name}: any number of threads");
        trials.push(Trial::test(threads, move || any_number_of_threads(&r)));
        let r = recipe.clone();
        let from = format!("{name}: from every step");
        trials.push(Trial::test(from, move || from_every_step(&r)));
        let needed = format!("{name}: every step is needed");
        trials.push(Trial::test(needed, move || every_step_is_needed(&recipe)));
    }
    Ok(libtest_mimic::run(&arguments, trials).exit_code())
}

/// A recipe in `scenes/`.
struct Scene {
    /// The file name without its extension.
    name: String,
    path: PathBuf,
    source: String,
}

/// A run that succeeded.
struct Run {
    outcome: Outcome,
    out: TempDir,
}

impl Scene {
    fn all() -> Result<Vec<Self>, Box<dyn Error>> {
        let mut found = Vec::new();
        for entry in std::fs::read_dir(folder())? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "ron") {
                let stem = path.file_stem().unwrap_or_default();
                let name = stem.to_string_lossy().into_owned();
                let source = std::fs::read_to_string(&path)?;
                found.push(Self { name, path, source });
            }
        }
        found.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(found)
    }

    /// Reads and checks `source` as if it were the text of the file. If the recipe is invalid, the error message
    /// contains all diagnostics.
    fn load(&self, source: &str, out: &Path) -> Result<Loaded, String> {
        let registry = ops_all::registry();
        let options = Options {
            out,
            budget: BUDGET,
            ..Options::default()
        };
        let text = Source::new(&self.path, source);
        let loaded = Engine::new(&registry).load(&text, &options);
        if loaded.has_errors() {
            return Err(loaded.render(&loaded.diagnostics, false));
        }
        Ok(loaded)
    }

    /// Reads, checks and runs `source`.
    fn run(&self, source: &str) -> Result<Run, String> {
        let out = tempfile::tempdir().map_err(|e| e.to_string())?;
        let loaded = self.load(source, out.path())?;
        let keeping = engine::Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run(keeping, &Silent);
        if outcome.succeeded() {
            Ok(Run { outcome, out })
        } else {
            Err(loaded.render(&outcome.failures, false))
        }
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

fn fail<T>(message: impl Into<String>) -> Result<T, Failed> {
    Err(Failed::from(message.into()))
}

// ---- The digests -------------------------------------------------------------------------------

type Digests = BTreeMap<String, String>;

/// Reads digests.txt, which has a line for each recipe: its name and its digest.
fn digests() -> Result<Digests, Box<dyn Error>> {
    if !Path::new(DIGESTS).exists() {
        return Ok(Digests::new());
    }
    let text = std::fs::read_to_string(DIGESTS)?;
    let pair = |line: &str| {
        line.split_once(' ')
            .map(|(n, d)| (n.to_owned(), d.to_owned()))
    };
    Ok(text.lines().filter_map(pair).collect())
}

/// Writes the digests of all recipes that succeed.
fn update(recipes: &[Scene]) -> std::io::Result<()> {
    let lines = recipes.iter().filter_map(|recipe| {
        let run = recipe.run(&recipe.source).ok()?;
        Some(format!("{} {}\n", recipe.name, run.outcome.digest))
    });
    std::fs::write(DIGESTS, lines.collect::<String>())
}

fn has_recipes(n: usize) -> Trial {
    Trial::test("scenes/ has recipes", move || {
        if n == 0 {
            return fail("no recipes found");
        }
        Ok(())
    })
}

fn digests_name_recipes(recipes: &[Scene], digests: &Digests) -> Trial {
    let is_known = |name: &String| recipes.iter().any(|recipe| recipe.name == *name);
    let unknown: Vec<String> = digests.keys().filter(|n| !is_known(n)).cloned().collect();
    Trial::test("digests.txt names only existing recipes", move || {
        if !unknown.is_empty() {
            return fail(format!(
                "digests.txt names missing recipes: {}",
                unknown.join(", ")
            ));
        }
        Ok(())
    })
}

// ---- The tests of a recipe ---------------------------------------------------------------

fn holds(recipe: &Scene, digests: &Digests) -> Result<(), Failed> {
    let outcome = recipe.run(&recipe.source)?.outcome;
    if outcome.checked == 0 {
        return fail("the recipe has no expectations");
    }
    let (name, found) = (&recipe.name, outcome.digest.to_string());
    match digests.get(name) {
        Some(expected) if *expected == found => Ok(()),
        Some(expected) => fail(format!(
            "the digest is {found}, expected {expected} as in digests.txt"
        )),
        None => fail(format!("digests.txt is missing the line `{name} {found}`")),
    }
}

fn any_number_of_threads(recipe: &Scene) -> Result<(), Failed> {
    let mut first = None;
    for n in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build()?;
        let run = pool.install(|| recipe.run(&recipe.source))?;
        let mut files = BTreeMap::new();
        for path in &run.outcome.written {
            let name = path.strip_prefix(run.out.path())?.to_owned();
            files.insert(name, std::fs::read(path)?);
        }
        let (digest, files_before) = first.get_or_insert((run.outcome.digest, files.clone()));
        if *digest != run.outcome.digest {
            let found = run.outcome.digest;
            return fail(format!("1 thread: digest {digest}, {n} threads: {found}"));
        }
        if files.keys().ne(files_before.keys()) {
            return fail(format!("{n} threads write different files than 1 thread"));
        }
        let differs = |name: &&PathBuf| files.get(*name) != files_before.get(*name);
        if let Some(name) = files.keys().find(differs) {
            let name = name.display();
            return fail(format!(
                "{n} threads write a different {name} than 1 thread"
            ));
        }
    }
    Ok(())
}

/// A listener that keeps the scene after each step.
#[derive(Default)]
struct SceneRecorder(Mutex<Vec<scene::Scene>>);

impl Progress for SceneRecorder {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

impl Listener for SceneRecorder {
    fn step_begins(&self, _: usize, _: &str) {}
    fn step_done(&self, _: usize, _: &StepDone) {}

    fn wants_scenes(&self) -> bool {
        true
    }

    fn scene_after(&self, _: usize, scene: &scene::Scene) {
        self.0.lock().expect("nobody panics").push(scene.clone());
    }
}

fn from_every_step(recipe: &Scene) -> Result<(), Failed> {
    let out = tempfile::tempdir()?;
    let mut loaded = recipe.load(&recipe.source, out.path())?;
    if loaded.forecast.peak_bytes() > MAX_BYTES_FROM_EVERY_STEP {
        return Ok(());
    }
    // A run that starts at a later step does not write the files of the earlier steps, so the test removes expectations
    // about files.
    let expectations = &mut loaded.recipe.expectations;
    expectations.retain(|placed| placed.that.output().is_none());
    let recorder = SceneRecorder::default();
    let whole = loaded.run(engine::Run::default(), &recorder).digest;
    let scenes = recorder.0.into_inner()?;
    for (i, scene) in (1..).zip(scenes) {
        let rest = loaded.run_from(i, scene, engine::Run::default(), &Silent);
        if !rest.succeeded() {
            return fail(loaded.render(&rest.failures, false));
        }
        if rest.digest != whole {
            let found = rest.digest;
            return fail(format!(
                "the run from step {} has the digest {found}, expected {whole}",
                i + 1
            ));
        }
    }
    Ok(())
}

fn every_step_is_needed(recipe: &Scene) -> Result<(), Failed> {
    let source = &recipe.source;
    let parsed = ron_tree::parse(source);
    let mut unnoticed = Vec::new();
    for step in list(&parsed.value, "steps") {
        let run = step
            .field("run")
            .filter(|_| step.name().is_none())
            .unwrap_or(step);
        let (operation, _) = run.name().unwrap_or_default();
        let is_refused = step.name().is_none() && step.field("refused").is_some();
        if OUTPUTS.contains(&operation) || is_refused {
            continue;
        }
        let id = step.field("id").filter(|_| step.name().is_none());
        let id = id.and_then(Value::as_str);
        // Expectations that name the id of a removed step always fail. Therefore the recipe is tested once with these
        // expectations and once without them.
        let naming = list(&parsed.value, "expect").iter().filter(|expectation| {
            let after = expectation
                .field("after")
                .filter(|_| expectation.name().is_none());
            id.is_some() && after.and_then(Value::as_str) == id
        });
        let naming: Vec<Span> = naming.map(|expectation| expectation.span).collect();
        for more in [&[], &naming[..]] {
            let mut spans = vec![step.span];
            spans.extend(more);
            let shortened = without(source, &spans);
            if ron_tree::parse(&shortened).diagnostics.len() > parsed.diagnostics.len() {
                return fail(format!("removing {operation} broke the text:\n{shortened}"));
            }
            if recipe.run(&shortened).is_ok() {
                let (line, _) = recipe::LineIndex::new(source).position(step.span.start);
                let with = if more.is_empty() {
                    ""
                } else {
                    " and the expectations that name it"
                };
                unnoticed.push(format!("line {line}: {}{with}", id.unwrap_or(operation)));
            }
        }
    }
    unnoticed.dedup();
    if unnoticed.is_empty() {
        return Ok(());
    }
    let steps = unnoticed.join("\n");
    fail(format!("the recipe succeeds without these steps:\n{steps}"))
}

/// Some steps are needed only by expectations that name the id of the step. Tests that such a step is reported as
/// unneeded.
fn unneeded_steps_are_found() -> Result<(), Failed> {
    let source = r#"(
        recipe: 1,
        steps: [
            Cube(name: "a"), // If the step is removed, its comma is removed too, but this comment stays.
            (id: "more", run: VertexNormals()),
            Octahedron(name: "b")
        ],
        expect: [Faces(eq: 14), (after: "more", that: Faces(eq: 6))],
    )"#;
    let recipe = Scene {
        name: "idle".to_owned(),
        path: folder().join("idle.ron"),
        source: source.to_owned(),
    };
    let Err(found) = every_step_is_needed(&recipe) else {
        return fail("no unneeded step is reported");
    };
    let message = found.message().unwrap_or_default();
    if message.ends_with(":\nline 5: more and the expectations that name it") {
        Ok(())
    } else {
        fail(format!("expected line 5 only, found: {message}"))
    }
}

/// Returns the items of a list of the recipe.
fn list<'v>(recipe: &'v Value, field: &str) -> &'v [Value] {
    recipe
        .field(field)
        .and_then(Value::items)
        .unwrap_or_default()
}

/// Removes list items and the commas after them from the text of a recipe. Comments are kept.
fn without(source: &str, items: &[Span]) -> String {
    let mut edits = Vec::new();
    for &item in items {
        edits.push((item, String::new()));
        let behind = Lexer::new(&source[item.end..]).find(|token| !token.kind.is_trivia());
        if let Some(comma) = behind.filter(|token| token.kind == TokenKind::Comma) {
            let Span { start, end } = comma.span;
            edits.push((Span::new(item.end + start, item.end + end), String::new()));
        }
    }
    ron_tree::replace(source, edits).expect("items of a list do not overlap")
}
