//! Options that set the parameters of a recipe.

use clap::Args as ClapArgs;

use super::assignment;

/// Options that set the parameters of a recipe.
#[derive(Clone, Debug, Default, ClapArgs)]
pub(crate) struct ValueArgs {
    /// Set a parameter of the recipe; can be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Use a preset, which is a named set of parameter values in the recipe; values given with --set take precedence
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
}

impl ValueArgs {
    pub(crate) fn is_empty(&self) -> bool {
        self.set.is_empty() && self.preset.is_none()
    }
}
