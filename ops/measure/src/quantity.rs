//! The quantities that `Measure` computes.

use geometry::Scaled;
use geometry::distance::vertex_distances_with;
use geometry::sparse::SolveError;
use geometry::surface_index::{SurfaceIndex, Winding};
use mesh::{Domain, FaceId, parallel};
use op::prelude::*;
use op::{Refusal, named_object};

/// A quantity that is computed for each vertex or for each face.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum MeasureOf {
    /// The mean curvature at each vertex, in 1 / scene unit (Cohen-Steiner, Morvan, 2003). It is 1 / r on a sphere of
    /// radius r, 1 / (2 r) on a cylinder, and negative where the surface is concave.
    MeanCurvature,
    /// The Gaussian curvature at each vertex, in 1 / scene unit² (Meyer, Desbrun, Schröder, Barr, 2003). It is the
    /// angle defect divided by the area of the vertex. The angle defect is 360° minus the sum of the corner angles at
    /// the vertex. The curvature is 1 / r² on a sphere of radius r, 0 on a cylinder, and negative at saddles. At a
    /// boundary vertex, the angle defect is 180° minus the sum of the corner angles. This is the angle by which the
    /// boundary turns at the vertex. It is divided by the area of the vertex, so the Gaussian curvature of boundary
    /// vertices depends on the size of the faces.
    GaussianCurvature,
    /// A principal curvature at each vertex, in 1 / scene unit: an eigenvalue of the curvature tensor of Cohen-Steiner
    /// and Morvan, 2003. On a cylinder of radius r, the two principal curvatures are 0 and 1 / r.
    PrincipalCurvature(Principal),
    /// The area of each face, in scene units².
    Area,
    /// The area of the surface that belongs to each vertex, in scene units². Each face at the vertex contributes the
    /// area of the face divided by its number of corners.
    VertexArea,
    /// The smallest angle of each face, in degrees.
    MinAngle,
    /// The aspect ratio of each face (Stimpson, Ernst, Knupp, Pébay, Thompson, "The Verdict Geometric Quality Library",
    /// 2007). It is 1 for regular polygons, and more than 1 for all other polygons. The aspect ratio is not defined for
    /// zero-area faces.
    AspectRatio,
    /// The distance from each vertex to the nearest point of another mesh of the scene, in scene units. A step without
    /// `on` computes the distances for all meshes except the other mesh itself.
    Distance {
        /// The name of the object to which distances are measured.
        to: String,
        /// Whether distances are negative inside the other mesh, that is, where its winding number is more than 1/2 or
        /// less than -1/2.
        #[serde(default)]
        signed: bool,
    },
    /// The distance along the surface from each vertex to the nearest selected vertex, in scene units. It is computed
    /// by the heat method (Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013; Sharp, Crane, 2020). On fine meshes
    /// of smooth surfaces, the mean error is below 1 % of the largest distance. If no path of edges joins a vertex to a
    /// selected vertex, the distance of this vertex is not defined.
    Geodesic {
        /// The vertices from which distances are measured.
        from: VertexSelection,
    },
    /// The thickness of the solid at each vertex, in scene units. For each face at the vertex, a ray starts at the
    /// vertex and runs inward at a right angle to the face. It ends where it leaves the solid. The thickness is the
    /// length of the shortest ray. If no ray leaves the solid, for example on a flat sheet, the thickness is not
    /// defined.
    Thickness,
    /// The ambient occlusion of each vertex. Rays start at the vertex, and the value is the fraction of rays that hit
    /// the mesh, from 0 (open) to 1 (enclosed). The density of the rays is proportional to the cosine of their angle to
    /// the normal.
    Occlusion {
        /// The number of rays from each vertex. At most 4096. Defaults to 64.
        #[serde(default = "sixty_four")]
        rays: Count<1, 4096>,
        /// The seed of the rays. Defaults to 0.
        #[serde(default)]
        seed: u64,
    },
    /// The winding number of another mesh of the scene around each vertex (Jacobson, Kavan, Sorkine-Hornung, 2013;
    /// Barill, Dickson, Schmidt, Levin, Jacobson, 2018). It is 1 inside, 0 outside, and between 0 and 1 near gaps of
    /// the other mesh. The error is usually below 0.001. A step without `on` computes the winding numbers for all
    /// meshes except the other mesh itself.
    Winding {
        /// The name of the object whose winding number is computed.
        of: String,
    },
}

