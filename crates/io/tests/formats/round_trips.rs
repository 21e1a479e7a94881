//! Checks that writing a scene and reading it again preserves the scene. The only exceptions are reported losses, and
//! changes that are listed in a table of the crate documentation.

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
use flat::{Difference, Key, differences, has_only_default_values, key};
use models::{Feature, features};

/// The formats of the table, in the order of its columns. Files of the format `.glb` are used to test the column of
/// `.gltf`, because both formats store the same content.
const FORMATS: [&str; 7] = ["obj", "glb", "ply", "stl", "off", "bez", "bzc"];

/// The table in the documentation of the crate.
const TABLE: &str = include_str!("../../src/kept.md");

/// What happens to some content in a round trip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// The content is restored bit for bit.
    Exactly,
    /// The numbers of the content are rounded to 32 bits.
    Rounded,
    /// The content has a different form after reading. Writing does not report this as a loss.
    Changed,
    /// At least a part of the content is missing or different after reading. Writing reports this as a loss.
    Lost,
    /// Writing fails.
    Refused,
}

impl Outcome {
    const ALL: [Self; 5] = [
        Self::Exactly,
        Self::Rounded,
        Self::Changed,
        Self::Lost,
        Self::Refused,
    ];

    fn word(self) -> &'static str {
        match self {
            Self::Exactly => "kept",
            Self::Rounded => "32 bits",
            Self::Changed => "changed",
            Self::Lost => "lost",
            Self::Refused => "refused",
        }
    }
}

/// The result of a round trip through a file.
struct RoundTrip {
    bytes: BTreeMap<String, Vec<u8>>,
    losses: Vec<Loss>,
    loaded: Loaded,
}

fn round_trip(objects: &[Object], extension: &str) -> Result<RoundTrip, WriteError> {
    let folder = Folder::new();
    let path = folder.path(&format!("it.{extension}"));
    let scene = scene(objects.iter().cloned());
    let report = mesh_io::write(&store::Disk, &path, &scene, &WriteOptions::default())?;
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let files = report.files.iter();
    let bytes = files.map(|path| (name(path), std::fs::read(path).unwrap()));
    Ok(RoundTrip {
        bytes: bytes.collect(),
        losses: report.losses,
        loaded: read(&path).unwrap_or_else(|e| panic!("the written file cannot be read: {e}")),
    })
}

/// Returns the keys of all differences that the reported losses explain.
fn reported(objects: &[Object], losses: &[Loss]) -> BTreeSet<Key> {
    let materials = objects.iter().flat_map(|object| &object.materials);
    let materials: BTreeSet<&str> = materials.map(|material| material.name.as_str()).collect();
    let of = |loss: &Loss| match (loss.domain, loss.attribute.as_str()) {
        (None, "mesh") => key(None, "name"),
        (None, name) if materials.contains(name) => key(None, "materials"),
        (domain, name) => key(domain, name),
    };
    let mut all: BTreeSet<Key> = losses.iter().map(of).collect();
    // If all vertices of a mesh are isolated and the format does not store isolated vertices, the whole mesh is lost.
    let is_bare = |object: &Object| object.as_mesh().is_some_and(|mesh| mesh.n_faces() == 0);
    if objects.iter().any(is_bare) && all.contains(&key(Domain::Vertex, "position")) {
        all.insert(key(None, "name"));
    }
    if all.contains(&key(Domain::Vertex, "position")) {
        all.insert(key(Domain::Vertex, "merged"));
    }
    all
}

/// Whether files of this format store separate triangles. The reader merges the coincident corners of these triangles.
fn is_soup(extension: &str) -> bool {
    matches!(extension, "stl" | "glb" | "gltf")
}

/// Returns the rows of the table: for each feature, the outcome for each format.
fn table() -> BTreeMap<String, Vec<Outcome>> {
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim().trim_matches('|');
        line.split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    // The file has several tables. This test uses only the first one.
    let (table, _) = TABLE.split_once("\n## ").unwrap();
    let mut lines = table
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
        let known = Outcome::ALL.into_iter().find(|kept| kept.word() == word);
        known.unwrap_or_else(|| panic!("unknown word `{word}` in the table"))
    };
    let of_line = |line: Vec<String>| (line[0].clone(), line[1..].iter().map(kept).collect());
    lines.skip(1).map(of_line).collect()
}

/// Returns the differences that a round trip through a format can cause without a reported loss, according to the
/// table.
fn unreported(extension: &str) -> &'static BTreeMap<Key, Difference> {
    static UNREPORTED: OnceLock<BTreeMap<&str, BTreeMap<Key, Difference>>> = OnceLock::new();
    let unreported = UNREPORTED.get_or_init(|| {
        let table = table();
        let mut unreported = FORMATS.map(|format| (format, BTreeMap::new()));
        for Feature { name, key, .. } in features() {
            for ((_, all), kept) in unreported
                .iter_mut()
                .zip(table.get(name).into_iter().flatten())
            {
                let difference = match kept {
                    Outcome::Rounded => Difference::Rounded,
                    Outcome::Changed => Difference::Other,
                    _ => continue,
                };
                let known = all.entry(key.clone()).or_insert(difference);
                *known = difference.max(*known);
            }
        }
        unreported.into()
    });
    &unreported[if extension == "gltf" {
        "glb"
    } else {
        extension
    }]
}

