//! The values of an attribute, for expectations and sweeps.

use mesh::{Column, Domain, EdgeId, Element, FaceId, HalfEdgeId, Id, Mesh, VertexId};
use op::{Elements, check_component};
use scene::Object;

use super::subject::{EdgeByVertices, Subject, selected};
use super::violation::{Violation, check_number};

/// Checks that all values of an attribute are in a range.
pub(super) fn check(
    subject: Subject,
    name: &str,
    of: Option<&Elements>,
    component: Option<u32>,
    bounds: [Option<f64>; 3],
) -> Result<(), Violation> {
    each(subject, name, of, component, |mesh, element, value| {
        let at = match element {
            Element::Vertex(v) => v.to_string(),
            Element::HalfEdge(h) => format!("the corner {h}"),
            Element::Edge(e) => EdgeByVertices(mesh, e).to_string(),
            Element::Face(f) => f.to_string(),
        };
        let what = format_args!("the attribute \"{name}\" at {at} to have a value");
        check_number(what, value, bounds, 0.0)
    })
}

/// Returns all values of an attribute.
///
/// # Errors
///
/// Returns an error if a mesh does not have the attribute, or if no element has a value.
pub(crate) fn values(
    subject: Subject,
    name: &str,
    component: Option<u32>,
) -> Result<Vec<f64>, Violation> {
    let mut values = Vec::new();
    each(subject, name, None, component, |_, _, value| {
        values.push(value);
        Ok(())
    })?;
    Ok(values)
}

/// Calls `visit` with each value of an attribute and the element that has this value.
fn each(
    subject: Subject,
    name: &str,
    of: Option<&Elements>,
    component: Option<u32>,
    mut visit: impl FnMut(&Mesh, Element, f64) -> Result<(), Violation>,
) -> Result<(), Violation> {
    let mut is_empty = true;
    for (object, mesh) in subject.meshes()? {
        let (domain, column) = column(object, mesh, name, of)?;
        let component = check_component(domain, column, component);
        let component = component.map_err(|error| error.to_string())?;
        for element in elements(domain, of, object, mesh, subject)? {
            is_empty = false;
            let i = match element {
                Element::Vertex(v) => v.index(),
                Element::HalfEdge(h) => h.index(),
                Element::Edge(e) => e.index(),
                Element::Face(f) => f.index(),
            };
            visit(mesh, element, column.values.component(i, component))?;
        }
    }
    if is_empty {
        return Err(format!("no element has a value of the attribute \"{name}\"").into());
    }
    Ok(())
}

fn column<'m>(
    object: &Object,
    mesh: &'m Mesh,
    name: &str,
    of: Option<&Elements>,
) -> Result<(Domain, &'m Column), Violation> {
    let domains: &[Domain] = match of {
        None => &[Domain::Vertex, Domain::Face, Domain::Corner, Domain::Edge],
        Some(Elements::Vertices(_)) => &[Domain::Vertex],
        Some(Elements::Edges(_)) => &[Domain::Edge],
        Some(Elements::Faces(_)) => &[Domain::Face],
    };
    let columns = domains
        .iter()
        .map(|&domain| (domain, mesh.attributes().column(domain, name)));
    let mut columns = columns.filter_map(|(domain, column)| Some((domain, column?)));
    columns.next().ok_or_else(|| {
        let kind = of.map_or(String::new(), |_| format!("{} ", domains[0]));
        let object = &object.name;
        Violation::unmet(format!(
            "expected the {kind}attribute \"{name}\", but \"{object}\" does not have it"
        ))
    })
}

/// Returns the elements that the selection `of` matches. If there is no selection, returns all elements of the domain.
fn elements(
    domain: Domain,
    of: Option<&Elements>,
    object: &Object,
    mesh: &Mesh,
    subject: Subject,
) -> Result<Vec<Element>, Violation> {
    fn list<I: Id + Into<Element>>(ids: impl IntoIterator<Item = I>) -> Vec<Element> {
        ids.into_iter().map(Into::into).collect()
    }
    Ok(match (of, domain) {
        (Some(Elements::Vertices(s)), _) => list::<VertexId>(selected(s, object, mesh, subject)?),
        (Some(Elements::Edges(s)), _) => list::<EdgeId>(selected(s, object, mesh, subject)?),
        (Some(Elements::Faces(s)), _) => list::<FaceId>(selected(s, object, mesh, subject)?),
        (None, Domain::Vertex) => list(mesh.vertices()),
        (None, Domain::Edge) => list(mesh.edges()),
        (None, Domain::Face) => list(mesh.faces()),
        (None, Domain::Corner) => {
            list::<HalfEdgeId>(mesh.half_edges().filter(|&h| mesh.face(h).is_some()))
        }
    })
}
