//! Values of attributes, for selections.

use mesh::{Column, Domain, Id, Mesh, Values};

use super::{ElementKind, Select};
use crate::{OpError, Refusal};

/// Returns a function that takes the index of an element and returns its attribute value. If the values are vectors,
/// the function returns one component.
///
/// # Errors
///
/// Returns [`Refusal::Missing`] if no attribute of these elements has this name. Returns [`OpError::Parameter`] if the
/// attribute is a tag, if it is a vector but `component` is missing, or if the attribute does not have this component.
pub(super) fn component_of<'m, S: Select>(
    mesh: &'m Mesh,
    name: &str,
    component: Option<u32>,
) -> Result<impl Fn(usize) -> f64 + use<'m, S>, OpError> {
    let domain = S::Id::DOMAIN;
    let Some(column) = mesh.attributes().column(domain, name) else {
        return Err(missing::<S>(mesh, name));
    };
    let (values, i) = (&column.values, check_component(domain, column, component)?);
    Ok(move |element: usize| values.component(element, i))
}

/// Returns the index of the component that a selection uses. `component` is the parameter `component` of this
/// selection. If the attribute holds one number for each element, `component` must be omitted, and the returned index
/// is 0.
///
/// # Errors
///
/// Returns [`OpError::Parameter`] if the attribute is a tag, if it is a vector but `component` is missing, or if the
/// attribute does not have this component.
pub fn check_component(
    domain: Domain,
    column: &Column,
    component: Option<u32>,
) -> Result<usize, OpError> {
    let (name, values) = (&column.name, &column.values);
    if let Values::Tag(_) = values {
        let message = format!(
            "the {domain} attribute \"{name}\" is a tag, which has no numbers: to select its elements, write `Tagged(\"{name}\")`"
        );
        return Err(OpError::Parameter(message));
    }
    let n = values.n_components();
    let help = match component {
        None if n == 1 => return Ok(0),
        Some(i) if n > 1 && (i as usize) < n => return Ok(i as usize),
        None => "choose one number with `component`, counted from 0".to_owned(),
        Some(_) if n == 1 => "remove `component`".to_owned(),
        Some(_) => format!("`component` must be at most {}", n - 1),
    };
    Err(OpError::Parameter(format!(
        "the type of the {domain} attribute \"{name}\" is {}: {help}",
        values.type_name()
    )))
}

/// Returns the refusal for an attribute that does not exist on this kind of element.
fn missing<S: Select>(mesh: &Mesh, name: &str) -> OpError {
    let attributes = mesh.attributes();
    let refused = |message| OpError::refused(Refusal::Missing, message);
    let word = S::WORD;
    for (kind, domain) in
        ElementKind::ALL
            .into_iter()
            .zip([Domain::Vertex, Domain::Edge, Domain::Face])
    {
        if attributes.column(domain, name).is_none() {
            continue;
        }
        let own = ElementKind::ALL.into_iter().find(|own| own.word() == word);
        let conversions = own.map_or(&[][..], |own| own.conversions(kind));
        let ways: Vec<String> = (conversions.iter())
            .map(|way| format!("`{way}(Where(attribute: \"{name}\", ..))`"))
            .collect();
        let other = kind.word();
        return refused(format!(
            "\"{name}\" is an attribute of {other}, but a selection of {word} is needed: write {}",
            ways.join(" or ")
        ));
    }
    let numbers = attributes.of(S::Id::DOMAIN).iter();
    let numbers = numbers.filter(|column| !matches!(column.values, Values::Tag(_)));
    let known: Vec<&str> = numbers.map(|column| column.name.as_str()).collect();
    let known = match &known[..] {
        [] => "none".to_owned(),
        known => known.join(", "),
    };
    refused(format!(
        "no attribute of {word} is named \"{name}\"; numeric attributes of {word}: {known}"
    ))
}
