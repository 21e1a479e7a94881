//! The JSON of morph targets that change texture coordinates and colors.

use gltf_json::mesh::Semantic;
use serde_json::Value;

use super::budget::Budget;
use super::reference::index;
use crate::fault::Fault;

/// The changes that a morph target of a primitive makes to one set of texture coordinates or to the colors.
#[derive(Clone, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub(super) struct ValueChange {
    pub(super) target: usize,
    pub(super) semantic: Semantic,
    pub(super) accessor: usize,
}

/// Whether a morph target of this primitive can change the attribute `name`. Only attributes that the primitive has can
/// be changed.
pub(super) fn is_changeable(primitive: &Value, name: &str) -> bool {
    primitive["attributes"].get(name).is_some() && semantic(name).is_some()
}

/// Returns the semantic of the attribute `name` in glTF if the attribute contains texture coordinates or colors.
/// Otherwise, returns `None`.
fn semantic(name: &str) -> Option<Semantic> {
    let semantic = match name.strip_prefix("TEXCOORD_") {
        Some(set) => Semantic::TexCoords(set.parse().ok()?),
        None => Semantic::Colors(0),
    };
    // Unlike glTF, `parse` accepts leading zeros in the number of a set. This comparison with `name` refuses such
    // names.
    (semantic.to_string() == name).then_some(semantic)
}

/// Returns, for each primitive of each mesh, the changes that its morph targets make to texture coordinates and colors.
/// The changes are sorted by morph target, attribute and accessor.
///
/// # Errors
///
/// Returns an error if a reference to an accessor is not an index, or the memory budget is used up.
pub(super) fn value_changes(
    meshes: &[Value],
    budget: &Budget,
) -> Result<Vec<Vec<Vec<ValueChange>>>, Fault> {
    let of_mesh = |(m, mesh): (usize, &Value)| {
        let primitives = list(mesh, "primitives").iter().enumerate();
        let of_primitive = |(p, primitive): (usize, &Value)| {
            let mut changes = Vec::new();
            for (target, attributes) in list(primitive, "targets").iter().enumerate() {
                for (name, accessor) in attributes.as_object().into_iter().flatten() {
                    let Some(semantic) = semantic(name).filter(|_| is_changeable(primitive, name))
                    else {
                        continue;
                    };
                    let at = format!("/meshes/{m}/primitives/{p}/targets/{target}/{name}");
                    budget.spend(size_of::<ValueChange>() as u64, &at)?;
                    changes.push(ValueChange {
                        target,
                        semantic,
                        accessor: index(accessor, &at)?,
                    });
                }
            }
            changes.sort_unstable();
            Ok(changes)
        };
        primitives.map(of_primitive).collect()
    };
    meshes.iter().enumerate().map(of_mesh).collect()
}

fn list<'a>(json: &'a Value, key: &str) -> &'a [Value] {
    json[key].as_array().map_or(&[], Vec::as_slice)
}
