//! `meshwright select`: shows the elements that a selection matches.

use mesh::{EdgeId, FaceId, Mesh, VertexId};
use op::{ElementKind, Elements, Selected};
use ops_pictures::Picture;
use recipe::{Source, read_selection, resolve};
use scene::Object;
use serde_json::{Value as Json, json};

use crate::args::{Format, Kind, SelectArgs, WrongUsage};
use crate::commands::picture::{draw_scenes, write_images};
use crate::output::{group_digits, number, print, print_error, print_json};
use crate::scenes::load_scene;
use engine::{Engine, Stop};

pub(crate) fn run(args: &SelectArgs, engine: &Engine) -> anyhow::Result<bool> {
    let kind = args.of.map(|kind| match kind {
        Kind::Vertices => ElementKind::Vertices,
        Kind::Edges => ElementKind::Edges,
        Kind::Faces => ElementKind::Faces,
    });
    let elements = read_selection(&args.selection, kind).map_err(|wrong| {
        let source = Source::new("selection", args.selection.as_str());
        print_error(&recipe::render(&[source], &wrong, false));
        WrongUsage("invalid selection".to_owned())
    })?;
    let stop = Stop {
        after: args.after.as_deref(),
        before: args.before.as_deref(),
    };
    let found = load_scene(&args.file, &args.read.options(), &args.values, stop, engine)?;
    let meshes = meshes(args, found.scene.objects())?;
    let mut selected = Vec::new();
    for (object, mesh) in meshes {
        let chosen = resolve(&elements, &found.scene, object, mesh, &found.stream)
            .map_err(|error| anyhow::anyhow!("{}: {error}", object.name))?;
        selected.push((object, mesh, chosen));
    }
    match (args.format, args.count) {
        (Format::Json, _) => print_json(&json(args, &elements, &selected))?,
        (Format::Human, true) => {
            let count: usize = selected.iter().map(|(_, _, chosen)| chosen.len()).sum();
            print(&format!("{count}\n"))?;
        }
        (Format::Human, false) => {
            for (object, mesh, chosen) in &selected {
                let word = elements.kind().word();
                print(&elements_text(args, object, mesh, chosen, word))?;
            }
        }
    }
    drop(selected);
    if let Some(path) = &args.picture {
        let mut picture = Picture::new(path.display().to_string());
        picture.highlight = Some(elements);
        let images = draw_scenes(&picture, &args.file, &[(found, "")], &args.on)?;
        write_images(&picture, &images, path)?;
    }
    Ok(true)
}

/// Returns the meshes whose elements can be selected: the meshes that `--on` names or, without this option, all meshes.
fn meshes<'s>(
    args: &SelectArgs,
    objects: &'s [Object],
) -> anyhow::Result<Vec<(&'s Object, &'s Mesh)>> {
    let mesh = |o: &'s Object| o.as_mesh().map(|mesh| (o, mesh.as_ref()));
    if args.on.is_empty() {
        let meshes: Vec<_> = objects.iter().filter_map(mesh).collect();
        anyhow::ensure!(
            !meshes.is_empty(),
            "{} contains no mesh",
            args.file.display()
        );
        return Ok(meshes);
    }
    let named = |name: &String| {
        let Some(object) = objects.iter().find(|o| o.name == *name) else {
            let known = objects.iter().map(|o| o.name.as_str());
            let help = recipe::did_you_mean(name, known);
            return Err(WrongUsage(format!("unknown object \"{name}\": {help}")).into());
        };
        let kind = object.geometry.kind();
        mesh(object).ok_or_else(|| anyhow::anyhow!("\"{name}\" is {kind}, expected a mesh"))
    };
    args.on.iter().map(named).collect()
}

/// Returns the number of all vertices, edges or faces of the mesh, depending on the kind of the selected elements.
fn total(mesh: &Mesh, chosen: &Selected) -> usize {
    match chosen {
        Selected::Vertices(_) => mesh.n_vertices(),
        Selected::Edges(_) => mesh.n_edges(),
        Selected::Faces(_) => mesh.n_faces(),
    }
}

fn elements_text(
    args: &SelectArgs,
    object: &Object,
    mesh: &Mesh,
    chosen: &Selected,
    word: &str,
) -> String {
    let count = |n: usize| group_digits(n as u64);
    let (n, all, name) = (chosen.len(), total(mesh, chosen), &object.name);
    let mut text = format!("{name}: {} of {} {word}\n", count(n), count(all));
    let shown = if args.all { n } else { n.min(args.first) };
    for i in 0..shown {
        text += &match chosen {
            Selected::Vertices(list) => {
                let [x, y, z] = mesh.position(list[i]).to_array().map(number);
                format!("  {}  ({x}, {y}, {z})\n", list[i].index())
            }
            Selected::Edges(list) => {
                let [v, w] = ends(mesh, list[i]);
                format!("  Between({v}, {w})\n")
            }
            Selected::Faces(list) => {
                let vertices = corners(mesh, list[i]).map(|v| v.to_string());
                let vertices: Vec<String> = vertices.collect();
                format!("  {}  of {}\n", list[i].index(), vertices.join(" "))
            }
        };
    }
    if shown < n {
        text += &format!("  and {} more: --all shows them\n", count(n - shown));
    }
    text
}

/// Returns the two vertices of an edge, in the order in which the command prints them as `Between(..)`.
fn ends(mesh: &Mesh, e: EdgeId) -> [usize; 2] {
    mesh.edge_vertices(e).map(VertexId::index)
}

/// Returns the vertices of a face.
fn corners(mesh: &Mesh, f: FaceId) -> impl Iterator<Item = usize> {
    mesh.face_vertices(f).map(VertexId::index)
}

/// Returns the selected elements as JSON. All selected elements are listed, even if `--first` is given. With `--count`,
/// returns only how many vertices, edges or faces are selected.
fn json(args: &SelectArgs, elements: &Elements, selected: &[(&Object, &Mesh, Selected)]) -> Json {
    let objects = selected.iter().map(|(object, mesh, chosen)| {
        let mut json = json!({
            "name": object.name, "count": chosen.len(), "total": total(mesh, chosen),
        });
        if !args.count {
            json["elements"] = listed(mesh, chosen);
        }
        json
    });
    json!({
        "file": args.file.display().to_string(),
        "of": elements.kind().word(),
        "count": selected.iter().map(|(_, _, chosen)| chosen.len()).sum::<usize>(),
        "objects": objects.collect::<Json>(),
    })
}

fn listed(mesh: &Mesh, chosen: &Selected) -> Json {
    let vertex =
        |&v: &VertexId| json!({ "vertex": v.index(), "position": mesh.position(v).to_array() });
    let edge = |&e: &EdgeId| json!({ "vertices": ends(mesh, e) });
    let face =
        |&f: &FaceId| json!({ "face": f.index(), "vertices": corners(mesh, f).collect::<Json>() });
    match chosen {
        Selected::Vertices(list) => list.iter().map(vertex).collect(),
        Selected::Edges(list) => list.iter().map(edge).collect(),
        Selected::Faces(list) => list.iter().map(face).collect(),
    }
}
