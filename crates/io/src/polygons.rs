//! Stores the polygons of a file with their attributes, before a mesh is built from them.

use glam::{DAffine3, DMat3, DVec3, DVec4};
use mesh::{
    Attribute, Attributes, Column, Domain, Id, Rule, Value, joint_name, morph_name, parallel,
};
use scene::{Material, Pose, holds_tangents, transform_tangent};

use crate::note::PolygonArrays;

/// The polygons of a file as flat arrays, in the order of the file. The polygons need not form a manifold.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygons {
    /// The position of each vertex.
    pub positions: Vec<DVec3>,
    /// Polygon f has the corners from `offsets[f]` to `offsets[f + 1]`, exclusive. The number of offsets is the number
    /// of polygons plus 1.
    pub offsets: Vec<u32>,
    /// The index of the vertex of each corner, counter-clockwise around each polygon.
    pub corners: Vec<u32>,
    /// The attributes of vertices, corners and faces. Values of corners are in the order of `corners`.
    pub attributes: Attributes,
    /// The materials. The values of the face attribute `material` are indices into this list.
    pub materials: Vec<Material>,
}

/// The prefix of tags that mark the faces of an object.
pub(crate) const OBJECT_TAG: &str = "o:";

/// A reader converts the groups, objects or solids of a file to tags. Returns the maximum number of such tags for a
/// mesh with `n_faces` faces. The number is limited because a tag needs one byte for each face.
pub(crate) fn most_tags(n_faces: usize) -> usize {
    const MOST: usize = 4096;
    const MOST_BYTES: usize = 1 << 28;
    MOST.min(MOST_BYTES / n_faces.max(1))
}

impl Default for Polygons {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            offsets: vec![0],
            corners: Vec::new(),
            attributes: Attributes::default(),
            materials: Vec::new(),
        }
    }
}

impl Polygons {
    /// The number of polygons.
    pub fn n_faces(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Returns the arrays from which notes take the positions of elements.
    pub(crate) fn arrays(&self) -> PolygonArrays<'_> {
        PolygonArrays {
            positions: &self.positions,
            offsets: &self.offsets,
            corners: &self.corners,
        }
    }

    /// Returns the offsets of `n` polygons with `degree` corners each. The total number of corners must fit in 32 bits.
    pub(crate) fn even_offsets(n: usize, degree: usize) -> Vec<u32> {
        parallel::collect(n + 1, |f| u32::try_from(f * degree).unwrap_or(u32::MAX))
    }

    /// Adds an attribute.
    pub(crate) fn insert<T: Value>(
        &mut self,
        domain: Domain,
        name: impl Into<String>,
        rule: Rule,
        values: Vec<T>,
    ) {
        let column = Column {
            name: name.into(),
            rule,
            values: T::wrap(values),
        };
        self.attributes.insert(domain, column);
    }

    /// Adds a predefined attribute.
    pub(crate) fn insert_known<I: Id, T: Value>(
        &mut self,
        attribute: Attribute<I, T>,
        values: Vec<T>,
    ) {
        self.insert(I::DOMAIN, attribute.name, attribute.rule, values);
    }

    /// Applies the transform of a node to positions, normals, tangents and the deltas of morph targets. If the
    /// transform is a reflection, reverses the faces. Returns the number of normals that are left out because the
    /// transform is singular.
    pub(crate) fn apply_transform(&mut self, to_scene: &DAffine3) -> usize {
        if *to_scene == DAffine3::IDENTITY {
            return 0;
        }
        parallel::change(&mut self.positions, |p| *p = to_scene.transform_point3(*p));
        self.change_deltas(|_| to_scene.matrix3);
        self.change_tangents(|_| &to_scene.matrix3);
        let normal_matrix = to_scene.matrix3.inverse().transpose();
        let mut lost = 0;
        for mut column in self.take_normals() {
            if normal_matrix.is_finite() {
                let normals = DVec3::of_mut(&mut column.values).unwrap_or_default();
                parallel::change(normals, |n| *n = (normal_matrix * *n).normalize_or_zero());
                self.attributes.insert(Domain::Corner, column);
            } else {
                lost += column.values.len();
            }
        }
        if to_scene.matrix3.determinant() < 0.0 {
            self.reverse_faces();
        }
        lost
    }

    fn reverse_faces(&mut self) {
        let mut order: Vec<u32> = (0..).take(self.corners.len()).collect();
        for ends in self.offsets.windows(2) {
            // Reversing a polygon does not change its first corner.
            order[ends[0] as usize + 1..ends[1] as usize].reverse();
        }
        let corners = &self.corners;
        self.corners = order.iter().map(|&c| corners[c as usize]).collect();
        gather(&mut self.attributes, Domain::Corner, &order);
    }

