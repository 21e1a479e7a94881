//! How attributes contribute to the cost of an edge collapse in simplification.
//!
//! Texture coordinates, normals, colors and other numbers are linear functions on each original triangle. A vertex
//! represents some original triangles. Let the vertex be placed at the point p and get the value s. The error is the
//! mean squared difference between s and the values of these linear functions at p. For each point p, one value s has
//! the least error. This least error is a quadratic function of p, a quadric. Source: Hoppe, "New Quadric Metric for
//! Simplifying Meshes with Appearance Attributes", 1999.
//!
//! ```text
//!           \   w0  /
//!            \     /           A wedge is a sector of the faces around a vertex, between two lines. All corners of a
//!       ======v======          wedge have the same values. Values are never mixed between wedges of one vertex, so
//!            /     \           they are not mixed across seams.
//!           /  w1   \
//! ```

mod stored;

use std::ops::Range;

use mesh::{
    Column, DVec2, DVec3, DVec4, Domain, EdgeId, FaceId, HalfEdgeId, Mesh, Rule, Values, VertexId,
};

use super::quadric::Quadric;

/// A column whose values are stored in [`Appearance`] instead of in the mesh, one value for each wedge. A wedge is the
/// set of those face corners at a vertex that lie between two lines.
struct Taken {
    domain: Domain,
    column: Column,
    /// The weight of the column: a power of two, so that scaled values can be scaled back exactly.
    weight: f64,
    /// The index of the first component of this column, in one common list of the components of all columns.
    first: usize,
    /// The number of components of this column, for example 3 for a vector.
    n: usize,
}

impl Taken {
    fn is_texture(&self) -> bool {
        self.domain == Domain::Corner && matches!(self.column.values, Values::Vec2(_))
    }
}

/// The interpolated attributes of a mesh during the simplification. A wedge is the set of face corners at a vertex that
/// lie between two lines.
pub(super) struct Appearance {
    taken: Vec<Taken>,
    /// The names of all columns of vertices and corners, in the original order of the columns. This order is restored
    /// at the end.
    order: Vec<(Domain, String)>,
    /// The number of components of all columns together. The components of normals come last.
    n: usize,
    /// The number of components of the columns that are not normals. Only these columns affect the positions of
    /// vertices.
    n_placing: usize,
    /// For each half-edge with a face: the index of the wedge (a group of face corners at a vertex) to which its corner
    /// belongs.
    wedges: Vec<u32>,
    /// For each wedge: a third of the area of its triangles.
    areas: Vec<f64>,
    /// For each wedge: an integral over the triangles of the wedge. On each triangle, every component of an attribute
    /// is a linear function. The integrand is the sum of the squares of these functions; normals are left out.
    placing: Vec<Quadric>,
    /// For each wedge: the same integral as in `placing`, but for normals.
    normals: Vec<Quadric>,
    /// For each wedge and each component of the attributes: the integral of the linear functions of this component over
    /// the triangles of the wedge. The first three numbers are the integral of the gradient, and the fourth is the
    /// integral of the offset.
    fits: Vec<DVec4>,
    /// For each wedge and each component of the attributes: the value of the wedge, times the weight of the column.
    values: Vec<f64>,
    /// For each component of the attributes: a typical value that is subtracted from the linear functions, so that
    /// rounding errors are small.
    bases: Vec<f64>,
}

/// The indices of two wedges (groups of face corners at a vertex) that an edge joins, one at each end of the edge.
pub(super) type Pair = [u32; 2];

/// For each face around an edge before its collapse, the corners of the face and their wedges (groups of face corners
/// at a vertex).
pub(super) struct Around(Vec<(FaceId, [(VertexId, u32); 3])>);

/// The faces around an edge before its collapse, and the pairs of wedges (groups of face corners at a vertex) that the
/// collapse merges. Each pair is listed with the values of the merged wedge.
pub(super) type Merge = (Around, Vec<(Pair, Vec<f64>)>);

impl Appearance {
    fn values_of(&self, wedge: u32) -> &[f64] {
        let first = self.n * wedge as usize;
        &self.values[first..first + self.n]
    }

    /// Returns, for each side of an edge, the two wedges (groups of face corners at a vertex) that the edge joins. If
    /// the edge is not on a line, both sides have the same two wedges, and the pair is returned only once.
    pub(super) fn pairs(&self, mesh: &Mesh, e: EdgeId, is_line: bool) -> [Option<Pair>; 2] {
        let [h, twin] = e.half_edges();
        let at = |h: HalfEdgeId| self.wedges[h.index()];
        let pair = mesh.face(h).map(|_| [at(h), at(mesh.next(h))]);
        let opposite = mesh.face(twin).map(|_| [at(mesh.next(twin)), at(twin)]);
        if is_line {
            [pair, opposite]
        } else {
            [pair, None]
        }
    }

