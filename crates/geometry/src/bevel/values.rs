//! Computes the values (attributes) of a mesh whose edges are beveled.

use mesh::{Attributes, Domain, EdgeId, FaceId, HalfEdgeId, Id, Rule, VertexId};

/// A weighted mean of the values at three vertices or corners: each of the three sources with its weight. The weights
/// add up to 1.
pub(super) type Blend<I> = [(I, f64); 3];

/// Returns the attributes of the beveled mesh. The four lists tell from which old elements the values of each vertex,
/// corner, edge and face of the beveled mesh are computed. The entry of a half-edge without a face is `None`. The entry
/// of an edge that does not come from an old edge is [`EdgeId::NONE`]. Values that cannot be averaged are copied from
/// the first element of the [`Blend`].
pub(super) fn blended(
    old: &Attributes,
    vertices: &[Blend<VertexId>],
    corners: &[Option<Blend<HalfEdgeId>>],
    edges: &[EdgeId],
    faces: &[FaceId],
) -> Attributes {
    fn run<I: Id>(
        new: &mut Attributes,
        old: &Attributes,
        domain: Domain,
        blends: &[Option<Blend<I>>],
    ) {
        for column in old.of(domain) {
            let is_mean = matches!(column.rule, Rule::Interpolate | Rule::Normal);
            let values = column.values.blend(blends.len(), |i, add| {
                let Some(blend) = &blends[i] else {
                    return;
                };
                if is_mean {
                    let terms = blend.iter().filter(|(_, weight)| *weight != 0.0);
                    terms.for_each(|&(source, weight)| add(source.index(), weight));
                } else {
                    add(blend[0].0.index(), 1.0);
                }
            });
            new.insert(domain, column.with_values(values));
        }
    }
    let mut new = Attributes::default();
    let vertices: Vec<Option<Blend<VertexId>>> = vertices.iter().copied().map(Some).collect();
    run(&mut new, old, Domain::Vertex, &vertices);
    run(&mut new, old, Domain::Corner, corners);
    for column in old.of(Domain::Edge) {
        let source = |e: usize| edges[e].some().map(Id::index);
        new.insert(
            Domain::Edge,
            column.with_values(column.values.gather(edges.len(), source)),
        );
    }
    for column in old.of(Domain::Face) {
        let values = column
            .values
            .gather(faces.len(), |f| Some(faces[f].index()));
        new.insert(Domain::Face, column.with_values(values));
    }
    new
}
