//! Arguments of the commands `select` and `diff`.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{Format, ReadArgs, ValueArgs};

/// The kind of elements that a selection selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    Vertices,
    Edges,
    Faces,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct SelectArgs {
    /// A mesh file or a recipe (*.ron); for a recipe, its final scene is used
    pub(crate) file: PathBuf,
    /// The selection, written as in recipes, such as 'Sharp(above: 30)'
    pub(crate) selection: String,
    /// The kind of elements to select; required if the selection is valid for several kinds
    #[arg(long, value_enum, value_name = "ELEMENTS")]
    pub(crate) of: Option<Kind>,
    /// Select only elements of the object with this name; can be repeated
    #[arg(long, value_name = "OBJECT")]
    pub(crate) on: Vec<String>,
    /// For a recipe, use the scene after the step (or `Call`) with this id
    #[arg(long, value_name = "ID", conflicts_with = "before")]
    pub(crate) after: Option<String>,
    /// For a recipe, use the scene before the step (or `Call`) with this id; a random selection chooses the same
    /// elements as it would in that step
    #[arg(long, value_name = "ID")]
    pub(crate) before: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// Show at most N elements of each object
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub(crate) first: usize,
    /// Show all elements
    #[arg(long)]
    pub(crate) all: bool,
    /// Print only the number of selected elements
    #[arg(long)]
    pub(crate) count: bool,
    /// Also write an image (.png) with the selected elements highlighted
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct DiffArgs {
    /// The first mesh file or recipe (*.ron)
    pub(crate) first: PathBuf,
    /// The second mesh file or recipe (*.ron)
    pub(crate) second: PathBuf,
    /// Largest allowed difference between two positions or two attribute values
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = not_negative)]
    pub(crate) tolerance: f64,
    /// Compare two runs. Each file must contain the output of `meshwright run --format json`
    #[arg(long)]
    pub(crate) runs: bool,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x >= 0.0 => Ok(x),
        _ => Err("expected a number of at least 0".to_owned()),
    }
}
