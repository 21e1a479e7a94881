//! What nearly every operation names: `use op::prelude::*;`.

pub use mesh::Mesh;
pub use scene::Scene;
pub use schemars::JsonSchema;
pub use serde::{Deserialize, Serialize};

pub use crate::{
    Context, EdgeSelection, FaceSelection, MeshOperation, MeshPlan, OnRefusal, OpError, Operation,
    Plan, PlanContext, PlannedGeometry, Problem, Range, Report, Select, Source, Vector,
    VertexSelection, edit_each,
};
