//! Describes losses. A loss is content of a scene that a written file does not store.

use std::collections::BTreeSet;
use std::fmt;

use mesh::{Column, Domain, Mesh, joint_name, morph_name};

use crate::file_vertices::is_mark;
use crate::{Format, Rows, Storage, Stored};

/// Content of a scene that a written file does not store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// The name of the object. The name is empty if the loss concerns the whole scene, such as its cameras.
    pub object: String,
    /// The domain (vertices, edges, faces or corners) of the lost values. `None` if the loss concerns the object as a
    /// whole.
    pub domain: Option<Domain>,
    /// The name of the attribute, or of another part of the object, such as `materials`.
    pub attribute: String,
    /// The number of lost values or elements.
    pub count: usize,
    /// The reason why the file does not store the values or elements.
    pub reason: String,
}

/// If a loss has a domain, its [`Loss::attribute`] is usually the name of an attribute. These values are the
/// exceptions.
const NOT_ATTRIBUTES: [&str; 4] = ["influences", "joint weights", "morph targets", "polygon"];

impl Loss {
    /// Returns the name of the kind of loss, such as `attribute-lost`. This name is stable, so programs can rely on it.
    pub fn code(&self) -> String {
        const PARTS: [&str; 10] = [
            "animations",
            "cameras",
            "lights",
            "materials",
            "mesh",
            "morph targets",
            "morph weights",
            "name",
            "nodes",
            "skins",
        ];
        match self.attribute.as_str() {
            name @ ("position" | "polygon") => format!("{name}-changed"),
            _ if self.domain.is_some() => "attribute-lost".to_owned(),
            name if PARTS.contains(&name) => format!("{}-lost", name.replace(' ', "-")),
            _ => "material-changed".to_owned(),
        }
    }

    /// Returns the lost content in words, such as `the corner attribute "uv" (3 corners)`.
    pub fn what(&self) -> String {
        let (name, count) = (&self.attribute, self.count);
        let Some(domain) = self.domain else {
            return format!("\"{name}\" ({count})");
        };
        let unit = match (domain, count) {
            (Domain::Vertex, 1) => "vertex",
            (Domain::Vertex, _) => "vertices",
            (Domain::Corner, 1) => "corner",
            (Domain::Corner, _) => "corners",
            (Domain::Edge, 1) => "edge",
            (Domain::Edge, _) => "edges",
            (Domain::Face, 1) => "face",
            (Domain::Face, _) => "faces",
        };
        if NOT_ATTRIBUTES.contains(&name.as_str()) {
            format!("\"{name}\" ({count} {unit})")
        } else {
            format!("the {domain} attribute \"{name}\" ({count} {unit})")
        }
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.object.is_empty() {
            write!(f, "the scene lost ")?;
        } else {
            write!(f, "\"{}\" lost ", self.object)?;
        }
        write!(f, "{}: {}", self.what(), self.reason)
    }
}

/// Returns the number of elements in this domain. An attribute of this domain has one value for each element. The array
/// of a corner attribute has additional entries for boundary half-edges. These entries are not counted, because
/// boundary half-edges are not corners.
pub(crate) fn n_values(mesh: &Mesh, domain: Domain) -> usize {
    match domain {
        Domain::Corner => {
            let faces = mesh.connectivity().face.iter();
            faces.filter(|f| f.some().is_some()).count()
        }
        _ => mesh.domain_len(domain),
    }
}

/// Collects the losses of one object, or of the whole scene if the name of the object is empty.
#[derive(Debug)]
pub(crate) struct Losses<'a> {
    object: &'a str,
    list: &'a mut Vec<Loss>,
}

impl<'a> Losses<'a> {
    pub(crate) fn of(object: &'a str, list: &'a mut Vec<Loss>) -> Self {
        Self { object, list }
    }

    /// Returns a collector for the losses of another object, or of the whole scene if the name is empty.
    pub(crate) fn about<'b>(&'b mut self, object: &'b str) -> Losses<'b> {
        Losses::of(object, self.list)
    }

    /// Adds a loss (content that the file does not store), unless `count` is 0.
    pub(crate) fn add(
        &mut self,
        domain: impl Into<Option<Domain>>,
        attribute: &str,
        count: usize,
        reason: impl Into<String>,
    ) {
        if count > 0 {
            self.list.push(Loss {
                object: self.object.to_owned(),
                domain: domain.into(),
                attribute: attribute.to_owned(),
                count,
                reason: reason.into(),
            });
        }
    }

    /// Adds a loss for every attribute column of `mesh` that the format cannot store, or for which `is_stored` returns
    /// false.
    pub(crate) fn add_columns(
        &mut self,
        mesh: &Mesh,
        format: Format,
        is_stored: impl Fn(Domain, &Column) -> bool,
    ) {
        self.add_columns_of_rows(mesh, format, Rows::default(), is_stored);
    }

    /// Like [`add_columns`](Self::add_columns), but `rows` is the kind of elements that a `.csv` table lists.
    pub(crate) fn add_columns_of_rows(
        &mut self,
        mesh: &Mesh,
        format: Format,
        rows: Rows,
        is_stored: impl Fn(Domain, &Column) -> bool,
    ) {
        let has = |domain, name: &str| mesh.attributes().column(domain, name).is_some();
        let table = Stored {
            format,
            rows,
            has: &has,
        };
        let format = table.name();
        let is_stored = |domain, column: &Column| {
            let storage = table.storage(domain, &column.name, Some(&column.values));
            is_mark(domain, column) || storage != Storage::Lost && is_stored(domain, column)
        };
        let lost = |name: &str| {
            let column = mesh.attributes().column(Domain::Vertex, name);
            column.is_some_and(|column| !is_stored(Domain::Vertex, column))
        };
        // The weights of all joints are reported as one loss, and the deltas of all morph targets as another.
        let joints = mesh.attributes().joints().into_iter();
        let joints: BTreeSet<String> = joints.map(|(joint, _)| joint_name(joint)).collect();
        let morphs = mesh.attributes().morphs().into_iter();
        let morphs: BTreeSet<String> = morphs.map(|(target, _)| morph_name(target)).collect();
        if joints.iter().any(|name| lost(name)) {
            let reason = format!("{format} cannot store joint weights");
            self.add(Domain::Vertex, "joint weights", mesh.n_vertices(), reason);
        }
        let n_morphs = morphs.iter().filter(|name| lost(name)).count();
        let reason = format!("{format} cannot store morph targets");
        self.add(None, "morph targets", n_morphs, reason);
        for (domain, column) in mesh.attributes().iter() {
            let is_deformer = joints.contains(&column.name) || morphs.contains(&column.name);
            if !(is_stored(domain, column) || domain == Domain::Vertex && is_deformer) {
                let kind = column.values.type_name();
                let reason = format!("{format} cannot store this {domain} attribute ({kind})");
                let count = n_values(mesh, domain).max(1);
                self.add(domain, &column.name, count, reason);
            }
        }
    }
}
