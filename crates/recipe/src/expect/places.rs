//! Finds the elements that violate an expectation, so that pictures can mark them.

use geometry::distance::Distance;
use mesh::{DVec3, EdgeId, Element, FaceId, Mesh, VertexId};
use op::{Elements, ErrorLocation, FaceSelection, Select};
use scene::Object;

use super::same::PositionIndex;
use super::subject::{Subject, selected, smallest_corner_angle};
use super::{Expectation, symmetry, textures};

impl Expectation {
    /// Returns the locations in the scene at which the expectation is violated, at most
    /// [`ErrorLocation::MAX_ELEMENTS`]. The result is empty for expectations that are not about elements and for `Not`.
    /// The result is also empty for comparisons of meshes in a scene with nodes.
    pub fn places(&self, subject: Subject) -> Vec<ErrorLocation> {
        let mut places = Vec::new();
        let compares = matches!(
            self,
            Self::Same { .. } | Self::DistanceTo { .. } | Self::SymmetricUnder { .. }
        );
        if compares && !subject.scene.graph().is_empty() {
            // In a scene with nodes, comparisons use instances in scene space, but locations must be in object space.
            // Therefore no locations are returned.
            return places;
        }
        for (object, mesh) in subject.meshes().unwrap_or_default() {
            let found = CheckedMesh {
                subject,
                object,
                mesh,
            };
            places.extend(found.places(self));
            places.truncate(ErrorLocation::MAX_ELEMENTS);
        }
        if let Self::Point {
            line, index, is, ..
        } = self
        {
            let lines = subject.polylines().unwrap_or_default();
            let found = lines
                .get(*line as usize)
                .and_then(|l| l.get(*index as usize));
            places.extend(found.copied().map(point));
            places.push(expected((*is).into()));
        }
        places
    }
}

/// A mesh on which an expectation is checked.
struct CheckedMesh<'a> {
    subject: Subject<'a>,
    object: &'a Object,
    mesh: &'a Mesh,
}

