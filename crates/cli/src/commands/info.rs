//! `meshwright info`: shows what a file contains.

use std::path::Path;

use engine::BUDGET;
use mesh::{DVec3, Domain, Elements, Mesh, VertexId, counted, is_rig_name};
use mesh_io::{Note, NoteKind};
use op::ErrorLocation;
use ops_pictures::Picture;
use scene::{Animation, Geometry, Graph, Instance, Object, Scene};
use serde_json::json;

use crate::args::{Format, InfoArgs};
use crate::commands::picture::draw_scenes;
use crate::output::{group_digits, number, point, print, print_json};
use crate::pipes;
use crate::scenes::{SceneAtStep, read_file_or_input};
use crate::terminal_picture;

pub(crate) fn run(args: &InfoArgs) -> anyhow::Result<bool> {
    let path = &pipes::mesh_name(&args.file, args.from.as_deref(), "stdin", "--from")?;
    let (scene, notes) = read_file_or_input(&args.file, path, &args.read.options())?;
    let pictures = args.picture_errors.of(path, BUDGET);
    // The locations in the reader's notes use the coordinates of the objects. Therefore, the objects are drawn without
    // the transforms of the scene's nodes.
    let mut unplaced = Scene::new();
    unplaced.append(scene.objects().to_vec(), Graph::default())?;
    for note in &notes {
        let places = places(note);
        if !places.is_empty() {
            pictures.draw(&unplaced, &places, &note.to_string());
        }
    }
    if args.format == Format::Json {
        pictures.warn();
        let objects: Vec<_> = each_object(&scene, object_json);
        let notes: Vec<_> = notes.iter().map(note_json).collect();
        let mut json = json!({
            "file": path.display().to_string(), "objects": objects, "notes": notes,
            "pictures": pictures.paths(),
        });
        for (what, n) in graph_counts(scene.graph()) {
            json[what] = n.into();
        }
        let animations = scene.graph().animations.iter().map(|animation| {
            let (n, seconds) = (animation.channels.len(), duration(scene.graph(), animation));
            json!({ "name": animation.name, "channels": n, "seconds": seconds })
        });
        json["animation_list"] = animations.collect();
        print_json(&json)?;
        return Ok(true);
    }
    for (object, facts) in each_object(&scene, |object, placed| (object, facts(object, placed))) {
        print(&format!("{}: {}\n", object.name, object.geometry.kind()))?;
        for (what, value) in facts {
            print(&format!("  {what:<18} {value}\n"))?;
        }
    }
    for (what, n) in graph_counts(scene.graph()).filter(|(_, n)| *n > 0) {
        print(&format!("{what}: {}\n", group_digits(n as u64)))?;
    }
    for animation in &scene.graph().animations {
        let name = animation.name.as_deref().unwrap_or("without a name");
        let channels = counted(animation.channels.len(), "channel");
        let seconds = number(duration(scene.graph(), animation));
        print(&format!(
            "animation {name}: {channels}, duration {seconds} s\n"
        ))?;
    }
    for note in &notes {
        print(&format!("note: {note}\n"))?;
    }
    pictures.print_list();
    if args.picture {
        show(path, scene)?;
    }
    Ok(true)
}

/// Measures of all instances of a mesh together, in scene space: the area, the volume and the bounds.
struct Placed {
    n: usize,
    area: f64,
    volume: f64,
    bounds: Option<[DVec3; 2]>,
}

impl Placed {
    fn of(instances: &[Instance]) -> Self {
        let mut placed = Self {
            n: instances.len(),
            area: 0.0,
            volume: 0.0,
            bounds: None,
        };
        for instance in instances {
            let object = instance.placed();
            let Some(mesh) = object.as_mesh() else {
                continue;
            };
            placed.area += geometry::area(mesh);
            placed.volume += geometry::volume(mesh);
            if let Some([low, high]) = geometry::bounds(mesh) {
                let [min, max] = placed.bounds.unwrap_or([low, high]);
                placed.bounds = Some([min.min(low), max.max(high)]);
            }
        }
        placed
    }
}

/// Describes each object of a scene.
fn each_object<'s, T>(scene: &'s Scene, describe: impl Fn(&'s Object, &Placed) -> T) -> Vec<T> {
    let instances = scene.instances();
    let objects = instances.chunk_by(|a, b| a.object.name == b.object.name);
    objects
        .map(|instances| describe(instances[0].object, &Placed::of(instances)))
        .collect()
}

