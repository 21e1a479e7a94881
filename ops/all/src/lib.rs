//! The list of built-in operations: one line each.

use op::Registry;

/// Every built-in operation, in the order of the reference.
#[rustfmt::skip]
pub fn registry() -> Registry {
    Registry::new()
        .with::<load::Load>()
        .with::<polygons::Polygons>()
        .with::<cube::Cube>()
        .with::<tetrahedron::Tetrahedron>()
        .with::<octahedron::Octahedron>()
        .with::<icosahedron::Icosahedron>()
        .with::<grid::Grid>()
        .with::<torus::Torus>()
        .with::<cylinder::Cylinder>()
        .with::<uv_sphere::UvSphere>()
        .with::<tessellate::Tessellate>()
        .with::<sample_curve::SampleCurve>()
        .with::<curve_levels::CurveLevels>()
        .with::<move_control_point::MoveControlPoint>()
        .with::<transform::Transform>()
        .with::<reverse::Reverse>()
        .with::<join::Join>()
        .with::<copy::Copy>()
        .with::<delete::Delete>()
        .with::<rename::Rename>()
        .with::<weld::Weld>()
        .with::<triangulate::Triangulate>()
        .with::<flip_edges::FlipEdges>()
        .with::<split_edges::SplitEdges>()
        .with::<poke_faces::PokeFaces>()
        .with::<split_faces::SplitFaces>()
        .with::<delete_faces::DeleteFaces>()
        .with::<dissolve_edges::DissolveEdges>()
        .with::<dissolve_vertices::DissolveVertices>()
        .with::<extrude_faces::ExtrudeFaces>()
        .with::<loop_subdivide::LoopSubdivide>()
        .with::<vertex_normals::VertexNormals>()
        .with::<save::Save>()
}
