//! Named columns of values, and the functions with which edits change them.

use std::ops::Range;

use glam::DVec3;

use super::{Rule, Values};
use crate::{Domain, EdgeId, FaceId, HalfEdgeId, Id, VertexId};

/// One attribute: a name, a rule and a value for each element of a domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name, unique in its domain.
    pub name: String,
    /// How edits change the values.
    pub rule: Rule,
    /// The values, one for each element of the domain.
    pub values: Values,
}

/// All attributes of a mesh: for each domain its columns, sorted by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    columns: [Vec<Column>; 4],
}

/// Iterates over all columns with their domains, in the order of [`Attributes::iter`].
impl IntoIterator for Attributes {
    type Item = (Domain, Column);
    type IntoIter = std::vec::IntoIter<(Domain, Column)>;

    fn into_iter(self) -> Self::IntoIter {
        let domains = Domain::ALL.into_iter().zip(self.columns);
        let columns = domains.flat_map(|(d, columns)| columns.into_iter().map(move |c| (d, c)));
        columns.collect::<Vec<_>>().into_iter()
    }
}

/// For each element of a new mesh, the element of the old mesh from which the values are copied. If an entry is `NONE`,
/// the values of the new element are zero.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a> {
    /// The old vertex for each new vertex.
    pub vertices: &'a [VertexId],
    /// The old half-edge for each new half-edge.
    pub corners: &'a [HalfEdgeId],
    /// The old edge for each new edge.
    pub edges: &'a [EdgeId],
    /// The old face for each new face.
    pub faces: &'a [FaceId],
}

impl Attributes {
    /// Returns the columns of a domain, sorted by name.
    pub fn of(&self, domain: Domain) -> &[Column] {
        &self.columns[domain as usize]
    }

    /// Iterates over all columns with their domains. The domains are in the order of [`Domain::ALL`], and the columns
    /// of each domain are sorted by name.
    pub fn iter(&self) -> impl Iterator<Item = (Domain, &Column)> {
        Domain::ALL
            .into_iter()
            .flat_map(|d| self.of(d).iter().map(move |c| (d, c)))
    }

    /// Returns the column with this domain and name, if there is one.
    pub fn column(&self, domain: Domain, name: &str) -> Option<&Column> {
        self.find(domain, name).ok().map(|i| &self.of(domain)[i])
    }

    /// Returns the index of the column with this name. If the domain has no column with this name, returns, as an
    /// error, the index at which to insert the column.
    fn find(&self, domain: Domain, name: &str) -> Result<usize, usize> {
        self.of(domain)
            .binary_search_by(|c| c.name.as_str().cmp(name))
    }

    pub(crate) fn of_mut(&mut self, domain: Domain) -> &mut [Column] {
        &mut self.columns[domain as usize]
    }

    pub(crate) fn column_mut(&mut self, domain: Domain, name: &str) -> Option<&mut Column> {
        let index = self.find(domain, name).ok();
        index.map(|i| &mut self.columns[domain as usize][i])
    }

    /// Inserts a column into a domain. An existing column of this domain with the same name is replaced. The column
    /// must have as many values as the mesh has elements in this domain.
    pub fn insert(&mut self, domain: Domain, column: Column) {
        let index = self.find(domain, &column.name);
        let columns = &mut self.columns[domain as usize];
        match index {
            Ok(i) => columns[i] = column,
            Err(i) => columns.insert(i, column),
        }
    }

    /// Removes a column and returns it; `None` if the domain has no column with this name.
    pub fn remove(&mut self, domain: Domain, name: &str) -> Option<Column> {
        let index = self.find(domain, name).ok();
        index.map(|i| self.columns[domain as usize].remove(i))
    }

    /// Returns the columns for a new mesh: each new element gets the values of its source element.
    #[must_use]
    pub fn gathered(&self, sources: Sources) -> Self {
        fn run<I: Id>(columns: &[Column], from: &[I]) -> Vec<Column> {
            let source = |i: usize| (from[i] != I::NONE).then(|| from[i].index());
            let columns = columns.iter();
            columns
                .map(|c| c.with_values(c.values.gather(from.len(), source)))
                .collect()
        }
        Self {
            columns: [
                run(self.of(Domain::Vertex), sources.vertices),
                run(self.of(Domain::Corner), sources.corners),
                run(self.of(Domain::Edge), sources.edges),
                run(self.of(Domain::Face), sources.faces),
            ],
        }
    }

    /// Appends the values of `other`. `lens` contains the number of elements of each domain in the mesh of `self`, and
    /// `other_lens` the number of elements of each domain in the mesh of `other`. If only one of the two meshes has a
    /// column, its values are zero for the elements of the other mesh. If two columns have the same name but different
    /// types, the column of `other` is skipped, and its domain and name are returned.
    pub fn append(
        &mut self,
        lens: [usize; 4],
        other: &Self,
        other_lens: [usize; 4],
    ) -> Vec<(Domain, String)> {
        let mut skipped = Vec::new();
        for domain in Domain::ALL {
            let (len, other_len) = (lens[domain as usize], other_lens[domain as usize]);
            for column in other.of(domain) {
                if self.column(domain, &column.name).is_none() {
                    let values = column.values.gather(len, |_| None);
                    self.insert(domain, column.with_values(values));
                }
                let mine = self
                    .column_mut(domain, &column.name)
                    .expect("inserted above");
                if !mine.values.append(&column.values) {
                    skipped.push((domain, column.name.clone()));
                }
            }
            for column in &mut self.columns[domain as usize] {
                column.values.grow(len + other_len);
            }
        }
        skipped
    }

