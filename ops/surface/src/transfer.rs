//! Transfer: copies attributes from the nearest points of another object.
//!
//! ```text
//!    source    .--o--.--o--.        each vertex, corner or face of the target takes the values
//!              |  ^  |  ^  |        of the nearest point of the source
//!    target    +--+-----+--+
//! ```

mod charts;
mod origins;

use std::collections::BTreeMap;

use geometry::surface_index::SurfaceIndex;
use mesh::{Column, DVec3, Domain, HalfEdgeId, Rule, Values};
use op::Refusal;
use op::prelude::*;

use origins::{Origin, Source};

/// Copies attributes from the nearest points of another object.
///
/// The step copies vertex, corner and face attributes from the object `from` to elements of the same kind in the
/// changed mesh. For each element, the step finds the nearest point on the surface of `from`, and the face that
/// contains this point. The values of vertex and corner attributes at this point are interpolated between corners of
/// this face. Attributes that are never interpolated, such as whole numbers and tags, are copied from the corner of
/// this face that is nearest to the point. Values of face attributes are copied from this face. If the changed mesh
/// already has the attribute with the same type of values, the attribute is overwritten. If the changed mesh has the
/// attribute with another type of values, the step fails. Without `on`, the step changes all meshes except the object
/// `from`.
///
/// Seams divide the source object into charts. All corners of a face of the changed mesh take their values from the
/// same chart. If a seam lies inside this chart, they take their values from the same side of the seam. This prevents
/// triangles from stretching across a seam of the texture. Usually the chart that is nearest to the center of the face
/// is used. Where parts of the source object intersect, the chart that is nearest to the center can be far from the
/// corners of the face. If another chart is nearest to a corner, and is much nearer to the face as a whole, this other
/// chart is used.
///
/// Elements that are farther from the source object than `within` keep their values, or get zeros if the attribute is
/// new. Either all corners of a face take values, or none of them. If one of the corners or the center of the face is
/// too far away, all corners of the face keep their values or get zeros. The report counts the elements that take no
/// values from the source object.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Transfer {
    /// The name of the object with the attributes.
    pub from: String,
    /// The names of the attributes, for example `["uv", "color"]`.
    pub attributes: Vec<String>,
    /// The largest distance from the object `from` at which an element takes values, in scene units. If omitted, there
    /// is no limit.
    #[serde(default)]
    pub within: Option<PositiveLength>,
}

impl Transfer {
    fn problem(&self) -> Option<&'static str> {
        if self.attributes.is_empty() {
            Some("Transfer needs at least one attribute")
        } else if self.attributes.iter().any(|name| name == "material") {
            Some(
                "materials cannot be transferred, because each object has its own list of materials",
            )
        } else {
            None
        }
    }
}

impl MeshOperation for Transfer {
    const NAME: &'static str = "Transfer";
    const VERSION: u32 = 2;
    const SUMMARY: &'static str = "Copy attributes from the nearest points of another object";
    const EXAMPLE: &'static str =
        r#"Transfer(from: "scan", attributes: ["uv", "color"], within: 0.01)"#;
    const WORDS: &'static [&'static str] = &["data transfer", "bake", "copy uv", "project uv"];

    fn reads(&self) -> Vec<(&str, &'static str)> {
        vec![(&self.from, "from")]
    }

    fn plan_reading(&self, name: &str, mesh: &MeshPlan) -> Vec<Problem> {
        if mesh.has_unlisted_attributes {
            return Vec::new();
        }
        let known = |name: &str| mesh.attributes.iter().any(|a| a.name == name);
        let unknown = (self.attributes.iter().enumerate()).filter(|(_, name)| !known(name));
        let list = mesh.attributes.iter().map(|a| (a.domain, a.name.as_str()));
        let list = list.collect::<Vec<_>>();
        let problem = |(i, wanted): (usize, &String)| {
            let message = missing(name, wanted, list.iter().copied());
            Problem::error(message).at(["attributes", &i.to_string()])
        };
        unknown.map(problem).collect()
    }

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        // The attributes come from another object, which this method does not know. This method therefore does not know
        // whether the attributes belong to vertices, corners or faces.
        plan.has_unlisted_attributes = true;
        let problem = |message| Problem::error(message).at(["attributes"]);
        self.problem().map(problem).into_iter().collect()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if let Some(problem) = self.problem() {
            return Err(OpError::Parameter(problem.to_owned()));
        }
        let other = cx.other_mesh(Self::NAME, &self.from)?;
        let columns = self.columns(&other, mesh)?;
        cx.advance("transfer", 0, 1)?;
        let Some(index) = SurfaceIndex::with_progress(&other, cx.progress())? else {
            return Err(OpError::Object(format!("\"{}\" has no faces", self.from)));
        };
        let uses = |domain| columns.iter().any(|column| column.0 == domain);
        let source = Source {
            mesh: &other,
            index: &index,
            within: self.within.map_or(f64::INFINITY, PositiveLength::get),
        };
        let vertices = if uses(Domain::Vertex) || uses(Domain::Corner) {
            index.nearest_to_points(mesh.positions(), cx.progress())?
        } else {
            Vec::new()
        };
        let faces = if uses(Domain::Face) || uses(Domain::Corner) {
            let centers: Vec<DVec3> = mesh.faces().map(|f| mesh.face_center(f)).collect();
            index.nearest_to_points(&centers, cx.progress())?
        } else {
            Vec::new()
        };
        let mut report = Report::default();
        let mut far = BTreeMap::new();
        for (domain, column) in &columns {
            let origins = match domain {
                Domain::Vertex => vertices.iter().map(|hit| source.of_vertex(hit)).collect(),
                Domain::Face => faces.iter().map(|hit| source.of_face(hit)).collect(),
                _ => source.of_corners(mesh, &column.values, &vertices, &faces, cx)?,
            };
            // A half-edge without a face is not a corner, so it is not counted.
            let is_element =
                |i: usize| *domain != Domain::Corner || mesh.face(HalfEdgeId::new(i)).is_some();
            let elements = (0..origins.len()).filter(|&i| is_element(i));
            let kept = elements.clone().filter(|&i| origins[i].is_none()).count();
            far.insert(*domain, kept);
            report.changed += (elements.count() - kept) as u64;
            let new = transferred(
                column,
                mesh.attributes().column(*domain, &column.name),
                &origins,
            );
            mesh.insert_column(*domain, new);
        }
        for (domain, kept) in far {
            let what = format!(
                "{} that take no values from \"{}\", because they are farther away from it than `within`",
                plural(domain),
                self.from
            );
            report = report.count(&what, kept);
        }
        Ok(report)
    }
}

