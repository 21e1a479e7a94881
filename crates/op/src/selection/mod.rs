//! Selections: values that say which vertices, edges or faces an operation works on.
//!
//! The three types share one algebra: `And`, `Or`, `Not`, `Grow`, `Shrink`, `Component`, choices (`Random`,
//! `Nearest`, ...) from another selection, and `Expect`, which fails unless the number of elements is
//! the expected one. A selection is evaluated once, before the first edit.

/// Defines a type of selections: the variants that all types share, and those of its own.
macro_rules! selection {
    (
        $(#[$meta:meta])*
        $name:ident($elements:literal, inside: $inside:literal, shares: $part:literal, nearest: $nearest:literal) {
            $($own:tt)*
        }
    ) => {
        $(#[$meta])*
        #[derive(
            Clone, Debug, Default, serde::Deserialize, schemars::JsonSchema, PartialEq, serde::Serialize,
        )]
        #[serde(deny_unknown_fields)]
        pub enum $name {
            #[doc = concat!("All ", $elements, ".")]
            #[default]
            All,
            $($own)*
            #[doc = $inside]
            Inside(super::Region),
            #[doc = concat!("The ", $elements, " marked by a tag of this name.")]
            Tagged(String),
            #[doc = concat!("The ", $elements, " in all of these; every one for an empty list.")]
            And(Vec<Self>),
            #[doc = concat!("The ", $elements, " in any of these; none for an empty list.")]
            Or(Vec<Self>),
            #[doc = concat!("The ", $elements, " that are not in this.")]
            Not(Box<Self>),
            #[doc = concat!("These, and those that share ", $part, " with one of them.")]
            Grow(Box<Self>),
            #[doc = concat!("Those of these that share ", $part, " with none outside.")]
            Shrink(Box<Self>),
            /// All of the connected pieces of the mesh that one of these belongs to.
            Component(Box<Self>),
            /// A random choice, the same for the same seed and step.
            Random {
                /// How many; all if there are fewer.
                count: u32,
                /// From which.
                #[serde(default)]
                of: Box<Self>,
                /// Another number gives another choice.
                seed: u64,
            },
            #[doc = $nearest]
            Nearest {
                /// The point.
                to: $crate::Vector,
                /// How many; all if there are fewer.
                #[serde(default = "super::one")]
                count: u32,
                /// From which.
                #[serde(default)]
                of: Box<Self>,
            },
            /// The same elements; refused unless there are exactly `count`.
            Expect {
                /// How many there must be.
                count: u32,
                /// Of what.
                of: Box<Self>,
            },
        }

        impl $name {
            fn shared(&self) -> super::Shared<'_, Self> {
                use super::Shared;
                match self {
                    Self::All => Shared::All,
                    Self::Inside(region) => Shared::Inside(region),
                    Self::Tagged(name) => Shared::Tagged(name),
                    Self::And(parts) => Shared::And(parts),
                    Self::Or(parts) => Shared::Or(parts),
                    Self::Not(of) => Shared::Not(of),
                    Self::Grow(of) => Shared::Grow(of),
                    Self::Shrink(of) => Shared::Shrink(of),
                    Self::Component(of) => Shared::Component(of),
                    &Self::Random { count, ref of, seed } => Shared::Random { count, of, seed },
                    &Self::Nearest { to, count, ref of } => Shared::Nearest { to, count, of },
                    &Self::Expect { count, ref of } => Shared::Expect { count, of },
                    _ => Shared::Own,
                }
            }
        }
    };
}

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
enum Shared<'a, S> {
    /// A variant that only the type itself has.
    Own,
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
        Ok(Self::marked(mesh, &mask).collect())
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
    fn elements(mesh: &Mesh) -> impl Iterator<Item = Self::Id>;

    /// The vertices of an element.
    fn vertices(mesh: &Mesh, id: Self::Id) -> impl Iterator<Item = VertexId>;

    /// The elements that have a mark.
    fn marked(mesh: &Mesh, mask: &[bool]) -> impl Iterator<Item = Self::Id> {
        Self::elements(mesh).filter(|id| mask[id.index()])
    }

    /// The word for the elements.
    const WORD: &'static str;
}

