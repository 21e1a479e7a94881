//! Laws of writing and reading: what comes back is what was there, but for what was told and what the
//! table in the documentation of the crate says.

mod flat;
mod models;
mod random;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::OnceLock;

use mesh::Domain;
use mesh_io::{Loaded, Loss, Note, NoteKind, WriteError, WriteOptions};
use scene::Object;

use crate::{Folder, read, scene};
use flat::{Difference, Key, differences, key, says_nothing};
use models::{Feature, features};

/// The formats that are written, in the order of the table. `gltf` and `glb` hold the same.
const FORMATS: [&str; 7] = ["obj", "glb", "ply", "stl", "off", "bez", "bzc"];

/// What the documentation of the crate shows.
const TABLE: &str = include_str!("../../src/kept.md");

/// What becomes of something in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    /// It comes back with the same bits.
    Exactly,
    /// Its numbers come back with 32 bits.
    Rounded,
    /// It comes back in another form, and nothing tells.
    Changed,
    /// Some or all of it does not come back, and a loss says so.
    Told,
    /// Nothing is written.
    Refused,
}

impl Kept {
    const ALL: [Self; 5] = [
        Self::Exactly,
        Self::Rounded,
        Self::Changed,
        Self::Told,
        Self::Refused,
    ];

    fn word(self) -> &'static str {
        match self {
            Self::Exactly => "kept",
            Self::Rounded => "32 bits",
            Self::Changed => "changed",
            Self::Told => "lost",
            Self::Refused => "refused",
        }
    }
}

/// One way to a file and back.
struct Trip {
    bytes: BTreeMap<String, Vec<u8>>,
    losses: Vec<Loss>,
    loaded: Loaded,
}

fn trip(objects: &[Object], extension: &str) -> Result<Trip, WriteError> {
    let folder = Folder::new();
    let path = folder.path(&format!("it.{extension}"));
    let scene = scene(objects.iter().cloned());
    let report = mesh_io::write(&store::Disk, &path, &scene, &WriteOptions::default())?;
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let files = report.files.iter();
    let bytes = files.map(|path| (name(path), std::fs::read(path).unwrap()));
    Ok(Trip {
        bytes: bytes.collect(),
        losses: report.losses,
        loaded: read(&path).unwrap_or_else(|e| panic!("what was written is not read: {e}")),
    })
}

/// What the losses tell, in the words of differences.
fn told(objects: &[Object], losses: &[Loss]) -> BTreeSet<Key> {
    let materials = objects.iter().flat_map(|object| &object.materials);
    let materials: BTreeSet<&str> = materials.map(|material| material.name.as_str()).collect();
    let of = |loss: &Loss| match (loss.domain, loss.attribute.as_str()) {
        (None, "mesh") => key(None, "name"),
        (None, name) if materials.contains(name) => key(None, "materials"),
        (domain, name) => key(domain, name),
    };
    let mut all: BTreeSet<Key> = losses.iter().map(of).collect();
    // A mesh of isolated vertices is gone with them.
    let is_bare = |object: &Object| object.as_mesh().is_some_and(|mesh| mesh.n_faces() == 0);
    if objects.iter().any(is_bare) && all.contains(&key(Domain::Vertex, "position")) {
        all.insert(key(None, "name"));
    }
    if all.contains(&key(Domain::Vertex, "position")) {
        all.insert(key(Domain::Vertex, "merged"));
    }
    all
}

/// Whether a format gives triangles that are put together again.
fn is_soup(extension: &str) -> bool {
    matches!(extension, "stl" | "glb" | "gltf")
}

/// The lines of the table: for each name what becomes of it in each format.
fn table() -> BTreeMap<String, Vec<Kept>> {
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim().trim_matches('|');
        line.split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    let mut lines = TABLE
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(cells);
    let head = lines.next().unwrap();
    let formats: Vec<String> = FORMATS.map(|name| format!("`.{name}`")).into();
    assert_eq!(
        head[1..].join(" "),
        formats.join(" ").replace(".glb", ".gltf")
    );
    let kept = |word: &String| {
        let known = Kept::ALL.into_iter().find(|kept| kept.word() == word);
        known.unwrap_or_else(|| panic!("`{word}` is no word of the table"))
    };
    let of_line = |line: Vec<String>| (line[0].clone(), line[1..].iter().map(kept).collect());
    lines.skip(1).map(of_line).collect()
}

