//! How files of meshes are read.

use clap::Args as ClapArgs;
use mesh_io::{CleanupPolicy, NonManifold, Orientation, Policies, ReadOptions};
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeOwned, IntoDeserializer};

/// What commands that read a file of meshes share.
#[derive(Debug, ClapArgs)]
pub(crate) struct ReadArgs {
    /// Fail where something of the file would be left out
    #[arg(long)]
    strict: bool,
    /// Where faces form no manifold: Split or Refuse
    #[arg(long, default_value = "Split", value_name = "POLICY", value_parser = policy::<NonManifold>)]
    non_manifold: NonManifold,
    /// Where neighboring faces disagree about their orientation: Orient or Keep
    #[arg(long, default_value = "Orient", value_name = "POLICY", value_parser = policy::<Orientation>)]
    orientation: Orientation,
    /// Faces with the vertices of an earlier one: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    duplicates: CleanupPolicy,
    /// Faces without area: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    degenerate: CleanupPolicy,
    /// Vertices that no face uses: Keep or Drop
    #[arg(long, default_value = "Keep", value_name = "POLICY", value_parser = policy::<CleanupPolicy>)]
    isolated: CleanupPolicy,
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
            strict: self.strict,
        }
    }
}

/// A policy by the name that it has in recipes.
fn policy<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let name: StrDeserializer<serde::de::value::Error> = text.into_deserializer();
    T::deserialize(name).map_err(|error| error.to_string())
}