    /// Grows all columns of a domain to `n` values; new values are zero.
    pub(crate) fn grow(&mut self, domain: Domain, n: usize) {
        for column in &mut self.columns[domain as usize] {
            column.values.grow(n);
        }
    }

    /// Returns the domain and name of the first column whose rule is [`Rule::Drop`].
    #[inline]
    pub(crate) fn first_to_drop(&self) -> Option<(Domain, String)> {
        self.iter()
            .find(|(_, c)| c.rule == Rule::Drop)
            .map(|(domain, c)| (domain, c.name.clone()))
    }

    /// Whether any corner column has different values at `a` and `b`.
    pub(crate) fn corners_differ(&self, a: HalfEdgeId, b: HalfEdgeId) -> bool {
        self.of(Domain::Corner)
            .iter()
            .any(|c| !c.values.are_equal(a.index(), b.index()))
    }

    /// Removes the columns whose rule is [`Rule::Drop`]. Every function that changes connectivity must remove these
    /// columns.
    pub fn drop_by_rule(&mut self) {
        for columns in &mut self.columns {
            columns.retain(|c| c.rule != Rule::Drop);
        }
    }
}

impl Column {
    /// Returns a column with the same name and rule, but with the given values.
    #[must_use]
    pub fn with_values(&self, values: Values) -> Self {
        Self {
            name: self.name.clone(),
            rule: self.rule,
            values,
        }
    }

    /// Sets the value of element `to` to the weighted mean of the values of `a` and `b`, where `t` is the weight of
    /// `b`. Does nothing if the rule does not interpolate.
    #[inline]
    pub(crate) fn mix<I: Id>(&mut self, a: I, b: I, t: f64, to: I) {
        if matches!(self.rule, Rule::Interpolate | Rule::Normal) {
            self.values.mix(a.index(), b.index(), t, to.index());
            self.normalize(to.index());
        }
    }

    /// Sets the value of element `to` to the mean of the values of `from`. Does nothing if the rule does not
    /// interpolate.
    pub(crate) fn average<I: Id>(&mut self, from: &[I], to: I) {
        if matches!(self.rule, Rule::Interpolate | Rule::Normal) {
            let weight = 1.0 / from.len().max(1) as f64;
            let mean = self.values.blend(1, |_, add| {
                for i in from {
                    add(i.index(), weight);
                }
            });
            self.set_mean(to, &mean);
        }
    }

    /// Sets the value of element `to` to the first value of `mean`. Does nothing if the rule does not interpolate.
    pub(crate) fn set_mean<I: Id>(&mut self, to: I, mean: &Values) {
        if matches!(self.rule, Rule::Interpolate | Rule::Normal) {
            self.values.set(to.index(), mean);
            self.normalize(to.index());
        }
    }

    /// Returns the values of the column mutably; `None` if the column does not store normals.
    fn normals_mut(&mut self) -> Option<&mut [DVec3]> {
        match (self.rule, &mut self.values) {
            (Rule::Normal, Values::Vec3(normals)) => Some(normals),
            _ => None,
        }
    }

    /// If the column stores normals, scales the normal at `i` to length 1.
    fn normalize(&mut self, i: usize) {
        if let Some(normals) = self.normals_mut() {
            normals[i] = normals[i].normalize_or_zero();
        }
    }

    /// If the column stores normals, negates the normals of a range of elements.
    pub(crate) fn negate_normals(&mut self, range: Range<usize>) {
        let normals = self.normals_mut().map(|normals| &mut normals[range]);
        for normal in normals.into_iter().flatten() {
            // Subtracts the value from zero instead of negating it, so that 0 does not become -0.
            *normal = DVec3::ZERO - *normal;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn appending_fills_missing_columns_with_zeros() {
        let mut a = Attributes::default();
        a.insert(
            Domain::Face,
            Column {
                name: "x".into(),
                rule: Rule::Copy,
                values: Values::Int(vec![1]),
            },
        );
        let mut b = Attributes::default();
        b.insert(
            Domain::Face,
            Column {
                name: "y".into(),
                rule: Rule::Copy,
                values: Values::Tag(vec![true, true]),
            },
        );
        assert_eq!(a.append([0, 0, 0, 1], &b, [0, 0, 0, 2]), vec![]);
        assert_eq!(
            a.column(Domain::Face, "x").unwrap().values,
            Values::Int(vec![1, 0, 0])
        );
        let tags = Values::Tag(vec![false, true, true]);
        assert_eq!(a.column(Domain::Face, "y").unwrap().values, tags);
    }
}