impl CheckedMesh<'_> {
    fn places(&self, expectation: &Expectation) -> Vec<ErrorLocation> {
        let mesh = self.mesh;
        match expectation {
            Expectation::Closed | Expectation::BoundaryLoops { .. } => {
                self.locations(mesh.edges().filter(|&e| mesh.is_boundary_edge(e)))
            }
            Expectation::Manifold => self.locations(double_edges(mesh)),
            Expectation::Count { of, .. } => match of {
                Elements::Vertices(of) => self.locations(self.selected(of)),
                Elements::Edges(of) => self.locations(self.selected(of)),
                Elements::Faces(of) => self.locations(self.selected(of)),
            },
            Expectation::Valence { of, eq, min, max } => {
                let valence = |v| Some(mesh.valence(v) as u64);
                self.out_of_bounds(of, valence, eq.or(*min), eq.or(*max))
            }
            Expectation::DihedralAngle { of, min, max, .. } => {
                let angle = mesh.dihedral_angles();
                self.out_of_bounds(of, |e| angle(e).map(f64::to_degrees), *min, *max)
            }
            Expectation::EdgeLength { of, min, max } => {
                self.out_of_bounds(of, |e| Some(mesh.length(e.half_edge())), *min, *max)
            }
            Expectation::MinAngle { of, min, .. } => {
                let angles = self
                    .selected(of)
                    .into_iter()
                    .map(|f| (smallest_corner_angle(mesh, f), f));
                let mut off: Vec<(f64, FaceId)> = angles
                    .filter(|(angle, _)| !within(*angle, *min, None))
                    .collect();
                // The face with the smallest angle comes first, because the message of the violation names this angle.
                off.sort_by(|a, b| a.0.total_cmp(&b.0));
                self.locations(off.into_iter().map(|(_, f)| f))
            }
            Expectation::Thickness { of, min, max } => {
                let Ok(thickness) = geometry::thickness(mesh, self.subject.progress) else {
                    return Vec::new();
                };
                let at = |v: VertexId| Some(thickness[v.index()]);
                self.out_of_bounds(of, at, *min, *max)
            }
            Expectation::SelfIntersections { .. } => {
                self.locations(self.selected(&FaceSelection::SelfIntersecting))
            }
            Expectation::UvStretch { uv, max } => {
                self.locations(textures::stretched_faces(mesh, uv, *max))
            }
            Expectation::UvOverlap { uv, .. } => {
                let progress = self.subject.progress;
                self.locations(textures::overlapping_faces(mesh, uv, progress))
            }
            Expectation::MeanFaceArea { of, .. } => self.locations(self.selected(of)),
            Expectation::Position { of, is, .. } => {
                let mut places = self.locations(self.selected(of));
                places.push(expected((*is).into()));
                places
            }
            Expectation::Same {
                r#as, tolerance, ..
            } => match self.subject.other_mesh(r#as) {
                Ok(other) => self.unmatched_vertices(&other, *tolerance),
                Err(_) => Vec::new(),
            },
            Expectation::DistanceTo { other, .. } => {
                let other = self.subject.other_mesh(other).ok();
                let found = other.and_then(|other| {
                    let progress = self.subject.progress;
                    Distance::between_with(mesh, &other, None, progress)
                        .ok()
                        .flatten()
                });
                found.map_or_else(Vec::new, |found| self.farthest(&found))
            }
            Expectation::SymmetricUnder {
                group, tolerance, ..
            } => {
                let points = PositionIndex::new(mesh);
                let motions = group.motions();
                let is_off = |v: &VertexId| {
                    symmetry::has_unmatched_image(mesh, &points, &motions, *v, *tolerance)
                };
                self.locations(mesh.vertices().filter(is_off))
            }
            _ => Vec::new(),
        }
    }

    fn selected<S: Select>(&self, of: &S) -> Vec<S::Id> {
        let found = selected(of, self.object, self.mesh, self.subject);
        found.unwrap_or_default()
    }

    /// Returns the selected elements whose measured value is out of bounds. Elements for which `measure` returns `None`
    /// are not returned.
    fn out_of_bounds<S: Select, T: PartialOrd + Copy>(
        &self,
        of: &S,
        measure: impl Fn(S::Id) -> Option<T>,
        min: Option<T>,
        max: Option<T>,
    ) -> Vec<ErrorLocation>
    where
        S::Id: Into<Element>,
    {
        let is_off = |id: &S::Id| measure(*id).is_some_and(|found| !within(found, min, max));
        self.locations(self.selected(of).into_iter().filter(is_off))
    }

    fn locations<E: Into<Element>>(
        &self,
        elements: impl IntoIterator<Item = E>,
    ) -> Vec<ErrorLocation> {
        let places = elements.into_iter();
        places
            .filter_map(|element| ErrorLocation::of(&self.object.name, self.mesh, element))
            .take(ErrorLocation::MAX_ELEMENTS)
            .collect()
    }

    /// Returns the vertices of both meshes that are farther than the tolerance from every vertex of the other mesh.
    fn unmatched_vertices(&self, other: &Mesh, tolerance: f64) -> Vec<ErrorLocation> {
        let (these, others) = (PositionIndex::new(self.mesh), PositionIndex::new(other));
        let mut places = self.locations(self.mesh.vertices().filter(|&v| {
            let p = self.mesh.position(v);
            !others.any_near(p, tolerance)
        }));
        let missing = other.vertices().map(|v| other.position(v));
        // Each of the two meshes gets half of the maximum number of locations.
        places.truncate(ErrorLocation::MAX_ELEMENTS / 2);
        let missing = missing.filter(|&p| !these.any_near(p, tolerance));
        places.extend(missing.map(expected).take(ErrorLocation::MAX_ELEMENTS / 2));
        places
    }

    /// Returns two locations that show the largest distance between two surfaces. This distance is the length of a line
    /// from a point on one surface to the nearest point on the other surface. The first location is the element of this
    /// mesh that contains one end of the line. The second location is the line itself.
    fn farthest(&self, found: &Distance) -> Vec<ErrorLocation> {
        let worst = found.worst();
        let on = if found.is_worst_forth() {
            worst.from.on
        } else {
            worst.to.on
        };
        let mut places = self.locations([on]);
        places.push(ErrorLocation {
            object: self.object.name.clone(),
            name: String::new(),
            points: vec![worst.from.position, worst.to.position],
        });
        places
    }
}

fn within<T: PartialOrd + Copy>(found: T, min: Option<T>, max: Option<T>) -> bool {
    min.is_none_or(|min| found >= min) && max.is_none_or(|max| found <= max)
}

/// Creates a location that has no name.
fn point(at: DVec3) -> ErrorLocation {
    ErrorLocation {
        object: String::new(),
        name: String::new(),
        points: vec![at],
    }
}

/// Creates a location at the expected position of an element that does not exist.
fn expected(at: DVec3) -> ErrorLocation {
    ErrorLocation {
        name: ErrorLocation::EXPECTED.to_owned(),
        ..point(at)
    }
}

/// Returns all edges that join the same two vertices as another edge.
pub(super) fn double_edges(mesh: &Mesh) -> Vec<EdgeId> {
    let ends = |e: EdgeId| {
        let [v, w] = mesh.edge_vertices(e);
        [v.min(w), v.max(w)]
    };
    let mut edges: Vec<([VertexId; 2], EdgeId)> = mesh.edges().map(|e| (ends(e), e)).collect();
    edges.sort_unstable();
    let groups = edges.chunk_by(|(ends, _), (others, _)| ends == others);
    groups
        .filter(|group| group.len() > 1)
        .flat_map(|group| group.iter().map(|(_, e)| *e))
        .collect()
}