impl<S: Select> Shared<'_, S> {
    /// Evaluates the variant.
    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        Ok(match *self {
            Self::Own => unreachable!("the type evaluates its own variants"),
            Self::All => marks::<S>(mesh, |_| true),
            Self::Inside(region) => marks::<S>(mesh, |id| {
                S::vertices(mesh, id).all(|v| region.contains(mesh.position(v)))
            }),
            Self::Tagged(name) => tagged::<S>(mesh, name)?,
            Self::And(parts) => {
                let mut mask = marks::<S>(mesh, |_| true);
                for part in parts {
                    let other = part.mask(mesh, cx)?;
                    mask.iter_mut().zip(other).for_each(|(m, o)| *m &= o);
                }
                mask
            }
            Self::Or(parts) => {
                let mut mask = marks::<S>(mesh, |_| false);
                for part in parts {
                    let other = part.mask(mesh, cx)?;
                    mask.iter_mut().zip(other).for_each(|(m, o)| *m |= o);
                }
                mask
            }
            Self::Not(of) => not::<S>(mesh, &of.mask(mesh, cx)?),
            Self::Grow(of) => grow::<S>(mesh, &of.mask(mesh, cx)?),
            Self::Shrink(of) => {
                let outside = not::<S>(mesh, &of.mask(mesh, cx)?);
                not::<S>(mesh, &grow::<S>(mesh, &outside))
            }
            Self::Component(of) => {
                let vertices = touched::<S>(mesh, &of.mask(mesh, cx)?);
                touching::<S>(mesh, &walk::connected(mesh, vertices))
            }
            Self::Random { count, of, seed } => {
                let step = cx.stream.bytes().fold(0, |h, b| mix(h, u64::from(b)));
                let stream = mix(seed, step);
                lowest::<S, u64>(mesh, count, &of.mask(mesh, cx)?, |id| {
                    mix(stream, id.index() as u64)
                })
            }
            Self::Nearest { to, count, of } => {
                lowest::<S, f64>(mesh, count, &of.mask(mesh, cx)?, |id| {
                    middle::<S>(mesh, id).distance_squared(to.into())
                })
            }
            Self::Expect { count, of } => {
                let mask = of.mask(mesh, cx)?;
                let found = mask.iter().filter(|&&m| m).count();
                if found != count as usize {
                    let message =
                        format!("expected {count} {} to be selected, found {found}", S::WORD);
                    let selected = S::marked(mesh, &mask);
                    return Err(OpError::refused(Refusal::Expectation, message).about(selected));
                }
                mask
            }
        })
    }

    /// How many elements the variant can select, of `all` that there are.
    fn count(&self, all: Range, plan: &MeshPlan) -> Range {
        match self {
            Self::All => all,
            Self::Random { count, of, .. } | Self::Nearest { count, of, .. } => {
                of.count(plan).capped(u64::from(*count))
            }
            Self::Expect { count, .. } => Range::exactly(u64::from(*count)),
            Self::And(parts) => parts
                .iter()
                .fold(all, |sum, part| sum.capped(part.count(plan).max))
                .or_less(),
            _ => all.or_less(),
        }
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

/// The elements without a mark.
fn not<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    marks::<S>(mesh, |id| !mask[id.index()])
}

/// The vertices of the marked elements.
fn touched<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    let mut vertices = vec![false; mesh.domain_len(Domain::Vertex)];
    for v in S::marked(mesh, mask).flat_map(|id| S::vertices(mesh, id)) {
        vertices[v.index()] = true;
    }
    vertices
}

/// The elements that have one of the marked vertices.
fn touching<S: Select>(mesh: &Mesh, vertices: &[bool]) -> Vec<bool> {
    marks::<S>(mesh, |id| {
        S::vertices(mesh, id).any(|v| vertices[v.index()])
    })
}

/// The marked elements and all that share a vertex, or for vertices an edge, with one of them.
fn grow<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    let mut vertices = touched::<S>(mesh, mask);
    if S::Id::DOMAIN == Domain::Vertex {
        for v in S::marked(mesh, mask).flat_map(|id| S::vertices(mesh, id)) {
            mesh.vertex_neighbors(v)
                .for_each(|w| vertices[w.index()] = true);
        }
    }
    touching::<S>(mesh, &vertices)
}

/// The mean of the vertices of an element.
fn middle<S: Select>(mesh: &Mesh, id: S::Id) -> DVec3 {
    let (mut sum, mut n) = (DVec3::ZERO, 0.0);
    for v in S::vertices(mesh, id) {
        sum += mesh.position(v);
        n += 1.0;
    }
    sum / n
}

/// The `count` marked elements of the lowest keys; of equal keys the lower ids.
fn lowest<S: Select, K: PartialOrd>(
    mesh: &Mesh,
    count: u32,
    mask: &[bool],
    key: impl Fn(S::Id) -> K,
) -> Vec<bool> {
    let mut keyed: Vec<(K, S::Id)> = S::marked(mesh, mask).map(|id| (key(id), id)).collect();
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

/// The default of `count` where one is meant.
const fn one() -> u32 {
    1
}

#[cfg(test)]
mod tests;