    fn area(&self, [a, b]: Pair) -> f64 {
        self.areas[a as usize] + self.areas[b as usize]
    }

    /// Returns a weighted sum of the linear functions of component `i` on the triangles of two wedges. The weight of a
    /// triangle is the area that it contributes to its wedge. The weighted sum is also a linear function of the point.
    /// The first three numbers of the result are the gradient of this function, and the fourth number is its offset.
    fn fit(&self, [a, b]: Pair, i: usize) -> DVec4 {
        self.fits[self.n * a as usize + i] + self.fits[self.n * b as usize + i]
    }

    /// Returns the integral of the squared error of all attributes except normals, as a function of the point at which
    /// the vertex is placed. The values of the vertex are those with the least error at this point.
    pub(super) fn placing(&self, pair: Pair) -> Quadric {
        self.least(pair, &self.placing, 0..self.n_placing)
    }

    /// Returns the integral of the squared error of the given components, as a function of the point at which the
    /// vertex is placed. The values of the vertex are those with the least error at this point.
    fn least(&self, pair: Pair, quadrics: &[Quadric], components: Range<usize>) -> Quadric {
        let [a, b] = pair.map(|wedge| quadrics[wedge as usize]);
        let area = self.area(pair);
        let mut sum = a + b;
        if area > 0.0 {
            for i in components {
                let fit = self.fit(pair, i);
                sum = sum + Quadric::linear(fit.truncate(), fit.w, -1.0 / area);
            }
        }
        sum
    }

    /// Returns the integral of the squared error of all attributes, if the vertex is at `point` and has the values with
    /// the least error.
    pub(super) fn least_error(&self, pair: Pair, point: DVec3) -> f64 {
        let mut error = self.placing(pair).at(point);
        if self.n_placing < self.n {
            let normals = self.least(pair, &self.normals, self.n_placing..self.n);
            error += normals.at(point);
        }
        error
    }

    /// Returns the integral of the squared error of all attributes, if the vertex is at `point` and its values are
    /// interpolated between the two wedges. `t` is the weight of the second wedge, from 0 to 1.
    pub(super) fn error(&self, pair: Pair, point: DVec3, t: f64) -> f64 {
        let [a, b] = pair.map(|wedge| self.values_of(wedge));
        let area = self.area(pair);
        let [x, y] = pair.map(|w| self.placing[w as usize] + self.normals[w as usize]);
        let mut error = (x + y).at(point);
        for i in 0..self.n {
            let value = (1.0 - t) * a[i] + t * b[i] - self.bases[i];
            error += value * (area * value - 2.0 * self.fit(pair, i).dot(point.extend(1.0)));
        }
        if error > 0.0 { error } else { 0.0 }
    }

    /// Interpolates between the values of two wedges (groups of face corners at a vertex). `t` is the weight of the
    /// second wedge, from 0 to 1.
    pub(super) fn mixed(&self, pair: Pair, t: f64) -> Vec<f64> {
        let [a, b] = pair.map(|wedge| self.values_of(wedge));
        let mix = |(a, b): (&f64, &f64)| {
            if t <= 0.0 {
                *a
            } else if t >= 1.0 {
                *b
            } else {
                (1.0 - t) * a + t * b
            }
        };
        let mut values: Vec<f64> = a.iter().zip(b).map(mix).collect();
        if t > 0.0 && t < 1.0 {
            self.normalize(&mut values);
        }
        values
    }

    /// Returns the values with the least error if the vertex is placed at `point`. Each component stays between its
    /// lowest and its highest value at the wedges in `around`.
    pub(super) fn best(&self, pair: Pair, around: &Around, point: DVec3) -> Vec<f64> {
        let area = self.area(pair);
        if area.is_nan() || area <= 0.0 {
            return self.mixed(pair, 0.5);
        }
        let mut values: Vec<f64> = (0..self.n)
            .map(|i| {
                let value = self.fit(pair, i).dot(point.extend(1.0)) / area + self.bases[i];
                let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                for (_, corners) in &around.0 {
                    for &(_, wedge) in corners {
                        let value = self.values_of(wedge)[i];
                        low = low.min(value);
                        high = high.max(value);
                    }
                }
                value.max(low).min(high)
            })
            .collect();
        self.normalize(&mut values);
        values
    }

