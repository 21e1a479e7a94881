//! The sheet of a sweep: the scenes at the ends of its cells in one image.
//!
//! ```text
//!   cell by cell: scene --> extent (small) ---join---> extent of all
//!                   |                                       |
//!                   +-- kept, if there is memory, or -------+--> image --> sheet
//!                       else made again
//! ```

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::ensure;
use op::{Context, Files};
use ops_pictures::Picture;
use recipe::{Axis, Metric};
use render::figure::label::filled;
use render::figure::legend::{Legend, draw_legend, legend_figure};
use render::figure::{Color, Font};
use render::{Image, PictureError};
use scene::Scene;
use view::Extent;
use view::sheet::{Cell, Heads, SheetStyle, notice, sheet_size, sheet_with_heads};

use super::cell::{CellResult, Cells, Seen};
use super::{Plan, short};
use crate::args::{SweepArgs, WrongUsage};
use crate::commands::picture::{SHEET_CELL, check_names, parameters};
use crate::listener::{QUIET, is_interrupted};
use crate::many::{in_order, interrupted};

/// Most lines below a cell: its values, and what is kept of it.
const LINES: [usize; 2] = [2, 3];

/// The ink of errors.
const RED: Color = [0xb9, 0x1c, 0x1c, 255];

/// How the sheet is drawn, before anything has run.
pub(super) struct Sheet<'a> {
    args: &'a SweepArgs,
    picture: Picture,
    files: Files,
    layout: Layout,
    /// The bytes of the scenes that are kept until all are there.
    kept: AtomicU64,
}

/// The sheet.
pub(super) struct Drawn {
    pub(super) image: Image,
    /// The cells, from 0, that succeeded and cannot be drawn, with the reason.
    pub(super) errors: Vec<(usize, String)>,
    /// What is not shown as the scenes have it.
    pub(super) notes: BTreeSet<String>,
}

impl<'a> Sheet<'a> {
    /// Reads the options, if a sheet is wanted.
    pub(super) fn new(args: &'a SweepArgs, plan: &Plan) -> anyhow::Result<Option<Self>> {
        let Some(path) = &args.sheet else {
            return Ok(None);
        };
        let ending = path.extension().unwrap_or_default();
        if !ending.eq_ignore_ascii_case("png") {
            let message = format!("{}: expected an image that ends in .png", path.display());
            return Err(WrongUsage(message).into());
        }
        let picture = parameters(&args.draw, path, SHEET_CELL, Vec::new())?;
        if picture.turntable.is_some() {
            return Err(WrongUsage("the cells on a sheet do not move".to_owned()).into());
        }
        let sheet = Self {
            args,
            picture,
            files: Files {
                input: plan.recipe.folder().to_path_buf(),
                ..Files::default()
            },
            layout: Layout::of(plan, args.columns),
            kept: AtomicU64::new(0),
        };
        sheet.check_size(plan.grid.cells.len())?;
        Ok(Some(sheet))
    }

    /// The size of the image of each cell.
    fn cell_size(&self) -> [u32; 2] {
        let views = self.picture.views.len().max(1);
        let columns = self.picture.columns.map_or(4, |n| n.get() as usize);
        let columns = columns.min(views);
        let of = |side: u32, n: usize| side.saturating_mul(u32::try_from(n).unwrap_or(u32::MAX));
        let [width, height] = self.picture.size.map(op::Count::get);
        [of(width, columns), of(height, views.div_ceil(columns))]
    }

    fn style(&self) -> SheetStyle {
        SheetStyle {
            columns: self.layout.columns,
            background: self.picture.style.background.srgb(),
            ..SheetStyle::default()
        }
    }

    /// Whether the sheet can be made, however much stands below its cells.
    fn check_size(&self, n: usize) -> anyhow::Result<()> {
        let [width, height] = self.cell_size();
        let image = Image {
            width,
            height,
            pixels: Vec::new(),
        };
        let caption = "\n".repeat(LINES.iter().sum());
        let cell = Cell {
            image: &image,
            caption: &caption,
        };
        let (w, h) = sheet_size(&vec![cell; n], self.layout.heads(), &self.style())?;
        let pixels = u64::from(w) * u64::from(h) + n as u64 * u64::from(width) * u64::from(height);
        let (needed, budget) = (4 * pixels, self.args.many.budget);
        ensure!(needed <= budget, PictureError::Budget { needed, budget });
        Ok(())
    }

