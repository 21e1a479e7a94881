//! Joins the attributes and the materials of several meshes.

use mesh::{Attributes, Column, Domain, MATERIAL, Mesh, Rule, Values};
use op::{Loss, Report};
use scene::{Material, Object};

/// Returns the materials of all parts without duplicates, in order of their first use. Also returns, for each part, the
/// new indices of its materials.
pub(crate) fn merged_materials(parts: &[&Object]) -> (Vec<Material>, Vec<Vec<i32>>) {
    let mut merged: Vec<Material> = Vec::new();
    let mut number = |material: &Material| {
        let known = merged.iter().position(|m| m == material);
        let i = known.unwrap_or_else(|| {
            merged.push(material.clone());
            merged.len() - 1
        });
        i32::try_from(i).unwrap_or(-1)
    };
    let numbers = parts
        .iter()
        .map(|p| p.materials.iter().map(&mut number).collect())
        .collect();
    (merged, numbers)
}

/// Returns the attribute columns of the joined mesh: the concatenated columns of all parts. `numbers` contains the new
/// material indices that [`merged_materials`] returns. Adds a loss to the report for each dropped column, and a note
/// for each part that gets zero values.
pub(crate) fn appended(parts: &[&Object], numbers: &[Vec<i32>], report: &mut Report) -> Attributes {
    let meshes = || {
        let parts = parts.iter();
        parts.filter_map(|o| Some((*o, o.as_mesh()?.as_ref())))
    };
    let mut columns: Vec<Attributes> = meshes().map(|(_, m)| m.attributes().clone()).collect();
    renumber_materials(&mut columns, numbers, meshes().map(|(_, m)| m.n_faces()));
    leave_out_normals(&mut columns, parts, report);
    note_zeros(&columns, parts, report);

    let lens = |mesh: &Mesh| Domain::ALL.map(|domain| mesh.domain_len(domain));
    let mut all = Attributes::default();
    let mut len = [0; 4];
    for ((object, mesh), part) in meshes().zip(&columns) {
        let part_len = lens(mesh);
        for (domain, name) in all.append(len, part, part_len) {
            let reason = "an earlier part has an attribute of the same name with a different type";
            let loss = Loss::attribute(&object.name, domain, &name, reason);
            report.losses.push(loss);
        }
        len = [0, 1, 2, 3].map(|d| len[d] + part_len[d]);
    }
    all
}

/// Replaces the material indices of the faces with the indices of the merged materials. Faces without a material
/// get -1. If only some parts have material indices, all faces of the parts without material indices get -1.
fn renumber_materials(
    columns: &mut [Attributes],
    numbers: &[Vec<i32>],
    n_faces: impl Iterator<Item = usize>,
) {
    let column = |values| Column {
        name: MATERIAL.name.to_owned(),
        rule: MATERIAL.rule,
        values,
    };
    let of = |a: &Attributes| Some(a.column(Domain::Face, MATERIAL.name)?.values.clone());
    let has_materials = |a: &Attributes| matches!(of(a), Some(Values::Int(_)));
    if !columns.iter().any(has_materials) {
        return;
    }
    for ((attributes, numbers), n) in columns.iter_mut().zip(numbers).zip(n_faces) {
        let values = match of(attributes) {
            None => vec![-1; n],
            Some(Values::Int(old)) => {
                let new = |i: i32| numbers.get(usize::try_from(i).ok()?).copied();
                old.into_iter().map(|i| new(i).unwrap_or(-1)).collect()
            }
            Some(_) => continue,
        };
        attributes.insert(Domain::Face, column(Values::Int(values)));
    }
}

/// If a part lacks an attribute of normals, removes this attribute from all parts. Otherwise, the joined mesh would get
/// zero vectors, which are not valid normals.
fn leave_out_normals(columns: &mut [Attributes], parts: &[&Object], report: &mut Report) {
    for (domain, name) in names(columns, |c| c.rule == Rule::Normal) {
        let Some(without) = (0..parts.len()).find(|&i| lacks(columns, parts, i, domain, &name))
        else {
            continue;
        };
        let reason = format!("\"{}\" does not have this attribute", parts[without].name);
        for (attributes, object) in columns.iter_mut().zip(parts) {
            if attributes.remove(domain, &name).is_some() {
                let loss = Loss::attribute(&object.name, domain, &name, &*reason);
                report.losses.push(loss);
            }
        }
    }
}

/// Adds a note for each part that gets zero values for an attribute. Tags need no note: the elements of a part without
/// the tag are not tagged. Materials need no note: the faces of a part without materials have no material.
fn note_zeros(columns: &[Attributes], parts: &[&Object], report: &mut Report) {
    for (domain, name) in names(columns, |c| !matches!(c.values, Values::Tag(_))) {
        for (i, object) in parts.iter().enumerate() {
            if lacks(columns, parts, i, domain, &name) {
                let part = &object.name;
                report.notes.push(format!(
                    "\"{part}\" has no {domain} attribute \"{name}\", so this attribute is zero for all elements of \"{part}\""
                ));
            }
        }
    }
}

/// Returns the domain and the name of each attribute column for which `predicate` returns true, without duplicates, in
/// the order of the parts.
fn names(columns: &[Attributes], predicate: impl Fn(&Column) -> bool) -> Vec<(Domain, String)> {
    let mut names = Vec::new();
    for (domain, column) in columns.iter().flat_map(Attributes::iter) {
        let key = (domain, column.name.clone());
        if predicate(column) && !names.contains(&key) {
            names.push(key);
        }
    }
    names
}

/// Whether part `i` has elements of this domain, but lacks the attribute `name` for them.
fn lacks(columns: &[Attributes], parts: &[&Object], i: usize, domain: Domain, name: &str) -> bool {
    let n = parts[i].as_mesh().map_or(0, |mesh| mesh.domain_len(domain));
    n > 0 && columns[i].column(domain, name).is_none()
}

/// Tags the faces of each part with the name of the part. Faces that already have the tag keep it.
pub(crate) fn tag_parts(joined: &mut Mesh, parts: &[&Object], report: &mut Report) {
    let mut first = 0;
    for object in parts {
        let end = first + object.as_mesh().map_or(0, |mesh| mesh.n_faces());
        let name = object.name.clone();
        let column = joined.attributes().column(Domain::Face, &name);
        let mut marks = match column.map(|c| &c.values) {
            None => vec![false; joined.n_faces()],
            Some(Values::Tag(marks)) => marks.clone(),
            Some(_) => {
                report.notes.push(format!(
                    "the faces of \"{name}\" are not tagged with this name, because a face attribute that is not a tag has the same name"
                ));
                first = end;
                continue;
            }
        };
        marks[first..end].fill(true);
        let column = Column {
            name,
            rule: Rule::Copy,
            values: Values::Tag(marks),
        };
        joined.insert_column(Domain::Face, column);
        first = end;
    }
}