    fn normalize(&self, values: &mut [f64]) {
        for taken in &self.taken {
            let values = &mut values[taken.first..taken.first + taken.n];
            if taken.column.rule == Rule::Normal {
                let length = values.iter().map(|x| x * x).sum::<f64>().sqrt() / taken.weight;
                if length > 0.0 {
                    for x in values.iter_mut() {
                        *x /= length;
                    }
                }
            }
        }
    }

    /// Returns the faces around two vertices, with the wedges of the corners of these faces.
    pub(super) fn around(&self, mesh: &Mesh, [a, b]: [VertexId; 2]) -> Around {
        let mut faces = Vec::new();
        for (v, other) in [(a, b), (b, a)] {
            for h in mesh.vertex_half_edges(v) {
                let next = mesh.next(h);
                let corners = [h, next, mesh.next(next)];
                let vertices = corners.map(|h| mesh.origin(h));
                if let Some(f) = mesh
                    .face(h)
                    .filter(|_| v == a || !vertices.contains(&other))
                {
                    let corner = |i: usize| (vertices[i], self.wedges[corners[i].index()]);
                    faces.push((f, [corner(0), corner(1), corner(2)]));
                }
            }
        }
        Around(faces)
    }

    /// Whether a collapse would turn a triangle over in the texture, or make it degenerate there. `merged` lists the
    /// pairs of wedges (groups of face corners at a vertex) that the collapse merges. Each pair is listed with the
    /// values of the merged wedge.
    pub(super) fn turns(&self, around: &Around, merged: &[(Pair, Vec<f64>)]) -> bool {
        let new = |wedge: u32| {
            let merged = merged.iter().find(|(pair, _)| pair.contains(&wedge));
            merged.map_or_else(|| self.values_of(wedge), |(_, values)| values)
        };
        let textures = self.taken.iter().filter(|taken| taken.is_texture());
        textures.map(|taken| taken.first).any(|i| {
            let area = |corners: [&[f64]; 3]| {
                let [a, b, c] = corners.map(|values| DVec2::new(values[i], values[i + 1]));
                (b - a).perp_dot(c - a)
            };
            around.0.iter().any(|(_, corners)| {
                let wedges = corners.map(|(_, wedge)| wedge);
                let is_removed = |(pair, _): &(Pair, _)| pair.iter().all(|w| wedges.contains(w));
                let before = area(wedges.map(|wedge| self.values_of(wedge)));
                let after = area(wedges.map(new));
                before * after <= 0.0 && before != 0.0 && !merged.iter().any(is_removed)
            })
        })
    }

