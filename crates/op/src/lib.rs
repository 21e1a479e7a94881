//! The traits that operations implement, and the code that operations share: the registry, the context of a running
//! operation, plans, reports, errors, selections and parameter types. This crate contains no operation.
//!
//! An operation is a struct whose fields are its parameters. Most operations change one mesh and implement
//! [`MeshOperation`]. For these operations, this crate chooses the meshes that a step changes (`on:`), reports lost
//! data, and undoes the changes after an error. Operations that need the whole scene implement [`Operation`].
//!
//! ```
//! use mesh::DVec3;
//! use op::prelude::*;
//!
//! /// Lifts every vertex.
//! #[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
//! #[serde(deny_unknown_fields)]
//! pub struct Lift {
//!     /// The distance, in scene units. A negative distance lowers the vertices.
//!     pub distance: Distance,
//! }
//!
//! impl MeshOperation for Lift {
//!     const NAME: &'static str = "Lift";
//!     const SUMMARY: &'static str = "Lift every vertex";
//!     const EXAMPLE: &'static str = "Lift(distance: 0.5)";
//!
//!     fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
//!         Vec::new() // counts and attributes do not change
//!     }
//!
//!     fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
//!         cx.advance("lift", 0, 1)?;
//!         for p in mesh.positions_mut() {
//!             *p += DVec3::new(0.0, 0.0, self.distance.get());
//!         }
//!         Ok(Report::changed(mesh.n_vertices()))
//!     }
//! }
//!
//! let registry = op::Registry::new().with::<Lift>();
//! assert!(registry.get("Lift").is_some());
//! let lifted = op::test::applied(&Lift { distance: Distance::literal(2.0) }, geometry::shapes::square());
//! assert_eq!(lifted.position(lifted.vertices().next().unwrap()), DVec3::new(0.0, 0.0, 2.0));
//! ```

mod attribute_name;
mod cancellable_store;
mod compiled_once;
mod context;
mod edit;
mod error;
mod error_location;
mod files;
mod mesh_plan;
mod operation;
mod parameter;
mod plan;
pub mod prelude;
mod problem;
mod range;
mod registry;
mod report;
mod selection;
mod source;
mod statistics;
mod tag;
mod targets;
pub mod test;

pub use attribute_name::{AttributeName, BadAttributeName};
pub use cancellable_store::CancellableStore;
pub use context::Context;
pub use edit::{EditTarget, OnRefusal, Seams, edit_each};
pub use error::{OpError, Refusal};
pub use error_location::ErrorLocation;
pub use files::{FileError, FileLog, FileUse, Files};
pub use mesh::{readable, readable_bytes};
pub use mesh_plan::{MeshPlan, PlannedAttribute};
pub use operation::{MeshOperation, Operation};
pub use parameter::{
    Angle, AngleBetween, Axis, BadVector, ClosedFraction, Count, Direction, Distance, Factors,
    Fraction, Length, Levels, Number, OutOfRange, PositiveFactor, PositiveLength, Seconds,
    Sharpness, Turn, Vector,
};
pub use plan::{Plan, PlanContext, PlannedGeometry, PlannedObject};
pub use problem::Problem;
pub use progress::{Cancelled, NoProgress, Progress};
pub use range::Range;
pub use registry::{DuplicateOperation, Entry, Registry, Step, to_ron};
pub use report::{Loss, ReadingChange, ReadingElements, Refused, Report};
pub use selection::{
    EdgeSelection, ElementKind, Elements, FaceSelection, Region, Select, Selected, VertexSelection,
    check_component,
};
pub use source::{Source, check_name, named_object};
pub use statistics::Statistics;
pub use tag::{BadTagName, TagName, tag};
pub use targets::{TargetKind, change_curves, plan_curves, target_names, target_scene};
