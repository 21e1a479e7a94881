//! The items that nearly every operation uses, imported with `use op::prelude::*;`. [`Operation`](crate::Operation) is
//! not included, because every [`MeshOperation`] also implements it, so `Self::NAME` would be ambiguous.

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
