//! Deforms a mesh by the weights of its morph targets and by the joints of its skin.

use std::collections::BTreeMap;
use std::ops::{Add, Mul};
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, DVec4};
use mesh::{
    Attributes, CORNER_TANGENT, Column, Domain, HalfEdgeId, Mesh, Rule, VERTEX_NORMAL, Value,
    Values, morph_normal_of, morph_tangent_of, morph_value_of, parallel,
};

use crate::transformed::{LinearMap, holds_tangents, mapped, transformed};
use crate::{Graph, Node};

/// How a morph target changes an attribute: the weight of the target, the domain of the changes (vertices or corners),
/// and the changes.
type Change<'a> = (f64, Domain, &'a Values);

/// An attribute column of normals: its domain (vertices or corners) and its values.
type Normals<'a> = (Domain, &'a [DVec3]);

/// How a node deforms its object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// For each joint of the skin, the affine map from points in the bind pose to scene space. `None` if the node has
    /// no skin, the skin has no joints, or the mesh has no weights of joints.
    pub joints: Option<Arc<[DAffine3]>>,
    /// The weights of the morph targets.
    pub weights: Vec<f64>,
}

impl Pose {
    /// Returns the pose that a node gives to a mesh with these attributes. `to_scene` is the result of
    /// [`Graph::to_scene`].
    pub(crate) fn of(
        graph: &Graph,
        node: Option<&Node>,
        object: &str,
        attributes: &Attributes,
        to_scene: &[DAffine3],
    ) -> Self {
        let mut pose = Self::default();
        if let Some(skin) = node.and_then(|node| node.skin)
            && !graph.skins[skin].joints.is_empty()
            && !attributes.joints().is_empty()
        {
            pose.joints = Some(graph.joint_maps(skin, to_scene).into());
        }
        let own = node.map(|node| &node.weights).filter(|own| !own.is_empty());
        let default = || graph.label(object).map(|label| &label.weights);
        pose.weights = own.or_else(default).cloned().unwrap_or_default();
        pose
    }

    /// Whether joints or morph targets change the points of a mesh. The placement of the node does not count as a
    /// change.
    pub(crate) fn deforms(&self) -> bool {
        self.joints.is_some() || self.weights.iter().any(|&w| w != 0.0)
    }

    /// Returns, for each of `n` vertices, the affine map from its point in the bind pose to scene space. The map is the
    /// weighted mean of the maps of the joints of the vertex (linear blend skinning). A vertex without weights follows
    /// the first joint. Returns `None` if the pose has no joints.
    pub fn blended(&self, attributes: &Attributes, n: usize) -> Option<Vec<DAffine3>> {
        let maps = self.joints.as_deref()?;
        let columns = attributes.joints();
        let columns: Vec<(&DAffine3, &[f64])> = (columns.iter())
            .filter_map(|&(joint, weights)| Some((maps.get(joint)?, weights)))
            .collect();
        let first = maps.first().copied().unwrap_or(DAffine3::IDENTITY);
        let blend = |v: usize| {
            let mut linear = DMat3::ZERO;
            let (mut shift, mut sum) = (DVec3::ZERO, 0.0);
            for (map, weights) in &columns {
                let weight = weights[v];
                if weight != 0.0 {
                    linear += map.matrix3 * weight;
                    shift += map.translation * weight;
                    sum += weight;
                }
            }
            if sum <= 0.0 {
                return first;
            }
            DAffine3 {
                matrix3: linear * (1.0 / sum),
                translation: shift / sum,
            }
        };
        Some(parallel::collect(n, blend))
    }

    /// Returns the attributes that morph targets change in this pose: normals and tangents of the mesh and of its morph
    /// targets, and texture coordinates and colors of the mesh. The returned values include the effect of the morph
    /// targets, but not of the joints.
    pub fn morphed_attributes(
        &self,
        attributes: &Attributes,
        vertex_of: impl Fn(usize) -> usize + Sync,
    ) -> Vec<(Domain, Column)> {
        let mut columns = self.morphed_directions(attributes, &vertex_of);
        columns.extend(self.morphed_values(attributes, &vertex_of));
        columns
    }