fn measured(feature: &Feature, extension: &str) -> Outcome {
    let Feature { name, key, objects } = feature;
    let here = format!("{name} in {extension}");
    let Ok(RoundTrip { losses, loaded, .. }) = round_trip(objects, extension) else {
        return Outcome::Refused;
    };
    let all = differences(objects, &loaded.objects, is_soup(extension));
    let reported = reported(objects, &losses);
    let is_form = matches!(key.1.as_str(), "domain" | "rule");
    match all.get(key) {
        None if is_form && !reported.is_empty() => Outcome::Lost,
        None => {
            assert!(
                !reported.contains(key),
                "{here}: reported as lost, but restored: {losses:?}"
            );
            Outcome::Exactly
        }
        Some(Difference::Rounded) => Outcome::Rounded,
        Some(Difference::Other) if reported.contains(key) => Outcome::Lost,
        Some(Difference::Other) => Outcome::Changed,
    }
}

/// Checks that a round trip preserves the objects, except for reported losses and the changes in the table. A second
/// round trip must not change or lose anything. It must also write the same bytes, unless the first round trip changed
/// the form of the content.
///
/// # Errors
///
/// Returns a description of the first property that does not hold.
fn check_laws(objects: &[Object], extension: &str) -> Result<(), String> {
    let Ok(first) = round_trip(objects, extension) else {
        return Ok(());
    };
    let all = differences(objects, &first.loaded.objects, is_soup(extension));
    let reported = reported(objects, &first.losses);
    let unreported = unreported(extension);
    for (what, difference) in &all {
        let new_name = format!("`{}`", what.1);
        let is_new_name = first
            .losses
            .iter()
            .any(|loss| loss.reason.contains(&new_name));
        // If corner values become vertex values when the file is read, the loss names the corners, but the difference
        // is at the vertices.
        let as_corners = key(Domain::Corner, &what.1);
        let is_reported = reported.contains(what)
            || what.0 == Some(Domain::Vertex) && reported.contains(&as_corners)
            // If unused materials are lost, the indices of the remaining materials change.
            || *what == key(Domain::Face, "material") && reported.contains(&key(None, "materials"));
        // In the table, `heat` stands for all custom attributes.
        let other = key(Domain::Vertex, "heat");
        let is_custom = *difference == Difference::Rounded
            && matches!(what.0, Some(Domain::Vertex | Domain::Corner))
            && unreported.get(&other) == Some(difference);
        let is_listed = unreported.get(what).is_some_and(|d| d >= difference) || is_custom;
        let is_known = is_reported || is_listed || is_new_name;
        ensure(is_known, || {
            format!("{what:?} differs, but is not reported: {reported:?}")
        })?;
    }
    let is_whole = !all.contains_key(&key(None, "name"));
    let is_merged = all.contains_key(&key(Domain::Vertex, "merged"));
    if is_whole && !is_merged {
        for what in reported.iter().filter(|_| !has_empty_columns(objects)) {
            let losses = &first.losses;
            let is_lost =
                all.contains_key(what) || what.1 == "merged" || has_only_defaults(objects, what);
            ensure(is_lost, || {
                format!("reported as lost, but restored: {what:?} of {losses:?}")
            })?;
        }
    }
    // Notes are allowed only if vertices were merged, or if the STL reader changed content.
    let notes = &first.loaded.notes;
    // The image files of some materials do not exist, which gives notes.
    let is_fine = |note: &Note| {
        note.kind == NoteKind::Changed && extension == "stl" || note.what.starts_with("image ")
    };
    ensure(is_merged || notes.iter().all(is_fine), || {
        format!("notes: {notes:?}")
    })?;

    let second = round_trip(&first.loaded.objects, extension).map_err(|e| e.to_string())?;
    let losses = &second.losses;
    ensure(is_merged || losses.is_empty(), || {
        format!("the second round trip loses {losses:?}")
    })?;
    ensure(second.loaded.objects == first.loaded.objects, || {
        format!(
            "the second round trip changes {:?} to {:?}",
            first.loaded, second.loaded
        )
    })?;
    let third = round_trip(&second.loaded.objects, extension).map_err(|e| e.to_string())?;
    ensure(third.bytes == second.bytes, || {
        "the third file differs from the second".to_owned()
    })?;
    // If the first round trip changed the form of the content (for example, a name or the order of the faces), the
    // second round trip can write different bytes.
    let other_forms = ["name", "domain", "rule", "order of faces"].map(|what| key(None, what));
    let has_other_form = other_forms.iter().any(|what| all.contains_key(what));
    let is_another_form = has_other_form || is_merged || has_empty_columns(objects);
    ensure(is_another_form || second.bytes == first.bytes, || {
        let text = |trip: &RoundTrip| {
            trip.bytes
                .values()
                .map(|bytes| String::from_utf8_lossy(bytes).into_owned())
                .collect::<String>()
        };
        format!(
            "the second file differs from the first:\n{}\n{}",
            text(&first),
            text(&second)
        )
    })
}

/// Whether a mesh has an attribute with this key, and all values of the attribute are defaults, such as "no material"
/// on every face.
fn has_only_defaults(objects: &[Object], (domain, name): &Key) -> bool {
    let meshes = objects.iter().filter_map(Object::as_mesh);
    let mut columns = meshes.flat_map(|mesh| mesh.attributes().iter());
    columns.any(|(of, column)| {
        Some(of) == *domain && column.name == *name && has_only_default_values(column)
    })
}

/// Whether a mesh has an attribute without values, because the domain of the attribute has no elements.
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
fn the_table_matches_the_measured_results() {
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
        "different from the table: {wrong:?}, not measured: {left:?}\n{text}"
    );
}

#[test]
fn every_feature_survives_as_documented() {
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
fn a_real_model_survives_as_documented() {
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
fn every_kind_of_mesh_survives_as_documented() {
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
