//! Builds a mesh from polygons with attributes.

use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use mesh::{
    BuildError, BuildOutput, Column, Domain, Elements, Mesh, Rule, Values, morph_value_of,
    parallel, uv_set,
};
use scene::{Material, holds_tangents};

use crate::clean::{SourcePolygons, clean};
use crate::corners::vertex_values;
use crate::error::ReadError;
use crate::file_vertices::COPY_DISTANCE;
use crate::note::{NoteKind, Notes, PolygonArrays};
use crate::{NonManifold, Orientation, Policies, Polygons, ReadOptions};

impl Polygons {
    /// Builds a mesh of these polygons, and returns it with the materials. A corner attribute becomes a vertex
    /// attribute if, at each vertex, all corners have the same value, and the mesh has no vertex attribute of the same
    /// name. Three kinds of attributes always stay on the corners: tangents, texture coordinates, and the changes that
    /// morph targets make to texture coordinates. Texture coordinates are the attributes whose names begin with `uv`.
    ///
    /// # Errors
    ///
    /// Returns [`ReadError::Mesh`] if the polygons do not form a valid mesh or the policies refuse them.
    pub(crate) fn into_mesh(
        mut self,
        path: &Path,
        options: &ReadOptions,
        notes: &mut Notes,
    ) -> Result<(Mesh, Vec<Material>), ReadError> {
        let kept = clean(&mut self, options.policies, notes);
        let n_positions = self.positions.len();
        let mut built = self.build(path, options.policies, &kept, notes)?;
        if options.keep_vertices {
            mark_copies(&mut built, n_positions);
        }
        if self.attributes.iter().next().is_none() {
            return Ok((built.mesh, self.materials));
        }
        let sources = Sources::of(&built, n_positions);
        for (domain, mut column) in self.attributes {
            column.values = sources.gather(domain, column.values);
            let mut domain = domain;
            // All vertex attributes are already inserted, because they come before the corner attributes. A corner
            // attribute stays on the corners if a vertex attribute has the same name.
            let vertices = built.mesh.attributes();
            if domain == Domain::Corner
                && !column.name.starts_with("uv")
                && morph_value_of(&column.name).is_none_or(|(changed, _)| uv_set(changed).is_none())
                && !holds_tangents(&column)
                && vertices.column(Domain::Vertex, &column.name).is_none()
                && let Some(values) = vertex_values(&built.mesh, &column.values, |a, b| {
                    column.values.are_equal(a, b)
                })
            {
                (domain, column.values) = (Domain::Vertex, values);
            }
            built.mesh.insert_column(domain, column);
        }
        Ok((built.mesh, self.materials))
    }

    /// Builds a mesh of the polygons; see [`mesh::build()`]. `kept` contains, for each polygon, its index in the file.
    ///
    /// # Errors
    ///
    /// Returns an error if there are too many elements. Also returns an error if the polygons do not form a manifold,
    /// but the policies require a manifold.
    fn build(
        &mut self,
        path: &Path,
        policies: Policies,
        kept: &SourcePolygons,
        notes: &mut Notes,
    ) -> Result<BuildOutput, ReadError> {
        let positions = std::mem::take(&mut self.positions);
        let (offsets, corners) = (&self.offsets, &self.corners);
        let policy = match (policies.non_manifold, policies.orientation) {
            (NonManifold::Split, Orientation::Orient) => mesh::NonManifold::Split,
            (NonManifold::Split, Orientation::Keep) => mesh::NonManifold::SplitAsGiven,
            (NonManifold::Refuse, Orientation::Orient) => mesh::NonManifold::Refuse,
            (NonManifold::Refuse, Orientation::Keep) => mesh::NonManifold::RefuseAsGiven,
        };
        let in_file = |f: usize| kept.as_ref().map_or(f, |kept| kept[f] as usize);
        let built = mesh::build(positions, offsets, corners, policy).map_err(|mut source| {
            if let BuildError::NoSuchVertex { face, .. } = &mut source {
                *face = in_file(*face);
            }
            ReadError::Mesh {
                path: path.to_path_buf(),
                source,
            }
        })?;
        // In the mesh, the copies of split vertices come after the original vertices. Therefore, the vertex indices of
        // the polygons are also valid in the mesh.
        let given = PolygonArrays {
            positions: built.mesh.positions(),
            offsets,
            corners,
        };
        let dropped = built.report.dropped();
        let changed = built.report.repairs().into_iter();
        for (repair, kind) in (changed.map(|repair| (repair, NoteKind::Changed)))
            .chain(dropped.map(|dropped| (dropped, NoteKind::LeftOut)))
        {
            let places = given.places(&repair.elements);
            let elements = match repair.elements {
                Elements::Faces(faces) => Elements::Faces(faces.into_iter().map(in_file).collect()),
                elements => elements,
            };
            notes.elements(repair.code, kind, repair.description, elements, places);
        }
        Ok(built)
    }
}

