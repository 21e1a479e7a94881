//! Marking elements with a tag: what `TagVertices`, `TagEdges` and `TagFaces` share.

use mesh::{Column, Id, Mesh, Rule, Values};

use crate::{Context, OpError, Problem, Select};

/// Marks the selected elements, and no others, with a tag. A tag of this name that is there already is
/// replaced. Returns how many elements are marked now and were not, or the other way round.
///
/// # Errors
///
/// As [`Select::resolve`]; [`OpError::Parameter`] if the name is empty or that of an attribute of another type.
pub fn tag<S: Select>(
    mesh: &mut Mesh,
    name: &str,
    selection: &S,
    cx: &mut Context,
) -> Result<usize, OpError> {
    if let Some(message) = bad_name(name) {
        return Err(OpError::Parameter(message));
    }
    cx.advance("tag", 0, 1)?;
    let domain = S::Id::DOMAIN;
    let marks = selection.mask(mesh, cx)?;
    let changed = match mesh.attributes().column(domain, name) {
        None => marks.iter().filter(|&&mark| mark).count(),
        Some(Column {
            values: Values::Tag(old),
            ..
        }) => marks
            .iter()
            .zip(old)
            .filter(|(new, old)| new != old)
            .count(),
        Some(column) => {
            let kind = column.values.type_name();
            let message = format!("the {domain} attribute \"{name}\" is no tag: it holds {kind}");
            return Err(OpError::Parameter(message));
        }
    };
    mesh.insert_column(
        domain,
        Column {
            name: name.to_owned(),
            rule: Rule::Copy,
            values: Values::Tag(marks),
        },
    );
    cx.advance("tag", 1, 1)?;
    Ok(changed)
}

/// What is wrong with the name of a tag, at the parameter `name`.
pub fn tag_problems(name: &str) -> Vec<Problem> {
    let problem = |message| Problem::error(message).at(["name"]);
    bad_name(name).map(problem).into_iter().collect()
}

fn bad_name(name: &str) -> Option<String> {
    (name.trim() != name || name.is_empty())
        .then(|| format!("a tag needs a name without blanks around it, not \"{name}\""))
}