    /// Returns the texture coordinates and colors of the mesh in this pose: the sums of the old values and the weighted
    /// changes of the morph targets. Colors are clamped to 0 to 1, as in glTF 2.0, section 3.7.2.2. If the old values,
    /// or the changes of any morph target, are stored on the corners, the new values are stored on the corners too.
    /// Columns that do not change are left out. `vertex_of` returns the vertex of a corner.
    fn morphed_values(
        &self,
        attributes: &Attributes,
        vertex_of: impl Fn(usize) -> usize + Sync,
    ) -> Vec<(Domain, Column)> {
        // Attributes of corners take precedence over attributes of vertices with the same name.
        let mut columns: BTreeMap<&str, (Domain, &Column)> = BTreeMap::new();
        for domain in [Domain::Vertex, Domain::Corner] {
            let own = attributes.of(domain).iter();
            columns.extend(own.map(|column| (column.name.as_str(), (domain, column))));
        }
        let mut changes: BTreeMap<&str, Vec<Change>> = BTreeMap::new();
        for (name, &(domain, column)) in &columns {
            let weight = |target: usize| self.weights.get(target).copied().unwrap_or_default();
            if let Some((changed, target)) = morph_value_of(name)
                && weight(target) != 0.0
            {
                let of_name = changes.entry(changed).or_default();
                of_name.push((weight(target), domain, &column.values));
            }
        }
        let changed = changes.into_iter().filter_map(|(name, changes)| {
            let &(own, column) = columns.get(name)?;
            let mut domains = changes.iter().map(|change| change.1);
            let at_corners = own == Domain::Corner || domains.any(|d| d == Domain::Corner);
            let domain = if at_corners { Domain::Corner } else { own };
            let n = attributes.of(domain).first()?.values.len();
            let place = |from: Domain, i: usize| if from == domain { i } else { vertex_of(i) };
            let values = match &column.values {
                Values::Vec2(old) => Values::Vec2(parallel::collect(n, |i| {
                    plus_changes(old[place(own, i)], &changes, |from| place(from, i))
                })),
                Values::Vec4(old) => Values::Vec4(parallel::collect(n, |i| {
                    plus_changes(old[place(own, i)], &changes, |from| place(from, i))
                        .clamp(DVec4::ZERO, DVec4::ONE)
                })),
                _ => return None,
            };
            Some((domain, column.with_values(values)))
        });
        changed.collect()
    }

    /// Returns the normals and tangents of the mesh and of its morph targets in this pose. The returned values include
    /// the effect of the morph targets, but not of the joints. The returned columns replace the attribute columns of
    /// the same names in `attributes`. Columns that do not change are left out. If at least one of the old columns of
    /// normals is stored on corners, all new columns of normals are stored on corners. Otherwise, all of them are
    /// stored on vertices. `vertex_of` returns the vertex of a corner.
    ///
    /// For each morph target, the difference between the normal of the target and the old normal is multiplied by the
    /// weight of the target. The new normal is the normalized sum of the old normal and these weighted differences, as
    /// in glTF 2.0, section 3.7.2.2. The normals of the morph targets change by the same vector as the normal of the
    /// mesh, so the differences stay the same. If the sum is zero, the old normal stays. Tangents are computed like
    /// normals, and keep their signs.
    fn morphed_directions(
        &self,
        attributes: &Attributes,
        vertex_of: impl Fn(usize) -> usize + Sync,
    ) -> Vec<(Domain, Column)> {
        let mut columns = self.morphed_normals(attributes, vertex_of);
        let tangents = self.morphed_tangents(attributes).into_iter();
        columns.extend(tangents.map(|column| (Domain::Corner, column)));
        columns
    }

    fn morphed_tangents(&self, attributes: &Attributes) -> Vec<Column> {
        let columns = || {
            let columns = attributes.of(Domain::Corner).iter();
            let columns = columns.filter(|column| holds_tangents(column));
            columns.filter_map(|column| Some((column, DVec4::of(&column.values)?)))
        };
        let own = columns().find(|(column, _)| column.name == CORNER_TANGENT.name);
        let targets = columns().filter_map(|(column, values)| {
            let weight = self.weights.get(morph_tangent_of(&column.name)?)?;
            (*weight != 0.0).then_some((*weight, values))
        });
        let targets: Vec<(f64, &[DVec4])> = targets.collect();
        let Some((_, own)) = own.filter(|_| !targets.is_empty()) else {
            return Vec::new();
        };
        let changes: Vec<DVec4> = parallel::collect(own.len(), |i| {
            let old = own[i].truncate();
            let sum = targets.iter().fold(old, |sum, (weight, target)| {
                sum + *weight * (target[i].truncate() - old)
            });
            let change = sum.try_normalize().map_or(DVec3::ZERO, |new| new - old);
            change.extend(0.0)
        });
        let moved = |(column, values): (&Column, &[DVec4])| {
            let values = values
                .iter()
                .zip(&changes)
                .map(|(tangent, change)| tangent + change);
            Column {
                values: DVec4::wrap(values.collect()),
                ..column.clone()
            }
        };
        columns().map(moved).collect()
    }