    /// Takes in the scene of a cell that took `bytes` to make.
    pub(super) fn see(&self, scene: Scene, bytes: u64) -> Seen {
        let check = check_names(&self.args.draw.on, &[&scene]);
        let extent = check.map_err(|e| e.to_string()).and_then(|()| {
            let extent = self.picture.extent(&scene, &mut self.context());
            extent.map_err(|error| error.to_string())
        });
        let most = kept_bytes(self.args.many.budget);
        let keep = |kept: u64| kept.checked_add(bytes).filter(|all| *all <= most);
        let order = Ordering::Relaxed;
        let is_kept = extent.is_ok() && self.kept.fetch_update(order, order, keep).is_ok();
        Seen {
            extent,
            scene: is_kept.then_some(scene),
            bytes,
        }
    }

    fn context(&self) -> Context<'_> {
        let mut cx = Context::new(&QUIET, &self.files);
        cx.budget = self.args.many.budget;
        let on = &self.args.draw.on;
        cx.on = (!on.is_empty()).then_some(on);
        cx
    }

    /// Draws all cells that succeeded.
    pub(super) fn draw(
        &self,
        plan: &Plan,
        cells: &Cells,
        results: &[CellResult],
    ) -> anyhow::Result<Drawn> {
        let extent_of = |result: &CellResult| result.seen.as_ref()?.extent.clone().ok();
        let mut extent = Extent::default();
        for one in results.iter().filter_map(extent_of) {
            extent.join(one);
        }
        let [width, height] = self.cell_size();
        let pixels = u64::from(width) * u64::from(height);
        let bytes = |i: usize| match &results[i].seen {
            Some(seen) if seen.scene.is_none() => seen.bytes.saturating_add(256 * pixels),
            Some(_) => 256 * pixels,
            None => 0,
        };
        let draw = |i: usize| self.image(cells, i, &results[i], &extent);
        let (mut errors, mut notes, mut images) = (Vec::new(), BTreeSet::new(), Vec::new());
        let mut stopped = false;
        let style = SheetStyle {
            ink: RED,
            ..self.style()
        };
        let limits = self.args.many.limits();
        in_order(results.len(), limits, bytes, draw, |i, end| {
            let drawn = end.unwrap_or_else(|panicked| {
                stopped |= panicked.is_none();
                Err(interrupted(panicked))
            });
            images.push(match drawn {
                Ok((image, more)) => {
                    notes.extend(more);
                    Ok(image)
                }
                Err(error) => {
                    let image = notice(&error, [width, height], &style);
                    if results[i].error.is_none() {
                        errors.push((i, error));
                    }
                    image
                }
            });
        })?;
        ensure!(
            !stopped && !is_interrupted(),
            "the sheet was not drawn: interrupted"
        );
        let images: Vec<Image> = images.into_iter().collect::<Result<_, _>>()?;
        let captions: Vec<String> = (0..images.len())
            .map(|i| self.layout.caption(plan, i, &results[i], width))
            .collect();
        let cells: Vec<Cell> = (images.iter().zip(&captions))
            .map(|(image, caption)| Cell { image, caption })
            .collect();
        let budget = self.args.many.budget;
        let mut image = sheet_with_heads(&cells, self.layout.heads(), &self.style(), budget)?;
        if let Some(legend) = extent.legend() {
            image = with_legend(&image, &legend, self.style().background)?;
        }
        Ok(Drawn {
            image,
            errors,
            notes,
        })
    }

    /// The image of a cell, and what it does not show.
    fn image(
        &self,
        cells: &Cells,
        i: usize,
        result: &CellResult,
        extent: &Extent,
    ) -> Result<(Image, Vec<String>), String> {
        let Some(seen) = &result.seen else {
            return Err(result.error.clone().unwrap_or_else(|| "not run".to_owned()));
        };
        seen.extent.as_ref().map_err(String::clone)?;
        let again;
        let scene = if let Some(scene) = &seen.scene {
            scene
        } else {
            again = cells.scene(i)?;
            &again
        };
        let drawn = self
            .picture
            .draw(&[(scene, "")], Some(extent), &mut self.context());
        let (mut images, notes) = drawn.map_err(|error| error.to_string())?;
        Ok((images.remove(0), notes))
    }

    /// The path of the sheet.
    pub(super) fn path(&self) -> &'a Path {
        self.args.sheet.as_deref().unwrap_or(Path::new("sheet.png"))
    }
}

