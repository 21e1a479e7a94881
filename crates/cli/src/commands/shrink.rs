//! `meshwright shrink`: makes the scene smaller on which a recipe fails.

use engine::{Engine, Run};
use op::OpError;
use recipe::shrink::{failure, is_alike, shrink};
use scene::Scene;

use crate::args::ShrinkArgs;
use crate::capsule;
use crate::commands::run::refuse;
use crate::listener::{QUIET, Terminal, catch_interrupts};
use crate::loading::load_recipe;
use crate::output::{complain, print};

pub(crate) fn run(args: &ShrinkArgs, engine: &Engine) -> anyhow::Result<bool> {
    let (path, out) = (&args.recipe, &args.out);
    let mut loaded = load_recipe(path, &args.values, out, args.budget, engine)?;
    if loaded.has_errors() {
        return refuse(&loaded, false);
    }
    catch_interrupts();
    let outcome = loaded.run(Run::default(), &QUIET);
    anyhow::ensure!(!outcome.cancelled, "interrupted, nothing was written");
    let number = outcome.steps.len();
    if number == loaded.recipe.steps.len() {
        complain(&format!("error: no step of {} fails\n", loaded.path));
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
            "the step {} fails no more when it is tried again",
            step.label()
        ),
        Err(OpError::Cancelled) => anyhow::bail!("interrupted, nothing was written"),
        Err(error) => return Err(error.into()),
    };
    capsule::write(&loaded, number, &message, &small, out)?;
    let faces = |scene: &Scene| -> usize {
        let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
        meshes.map(|mesh| mesh.n_faces()).sum()
    };
    print(&format!(
        "{}: {message}\n{} faces of {} are enough; see it with: meshwright run {}\n",
        step.label(),
        faces(&small),
        faces(&scene),
        out.join("recipe.ron").display()
    ))?;
    Ok(true)
}