/// One of the two principal curvatures.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Principal {
    /// The larger of the two principal curvatures.
    Largest,
    /// The smaller of the two principal curvatures.
    Smallest,
}

const fn sixty_four() -> Count<1, 4096> {
    Count::literal(64)
}

impl MeasureOf {
    /// Returns the default name of the attribute.
    pub(crate) fn default_name(&self) -> &'static str {
        match self {
            Self::MeanCurvature => "mean_curvature",
            Self::GaussianCurvature => "gaussian_curvature",
            Self::PrincipalCurvature(Principal::Largest) => "largest_curvature",
            Self::PrincipalCurvature(Principal::Smallest) => "smallest_curvature",
            Self::Area => "area",
            Self::VertexArea => "vertex_area",
            Self::MinAngle => "min_angle",
            Self::AspectRatio => "aspect_ratio",
            Self::Distance { .. } => "distance",
            Self::Geodesic { .. } => "geodesic",
            Self::Thickness => "thickness",
            Self::Occlusion { .. } => "occlusion",
            Self::Winding { .. } => "winding",
        }
    }

    /// Returns the kind of elements for which the quantity has values.
    pub(crate) fn domain(&self) -> Domain {
        match self {
            Self::Area | Self::MinAngle | Self::AspectRatio => Domain::Face,
            _ => Domain::Vertex,
        }
    }

    /// Returns the default value for elements at which the quantity is not defined: 0 for quantities that can be
    /// negative, and otherwise -1.
    pub(crate) fn default_missing(&self) -> f64 {
        match self {
            Self::MeanCurvature
            | Self::GaussianCurvature
            | Self::PrincipalCurvature(_)
            | Self::Distance { signed: true, .. }
            | Self::Winding { .. } => 0.0,
            _ => -1.0,
        }
    }

    /// Returns the name of the other object that the quantity needs, and the path of the parameter that contains this
    /// name. Returns `None` if the quantity needs no other object.
    pub(crate) fn other(&self) -> Option<(&str, [&'static str; 3])> {
        match self {
            Self::Distance { to, .. } => Some((to, ["of", "Distance", "to"])),
            Self::Winding { of } => Some((of, ["of", "Winding", "of"])),
            _ => None,
        }
    }

    /// Returns the value for each vertex or face of a mesh, in the order of their ids. If the quantity is not defined
    /// at an element, the value of the element is not finite. The mesh must not have deleted elements.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Object`] if the other mesh is missing or has no faces. Returns [`OpError::Refused`] if a
    /// selection is refused, or if the mesh is so small or large that values are outside the range of floating-point
    /// numbers. Also returns [`OpError::Budget`] and [`OpError::Cancelled`].
    pub(crate) fn values(
        &self,
        mesh: &Mesh,
        scene: &Scene,
        cx: &Context,
    ) -> Result<Vec<f64>, OpError> {
        let scaled = Scaled::new(mesh);
        let small = scaled.mesh();
        let faces = |value: &(dyn Fn(FaceId) -> f64 + Sync)| {
            parallel::collect(mesh.n_faces(), |f| value(FaceId::new(f)))
        };
        let principal = |i: usize| {
            let both = geometry::principal_curvatures(small);
            both.into_iter().map(|pair| pair[i]).collect()
        };
        let restored = |values, dimension| restored(&scaled, values, dimension);
        Ok(match self {
            Self::MeanCurvature => restored(geometry::mean_curvatures(small), -1)?,
            Self::GaussianCurvature => restored(geometry::gaussian_curvatures(small), -2)?,
            Self::PrincipalCurvature(Principal::Smallest) => restored(principal(0), -1)?,
            Self::PrincipalCurvature(Principal::Largest) => restored(principal(1), -1)?,
            Self::Area => restored(faces(&|f| small.face_area(f)), 2)?,
            Self::VertexArea => restored(geometry::vertex_areas(small), 2)?,
            Self::MinAngle => faces(&|f| geometry::min_angle(small, f).to_degrees()),
            Self::AspectRatio => faces(&|f| geometry::aspect_ratio(small, f)),
            Self::Distance { to, signed } => {
                distances(mesh, other_mesh(scene, to)?, *signed, cx)?.ok_or_else(|| no_faces(to))?
            }
            Self::Geodesic { from } => {
                let is_source = from.mask(mesh, cx)?;
                geometry::geodesic_distances(mesh, &is_source, cx.progress()).map_err(unsolved)?
            }
            Self::Thickness => geometry::thickness(mesh, cx.progress())?,
            Self::Occlusion { rays, seed } => {
                geometry::occlusion(mesh, rays.get(), *seed, cx.progress())?
            }
            Self::Winding { of } => {
                windings(mesh, other_mesh(scene, of)?, cx)?.ok_or_else(|| no_faces(of))?
            }
        })
    }
}

