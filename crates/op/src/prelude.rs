//! What nearly every operation names: `use op::prelude::*;`. [`Operation`](crate::Operation) is not among it: every
//! [`MeshOperation`] is one too, and `Self::NAME` would be that of either.

pub use mesh::Mesh;
pub use scene::Scene;
pub use schemars::JsonSchema;
pub use serde::{Deserialize, Serialize};

pub use crate::{
    Angle, AngleBetween, ClosedFraction, Context, Count, Direction, Distance, EdgeSelection,
    FaceSelection, Factors, Fraction, Length, Levels, MeshOperation, MeshPlan, OnRefusal, OpError,
    Plan, PlanContext, PlannedGeometry, PositiveFactor, PositiveLength, Problem, Range, Report,
    Seams, Select, Sharpness, Source, TagName, Turn, Vector, VertexSelection, edit_each,
};
