//! Options for reading mesh files.

use clap::Args as ClapArgs;
use mesh_io::{CleanupPolicy, NonManifold, Orientation, Placements, Policies, ReadOptions};
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeOwned, IntoDeserializer};

/// Options of the commands that read a mesh file.
#[derive(Debug, ClapArgs)]
pub(crate) struct ReadArgs {
    /// Fail if the reader would leave out a part of the file. With `convert`, also fail if the written file would not
    /// store everything
    #[arg(long)]
    pub(crate) strict: bool,
    /// How non-manifold edges and vertices are read: Split (copy vertices until the faces form a manifold) or Refuse
    /// (fail)
    #[arg(long, default_value = "Split", value_name = "POLICY", value_parser = policy::<NonManifold>)]
    non_manifold: NonManifold,
    /// How neighboring faces with opposite orientations are read: Orient (reverse faces until neighbors agree) or Keep
    #[arg(long, default_value = "Orient", value_name = "POLICY", value_parser = policy::<Orientation>)]
    orientation: Orientation,
    /// How faces with the same vertices as an earlier face are read: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    duplicates: CleanupPolicy,
    /// How faces with zero area are read: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    degenerate: CleanupPolicy,
    /// How vertices without faces are read: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    isolated: CleanupPolicy,
    /// How the nodes of glTF files are read: Keep, or Bake (apply their transforms to the points)
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<Placements>)]
    placements: Placements,
}

impl ReadArgs {
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            name: None,
            policies: Policies {
                non_manifold: self.non_manifold,
                orientation: self.orientation,
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

/// Parses the name of a policy. The names are the same as in recipes, but can be in lower or upper case. Each name is a
/// single word.
pub(super) fn policy<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let mut name = text.to_ascii_lowercase();
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    let name: StrDeserializer<serde::de::value::Error> = name.as_str().into_deserializer();
    T::deserialize(name).map_err(|error| error.to_string())
}
