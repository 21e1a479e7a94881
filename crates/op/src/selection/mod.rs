//! Selections: values that describe which vertices, edges or faces an operation works on.
//!
//! The selection types for vertices, edges and faces have many variants in common: `And`, `Or`, `Not`, `Grow`,
//! `Shrink`, `Component`, choices from another selection (`Random`, `Nearest` and others), and `Expect`. `Expect`
//! checks the number of elements of another selection. A step evaluates its selections once, before the first edit.

/// Defines a selection type. The type gets the variants that all three types share, and its own variants.
macro_rules! selection {
    (
        $(#[$meta:meta])*
        $name:ident(
            $elements:literal,
            inside: $inside:literal,
            inside_of: $inside_of:literal,
            shares: $part:literal,
            nearest: $nearest:literal
        ) {
            $($own:tt)*
        }
    ) => {
        $(#[$meta])*
        #[derive(
            Clone, Debug, Default, serde::Deserialize, schemars::JsonSchema, PartialEq, serde::Serialize,
        )]
        #[serde(deny_unknown_fields, remote = "Self")]
        #[schemars(!remote)]
        pub enum $name {
            #[doc = concat!("All ", $elements, ".")]
            #[default]
            All,
            $($own)*
            #[doc = $inside]
            Inside(super::Region),
            #[doc = concat!(
                $inside_of, " the mesh of another object, given by its name. A point is inside if the winding number \
                 of the mesh around the point is above 1/2 or below -1/2. Small gaps in the mesh are allowed."
            )]
            InsideOf(String),
            #[doc = concat!("The ", $elements, " with the tag of this name. Refused if no tag of ", $elements,
                " has this name.")]
            Tagged(String),
            #[doc = concat!("The ", $elements, " whose attribute has a value in a range. Refused if no attribute of ",
                $elements, " has this name.")]
            Where {
                /// The name of the attribute.
                attribute: String,
                /// The index of the component of a vector, starting at 0. Required if the attribute is a vector, and
                /// not allowed if it is a number.
                #[serde(default)]
                #[schemars(range(max = 3))]
                component: Option<u32>,
                /// Only values above this number. At least one of the bounds `above` and `below` is required.
                #[serde(default)]
                above: Option<$crate::Number>,
                /// Only values below this number.
                #[serde(default)]
                below: Option<$crate::Number>,
            },
            #[doc = concat!("The ", $elements, " in all of these selections. An empty list selects all ", $elements, ".")]
            And(Vec<Self>),
            #[doc = concat!("The ", $elements, " in at least one of these selections. An empty list selects no ",
                $elements, ".")]
            Or(Vec<Self>),
            #[doc = concat!("The ", $elements, " that are not in this selection.")]
            Not(Box<Self>),
            #[doc = concat!("This selection and the ", $elements, " that share ", $part, " with it.")]
            Grow(Box<Self>),
            #[doc = concat!(
                "This selection without the ", $elements, " that share ", $part, " with ", $elements,
                " outside the selection."
            )]
            Shrink(Box<Self>),
            #[doc = concat!(
                "The ", $elements, " of all connected components that contain an element of this selection."
            )]
            Component(Box<Self>),
            /// A random choice of `count` elements from the selection `of`. The same step with the same seed makes the
            /// same choice in each run. Two steps with the same seed choose independently of each other.
            Random {
                #[doc = concat!("The number of ", $elements, ". If fewer are available, all are selected.")]
                count: u32,
                /// The selection to choose from.
                #[serde(default)]
                of: Box<Self>,
                /// The seed. A different seed gives a different choice.
                seed: u64,
            },
            #[doc = $nearest]
            Nearest {
                /// The point.
                to: $crate::Vector,
                #[doc = concat!("The number of ", $elements, ". If fewer are available, all are selected.")]
                #[serde(default = "super::one")]
                count: u32,
                /// The selection to choose from.
                #[serde(default)]
                of: Box<Self>,
            },
            /// The elements of the selection `of`. The step fails with the reason `Expectation` unless `of` has exactly
            /// `count` elements.
            Expect {
                #[doc = concat!("The expected number of ", $elements, ".")]
                count: u32,
                /// The selection to count.
                of: Box<Self>,
            },
        }

        $crate::compiled_once::compiled_once!($name);

        impl $name {
            fn shared(&self) -> super::Shared<'_, Self> {
                use super::Shared;
                match self {
                    Self::All => Shared::All,
                    Self::Inside(region) => Shared::Inside(region),
                    Self::InsideOf(name) => Shared::InsideOf(name),
                    Self::Tagged(name) => Shared::Tagged(name),
                    Self::Where { attribute, component, above, below } => Shared::Where {
                        attribute,
                        component: *component,
                        above: *above,
                        below: *below,
                    },
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

mod attribute;
mod edge;
mod elements;
mod face;
mod region;
mod vertex;
mod walk;

use geometry::surface_index::{SurfaceIndex, Winding};
use mesh::{DVec3, Domain, Id, Mesh, VertexId};

use crate::{Context, MeshPlan, Number, OpError, Range, Refusal, Vector};

pub use attribute::check_component;
pub use edge::EdgeSelection;
pub use elements::{ElementKind, Elements, Selected};
pub use face::FaceSelection;
pub use region::Region;
pub use vertex::VertexSelection;

/// The variants that all selection types share. The macro `selection` documents each variant.
enum Shared<'a, S> {
    /// Stands for every variant that the selection types do not share.
    Own,
    All,
    Inside(&'a Region),
    InsideOf(&'a str),
    Tagged(&'a str),
    Where {
        attribute: &'a str,
        component: Option<u32>,
        above: Option<Number>,
        below: Option<Number>,
    },
    And(&'a [S]),
    Or(&'a [S]),
    Not(&'a S),
    Grow(&'a S),
    Shrink(&'a S),
    Component(&'a S),
    Random {
        count: u32,
        of: &'a S,
        seed: u64,
    },
    Nearest {
        to: Vector,
        count: u32,
        of: &'a S,
    },
    Expect {
        count: u32,
        of: &'a S,
    },
}

/// The common interface of the three selection types.
pub trait Select: Sized + Sync {
    /// The id type of the elements.
    type Id: Id;

    /// Returns the selected elements, in order of their ids.
    ///
    /// # Errors
    ///
    /// Returns [`Refusal::Missing`] if a given element, tag, attribute or material does not exist, or if no path
    /// exists. Returns [`Refusal::Expectation`] if a selection `Expect` does not have the expected number of elements.
    fn resolve(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<Self::Id>, OpError> {
        let mask = self.mask(mesh, cx)?;
        Ok(Self::marked(mesh, &mask).collect())
    }

    /// Returns one flag for each element, at the index of the element. The flag says whether the element is selected.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`resolve`](Self::resolve).
    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError>;

    /// Returns how many elements this selection selects in a planned mesh, as a range.
    fn count(&self, plan: &MeshPlan) -> Range;

    /// Returns all elements of a mesh.
    fn elements(mesh: &Mesh) -> impl Iterator<Item = Self::Id>;

    /// Returns the vertices of an element.
    fn vertices(mesh: &Mesh, id: Self::Id) -> impl Iterator<Item = VertexId>;

    /// Returns the elements whose flags in `mask` are true.
    fn marked(mesh: &Mesh, mask: &[bool]) -> impl Iterator<Item = Self::Id> {
        Self::elements(mesh).filter(|id| mask[id.index()])
    }

    /// The plural word for the elements: `vertices`, `edges` or `faces`.
    const WORD: &'static str;
}

impl<S: Select> Shared<'_, S> {
    /// Returns a mask: one flag for each element. The flag says whether this variant selects the element.
    fn mask(&self, mesh: &Mesh, cx: &Context) -> Result<Vec<bool>, OpError> {
        Ok(match *self {
            Self::Own => {
                unreachable!(
                    "each selection type evaluates its own variants, which the other types do not have"
                )
            }
            Self::All => marks::<S>(mesh, |_| true),
            Self::Inside(region) => marks::<S>(mesh, |id| {
                S::vertices(mesh, id).all(|v| region.contains(mesh.position(v)))
            }),
            Self::InsideOf(name) => {
                let inside = inside_of(mesh, name, cx)?;
                marks::<S>(mesh, |id| S::vertices(mesh, id).all(|v| inside[v.index()]))
            }
            Self::Tagged(name) => tagged::<S>(mesh, name)?,
            Self::Where {
                attribute,
                component,
                above,
                below,
            } => {
                let value = attribute::component_of::<S>(mesh, attribute, component)?;
                if above.is_none() && below.is_none() {
                    let message = "`Where` needs `above`, `below` or both";
                    return Err(OpError::Parameter(message.to_owned()));
                }
                let is_in = |x: f64| {
                    above.is_none_or(|above| x > above.get())
                        && below.is_none_or(|below| x < below.get())
                };
                marks::<S>(mesh, |id| is_in(value(id.index())))
            }
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
                let mask = of.mask(mesh, cx)?;
                note_if_fewer::<S>("Random", count, &mask, cx);
                lowest::<S, u64>(mesh, count, &mask, |id| mix(stream, id.index() as u64))
            }
            Self::Nearest { to, count, of } => {
                let mask = of.mask(mesh, cx)?;
                note_if_fewer::<S>("Nearest", count, &mask, cx);
                lowest::<S, f64>(mesh, count, &mask, |id| {
                    center::<S>(mesh, id).distance_squared(to.into())
                })
            }
            Self::Expect { count, of } => {
                let mask = of.mask(mesh, cx)?;
                let found = mask.iter().filter(|&&m| m).count();
                if found != count as usize {
                    let message = format!("expected {count} selected {}, found {found}", S::WORD);
                    let selected = S::marked(mesh, &mask);
                    return Err(OpError::refused(Refusal::Expectation, message).about(selected));
                }
                mask
            }
        })
    }

    /// Returns how many elements the variant selects, as a range. `all` is the number of all elements.
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

/// Returns a mask with the result of `predicate` for each element.
fn marks<S: Select>(mesh: &Mesh, predicate: impl Fn(S::Id) -> bool) -> Vec<bool> {
    let mut mask = vec![false; mesh.domain_len(S::Id::DOMAIN)];
    for id in S::elements(mesh) {
        mask[id.index()] = predicate(id);
    }
    mask
}

/// Returns one flag for each vertex. The flag says whether the vertex lies inside the mesh of the object `name`.
fn inside_of(mesh: &Mesh, name: &str, cx: &Context) -> Result<Vec<bool>, OpError> {
    let other = cx.other_mesh("InsideOf", name)?;
    let Some(index) = SurfaceIndex::with_progress(&other, cx.progress())? else {
        return Ok(vec![false; mesh.domain_len(Domain::Vertex)]);
    };
    let winding = Winding::new(&index, cx.progress())?;
    let numbers = winding.at_points(mesh.positions(), cx.progress())?;
    Ok(numbers.into_iter().map(|w| w.abs() > 0.5).collect())
}

/// Returns a mask of the elements with the tag `name`.
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
    let message = format!(
        "no {word} are tagged \"{name}\"; known tags: {known}",
        word = S::WORD
    );
    Err(OpError::refused(Refusal::Missing, message))
}

/// Returns a mask of the elements that `mask` does not mark.
fn not<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    marks::<S>(mesh, |id| !mask[id.index()])
}

/// Returns a mask of the vertices that belong to at least one marked element.
fn touched<S: Select>(mesh: &Mesh, mask: &[bool]) -> Vec<bool> {
    let mut vertices = vec![false; mesh.domain_len(Domain::Vertex)];
    for v in S::marked(mesh, mask).flat_map(|id| S::vertices(mesh, id)) {
        vertices[v.index()] = true;
    }
    vertices
}

/// Returns a mask of the elements with at least one marked vertex.
fn touching<S: Select>(mesh: &Mesh, vertices: &[bool]) -> Vec<bool> {
    marks::<S>(mesh, |id| {
        S::vertices(mesh, id).any(|v| vertices[v.index()])
    })
}

/// Returns a mask of the marked elements and their neighbors. Two vertices are neighbors if they share an edge, and two
/// edges or faces are neighbors if they share a vertex.
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

/// Returns the mean position of the vertices of an element.
fn center<S: Select>(mesh: &Mesh, id: S::Id) -> DVec3 {
    let (mut sum, mut n) = (DVec3::ZERO, 0.0);
    for v in S::vertices(mesh, id) {
        sum += mesh.position(v);
        n += 1.0;
    }
    sum / n
}

/// Chooses the `count` elements with the lowest values of `key` among the elements that `mask` marks. Among elements
/// with equal values, the elements with the lowest ids are chosen. Returns a mask of the chosen elements.
fn lowest<S: Select, K: PartialOrd>(
    mesh: &Mesh,
    count: u32,
    mask: &[bool],
    key: impl Fn(S::Id) -> K,
) -> Vec<bool> {
    let mut keyed: Vec<(K, S::Id)> = S::marked(mesh, mask).map(|id| (key(id), id)).collect();
    // Positions are finite, so the values of `key` are never NaN.
    keyed.sort_by(|a, b| a.partial_cmp(b).expect("keys are numbers"));
    let mut chosen = vec![false; mask.len()];
    for (_, id) in keyed.into_iter().take(count as usize) {
        chosen[id.index()] = true;
    }
    chosen
}

/// Adds a note to the report if a selection must choose `count` elements but fewer are available. `mask` marks the
/// elements that are available for the choice.
fn note_if_fewer<S: Select>(choice: &str, count: u32, mask: &[bool], cx: &Context) {
    let available = mask.iter().filter(|&&m| m).count();
    if available < count as usize {
        let word = S::WORD;
        cx.note(format!(
            "{choice}(count: {count}) selected all available {word}: {available}"
        ));
    }
}

/// Combines two numbers into one, and hashes the result with the output function of SplitMix64.
///
/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014.
fn mix(key: u64, counter: u64) -> u64 {
    let mut z = key ^ counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Returns the vertex with an id from a recipe.
fn named_vertex(mesh: &Mesh, index: u32) -> Result<VertexId, OpError> {
    let v = VertexId::new((index as usize).min(u32::MAX as usize - 1));
    if mesh.has_vertex(v) {
        return Ok(v);
    }
    Err(missing_element(index, "vertex", mesh.n_vertices()))
}

/// Returns the refusal for an element id that does not exist in a mesh with `n` elements of this kind.
fn missing_element(number: u32, noun: &str, n: usize) -> OpError {
    let n = mesh::counted(n, noun);
    let message = format!("{noun} {number} does not exist: the mesh has {n}");
    OpError::refused(Refusal::Missing, message)
}

/// The default value of the field `count` of selections.
const fn one() -> u32 {
    1
}

#[cfg(test)]
mod tests;
