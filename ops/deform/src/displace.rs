//! Displace: moves vertices along their normals, by amounts that vary over the surface.
//!
//! ```text
//!                                  .-.       .-.
//!    ---+---+---+---+---   -->    /   \_._  /   \      p + distance value(p) n(p)
//!                               -'         '     '-
//! ```

use geometry::deform::noise::{gradient, random};
use geometry::deform::vertex_directions;
use mesh::{DVec2, DVec3, Domain, UV, Value, Values, VertexId};
use op::prelude::*;
use op::{Files, Refusal};
use render::{Heights, Image};

use crate::moved::moved;

/// Moves vertices along their normals, by amounts that vary over the surface.
///
/// Each vertex moves along its normal by `distance` times the value that `by` gives for this vertex. The normal of a
/// vertex is the area-weighted mean of its face normals. Vertices without a normal, such as isolated vertices, do not
/// move. The report counts these vertices. Normals and tangents are dropped. Faces, element ids and other attributes do
/// not change.
///
/// The displaced mesh is identical on all machines, because the computation uses only functions that do not depend on
/// the machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Displace {
    /// The source of the values by which `distance` is multiplied, for example noise or an image.
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
    /// Smooth noise from -1 to 1 (Perlin, "Improving Noise", 2002). At a vertex, the value depends only on the position
    /// of the vertex, so vertices at the same position have the same value.
    Noise {
        /// The size of the waves of the noise, in scene units.
        scale: PositiveLength,
        /// The seed. A different seed gives different noise. The same seed gives the same noise in every step. Defaults
        /// to 0.
        #[serde(default)]
        seed: u64,
    },
    /// A random number from -1 to 1 for each vertex. The number depends only on the seed and on the id of the vertex.
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
    /// The brightness of an image (a height map), from 0 (black) to 1 (white), at the texture coordinates of the
    /// vertex. Brightness is the mean of red, green and blue as they are stored in the file. Between the centers of
    /// pixels, the brightness is interpolated. Where the texture coordinates are less than 0 or more than 1, the image
    /// is repeated. A vertex on a seam has several texture coordinates; its value is the mean of the values at its
    /// corners. Gray PNG files with 16 bits per pixel give smoother surfaces than files with 8 bits.
    Image {
        /// The path of the PNG or JPEG file. A relative path is relative to the folder of the recipe.
        path: String,
        /// The name of the attribute that holds the texture coordinates. Defaults to `uv`.
        #[serde(default = "uv")]
        uv: String,
    },
}

fn uv() -> String {
    UV.name.to_owned()
}

