//! `meshwright picture`: draws files or the results of recipes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context as _;
use mesh::Domain;
use op::{Context, Elements, FaceSelection, Files, TagName};
use ops_pictures::Picture;
use recipe::{Source, with_case_of};
use render::{Image, Shading, Side};
use ron_tree::string_literal;
use scene::{Geometry, Object, Scene};
use view::sheet::{Cell, SheetStyle, sheet};
use view::{Quantity, changed_faces};

use crate::args::{DrawArgs, PictureArgs, ReportedUsage, WrongUsage};
use crate::commands::batch::inputs;
use crate::listener::{INTERRUPT, Terminal, catch_interrupts};
use crate::output::{STAMP, print, print_error, write_atomically};
use crate::scenes::{SceneAtStep, load_scene};
use engine::{BUDGET, Engine, Stop};

pub(crate) fn run(args: &PictureArgs, engine: &Engine) -> anyhow::Result<bool> {
    let inputs = inputs::list(&args.files)?.into_iter();
    let files: Vec<PathBuf> = inputs.map(|input| PathBuf::from(input.path)).collect();
    if files.len() > 1 && !args.sheet {
        let message = format!(
            "expected one file, found {}: use --sheet to draw several files on one sheet",
            files.len()
        );
        return Err(WrongUsage(message).into());
    }
    let default_size = if args.sheet { SHEET_CELL } else { [1280, 960] };
    let mut more: Vec<String> = Vec::new();
    more.extend(args.turntable.then(|| "turntable: ()".to_owned()));
    if !args.sheet {
        more.extend(args.columns.map(|n| format!("columns: {n}")));
    }
    let picture = parameters(
        &args.draw,
        &output_path(args, &files[0]),
        default_size,
        more,
    )?;
    catch_interrupts();
    if args.sheet {
        return on_sheet(args, &picture, &files, engine);
    }
    let images = draw(args, &picture, &files[0], engine)?;
    write_images(&picture, &images, &output_path(args, &files[0]))?;
    Ok(true)
}

/// Writes the images of a picture to a file.
pub(crate) fn write_images(picture: &Picture, images: &[Image], path: &Path) -> anyhow::Result<()> {
    let bytes = picture.encode(images, Some(STAMP), &INTERRUPT)?;
    write(path, &bytes, &images[0])
}

/// Returns the path of the image to write.
fn output_path(args: &PictureArgs, first: &Path) -> PathBuf {
    args.out.clone().unwrap_or_else(|| {
        let ending = if args.turntable { "gif" } else { "png" };
        let name = if args.sheet {
            "sheet".as_ref()
        } else {
            store::stem(first)
        };
        PathBuf::from(format!("{}.{ending}", name.display()))
    })
}

/// Default size of the images on a sheet, in pixels.
pub(crate) const SHEET_CELL: [u32; 2] = [320, 240];

/// Parses the options of the command as a `Picture` step of a recipe, with the same checks and suggestions as in a
/// recipe. `default_size` is in pixels. `more` contains further fields of the `Picture` step.
pub(crate) fn parameters(
    args: &DrawArgs,
    out: &Path,
    default_size: [u32; 2],
    more: Vec<String>,
) -> anyhow::Result<Picture> {
    let text = format!("Picture({})", fields(args, out, default_size, more));
    let mut picture: Picture = recipe::read_step(&text).map_err(|wrong| {
        let source = Source::new("options of picture", text.as_str());
        print_error(&recipe::render(&[source], &wrong, false));
        ReportedUsage
    })?;
    let quantity = picture.color_by.as_mut().map(|by| &mut by.of);
    if let Some(Quantity::DistanceTo(path)) = quantity {
        *path = absolute_path(path)?;
    }
    if let Some(folder) = &mut picture.images {
        *folder = absolute_path(folder)?;
    }
    Ok(picture)
}

/// Makes a path absolute. Paths on the command line are relative to the working directory, but paths in a step are
/// relative to the folder of the recipe.
fn absolute_path(path: &str) -> anyhow::Result<String> {
    let full = std::path::absolute(path)
        .with_context(|| format!("cannot make the path {path} absolute"))?;
    let full = full.into_os_string().into_string();
    full.map_err(|path| {
        WrongUsage(format!("the path {} is not valid Unicode", path.display())).into()
    })
}

