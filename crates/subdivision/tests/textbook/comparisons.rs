//! Compares the crate with the textbook implementation.

use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split, subdivide};

use crate::compare::{difference, mesh_of};
use crate::meshes::{self, Islands, Named, Pattern, Random};
use crate::polygons::Polygons;
use crate::textbook;

const BOUNDARIES: [Boundary; 3] = [
    Boundary::EdgesOnly,
    Boundary::EdgesAndCorners,
    Boundary::Fixed,
];
const CREASINGS: [Creasing; 2] = [Creasing::Uniform, Creasing::Chaikin];
const FACE_VARYING: [FaceVarying; 6] = [
    FaceVarying::None,
    FaceVarying::CornersOnly,
    FaceVarying::CornersPlus1,
    FaceVarying::CornersPlus2,
    FaceVarying::Boundaries,
    FaceVarying::All,
];

/// Collects differences between the crate and the textbook implementation.
#[derive(Debug, Default)]
struct Comparison {
    compared: usize,
    differences: Vec<String>,
}

impl Comparison {
    /// Compares the results for one mesh and records a difference.
    fn compare(&mut self, name: &str, mesh: &Polygons, rules: Rules, levels: u32) {
        self.compared += 1;
        let found = subdivide(&mesh_of(mesh), rules, levels, &progress::NoProgress);
        let difference = match found {
            Ok(found) => difference(&found, &textbook(mesh, rules, levels)),
            Err(error) => Some(format!("{error:?}")),
        };
        if let Some(difference) = difference {
            self.differences.push(format!(
                "{name}, {levels} levels, {rules:?}:\n    {difference}"
            ));
        }
    }

    /// Panics with the first differences, if any.
    fn finish(&self) {
        let first: Vec<&str> = self
            .differences
            .iter()
            .take(12)
            .map(String::as_str)
            .collect();
        assert!(
            first.is_empty(),
            "{} of {} differ:\n{}",
            self.differences.len(),
            self.compared,
            first.join("\n")
        );
    }
}

/// Returns the number of levels to test, which is lower for large meshes.
fn levels_of(mesh: &Polygons) -> u32 {
    if mesh.faces.len() <= 12 { 3 } else { 2 }
}

/// Compares the crate with the textbook implementation for a smooth scheme. Tests every boundary rule, creasing rule
/// and sharpness pattern on each mesh.
fn compare_sharp(meshes: &[Named], scheme: Scheme) {
    let mut comparison = Comparison::default();
    let mut random = Random(3);
    for (name, mesh) in meshes {
        for boundary in BOUNDARIES {
            for creasing in CREASINGS {
                for pattern in Pattern::ALL {
                    let rules = Rules {
                        boundary,
                        creasing,
                        ..Rules::of(scheme)
                    };
                    let mesh = pattern.on(mesh, &mut random);
                    for levels in 1..=levels_of(&mesh) {
                        let name = format!("{name}, {pattern:?}");
                        comparison.compare(&name, &mesh, rules, levels);
                    }
                }
            }
        }
    }
    comparison.finish();
}

/// Compares the crate with the textbook implementation for a scheme without options.
fn compare_plain(meshes: &[Named], scheme: Scheme) {
    let mut comparison = Comparison::default();
    for (name, mesh) in meshes {
        for levels in 0..=levels_of(mesh) + 1 {
            comparison.compare(name, mesh, Rules::of(scheme), levels);
        }
    }
    comparison.finish();
}

/// Compares the crate with the textbook implementation on meshes with corner values. Tests every face-varying rule on
/// each mesh, with and without sharp elements.
fn compare_corner_values(meshes: &[Named], scheme: Scheme) {
    let mut comparison = Comparison::default();
    let mut random = Random(4);
    for (name, mesh) in meshes {
        for face_varying in FACE_VARYING {
            for islands in Islands::ALL {
                for pattern in [Pattern::Smooth, Pattern::Mixed, Pattern::FewEdges] {
                    let boundary = random.one_of(&BOUNDARIES);
                    let creasing = random.one_of(&CREASINGS);
                    let rules = Rules {
                        scheme,
                        boundary,
                        creasing,
                        face_varying,
                    };
                    let mesh = pattern.on(&islands.on(mesh, &mut random), &mut random);
                    for levels in 1..=levels_of(&mesh) {
                        let name = format!("{name}, {pattern:?}, {islands:?}");
                        comparison.compare(&name, &mesh, rules, levels);
                    }
                }
            }
        }
    }
    comparison.finish();
}

#[test]
fn loop_with_the_weights_of_warren() {
    compare_sharp(&meshes::triangles(), Scheme::Loop(LoopWeights::Warren));
}

#[test]
fn loop_with_the_weights_of_loop() {
    compare_sharp(&meshes::triangles(), Scheme::Loop(LoopWeights::Loop));
}

#[test]
fn catmull_clark_on_polygons() {
    compare_sharp(&meshes::polygons(), Scheme::CatmullClark);
}

#[test]
fn catmull_clark_on_triangles() {
    compare_sharp(&meshes::triangles(), Scheme::CatmullClark);
}

#[test]
fn midpoints_of_triangles() {
    compare_plain(&meshes::triangles(), Scheme::Midpoint(Split::Triangles));
}

#[test]
fn midpoints_of_polygons() {
    compare_plain(&meshes::polygons(), Scheme::Midpoint(Split::Quads));
}

#[test]
fn butterfly() {
    compare_plain(&meshes::triangles(), Scheme::Butterfly);
}

#[test]
fn sqrt3() {
    compare_plain(&meshes::triangles(), Scheme::Sqrt3);
}

#[test]
fn doo_sabin() {
    compare_plain(&meshes::polygons(), Scheme::DooSabin);
    compare_plain(&meshes::triangles(), Scheme::DooSabin);
}

#[test]
fn corner_values_with_loop() {
    compare_corner_values(&meshes::triangles(), Scheme::Loop(LoopWeights::Loop));
}

#[test]
fn corner_values_with_midpoints() {
    let mut comparison = Comparison::default();
    let mut random = Random(6);
    for (name, mesh) in meshes::polygons() {
        for face_varying in FACE_VARYING {
            let mesh = Islands::Four.on(&mesh, &mut random);
            let rules = Rules {
                face_varying,
                ..Rules::of(Scheme::Midpoint(Split::Quads))
            };
            comparison.compare(&name, &mesh, rules, 2);
        }
    }
    comparison.finish();
}

#[test]
fn corner_values_with_catmull_clark() {
    compare_corner_values(&meshes::polygons(), Scheme::CatmullClark);
}
