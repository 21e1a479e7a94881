//! The names of attributes: in glTF and in a mesh.
//!
//! ```text
//! NORMAL <-> normal    TEXCOORD_0 <-> uv     TEXCOORD_n <-> uvn
//! COLOR_0 <-> color    _any_name  <-> any_name
//! ```
//!
//! Names that have a meaning of their own in a mesh keep their underscore when they are read: `_uv` stays
//! `_uv`, and is written as `__uv`, which is read as `_uv` again.

use gltf_json::mesh::Semantic;

/// The name in a mesh of an attribute of glTF; `None` for what is not read.
pub(super) fn attribute_name(semantic: &Semantic) -> Option<String> {
    match semantic {
        Semantic::Normals => Some("normal".to_owned()),
        Semantic::TexCoords(0) => Some("uv".to_owned()),
        Semantic::TexCoords(n) => Some(format!("uv{n}")),
        Semantic::Colors(0) => Some("color".to_owned()),
        Semantic::Extras(name) => Some(custom_name(name)),
        _ => None,
    }
}

/// The name in a mesh for an attribute `_name`.
fn custom_name(name: &str) -> String {
    if is_reserved(name) {
        format!("_{name}")
    } else {
        name.to_owned()
    }
}

/// Whether a name means something in a mesh, so that no other attribute may have it.
fn is_reserved(name: &str) -> bool {
    let known = "normal color tangent material smoothing crease position";
    name.is_empty() || known.split(' ').any(|one| one == name) || uv_set(name).is_some()
}

/// The number of texture coordinates of this name: 0 for `uv`, n for `uvn`.
pub(super) fn uv_set(name: &str) -> Option<u32> {
    let digits = name.strip_prefix("uv")?;
    if digits.is_empty() {
        return Some(0);
    }
    let n: u32 = digits.parse().ok()?;
    (n > 0 && n.to_string() == digits).then_some(n)
}

/// How an attribute without a meaning of its own is called in glTF; `None` if the name has one.
pub(super) fn custom_semantic(name: &str) -> Option<Semantic> {
    (!is_reserved(name)).then(|| Semantic::Extras(name.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back_and_reserved_ones_are_not_taken() {
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