fn graph_counts(graph: &Graph) -> impl Iterator<Item = (&'static str, usize)> {
    let counts = [
        ("nodes", graph.nodes().len()),
        ("cameras", graph.cameras.len()),
        ("lights", graph.lights.len()),
        ("skins", graph.skins.len()),
        ("animations", graph.animations.len()),
    ];
    counts.into_iter()
}

/// Returns the time of the last keyframe of an animation, in seconds.
fn duration(graph: &Graph, animation: &Animation) -> f64 {
    let samplers = animation.samplers.iter();
    let times = samplers.filter_map(|sampler| graph.arrays[sampler.input].last());
    times.fold(0.0, |longest, &time| {
        let time = f64::from(time);
        if time > longest { time } else { longest }
    })
}

/// Returns the number of joints that have weights, and the largest number of joints that influence one vertex.
fn joint_counts(mesh: &Mesh) -> (usize, usize) {
    let joints = mesh.attributes().joints();
    let at = |v: usize| {
        joints
            .iter()
            .filter(|(_, weights)| weights[v] != 0.0)
            .count()
    };
    let most = (0..mesh.n_vertices()).map(at).max();
    (joints.len(), most.unwrap_or(0))
}

/// Returns the locations of the elements that a note is about, to draw them in a picture.
fn places(note: &Note) -> Vec<ErrorLocation> {
    let names: Vec<String> = match &note.elements {
        Some(Elements::Vertices(list)) => list.iter().map(ToString::to_string).collect(),
        Some(Elements::Edges(list)) => list.iter().map(|[v, w]| format!("{v}-{w}")).collect(),
        Some(Elements::Faces(list)) => list.iter().map(|f| format!("face {f}")).collect(),
        None => Vec::new(),
    };
    let place = |(name, points): (String, &Vec<_>)| ErrorLocation {
        object: String::new(),
        name,
        points: points.clone(),
    };
    names.into_iter().zip(&note.places).map(place).collect()
}

/// Shows a picture of a scene in the terminal.
fn show(path: &Path, scene: Scene) -> anyhow::Result<()> {
    let stream = String::new();
    let mut picture = Picture::new("info.png");
    picture.size = [640, 480].map(op::Count::literal);
    let images = draw_scenes(&picture, path, &[(SceneAtStep { scene, stream }, "")], &[])?;
    terminal_picture::show(&images[0])?;
    Ok(())
}

/// Converts a note to JSON. The field `text` names only some of the elements that the note is about. The field
/// `vertices`, `edges` or `faces` lists all of these elements.
pub(crate) fn note_json(note: &Note) -> serde_json::Value {
    let places = (note.places.iter()).map(|points| points.iter().map(DVec3::to_array).collect());
    let places: Vec<Vec<_>> = places.collect();
    let mut json = json!({
        "code": note.code,
        "text": note.to_string(),
        "left_out": note.kind == NoteKind::LeftOut,
        "file": note.path.display().to_string(),
        "line": note.line,
        "count": note.count,
        "places": places,
    });
    let index = |v: &VertexId| v.index();
    match &note.elements {
        Some(Elements::Vertices(list)) => json["vertices"] = list.iter().map(index).collect(),
        Some(Elements::Edges(list)) => {
            json["edges"] = list.iter().map(|e| e.each_ref().map(index)).collect();
        }
        Some(Elements::Faces(list)) => json["faces"] = list.iter().copied().collect(),
        None => {}
    }
    json
}

fn facts(object: &Object, placed: &Placed) -> Vec<(&'static str, String)> {
    match &object.geometry {
        Geometry::Mesh(mesh) => mesh_facts(object, mesh, placed),
        Geometry::Patches(patches) => vec![("patches", group_digits(patches.len() as u64))],
        Geometry::Curve(curve) => {
            vec![("control points", group_digits(curve.points().len() as u64))]
        }
        Geometry::Polylines(lines) => {
            let points: usize = lines.iter().map(Vec::len).sum();
            let counts = [("polylines", lines.len()), ("points", points)];
            counts
                .map(|(what, n)| (what, group_digits(n as u64)))
                .to_vec()
        }
    }
}

