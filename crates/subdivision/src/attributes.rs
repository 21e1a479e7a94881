//! Computes the attributes of the next subdivision level.

use mesh::{
    Attributes, CREASE, Column, DVec2, DVec3, DVec4, Domain, Mesh, Rule, VERTEX_SHARPNESS, Value,
    Values,
};
use progress::{Cancelled, Meter};

use crate::face_varying::Field;
use crate::large_faces::LargeFaces;
use crate::masks::AnyMasks;
use crate::parallel::computed;
use crate::rules::{FaceVarying, Rules};
use crate::sharpness::{Sharpness, decreased};
use crate::topology::{Place, Topology, add_linear, linear_value};

/// The input from which the attributes of the next level are computed.
pub(crate) struct AttributeSources<'a> {
    pub(crate) mesh: &'a Mesh,
    /// The mesh of the next level, without attributes.
    pub(crate) finer: &'a Mesh,
    pub(crate) topology: &'a dyn Topology,
    pub(crate) masks: &'a dyn AnyMasks,
    /// Computes how sharpness decreases. If `None`, sharpness is copied unchanged.
    pub(crate) sharpness: Option<Sharpness<'a>>,
    pub(crate) rules: Rules,
}

/// Whether subdivision keeps this attribute column.
pub(crate) fn is_carried(column: &Column) -> bool {
    matches!(column.rule, Rule::Interpolate | Rule::Copy)
}

impl AttributeSources<'_> {
    /// Computes the attribute columns of the next level:
    ///
    /// - Vertices: [`Rule::Interpolate`] averages old values with the weights that also give the new positions (the
    ///   masks). [`Rule::Copy`] keeps the values of old vertices, and new vertices have the value zero.
    /// - Corners: [`Rule::Interpolate`] interpolates linearly within the old face. If `sharpness` is given, floats and
    ///   vectors are smoothed instead, as [`FaceVarying`] defines: separately on each side of a seam. [`Rule::Copy`]
    ///   keeps the values of old corners, and new corners have the value zero.
    /// - Edges: the parts of an old edge copy its value, and all other new edges have the value zero.
    /// - Faces: the parts of an old face copy its value.
    ///
    /// Columns with [`Rule::Normal`] or [`Rule::Drop`] are dropped. If `sharpness` is given, the sharpness of edges
    /// and vertices decreases.
    pub(crate) fn attributes(&self, meter: &Meter) -> Result<Attributes, Cancelled> {
        let mut new = Attributes::default();
        let columns = self.mesh.attributes().iter();
        for (domain, column) in columns.filter(|(_, c)| is_carried(c)) {
            // Checks for cancellation.
            meter.add(0)?;
            let n = self.finer.domain_len(domain);
            let values = match domain {
                Domain::Vertex => self.vertex_values(column, n, meter)?,
                Domain::Corner => self.corner_values(column, n, meter)?,
                Domain::Edge => self.edge_values(column, n, meter)?,
                Domain::Face => gathered(column, n, &|i| self.topology.face(i)),
            };
            new.insert(domain, column.with_values(values));
        }
        Ok(new)
    }

    fn vertex_values(&self, column: &Column, n: usize, meter: &Meter) -> Result<Values, Cancelled> {
        if column.rule == Rule::Copy {
            let n_old = self.mesh.n_vertices();
            return match (&self.sharpness, &column.values) {
                (Some(_), Values::Float(old)) if column.name == VERTEX_SHARPNESS.name => {
                    let fade = |i: usize| match old.get(i) {
                        Some(&s) if self.topology.smooths_vertex(i) => decreased(s.max(0.0)),
                        other => other.copied().unwrap_or_default(),
                    };
                    Ok(f64::wrap(computed(n, meter, fade)?))
                }
                _ => Ok(gathered(column, n, &|i| {
                    self.topology.vertex(i).filter(|&v| v < n_old)
                })),
            };
        }
        let Some(old) = to_vec4s(&column.values) else {
            return Ok(column.values.blend(n, |i, add| self.masks.mask(i, add)));
        };
        // The first three components are smoothed as a 3D vector; the fourth component is smoothed separately. In this
        // way, the code of the masks is compiled for one type only.
        let smoothed = |part: fn(&DVec4) -> DVec3| {
            let old: Vec<DVec3> = old.iter().map(part).collect();
            self.masks.values(n, &old, meter)
        };
        let mut new: Vec<DVec4> = smoothed(|v| v.truncate())?
            .into_iter()
            .map(|v| v.extend(0.0))
            .collect();
        if matches!(column.values, Values::Vec4(_)) {
            for (new, last) in new.iter_mut().zip(smoothed(|v| DVec3::splat(v.w))?) {
                new.w = last.x;
            }
        }
        Ok(from_vec4s(&column.values, new))
    }

    fn edge_values(&self, column: &Column, n: usize, meter: &Meter) -> Result<Values, Cancelled> {
        match (&self.sharpness, &column.values) {
            (Some(sharpness), Values::Float(old)) if column.name == CREASE.name => {
                let fade = |i: usize| match self.topology.half(i) {
                    Some(h) if self.topology.smooths_edge(h.edge()) => sharpness.next_of_half(h),
                    other => other.map_or(0.0, |h| old[h.edge().index()]),
                };
                Ok(f64::wrap(computed(n, meter, fade)?))
            }
            _ => Ok(gathered(column, n, &|i| self.topology.edge(i))),
        }
    }

    fn corner_values(&self, column: &Column, n: usize, meter: &Meter) -> Result<Values, Cancelled> {
        if column.rule == Rule::Copy {
            return Ok(gathered(column, n, &|i| match self.corner(i) {
                Place::At(h) => Some(h.index()),
                _ => None,
            }));
        }
        let is_linear = self.rules.face_varying == FaceVarying::All;
        if let (Some(sharpness), false) = (self.sharpness, is_linear)
            && let Some(old) = to_vec4s(&column.values)
        {
            let new = self.smooth_corners(sharpness, &old, n, meter)?;
            return Ok(from_vec4s(&column.values, new));
        }
        let large = LargeFaces::of(self.mesh);
        if large.is_empty() {
            return Ok(column
                .values
                .blend(n, |i, add| add_linear(self.mesh, self.corner(i), add)));
        }
        let sums = column.values.blend(large.n_sums(), |i, add| {
            large.add_sum(self.mesh, i, |h, w| add(h.index(), w));
        });
        meter.add(0)?;
        let n_old = column.values.len();
        let mut values = column.values.clone();
        values.append(&sums);
        Ok(values.blend(n, |i, add| {
            let place = self.corner(i);
            let is_large = match place {
                Place::In(f) => {
                    let center = large.center(self.mesh, f);
                    center.map(|sum| add(n_old + sum, 1.0)).is_some()
                }
                Place::DooSabin(h) => large.add_doo_sabin(h, [h.index(), n_old], add),
                _ => false,
            };
            if !is_large {
                add_linear(self.mesh, place, add);
            }
        }))
    }

    fn corner(&self, i: usize) -> Place {
        self.topology.corner(self.finer.connectivity(), i)
    }

    fn smooth_corners(
        &self,
        sharpness: Sharpness,
        old: &[DVec4],
        n: usize,
        meter: &Meter,
    ) -> Result<Vec<DVec4>, Cancelled> {
        let field = Field::new(self.mesh, sharpness, self.rules, old, meter)?;
        let is_smoothed = |place| match place {
            Place::At(h) => self.topology.smooths_vertex(self.mesh.origin(h).index()),
            Place::On(h) => self.topology.smooths_edge(h.edge()),
            _ => true,
        };
        computed(n, meter, |i| {
            let place = self.corner(i);
            if is_smoothed(place) {
                field.value(place)
            } else {
                linear_value(self.mesh, place, old)
            }
        })
    }
}

