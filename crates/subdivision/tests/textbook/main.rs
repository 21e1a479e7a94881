//! A second, slow implementation of every scheme, as textbooks describe it. This implementation works on lists
//! of polygons, without half-edges, and computes one level at a time. The tests compare the crate with this
//! implementation.

mod butterfly;
mod charts;
mod compare;
mod comparisons;
mod doo_sabin;
mod known;
mod masks;
mod meshes;
mod numbers;
mod polygons;
mod sharpness;
mod split;
mod sqrt3;

use polygons::Polygons;
use subdivision::{Rules, Scheme};

/// Subdivides a mesh `levels` times with the textbook implementation.
fn textbook(mesh: &Polygons, rules: Rules, levels: u32) -> Polygons {
    (1..=levels).fold(mesh.clone(), |mesh, level| match rules.scheme {
        Scheme::Loop(_) | Scheme::CatmullClark | Scheme::Midpoint(_) => split::refine(&mesh, rules),
        Scheme::Butterfly => butterfly::refine(&mesh),
        Scheme::Sqrt3 => sqrt3::refine(&mesh, level % 2 == 0),
        Scheme::DooSabin => doo_sabin::refine(&mesh),
    })
}