/// The sheet with a legend to its right.
fn with_legend(sheet: &Image, legend: &Legend, background: Color) -> Result<Image, PictureError> {
    /// What the corner keeps free beside the legend, in pixels.
    const FREE: f64 = 20.0;
    let figure = legend_figure(legend);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a legend is no larger than its words"
    )]
    let [width, height] = [figure.width, figure.height].map(|side| (side + FREE).ceil() as u32);
    let mut wide = Image::filled(
        sheet.width.saturating_add(width),
        sheet.height.max(height),
        background,
    )?;
    let rows = wide.pixels.chunks_exact_mut((sheet.width + width) as usize);
    for (to, from) in rows.zip(sheet.pixels.chunks_exact(sheet.width as usize)) {
        to[..from.len()].copy_from_slice(from);
    }
    draw_legend(&mut wide, legend, 1.0);
    Ok(wide)
}

/// How much of the budget scenes may take that wait to be drawn; runs get the rest.
pub(super) fn kept_bytes(budget: u64) -> u64 {
    budget / 4
}

/// Where cells stand on a sheet, in their order from left to right and from top to bottom.
struct Layout {
    columns: usize,
    /// The values that rows and columns share, if those are all that change; else none.
    heads: [Vec<String>; 2],
}

/// A row is not broken up to here.
const LONG_ROW: usize = 6;

impl Layout {
    fn of(plan: &Plan, columns: Option<u32>) -> Self {
        let grid = &plan.grid;
        let n = grid.cells.len();
        let changing: Vec<&Axis> = grid.axes.iter().filter(|axis| axis.len > 1).collect();
        let mut heads = <[Vec<String>; 2]>::default();
        let columns = match (columns, &changing[..]) {
            (Some(columns), _) => columns as usize,
            (None, [rows, columns]) => {
                // The last one changes first.
                let row = |i: usize| values(plan, rows, i * columns.len).join(", ");
                let column = |i: usize| values(plan, columns, i).join(", ");
                heads[0].extend((0..rows.len).map(row));
                heads[1].extend((0..columns.len).map(column));
                columns.len
            }
            (None, [.., last]) if changing.len() > 2 && last.len <= 2 * LONG_ROW => last.len,
            _ => {
                // As square as a long list can be, in rows of one length.
                let widest = LONG_ROW.max(n.isqrt());
                n.div_ceil(n.div_ceil(widest).max(1))
            }
        };
        Self { columns, heads }
    }

    fn heads(&self) -> Heads<'_> {
        let [rows, columns] = &self.heads;
        Heads { columns, rows }
    }

    /// What stands below a cell: its values, unless they are heads, and what is kept of it, as much as fits. Times
    /// do not: they are others in each run.
    fn caption(&self, plan: &Plan, cell: usize, result: &CellResult, width: u32) -> String {
        let style = SheetStyle::default();
        let (size, room) = (f64::from(style.letters), f64::from(width + style.gap / 2));
        let fill = |parts: &[String], most: usize| {
            let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
            let mut lines = filled(&parts, ", ", Font::Plain, size, room);
            lines.truncate(most);
            lines
        };
        let mut lines = Vec::new();
        if self.heads[0].is_empty() {
            let changing = plan.grid.axes.iter().filter(|axis| axis.len > 1);
            let parts: Vec<String> = changing.flat_map(|a| values(plan, a, cell)).collect();
            lines = fill(&parts, LINES[0]);
        }
        let Some(measures) = &result.measures else {
            return lines.join("\n");
        };
        let names = plan.names();
        let kept = plan.sweep.keep.iter().zip(&names).zip(measures);
        let parts: Vec<String> = kept
            .filter(|(((metric, _), _), _)| !matches!(metric, Metric::Seconds))
            .map(|((_, name), measured)| format!("{name} {}", short(&measured.to_string())))
            .collect();
        // What is too long for a line says nothing when it is shortened.
        let fits = |part: &&String| fill(&[(*part).clone()], 1) == [(*part).clone()];
        let parts: Vec<String> = parts.iter().filter(fits).cloned().collect();
        lines.extend(fill(&parts, LINES[1]));
        lines.join("\n")
    }
}

/// The values of parameters in a cell, as in `size = 0.5`.
fn values(plan: &Plan, axis: &Axis, cell: usize) -> Vec<String> {
    let grid = &plan.grid;
    let settings = &grid.cells[cell][axis.parameters.clone()];
    let names = &grid.parameters[axis.parameters.clone()];
    let value = |(name, setting)| format!("{name} = {}", short(&super::plain(setting)));
    names.iter().zip(settings).map(value).collect()
}