/// Converts values to 4D vectors, so that smoothing is compiled for one type only. Returns `None` for integers
/// and tags, which cannot be averaged.
fn to_vec4s(values: &Values) -> Option<Vec<DVec4>> {
    Some(match values {
        Values::Float(v) => v.iter().map(|&x| DVec4::new(x, 0.0, 0.0, 0.0)).collect(),
        Values::Vec2(v) => v.iter().map(|v| v.extend(0.0).extend(0.0)).collect(),
        Values::Vec3(v) => v.iter().map(|v| v.extend(0.0)).collect(),
        Values::Vec4(v) => v.clone(),
        Values::Int(_) | Values::Tag(_) => return None,
    })
}

/// Converts 4D vectors to values of the type of `like`: the inverse of [`to_vec4s`].
fn from_vec4s(like: &Values, new: Vec<DVec4>) -> Values {
    let new = new.into_iter();
    match like {
        Values::Float(_) => f64::wrap(new.map(|v| v.x).collect()),
        Values::Vec2(_) => DVec2::wrap(new.map(|v| v.truncate().truncate()).collect()),
        Values::Vec3(_) => DVec3::wrap(new.map(DVec4::truncate).collect()),
        _ => DVec4::wrap(new.collect()),
    }
}

/// Calls [`Values::gather`] with a `dyn` closure, so that `gather` is compiled once and not for each closure.
pub(crate) fn gathered(
    column: &Column,
    n: usize,
    source: &(dyn Fn(usize) -> Option<usize> + Sync),
) -> Values {
    column.values.gather(n, source)
}