/// What may differ in a format although nothing tells.
fn untold(extension: &str) -> &'static BTreeMap<Key, Difference> {
    static UNTOLD: OnceLock<BTreeMap<&str, BTreeMap<Key, Difference>>> = OnceLock::new();
    let untold = UNTOLD.get_or_init(|| {
        let table = table();
        let mut untold = FORMATS.map(|format| (format, BTreeMap::new()));
        for Feature { name, key, .. } in features() {
            for ((_, all), kept) in untold.iter_mut().zip(table.get(name).into_iter().flatten()) {
                let difference = match kept {
                    Kept::Rounded => Difference::Rounded,
                    Kept::Changed => Difference::Other,
                    _ => continue,
                };
                let known = all.entry(key.clone()).or_insert(difference);
                *known = difference.max(*known);
            }
        }
        untold.into()
    });
    &untold[if extension == "gltf" {
        "glb"
    } else {
        extension
    }]
}

fn measured(feature: &Feature, extension: &str) -> Kept {
    let Feature { name, key, objects } = feature;
    let here = format!("{name} in {extension}");
    let Ok(Trip { losses, loaded, .. }) = trip(objects, extension) else {
        return Kept::Refused;
    };
    let all = differences(objects, &loaded.objects, is_soup(extension));
    let told = told(objects, &losses);
    let is_form = matches!(key.1.as_str(), "domain" | "rule");
    match all.get(key) {
        None if is_form && !told.is_empty() => Kept::Told,
        None => {
            assert!(!told.contains(key), "{here}: told, but there: {losses:?}");
            Kept::Exactly
        }
        Some(Difference::Rounded) => Kept::Rounded,
        Some(Difference::Other) if told.contains(key) => Kept::Told,
        Some(Difference::Other) => Kept::Changed,
    }
}

/// What comes back is the same but for what was told and what the table says; a second way changes
/// nothing more, and loses nothing, and writes the same bytes.
///
/// # Errors
///
/// The first law that is broken.
fn check_laws(objects: &[Object], extension: &str) -> Result<(), String> {
    let Ok(first) = trip(objects, extension) else {
        return Ok(());
    };
    let all = differences(objects, &first.loaded.objects, is_soup(extension));
    let told = told(objects, &first.losses);
    let untold = untold(extension);
    for (what, difference) in &all {
        let new_name = format!("`{}`", what.1);
        let is_new_name = first
            .losses
            .iter()
            .any(|loss| loss.reason.contains(&new_name));
        // Values of corners may have moved to the vertices after they were told of.
        let as_corners = key(Domain::Corner, &what.1);
        let is_told = told.contains(what)
            || what.0 == Some(Domain::Vertex) && told.contains(&as_corners)
            // Without those that no face has, the others have other numbers.
            || *what == key(Domain::Face, "material") && told.contains(&key(None, "materials"));
        // What the table says of one name holds for all that have no meaning.
        let other = key(Domain::Vertex, "heat");
        let like_others = *difference == Difference::Rounded
            && matches!(what.0, Some(Domain::Vertex | Domain::Corner))
            && untold.get(&other) == Some(difference);
        let is_listed = untold.get(what).is_some_and(|d| d >= difference) || like_others;
        let is_known = is_told || is_listed || is_new_name;
        ensure(is_known, || {
            format!("{what:?} is another and nothing tells: {told:?}")
        })?;
    }
    let is_whole = !all.contains_key(&key(None, "name"));
    let is_merged = all.contains_key(&key(Domain::Vertex, "merged"));
    if is_whole && !is_merged {
        for what in told.iter().filter(|_| !has_empty_columns(objects)) {
            let losses = &first.losses;
            let is_lost =
                all.contains_key(what) || what.1 == "merged" || says_nothing_of(objects, what);
            ensure(is_lost, || {
                format!("told as lost, but there: {what:?} of {losses:?}")
            })?;
        }
    }
    // Triangles that are put together again are noted.
    let notes = &first.loaded.notes;
    let is_fine = |note: &Note| note.kind == NoteKind::Changed && extension == "stl";
    ensure(is_merged || notes.iter().all(is_fine), || {
        format!("notes: {notes:?}")
    })?;

    let second = trip(&first.loaded.objects, extension).map_err(|e| e.to_string())?;
    let losses = &second.losses;
    ensure(is_merged || losses.is_empty(), || {
        format!("the second way loses {losses:?}")
    })?;
    ensure(second.loaded.objects == first.loaded.objects, || {
        format!(
            "the second way changes {:?} to {:?}",
            first.loaded, second.loaded
        )
    })?;
    let third = trip(&second.loaded.objects, extension).map_err(|e| e.to_string())?;
    ensure(third.bytes == second.bytes, || {
        "the third file is another".to_owned()
    })?;
    // What has another form the second time may be written in another way.
    let other_forms = ["name", "domain", "rule", "order of faces"].map(|what| key(None, what));
    let has_other_form = other_forms.iter().any(|what| all.contains_key(what));
    let is_another_form = has_other_form || is_merged || has_empty_columns(objects);
    ensure(is_another_form || second.bytes == first.bytes, || {
        let text = |trip: &Trip| {
            trip.bytes
                .values()
                .map(|bytes| String::from_utf8_lossy(bytes).into_owned())
                .collect::<String>()
        };
        format!(
            "the second file is another:\n{}\n{}",
            text(&first),
            text(&second)
        )
    })
}