/// Converts values to scene units. The values were computed on a scaled copy of the mesh.
///
/// # Errors
///
/// Returns [`OpError::Refused`] if a quantity is outside of the range of floating-point numbers.
fn restored(scaled: &Scaled, mut values: Vec<f64>, dimension: i32) -> Result<Vec<f64>, OpError> {
    for x in &mut values {
        let restored = scaled.restored(*x, dimension);
        if x.is_finite() && scaled.restored(restored, -dimension) != *x {
            let size = scaled.restored(1.0, 1);
            let message = format!(
                "the coordinates are about {size:.0e}, and values of this quantity are outside of the range of \
                 numbers; scale the mesh with Transform before the step"
            );
            return Err(OpError::refused(Refusal::BadNumber, message));
        }
        *x = restored;
    }
    Ok(values)
}

/// Returns the distances of all vertices from the surface of another mesh; `None` if the other mesh has no faces.
fn distances(
    mesh: &Mesh,
    other: &Mesh,
    signed: bool,
    cx: &Context,
) -> Result<Option<Vec<f64>>, OpError> {
    let mut found = vertex_distances_with(mesh, other, cx.progress())?;
    if signed
        && let Some(distances) = &mut found
        && let Some(windings) = windings(mesh, other, cx)?
    {
        for (distance, winding) in distances.iter_mut().zip(windings) {
            if winding.abs() > 0.5 {
                *distance = -*distance;
            }
        }
    }
    Ok(found)
}

/// Returns the winding numbers of another mesh around all vertices; `None` if the other mesh has no faces.
fn windings(mesh: &Mesh, other: &Mesh, cx: &Context) -> Result<Option<Vec<f64>>, OpError> {
    let [mesh, other] = Scaled::pair(mesh, other);
    let Some(index) = SurfaceIndex::with_progress(other.mesh(), cx.progress())? else {
        return Ok(None);
    };
    let winding = Winding::new(&index, cx.progress())?;
    let windings = winding.at_points(mesh.mesh().positions(), cx.progress())?;
    Ok(Some(windings))
}

fn unsolved(error: SolveError) -> OpError {
    match error {
        SolveError::Cancelled(cancelled) => cancelled.into(),
        SolveError::TooLarge { .. } => OpError::Budget(error.to_string()),
        other => OpError::Parameter(format!("Measure: {other}")),
    }
}

fn no_faces(name: &str) -> OpError {
    OpError::Object(format!("\"{name}\" has no faces"))
}

fn other_mesh<'s>(scene: &'s Scene, name: &str) -> Result<&'s Mesh, OpError> {
    let object = named_object(scene, name)?;
    let kind = object.geometry.kind();
    let wrong = || {
        OpError::Object(format!(
            "Measure needs a mesh, but the type of \"{name}\" is {kind}"
        ))
    };
    object.as_mesh().map(AsRef::as_ref).ok_or_else(wrong)
}
