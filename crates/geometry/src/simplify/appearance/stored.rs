//! Moves the interpolated attributes of a mesh into an [`Appearance`], and back into the mesh.

use mesh::{
    Column, DVec2, DVec3, DVec4, Domain, HalfEdgeId, Mesh, Renumbering, Rule, Values, VertexId,
    parallel,
};

use super::super::kept::{keep, kept};
use super::super::quadric::Quadric;
use super::{Appearance, Taken};
use crate::lines::inverse_power_of_two;

/// The weight of texture coordinates, relative to lengths on the surface. Before this weight is applied, texture
/// coordinates are scaled so that all triangles together have the same area in the texture as on the surface.
const TEXTURE: f64 = 0.5;

/// The weight of normals. In the cost, the difference of two unit normals counts about as much as a distance: the
/// length of the difference, times this weight and the size of the mesh. The weight is small, because the normals of a
/// mesh depend mostly on the shape of the surface. For example, if a model of a rocker arm is simplified with five
/// times this weight, the mean distance between the original and the simplified surface doubles. For the same reason,
/// normals do not affect the positions of vertices. If normals affected the positions, the largest distance for the
/// rocker arm would be 3.9e-3 of the diagonal of the bounding box instead of 3.3e-3.
const NORMAL: f64 = 0.002;

/// The weight of all attributes except texture coordinates and normals. The largest possible error of an attribute is
/// the difference between its lowest and its highest value. In the cost, such an error counts about as much as a
/// distance: this number times the size of the mesh.
const OTHER: f64 = 0.02;

impl Appearance {
    /// Removes the interpolated attributes of vertices and corners from a mesh, and stores them. Returns `None` if the
    /// mesh has no such attributes. `place` returns the scaled position of a vertex.
    pub(in super::super) fn take(
        mesh: &mut Mesh,
        lines: &[bool],
        place: impl Fn(&Mesh, VertexId) -> DVec3 + Sync,
    ) -> Option<Self> {
        let is_taken = |column: &Column| {
            matches!(column.rule, Rule::Interpolate | Rule::Normal)
                && !matches!(column.values, Values::Int(_) | Values::Tag(_))
        };
        let mut order = Vec::new();
        for domain in [Domain::Vertex, Domain::Corner] {
            let columns = mesh.attributes().of(domain).iter();
            order.extend(columns.map(|column| (domain, column.name.clone())));
        }
        let (mut taken, mut n, mut n_placing) = (Vec::new(), 0, 0);
        for normals in [false, true] {
            for (domain, name) in &order {
                let column = mesh.attributes().column(*domain, name);
                let is_next = |c: &&Column| is_taken(c) && (c.rule == Rule::Normal) == normals;
                if let Some(column) = column.filter(is_next).cloned() {
                    mesh.remove_column(*domain, name);
                    let width = column.values.n_components();
                    taken.push(Taken {
                        weight: weight(mesh, *domain, &column, |v| place(mesh, v)),
                        domain: *domain,
                        column,
                        first: n,
                        n: width,
                    });
                    n += width;
                    n_placing += if normals { 0 } else { width };
                }
            }
        }
        if taken.is_empty() {
            return None;
        }
        let (wedges, firsts) = wedges(mesh, lines);
        let mut this = Self {
            taken,
            order,
            n,
            n_placing,
            wedges,
            areas: Vec::new(),
            placing: Vec::new(),
            normals: Vec::new(),
            fits: vec![DVec4::ZERO; n * firsts.len()],
            values: Vec::with_capacity(n * firsts.len()),
            bases: Vec::new(),
        };
        for &h in &firsts {
            for taken in &this.taken {
                let i = match taken.domain {
                    Domain::Vertex => mesh.origin(h).index(),
                    _ => h.index(),
                };
                let component = |c| taken.weight * taken.column.values.component(i, c);
                this.values.extend((0..taken.n).map(component));
            }
        }
        this.bases = this.values.iter().copied().take(n).collect();
        let mut fits = std::mem::take(&mut this.fits);
        let parts = firsts
            .chunks(parallel::BLOCK)
            .zip(fits.chunks_mut(n * parallel::BLOCK));
        let measured = parallel::consume(parts, |_, (firsts, fits)| {
            let wedges = firsts.iter().zip(fits.chunks_mut(n));
            wedges
                .map(|(&first, fits)| this.measure(mesh, lines, first, fits, |v| place(mesh, v)))
                .collect::<Vec<_>>()
        });
        (this.areas, (this.placing, this.normals)) = measured.into_iter().flatten().unzip();
        this.fits = fits;
        Some(this)
    }

    /// Adds to `fits` the linear functions of the attributes on the triangles of a wedge (a group of face corners at a
    /// vertex). `first` is the first corner of the wedge. Returns three results: the area of the wedge, the integral of
    /// the squared functions of all attributes except normals, and the same integral for normals.
    fn measure(
        &self,
        mesh: &Mesh,
        lines: &[bool],
        first: HalfEdgeId,
        fits: &mut [DVec4],
        place: impl Fn(VertexId) -> DVec3,
    ) -> (f64, (Quadric, Quadric)) {
        let (mut total, mut placing, mut normals) = (0.0, Quadric::default(), Quadric::default());
        for h in corners_from(mesh, lines, first) {
            let next = mesh.next(h);
            let corners = [h, next, mesh.next(next)];
            let [a, b, c] = corners.map(|h| place(mesh.origin(h)));
            let normal = (b - a).cross(c - a);
            let twice_area = normal.length();
            if twice_area > 0.0 {
                let area = twice_area / 6.0;
                // The gradients of the barycentric coordinates that belong to the corners b and c.
                let normal = normal / twice_area;
                let at_b = normal.cross(a - c) / twice_area;
                let at_c = normal.cross(b - a) / twice_area;
                let values = corners.map(|h| self.values_of(self.wedges[h.index()]));
                total += area;
                for (i, fit) in fits.iter_mut().enumerate() {
                    let [s, t, u] = values.map(|values| values[i] - self.bases[i]);
                    let gradient = (t - s) * at_b + (u - s) * at_c;
                    let offset = s - gradient.dot(a);
                    *fit += area * gradient.extend(offset);
                    let sum = if i < self.n_placing {
                        &mut placing
                    } else {
                        &mut normals
                    };
                    *sum = *sum + Quadric::linear(gradient, offset, area);
                }
            }
        }
        (total, (placing, normals))
    }