    fn morphed_normals(
        &self,
        attributes: &Attributes,
        vertex_of: impl Fn(usize) -> usize + Sync,
    ) -> Vec<(Domain, Column)> {
        // Normals of corners take precedence over normals of vertices with the same name.
        let mut columns: BTreeMap<&str, Normals> = BTreeMap::new();
        for domain in [Domain::Vertex, Domain::Corner] {
            for column in attributes.of(domain) {
                if (column.name == VERTEX_NORMAL.name || morph_normal_of(&column.name).is_some())
                    && let Some(values) = DVec3::of(&column.values)
                {
                    columns.insert(&column.name, (domain, values));
                }
            }
        }
        let Some(&own) = columns.get(VERTEX_NORMAL.name) else {
            return Vec::new();
        };
        let mut targets: Vec<(f64, Normals)> = Vec::new();
        for (name, normals) in &columns {
            let weight = morph_normal_of(name).and_then(|target| self.weights.get(target));
            if let Some(&weight) = weight
                && weight != 0.0
            {
                targets.push((weight, *normals));
            }
        }
        if targets.is_empty() {
            return Vec::new();
        }
        let mut of_corners = columns
            .values()
            .filter(|(domain, _)| *domain == Domain::Corner);
        let (domain, values) = of_corners.next().copied().unwrap_or(own);
        let n = values.len();
        let at = |(from, values): Normals, i: usize| {
            values[if from == domain { i } else { vertex_of(i) }]
        };
        let changes: Vec<DVec3> = parallel::collect(n, |i| {
            let normal = at(own, i);
            let sum = targets.iter().fold(normal, |sum, (weight, target)| {
                sum + *weight * (at(*target, i) - normal)
            });
            sum.try_normalize().map_or(DVec3::ZERO, |new| new - normal)
        });
        let column = |(name, normals): (&&str, &Normals)| {
            let values = (0..n).map(|i| at(*normals, i) + changes[i]).collect();
            let column = Column {
                name: (*name).to_owned(),
                rule: Rule::Normal,
                values: DVec3::wrap(values),
            };
            (domain, column)
        };
        columns.iter().map(column).collect()
    }

    /// Moves points by the weighted deltas of the morph targets.
    pub fn morph(&self, attributes: &Attributes, points: &mut [DVec3]) {
        for (target, deltas) in attributes.morphs() {
            let weight = self.weights.get(target).copied().unwrap_or(0.0);
            if weight != 0.0 {
                for (point, delta) in points.iter_mut().zip(deltas) {
                    *point += weight * *delta;
                }
            }
        }
    }
}

/// Adds the weighted changes to an old value. `place` takes the domain of a change (vertices or corners), and returns
/// the index of the value to add.
fn plus_changes<T>(old: T, changes: &[Change], place: impl Fn(Domain) -> usize) -> T
where
    T: Value + Add<Output = T>,
    f64: Mul<T, Output = T>,
{
    changes.iter().fold(old, |sum, &(weight, from, values)| {
        let change = T::of(values).map(|values| values[place(from)]);
        sum + weight * change.unwrap_or_default()
    })
}

/// Returns the mesh in the given pose, with points in scene space. If the pose has no joints, `to_scene` maps the
/// points to scene space. All ids stay the same.
pub(crate) fn posed(mesh: &Mesh, pose: &Pose, to_scene: &DAffine3) -> Mesh {
    let mut morphed = mesh.clone();
    let attributes = mesh.attributes();
    pose.morph(attributes, morphed.positions_mut());
    let vertex_of = |corner| mesh.origin(HalfEdgeId::new(corner)).index();
    for (domain, column) in pose.morphed_attributes(attributes, vertex_of) {
        morphed.remove_column(Domain::Vertex, &column.name);
        morphed.insert_column(domain, column);
    }
    match pose.blended(attributes, mesh.n_vertices()) {
        None if *to_scene == DAffine3::IDENTITY => morphed,
        None => transformed(&morphed, to_scene),
        Some(maps) => {
            let is_mirror = maps.first().is_some_and(|m| m.matrix3.determinant() < 0.0);
            mapped(morphed, is_mirror, |v| LinearMap::of(&maps[v]))
        }
    }
}
