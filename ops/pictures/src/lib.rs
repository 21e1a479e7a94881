//! Operations: pictures of scenes and figures of curves and half-edges.

mod curve_figure;
mod figure_file;
mod half_edge_figure;
mod picture;

use op::Registry;

pub use curve_figure::CurveFigure;
pub use half_edge_figure::HalfEdgeFigure;
pub use picture::{Mark, Picture, Turntable};

/// Adds the operations of this group, in the order of the reference.
#[rustfmt::skip]
pub fn register(registry: Registry) -> Registry {
    registry
        .with::<Picture>()
        .with::<CurveFigure>()
        .with::<HalfEdgeFigure>()
}