    /// Updates the stored attributes after [`Mesh::compact`] has changed the ids of elements.
    pub(in super::super) fn renumber(&mut self, map: &Renumbering) {
        let vertices = kept(&map.vertices);
        let edges = kept(&map.edges).into_iter();
        let corners: Vec<usize> = edges.flat_map(|e| [2 * e, 2 * e + 1]).collect();
        keep(&mut self.wedges, &corners);
        for taken in &mut self.taken {
            let kept = match taken.domain {
                Domain::Vertex => &vertices,
                _ => &corners,
            };
            let values = &mut taken.column.values;
            *values = values.gather(kept.len(), |i| Some(kept[i]));
        }
    }

    /// Puts the stored values back into the mesh. Between the call of [`take`](Self::take) and this call, the caller
    /// may remove elements from the mesh, but must not add elements. If the caller renumbers elements, it must call
    /// [`renumber`](Self::renumber).
    pub(in super::super) fn put_back(mut self, mesh: &mut Mesh) {
        for taken in std::mem::take(&mut self.taken) {
            let mut column = taken.column;
            for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
                let i = match taken.domain {
                    Domain::Vertex => mesh.origin(h).index(),
                    _ => h.index(),
                };
                let values = &self.values_of(self.wedges[h.index()])[taken.first..];
                let value = |c: usize| values[c] / taken.weight;
                match &mut column.values {
                    Values::Float(v) => v[i] = value(0),
                    Values::Vec2(v) => v[i] = DVec2::new(value(0), value(1)),
                    Values::Vec3(v) => v[i] = DVec3::new(value(0), value(1), value(2)),
                    Values::Vec4(v) => v[i] = DVec4::new(value(0), value(1), value(2), value(3)),
                    Values::Int(_) | Values::Tag(_) => {}
                }
            }
            mesh.insert_column(taken.domain, column);
        }
        for (domain, name) in self.order {
            if let Some(column) = mesh.remove_column(domain, &name) {
                mesh.insert_column(domain, column);
            }
        }
    }
}

/// Returns the weight by which the values of a column are multiplied: a power of two. `place` returns the scaled
/// position of a vertex. With this weight, errors of values can be compared with scaled distances.
fn weight(mesh: &Mesh, domain: Domain, column: &Column, place: impl Fn(VertexId) -> DVec3) -> f64 {
    if column.rule == Rule::Normal {
        return inverse_power_of_two(1.0 / NORMAL);
    }
    if let (Domain::Corner, Values::Vec2(uv)) = (domain, &column.values) {
        let (mut area, mut in_texture) = (0.0, 0.0);
        for f in mesh.faces() {
            let h = mesh.face_half_edge(f);
            let corners = [h, mesh.next(h), mesh.next(mesh.next(h))];
            let [a, b, c] = corners.map(|h| place(mesh.origin(h)));
            area += (b - a).cross(c - a).length();
            let [a, b, c] = corners.map(|h| uv[h.index()]);
            in_texture += (b - a).perp_dot(c - a).abs();
        }
        if area > 0.0 && in_texture > 0.0 {
            return inverse_power_of_two((in_texture / area).sqrt() / TEXTURE);
        }
    }
    let mut range = 0.0_f64;
    for c in 0..column.values.n_components() {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..column.values.len() {
            let value = column.values.component(i, c);
            low = low.min(value);
            high = high.max(value);
        }
        range = range.max(high - low);
    }
    inverse_power_of_two(range / OTHER)
}

/// Returns, for each corner, the index of its wedge (a group of face corners at a vertex). Also returns the first
/// corner of each wedge.
pub(super) fn wedges(mesh: &Mesh, lines: &[bool]) -> (Vec<u32>, Vec<HalfEdgeId>) {
    const NONE: u32 = u32::MAX;
    let mut wedges = vec![NONE; mesh.n_half_edges()];
    let mut firsts = Vec::new();
    for h in mesh.half_edges() {
        if mesh.face(h).is_none() || wedges[h.index()] != NONE {
            continue;
        }
        let mut first = h;
        while !lines[first.edge().index()] {
            first = mesh.next(first.twin());
            if first == h {
                break;
            }
        }
        let wedge = u32::try_from(firsts.len()).expect("fewer wedges than half-edges");
        for g in corners_from(mesh, lines, first) {
            wedges[g.index()] = wedge;
        }
        firsts.push(first);
    }
    (wedges, firsts)
}

/// Returns the corners of a wedge, counter-clockwise from its first corner.
fn corners_from(
    mesh: &Mesh,
    lines: &[bool],
    first: HalfEdgeId,
) -> impl Iterator<Item = HalfEdgeId> {
    std::iter::successors(Some(first), move |&h| {
        let last = mesh.next(mesh.next(h));
        let next = last.twin();
        (!lines[last.edge().index()] && next != first).then_some(next)
    })
}
