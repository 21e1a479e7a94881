//! Operations that draw pictures of scenes, and figures of curves, half-edges and texture coordinates.

mod curve_figure;
mod figure_file;
mod half_edge_figure;
mod picture;
mod uv_picture;

use op::Registry;

pub use curve_figure::CurveFigure;
pub use half_edge_figure::HalfEdgeFigure;
pub use picture::{Mark, Picture, Turntable};
pub use uv_picture::{UvFill, UvPicture};

/// Adds the operations of this group to the registry. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Picture>()
        .with::<CurveFigure>()
        .with::<HalfEdgeFigure>()
        .with::<UvPicture>()
}
