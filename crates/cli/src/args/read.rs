//! Options for reading mesh files.

use clap::Args as ClapArgs;
use mesh_io::{CleanupPolicy, NonManifold, Orientation, Placements, Policies, ReadOptions};
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeOwned, IntoDeserializer};

/// Options of the commands that read a mesh file.
#[derive(Debug, ClapArgs)]
pub(crate) struct ReadArgs {
    /// Fail if anything would be lost: a part of the file that the reader leaves out or, with `convert`, content that
    /// the written file does not store
    #[arg(long)]
    pub(crate) strict: bool,
    /// Handling of non-manifold edges and vertices: Split or Refuse
    #[arg(long, default_value = "Split", value_name = "POLICY", value_parser = policy::<NonManifold>)]
    non_manifold: NonManifold,
    /// Handling of neighboring faces with opposite orientations: Orient or Keep; by default, Keep for `convert` and
    /// Orient for other commands
    #[arg(long, value_name = "POLICY", value_parser = policy::<Orientation>)]
    pub(crate) orientation: Option<Orientation>,
    /// Handling of faces with the same vertices as an earlier face: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    duplicates: CleanupPolicy,
    /// Handling of faces with zero area: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    degenerate: CleanupPolicy,
    /// Handling of vertices without faces: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    isolated: CleanupPolicy,
    /// Handling of the nodes of glTF files: Keep them, or Bake their transforms into the points
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<Placements>)]
    placements: Placements,
}

impl ReadArgs {
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            name: None,
            policies: Policies {
                non_manifold: self.non_manifold,
                orientation: self.orientation.unwrap_or_default(),
                duplicates: self.duplicates,
                degenerate: self.degenerate,
                isolated: self.isolated,
            },
            placements: self.placements,
            strict: self.strict,
            ..ReadOptions::default()
        }
    }
}

/// Parses a policy from its name in recipes, in lower or upper case. The names are single words.
pub(super) fn policy<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let mut name = text.to_ascii_lowercase();
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    let name: StrDeserializer<serde::de::value::Error> = name.as_str().into_deserializer();
    T::deserialize(name).map_err(|error| error.to_string())
}
