//! The commands that look at meshes and compare them.

use std::path::PathBuf;

use clap::{Args as ClapArgs, ValueEnum};

use super::{Format, ReadArgs, ValueArgs};

/// Which elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    Vertices,
    Edges,
    Faces,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct SelectArgs {
    /// A file of meshes, or a recipe (*.ron): then the scene at its end
    pub(crate) file: PathBuf,
    /// A selection as in recipes, such as 'Sharp(above: 30)'
    pub(crate) selection: String,
    /// What it selects, where the selection does not tell
    #[arg(long, value_enum, value_name = "ELEMENTS")]
    pub(crate) of: Option<Kind>,
    /// Only on the object of this name; may be given more than once
    #[arg(long, value_name = "OBJECT")]
    pub(crate) on: Vec<String>,
    /// The scene of a recipe after the step or call of this id
    #[arg(long, value_name = "ID", conflicts_with = "before")]
    pub(crate) after: Option<String>,
    /// The scene of a recipe before the step or call of this id, with its random choices
    #[arg(long, value_name = "ID")]
    pub(crate) before: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    /// Show so many elements of each object
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub(crate) first: usize,
    /// Show all elements
    #[arg(long)]
    pub(crate) all: bool,
    /// Print only how many there are
    #[arg(long)]
    pub(crate) count: bool,
    /// Write an image (.png) in which they are marked, too
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct DiffArgs {
    /// A file of meshes, or a recipe (*.ron)
    pub(crate) first: PathBuf,
    /// Another one
    pub(crate) second: PathBuf,
    /// By how much positions and values of attributes may differ
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = not_negative)]
    pub(crate) tolerance: f64,
    /// The files are records of runs, as run --format json prints them
    #[arg(long)]
    pub(crate) runs: bool,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x >= 0.0 => Ok(x),
        _ => Err("expected a number that is not negative".to_owned()),
    }
}
