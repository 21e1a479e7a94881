//! Smooth: moves vertices so that noise disappears.
//!
//! ```text
//!        .   .                                        Laplacian   towards the mean of the neighbors
//!      .' '.' '.   .'            .--.----.--          Taubin      towards the mean and back: keeps the size
//!     /         '.'       -->   /                     Implicit    backward Euler steps of mean curvature flow
//!    /                         /                      Denoise     filtered normals, so that edges stay sharp
//! ```

use geometry::smooth::{Boundary, Method, SmoothError, Smoothing, Weights, smooth};
use geometry::sparse::SolveError;
use op::Refusal;
use op::prelude::*;

/// Moves vertices so that noise disappears.
///
/// A vertex moves only if it is in `vertices`, is not in `pin`, and has a face. All other vertices keep their exact
/// positions. Faces can have any number of corners, and degenerate faces are allowed. All elements keep their ids.
/// Attributes are kept, so textures stretch with the surface, but normals and tangents are dropped.
///
/// | `by` | use | size |
/// | --- | --- | --- |
/// | `Laplacian` | strong smoothing | shrinks |
/// | `Taubin` | removing noise | nearly the same |
/// | `Implicit` | strong smoothing of meshes with many small faces in one pass | shrinks |
/// | `Denoise` | scans of objects with flat sides and sharp edges | nearly the same |
///
/// If `boundary` is `Fixed`, vertices on the boundary do not move, so that objects that touch along their boundaries
/// still fit together.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Smooth {
    /// The method.
    pub by: SmoothBy,
    /// The number of passes. At most 10000. If omitted, 1 for `Implicit` and 10 for the other methods. With `Denoise`,
    /// `passes` counts only the passes that filter the normals, not the passes that then move the vertices.
    #[serde(default)]
    pub passes: Option<Count<1, 10_000>>,
    /// The vertices to move. If omitted, all vertices.
    #[serde(default)]
    pub vertices: VertexSelection,
    /// Vertices that do not move. If omitted, no vertices.
    #[serde(default)]
    pub pin: Option<VertexSelection>,
    /// How vertices on the boundary move.
    #[serde(default)]
    pub boundary: SmoothBoundary,
    /// Whether to restore the original volume of the mesh after smoothing. To restore the volume, all vertices that are
    /// allowed to move are shifted by the same distance along their normals. The mesh must be closed.
    #[serde(default)]
    pub keep_volume: bool,
}

/// A method to smooth surfaces.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum SmoothBy {
    /// Moves each vertex towards the mean of its neighbors.
    Laplacian {
        /// The weights of the neighbors.
        #[serde(default)]
        weights: SmoothWeights,
        /// The distance of the movement, as a fraction of the distance from the vertex to the mean of its neighbors.
        /// From 0 to 1. Defaults to 0.5.
        #[serde(default = "half")]
        factor: ClosedFraction,
    },
    /// Moves each vertex towards the mean of its neighbors, and then away from this mean with a slightly larger factor.
    /// This method removes noise, but keeps larger shapes and the volume nearly unchanged. One pass consists of both
    /// movements.
    Taubin {
        /// The weights of the neighbors.
        #[serde(default)]
        weights: SmoothWeights,
        /// The distance of the movement towards the mean, as a fraction of the distance from the vertex to the mean.
        /// From 0 to 1, exclusive. Values that would amplify noise are refused: with the default `pass_band`, these are
        /// values of more than about 0.7. Defaults to 0.33.
        #[serde(default = "taubin_factor")]
        factor: Fraction,
        /// The frequency below which shapes are kept. The frequencies of a mesh are from 0 (large shapes) to 2 (noise
        /// between neighboring vertices). A lower value smooths more. From 0 to 1, exclusive. Defaults to 0.05.
        #[serde(default = "pass_band")]
        pass_band: Fraction,
    },
    /// Moves the surface by mean curvature flow. Each pass is one time step of length `time`, and is stable for any
    /// length. Details smaller than the square root of the time disappear, regardless of how dense the vertices are.
    Implicit {
        /// The time, in squares of the scene unit.
        time: PositiveLength,
    },
    /// Filters the normals of the faces, so that similar normals of nearby faces become nearly equal. Then moves the
    /// vertices so that the faces fit the filtered normals.
    Denoise {
        /// Normals that differ by more than this angle hardly affect each other, so edges sharper than this angle are
        /// kept. From 0 to 180 degrees. Defaults to 30.
        #[serde(default = "thirty")]
        angle: AngleBetween,
    },
}

