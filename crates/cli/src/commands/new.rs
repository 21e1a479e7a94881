//! `meshwright new`: writes a small commented recipe to start from.

use std::fs::File;
use std::io::{ErrorKind, Write};

use anyhow::{Context as _, bail, ensure};

use crate::args::NewArgs;
use crate::output::print;

const RECIPE: &str = include_str!("new/recipe.ron.txt");

/// Writes a new recipe, which creates a cube or loads a given model.
pub(crate) fn run(args: &NewArgs) -> anyhow::Result<bool> {
    let given = &args.name;
    let path = given.with_extension("ron");
    let texts = (given.file_name().and_then(|name| name.to_str()))
        .zip(path.file_stem().and_then(|name| name.to_str()));
    let (file, name) = texts.context("the name of the recipe must be valid Unicode")?;
    let load = format!("Load(path: {file:?})");
    let first_step = match given.extension().and_then(|ending| ending.to_str()) {
        None | Some("ron") => format!("Cube(name: {name:?}, size: 2, triangles: true)"),
        Some("bzc") => bail!(
            "`new` cannot write recipes for curves (.bzc): `meshwright ops CurveFigure` shows an example step"
        ),
        Some("bez") => format!("{load},\n        Tessellate(segments: 8)"),
        Some(_) => load,
    };
    ensure!(
        first_step.starts_with("Cube") || given.is_file(),
        "the file {} does not exist",
        given.display()
    );
    let text = RECIPE.replace("{first_step}", &first_step);
    let shown = path.display();
    match File::create_new(&path) {
        Ok(mut file) => file.write_all(text.replace("{name}", name).as_bytes())?,
        Err(error) if error.kind() == ErrorKind::AlreadyExists => bail!("{shown} already exists"),
        Err(error) => return Err(error).with_context(|| format!("cannot write {shown}")),
    }
    print(&format!("wrote {shown}\nnext: meshwright run {shown}\n"))?;
    Ok(true)
}
