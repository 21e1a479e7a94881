//! The groups, object, material and smoothing group of the faces of an OBJ file.

use std::borrow::Cow;

use mesh::{Column, Domain, FaceId, Mesh, Values};

use super::corner::Counts;
use crate::loss::Losses;
use crate::polygons::OBJECT_TAG;
use mesh::parallel;

/// The groups, object, material and smoothing group that apply to the following faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FaceState<'a> {
    pub(super) object: Option<&'a str>,
    pub(super) groups: Vec<&'a str>,
    pub(super) material: Option<usize>,
    pub(super) smoothing: i32,
}

/// The state at the end of the text of an object: the material, the smoothing group, and the numbers of elements that
/// are defined so far. At this point, no groups are set.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TextState {
    pub(super) counts: Counts,
    pub(super) material: Option<usize>,
    pub(super) smoothing: i32,
}

/// The attribute columns that determine the groups, object, material and smoothing group of each written face.
pub(super) struct FaceStates<'a> {
    /// The tags that are written as `o` statements. If the list is not empty, each face has exactly one of the tags.
    objects: Vec<(&'a str, &'a [bool])>,
    groups: Vec<(&'a str, &'a [bool])>,
    materials: Option<&'a [i32]>,
    smoothing: Option<&'a [i32]>,
    places: &'a [usize],
}

impl<'a> FaceStates<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        places: &'a [usize],
        several: bool,
        losses: &mut Losses,
    ) -> Self {
        let mut groups = Vec::new();
        for Column { name, values, .. } in mesh.attributes().of(Domain::Face) {
            let Values::Tag(marks) = values else { continue };
            if !marks.contains(&true) {
                losses.add(Domain::Face, name, 1, "no face has this tag");
                continue;
            }
            groups.push((name.as_str(), marks.as_slice()));
        }
        let is_object = |name: &str| {
            name.strip_prefix(OBJECT_TAG)
                .is_some_and(|rest| !rest.is_empty() && fit_line(rest) == rest)
        };
        let one_object_each = |f: usize| {
            let is_of = |(name, marks): &&(&str, &[bool])| is_object(name) && marks[f];
            groups.iter().filter(is_of).count() == 1
        };
        // The tags of objects are written as `o` statements only if the scene has only one object, and each face has
        // exactly one of these tags. Otherwise, they are written as groups.
        let objects = if !several && parallel::all(mesh.n_faces(), one_object_each) {
            groups.extract_if(.., |(name, _)| is_object(name)).collect()
        } else {
            Vec::new()
        };
        for (name, marks) in &groups {
            let word = one_word(name);
            let count = marks.iter().filter(|&&is| is).count();
            let renamed = if word == *name { 0 } else { count };
            let reason = format!("the tag is written as group `{word}`");
            losses.add(Domain::Face, name, renamed, reason);
        }
        let materials = mesh.get(mesh::MATERIAL);
        let exists = |m: i32| usize::try_from(m).is_ok_and(|m| m < places.len());
        let unknown = materials.into_iter().flatten();
        let unknown = unknown.filter(|&&m| m != -1 && !exists(m)).count();
        let reason = "the object does not have a material with this index";
        losses.add(Domain::Face, "material", unknown, reason);
        let smoothing = mesh.get(mesh::SMOOTHING);
        let negative = smoothing.into_iter().flatten().filter(|&&group| group < 0);
        let reason = "OBJ does not allow negative smoothing groups, so they are written as 0";
        losses.add(Domain::Face, "smoothing", negative.count(), reason);
        Self {
            objects,
            groups,
            materials,
            smoothing,
            places,
        }
    }

    /// Whether two faces have the same groups, object, material and smoothing group.
    pub(super) fn same(&self, f: FaceId, g: FaceId) -> bool {
        let (f, g) = (f.index(), g.index());
        let mut tags = self.objects.iter().chain(&self.groups);
        tags.all(|(_, marks)| marks[f] == marks[g])
            && self.materials.is_none_or(|m| m[f] == m[g])
            && self.smoothing.is_none_or(|s| s[f] == s[g])
    }

    /// Whether the face is in a group.
    pub(super) fn is_grouped(&self, f: FaceId) -> bool {
        self.groups.iter().any(|(_, marks)| marks[f.index()])
    }

    pub(super) fn of(&self, f: FaceId) -> FaceState<'a> {
        let f = f.index();
        let object = self.objects.iter().find(|(_, marks)| marks[f]);
        let groups = self.groups.iter().filter(|(_, marks)| marks[f]);
        let material = self.materials.and_then(|m| usize::try_from(m[f]).ok());
        FaceState {
            object: object.map(|(name, _)| &name[OBJECT_TAG.len()..]),
            groups: groups.map(|(name, _)| *name).collect(),
            material: material.and_then(|m| self.places.get(m).copied()),
            smoothing: self.smoothing.map_or(0, |s| s[f].max(0)),
        }
    }
}

/// Changes a name so that it can be written at the end of a line. Surrounding blanks and trailing backslashes are
/// removed, and control characters become `_`.
pub(super) fn fit_line(name: &str) -> Cow<'_, str> {
    let trimmed = name.trim_matches(|c: char| c.is_whitespace());
    if trimmed.contains(char::is_control) || trimmed.ends_with('\\') {
        let fitted = trimmed.trim_end_matches('\\');
        return Cow::Owned(fitted.replace(char::is_control, "_"));
    }
    Cow::Borrowed(trimmed)
}

/// Turns a name into a single word. Blanks and control characters become `_`. Leading `#` and trailing backslashes are
/// removed.
pub(super) fn one_word(name: &str) -> Cow<'_, str> {
    let blank = |c: char| c.is_whitespace() || c.is_control();
    if name.is_empty() || name.contains(blank) || name.starts_with('#') || name.ends_with('\\') {
        let word = name.replace(blank, "_");
        let word = word.trim_start_matches('#').trim_end_matches('\\');
        let word = if word.is_empty() { "unnamed" } else { word };
        return Cow::Owned(word.to_owned());
    }
    Cow::Borrowed(name)
}
