//! Converts between the names of attributes in glTF and in a mesh.
//!
//! ```text
//! NORMAL <-> normal    TEXCOORD_0 <-> uv     TEXCOORD_n <-> uvn
//! COLOR_0 <-> color    TANGENT <-> tangent   _any_name  <-> any_name
//! ```
//!
//! If a name without its leading underscore is a reserved name of a mesh, the reader keeps the underscore: `_uv` in a
//! file becomes the attribute `_uv`. The writer writes the attribute `_uv` as `__uv`, which is read as `_uv` again.

use gltf_json::mesh::Semantic;
use mesh::uv_set;

/// Returns the name that an attribute of glTF gets in a mesh, or `None` if the attribute is not read.
pub(super) fn attribute_name(semantic: &Semantic) -> Option<String> {
    match semantic {
        Semantic::Normals => Some("normal".to_owned()),
        Semantic::Tangents => Some("tangent".to_owned()),
        Semantic::TexCoords(0) => Some("uv".to_owned()),
        Semantic::TexCoords(n) => Some(format!("uv{n}")),
        Semantic::Colors(0) => Some("color".to_owned()),
        Semantic::Extras(name) => Some(custom_name(name)),
        _ => None,
    }
}

/// Returns the name that an attribute `_name` of glTF gets in a mesh.
fn custom_name(name: &str) -> String {
    if is_reserved(name) {
        format!("_{name}")
    } else {
        name.to_owned()
    }
}

/// Whether a mesh reserves this name for a predefined attribute.
fn is_reserved(name: &str) -> bool {
    let known = "normal color tangent material smoothing crease position";
    let is_rig = mesh::is_rig_name(name);
    name.is_empty() || is_rig || known.split(' ').any(|one| one == name) || uv_set(name).is_some()
}

/// Returns the name that a custom attribute gets in glTF, or `None` if the name is reserved.
pub(super) fn custom_semantic(name: &str) -> Option<Semantic> {
    (!is_reserved(name)).then(|| Semantic::Extras(name.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn custom_names_survive_a_round_trip_and_reserved_names_are_avoided() {
        for name in [
            "quality", "_x", "Corner", "corner", "uv0", "uv01", "uvs", "_uv", "__uv", "é",
        ] {
            let semantic = custom_semantic(name).unwrap();
            assert_eq!(attribute_name(&semantic).as_deref(), Some(name));
        }
        for (name, in_mesh) in [
            ("uv", "_uv"),
            ("uv2", "_uv2"),
            ("normal", "_normal"),
            ("", "_"),
        ] {
            assert_eq!(custom_semantic(name), None);
            let semantic = Semantic::Extras(name.to_owned());
            assert_eq!(attribute_name(&semantic).as_deref(), Some(in_mesh));
        }
    }
}
