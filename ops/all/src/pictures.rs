//! The pictures of operations in the reference: what the recipes in `pictures/` draw.
//!
//! `meshwright test ops/all/pictures --out ops/all/pictures` makes them again.

/// Operations with a picture of what is there before them, and one after.
#[rustfmt::skip]
const BEFORE_AND_AFTER: &[&str] = &[
    "BevelEdges", "BevelFaces", "BevelVertices", "Bisect", "BridgeLoops", "Butterfly", "CatmullClark",
    "CollapseEdges", "Copy", "Crease", "CurveLevels", "Cut", "Delete", "DeleteFaces", "DissolveEdges",
    "DissolveVertices", "DooSabin", "ExtrudeFaces", "FillHoles", "FlipEdges", "InsetFaces", "Join",
    "LoopSubdivide", "Midpoint", "MoveControlPoint", "PokeFaces", "Rename", "Reverse", "SampleCurve",
    "Separate", "SplitEdges", "SplitFaces", "Sqrt3", "Stitch", "TagEdges", "TagFaces", "TagVertices",
    "Tessellate", "Transform", "Triangulate", "VertexNormals", "Weld",
];

/// Operations with a picture after them: there is nothing before them, or they draw it themselves.
#[rustfmt::skip]
const AFTER: &[&str] = &[
    "Cube", "CurveFigure", "Cylinder", "Grid", "Icosahedron", "Load", "Octahedron", "Picture", "Polygons",
    "Tetrahedron", "Torus", "UvSphere",
];

/// The paths of the pictures of an operation, seen from the folder of the reference: before, if there was anything,
/// and after. None for operations without pictures.
pub fn pictures(operation: &str) -> Vec<String> {
    let names: &[&str] = if BEFORE_AND_AFTER.contains(&operation) {
        &["before", "after"]
    } else if AFTER.contains(&operation) {
        &["after"]
    } else {
        &[]
    };
    let path = |name| format!("all/pictures/{}/{name}.png", folder(operation));
    names.iter().map(path).collect()
}

/// `UvSphere` is `uv_sphere`.
fn folder(operation: &str) -> String {
    let mut folder = String::new();
    for c in operation.chars() {
        if c.is_ascii_uppercase() && !folder.is_empty() {
            folder.push('_');
        }
        folder.push(c.to_ascii_lowercase());
    }
    folder
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn every_operation_but_save_has_its_recipe_and_its_pictures() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        for entry in crate::registry().entries() {
            let paths = pictures(entry.name);
            assert_eq!(paths.is_empty(), entry.name == "Save", "{}", entry.name);
            for path in paths {
                let size = root.join(&path).metadata().map_or(0, |file| file.len());
                assert!((1..50_000).contains(&size), "{path}: {size} bytes");
            }
            let recipe = format!("all/pictures/{}.ron", folder(entry.name));
            assert!(root.join(&recipe).is_file(), "{recipe} is not there");
        }
    }
}
