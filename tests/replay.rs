//! Every recipe in `scenes/` is a test.
//!
//! ```text
//! teapot                          all expectations hold, the digest is that in digests.txt
//! teapot: any number of threads   1, 2 and 8 threads: the same digest and the same files
//! teapot: from every step         a run that begins at a step with the scene before it: the same digest
//! teapot: every step counts       without one step the recipe fails
//! ```
//!
//! With `MESHWRIGHT_UPDATE` set in the environment, digests.txt is written anew first.

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

/// The bytes that meshes may take.
const BUDGET: u64 = 4 << 30;

/// Recipes whose meshes take more bytes are not run from every step.
const SMALL: u64 = 16 << 20;

/// The operations that only write: nothing in a recipe can miss them.
const OUTPUTS: [&str; 3] = ["CurveFigure", "Picture", "Save"];

const DIGESTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/digests.txt");

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments = Arguments::from_args();
    let recipes = Scene::all()?;
    if std::env::var_os("MESHWRIGHT_UPDATE").is_some() {
        update(&recipes)?;
    }
    let digests = Arc::new(digests()?);
    let mut trials = vec![there_are_recipes(recipes.len())];
    trials.push(digests_name_recipes(&recipes, &digests));
    trials.push(Trial::test(
        "a step that nothing misses is found",
        idle_step,
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
        let counts = format!("{name}: every step counts");
        trials.push(Trial::test(counts, move || every_step_counts(&recipe)));
    }
    Ok(libtest_mimic::run(&arguments, trials).exit_code())
}

/// A recipe in `scenes/`.
struct Scene {
    /// The name of the file without its ending.
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

    /// Reads and checks `source` as if it stood in the file. Fails with everything that is wrong.
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

    /// The same, and runs it.
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

/// The lines of digests.txt: the name of a recipe and its digest.
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

fn there_are_recipes(n: usize) -> Trial {
    Trial::test("there are recipes in scenes/", move || {
        if n == 0 {
            return fail("no recipes found");
        }
        Ok(())
    })
}

fn digests_name_recipes(recipes: &[Scene], digests: &Digests) -> Trial {
    let is_known = |name: &String| recipes.iter().any(|recipe| recipe.name == *name);
    let unknown: Vec<String> = digests.keys().filter(|n| !is_known(n)).cloned().collect();
    Trial::test("digests.txt names recipes only", move || {
        if !unknown.is_empty() {
            return fail(format!("there are no such recipes: {}", unknown.join(", ")));
        }
        Ok(())
    })
}

// ---- The tests of a recipe ---------------------------------------------------------------

fn holds(recipe: &Scene, digests: &Digests) -> Result<(), Failed> {
    let outcome = recipe.run(&recipe.source)?.outcome;
    if outcome.checked == 0 {
        return fail("the recipe expects nothing");
    }
    let (name, found) = (&recipe.name, outcome.digest.to_string());
    match digests.get(name) {
        Some(expected) if *expected == found => Ok(()),
        Some(expected) => fail(format!("the digest is {found}, in digests.txt {expected}")),
        None => fail(format!("digests.txt has no line `{name} {found}`")),
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
            return fail(format!("{n} threads write other files than 1"));
        }
        let differs = |name: &&PathBuf| files.get(*name) != files_before.get(*name);
        if let Some(name) = files.keys().find(differs) {
            let name = name.display();
            return fail(format!("{n} threads write another {name} than 1"));
        }
    }
    Ok(())
}

/// Keeps the scene after each step.
#[derive(Default)]
struct Kept(Mutex<Vec<scene::Scene>>);

impl Progress for Kept {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

impl Listener for Kept {
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
    if loaded.forecast.peak_bytes() > SMALL {
        return Ok(());
    }
    // What earlier steps write is not there.
    let expectations = &mut loaded.recipe.expectations;
    expectations.retain(|placed| placed.that.output().is_none());
    let kept = Kept::default();
    let whole = loaded.run(engine::Run::default(), &kept).digest;
    let kept = kept.0.into_inner()?;
    for (i, scene) in (1..).zip(kept) {
        let rest = loaded.run_from(i, scene, engine::Run::default(), &Silent);
        if !rest.succeeded() {
            return fail(loaded.render(&rest.failures, false));
        }
        if rest.digest != whole {
            let found = rest.digest;
            return fail(format!(
                "from step {}: digest {found}, whole: {whole}",
                i + 1
            ));
        }
    }
    Ok(())
}

fn every_step_counts(recipe: &Scene) -> Result<(), Failed> {
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
        // Without the step, its id is unknown: what names it would fail in any case, so it goes as well.
        let naming = list(&parsed.value, "expect").iter().filter(|expectation| {
            let after = expectation
                .field("after")
                .filter(|_| expectation.name().is_none());
            id.is_some() && after.and_then(Value::as_str) == id
        });
        let gone: Vec<Span> = naming.map(|expectation| expectation.span).collect();
        for more in [&[], &gone[..]] {
            let mut spans = vec![step.span];
            spans.extend(more);
            let shortened = without(source, &spans);
            if ron_tree::parse(&shortened).diagnostics.len() > parsed.diagnostics.len() {
                return fail(format!(
                    "taking {operation} out broke the text:\n{shortened}"
                ));
            }
            if recipe.run(&shortened).is_ok() {
                let (line, _) = recipe::LineIndex::new(source).position(step.span.start);
                let with = if more.is_empty() {
                    ""
                } else {
                    " and what names it"
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
    fail(format!(
        "no expectation misses these steps when they are taken out:\n{steps}"
    ))
}

/// Of three steps the second changes nothing that is expected.
fn idle_step() -> Result<(), Failed> {
    let source = r#"(
        recipe: 1,
        steps: [
            Cube(name: "a"), // stays, and its comma goes
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
    let Err(found) = every_step_counts(&recipe) else {
        return fail("every step is said to count");
    };
    let message = found.message().unwrap_or_default();
    if message.ends_with(":\nline 5: more and what names it") {
        Ok(())
    } else {
        fail(format!("expected line 5 alone, found: {message}"))
    }
}

/// The items of a list of the recipe.
fn list<'v>(recipe: &'v Value, field: &str) -> &'v [Value] {
    recipe
        .field(field)
        .and_then(Value::items)
        .unwrap_or_default()
}

/// The text without these items of lists and the commas behind them. Comments stay.
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
    ron_tree::replace(source, edits).expect("items of a list lie apart")
}
