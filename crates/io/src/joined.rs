//! Joins all meshes of a scene, for formats that store one object.

use std::borrow::Cow;

use mesh::{Attributes, Column, Connectivity, Domain, Mesh, Rule, Value, Values};
use scene::{Geometry, Object, Scene};

use crate::Format;
use crate::error::Unwritable;
use crate::loss::{Loss, Losses, n_values};
use crate::polygons::OBJECT_TAG;
use crate::writing::dense;

/// The joined mesh of a scene.
#[derive(Debug)]
pub(crate) struct Joined<'a> {
    /// The meshes of all objects, joined in the order of the objects. Elements that were removed from these meshes
    /// leave no gaps in the arrays.
    pub(crate) mesh: Cow<'a, Mesh>,
    /// The name of the first object. Losses of the joined mesh are reported with this name.
    pub(crate) name: String,
    pub(crate) losses: Vec<Loss>,
}

/// How a writer handles the names of objects when it joins the meshes of the objects.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Names {
    /// The names are lost.
    Lost,
    /// Each face gets a tag: `o:` followed by the name of its object.
    Tags,
    /// The format stores the names.
    Kept,
}

/// Joins the meshes of all objects of a scene for a format that stores one mesh. The joined mesh has no materials, and
/// each lost material is reported.
///
/// # Errors
///
/// Returns an error if an object is not a mesh, or if the joined mesh would be too large.
pub(crate) fn joined(scene: &Scene, format: Format) -> Result<Joined<'_>, Unwritable> {
    let mut meshes = Vec::new();
    let mut losses = Vec::new();
    for object in scene.objects() {
        let Geometry::Mesh(mesh) = &object.geometry else {
            return Err(Unwritable::kind(format, object));
        };
        meshes.push(dense(mesh));
        let reason = format!("{format} cannot store materials");
        let count = object.materials.len();
        Losses::of(&object.name, &mut losses).add(None, "materials", count, reason);
    }
    let first = scene.objects().first();
    let name = first.map(|object| object.name.clone()).unwrap_or_default();
    if meshes.len() == 1 {
        return Ok(Joined {
            mesh: meshes.remove(0),
            name,
            losses,
        });
    }
    let n_half_edges: usize = meshes.iter().map(|mesh| mesh.n_half_edges()).sum();
    let n_vertices: usize = meshes.iter().map(|mesh| mesh.n_vertices()).sum();
    if n_half_edges.max(n_vertices) >= u32::MAX as usize {
        let message = format!(
            "a {format} file stores one mesh, and the objects together are too large for one mesh"
        );
        return Err(Unwritable::scene(message));
    }
    let names = format.joined_names();
    let tags = names == Names::Tags;
    if names != Names::Kept {
        let became = if tags {
            ": the name of each object became a face tag"
        } else {
            ""
        };
        let reason = format!("a {format} file stores one mesh{became}");
        Losses::of(&name, &mut losses).add(None, "name", meshes.len(), reason);
    }
    let (mut all, mut positions) = (Connectivity::default(), Vec::new());
    for mesh in &meshes {
        all.append(mesh.connectivity());
        positions.extend_from_slice(mesh.positions());
    }
    let mut mesh = Mesh::from_arrays(all, positions);
    mesh.set_attributes(appended(scene.objects(), &meshes, tags, &mut losses));
    Ok(Joined {
        mesh: Cow::Owned(mesh),
        name,
        losses,
    })
}

fn domain_lengths(mesh: &Mesh) -> [usize; 4] {
    Domain::ALL.map(|domain| mesh.domain_len(domain))
}

/// Returns the attribute columns of all meshes, joined in the order of the objects. The material indices of each object
/// are increased by the number of materials of the objects before it. If `tags` is set, each face gets the tag of its
/// object.
fn appended(
    objects: &[Object],
    meshes: &[Cow<Mesh>],
    tags: bool,
    losses: &mut Vec<Loss>,
) -> Attributes {
    let mut all = Attributes::default();
    let mut len = [0; 4];
    let mut n_materials = 0;
    for (object, mesh) in objects.iter().zip(meshes) {
        let mut attributes = mesh.attributes().clone();
        if let Some(materials) = mesh.get(mesh::MATERIAL) {
            let shift = |&m: &i32| {
                if m < 0 {
                    m
                } else {
                    m.saturating_add(n_materials)
                }
            };
            let column = Column {
                name: mesh::MATERIAL.name.to_owned(),
                rule: mesh::MATERIAL.rule,
                values: i32::wrap(materials.iter().map(shift).collect()),
            };
            attributes.insert(Domain::Face, column);
        }
        let mut losses = Losses::of(&object.name, losses);
        let name = format!("{OBJECT_TAG}{}", object.name);
        let known = attributes.column(Domain::Face, &name);
        if tags && known.is_some_and(|known| !matches!(known.values, Values::Tag(_))) {
            let reason = "another attribute has this name";
            losses.add(Domain::Face, &name, mesh.n_faces(), reason);
        } else if tags {
            let column = Column {
                name,
                rule: Rule::Copy,
                values: Values::Tag(vec![true; mesh.n_faces()]),
            };
            attributes.insert(Domain::Face, column);
        }
        let own = i32::try_from(object.materials.len()).unwrap_or(i32::MAX);
        n_materials = n_materials.saturating_add(own);
        let part = domain_lengths(mesh);
        for (domain, name) in all.append(len, &attributes, part) {
            let reason = "its type differs from the type in an earlier object";
            losses.add(domain, &name, n_values(mesh, domain), reason);
        }
        len = std::array::from_fn(|i| len[i] + part[i]);
    }
    all
}
