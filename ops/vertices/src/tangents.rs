//! Tangents: computes the tangents of corners for normal maps.

use mesh::{CORNER_NORMAL, CORNER_TANGENT, DVec2, Domain, VERTEX_NORMAL, Value};
use op::Refusal;
use op::prelude::*;

/// Computes tangents for normal maps with the `MikkTSpace` algorithm, which many other tools also use.
///
/// The mesh needs texture coordinates and normals, such as the normals that `VertexNormals` computes. The tangents are
/// written to the corner attribute `tangent`, which is replaced if it exists. Each value has four numbers: a unit
/// vector perpendicular to the normal, and then the sign of the bitangent (1 or -1). `.glb` and `.gltf` files store the
/// attribute as `TANGENT`. For the computation, polygons are triangulated in the same way as for `.glb` and `.gltf`
/// files. Later steps that change the shape or the faces remove the tangents, except a `Transform` that does not mirror
/// the points. If the texture coordinates define no direction at a corner, the corner gets an arbitrary tangent. This
/// happens, for example, if all corners of a face have the same texture coordinates. The report counts the corners with
/// an arbitrary tangent.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tangents {
    /// The name of the attribute with the texture coordinates for the normal map. Defaults to `uv`.
    #[serde(default = "uv")]
    pub uv: String,
}

fn uv() -> String {
    mesh::UV.name.to_owned()
}

impl MeshOperation for Tangents {
    const NAME: &'static str = "Tangents";
    const SUMMARY: &'static str = "Compute tangents at the corners of faces for normal maps";
    const EXAMPLE: &'static str = "Tangents()";
    const WORDS: &'static [&'static str] = &["normal map", "mikktspace", "bitangent"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if !plan.has_unlisted_attributes {
            let has = |domain, name: &str| {
                let mut attributes = plan.attributes.iter();
                attributes.any(|a| a.domain == domain && a.name == name)
            };
            if !has(Domain::Corner, &self.uv) {
                problems.push(Problem::error(self.no_uvs()).at(["uv"]));
            }
            let normals = [
                (Domain::Vertex, VERTEX_NORMAL.name),
                (Domain::Corner, CORNER_NORMAL.name),
            ];
            if !normals.iter().any(|(domain, name)| has(*domain, name)) {
                problems.push(Problem::error(NO_NORMALS).help(NORMALS_HELP));
            }
        }
        plan.provide(Domain::Corner, CORNER_TANGENT.name);
        // A later step that changes the connectivity drops the tangents, so it is not certain that the tangents are
        // kept.
        if let Some(tangents) = plan.attributes.last_mut() {
            tangents.certain = false;
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("tangents", 0, 1)?;
        let column = mesh.attributes().column(Domain::Corner, &self.uv);
        let uvs = column.and_then(|column| DVec2::of(&column.values));
        let uvs = uvs.ok_or_else(|| OpError::refused(Refusal::Missing, self.no_uvs()))?;
        let tangents = geometry::tangents(mesh, uvs).ok_or_else(|| {
            let message = format!("{NO_NORMALS}: {NORMALS_HELP}");
            OpError::refused(Refusal::Missing, message)
        })?;
        cx.advance("tangents", 1, 1)?;
        mesh.set(CORNER_TANGENT, tangents.values);
        let n = mesh.faces().map(|f| mesh.degree(f)).sum();
        let what = "corners at which the texture coordinates define no direction";
        Ok(Report::changed(n).count(what, tangents.n_arbitrary))
    }
}

const NO_NORMALS: &str = "the mesh has no normals";
const NORMALS_HELP: &str = "compute normals first, for example with VertexNormals()";

impl Tangents {
    fn no_uvs(&self) -> String {
        format!(
            "the mesh has no texture coordinates `{}`; compute them first, for example with Unwrap",
            self.uv
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, DVec4, UV};
    use op::test::{applied, try_applied};

    fn op(text: &str) -> Tangents {
        op::test::read(text).unwrap()
    }

    /// Returns a grid whose texture coordinates are the x and y coordinates of its vertices.
    fn sheet(name: &str) -> Mesh {
        let mut mesh = shapes::grid(3, 2);
        let place = |h: usize| mesh.position(mesh.origin(mesh::HalfEdgeId::new(h)));
        let uvs: Vec<_> = (0..mesh.n_half_edges())
            .map(|h| place(h).truncate())
            .collect();
        mesh.set(
            mesh::Attribute::<mesh::HalfEdgeId, DVec2>::new(Box::leak(name.into()), UV.rule),
            uvs,
        );
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; mesh.n_vertices()]);
        mesh
    }

    #[test]
    fn tangents_follow_the_chosen_texture_coordinates() {
        for (name, text) in [("uv", "()"), ("uv1", r#"(uv: "uv1")"#)] {
            let (mesh, report) = try_applied(&op(text), sheet(name)).unwrap();
            assert_eq!((report.changed, report.notes.len()), (24, 0));
            let tangents = mesh.get(CORNER_TANGENT).unwrap();
            for h in mesh.faces().flat_map(|f| mesh.face_half_edges(f)) {
                assert_eq!(tangents[h.index()], DVec4::new(1.0, 0.0, 0.0, 1.0));
            }
        }
    }

    #[test]
    fn missing_texture_coordinates_and_normals_are_refused_and_planned() {
        let mut bare = sheet("uv");
        bare.remove_normals();
        for (text, mesh, words) in [
            ("()", shapes::cube(), "no texture coordinates `uv`"),
            (
                r#"(uv: "uv1")"#,
                sheet("uv"),
                "no texture coordinates `uv1`",
            ),
            ("()", bare, "no normals"),
        ] {
            let error = try_applied(&op(text), mesh).unwrap_err();
            assert!(error.to_string().contains(words), "{error}");
        }
    }

    #[test]
    fn steps_that_change_the_faces_remove_the_tangents() {
        let mesh = applied(&op("()"), sheet("uv"));
        let mut changed = mesh.clone();
        changed.remove_normals();
        assert!(changed.get(CORNER_TANGENT).is_none());
        let mut changed = mesh;
        let e = changed
            .edges()
            .find(|&e| !changed.is_boundary_edge(e))
            .unwrap();
        changed.split_edge(e, 0.5).unwrap();
        assert!(changed.get(CORNER_TANGENT).is_none());
    }
}
