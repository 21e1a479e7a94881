//! Compares the attributes of two meshes.

use mesh::{Column, Domain, Id, Mesh, Values};

use super::order::Order;

/// The comparison of one attribute of two meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct AttributeDifference {
    /// The domain of the attribute.
    pub domain: Domain,
    /// The name of the attribute.
    pub name: String,
    /// How the attribute differs.
    pub difference: ColumnDifference,
}

/// How an attribute of one mesh differs from the same attribute of another mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnDifference {
    /// All corresponding values are equal.
    None,
    /// Only the first mesh has the attribute.
    OnlyFirst,
    /// Only the second mesh has the attribute.
    OnlySecond,
    /// The types of the values differ.
    Types([&'static str; 2]),
    /// The attributes have different [edit rules](mesh::Rule).
    Rules,
    /// The connectivity of the meshes is not [`Connectivity::Same`](super::Connectivity::Same), so the values cannot be
    /// compared.
    Unknown,
    /// Some corresponding values differ.
    Values {
        /// The number of values that differ.
        count: usize,
        /// The largest difference between two corresponding numbers. Two different values of a tag count as a
        /// difference of 1.
        by: f64,
        /// The element of the first mesh at which the values differ most, such as `v12`.
        element: String,
    },
}

impl AttributeDifference {
    /// Whether both meshes have the attribute with the same type and the same edit rule, and each pair of corresponding
    /// values differs by at most `tolerance`. Returns `false` if the values cannot be compared.
    pub fn is_within(&self, tolerance: f64) -> bool {
        match &self.difference {
            ColumnDifference::None => true,
            ColumnDifference::Values { by, .. } => *by <= tolerance,
            _ => false,
        }
    }
}

/// Compares the attributes of two meshes. Values are compared only if `orders` is given, because `orders` says which
/// elements of the two meshes correspond.
pub(super) fn differences(
    [a, b]: [&Mesh; 2],
    orders: Option<&[Order; 2]>,
) -> Vec<AttributeDifference> {
    let mut found = Vec::new();
    let mut add = |domain, name: &str, difference| {
        found.push(AttributeDifference {
            domain,
            name: name.to_owned(),
            difference,
        });
    };
    for domain in Domain::ALL {
        for column in a.attributes().of(domain) {
            let difference = match (b.attributes().column(domain, &column.name), orders) {
                (None, _) => ColumnDifference::OnlyFirst,
                (Some(other), _) if column.values.type_name() != other.values.type_name() => {
                    ColumnDifference::Types([column, other].map(|c| c.values.type_name()))
                }
                (Some(other), _) if column.rule != other.rule => ColumnDifference::Rules,
                (Some(_), None) => ColumnDifference::Unknown,
                (Some(other), Some([p, q])) => match domain {
                    Domain::Vertex => values(column, other, &p.vertices, &q.vertices),
                    Domain::Corner => values(column, other, &p.corners, &q.corners),
                    Domain::Edge => values(column, other, &p.edges, &q.edges),
                    Domain::Face => values(column, other, &p.faces, &q.faces),
                },
            };
            add(domain, &column.name, difference);
        }
        for column in b.attributes().of(domain) {
            if a.attributes().column(domain, &column.name).is_none() {
                add(domain, &column.name, ColumnDifference::OnlySecond);
            }
        }
    }
    found
}

/// Compares two attribute columns. The value of each element in `first` is compared with the value of the corresponding
/// element in `second`.
fn values<I: Id>(a: &Column, b: &Column, first: &[I], second: &[I]) -> ColumnDifference {
    let (mut count, mut most, mut element) = (0, 0.0, None);
    for (&i, &j) in first.iter().zip(second) {
        let by = largest_difference(&a.values, i.index(), &b.values, j.index());
        // NaN is not equal to 0, so a NaN also counts as a difference.
        if by == 0.0 {
            continue;
        }
        count += 1;
        if element.is_none() || by > most {
            (most, element) = (by, Some(i));
        }
    }
    match element {
        None => ColumnDifference::None,
        Some(element) => ColumnDifference::Values {
            count,
            by: most,
            element: element.to_string(),
        },
    }
}

/// Compares two values of the same type and returns the largest difference between corresponding components.
fn largest_difference(a: &Values, i: usize, b: &Values, j: usize) -> f64 {
    match (a, b) {
        (Values::Float(a), Values::Float(b)) => (a[i] - b[j]).abs(),
        (Values::Vec2(a), Values::Vec2(b)) => (a[i] - b[j]).abs().max_element(),
        (Values::Vec3(a), Values::Vec3(b)) => (a[i] - b[j]).abs().max_element(),
        (Values::Vec4(a), Values::Vec4(b)) => (a[i] - b[j]).abs().max_element(),
        (Values::Int(a), Values::Int(b)) => (f64::from(a[i]) - f64::from(b[j])).abs(),
        (Values::Tag(a), Values::Tag(b)) => f64::from(u8::from(a[i] != b[j])),
        _ => f64::INFINITY,
    }
}
