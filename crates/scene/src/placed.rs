//! Lists the instances of objects. An object has one instance for each node that references it, or one instance if no
//! node references it.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, DVec4};
use mesh::{
    CORNER_TANGENT, Column, Domain, HalfEdgeId, Mesh, Rule, TANGENT, Value, morph_of,
    morph_tangent_of,
};
use rayon::prelude::*;

use crate::pose::posed;
use crate::{Geometry, Object, Pose, Scene};

/// An instance: an object with its placement in the scene.
#[derive(Clone, Debug)]
pub struct Instance<'s> {
    /// The object.
    pub object: &'s Object,
    /// A name that is unique among all instances. The only instance of an object has the name of the object. If an
    /// object has several instances, each has the name of its node (or of the object, if the node has no name),
    /// followed by a number if necessary.
    pub name: String,
    /// The map from the space of the object to the scene. For a skinned mesh, the map of the first joint.
    pub to_scene: DAffine3,
    /// The deformation of the object.
    pub pose: Pose,
}

impl Instance<'_> {
    /// Returns the object with the name of the instance. The points of a mesh are mapped to scene space; other geometry
    /// is unchanged. Morph targets deform the mesh by the weights of the node, or by the default weights if the node
    /// has none. A skin deforms the mesh by the placements of the joints.
    pub fn placed(&self) -> Object {
        let geometry = match &self.object.geometry {
            Geometry::Mesh(mesh) if self.pose.deforms() => {
                Geometry::Mesh(Arc::new(posed(mesh, &self.pose, &self.to_scene)))
            }
            Geometry::Mesh(mesh) if self.to_scene != DAffine3::IDENTITY => {
                Geometry::Mesh(Arc::new(transformed(mesh, &self.to_scene)))
            }
            geometry => geometry.clone(),
        };
        Object {
            name: self.name.clone(),
            geometry,
            materials: self.object.materials.clone(),
        }
    }
}

impl Scene {
    /// Returns all instances, ordered by object. The instances of an object are in the order of its nodes. An
    /// object that no node references has one instance.
    pub fn instances(&self) -> Vec<Instance<'_>> {
        let graph = self.graph();
        let nodes = graph.nodes_of_objects();
        let to_scene = graph.to_scene();
        let instance = |object, name, node: Option<usize>| {
            let pose = match &Object::as_mesh(object) {
                Some(mesh) => {
                    let node = node.map(|i| &graph.nodes()[i]);
                    Pose::of(graph, node, &object.name, mesh.attributes(), &to_scene)
                }
                None => Pose::default(),
            };
            let placed = node.map_or(DAffine3::IDENTITY, |i| to_scene[i]);
            let first = pose.joints.as_ref().and_then(|joints| joints.first());
            Instance {
                object,
                name,
                to_scene: first.copied().unwrap_or(placed),
                pose,
            }
        };
        let nodes_of = |object: &Object| nodes.get(object.name.as_str()).map_or(&[][..], |n| n);
        let mut taken: BTreeSet<String> = (self.objects().iter())
            .filter(|object| nodes_of(object).len() <= 1)
            .map(|object| object.name.clone())
            .collect();
        let mut instances = Vec::new();
        for object in self.objects() {
            let nodes = nodes_of(object);
            if nodes.len() <= 1 {
                instances.push(instance(
                    object,
                    object.name.clone(),
                    nodes.first().copied(),
                ));
                continue;
            }
            // `number` does not restart at 1 for each instance, so that naming many instances takes linear time.
            let mut number = 1;
            for &i in nodes {
                let node = graph.nodes()[i]
                    .name
                    .as_deref()
                    .filter(|name| !name.is_empty());
                let wanted = node.unwrap_or(&object.name);
                let mut name = wanted.to_owned();
                while !taken.insert(name.clone()) {
                    number += 1;
                    name = format!("{wanted}.{number}");
                }
                instances.push(instance(object, name, Some(i)));
            }
        }
        instances
    }

    /// Returns the scene without nodes: each instance is an object with points in scene space. Cameras, lights, skins
    /// and animations are left out.
    pub fn placed(&self) -> Cow<'_, Self> {
        if self.graph().is_empty() {
            return Cow::Borrowed(self);
        }
        let objects = self.instances().iter().map(Instance::placed).collect();
        Cow::Owned(Self {
            objects,
            graph: Arc::default(),
        })
    }

    /// Returns the size of the meshes of [`placed`](Self::placed) in bytes.
    pub fn placed_bytes(&self) -> u64 {
        let meshes = self.instances();
        let meshes = meshes
            .iter()
            .filter_map(|instance| instance.object.as_mesh());
        meshes.fold(0, |sum, mesh| sum.saturating_add(mesh.bytes() as u64))
    }
}

/// Returns a mesh with all points, normals, tangents and deltas of morph targets transformed. All ids stay the same. If
/// the map is a reflection, faces are reversed as by [`Mesh::reverse`], but no attribute is dropped.
///
/// Normals are multiplied by the cofactor matrix of the map, which is the inverse transpose of the map times its
/// determinant (Turkowski, "Properties of Surface-Normal Transformations", 1990). The determinant of a reflection is
/// negative, so the product with the cofactor matrix negates the normals. Reversing the faces negates the normals a
/// second time.
pub fn transformed(mesh: &Mesh, map: &DAffine3) -> Mesh {
    let is_mirror = map.matrix3.determinant() < 0.0;
    let map = LinearMap::of(map);
    mapped(mesh.clone(), is_mirror, |_| map)
}

