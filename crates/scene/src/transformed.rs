//! Transforms meshes: points, normals, tangents and the deltas of morph targets.

use glam::{DAffine3, DMat3, DVec3, DVec4};
use mesh::{
    CORNER_TANGENT, Column, Domain, HalfEdgeId, Mesh, Rule, TANGENT, Value, morph_of,
    morph_tangent_of,
};
use rayon::prelude::*;

/// Returns the mesh with transformed points, normals, tangents and deltas of morph targets. All ids stay the same. If
/// the map is a reflection, faces are reversed as in [`Mesh::reverse`]. Unlike [`Mesh::reverse`], this function keeps
/// attributes with [`Rule::Drop`].
///
/// Normals are multiplied by the cofactor matrix of the map: the inverse transpose, multiplied by the determinant
/// (Turkowski, "Properties of Surface-Normal Transformations", 1990). The determinant of a reflection is negative, so
/// the product with the cofactor matrix negates the normals. Reversing the faces negates the normals a second time.
pub fn transformed(mesh: &Mesh, map: &DAffine3) -> Mesh {
    let is_mirror = map.matrix3.determinant() < 0.0;
    let map = LinearMap::of(map);
    mapped(mesh.clone(), is_mirror, |_| map)
}

/// An affine map, and the cofactor matrix of its linear part.
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

/// Transforms each vertex of a mesh by its own map. If `is_mirror` is true, the faces are reversed.
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

/// Whether a column holds normals. Normals are transformed by the cofactor matrix of a map. The tangents of vertices
/// ([`TANGENT`]) have [`Rule::Normal`] too, but they are not normals: [`transform_tangents`] transforms them.
pub fn holds_normals(domain: Domain, column: &Column) -> bool {
    column.rule == Rule::Normal && (domain, &*column.name) != (Domain::Vertex, TANGENT.name)
}

/// Transforms the directions of [`CORNER_TANGENT`], [`TANGENT`] and the tangents of morph targets, if the mesh has
/// them. A reflection negates the signs of corner tangents.
pub fn transform_tangents(mesh: &mut Mesh, linear: &DMat3) {
    change_tangents(mesh, |_| *linear);
}

/// Transforms the direction (x, y, z) of a tangent. A reflection negates the sign of the tangent (w). If the map sends
/// the direction to zero, the tangent stays unchanged.
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

/// Does the same as [`transform_tangents`], but with a separate map for each vertex.
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

/// Whether a corner attribute holds tangents, either of the mesh ([`CORNER_TANGENT`]) or of a morph target.
pub fn holds_tangents(column: &Column) -> bool {
    column.name == CORNER_TANGENT.name || morph_tangent_of(&column.name).is_some()
}