/// Whether a column stands for nothing, such as no material at all.
fn says_nothing_of(objects: &[Object], (domain, name): &Key) -> bool {
    let meshes = objects.iter().filter_map(Object::as_mesh);
    let mut columns = meshes.flat_map(|mesh| mesh.attributes().iter());
    columns.any(|(of, column)| Some(of) == *domain && column.name == *name && says_nothing(column))
}

/// Whether there are attributes of elements of which there are none.
fn has_empty_columns(objects: &[Object]) -> bool {
    let meshes = objects.iter().filter_map(Object::as_mesh);
    meshes
        .flat_map(|mesh| mesh.attributes().iter())
        .any(|(_, column)| column.values.is_empty())
}

fn ensure(holds: bool, why: impl Fn() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(why()) }
}

fn assert_none(broken: &[String]) {
    let short = broken
        .iter()
        .map(|why| why.chars().take(1500).collect::<String>());
    assert!(
        broken.is_empty(),
        "{}",
        short.collect::<Vec<_>>().join("\n")
    );
}

#[test]
fn the_table_says_what_becomes_of_everything() {
    let mut expected = table();
    let mut text = String::new();
    let mut wrong = Vec::new();
    for feature in features() {
        let line = FORMATS.map(|extension| measured(&feature, extension));
        let words = line.map(|kept| format!(" {} |", kept.word())).concat();
        text += &format!("| {} |{words}\n", feature.name);
        if expected.remove(feature.name).as_deref() != Some(&line[..]) {
            wrong.push(feature.name);
        }
    }
    let left = expected.keys().collect::<Vec<_>>();
    assert!(
        wrong.is_empty() && left.is_empty(),
        "other than in the table: {wrong:?}, not measured: {left:?}\n{text}"
    );
}

#[test]
fn every_feature_comes_back_as_told() {
    let mut broken = Vec::new();
    for feature in features() {
        for extension in FORMATS.into_iter().chain(["gltf"]) {
            if let Err(why) = check_laws(&feature.objects, extension) {
                broken.push(format!("{} in {extension}: {why}", feature.name));
            }
        }
    }
    assert_none(&broken);
}

#[test]
fn a_real_model_comes_back_as_told() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/assets/bunny.obj");
    let loaded = mesh_io::read(
        &store::Disk,
        &path,
        &mesh_io::ReadOptions {
            name: Some("it".to_owned()),
            ..Default::default()
        },
    );
    let objects = loaded.unwrap().objects;
    let mut broken = Vec::new();
    for extension in ["obj", "glb", "ply", "stl", "off"] {
        if let Err(why) = check_laws(&objects, extension) {
            broken.push(format!("{extension}: {why}"));
        }
    }
    assert_none(&broken);
}

#[test]
fn every_kind_of_mesh_comes_back_as_told() {
    let mut broken = Vec::new();
    for (i, objects) in models::shapes_of_all_kinds().iter().enumerate() {
        for extension in FORMATS {
            if let Err(why) = check_laws(objects, extension) {
                broken.push(format!("shape {i} in {extension}: {why}"));
            }
        }
    }
    assert_none(&broken);
}
