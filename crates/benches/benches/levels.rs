//! Measures the faces per second that subdivision computes, with full connectivity, and compares the time with the memory
//! bandwidth of the machine. `tests/oracle` measures `OpenSubdiv` with the same cases.
//!
//! `cargo bench -p meshwright-benches --bench levels` prints, for one thread and two, the median time from the control mesh in
//! memory to the refined mesh in memory, the faces per second, the bytes of the result, and the faces per second that
//! copying or filling memory of this size would reach.

#![expect(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use geometry::shapes;
use mesh::Mesh;
use progress::NoProgress;
use rayon::prelude::*;
use subdivision::{LoopWeights, Rules, Scheme};

/// Number of measured runs, after one to warm up.
const RUNS: usize = 9;

fn main() {
    // `cargo test` also runs the benchmarks, to check that they work.
    let is_test = std::env::args().any(|a| a == "--test");
    let cases = [
        (
            "Loop, icosahedron",
            Scheme::Loop(LoopWeights::Warren),
            shapes::icosahedron(),
            9,
        ),
        (
            "Loop, 100,352 triangles",
            Scheme::Loop(LoopWeights::Warren),
            triangles(),
            3,
        ),
        (
            "Catmull-Clark, 33,451 mixed faces",
            Scheme::CatmullClark,
            mixed(),
            3,
        ),
    ];
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool of one or two threads").install(|| {
            println!("{threads} thread{}", if threads == 1 { "" } else { "s" });
            let n = if is_test { 1 << 20 } else { 256 << 20 };
            let (copy, fill) = bandwidth(n);
            println!("  copying {copy:.1} GB/s, filling new memory {fill:.1} GB/s");
            for (name, scheme, cage, levels) in &cases {
                let levels = if is_test { 1 } else { *levels };
                measure(name, Rules::of(*scheme), cage, levels, [copy, fill]);
            }
        });
    }
}

/// Measures one case and prints a line.
fn measure(name: &str, rules: Rules, cage: &Mesh, levels: u32, [copy, fill]: [f64; 2]) {
    let refined = |levels: u32| {
        subdivision::subdivide(cage, rules, levels, &NoProgress)
            .expect("a mesh that the scheme accepts")
    };
    let run = || refined(levels);
    let result = run();
    let (faces, bytes) = (result.n_faces() as f64, result.bytes() as f64);
    drop(result);
    // The bytes that the last level reads at least once.
    let read = refined(levels - 1).bytes() as f64;
    let seconds = median(|| {
        let start = Instant::now();
        let mesh = black_box(run());
        let time = start.elapsed();
        drop(mesh);
        time
    });
    println!(
        "  {name}, {levels} levels: {:.0} ms, {:.2} M faces, {:.1} M/s; the last \
         level reads {:.0} MB and writes {:.0} MB; copying would reach \
         {:.0} M/s and filling {:.0} M/s",
        seconds * 1e3,
        faces / 1e6,
        faces / seconds / 1e6,
        read / 1e6,
        bytes / 1e6,
        copy * 1e9 / bytes * faces / 1e6,
        fill * 1e9 / bytes * faces / 1e6,
    );
}

/// Measures bandwidth in GB per second: copying from one array to another, and filling new memory.
fn bandwidth(n: usize) -> (f64, f64) {
    const CHUNK: usize = 1 << 16;
    let source = vec![1_u8; n];
    let mut target = vec![2_u8; n];
    let copy = median(|| {
        let start = Instant::now();
        let chunks = target.par_chunks_mut(CHUNK).zip(source.par_chunks(CHUNK));
        chunks.for_each(|(to, from)| to.copy_from_slice(from));
        black_box(&mut target);
        start.elapsed()
    });
    let fill = median(|| {
        let start = Instant::now();
        let mut new: Vec<u8> = mesh::zeroed(n);
        new.par_chunks_mut(CHUNK).for_each(|chunk| chunk.fill(3));
        black_box(&mut new);
        start.elapsed()
    });
    (n as f64 / copy / 1e9, n as f64 / fill / 1e9)
}

/// Returns the median time of the runs, in seconds.
fn median(mut run: impl FnMut() -> Duration) -> f64 {
    run();
    let mut times: Vec<f64> = (0..RUNS).map(|_| run().as_secs_f64()).collect();
    times.sort_unstable_by(f64::total_cmp);
    times[RUNS / 2]
}

/// A torus of 100,352 triangles.
fn triangles() -> Mesh {
    shapes::fans(&shapes::torus(224, 224, 2.0, 1.0))
}

/// A torus of 33,451 faces: one of every three squares is split into two triangles.
fn mixed() -> Mesh {
    let torus = shapes::torus(224, 112, 2.0, 1.0);
    let mut polygons: Vec<Vec<u32>> = Vec::new();
    for f in torus.faces() {
        let corners = torus.face_vertices(f);
        let v: Vec<u32> = corners
            .map(|v| u32::try_from(v.index()).expect("a small mesh"))
            .collect();
        if f.index().is_multiple_of(3) {
            polygons.push(vec![v[0], v[1], v[2]]);
            polygons.push(vec![v[0], v[2], v[3]]);
        } else {
            polygons.push(v);
        }
    }
    let (mesh, _) = Mesh::from_polygons(torus.positions().to_vec(), &polygons).expect("a torus");
    mesh
}
