//! Every scheme once more, slowly, as textbooks write it: on lists of polygons, without half-edges, one
//! level after the other. The crate must give the same.

mod against;
mod butterfly;
mod charts;
mod compare;
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

/// So many levels, as the textbook has them.
fn textbook(mesh: &Polygons, rules: Rules, levels: u32) -> Polygons {
    (1..=levels).fold(mesh.clone(), |mesh, level| match rules.scheme {
        Scheme::Loop(_) | Scheme::CatmullClark | Scheme::Midpoint(_) => split::refine(&mesh, rules),
        Scheme::Butterfly => butterfly::refine(&mesh),
        Scheme::Sqrt3 => sqrt3::refine(&mesh, level % 2 == 0),
        Scheme::DooSabin => doo_sabin::refine(&mesh),
    })
}