/// How the neighbors of a vertex are weighted. The vertex moves towards their weighted mean.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum SmoothWeights {
    /// All vertices that share an edge with the vertex have the same weight. These weights also make the lengths of
    /// edges more equal.
    #[default]
    Uniform,
    /// The weights depend on the angles of the faces (cotangent weights). With these weights, vertices hardly slide
    /// along the surface.
    Cotangent,
}

/// How vertices on the boundary move.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum SmoothBoundary {
    /// The vertices do not move.
    #[default]
    Fixed,
    /// The boundary is smoothed as a set of curves: the movement of a vertex on the boundary depends only on its
    /// neighbors along the boundary. With `by: Denoise(..)`, the boundary is not treated in this way, and its vertices
    /// move like all other vertices.
    Free,
}

const fn half() -> ClosedFraction {
    ClosedFraction::literal(0.5)
}

const fn taubin_factor() -> Fraction {
    Fraction::literal(0.33)
}

const fn pass_band() -> Fraction {
    Fraction::literal(0.05)
}

const fn thirty() -> AngleBetween {
    AngleBetween::literal(30.0)
}

/// The number of passes of `Denoise` that move the vertices.
const VERTEX_PASSES: u32 = 10;

impl SmoothBy {
    fn method(self) -> Method {
        let weights = |weights| match weights {
            SmoothWeights::Uniform => Weights::Uniform,
            SmoothWeights::Cotangent => Weights::Cotangent,
        };
        match self {
            Self::Laplacian { weights: w, factor } => Method::Laplacian {
                weights: weights(w),
                factor: factor.get(),
            },
            Self::Taubin {
                weights: w,
                factor,
                pass_band,
            } => Method::Taubin {
                weights: weights(w),
                factor: factor.get(),
                pass_band: pass_band.get(),
            },
            Self::Implicit { time } => Method::Implicit { time: time.get() },
            Self::Denoise { angle } => Method::Denoise {
                angle: angle.get(),
                vertex_passes: VERTEX_PASSES,
            },
        }
    }
}

impl MeshOperation for Smooth {
    const NAME: &'static str = "Smooth";
    const SUMMARY: &'static str = "Remove noise by moving vertices";
    const EXAMPLE: &'static str = "Smooth(by: Taubin())";
    const WORDS: &'static [&'static str] = &["fair", "relax", "denoise", "laplace", "fairing"];

    fn plan(&self, plan: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan.drop_normals();
        let unstable = || Problem::error(SmoothError::Unstable.to_string()).at(["by"]);
        let is_stable = self.by.method().is_stable();
        (!is_stable).then(unstable).into_iter().collect()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let mut is_free = self.vertices.mask(mesh, cx)?;
        if let Some(pin) = &self.pin {
            for (free, pinned) in is_free.iter_mut().zip(pin.mask(mesh, cx)?) {
                *free &= !pinned;
            }
        }
        let usual = match self.by {
            SmoothBy::Implicit { .. } => 1,
            _ => 10,
        };
        let smoothing = Smoothing {
            method: self.by.method(),
            passes: self.passes.map_or(usual, Count::get),
            is_free: &is_free,
            boundary: match self.boundary {
                SmoothBoundary::Fixed => Boundary::Fixed,
                SmoothBoundary::Free => Boundary::Free,
            },
            keep_volume: self.keep_volume,
        };
        let moved = smooth(mesh, &smoothing, cx.progress()).map_err(error)?;
        mesh.remove_normals();
        let report = Report::changed(moved);
        Ok(if is_free.contains(&true) {
            report
        } else {
            report.note("no vertex can move, because no vertex is selected or all selected vertices are pinned")
        })
    }
}

