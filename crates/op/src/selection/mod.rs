//! Selections: values that say which vertices, edges or faces an operation works on.
//!
//! The three types share one algebra: `And`, `Or`, `Not`, `Grow`, `Shrink`, `Component`, choices (`Random`,
//! `Nearest`, ...) from another selection, and `Expect`, which fails unless the number of elements is
//! the expected one. A selection is evaluated once, before the first edit.

mod edge;
mod elements;
mod face;
mod region;
mod vertex;
mod walk;

use mesh::{DVec3, Domain, Id, Mesh, VertexId};

use crate::{Context, MeshPlan, OpError, Range, Refusal, Vector};

pub use edge::EdgeSelection;
pub use elements::{ElementKind, Elements, Selected};
pub use face::FaceSelection;
pub use region::Region;
pub use vertex::VertexSelection;

/// The part of the algebra that all selections share.
pub(crate) enum Shared<'a, S> {
    /// Every element.
    All,
    /// Elements whose vertices all lie in a region.
    Inside(&'a Region),
    /// Elements marked by a tag.
    Tagged(&'a str),
    /// Elements in all of these.
    And(&'a [S]),
    /// Elements in any of these.
    Or(&'a [S]),
    /// Elements not in this.
    Not(&'a S),
    /// These and the elements that share a vertex with one of them.
    Grow(&'a S),
    /// Those of which no element that shares a vertex is outside.
    Shrink(&'a S),
    /// These and all elements that edges lead to from them.
    Component(&'a S),
    /// So many, drawn by chance.
    Random { count: u32, of: &'a S, seed: u64 },
    /// The so many whose middles are nearest to a point.
    Nearest { to: Vector, count: u32, of: &'a S },
    /// These, which must be so many.
    Expect { count: u32, of: &'a S },
}

/// What the three types of selections have in common.
pub trait Select: Sized + Sync {
    /// The ids of the elements.
    type Id: Id;

    /// The elements that are selected, in order of their ids.
    ///
    /// # Errors
    ///
    /// [`Refusal::Missing`] if an element that is named is not there or nothing has a tag that is named,
    /// [`Refusal::Expectation`] if an expected number is not met.
    fn resolve(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<Self::Id>, OpError> {
        let mask = self.mask(mesh, cx)?;
        Ok(Self::elements(mesh)
            .into_iter()
            .filter(|id| mask[id.index()])
            .collect())
    }

    /// The selection as a mark for each element, by index.
    ///
    /// # Errors
    ///
    /// As [`resolve`](Self::resolve).
    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError>;

    /// How many elements of a planned mesh can be selected.
    fn count(&self, plan: &MeshPlan) -> Range;

    /// All elements of a mesh.
    fn elements(mesh: &Mesh) -> Vec<Self::Id>;

    /// The vertices of an element.
    fn vertices(mesh: &Mesh, id: Self::Id) -> Vec<VertexId>;

    /// The word for the elements.
    const WORD: &'static str;
}

/// Evaluates the shared part of the algebra.
fn shared_mask<S: Select>(
    shared: &Shared<S>,
    mesh: &Mesh,
    cx: &Context,
) -> Result<Vec<bool>, OpError> {
    Ok(match shared {
        Shared::All => marks::<S>(mesh, |_| true),
        Shared::Inside(region) => marks::<S>(mesh, |id| {
            S::vertices(mesh, id)
                .iter()
                .all(|&v| region.contains(mesh.position(v)))
        }),
        Shared::Tagged(name) => tagged::<S>(mesh, name)?,
        Shared::And(parts) => {
            let mut mask = marks::<S>(mesh, |_| true);
            for part in *parts {
                let other = part.mask(mesh, cx)?;
                mask.iter_mut().zip(other).for_each(|(m, o)| *m &= o);
            }
            mask
        }
        Shared::Or(parts) => {
            let mut mask = marks::<S>(mesh, |_| false);
            for part in *parts {
                let other = part.mask(mesh, cx)?;
                mask.iter_mut().zip(other).for_each(|(m, o)| *m |= o);
            }
            mask
        }
        Shared::Not(of) => {
            let mask = of.mask(mesh, cx)?;
            marks::<S>(mesh, |id| !mask[id.index()])
        }
        Shared::Grow(of) => grow::<S>(mesh, &of.mask(mesh, cx)?),
        Shared::Shrink(of) => {
            let mask = of.mask(mesh, cx)?;
            let outside = grow::<S>(mesh, &marks::<S>(mesh, |id| !mask[id.index()]));
            marks::<S>(mesh, |id| !outside[id.index()])
        }
        Shared::Component(of) => {
            let mut vertices = vec![false; mesh.domain_len(Domain::Vertex)];
            for v in (of.resolve(mesh, cx)?.into_iter()).flat_map(|id| S::vertices(mesh, id)) {
                vertices[v.index()] = true;
            }
            let vertices = walk::connected(mesh, vertices);
            marks::<S>(mesh, |id| {
                S::vertices(mesh, id).iter().any(|v| vertices[v.index()])
            })
        }
        Shared::Random { count, of, seed } => {
            let stream = mix(
                *seed,
                cx.stream.bytes().fold(0, |h, b| mix(h, u64::from(b))),
            );
            lowest::<S, u64>(mesh, *count, &of.mask(mesh, cx)?, |id| {
                mix(stream, id.index() as u64)
            })
        }
        Shared::Nearest { to, count, of } => {
            let to = DVec3::from(*to);
            lowest::<S, f64>(mesh, *count, &of.mask(mesh, cx)?, |id| {
                middle::<S>(mesh, id).distance_squared(to)
            })
        }
        Shared::Expect { count, of } => {
            let mask = of.mask(mesh, cx)?;
            let found = mask.iter().filter(|&&m| m).count();
            if found != *count as usize {
                let message = format!("expected {count} {} to be selected, found {found}", S::WORD);
                let selected = S::elements(mesh).into_iter().filter(|id| mask[id.index()]);
                return Err(OpError::refused(Refusal::Expectation, message).about(selected));
            }
            mask
        }
    })
}

/// How many elements the shared part of the algebra can select, of `all` that there are.
fn shared_count<S: Select>(shared: &Shared<S>, all: Range, plan: &MeshPlan) -> Range {
    match shared {
        Shared::All => all,
        Shared::Random { count, of, .. } | Shared::Nearest { count, of, .. } => {
            of.count(plan).capped(Range::exactly(u64::from(*count)))
        }
        Shared::Expect { count, .. } => Range::exactly(u64::from(*count)),
        Shared::And(parts) => parts
            .iter()
            .fold(all, |sum, part| sum.capped(part.count(plan).or_less()))
            .or_less(),
        Shared::Inside(_)
        | Shared::Tagged(_)
        | Shared::Or(_)
        | Shared::Not(_)
        | Shared::Grow(_)
        | Shared::Shrink(_)
        | Shared::Component(_) => all.or_less(),
    }
}

/// A mask from a question to each element.
fn marks<S: Select>(mesh: &Mesh, ask: impl Fn(S::Id) -> bool) -> Vec<bool> {
    let mut mask = vec![false; mesh.domain_len(S::Id::DOMAIN)];
    for id in S::elements(mesh) {
        mask[id.index()] = ask(id);
    }
    mask
}

fn tagged<S: Select>(mesh: &Mesh, name: &str) -> Result<Vec<bool>, OpError> {
    if let Some(mask) = mesh.tag(S::Id::DOMAIN, name) {
        return Ok(mask.to_vec());
    }
    let tags: Vec<&str> = mesh
        .attributes()
        .of(S::Id::DOMAIN)
        .iter()
        .filter(|c| matches!(c.values, mesh::Values::Tag(_)))
        .map(|c| c.name.as_str())
        .collect();
    let known = if tags.is_empty() {
        "none".to_owned()
    } else {
        tags.join(", ")
    };
    let message = format!("no {} are tagged \"{name}\"; tags: {known}", S::WORD);
    Err(OpError::refused(Refusal::Missing, message))
}

/// The marked elements and all that share a vertex with one of them.
fn grow<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    let mut touched = vec![false; mesh.domain_len(Domain::Vertex)];
    for id in S::elements(mesh).into_iter().filter(|id| mask[id.index()]) {
        for v in S::vertices(mesh, id) {
            touched[v.index()] = true;
            if S::Id::DOMAIN == Domain::Vertex {
                // Vertices share an edge with their neighbours, not a vertex.
                mesh.vertex_neighbors(v)
                    .for_each(|w| touched[w.index()] = true);
            }
        }
    }
    marks::<S>(mesh, |id| {
        S::vertices(mesh, id).iter().any(|v| touched[v.index()])
    })
}

/// The mean of the vertices of an element.
fn middle<S: Select>(mesh: &Mesh, id: S::Id) -> DVec3 {
    let vertices = S::vertices(mesh, id);
    vertices.iter().map(|&v| mesh.position(v)).sum::<DVec3>() / vertices.len() as f64
}

/// The `count` marked elements of the lowest keys; of equal keys the lower ids.
fn lowest<S: Select, K: PartialOrd>(
    mesh: &Mesh,
    count: u32,
    mask: &[bool],
    key: impl Fn(S::Id) -> K,
) -> Vec<bool> {
    let mut keyed: Vec<(K, S::Id)> = S::elements(mesh)
        .into_iter()
        .filter(|id| mask[id.index()])
        .map(|id| (key(id), id))
        .collect();
    // Positions are finite, so that keys compare.
    keyed.sort_by(|a, b| a.partial_cmp(b).expect("keys are numbers"));
    let mut chosen = vec![false; mask.len()];
    for (_, id) in keyed.into_iter().take(count as usize) {
        chosen[id.index()] = true;
    }
    chosen
}

/// A hash of two numbers: the output function of SplitMix64 on their combination.
///
/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
fn mix(key: u64, counter: u64) -> u64 {
    let mut z = key ^ counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A named vertex, if it is there.
fn named_vertex(mesh: &Mesh, index: u32) -> Result<VertexId, OpError> {
    let v = VertexId::new((index as usize).min(u32::MAX as usize - 1));
    if mesh.has_vertex(v) {
        return Ok(v);
    }
    let n = mesh.n_vertices();
    Err(OpError::refused(
        Refusal::Missing,
        format!("there is no vertex {index}, only {n} vertices"),
    ))
}

/// The arm of `shared()` that every selection has.
macro_rules! shared {
    ($selection:expr) => {
        match $selection {
            Self::All => Some(Shared::All),
            Self::Inside(region) => Some(Shared::Inside(region)),
            Self::Tagged(name) => Some(Shared::Tagged(name)),
            Self::And(parts) => Some(Shared::And(parts)),
            Self::Or(parts) => Some(Shared::Or(parts)),
            Self::Not(of) => Some(Shared::Not(of)),
            Self::Grow(of) => Some(Shared::Grow(of)),
            Self::Shrink(of) => Some(Shared::Shrink(of)),
            Self::Component(of) => Some(Shared::Component(of)),
            Self::Random { count, of, seed } => Some(Shared::Random {
                count: *count,
                of,
                seed: *seed,
            }),
            Self::Nearest { to, count, of } => Some(Shared::Nearest {
                to: *to,
                count: *count,
                of,
            }),
            Self::Expect { count, of } => Some(Shared::Expect { count: *count, of }),
            _ => None,
        }
    };
}
use shared;

/// The default of `count` where one is meant.
const fn one() -> u32 {
    1
}

#[cfg(test)]
mod tests;
