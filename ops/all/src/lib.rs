//! The list of built-in operations: one line each.

mod pictures;
mod samples;

use op::Registry;

pub use pictures::pictures;
pub use samples::samples;

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
        .with::<separate::Separate>()
        .with::<join::Join>()
        .with::<copy::Copy>()
        .with::<delete::Delete>()
        .with::<rename::Rename>()
        .with::<weld::Weld>()
        .with::<bisect::Bisect>()
        .with::<triangulate::Triangulate>()
        .with::<flip_edges::FlipEdges>()
        .with::<split_edges::SplitEdges>()
        .with::<collapse_edges::CollapseEdges>()
        .with::<poke_faces::PokeFaces>()
        .with::<split_faces::SplitFaces>()
        .with::<delete_faces::DeleteFaces>()
        .with::<dissolve_edges::DissolveEdges>()
        .with::<dissolve_vertices::DissolveVertices>()
        .with::<extrude_faces::ExtrudeFaces>()
        .with::<inset_faces::InsetFaces>()
        .with::<bevel_faces::BevelFaces>()
        .with::<bevel_edges::BevelEdges>()
        .with::<bevel_vertices::BevelVertices>()
        .with::<stitch::Stitch>()
        .with::<cut::Cut>()
        .with::<fill_holes::FillHoles>()
        .with::<bridge_loops::BridgeLoops>()
        .with::<crease::Crease>()
        .with::<tag_vertices::TagVertices>()
        .with::<tag_edges::TagEdges>()
        .with::<tag_faces::TagFaces>()
        .with::<loop_subdivide::LoopSubdivide>()
        .with::<catmull_clark::CatmullClark>()
        .with::<midpoint::Midpoint>()
        .with::<butterfly::Butterfly>()
        .with::<sqrt3::Sqrt3>()
        .with::<doo_sabin::DooSabin>()
        .with::<vertex_normals::VertexNormals>()
        .with::<picture::Picture>()
        .with::<curve_figure::CurveFigure>()
        .with::<save::Save>()
}
