//! What a written file does not hold.

use mesh::{Column, Domain, Mesh};

use crate::note::Loss;

/// The losses of one object.
#[derive(Debug)]
pub(crate) struct Losses<'a> {
    object: &'a str,
    list: &'a mut Vec<Loss>,
}

impl<'a> Losses<'a> {
    pub(crate) fn of(object: &'a str, list: &'a mut Vec<Loss>) -> Self {
        Self { object, list }
    }

    /// Adds a loss unless `count` is 0.
    pub(crate) fn add(
        &mut self,
        domain: impl Into<Option<Domain>>,
        attribute: &str,
        count: usize,
        reason: impl Into<String>,
    ) {
        if count > 0 {
            self.list.push(Loss {
                object: self.object.to_owned(),
                domain: domain.into(),
                attribute: attribute.to_owned(),
                count,
                reason: reason.into(),
            });
        }
    }

    /// Adds every column of `mesh` that is not `held`.
    pub(crate) fn add_columns(
        &mut self,
        mesh: &Mesh,
        format: &str,
        held: impl Fn(Domain, &Column) -> bool,
    ) {
        for (domain, column) in mesh.attributes().iter() {
            if !held(domain, column) {
                let kind = column.values.type_name();
                let reason = format!("{format} has no place for this {domain} attribute ({kind})");
                let count = column.values.len().max(1);
                self.add(domain, &column.name, count, reason);
            }
        }
    }
}
