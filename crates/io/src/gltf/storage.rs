//! Determines which attributes of a mesh a glTF file stores.

use mesh::{
    Domain, Values, joint_of, morph_name, morph_normal_of, morph_of, morph_tangent_of,
    morph_value_of, uv_set,
};

use super::names::custom_semantic;
use crate::Storage;

/// Returns how much of an attribute a file stores. `has` returns whether the mesh has an attribute with a given domain
/// and name.
pub(crate) fn storage(
    domain: Domain,
    name: &str,
    values: &Values,
    has: &dyn Fn(Domain, &str) -> bool,
) -> Storage {
    use Storage::{Kept, Lost, Partial};
    let kept_if = |is_kept| if is_kept { Kept } else { Lost };
    // A corner attribute takes precedence over a vertex attribute of the same name.
    let is_hidden = domain == Domain::Vertex && has(Domain::Corner, name);
    let has_normals = || has(Domain::Corner, "normal") || has(Domain::Vertex, "normal");
    match (domain, name, values) {
        (Domain::Face, "material", Values::Int(_)) => Kept,
        // Some joint weights can be lost, because a file stores only a few joints for each vertex. A morph target can
        // be lost if the indices of the morph targets have gaps.
        (Domain::Vertex, _, Values::Float(_)) if joint_of(name).is_some() => Partial,
        (Domain::Vertex, _, Values::Vec3(_)) if morph_of(name).is_some() => Partial,
        (Domain::Vertex | Domain::Corner, _, Values::Vec3(_))
            if morph_normal_of(name).is_some() =>
        {
            let target = morph_normal_of(name).unwrap_or_default();
            let has_deltas = has(Domain::Vertex, &morph_name(target));
            kept_if(has_deltas && has_normals() && !is_hidden)
        }
        (Domain::Corner, _, Values::Vec4(_)) if morph_tangent_of(name).is_some() => {
            let target = morph_tangent_of(name).unwrap_or_default();
            let has_deltas = has(Domain::Vertex, &morph_name(target));
            kept_if(has_deltas && has_normals() && has(Domain::Corner, "tangent"))
        }
        (Domain::Vertex | Domain::Corner, _, Values::Vec2(_) | Values::Vec4(_))
            if morph_value_of(name).is_some() =>
        {
            let (changed, target) = morph_value_of(name).unwrap_or_default();
            let has_changed = match values {
                Values::Vec2(_) => uv_set(changed).is_some() && has_uvs(changed, has),
                _ => changed == "color" && Domain::ALL[..2].iter().any(|&d| has(d, changed)),
            };
            kept_if(has_changed && has(Domain::Vertex, &morph_name(target)) && !is_hidden)
        }
        (Domain::Edge | Domain::Face, ..) | (.., Values::Int(_) | Values::Tag(_)) => Lost,
        (_, "normal", Values::Vec3(_)) => kept_if(!is_hidden),
        // The writer clamps color components to the range from 0 to 1, so values outside this range are lost.
        (_, "color", Values::Vec4(_)) => {
            if is_hidden {
                Lost
            } else {
                Partial
            }
        }
        (Domain::Corner, "tangent", Values::Vec4(_)) => kept_if(has_normals()),
        (Domain::Corner, _, Values::Vec2(_)) if uv_set(name).is_some() => {
            kept_if(has_uvs(name, has))
        }
        _ => kept_if(custom_semantic(name).is_some() && !is_hidden),
    }
}

/// Whether a mesh has this set of texture coordinates and all sets with lower numbers. `has` returns whether the mesh
/// has an attribute with a given domain and name.
fn has_uvs(name: &str, has: &dyn Fn(Domain, &str) -> bool) -> bool {
    let lower = 0..uv_set(name).unwrap_or_default();
    let name_of = |set| match set {
        0 => "uv".to_owned(),
        set => format!("uv{set}"),
    };
    has(Domain::Corner, name)
        && lower
            .into_iter()
            .all(|set| has(Domain::Corner, &name_of(set)))
}
