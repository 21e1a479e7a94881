//! One level of subdivision: a topology computes the connectivity, masks compute the positions, and both
//! together compute the attributes.

use mesh::Mesh;
use progress::{Cancelled, Meter};

use crate::attributes;
use crate::doo_sabin::DooSabin;
use crate::masks::{AnyMasks, ButterflyMasks, CatmullClarkMasks, LoopMasks, MidpointMasks};
use crate::quads::Quads;
use crate::rules::{Rules, Scheme, Split};
use crate::sharpness::Sharpness;
use crate::sqrt3::Sqrt3;
use crate::topology::Topology;
use crate::triangles::Triangles;

/// Computes one level of a dense mesh, which is a mesh without deleted elements. `level` is the index of the level,
/// counted from 0. The caller must have checked that the scheme accepts all faces, and that the next level is not too
/// large.
pub(crate) fn finer(
    mesh: &Mesh,
    rules: Rules,
    level: u32,
    meter: &Meter,
) -> Result<Mesh, Cancelled> {
    let sharpness = Sharpness::of(mesh, rules);
    with_level(mesh, rules, level, sharpness, |topology, masks| {
        build(mesh, rules, sharpness, topology, masks, meter)
    })
}

/// Calls `visit` with the topology of one level, which computes the connectivity, and with the masks, which compute the
/// positions.
pub(crate) fn with_level<T>(
    mesh: &Mesh,
    rules: Rules,
    level: u32,
    sharpness: Sharpness,
    visit: impl FnOnce(&dyn Topology, &dyn AnyMasks) -> T,
) -> T {
    match rules.scheme {
        Scheme::DooSabin => {
            let topology = DooSabin::new(mesh);
            visit(&topology, &topology)
        }
        Scheme::Sqrt3 => {
            let topology = Sqrt3::new(mesh, level);
            visit(&topology, &topology)
        }
        Scheme::Butterfly => visit(&Triangles(mesh), &ButterflyMasks(mesh)),
        Scheme::Loop(_) | Scheme::Midpoint(Split::Triangles) => {
            with_masks(mesh, rules, sharpness, |masks| {
                visit(&Triangles(mesh), masks)
            })
        }
        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => {
            with_masks(mesh, rules, sharpness, |masks| {
                visit(&Quads::new(mesh), masks)
            })
        }
    }
}

/// Calls `visit` with the masks of a scheme that supports local refinement (Loop, Catmull-Clark or Midpoint).
pub(crate) fn with_masks<T>(
    mesh: &Mesh,
    rules: Rules,
    sharpness: Sharpness,
    visit: impl FnOnce(&dyn AnyMasks) -> T,
) -> T {
    match rules.scheme {
        Scheme::Loop(weights) => visit(&LoopMasks {
            mesh,
            sharpness,
            weights,
        }),
        Scheme::CatmullClark => visit(&CatmullClarkMasks { mesh, sharpness }),
        _ => visit(&MidpointMasks(mesh)),
    }
}

/// Builds the next subdivision level of a mesh without deleted elements: connectivity, positions and attributes.
pub(crate) fn build(
    mesh: &Mesh,
    rules: Rules,
    sharpness: Sharpness,
    topology: &dyn Topology,
    masks: &dyn AnyMasks,
    meter: &Meter,
) -> Result<Mesh, Cancelled> {
    let connectivity = topology.connectivity(meter)?;
    let n = connectivity.vertex_half_edge.len();
    let positions = masks.values(n, mesh.positions(), meter)?;
    let mut finer = Mesh::from_arrays(connectivity, positions);
    if mesh.attributes().iter().next().is_some() {
        let sources = attributes::AttributeSources {
            mesh,
            finer: &finer,
            topology,
            masks,
            sharpness: rules.scheme.has_creases().then_some(sharpness),
            rules,
        };
        let attributes = sources.attributes(meter)?;
        finer.set_attributes(attributes);
    }
    Ok(finer)
}
