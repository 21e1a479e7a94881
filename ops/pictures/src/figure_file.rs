//! Writes figures into files.

use std::path::Path;

use op::prelude::*;
use render::PictureError;
use render::figure::{Svg, bytes_needed, pixel_size, pixels};

/// The formats of figures.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Format {
    Svg,
    Png,
}

impl Format {
    /// Returns the format for the extension of a path.
    fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// Adds the file of a figure to the plan. Returns the problems with the path of the file.
pub(crate) fn plan(path: &str, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
    plan.write(cx, path, |target| {
        let unknown = Problem::error(unknown_format(path)).at(["path"]);
        let help = "use the extension .svg or .png";
        Format::of(target).is_none().then(|| unknown.help(help))
    })
}

/// Writes a figure into a file. `scale` is the number of PNG pixels per SVG pixel.
pub(crate) fn write(
    path: &str,
    figure: &Svg,
    scale: Count<1, 8>,
    cx: &Context,
) -> Result<(), OpError> {
    let files = cx.files();
    let target = files.to_write(path).map_err(|e| files.output_error(e))?;
    let stamp = files.provenance.as_deref();
    let bytes = match Format::of(&target) {
        Some(Format::Svg) => figure.finish(stamp).into_bytes(),
        Some(Format::Png) => png(figure, scale, stamp, cx.budget)?,
        None => return Err(OpError::Parameter(unknown_format(path))),
    };
    let written = files.store.write(&target, &bytes);
    written.map_err(|e| files.output_error(e))
}

fn unknown_format(path: &str) -> String {
    format!("unknown figure format of \"{path}\"")
}

fn png(
    figure: &Svg,
    scale: Count<1, 8>,
    stamp: Option<&str>,
    budget: u64,
) -> Result<Vec<u8>, OpError> {
    let scale = f64::from(scale.get());
    let parameter_error = |error: PictureError| OpError::Parameter(error.to_string());
    let (width, height) = pixel_size(figure, scale).map_err(parameter_error)?;
    let needed = bytes_needed(width, height);
    if needed > budget {
        let message = format!(
            "the figure needs {} of memory, which exceeds the memory budget of {}",
            op::readable_bytes(needed),
            op::readable_bytes(budget)
        );
        return Err(OpError::Budget(message));
    }
    let image = pixels(figure, scale, [255; 4]).map_err(parameter_error)?;
    let texts: Vec<(&str, &str)> = stamp.iter().map(|stamp| ("Software", *stamp)).collect();
    image.to_png(&texts).map_err(parameter_error)
}