/// A linear map with its cofactor matrix.
#[derive(Clone, Copy)]
pub(crate) struct LinearMap {
    map: DAffine3,
    cofactors: DMat3,
}

impl LinearMap {
    pub(crate) fn of(map: &DAffine3) -> Self {
        let DMat3 {
            x_axis: x,
            y_axis: y,
            z_axis: z,
        } = map.matrix3;
        Self {
            map: *map,
            cofactors: DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)),
        }
    }

    fn normal(&self, n: DVec3) -> DVec3 {
        let image = self.cofactors * n;
        let largest = image.abs().max_element();
        if largest > 0.0 {
            (image / largest).normalize()
        } else {
            DVec3::ZERO
        }
    }
}

/// Transforms each vertex of a mesh by its own map. If `is_mirror`, the faces are reversed.
pub(crate) fn mapped(
    mut mesh: Mesh,
    is_mirror: bool,
    map_of: impl Fn(usize) -> LinearMap + Sync,
) -> Mesh {
    change_tangents(&mut mesh, |v| map_of(v).map.matrix3);
    let points = mesh.positions_mut().par_iter_mut().enumerate();
    let points = points.with_min_len(4096);
    points.for_each(|(v, p)| *p = map_of(v).map.transform_point3(*p));
    let is_delta = |domain, name: &str| domain == Domain::Vertex && morph_of(name).is_some();
    let columns: Vec<(Domain, String, Rule)> = (mesh.attributes().iter())
        .filter(|(domain, column)| {
            holds_normals(*domain, column)
                || is_mirror && column.rule == Rule::Drop
                || is_delta(*domain, &column.name)
        })
        .map(|(domain, column)| (domain, column.name.clone(), column.rule))
        .collect();
    for (domain, name, rule) in &columns {
        let mut column = mesh.remove_column(*domain, name).expect("listed above");
        let is_delta = is_delta(*domain, name);
        if *rule == Rule::Drop && is_mirror {
            // Reversing faces removes no element, so the values stay valid and are copied.
            column.rule = Rule::Copy;
        }
        if (*rule == Rule::Normal || is_delta)
            && let Some(vectors) = DVec3::of_mut(&mut column.values)
        {
            let vectors = vectors.par_iter_mut().enumerate().with_min_len(4096);
            vectors.for_each(|(i, vector)| {
                let v = match domain {
                    Domain::Corner => mesh.origin(HalfEdgeId::new(i)).index(),
                    _ => i,
                };
                let map = map_of(v);
                *vector = if is_delta {
                    map.map.matrix3 * *vector
                } else {
                    map.normal(*vector)
                };
            });
        }
        mesh.insert_column(*domain, column);
    }
    if is_mirror {
        mesh.reverse();
        for (domain, name, _) in columns.iter().filter(|(.., rule)| *rule == Rule::Drop) {
            let mut column = mesh.remove_column(*domain, name).expect("listed above");
            column.rule = Rule::Drop;
            mesh.insert_column(*domain, column);
        }
    }
    mesh
}

/// Whether a column holds normals, which the cofactor matrix of a map transforms. The tangents of vertices
/// ([`TANGENT`]) have [`Rule::Normal`] too, but they are not normals: [`transform_tangents`] transforms them.
pub fn holds_normals(domain: Domain, column: &Column) -> bool {
    column.rule == Rule::Normal && (domain, &*column.name) != (Domain::Vertex, TANGENT.name)
}

/// Transforms the directions of [`CORNER_TANGENT`], [`TANGENT`] and the tangents of morph targets, if the mesh has
/// them. A reflection negates the signs of the tangents of corners.
pub fn transform_tangents(mesh: &mut Mesh, linear: &DMat3) {
    change_tangents(mesh, |_| *linear);
}

/// Transforms the direction of a tangent. A reflection negates the sign of the tangent. A direction that the map sends
/// to zero stays unchanged.
pub fn transform_tangent(tangent: DVec4, linear: &DMat3) -> DVec4 {
    let image = *linear * tangent.truncate();
    let largest = image.abs().max_element();
    if largest == 0.0 {
        return tangent;
    }
    let sign = if linear.determinant() < 0.0 {
        -1.0
    } else {
        1.0
    };
    (image / largest).normalize().extend(sign * tangent.w)
}

/// Works like [`transform_tangents`], with a different map for each vertex.
fn change_tangents(mesh: &mut Mesh, linear: impl Fn(usize) -> DMat3) {
    if let Some(tangents) = mesh.get_mut(TANGENT) {
        for (v, tangent) in tangents.iter_mut().enumerate() {
            *tangent = transform_tangent(tangent.extend(1.0), &linear(v)).truncate();
        }
    }
    let columns = mesh.attributes().of(Domain::Corner).iter();
    let names: Vec<String> = columns
        .filter(|c| holds_tangents(c))
        .map(|c| c.name.clone())
        .collect();
    for name in names {
        let Some(mut column) = mesh.remove_column(Domain::Corner, &name) else {
            continue;
        };
        let tangents = DVec4::of_mut(&mut column.values).into_iter().flatten();
        for (h, tangent) in tangents.enumerate() {
            let v = mesh.origin(HalfEdgeId::new(h));
            *tangent = transform_tangent(*tangent, &linear(v.index()));
        }
        mesh.insert_column(Domain::Corner, column);
    }
}

/// Whether a column of corners holds the tangents of the mesh ([`CORNER_TANGENT`]) or of a morph target.
pub fn holds_tangents(column: &Column) -> bool {
    column.name == CORNER_TANGENT.name || morph_tangent_of(&column.name).is_some()
}
