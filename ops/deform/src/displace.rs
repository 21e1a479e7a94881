//! Displace: moves vertices along their normals, by amounts that vary over the surface.
//!
//! ```text
//!                                  .-.       .-.
//!    ---+---+---+---+---   -->    /   \_._  /   \      p + distance value(p) n(p)
//!                               -'         '     '-
//! ```

use geometry::deform::noise::{gradient, random};
use geometry::deform::vertex_directions;
use mesh::{DVec3, Domain, Values, VertexId};
use op::Refusal;
use op::prelude::*;

use crate::moved::moved;

/// Moves vertices along their normals, by amounts that vary over the surface.
///
/// Each vertex moves along its normal by `distance` times the value of `by`. The normal of a vertex is the mean of the
/// normals of its faces, weighted by their areas. Vertices without a normal do not move. The report counts them.
/// Normals and tangents are dropped. Faces, element ids and other attributes do not change.
///
/// The values are computed without functions whose results differ between machines, so the result is identical on all
/// machines.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Displace {
    /// The values by which `distance` is multiplied.
    pub by: DisplaceBy,
    /// The distance that a vertex with the value 1 moves, in scene units. A negative distance moves the vertex inwards.
    pub distance: Distance,
    /// The vertices to move. If omitted, all vertices.
    #[serde(default)]
    pub vertices: VertexSelection,
}

/// The values by which the distance of a displacement is multiplied.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum DisplaceBy {
    /// Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002). The value depends only on the position, so vertices
    /// at the same position move by the same amount.
    Noise {
        /// The size of the waves, in scene units.
        scale: PositiveLength,
        /// The seed. A different seed gives different noise. The same seed gives the same noise in every step. Defaults
        /// to 0.
        #[serde(default)]
        seed: u64,
    },
    /// A random number from -1 to 1 for each vertex, which depends on the id of the vertex.
    Random {
        /// The seed. A different seed gives different numbers. The same seed gives the same numbers in every step.
        /// Defaults to 0.
        #[serde(default)]
        seed: u64,
    },
    /// A vertex attribute that holds one number for each vertex.
    Attribute {
        /// The name of the attribute.
        name: String,
    },
}

impl MeshOperation for Displace {
    const NAME: &'static str = "Displace";
    const SUMMARY: &'static str = "Move vertices along their normals by noise or by an attribute";
    const EXAMPLE: &'static str = "Displace(by: Noise(scale: 0.5, seed: 7), distance: 0.1)";
    const WORDS: &'static [&'static str] = &["noise", "bump", "terrain", "rough", "jitter"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let DisplaceBy::Attribute { name } = &self.by else {
            return Vec::new();
        };
        let mut listed = plan.attributes.iter();
        if plan.has_unlisted_attributes
            || listed.any(|a| a.domain == Domain::Vertex && a.name == *name)
        {
            return Vec::new();
        }
        vec![Problem::error(missing(name)).at(["by", "name"])]
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;
        cx.advance("displace", 0, 1)?;
        let attribute = match &self.by {
            DisplaceBy::Attribute { name } => Some(numbers(mesh, name)?),
            _ => None,
        };
        let value = |v: VertexId, p: DVec3| match self.by {
            DisplaceBy::Noise { scale, seed } => gradient(seed, p / scale.get()),
            DisplaceBy::Random { seed } => random(seed, v.index() as u64),
            DisplaceBy::Attribute { .. } => attribute.as_ref().map_or(0.0, |a| a[v.index()]),
        };
        let normals = vertex_directions(mesh);
        let without = normals
            .iter()
            .zip(&mask)
            .filter(|(n, m)| **m && **n == DVec3::ZERO);
        let without = without.count();
        let report = moved(mesh, &mask, Self::NAME, "distance and by", |v, p| {
            p + self.distance.get() * value(v, p) * normals[v.index()]
        })?;
        Ok(report.count("vertices without a normal, not moved", without))
    }
}

/// Returns the values of a vertex attribute.
fn numbers(mesh: &Mesh, name: &str) -> Result<Vec<f64>, OpError> {
    match mesh
        .attributes()
        .column(Domain::Vertex, name)
        .map(|c| &c.values)
    {
        Some(Values::Float(values)) => Ok(values.clone()),
        Some(Values::Int(values)) => Ok(values.iter().map(|&x| f64::from(x)).collect()),
        Some(other) => Err(OpError::Parameter(format!(
            "by: the vertex attribute \"{name}\" holds {}, but `Displace` needs one number for each vertex",
            other.type_name()
        ))),
        None => Err(OpError::refused(
            Refusal::Missing,
            format!("by: {}", missing(name)),
        )),
    }
}

fn missing(name: &str) -> String {
    format!("the mesh has no vertex attribute \"{name}\"")
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{Column, Rule};
    use op::test::{applied_as_planned, refused, try_applied};

    fn parse(text: &str) -> Displace {
        op::test::read(text).unwrap()
    }

    #[test]
    fn vertices_move_along_their_normals_by_at_most_the_distance() {
        let mesh = shapes::icosahedron();
        for by in ["Noise(scale: 0.3)", "Random(seed: 3)"] {
            let after = applied_as_planned(&parse(&format!("(by: {by}, distance: 0.1)")), &mesh);
            let mut moves: Vec<f64> = Vec::new();
            for (p, q) in mesh.positions().iter().zip(after.positions()) {
                moves.push(q.dot(*p) - 1.0);
                assert!(q.distance(*p * q.length()) < 1e-14);
            }
            assert!(
                moves.iter().all(|m| m.abs() <= 0.1) && moves.iter().any(|m| m.abs() > 0.01),
                "{moves:?}"
            );
        }
    }

    #[test]
    fn seeds_give_different_results_and_half_the_distance_gives_half_the_move() {
        let mesh = shapes::torus(12, 9, 2.0, 0.7);
        let at = |seed: u32, distance: f64| {
            let text = format!("(by: Noise(scale: 0.7, seed: {seed}), distance: {distance})");
            applied_as_planned(&parse(&text), &mesh)
        };
        assert_ne!(at(1, 0.1).positions(), at(2, 0.1).positions());
        let (whole, half) = (at(1, 0.1), at(1, 0.05));
        for ((p, a), b) in mesh
            .positions()
            .iter()
            .zip(whole.positions())
            .zip(half.positions())
        {
            assert!(p.midpoint(*a).distance(*b) < 1e-15);
        }
    }

    #[test]
    fn attributes_are_heights() {
        let mut grid = shapes::grid(3, 3);
        let heights: Vec<f64> = (0..16).map(f64::from).collect();
        let values = Values::Float(heights.clone());
        grid.insert_column(
            Domain::Vertex,
            Column {
                name: "wall".into(),
                values,
                rule: Rule::Interpolate,
            },
        );
        let step = parse(r#"(by: Attribute(name: "wall"), distance: -2)"#);
        let after = applied_as_planned(&step, &grid);
        for (p, h) in after.positions().iter().zip(heights) {
            assert_eq!(p.z, -2.0 * h);
        }
        assert_eq!(refused(&step, shapes::cube()), Refusal::Missing);
        let mut wrong = shapes::cube();
        let values = Values::Vec3(vec![DVec3::X; 8]);
        wrong.insert_column(
            Domain::Vertex,
            Column {
                name: "wall".into(),
                values,
                rule: Rule::Interpolate,
            },
        );
        assert!(matches!(
            try_applied(&step, wrong),
            Err(OpError::Parameter(_))
        ));
    }
}
