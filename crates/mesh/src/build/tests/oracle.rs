//! A second builder, which is slow and simple. The builder of the crate must produce the same result for any
//! polygons.

use std::collections::BTreeMap;

use super::*;
use crate::{Connectivity, VertexId};

/// A linear congruential random number generator.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n
    }

    /// Returns up to `max` random polygons with 1 to 6 corners.
    fn polygons(&mut self, n_vertices: usize, max: usize) -> Vec<Vec<u32>> {
        let n = self.below(max + 1);
        let mut polygon = || {
            let degree = if self.below(3) == 0 {
                1 + self.below(6)
            } else {
                3
            };
            let corner = |_| u32::try_from(self.below(n_vertices)).unwrap();
            (0..degree).map(corner).collect()
        };
        (0..n).map(|_| polygon()).collect()
    }
}

/// Returns the expected result for polygons that keep their orientation: the arrays and, for each vertex of the result,
/// the input vertex from which it comes. If a vertex of the result is a copy, it comes from the vertex that was split.
fn expected(n_vertices: usize, polygons: &[Vec<u32>]) -> (Connectivity, Vec<usize>) {
    let is_valid = |p: &&Vec<u32>| {
        let unique: std::collections::BTreeSet<_> = p.iter().collect();
        p.len() >= 3 && unique.len() == p.len()
    };
    let polygons: Vec<&Vec<u32>> = polygons.iter().filter(is_valid).collect();
    // A corner is a pair: a polygon, and the index of the corner in the polygon.
    let corners: Vec<(usize, usize)> = (0..polygons.len())
        .flat_map(|f| (0..polygons[f].len()).map(move |i| (f, i)))
        .collect();
    let index_of = |c: (usize, usize)| corners.binary_search(&c).unwrap();
    let next: Vec<usize> = corners
        .iter()
        .map(|&(f, i)| index_of((f, (i + 1) % polygons[f].len())))
        .collect();
    let mut prev = vec![0; corners.len()];
    for (c, &n) in next.iter().enumerate() {
        prev[n] = c;
    }
    let vertex = |c: usize| polygons[corners[c].0][corners[c].1] as usize;

    let mut sides: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for (c, &next) in next.iter().enumerate() {
        sides.entry((vertex(c), vertex(next))).or_default().push(c);
    }
    let twin: Vec<Option<usize>> = (0..corners.len())
        .map(|c| {
            let (a, b) = (vertex(c), vertex(next[c]));
            let rank = sides[&(a, b)].iter().position(|&d| d == c).unwrap();
            let opposite = sides.get(&(b, a));
            opposite.and_then(|sides| sides.get(rank)).copied()
        })
        .collect();

    // Corners at a vertex that share an edge belong to the same fan. A fan is identified by its lowest corner.
    let mut fan: Vec<usize> = (0..corners.len()).collect();
    loop {
        let before = fan.clone();
        for (c, twin) in twin.iter().enumerate() {
            if let Some(t) = twin {
                let low = fan[c].min(fan[next[*t]]);
                (fan[c], fan[next[*t]]) = (low, low);
            }
        }
        if fan == before {
            break;
        }
    }
    let mut sources: Vec<usize> = (0..n_vertices).collect();
    let mut vertex_of_fan = BTreeMap::new();
    for v in 0..n_vertices {
        let fans = (0..corners.len()).filter(|&c| vertex(c) == v && fan[c] == c);
        for (i, fan) in fans.enumerate() {
            if i > 0 {
                sources.push(v);
            }
            vertex_of_fan.insert(fan, if i == 0 { v } else { sources.len() - 1 });
        }
    }
    let origin_of = |c: usize| vertex_of_fan[&fan[c]];

    let mut half_edge = vec![HalfEdgeId::NONE; corners.len()];
    let mut arrays = Connectivity::default();
    let mut first_sides = Vec::new();
    for c in 0..corners.len() {
        if half_edge[c] == HalfEdgeId::NONE {
            half_edge[c] = HalfEdgeId::new(2 * first_sides.len());
            if let Some(t) = twin[c] {
                half_edge[t] = half_edge[c].twin();
            }
            first_sides.push(c);
        }
    }
    // For each vertex on the boundary, finds the boundary half-edge that starts there. It follows the boundary
    // half-edge that ends there.
    let mut boundary = BTreeMap::new();
    for &c in first_sides.iter().filter(|&&c| twin[c].is_none()) {
        boundary.insert(origin_of(next[c]), half_edge[c].twin());
    }
    for &c in &first_sides {
        let face = |c: usize| FaceId::new(corners[c].0);
        arrays.next.push(half_edge[next[c]]);
        arrays.origin.push(VertexId::new(origin_of(c)));
        arrays.origin.push(VertexId::new(origin_of(next[c])));
        arrays.face.push(face(c));
        arrays
            .next
            .push(twin[c].map_or_else(|| boundary[&origin_of(c)], |t| half_edge[next[t]]));
        arrays.face.push(twin[c].map_or(FaceId::NONE, face));
    }
    for v in 0..sources.len() {
        let first = (0..corners.len()).find(|&c| origin_of(c) == v);
        let first = first.map_or(HalfEdgeId::NONE, |c| half_edge[c]);
        arrays
            .vertex_half_edge
            .push(boundary.get(&v).copied().unwrap_or(first));
    }
    arrays.face_half_edge = (0..polygons.len())
        .map(|f| half_edge[index_of((f, 0))])
        .collect();
    (arrays, sources)
}

