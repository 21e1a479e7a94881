//! How pictures look, and the command that draws them.

use std::path::PathBuf;

use clap::Args as ClapArgs;

use super::{ReadArgs, ValueArgs};

/// How a scene is drawn.
#[derive(Debug, ClapArgs)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command line"
)]
pub(crate) struct DrawArgs {
    /// Its size in pixels, of each view of each file or cell; by default 1280x960, on a sheet 320x240
    #[arg(long, value_name = "WxH", value_parser = pixels)]
    pub(crate) size: Option<[u32; 2]>,
    /// The side from which it is seen, such as Front or Isometric; several stand side by side
    #[arg(long, value_name = "SIDE")]
    pub(crate) from: Vec<String>,
    /// Without perspective
    #[arg(long)]
    pub(crate) orthographic: bool,
    /// The z axis points upwards, not y
    #[arg(long)]
    pub(crate) z_up: bool,
    /// How light falls: Flat, Smooth, Phong, Matcap or Plain
    #[arg(long, value_name = "SHADING")]
    pub(crate) shading: Option<String>,
    /// Show the edges
    #[arg(long)]
    pub(crate) wireframe: bool,
    /// Nothing is behind the scene, in place of white
    #[arg(long)]
    pub(crate) transparent: bool,
    /// Mark elements, such as 'Sharp(above: 30)' or 'Faces(Boundary)'
    #[arg(long, value_name = "SELECTION")]
    pub(crate) highlight: Option<String>,
    /// Show numbers as colors, such as Valence or Area: all are shown by `meshwright ops Picture`. A file in it,
    /// as in 'DistanceTo("other.obj")', is seen from the working directory
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) color_by: Option<String>,
    /// Where images of materials are looked for, seen from the working directory; by default beside the file or
    /// recipe
    #[arg(long, value_name = "DIR")]
    pub(crate) images: Option<String>,
    /// More parameters of the operation Picture, as recipes write them
    #[arg(long, value_name = "FIELDS")]
    pub(crate) with: Option<String>,
    /// Only the objects of this name; may be given more than once
    #[arg(long, value_name = "OBJECT")]
    pub(crate) on: Vec<String>,
}

/// Whether failures are drawn.
#[derive(Debug, ClapArgs)]
pub(crate) struct PictureErrorsArgs {
    /// Draw each failure into this folder, the working directory unless told otherwise: the scene, with the
    /// elements that it is about large and marked
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

The parameters are those of the operation Picture: `meshwright ops Picture` shows them all. Those that
have no option here are given as recipes write them, as in --with 'style: (occlusion: 0, ids: Vertices)'; paths
in them are seen from the working directory.")]
pub(crate) struct PictureArgs {
    /// Files of meshes, patches or curves, or recipes (*.ron); patterns such as 'models/*.obj' too
    #[arg(required = true, value_name = "FILES")]
    pub(crate) files: Vec<String>,
    /// The image: .png, or for a turntable .gif or .apng; by default in the working directory, named as the file
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) draw: DrawArgs,
    /// Turn the camera once around the scene
    #[arg(long)]
    pub(crate) turntable: bool,
    /// Put many files on one sheet, each with its name
    #[arg(long)]
    pub(crate) sheet: bool,
    /// How many files, or views, stand in a row
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) columns: Option<u32>,
    /// The scene of a recipe after the step or call of this id
    #[arg(long, value_name = "ID", conflicts_with_all = ["before", "change"])]
    pub(crate) after: Option<String>,
    /// The scene of a recipe before the step or call of this id
    #[arg(long, value_name = "ID", conflicts_with = "change")]
    pub(crate) before: Option<String>,
    /// The scenes of a recipe before and after the step or call of this id, side by side
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
        _ => Err("expected a size such as 1280x960, of 1 to 16384 pixels a side".to_owned()),
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
