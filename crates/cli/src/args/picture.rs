//! Options for pictures, and the arguments of the command `picture`.

use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::{ReadArgs, ValueArgs};

/// Options that determine how a scene is drawn.
#[derive(Debug, ClapArgs)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each field is a switch of the command line"
)]
pub(crate) struct DrawArgs {
    /// Size of each view in pixels; defaults to 1280x960, and to 320x240 on a sheet
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pub(crate) size: Option<[u32; 2]>,
    /// View direction, such as Front or Isometric; can be repeated to draw several views side by side
    #[arg(long, value_name = "SIDE")]
    pub(crate) from: Vec<String>,
    /// Use a camera without perspective
    #[arg(long)]
    pub(crate) orthographic: bool,
    /// Draw the z axis upwards. By default, the z axis points up if the model stands on the plane z = 0 but not on the
    /// plane y = 0. Otherwise, the y axis points up
    #[arg(long)]
    pub(crate) z_up: bool,
    /// Shading: Flat, Smooth, Phong, Matcap or Plain
    #[arg(long, value_name = "SHADING")]
    pub(crate) shading: Option<String>,
    /// Draw the edges of meshes and the grids of patches
    #[arg(long)]
    pub(crate) wireframe: bool,
    /// Draw the control nets of patches and the control polygons of curves
    #[arg(long)]
    pub(crate) control_nets: bool,
    /// Draw a transparent background instead of a white background
    #[arg(long)]
    pub(crate) transparent: bool,
    /// Highlight elements, such as 'Sharp(above: 30)' or 'Faces(Boundary)'
    #[arg(long, value_name = "SELECTION")]
    pub(crate) highlight: Option<String>,
    /// Color the surface by a quantity, such as Valence or Area; `meshwright ops Picture` lists all quantities. Paths,
    /// as in 'DistanceTo("other.obj")', are relative to the working directory
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) color_by: Option<String>,
    /// The folder of texture images that are not next to their model. The path is relative to the working directory.
    /// Defaults to the folder of the model or recipe that is drawn
    #[arg(long, value_name = "DIR")]
    pub(crate) images: Option<String>,
    /// Further parameters of the operation Picture, written as in recipes
    #[arg(long, value_name = "FIELDS")]
    pub(crate) with: Option<String>,
    /// Draw only the object with this name; can be repeated
    #[arg(long, value_name = "OBJECT")]
    pub(crate) on: Vec<String>,
}

/// The option that draws a picture of each failure.
#[derive(Debug, ClapArgs)]
pub(crate) struct PictureErrorsArgs {
    /// Write a picture of each failure (at most 20 pictures), with the affected elements enlarged and highlighted. The
    /// pictures are written to DIR, which defaults to the working directory
    #[arg(
        long,
        value_name = "DIR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "."
    )]
    pub(crate) picture_errors: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples:
  meshwright picture cow.obj --wireframe --out cow.png
  meshwright picture part.glb --from Front --from Top --highlight 'Sharp(above: 30)'
  meshwright picture scenes/cube.ron --change split --color-by Valence
  meshwright picture 'models/**/*.obj' --sheet --columns 6

`meshwright ops Picture` describes all parameters of a picture. If a parameter has no option of its own,
use --with and write the parameter as in recipes: --with 'style: (occlusion: 0, ids: Vertices)'. Paths in
these parameters are relative to the working directory.")]
pub(crate) struct PictureArgs {
    /// Mesh, patch or curve files, or recipes (*.ron); patterns such as 'models/*.obj' are allowed
    #[arg(required = true, value_name = "FILES")]
    pub(crate) files: Vec<String>,
    /// The image to write: a .png file or, for a turntable, a .gif or .apng file. By default, the image is written to
    /// the working directory, and has the name of the input file (with --sheet, the name `sheet`)
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) draw: DrawArgs,
    /// Draw an animation in which the camera turns once around the scene
    #[arg(long)]
    pub(crate) turntable: bool,
    /// Draw all files on one sheet, each with its name
    #[arg(long)]
    pub(crate) sheet: bool,
    /// Number of views in each row; on a sheet, the number of files in each row
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) columns: Option<u32>,
    /// For a recipe, draw the scene after the step (or `Call`) with this id
    #[arg(long, value_name = "ID", conflicts_with_all = ["before", "change"])]
    pub(crate) after: Option<String>,
    /// For a recipe, draw the scene before the step (or `Call`) with this id
    #[arg(long, value_name = "ID", conflicts_with = "change")]
    pub(crate) before: Option<String>,
    /// For a recipe, draw two scenes side by side: before and after the step (or `Call`) with this id
    #[arg(long, value_name = "ID", conflicts_with = "sheet")]
    pub(crate) change: Option<String>,
    #[command(flatten)]
    pub(crate) values: ValueArgs,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
}

fn pixels(text: &str) -> Result<[u32; 2], String> {
    let parse = |side: &str| side.parse().ok().filter(|n| (1..=16_384).contains(n));
    let sides = text.split_once('x').map(|(w, h)| (parse(w), parse(h)));
    match sides {
        Some((Some(width), Some(height))) => Ok([width, height]),
        _ => Err("expected a size such as 1280x960, with 1 to 16384 pixels per side".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_has_two_sides() {
        assert_eq!(pixels("640x480"), Ok([640, 480]));
        for wrong in ["640", "640x", "x480", "0x10", "16385x1", "-1x1", "1x1x1"] {
            assert!(pixels(wrong).is_err(), "{wrong}");
        }
    }
}