#[test]
fn both_builders_agree_on_random_polygons() {
    let mut random = Random(1);
    for round in 0..600 {
        let n = 3 + random.below(if round % 5 == 0 { 40 } else { 8 });
        let polygons = random.polygons(n, if round % 5 == 0 { 60 } else { 12 });
        let (offsets, corners) = flatten(&polygons).unwrap();
        let built = build(points(n), &offsets, &corners, NonManifold::SplitAsGiven).unwrap();
        let (arrays, sources) = expected(n, &polygons);
        assert_eq!(built.mesh.connectivity(), &arrays, "{polygons:?}");
        assert_eq!(built.mesh.defects(), []);
        let copies = built.report.split_vertices.iter().map(|(v, _)| v.index());
        assert!(copies.eq(sources[n..].iter().copied()));
        for (v, &source) in sources.iter().enumerate() {
            assert_eq!(built.mesh.position(VertexId::new(v)), points(n)[source]);
        }
    }
}

#[test]
fn both_builders_agree_on_vertices_with_many_faces() {
    // In some rounds, there are vertices with more than 32 corners, which the builder sorts instead of comparing them
    // in pairs. In most rounds, most edges belong to more than two polygons.
    let mut random = Random(2);
    for _ in 0..20 {
        let polygons = random.polygons(7, 150);
        let (arrays, _) = expected(7, &polygons);
        let (offsets, corners) = flatten(&polygons).unwrap();
        let built = build(points(7), &offsets, &corners, NonManifold::SplitAsGiven).unwrap();
        assert_eq!(built.mesh.connectivity(), &arrays, "{polygons:?}");
    }
}

#[test]
fn the_report_lists_exactly_the_non_manifold_edges() {
    let mut random = Random(3);
    for round in 0..300 {
        // With few polygons, there are edges of one polygon, of two polygons and of more polygons.
        let polygons = random.polygons(5, if round % 3 == 0 { 100 } else { 10 });
        let polygons: Vec<_> = polygons.into_iter().filter(|p| p.len() == 3).collect();
        let mut counts: BTreeMap<[u32; 2], [usize; 2]> = BTreeMap::new();
        for p in polygons
            .iter()
            .filter(|p| p[0] != p[1] && p[1] != p[2] && p[2] != p[0])
        {
            for [a, b] in [[p[0], p[1]], [p[1], p[2]], [p[2], p[0]]] {
                counts.entry([a.min(b), a.max(b)]).or_default()[usize::from(a < b)] += 1;
            }
        }
        let non_manifold = counts.iter().filter(|(_, [a, b])| a.max(b) > &1);
        let non_manifold: Vec<_> = non_manifold
            .map(|(edge, _)| edge.map(|v| VertexId::new(v as usize)))
            .collect();
        let (offsets, corners) = flatten(&polygons).unwrap();
        let built = build(points(5), &offsets, &corners, NonManifold::SplitAsGiven).unwrap();
        assert_eq!(built.report.split_edges, non_manifold, "{polygons:?}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let mut random = Random(4);
    let mut polygons: Vec<Vec<u32>> = random.polygons(30_000, 60_000);
    polygons.extend((0..20_000).map(|i| vec![i, i + 1, i + 2]));
    let (offsets, corners) = flatten(&polygons).unwrap();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let build = || build(points(30_000), &offsets, &corners, NonManifold::Split).unwrap();
        pool.build().unwrap().install(build)
    };
    let one = with(1);
    assert!(!one.report.reversed_faces.is_empty() && !one.report.split_vertices.is_empty());
    for threads in [2, 8] {
        let many = with(threads);
        assert_eq!(one.mesh, many.mesh);
        assert_eq!(one.report, many.report);
        assert_eq!(one.half_edge_of_corner, many.half_edge_of_corner);
    }
}