/// Formats the options of the command as the fields of a `Picture` step.
fn fields(args: &DrawArgs, out: &Path, default_size: [u32; 2], further: Vec<String>) -> String {
    let path = out.file_name().unwrap_or_default().to_string_lossy();
    let mut fields = vec![format!("path: {}", string_literal(&path))];
    let [width, height] = args.size.unwrap_or(default_size);
    fields.push(format!("size: ({width}, {height})"));
    let field_if = |is_given: bool, field: &str| is_given.then(|| field.to_owned());
    let up = if args.z_up { "up: Z" } else { "up: Auto" };
    let projection = field_if(args.orthographic, "projection: Orthographic");
    let more = projection.into_iter().chain([up.to_owned()]);
    let has_own_camera = args.with.as_deref().is_some_and(has_camera);
    let camera = |from: Option<&String>| {
        let from = from.map(|from| format!("from: {}", with_case_of::<Side>(from)));
        let fields: Vec<String> = from.into_iter().chain(more.clone()).collect();
        format!("Fit({})", fields.join(", "))
    };
    match &args.from[..] {
        [] if has_own_camera && !args.orthographic && !args.z_up => {}
        [] | [_] => fields.push(format!("camera: {}", camera(args.from.first()))),
        sides => {
            let cameras: Vec<String> = sides.iter().map(|from| camera(Some(from))).collect();
            fields.push(format!("views: [{}]", cameras.join(", ")));
        }
    }
    let mut style = Vec::new();
    style.extend(
        args.shading
            .iter()
            .map(|s| format!("shading: {}", with_case_of::<Shading>(s))),
    );
    style.extend(field_if(args.wireframe, "wireframe: ()"));
    style.extend(field_if(args.control_nets, "control_nets: ()"));
    style.extend(field_if(args.transparent, "background: Transparent"));
    if !style.is_empty() {
        fields.push(format!("style: ({})", style.join(", ")));
    }
    fields.extend(args.highlight.iter().map(|s| format!("highlight: {s}")));
    fields.extend(
        args.color_by
            .iter()
            .map(|s| format!("color_by: (of: {})", with_case_of::<Quantity>(s))),
    );
    let images = args.images.iter();
    fields.extend(images.map(|folder| format!("images: {}", string_literal(folder))));
    fields.extend(further);
    fields.extend(args.with.clone());
    fields.join(", ")
}

/// Whether the parameters in `with` set the camera or the list of cameras.
fn has_camera(with: &str) -> bool {
    let with = ron_tree::parse(&format!("({with})")).value;
    with.field("camera").is_some() || with.field("views").is_some()
}

/// Draws one file.
fn draw(
    args: &PictureArgs,
    picture: &Picture,
    path: &Path,
    engine: &Engine,
) -> anyhow::Result<Vec<Image>> {
    let scene = |stop| -> anyhow::Result<SceneAtStep> {
        load_scene(path, &args.read.options(), &args.values, stop, engine)
    };
    let stop = |after, before| Stop { after, before };
    let (change, before) = (args.change.as_deref(), args.before.as_deref());
    let mut scenes_at_steps = match change {
        None => vec![(scene(stop(args.after.as_deref(), before))?, "")],
        Some(_) => vec![
            (scene(stop(None, change))?, "before"),
            (scene(stop(change, None))?, "after"),
        ],
    };
    let scenes: Vec<&Scene> = scenes_at_steps.iter().map(|(at, _)| &at.scene).collect();
    check_names(&args.draw.on, &scenes)?;
    let mut picture = picture.clone();
    if let [(before, _), (after, _)] = &mut scenes_at_steps[..]
        && picture.highlight.is_none()
    {
        picture.highlight = highlight_changes(&mut before.scene, &mut after.scene);
    }
    draw_scenes(&picture, path, &scenes_at_steps, &args.draw.on)
}

/// Tags the faces in which two scenes differ, and returns a selection of these faces. Returns `None` if no faces
/// differ, or if more than half of the faces differ, as after a subdivision.
fn highlight_changes(before: &mut Scene, after: &mut Scene) -> Option<Elements> {
    const TAG: &str = "changed by the step";
    let tag = TagName::try_from(TAG.to_owned()).ok()?;
    let tagged = |scene: &Scene, other: &Scene| -> Vec<(String, Vec<bool>)> {
        (scene.objects().iter())
            .filter_map(|object| {
                let other = other.object(&object.name).and_then(Object::as_mesh);
                let changed = changed_faces(object.as_mesh()?, other.map(AsRef::as_ref));
                Some((object.name.clone(), changed))
            })
            .collect()
    };
    let all = [tagged(before, after), tagged(after, before)];
    let (mut n_changed, mut n_faces) = (0, 0);
    for (_, changed) in all.iter().flatten() {
        n_changed += changed.iter().filter(|&&changed| changed).count();
        n_faces += changed.len();
    }
    if n_changed == 0 || 2 * n_changed > n_faces {
        return None;
    }
    for (scene, objects) in [before, after].into_iter().zip(all) {
        for (name, changed) in objects {
            if let Some((Geometry::Mesh(mesh), _)) = scene.parts_mut(&name) {
                tag.write(Arc::make_mut(mesh), Domain::Face, changed);
            }
        }
    }
    Some(Elements::Faces(FaceSelection::Tagged(TAG.to_owned())))
}

