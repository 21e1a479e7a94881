//! Operations for tests of recipes.

use geometry::shapes;
use mesh::{DVec3, Mesh};
use op::{
    Context, MeshOperation, MeshPlan, OpError, Operation, Plan, PlanContext, Problem, Refusal,
    Registry, Report, Select, Source, VertexSelection,
};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Makes a sheet of squares in one row.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Sheet {
    /// The number of squares.
    #[schemars(range(min = 1, max = 1_000_000))]
    columns: u32,
    /// The name of the new object.
    #[serde(default = "sheet")]
    name: String,
}

fn sheet() -> String {
    "sheet".to_owned()
}

impl Sheet {
    fn source(&self) -> Source<'_> {
        let n = u64::from(self.columns);
        let counts = MeshPlan::counted(2 * n + 2, 3 * n + 1, n, op::Range::exactly(4));
        Source::new(Self::NAME, Some(&self.name), counts)
    }
}

impl Operation for Sheet {
    const NAME: &'static str = "Sheet";
    const SUMMARY: &'static str = "Make a sheet";
    const EXAMPLE: &'static str = "Sheet(columns: 3)";

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        self.source().plan(plan)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        self.source()
            .insert(scene, cx, || shapes::grid(self.columns, 1))
    }
}

/// How to lift.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) enum Way {
    /// Up.
    #[default]
    #[serde(alias = "North")]
    #[schemars(extend("aliases" = ["North"]))]
    Up,
    /// By an additional distance.
    #[serde(alias = "More")]
    #[schemars(extend("aliases" = ["More"]))]
    Further {
        /// In scene units.
        #[serde(alias = "amount")]
        #[schemars(extend("aliases" = ["amount"]))]
        than: f64,
    },
}

/// Lifts vertices.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Lift {
    /// How far.
    #[serde(alias = "height")]
    #[schemars(extend("aliases" = ["height"]))]
    by: f64,
    /// How the vertices are lifted. The variants and their fields also have old names.
    #[serde(default)]
    way: Way,
    /// Which vertices.
    #[serde(default)]
    vertices: VertexSelection,
    /// If given, the operation fails with this reason after it has lifted some of the vertices.
    #[serde(default)]
    fails: Option<Refusal>,
}

impl MeshOperation for Lift {
    const NAME: &'static str = "Lift";
    const VERSION: u32 = 2;
    const ALIASES: &'static [&'static str] = &["Raise", "Elevate"];
    const SUMMARY: &'static str = "Lift vertices";
    const EXAMPLE: &'static str = "Lift(by: 1)";

    fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        if self.by > 1e6 {
            vec![Problem::error("that is too high").at(["by"])]
        } else if self.by == 0.0 {
            vec![Problem::warning("nothing moves").at(["by"])]
        } else {
            Vec::new()
        }
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let chosen = self.vertices.resolve(mesh, cx)?;
        assert!(self.by > -1e6, "the distance is too low");
        let by = match self.way {
            Way::Up => self.by,
            Way::Further { than } => self.by + than,
        };
        for (done, &v) in chosen.iter().enumerate() {
            cx.advance("lift", done as u64, chosen.len() as u64)?;
            mesh.positions_mut()[mesh::Id::index(v)] += DVec3::new(0.0, 0.0, by);
            if let Some(reason) = self.fails
                && done >= chosen.len() / 2
            {
                return Err(OpError::refused(reason, format!("{v} refuses")).about([v]));
            }
        }
        Ok(Report::changed(chosen.len()))
    }
}

/// Writes the names of all objects to a text file.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Write {
    /// The file.
    path: String,
}

impl Operation for Write {
    const NAME: &'static str = "Write";
    const SUMMARY: &'static str = "Write names";
    const EXAMPLE: &'static str = r#"Write(path: "names.txt")"#;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        plan.write(cx, &self.path, |_| None)
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("write", 0, 1)?;
        let failed = |error: &dyn std::fmt::Display| OpError::File(error.to_string());
        let path = cx.files().to_write(&self.path).map_err(|e| failed(&e))?;
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| failed(&e))?;
        }
        let names: Vec<&str> = scene.objects().iter().map(|o| o.name.as_str()).collect();
        std::fs::write(path, names.join("\n")).map_err(|e| failed(&e))?;
        Ok(Report::changed(1))
    }
}

pub(crate) fn registry() -> Registry {
    Registry::new()
        .with::<Sheet>()
        .with::<Lift>()
        .with::<Write>()
}

/// Returns a recipe with these steps.
pub(crate) fn steps(steps: &str) -> String {
    format!("(recipe: 1, steps: [{steps}])")
}
