//! `meshwright shrink`: reduces the scene before a failing step of a recipe to a smaller scene on which the step still
//! fails.

use engine::{Engine, Run};
use op::OpError;
use recipe::shrink::{failure, is_alike, shrink};
use scene::Scene;

use crate::args::ShrinkArgs;
use crate::capsule;
use crate::commands::run::report_errors;
use crate::listener::{INTERRUPT, Terminal, catch_interrupts};
use crate::loading::{Checking, load_recipe};
use crate::output::{print, print_error};

pub(crate) fn run(args: &ShrinkArgs, engine: &Engine) -> anyhow::Result<bool> {
    let (path, out) = (&args.recipe, &args.out);
    let checking = Checking::for_budget(args.budget);
    let mut loaded = load_recipe(path, &args.values, out, checking, engine)?;
    if loaded.has_errors() {
        return report_errors(&loaded, false);
    }
    catch_interrupts();
    let outcome = loaded.run(Run::default(), &INTERRUPT);
    anyhow::ensure!(!outcome.cancelled, "interrupted, no files were written");
    let number = outcome.steps.len();
    if number == loaded.recipe.steps.len() {
        print_error(&format!("error: no step of {} fails\n", loaded.path));
        return Ok(false);
    }
    let scene = capsule::scene_before(&mut loaded, number)?;

    let step = &loaded.recipe.steps[number];
    let files = &loaded.recipe.files(&loaded.files)[step.scope];
    let terminal = Terminal::new();
    let fails = |scene: &Scene| failure(step, scene, files, args.budget, &terminal);
    let shrunk = fails(&scene).and_then(|first| {
        let Some(first) = first else {
            return Ok(None);
        };
        let same = |scene: &Scene| Ok(fails(scene)?.is_some_and(|other| is_alike(&first, &other)));
        let small = shrink(&scene, args.tries, same)?;
        let message = fails(&small)?.unwrap_or_default();
        Ok(Some((small, message)))
    });
    terminal.clear();
    let (small, message) = match shrunk {
        Ok(Some(shrunk)) => shrunk,
        Ok(None) => anyhow::bail!(
            "the step {} did not fail when it was run again",
            step.label()
        ),
        Err(OpError::Cancelled) => anyhow::bail!("interrupted, no files were written"),
        Err(error) => return Err(error.into()),
    };
    capsule::write(&loaded, number, &message, &small, out)?;
    let faces = |scene: &Scene| -> usize {
        let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
        meshes.map(|mesh| mesh.n_faces()).sum()
    };
    print(&format!(
        "{}: {message}\nreduced from {} to {} faces; to reproduce the failure: meshwright run {}\n",
        step.label(),
        faces(&scene),
        faces(&small),
        out.join("recipe.ron").display()
    ))?;
    Ok(true)
}