/// Checks that each name is the name of an object in one of the scenes.
pub(crate) fn check_names(on: &[String], scenes: &[&Scene]) -> anyhow::Result<()> {
    for name in on {
        let objects = scenes.iter().flat_map(|scene| scene.objects());
        let known: Vec<&str> = objects.map(|o| o.name.as_str()).collect();
        if !known.contains(&name.as_str()) {
            let help = recipe::did_you_mean(name, known);
            return Err(WrongUsage(format!("unknown object \"{name}\": {help}")).into());
        }
    }
    Ok(())
}

/// Draws one or more scenes of the same file, each with a caption. Draws only the objects named in `on`, or all objects
/// if `on` is empty.
pub(crate) fn draw_scenes(
    picture: &Picture,
    path: &Path,
    scenes: &[(SceneAtStep, &str)],
    on: &[String],
) -> anyhow::Result<Vec<Image>> {
    // Relative paths in the fields of `picture` are resolved in the folder of the drawn file or recipe.
    let files = Files {
        input: path.parent().map(Path::to_path_buf).unwrap_or_default(),
        ..Files::default()
    };
    let terminal = Terminal::new();
    let mut cx = Context::new(&terminal, &files);
    cx.budget = BUDGET;
    cx.stream = scenes.first().map_or("", |(at, _)| &at.stream);
    cx.on = (!on.is_empty()).then_some(on);
    let scenes: Vec<_> = (scenes.iter())
        .map(|(at, caption)| (&at.scene, *caption))
        .collect();
    let drawn = picture.draw(&scenes, None, &mut cx);
    terminal.clear();
    let (images, notes) = drawn.with_context(|| format!("cannot draw {}", path.display()))?;
    for note in notes {
        print_error(&format!("note: {}: {note}\n", path.display()));
    }
    Ok(images)
}

/// Draws several files on one sheet. The place of a file that cannot be drawn stays empty.
fn on_sheet(
    args: &PictureArgs,
    picture: &Picture,
    files: &[PathBuf],
    engine: &Engine,
) -> anyhow::Result<bool> {
    if picture.turntable.is_some() {
        return Err(WrongUsage("a sheet cannot have a turntable".to_owned()).into());
    }
    let (mut drawn, mut all_drawn) = (Vec::new(), true);
    for path in files {
        let image = match draw(args, picture, path, engine) {
            Ok(mut images) => images.remove(0),
            Err(error) if error.is::<WrongUsage>() || is_cancelled(&error) => return Err(error),
            Err(error) => {
                print_error(&format!("error: {error:#}\n"));
                all_drawn = false;
                let [width, height] = picture.size.map(op::Count::get);
                Image::filled(width, height, [0; 4])?
            }
        };
        drawn.push((image, path.display().to_string()));
    }
    let cells: Vec<Cell> = (drawn.iter())
        .map(|(image, caption)| Cell { image, caption })
        .collect();
    let style = SheetStyle {
        columns: args.columns.map_or(4, |n| n as usize),
        background: picture.style.background.srgb(),
        ..SheetStyle::default()
    };
    let style = style.scaled_to(picture.size.map(op::Count::get));
    let image = sheet(&cells, &style, BUDGET)?;
    write_png(&image, &output_path(args, &files[0]), true)?;
    Ok(all_drawn)
}

fn is_cancelled(error: &anyhow::Error) -> bool {
    matches!(error.downcast_ref(), Some(op::OpError::Cancelled))
}

/// Writes one image as PNG. If `say` is true, prints the path and the size of the image.
pub(crate) fn write_png(image: &Image, path: &Path, say: bool) -> anyhow::Result<()> {
    let bytes = image.to_png_with_progress(&[("Software", STAMP)], &INTERRUPT)?;
    if say {
        write(path, &bytes, image)
    } else {
        write_atomically(path, &bytes)
    }
}

fn write(path: &Path, bytes: &[u8], image: &Image) -> anyhow::Result<()> {
    write_atomically(path, bytes)?;
    let (path, width, height) = (path.display(), image.width, image.height);
    let printed = print(&format!("wrote {path}, {width} x {height} pixels\n"));
    Ok(printed?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_recognized_as_a_parameter() {
        assert!(has_camera("camera: Fit(up: Z)"));
        assert!(has_camera("size: (4, 4), views: []"));
        assert!(has_camera("/* left */ camera : Fit()"));
        assert!(!has_camera("path: \"camera: a.png\""));
        assert!(!has_camera("style: (camera: 1)"));
        assert!(!has_camera("background: White // views: none"));
    }
}
