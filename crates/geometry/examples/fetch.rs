use mesh::{DVec3, EdgeId, Mesh};
use std::time::Instant;

fn shuffle<T>(values: &mut [T]) {
    let mut state = 1_u64;
    for i in (1..values.len()).rev() {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        values.swap(i, (state >> 33) as usize % (i + 1));
    }
}

fn main() {
    let quads = geometry::shapes::torus(1000, 500, 2.0, 1.0);
    let triangles: Vec<[u32; 3]> = quads
        .faces()
        .flat_map(|f| {
            let v: Vec<u32> = quads.face_vertices(f).map(|v| v.index() as u32).collect();
            [[v[0], v[1], v[2]], [v[0], v[2], v[3]]]
        })
        .collect();
    let ordered = Mesh::from_polygons(quads.positions().to_vec(), &triangles)
        .unwrap()
        .0;
    let mut order: Vec<u32> = (0..quads.n_vertices() as u32).collect();
    shuffle(&mut order);
    let mut moved: Vec<DVec3> = quads.positions().to_vec();
    for (p, &v) in quads.positions().iter().zip(&order) {
        moved[v as usize] = *p;
    }
    let mut t2: Vec<[u32; 3]> = triangles
        .iter()
        .map(|t| t.map(|v| order[v as usize]))
        .collect();
    shuffle(&mut t2);
    let random = Mesh::from_polygons(moved, &t2).unwrap().0;
    for (name, mesh, shuffled) in [
        ("ordered mesh, index order", &ordered, false),
        ("ordered mesh, shuffled order", &ordered, true),
        ("shuffled mesh, index order", &random, false),
    ] {
        let mut edges: Vec<EdgeId> = mesh.edges().collect();
        if shuffled {
            shuffle(&mut edges);
        }
        for _ in 0..3 {
            for fetch in [false, true] {
                let mut m = mesh.clone();
                m.begin();
                let start = Instant::now();
                let mut done = 0;
                for (i, &e) in edges.iter().enumerate() {
                    if fetch {
                        m.fetch_ahead(&edges, i);
                    }
                    done += usize::from(m.flip_edge(e).is_ok());
                }
                println!(
                    "{name}: fetch {fetch}: {:.0} ms ({done} flips)",
                    start.elapsed().as_secs_f64() * 1e3
                );
            }
        }
    }
}
