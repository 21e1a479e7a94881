//! Regions: connected groups of selected faces.

use glam::DVec3;
use mesh::{FaceId, Mesh, VertexId};

/// Faces that are connected across edges, in order of their ids.
pub(crate) struct Region {
    pub(crate) faces: Vec<FaceId>,
}

impl Region {
    /// Returns the regions of the marked faces, in order of the lowest face id of each region.
    pub(crate) fn all(mesh: &Mesh, marked: &[bool]) -> Vec<Self> {
        let mut unvisited = marked.to_vec();
        let mut regions = Vec::new();
        let mut stack = Vec::new();
        for lowest in mesh.faces() {
            if !std::mem::take(&mut unvisited[lowest.index()]) {
                continue;
            }
            let mut faces = Vec::new();
            stack.push(lowest);
            while let Some(f) = stack.pop() {
                faces.push(f);
                for g in mesh.face_half_edges(f).filter_map(|h| mesh.face(h.twin())) {
                    if std::mem::take(&mut unvisited[g.index()]) {
                        stack.push(g);
                    }
                }
            }
            faces.sort_unstable();
            regions.push(Self { faces });
        }
        regions
    }

    /// Returns the unit vector along the sum of the area vectors of the faces. Returns `None` if the area vectors
    /// cancel each other out up to rounding errors, as in a closed region.
    pub(crate) fn normal(&self, mesh: &Mesh) -> Option<DVec3> {
        let (mut sum, mut area) = (DVec3::ZERO, 0.0);
        for vector in self.faces.iter().map(|&f| mesh.area_vector(f)) {
            sum += vector;
            area += vector.length();
        }
        (sum.length() > 1e-12 * area).then(|| sum.normalize_or_zero())
    }

    /// Returns the vertices of the faces without duplicates, in order of their ids.
    pub(crate) fn vertices(&self, mesh: &Mesh) -> Vec<VertexId> {
        let corners = self.faces.iter().flat_map(|&f| mesh.face_vertices(f));
        let mut vertices: Vec<_> = corners.collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }
}

/// Returns the mean position of the vertices.
pub(crate) fn center(mesh: &Mesh, vertices: &[VertexId]) -> DVec3 {
    let sum: DVec3 = vertices.iter().map(|&v| mesh.position(v)).sum();
    sum / vertices.len() as f64
}