    /// Updates the wedges (groups of face corners at a vertex) after a collapse. `v` is the vertex that remains.
    /// `around` has the faces before the collapse.
    pub(super) fn merge(
        &mut self,
        mesh: &Mesh,
        ends: [VertexId; 2],
        v: VertexId,
        around: &Around,
        merged: Vec<(Pair, Vec<f64>)>,
    ) {
        let mut new_names: Vec<(u32, u32)> = Vec::new();
        let newest = |names: &[(u32, u32)], wedge: u32| {
            names
                .iter()
                .fold(wedge, |w, &(old, new)| if w == old { new } else { w })
        };
        for (pair, values) in merged {
            let [a, b] = pair.map(|wedge| newest(&new_names, wedge));
            let (to, from) = (a as usize, b as usize);
            if a != b {
                self.areas[to] += self.areas[from];
                for quadrics in [&mut self.placing, &mut self.normals] {
                    quadrics[to] = quadrics[to] + quadrics[from];
                }
                for i in 0..self.n {
                    self.fits[self.n * to + i] = self.fit([a, b], i);
                }
                new_names.push((b, a));
            }
            self.values[self.n * to..self.n * (to + 1)].copy_from_slice(&values);
        }
        for &(f, corners) in &around.0 {
            if !mesh.has_face(f) {
                continue;
            }
            for h in mesh.face_half_edges(f) {
                let origin = mesh.origin(h);
                let is_here = |w: VertexId| w == origin || (origin == v && ends.contains(&w));
                if let Some(&(_, wedge)) = corners.iter().find(|&&(w, _)| is_here(w)) {
                    self.wedges[h.index()] = newest(&new_names, wedge);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{square, waves};
    use super::*;
    use crate::lines::lines;
    use mesh::UV;
    use proptest::prelude::*;

    /// A wavy square with texture coordinates that are not linear, and the [`Appearance`] that stores them.
    fn taken() -> (Mesh, Appearance) {
        let mut mesh = waves();
        let at = |h| {
            let p = mesh.position(mesh.origin(h));
            DVec2::new(p.x * p.x + 3.0, p.x * p.y)
        };
        let uv = mesh.half_edges().map(at).collect();
        mesh.set(UV, uv);
        let lines = lines(&mesh, &[]);
        let mut without = mesh.clone();
        let appearance = Appearance::take(&mut without, &lines, Mesh::position);
        assert_eq!(without.attributes().of(Domain::Corner), []);
        (mesh, appearance.unwrap())
    }

    proptest! {
        #[test]
        fn the_error_is_the_integral_of_squared_differences(
            e in 0..1500_usize, x in -0.5..1.5, y in -0.5..1.5, z in -0.5..0.5, t in 0.0..1.0,
        ) {
            let (mesh, appearance) = taken();
            let (e, p) = (EdgeId::new(e), DVec3::new(x, y, z));
            let [Some(pair), _] = appearance.pairs(&mesh, e, false) else {
                return Ok(());
            };
            let uv = mesh.get(UV).unwrap();
            let weight = appearance.taken[0].weight;
            let ends = mesh.edge_vertices(e);
            let values = appearance.mixed(pair, t);
            let (mut error, mut best, mut total) = (0.0, DVec2::ZERO, 0.0);
            let mut functions = Vec::new();
            for h in ends.into_iter().flat_map(|v| mesh.vertex_half_edges(v)) {
                let Some(f) = mesh.face(h) else { continue };
                let corners: Vec<HalfEdgeId> = mesh.face_half_edges(f).collect();
                let [a, b, c] = [0, 1, 2].map(|i| mesh.position(mesh.origin(corners[i])));
                // The barycentric coordinates of the projection of p.
                let normal = (b - a).cross(c - a);
                let part = |q: DVec3, r: DVec3| (r - q).cross(p - q).dot(normal) / normal.length_squared();
                let weights = [part(b, c), part(c, a), part(a, b)];
                let value: DVec2 = (0..3).map(|i| weight * weights[i] * uv[corners[i].index()]).sum();
                let area = mesh.face_area(f) / 3.0;
                error += area * value.distance_squared(DVec2::new(values[0], values[1]));
                best += area * value;
                total += area;
                functions.push((value, area));
            }
            prop_assert!((appearance.error(pair, p, t) - error).abs() < 1e-9 * (1.0 + error));
            let least: f64 = functions.iter().map(|(value, area)| area * value.distance_squared(best / total)).sum();
            prop_assert!((appearance.least_error(pair, p) - least).abs() < 1e-9 * (1.0 + least));
        }
    }

    #[test]
    fn normals_do_not_move_vertices() {
        let mut mesh = waves();
        let normals = mesh.positions().iter().map(|p| p.normalize_or_zero());
        let normals = normals.collect();
        mesh.set(mesh::VERTEX_NORMAL, normals);
        let lines = lines(&mesh, &[]);
        let appearance = Appearance::take(&mut mesh, &lines, Mesh::position).unwrap();
        for e in mesh.edges().filter(|&e| !mesh.is_boundary_edge(e)) {
            let pairs = appearance.pairs(&mesh, e, false);
            for pair in pairs.into_iter().flatten() {
                assert_eq!(appearance.placing(pair), Quadric::default());
                assert!(appearance.least_error(pair, DVec3::ONE) > 0.0);
            }
        }
    }

    #[test]
    fn values_come_back_bit_for_bit() {
        let (mesh, appearance) = taken();
        let mut back = mesh.clone();
        back.remove_column(Domain::Corner, "uv");
        appearance.put_back(&mut back);
        assert_eq!(mesh.get(UV), back.get(UV));
    }

    #[test]
    fn a_wedge_is_a_sector_between_lines() {
        let mesh = square(2);
        let middle = super::super::tests::middle(&mesh);
        for (features, n) in [(&[][..], 9), (&middle[..], 12)] {
            let (wedges, firsts) = stored::wedges(&mesh, &lines(&mesh, features));
            assert_eq!(firsts.len(), n);
            let mut used: Vec<u32> = mesh
                .half_edges()
                .filter(|&h| mesh.face(h).is_some())
                .map(|h| wedges[h.index()])
                .collect();
            used.sort_unstable();
            used.dedup();
            assert_eq!(used.len(), n);
        }
    }
}
