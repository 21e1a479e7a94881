//! Reads the changes that morph targets make to texture coordinates and colors.

use std::collections::BTreeSet;

use glam::{DVec2, DVec4};
use gltf_json::accessor::Type;
use gltf_json::mesh::Semantic;
use mesh::{Column, Rule, Value as _, morph_value_name};

use super::deform::{Repairs, expect_len};
use super::morph_json::ValueChange;
use super::names::attribute_name;
use super::views::Reader;
use crate::fault::Fault;

/// The changes that the morph targets of a mesh make to texture coordinates and colors.
pub(super) struct ValueChanges<'a> {
    of_primitives: &'a [Vec<ValueChange>],
    /// Pairs of an attribute and the index of a morph target. The target changes the attribute in at least one
    /// primitive of the mesh.
    columns: BTreeSet<(&'a Semantic, usize)>,
}

impl<'a> ValueChanges<'a> {
    /// Collects the changes of all primitives of a mesh.
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

    /// Returns the names of the mesh attributes that will store the changes made by morph targets.
    pub(super) fn names(&self) -> impl Iterator<Item = String> {
        self.columns.iter().map(|&(semantic, t)| name(semantic, t))
    }

    /// Reads the changes of a primitive with `n` vertices. Each entry of `columns` is an attribute with the index of a
    /// morph target. Returns a column of values for each entry. If the target does not change the attribute in this
    /// primitive, the column is zero. `here` is the location of the primitive, for errors.
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