fn mesh_facts(object: &Object, mesh: &Mesh, placed: &Placed) -> Vec<(&'static str, String)> {
    let count = |n: usize| group_digits(n as u64);
    let loops = mesh.n_boundary_loops();
    let closed = if loops == 0 {
        "yes".to_owned()
    } else {
        format!("no, {}", counted(loops, "boundary loop"))
    };
    let mut degrees: Vec<usize> = Vec::new();
    for f in mesh.faces() {
        let n = mesh.degree(f);
        degrees.resize(degrees.len().max(n + 1), 0);
        degrees[n] += 1;
    }
    let is_listed = |name: &str| !is_rig_name(name);
    let attributes: Vec<String> = mesh
        .attributes()
        .iter()
        .filter(|(domain, c)| *domain != Domain::Vertex || is_listed(&c.name))
        .map(|(domain, c)| format!("{domain} {} ({})", c.name, c.values.type_name()))
        .collect();
    let (n_faces, degrees) = (count(mesh.n_faces()), histogram(&degrees, "corners"));
    let mut facts = vec![
        ("vertices", count(mesh.n_vertices())),
        ("edges", count(mesh.n_edges())),
        ("faces", format!("{n_faces} ({degrees})")),
        ("valences", histogram(&geometry::valences(mesh), "edges")),
        ("closed", closed),
        ("components", count(geometry::n_components(mesh))),
        ("Euler char.", mesh.euler_characteristic().to_string()),
        ("genus", geometry::genus(mesh).to_string()),
        ("area", number(placed.area)),
    ];
    if loops == 0 {
        facts.push(("volume", number(placed.volume)));
    }
    if placed.n > 1 {
        facts.push(("instances", count(placed.n)));
    }
    if let Some([min, max]) = placed.bounds {
        facts.push(("bounds", format!("{} to {}", point(min), point(max))));
    }
    let isolated = mesh.n_isolated_vertices();
    if isolated > 0 {
        facts.push(("isolated vertices", count(isolated)));
    }
    let (n_joints, most) = joint_counts(mesh);
    if n_joints > 0 {
        let facts_of = format!("{} (at most {most} at a vertex)", count(n_joints));
        facts.push(("joints", facts_of));
    }
    let n_morphs = mesh.attributes().morphs().len();
    if n_morphs > 0 {
        facts.push(("morph targets", count(n_morphs)));
    }
    if !attributes.is_empty() {
        facts.push(("attributes", attributes.join(", ")));
    }
    if !object.materials.is_empty() {
        let names: Vec<&str> = object.materials.iter().map(|m| m.name.as_str()).collect();
        facts.push(("materials", names.join(", ")));
    }
    facts
}

/// Formats a histogram with at most eight entries. An example is `12 of 3, 6 of 4 corners`: 12 faces have 3 corners,
/// and 6 faces have 4 corners.
fn histogram(counts: &[usize], what: &str) -> String {
    let found = counts.iter().enumerate().filter(|(_, n)| **n > 0);
    let mut parts: Vec<String> = found
        .map(|(number, n)| format!("{} of {number}", group_digits(*n as u64)))
        .collect();
    if parts.is_empty() {
        return "none".to_owned();
    }
    if parts.len() > 8 {
        parts.truncate(8);
        parts.push("...".to_owned());
    }
    format!("{} {what}", parts.join(", "))
}

fn object_json(object: &Object, placed: &Placed) -> serde_json::Value {
    let mut json = json!({ "name": object.name, "kind": object.geometry.kind() });
    let more = match &object.geometry {
        Geometry::Mesh(mesh) => {
            let attributes: Vec<String> = mesh
                .attributes()
                .iter()
                .map(|(d, c)| format!("{d} {}", c.name))
                .collect();
            json!({
                "vertices": mesh.n_vertices(),
                "edges": mesh.n_edges(),
                "faces": mesh.n_faces(),
                "boundary_loops": mesh.n_boundary_loops(),
                "components": geometry::n_components(mesh),
                "euler_characteristic": mesh.euler_characteristic(),
                "genus": geometry::genus(mesh),
                "area": placed.area,
                "volume": placed.volume,
                "bounds": placed.bounds.map(|b| b.map(|p| p.to_array())),
                "instances": placed.n,
                "isolated_vertices": mesh.n_isolated_vertices(),
                "joints": joint_counts(mesh).0,
                "joints_at_a_vertex": joint_counts(mesh).1,
                "morph_targets": mesh.attributes().morphs().len(),
                "attributes": attributes,
            })
        }
        _ => facts(object, placed).into_iter().collect(),
    };
    if let (Some(json), serde_json::Value::Object(more)) = (json.as_object_mut(), more) {
        json.extend(more);
    }
    json
}