impl MeshOperation for Displace {
    const NAME: &'static str = "Displace";
    const SUMMARY: &'static str =
        "Move vertices along their normals by noise, an image or an attribute";
    const EXAMPLE: &'static str = "Displace(by: Noise(scale: 0.5, seed: 7), distance: 0.1)";
    const WORDS: &'static [&'static str] = &[
        "noise",
        "bump",
        "terrain",
        "rough",
        "jitter",
        "heightmap",
        "height map",
        "displacement map",
    ];

    fn files(&self) -> Vec<&str> {
        match &self.by {
            DisplaceBy::Image { path, .. } => vec![path],
            _ => Vec::new(),
        }
    }

    fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let is_missing = |domain, name: &str| {
            let mut listed = plan.attributes.iter();
            !plan.has_unlisted_attributes && !listed.any(|a| a.domain == domain && a.name == name)
        };
        let mut problems = Vec::new();
        match &self.by {
            DisplaceBy::Attribute { name } if is_missing(Domain::Vertex, name) => {
                problems.push(Problem::error(missing(name)).at(["by", "Attribute", "name"]));
            }
            DisplaceBy::Image { path, uv } => {
                if is_missing(Domain::Corner, uv) {
                    let problem = Problem::error(missing_uv(uv)).at(["by", "Image", "uv"]);
                    problems.push(problem.help("add texture coordinates with Unwrap"));
                }
                if let Err(error) = image(path, cx.files, cx.budget) {
                    problems.push(Problem::error(error.to_string()).at(["by", "Image", "path"]));
                }
            }
            _ => {}
        }
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mask = self.vertices.mask(mesh, cx)?;
        cx.advance("displace", 0, 1)?;
        let stored = match &self.by {
            DisplaceBy::Attribute { name } => numbers(mesh, name)?,
            DisplaceBy::Image { path, uv } => {
                let bytes = image(path, cx.files(), cx.budget)?;
                cx.files().has_read(cx.files().to_read(path));
                let decoded = Heights::decode(&bytes).map_err(|error| unreadable(path, &error))?;
                heights(mesh, &decoded, uv)?
            }
            _ => Vec::new(),
        };
        let value = |v: VertexId, p: DVec3| match self.by {
            DisplaceBy::Noise { scale, seed } => gradient(seed, p / scale.get()),
            DisplaceBy::Random { seed } => random(seed, v.index() as u64),
            DisplaceBy::Attribute { .. } | DisplaceBy::Image { .. } => stored[v.index()],
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

/// Returns the values of the vertex attribute `name`, which must hold one number for each vertex.
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

/// Reads an image, and checks its format and size without decoding its pixels.
fn image(path: &str, files: &Files, budget: u64) -> Result<Vec<u8>, OpError> {
    let bytes = files.store.read(&files.to_read(path));
    let bytes = bytes.map_err(|error| OpError::File(error.to_string()))?;
    let [width, height] = Image::size(&bytes).map_err(|error| unreadable(path, &error))?;
    let needed = Heights::DECODING_BYTES * u64::from(width) * u64::from(height);
    if needed > budget {
        return Err(OpError::Budget(format!(
            "the image \"{path}\" needs {} of memory, which exceeds the memory budget of {}",
            op::readable_bytes(needed),
            op::readable_bytes(budget)
        )));
    }
    Ok(bytes)
}

fn unreadable(path: &str, error: &render::PictureError) -> OpError {
    OpError::File(format!("{path}: {error}"))
}

/// Returns, for each vertex, the mean of the heights at its corners; 0 if the vertex has no corner.
fn heights(mesh: &Mesh, heights: &Heights, uv: &str) -> Result<Vec<f64>, OpError> {
    let column = mesh.attributes().column(Domain::Corner, uv);
    let uvs = column
        .and_then(|column| DVec2::of(&column.values))
        .ok_or_else(|| OpError::refused(Refusal::Missing, format!("by: {}", missing_uv(uv))))?;
    let mean = |v: VertexId| {
        let corners = mesh
            .vertex_half_edges(v)
            .filter(|&h| mesh.face(h).is_some());
        let (sum, n) = corners.fold((0.0, 0.0), |(sum, n), h| {
            (sum + heights.at(uvs[h.index()]), n + 1.0)
        });
        if n > 0.0 { sum / n } else { 0.0 }
    };
    Ok(mesh.vertices().map(mean).collect())
}

fn missing_uv(uv: &str) -> String {
    format!(
        "the mesh has no texture coordinates `{uv}`; compute them first, for example with Unwrap"
    )
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

    /// Returns a plane grid and the folder of an image. The texture coordinates of a vertex are its x and y
    /// coordinates, scaled to the range from 0 to 1. The left half of the image is black, and the right half is white.
    fn grid_and_image() -> (Mesh, tempfile::TempDir) {
        let mut grid = shapes::grid(4, 4);
        let [min, max] = geometry::bounds(&grid).unwrap();
        let mut uvs = vec![DVec2::ZERO; grid.domain_len(Domain::Corner)];
        for h in grid.half_edges() {
            let p = grid.position(grid.origin(h));
            uvs[h.index()] = ((p - min) / (max - min)).truncate();
        }
        grid.set(UV, uvs);
        let mut image = Image::filled(2, 1, [0, 0, 0, 255]).unwrap();
        image.pixels[1] = [255; 4];
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.png"), image.to_png(&[]).unwrap()).unwrap();
        std::fs::write(folder.path().join("bad.png"), "no image").unwrap();
        (grid, folder)
    }

    fn files(folder: &tempfile::TempDir) -> Files {
        Files {
            input: folder.path().into(),
            ..Files::default()
        }
    }

    #[test]
    fn an_image_gives_heights_at_the_texture_coordinates() {
        let (grid, folder) = grid_and_image();
        let (mut mesh, files) = (grid.clone(), files(&folder));
        let step = parse(r#"(by: Image(path: "a.png"), distance: 2)"#);
        let mut cx = Context::new(&op::NoProgress, &files);
        let report = step.apply(&mut mesh, &mut cx).unwrap();
        // The image is not black at three of the five columns of vertices. Its values at these columns are 1/2, 1
        // and 1.
        assert_eq!(report.changed, 15);
        let [min, max] = geometry::bounds(&grid).unwrap();
        for (p, q) in grid.positions().iter().zip(mesh.positions()) {
            let u = (p.x - min.x) / (max.x - min.x);
            let height = (2.0 * u - 0.5).clamp(0.0, 1.0);
            assert_eq!(*q, *p + 2.0 * height * DVec3::Z);
        }
        let uses = files.log.take();
        let is_read = |file: &op::FileUse| *file == op::FileUse::Read(folder.path().join("a.png"));
        assert!(uses.iter().any(is_read));
    }

    #[test]
    fn vertices_on_a_seam_move_by_the_mean_over_their_corners() {
        let (mut grid, folder) = grid_and_image();
        let mut uvs = vec![DVec2::ZERO; grid.domain_len(Domain::Corner)];
        for h in grid.half_edges() {
            let is_white = grid.face(h) == Some(mesh::FaceId::new(0));
            uvs[h.index()].x = f64::from(u8::from(is_white));
        }
        grid.set(UV, uvs);
        let files = files(&folder);
        let step = parse(r#"(by: Image(path: "a.png", uv: "uv"), distance: 1)"#);
        let mut cx = Context::new(&op::NoProgress, &files);
        step.apply(&mut grid, &mut cx).unwrap();
        let corners = grid.face_vertices(mesh::FaceId::new(0));
        let mut heights: Vec<f64> = corners.map(|v| grid.position(v).z).collect();
        heights.sort_by(f64::total_cmp);
        assert_eq!(heights, [0.25, 0.5, 0.5, 1.0]);
    }

    #[test]
    fn missing_images_and_texture_coordinates_are_refused_in_the_plan_and_in_the_run() {
        let (grid, folder) = grid_and_image();
        let files = files(&folder);
        let problems = |text: &str, mesh: &Mesh| {
            let mut plan = MeshPlan::of(mesh);
            let cx = PlanContext {
                files: &files,
                on: None,
                budget: 1 << 20,
            };
            MeshOperation::plan(&parse(text), &mut plan, &cx)
        };
        let run = |text: &str, mut mesh: Mesh, budget: u64| {
            let mut cx = Context::new(&op::NoProgress, &files);
            cx.budget = budget;
            parse(text).apply(&mut mesh, &mut cx)
        };
        let good = r#"(by: Image(path: "a.png"), distance: 1)"#;
        assert_eq!(problems(good, &grid), []);
        for bad in ["no.png", "bad.png"] {
            let text = good.replace("a.png", bad);
            assert_eq!(problems(&text, &grid).len(), 1);
            assert!(matches!(
                run(&text, grid.clone(), u64::MAX),
                Err(OpError::File(_))
            ));
        }
        assert_eq!(problems(good, &shapes::cube()).len(), 1);
        assert!(matches!(
            run(good, shapes::cube(), u64::MAX),
            Err(OpError::Refused { .. })
        ));
        assert!(matches!(run(good, grid, 1), Err(OpError::Budget(_))));
    }
}
