//! `meshwright schema`: prints the JSON schema of recipes.

use op::Registry;

use crate::output::print;

pub(crate) fn run(registry: &Registry) -> anyhow::Result<bool> {
    print(&format!("{:#}\n", recipe::schema(registry)))?;
    Ok(true)
}