/// Marks the copies of split vertices for [`FileVertices`](crate::file_vertices::FileVertices).
fn mark_copies(built: &mut BuildOutput, n_positions: usize) {
    if built.report.split_vertices.is_empty() {
        return;
    }
    let mut distances = vec![0; built.mesh.n_vertices()];
    for (v, copy) in &built.report.split_vertices {
        debug_assert!(
            v.index() < n_positions,
            "copies are made of original vertices"
        );
        distances[copy.index()] = i32::try_from(copy.index() - v.index()).unwrap_or(0);
    }
    let column = Column {
        name: COPY_DISTANCE.to_owned(),
        rule: Rule::Drop,
        values: Values::Int(distances),
    };
    built.mesh.insert_column(Domain::Vertex, column);
}

/// For each element of the mesh, the index of the input element (such as a corner of a polygon) from which its
/// attribute values come.
struct Sources {
    n_positions: usize,
    /// For each copy of a split vertex, the original vertex. Copies come after the original vertices.
    copies: Vec<usize>,
    /// For each half-edge, 1 plus the index of its corner in the input, or 0 if the half-edge has no face.
    corners: Vec<AtomicU32>,
    /// For each face, the index of its polygon. `None` if faces and polygons have the same indices.
    faces: Option<Vec<u32>>,
}

impl Sources {
    fn of(built: &BuildOutput, n_positions: usize) -> Self {
        let corners: Vec<AtomicU32> = mesh::zeroed(built.mesh.n_half_edges());
        parallel::blocks(built.half_edge_of_corner.len(), |block| {
            for c in block {
                if let Some(h) = built.half_edge_of_corner[c].some() {
                    corners[h.index()].store(u32::try_from(c + 1).unwrap_or(0), Relaxed);
                }
            }
        });
        let mut copies = vec![0; built.mesh.n_vertices() - n_positions];
        for (v, copy) in &built.report.split_vertices {
            copies[copy.index() - n_positions] = v.index();
        }
        let dropped = !built.report.dropped_faces.is_empty();
        let faces = dropped.then(|| {
            let kept = (0..).zip(&built.face_of_polygon);
            kept.filter(|(_, f)| f.some().is_some())
                .map(|(polygon, _)| polygon)
                .collect()
        });
        Self {
            n_positions,
            copies,
            corners,
            faces,
        }
    }

    /// Converts values for the elements of the input to values for the elements of the mesh.
    fn gather(&self, domain: Domain, values: Values) -> Values {
        match (domain, &self.faces) {
            (Domain::Vertex, _) if !self.copies.is_empty() => {
                let n = self.n_positions + self.copies.len();
                values.gather(n, |v| match v.checked_sub(self.n_positions) {
                    None => Some(v),
                    Some(copy) => Some(self.copies[copy]),
                })
            }
            (Domain::Corner, _) => values.gather(self.corners.len(), |h| {
                (self.corners[h].load(Relaxed) as usize).checked_sub(1)
            }),
            (Domain::Face, Some(faces)) => values.gather(faces.len(), |f| Some(faces[f] as usize)),
            (Domain::Vertex | Domain::Edge | Domain::Face, _) => values,
        }
    }
}
