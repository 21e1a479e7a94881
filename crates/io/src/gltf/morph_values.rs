//! Reads the changes that morph targets make to texture coordinates and colors.

use std::collections::BTreeSet;

use glam::{DVec2, DVec4};
use gltf_json::accessor::Type;
use gltf_json::mesh::Semantic;
use mesh::{Column, Rule, Value as _, morph_value_name};
use serde_json::Value;

use super::budget::Budget;
use super::deform::{Repairs, expect_len};
use super::document::index;
use super::names::attribute_name;
use super::views::Reader;
use crate::fault::Fault;

/// An attribute of a morph target of a primitive: the changes of texture coordinates or colors.
#[derive(Clone, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub(super) struct ValueChange {
    target: usize,
    semantic: Semantic,
    accessor: usize,
}

/// Whether a morph target of this primitive can change the attribute `name`. Only attributes that the primitive has can
/// be changed.
pub(super) fn is_changeable(primitive: &Value, name: &str) -> bool {
    primitive["attributes"].get(name).is_some() && semantic(name).is_some()
}

/// Returns the texture coordinates or the color with this name in glTF; `None` for all other names.
fn semantic(name: &str) -> Option<Semantic> {
    let semantic = match name.strip_prefix("TEXCOORD_") {
        Some(set) => Semantic::TexCoords(set.parse().ok()?),
        None => Semantic::Colors(0),
    };
    // Parsing accepts leading zeros in the number of a set, but glTF does not allow them. Therefore, the result is
    // compared with the name.
    (semantic.to_string() == name).then_some(semantic)
}

/// Returns the changes of each primitive of each mesh, sorted by morph target, attribute and accessor.
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

/// The changes that the morph targets of a mesh make to texture coordinates and colors.
pub(super) struct ValueChanges<'a> {
    of_primitives: &'a [Vec<ValueChange>],
    /// The pairs of an attribute and a morph target that changes this attribute in at least one primitive of the mesh.
    columns: BTreeSet<(&'a Semantic, usize)>,
}

impl<'a> ValueChanges<'a> {
    /// Collects the changes of the primitives of a mesh.
    pub(super) fn new(of_primitives: &'a [Vec<ValueChange>]) -> Self {
        let changes = of_primitives.iter().flatten();
        Self {
            of_primitives,
            columns: changes.map(|c| (&c.semantic, c.target)).collect(),
        }
    }

    /// The changes of a primitive.
    pub(super) fn of_primitive(&self, primitive: usize) -> &'a [ValueChange] {
        self.of_primitives.get(primitive).map_or(&[], Vec::as_slice)
    }

    /// Returns the names of the attributes with the changes.
    pub(super) fn names(&self) -> impl Iterator<Item = String> {
        self.columns.iter().map(|&(semantic, t)| name(semantic, t))
    }

    /// Reads the changes of a primitive, into one column of `n` values for each pair of an attribute and a morph target
    /// in the mesh. If the target does not change the attribute in this primitive, the column is zero. `here` is the
    /// location of the primitive, for errors.
    ///
    /// # Errors
    ///
    /// Returns an error if an accessor is invalid.
    pub(super) fn read(
        &self,
        reader: &Reader,
        primitive: usize,
        n: usize,
        here: &str,
        repairs: &mut Repairs,
    ) -> Result<Vec<Column>, Fault> {
        let bytes = (self.columns.len() as u64).saturating_mul((n * size_of::<DVec4>()) as u64);
        if !reader.budget.has(2 * bytes) {
            let what = format!(
                "texture coordinates and colors of morph targets left out: they need {bytes} bytes, which exceeds the memory \
                 limit for a file of this size"
            );
            *repairs.left_out.entry(what).or_default() += self.columns.len();
            return Ok(Vec::new());
        }
        let own = self.of_primitive(primitive);
        let mut columns = Vec::new();
        for &(semantic, target) in &self.columns {
            let is_it = |c: &&ValueChange| c.target == target && c.semantic == *semantic;
            let accessor = own.iter().find(is_it).map(|change| change.accessor);
            let at = format!("{here}/targets/{target}/{}", semantic.to_string());
            let is_color = *semantic == Semantic::Colors(0);
            let values = match accessor {
                Some(accessor) if is_color => {
                    // If the change of a color has only three numbers, alpha does not change.
                    let kinds = &[Type::Vec3, Type::Vec4];
                    let changes = reader.vectors(accessor, &at, kinds, 0.0, DVec4::from_array)?;
                    DVec4::wrap(changes)
                }
                Some(accessor) => {
                    let up = |[u, v]: [f64; 2]| DVec2::new(u, -v);
                    DVec2::wrap(reader.vectors(accessor, &at, &[Type::Vec2], 0.0, up)?)
                }
                None => {
                    let size = if is_color {
                        size_of::<DVec4>()
                    } else {
                        size_of::<DVec2>()
                    };
                    reader.budget.spend((n * size) as u64, &at)?;
                    if is_color {
                        DVec4::wrap(mesh::zeroed(n))
                    } else {
                        DVec2::wrap(mesh::zeroed(n))
                    }
                }
            };
            expect_len(values.len(), n, &at)?;
            columns.push(Column {
                name: name(semantic, target),
                rule: Rule::Interpolate,
                values,
            });
        }
        Ok(columns)
    }
}

fn name(semantic: &Semantic, target: usize) -> String {
    morph_value_name(&attribute_name(semantic).unwrap_or_default(), target)
}