    /// Moves the vertices by the weighted morph targets, and then by the joints. If the vertices have no joints,
    /// `to_scene` is applied instead. Removes the joint weights, which have no meaning without a skin. Returns the
    /// number of normals that are left out.
    pub(crate) fn apply_pose(&mut self, pose: &Pose, to_scene: &DAffine3) -> usize {
        let n = self.positions.len();
        pose.morph(&self.attributes, &mut self.positions);
        let vertex_of = |corner: usize| self.corners[corner] as usize;
        for (domain, column) in pose.morphed_attributes(&self.attributes, vertex_of) {
            self.attributes.insert(domain, column);
        }
        let maps = pose.blended(&self.attributes, n);
        let joints = self.attributes.joints().into_iter();
        let joints: Vec<String> = joints.map(|(joint, _)| joint_name(joint)).collect();
        let has_joints = !joints.is_empty();
        for name in joints {
            self.attributes.remove(Domain::Vertex, &name);
        }
        let Some(maps) = maps.filter(|_| has_joints) else {
            return self.apply_transform(to_scene);
        };
        for (p, map) in self.positions.iter_mut().zip(&maps) {
            *p = map.transform_point3(*p);
        }
        self.change_deltas(|v| maps[v].matrix3);
        self.change_tangents(|v| &maps[v].matrix3);
        for mut column in self.take_normals() {
            let normals = DVec3::of_mut(&mut column.values).unwrap_or_default();
            for (n, &v) in normals.iter_mut().zip(&self.corners) {
                let DMat3 {
                    x_axis: x,
                    y_axis: y,
                    z_axis: z,
                } = maps[v as usize].matrix3;
                let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                *n = (cofactors * *n).normalize_or_zero();
            }
            self.attributes.insert(Domain::Corner, column);
        }
        if maps
            .first()
            .is_some_and(|map| map.matrix3.determinant() < 0.0)
        {
            self.reverse_faces();
        }
        0
    }

    /// Removes and returns the corner attributes that contain normals.
    fn take_normals(&mut self) -> Vec<Column> {
        let columns = self.attributes.of(Domain::Corner).iter();
        let normals = columns.filter(|column| column.rule == Rule::Normal);
        let names: Vec<String> = normals.map(|column| column.name.clone()).collect();
        let take = |name: &String| self.attributes.remove(Domain::Corner, name);
        names.iter().filter_map(take).collect()
    }

    /// Multiplies the tangent of each corner by the matrix of its vertex.
    fn change_tangents<'a>(&mut self, matrix: impl Fn(usize) -> &'a DMat3) {
        let columns = self.attributes.of(Domain::Corner).iter();
        let tangents = columns.filter(|column| holds_tangents(column));
        let names: Vec<String> = tangents.map(|column| column.name.clone()).collect();
        for name in names {
            let Some(mut column) = self.attributes.remove(Domain::Corner, &name) else {
                continue;
            };
            let tangents = DVec4::of_mut(&mut column.values).unwrap_or_default();
            for (tangent, &v) in tangents.iter_mut().zip(&self.corners) {
                *tangent = transform_tangent(*tangent, matrix(v as usize));
            }
            self.attributes.insert(Domain::Corner, column);
        }
    }

    /// Multiplies the deltas of morph targets at each vertex by the matrix of the vertex.
    fn change_deltas(&mut self, matrix: impl Fn(usize) -> DMat3) {
        let morphs = self.attributes.morphs().into_iter();
        let morphs: Vec<String> = morphs.map(|(target, _)| morph_name(target)).collect();
        for name in morphs {
            let Some(mut column) = self.attributes.remove(Domain::Vertex, &name) else {
                continue;
            };
            let deltas = DVec3::of_mut(&mut column.values).unwrap_or_default();
            for (v, delta) in deltas.iter_mut().enumerate() {
                *delta = matrix(v) * *delta;
            }
            self.attributes.insert(Domain::Vertex, column);
        }
    }
}

/// Rearranges every column of a domain: the value at index `sources[i]` is copied to index i.
pub(crate) fn gather(attributes: &mut Attributes, domain: Domain, sources: &[u32]) {
    for (of, mut column) in std::mem::take(attributes) {
        if of == domain {
            column.values = (column.values).gather(sources.len(), |i| Some(sources[i] as usize));
        }
        attributes.insert(of, column);
    }
}