impl Transfer {
    /// Returns the attribute columns of the mesh `other` that the step copies.
    fn columns(&self, other: &Mesh, mesh: &Mesh) -> Result<Vec<(Domain, Column)>, OpError> {
        let mut columns = Vec::new();
        for name in &self.attributes {
            let found = || other.attributes().iter().filter(|(_, c)| c.name == *name);
            if found().next().is_none() {
                let known = other.attributes().iter();
                let known = known.map(|(domain, c)| (domain, c.name.as_str()));
                let message = missing(&self.from, name, known);
                return Err(OpError::refused(Refusal::Missing, message));
            }
            for (domain, column) in found() {
                if domain == Domain::Edge {
                    let message = format!(
                        "\"{name}\" is an edge attribute, but Transfer copies only attributes of vertices, corners and faces"
                    );
                    return Err(OpError::refused(Refusal::Missing, message));
                }
                if let Some(old) = mesh.attributes().column(domain, name)
                    && old.values.type_name() != column.values.type_name()
                {
                    let message = format!(
                        "the {domain} attribute \"{name}\" has the type \"{}\" in \"{from}\", but the type \"{}\" in the mesh that receives the values",
                        column.values.type_name(),
                        old.values.type_name(),
                        from = self.from
                    );
                    return Err(OpError::Object(message));
                }
                if !columns
                    .iter()
                    .any(|(d, c): &(Domain, Column)| *d == domain && c.name == *name)
                {
                    columns.push((domain, column.clone()));
                }
            }
        }
        Ok(columns)
    }
}

/// Returns the error message for an attribute `name` that the object `from` does not have.
fn missing<'a>(from: &str, name: &str, known: impl Iterator<Item = (Domain, &'a str)>) -> String {
    let known: Vec<String> = known
        .map(|(domain, name)| format!("{domain} attribute \"{name}\""))
        .collect();
    let known = if known.is_empty() {
        "none".to_owned()
    } else {
        known.join(", ")
    };
    format!("\"{from}\" has no attribute \"{name}\"; its attributes: {known}")
}

const fn plural(domain: Domain) -> &'static str {
    match domain {
        Domain::Vertex => "vertices",
        Domain::Corner => "corners",
        Domain::Edge => "edges",
        Domain::Face => "faces",
    }
}

/// Returns the new attribute column of the target. For each element of the target, `origins` states the source elements
/// from which it takes its value. If there are none, the element keeps its value in `old`, or gets zero if `old` is
/// `None`.
fn transferred(column: &Column, old: Option<&Column>, origins: &[Origin]) -> Column {
    let mut values = column.values.clone();
    let n = values.len();
    let is_appended = old.is_some_and(|old| values.append(&old.values));
    let interpolates = matches!(column.rule, Rule::Interpolate | Rule::Normal);
    let mut new = values.blend(origins.len(), |i, add| match origins[i] {
        Some(parts) if interpolates => {
            for (source, weight) in parts.into_iter().filter(|part| part.1 > 0.0) {
                add(source, weight);
            }
        }
        Some(parts) => {
            let first = parts[0];
            let largest = parts
                .into_iter()
                .fold(first, |a, b| if b.1 > a.1 { b } else { a });
            add(largest.0, 1.0);
        }
        None if is_appended => add(n + i, 1.0),
        None => {}
    });
    if let (Rule::Normal, Values::Vec3(normals)) = (column.rule, &mut new) {
        for normal in normals {
            *normal = normal.normalize_or_zero();
        }
    }
    column.with_values(new)
}

#[cfg(test)]
mod tests;
