//! The code that the operations on texture coordinates share: the attribute, the page into which charts are packed, and
//! the errors.

use geometry::uv::{Page, UvError};
use mesh::{CORNER_TANGENT, Column, DVec2, Domain, UV, Value, morph_value_of};
use op::Refusal;
use op::prelude::*;

/// The default name of texture coordinates.
pub(crate) fn uv() -> String {
    UV.name.to_owned()
}

pub(crate) const fn page() -> Count<16, 16384> {
    Count::literal(1024)
}

pub(crate) const fn padding() -> Count<0, 256> {
    Count::literal(2)
}

/// Returns the page with the size and the padding from the parameters `page` and `padding`.
pub(crate) const fn page_of(size: Count<16, 16384>, padding: Count<0, 256>) -> Page {
    Page {
        size: size.get(),
        padding: padding.get(),
    }
}

/// Returns a problem if the padding leaves no space on the page.
pub(crate) fn padding_problem(page: Page) -> Option<Problem> {
    let Page { size, padding } = page;
    (size <= 2 * padding).then(|| {
        let message = format!(
            "`page` must exceed twice the `padding`, found a page of {size} texels and a padding of {padding}"
        );
        Problem::error(message).at(["padding"])
    })
}

/// Adds the attribute `uv` to the plan, and removes the attributes that depend on the old values of `uv`.
pub(crate) fn plan(plan: &mut MeshPlan, uv: &str) {
    plan.provide(Domain::Corner, uv);
    plan.drop_attribute(Domain::Corner, CORNER_TANGENT.name);
    (plan.attributes).retain(|attribute| !changes(&attribute.name, uv));
}

/// Whether the attribute `name` stores how a morph target changes the attribute `uv`.
fn changes(name: &str, uv: &str) -> bool {
    morph_value_of(name).is_some_and(|(changed, _)| changed == uv)
}

/// Sets the attribute `uv`. Removes the tangents of corners and the attributes that store how morph targets change
/// `uv`, because they depend on the old values of `uv`.
pub(crate) fn set(mesh: &mut Mesh, uv: &str, uvs: Vec<DVec2>, report: &mut Report) {
    let values = DVec2::wrap(uvs);
    let column = Column {
        name: uv.to_owned(),
        rule: UV.rule,
        values,
    };
    mesh.insert_column(Domain::Corner, column);
    if mesh
        .remove_column(Domain::Corner, CORNER_TANGENT.name)
        .is_some()
    {
        report.notes.push(
            "removed the tangents, because they depend on the texture coordinates, which this step replaced"
                .to_owned(),
        );
    }
    let columns = mesh.attributes().iter();
    let outdated = columns.filter(|(_, column)| changes(&column.name, uv));
    let outdated: Vec<_> = outdated
        .map(|(domain, column)| (domain, column.name.clone()))
        .collect();
    for (domain, name) in outdated {
        mesh.remove_column(domain, &name);
        report.notes.push(format!(
            "removed the attribute `{name}`, because it stores how a morph target changes `{uv}`, and this step replaced the values of `{uv}`"
        ));
    }
}

/// Returns the texture coordinates that the attribute `uv` of a mesh stores.
pub(crate) fn get<'m>(mesh: &'m Mesh, uv: &str) -> Result<&'m [DVec2], OpError> {
    let column = mesh.attributes().column(Domain::Corner, uv);
    let uvs = column.and_then(|column| DVec2::of(&column.values));
    uvs.ok_or_else(|| OpError::refused(Refusal::Missing, missing(uv)))
}

pub(crate) fn missing(uv: &str) -> String {
    format!(
        "the mesh has no texture coordinates `{uv}`; compute them first, for example with Unwrap"
    )
}

pub(crate) fn error(error: &UvError) -> OpError {
    match error {
        UvError::Cancelled(_) => OpError::Cancelled,
        UvError::PageTooSmall(_) => {
            let message = format!("{error}; use a larger `page` or a smaller `padding`");
            OpError::refused(Refusal::Unreached, message)
        }
        UvError::Limit(_) => OpError::Parameter(error.to_string()),
    }
}

/// Returns a note with the percentage of the page that charts cover. `part` is the covered fraction of the page.
pub(crate) fn coverage(part: f64) -> String {
    format!("the charts cover {:.1} % of the page", 100.0 * part)
}