fn error(error: SmoothError) -> OpError {
    match error {
        SmoothError::Cancelled(cancelled)
        | SmoothError::Solve(SolveError::Cancelled(cancelled)) => cancelled.into(),
        SmoothError::NotClosed => OpError::refused(
            Refusal::Boundary,
            format!("`keep_volume`: {}", SmoothError::NotClosed),
        ),
        SmoothError::Solve(SolveError::TooLarge { .. }) => OpError::Budget(error.to_string()),
        other => OpError::Parameter(format!("Smooth: {other}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::{DVec3, VERTEX_NORMAL, VertexId};
    use op::test::{applied_as_planned, planned, refused, try_applied};

    fn parse(text: &str) -> Smooth {
        op::test::read(text).unwrap()
    }

    /// Returns a closed mesh with a spike at vertex 30.
    fn spiky() -> Mesh {
        let mut mesh = shapes::torus(32, 24, 2.0, 0.7);
        let v = VertexId::new(30);
        mesh.set_position(v, 1.05 * mesh.position(v));
        mesh.set(VERTEX_NORMAL, vec![DVec3::Z; mesh.n_vertices()]);
        mesh
    }

    const METHODS: [&str; 6] = [
        "Laplacian()",
        "Laplacian(weights: Cotangent, factor: 1)",
        "Taubin()",
        "Taubin(weights: Cotangent, factor: 0.5, pass_band: 0.05)",
        "Implicit(time: 0.05)",
        "Denoise(angle: 120)",
    ];

    #[test]
    fn all_methods_move_a_spike_back_and_drop_normals() {
        let before = spiky();
        let clean = shapes::torus(32, 24, 2.0, 0.7);
        for by in METHODS {
            let after = applied_as_planned(&parse(&format!("(by: {by})")), &before);
            let height = |mesh: &Mesh| {
                let v = VertexId::new(30);
                let sum: DVec3 = mesh.vertex_neighbors(v).map(|w| mesh.position(w)).sum();
                mesh.position(v).distance(sum / mesh.valence(v) as f64)
            };
            let [old, new] = [&before, &after].map(|mesh| height(mesh) - height(&clean));
            assert!(new < 0.9 * old, "{by} {old} {new}");
            assert!(after.get(VERTEX_NORMAL).is_none());
        }
    }

    #[test]
    fn pinned_and_unselected_vertices_keep_their_positions() {
        let before = spiky();
        for by in METHODS {
            let text =
                format!("(by: {by}, vertices: Not(Vertices([3, 4])), pin: Vertices([30, 31]))");
            let (after, report) = try_applied(&parse(&text), before.clone()).unwrap();
            for v in [3, 4, 30, 31].map(VertexId::new) {
                assert_eq!(after.position(v), before.position(v), "{by}");
            }
            assert!(report.changed > 700, "{by}");
        }
    }

    #[test]
    fn a_step_that_may_move_no_vertex_says_so() {
        for choice in ["vertices: Not(All)", "pin: All"] {
            let text = format!("(by: Taubin(), {choice})");
            let (after, report) = try_applied(&parse(&text), spiky()).unwrap();
            assert_eq!(after.positions(), spiky().positions());
            assert_eq!(report.notes.len(), 1, "{choice}");
        }
    }

    #[test]
    fn the_number_of_passes_depends_on_the_method() {
        for (by, usual) in [
            ("Taubin()", 10),
            ("Implicit(time: 0.1)", 1),
            ("Denoise()", 10),
        ] {
            let omitted = applied_as_planned(&parse(&format!("(by: {by})")), &spiky());
            let given = format!("(by: {by}, passes: {usual})");
            let given = applied_as_planned(&parse(&given), &spiky());
            assert_eq!(omitted.positions(), given.positions());
        }
    }

    #[test]
    fn the_boundary_stays_unless_it_is_free() {
        let grid = shapes::grid(4, 4);
        let fixed = applied_as_planned(&parse("(by: Laplacian())"), &grid);
        let free = applied_as_planned(&parse("(by: Laplacian(), boundary: Free)"), &grid);
        let corner = VertexId::new(0);
        assert_eq!(fixed.position(corner), grid.position(corner));
        assert_ne!(free.position(corner), grid.position(corner));
    }

    #[test]
    fn the_volume_is_kept_if_the_mesh_is_closed() {
        let step = parse("(by: Laplacian(), keep_volume: true)");
        let before = spiky();
        let after = applied_as_planned(&step, &before);
        let drift = geometry::volume(&after) / geometry::volume(&before) - 1.0;
        assert!(drift.abs() < 1e-12);
        assert_eq!(refused(&step, shapes::grid(2, 2)), Refusal::Boundary);
    }

    #[test]
    fn unstable_factors_are_found_before_the_run() {
        let (_, problems) = planned(&parse("(by: Taubin(factor: 0.9))"), &spiky());
        assert_eq!(problems.len(), 1);
        let refused = try_applied(&parse("(by: Taubin(factor: 0.9))"), spiky());
        assert!(matches!(refused, Err(OpError::Parameter(_))), "{refused:?}");
    }

    #[test]
    fn parameters_are_checked() {
        for wrong in [
            "()",
            "(by: Laplacian(factor: 1.5))",
            "(by: Implicit())",
            "(by: Implicit(time: 0))",
            "(by: Denoise(angle: 181))",
            "(by: Taubin(), passes: 0)",
            "(by: Taubin(pass_band: 0))",
        ] {
            assert!(op::test::read::<Smooth>(wrong).is_err(), "{wrong}");
        }
    }
}
