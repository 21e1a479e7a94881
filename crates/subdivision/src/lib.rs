//! Subdivision surfaces.

mod rules;

pub use rules::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split};

use mesh::Mesh;
use op::{OpError, Progress};

/// So many levels.
///
/// # Errors
///
/// [`OpError`].
pub fn subdivide(
    _mesh: &Mesh,
    _rules: &Rules,
    _levels: u32,
    _progress: &dyn Progress,
) -> Result<Mesh, OpError> {
    Err(OpError::Cancelled)
}
