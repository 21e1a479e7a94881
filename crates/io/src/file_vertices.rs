//! Finds the original vertices of a mesh. If the polygons of a file do not form a manifold, the reader splits some
//! vertices into an original and copies.

use std::borrow::Cow;
use std::sync::Arc;

use mesh::{Column, Domain, Mesh, Values, VertexId};
use scene::{Geometry, Object, Scene};

/// The name of the vertex attribute that marks the copies of split vertices. The value at a copy is the index of the
/// copy minus the index of the original. The value at an original vertex is 0. Readers add this attribute if
/// [`ReadOptions::keep_vertices`](crate::ReadOptions::keep_vertices) is set.
pub(crate) const COPY_DISTANCE: &str = "distance to the original vertex";

/// The original vertices of a mesh: the vertices of the file from which the mesh was read.
pub(crate) struct FileVertices {
    /// Two lists: the vertices that are written, and for each vertex of the mesh, its index in the written file. A copy
    /// has the same index as its original. `None` if the mesh has no attribute [`COPY_DISTANCE`].
    originals: Option<(Vec<u32>, Vec<u32>)>,
    /// For each copy, its index in the written file and its index in the mesh. The pairs are sorted.
    copies: Vec<(u32, u32)>,
    n: usize,
}

impl FileVertices {
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let n = mesh.n_vertices();
        let column = mesh.attributes().column(Domain::Vertex, COPY_DISTANCE);
        let Some(Values::Int(distances)) = column.map(|column| &column.values) else {
            return Self {
                originals: None,
                copies: Vec::new(),
                n,
            };
        };
        let mut written = Vec::new();
        let mut numbers: Vec<u32> = Vec::with_capacity(n);
        let mut copies = Vec::new();
        for (v, &distance) in (0_u32..).zip(distances) {
            let original = v.checked_sub(distance.unsigned_abs());
            if let Some(original) = original.filter(|_| distance > 0) {
                let number = numbers[original as usize];
                numbers.push(number);
                copies.push((number, v));
            } else {
                numbers.push(u32::try_from(written.len()).unwrap_or(u32::MAX));
                written.push(v);
            }
        }
        copies.sort_unstable();
        Self {
            n: written.len(),
            originals: Some((written, numbers)),
            copies,
        }
    }

    /// Whether the mesh has copies of split vertices.
    pub(crate) fn has_copies(&self) -> bool {
        !self.copies.is_empty()
    }

    /// Returns the vertices of the mesh that become vertex `i` of the written file: the original, then its copies.
    pub(crate) fn all(&self, i: usize) -> impl Iterator<Item = VertexId> {
        let start = self.copies.partition_point(|(k, _)| (*k as usize) < i);
        let copies = self.copies[start..].iter();
        let copies = copies.take_while(move |(k, _)| *k as usize == i);
        let copies = copies.map(|(_, v)| *v as usize);
        std::iter::once(self.vertex(i))
            .chain(copies)
            .map(VertexId::new)
    }

    /// Whether a vertex of the mesh is a copy of another vertex.
    pub(crate) fn is_copy(&self, v: VertexId) -> bool {
        self.has_copies() && self.vertex(self.number(v)) != v.index()
    }

    /// The number of vertices in the written file.
    pub(crate) fn len(&self) -> usize {
        self.n
    }

    /// The original vertex of the mesh that becomes vertex `i` of the written file.
    pub(crate) fn vertex(&self, i: usize) -> usize {
        match &self.originals {
            Some((written, _)) => written[i] as usize,
            None => i,
        }
    }

    /// Returns the index of a vertex of the mesh in the written file.
    pub(crate) fn number(&self, v: VertexId) -> usize {
        match &self.originals {
            Some((_, numbers)) => numbers[v.index()] as usize,
            None => v.index(),
        }
    }
}

/// Whether an attribute is [`COPY_DISTANCE`], which marks the copies of split vertices.
pub(crate) fn is_mark(domain: Domain, column: &Column) -> bool {
    domain == Domain::Vertex && column.name == COPY_DISTANCE
}

/// Removes the attribute [`COPY_DISTANCE`] from all meshes.
pub(crate) fn without_marks(scene: Cow<Scene>) -> Cow<Scene> {
    let has_marks = |object: &Object| {
        let mesh = object.as_mesh();
        mesh.is_some_and(|m| {
            m.attributes()
                .column(Domain::Vertex, COPY_DISTANCE)
                .is_some()
        })
    };
    if !scene.objects().iter().any(has_marks) {
        return scene;
    }
    let mut new = Scene::new();
    for mut object in scene.objects().iter().cloned() {
        if let Geometry::Mesh(mesh) = &mut object.geometry {
            Arc::make_mut(mesh).remove_column(Domain::Vertex, COPY_DISTANCE);
        }
        let inserted = new.insert(object);
        inserted.expect("the names of the objects are those of the scene");
    }
    new.graph_mut().clone_from(scene.graph());
    Cow::Owned(new)
}
