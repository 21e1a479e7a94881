//! The attributes and the materials of several meshes, one behind the other.

use mesh::{Attributes, Column, Domain, MATERIAL, Mesh, Rule, Values};
use op::{Loss, Report};
use scene::{Material, Object};

/// The different materials of all parts in the order of their first use, and for each part the number
/// of each of its materials among them.
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

/// The columns of all parts. `numbers` are those of [`merged_materials`]. What is left out goes into
/// `report.losses`, and which part gets zero values into `report.notes`.
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
            let reason = "a part before it has one of that name with values of another type";
            let loss = Loss::attribute(&object.name, domain, &name, reason);
            report.losses.push(loss);
        }
        len = [0, 1, 2, 3].map(|d| len[d] + part_len[d]);
    }
    all
}

/// Gives the faces the numbers of the merged materials; -1 for none, also in parts without the attribute if
/// another part has it.
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

/// Takes out columns of normals that not every part has: a normal of length zero is none.
fn leave_out_normals(columns: &mut [Attributes], parts: &[&Object], report: &mut Report) {
    for (domain, name) in names(columns, |c| c.rule == Rule::Normal) {
        let Some(without) = (0..parts.len()).find(|&i| lacks(columns, parts, i, domain, &name))
        else {
            continue;
        };
        let reason = format!("\"{}\" has none to join it with", parts[without].name);
        for (attributes, object) in columns.iter_mut().zip(parts) {
            if attributes.remove(domain, &name).is_some() {
                let loss = Loss::attribute(&object.name, domain, &name, &*reason);
                report.losses.push(loss);
            }
        }
    }
}

/// Notes which parts get zero values for an attribute. Of a tag that means what it should, and a
/// material has a value for none.
fn note_zeros(columns: &[Attributes], parts: &[&Object], report: &mut Report) {
    for (domain, name) in names(columns, |c| !matches!(c.values, Values::Tag(_))) {
        for (i, object) in parts.iter().enumerate() {
            if lacks(columns, parts, i, domain, &name) {
                let part = &object.name;
                report.notes.push(format!(
                    "\"{part}\" has no {domain} attribute \"{name}\": its values are zero"
                ));
            }
        }
    }
}

/// The columns that a rule picks, each once, in the order of the parts.
fn names(columns: &[Attributes], pick: impl Fn(&Column) -> bool) -> Vec<(Domain, String)> {
    let mut names = Vec::new();
    for (domain, column) in columns.iter().flat_map(Attributes::iter) {
        let key = (domain, column.name.clone());
        if pick(column) && !names.contains(&key) {
            names.push(key);
        }
    }
    names
}

/// Whether part i has elements of a domain, but not this column.
fn lacks(columns: &[Attributes], parts: &[&Object], i: usize, domain: Domain, name: &str) -> bool {
    let n = parts[i].as_mesh().map_or(0, |mesh| mesh.domain_len(domain));
    n > 0 && columns[i].column(domain, name).is_none()
}

/// Marks the faces of each part with a tag of its name, beside those that already have the tag.
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
                    "the faces of \"{name}\" get no tag: there is a face attribute of that name"
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
