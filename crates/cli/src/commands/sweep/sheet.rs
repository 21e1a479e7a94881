//! The sheet of a sweep: one image with the final scenes of all runs.
//!
//! ```text
//!   cell by cell: scene --> extent (small) ---join---> extent of all
//!                   |                                       |
//!                   +-- kept if memory allows, -------------+--> image --> sheet
//!                       else computed again
//! ```

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::ensure;
use op::{Context, Files};
use ops_pictures::Picture;
use recipe::{Axis, Metric};
use render::figure::label::wrapped;
use render::figure::legend::{Corner, Legend, draw_legend, legend_figure};
use render::figure::{Color, Font};
use render::{Image, PictureError};
use scene::Scene;
use view::Extent;
use view::sheet::{Cell, Headings, SheetStyle, notice, sheet_size, sheet_with_headings};

use super::cell::{CellResult, CellScene, Cells};
use super::{Plan, short};
use crate::args::{SweepArgs, WrongUsage};
use crate::commands::picture::{SHEET_CELL, check_names, parameters};
use crate::listener::{INTERRUPT, is_interrupted};
use crate::many::{error_message, run_in_order};

/// Maximum numbers of lines below each scene on the sheet: first for the parameter values, then for the measured values
/// that `keep` lists.
const MAX_LINES: [usize; 2] = [2, 3];

/// The color of errors.
const RED: Color = [0xb9, 0x1c, 0x1c, 255];

/// The options and layout of the sheet, and the memory used for scenes.
pub(super) struct Sheet<'a> {
    args: &'a SweepArgs,
    picture: Picture,
    files: Files,
    layout: Layout,
    /// The memory, in bytes, of the scenes that are kept until they are drawn. This is an upper estimate: each scene
    /// counts as the estimated peak memory of the run that made it.
    kept: AtomicU64,
}

/// The finished sheet.
pub(super) struct DrawnSheet {
    pub(super) image: Image,
    /// The successful runs whose scenes cannot be drawn: the index of each run, and the reason.
    pub(super) errors: Vec<(usize, String)>,
    /// Notes that say which parts of the scenes are missing from the images.
    pub(super) notes: BTreeSet<String>,
}

impl<'a> Sheet<'a> {
    /// Checks the options of the sheet. Returns `None` without `--sheet`.
    pub(super) fn new(args: &'a SweepArgs, plan: &Plan) -> anyhow::Result<Option<Self>> {
        let Some(path) = &args.sheet else {
            return Ok(None);
        };
        let ending = path.extension().unwrap_or_default();
        if !ending.eq_ignore_ascii_case("png") {
            let message = format!(
                "{}: expected an image with the extension .png",
                path.display()
            );
            return Err(WrongUsage(message).into());
        }
        let picture = parameters(&args.draw, path, SHEET_CELL, Vec::new())?;
        if picture.turntable.is_some() {
            return Err(WrongUsage("a sheet cannot have a turntable".to_owned()).into());
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

    /// Returns the size, in pixels, of each scene on the sheet.
    fn cell_size(&self) -> [u32; 2] {
        let views = self.picture.views.len().max(1);
        let columns = self.picture.columns.map_or(4, |n| n.get() as usize);
        let columns = columns.min(views);
        let times = |side: u32, n: usize| side.saturating_mul(u32::try_from(n).unwrap_or(u32::MAX));
        let [width, height] = self.picture.size.map(op::Count::get);
        [
            times(width, columns),
            times(height, views.div_ceil(columns)),
        ]
    }

    fn style(&self) -> SheetStyle {
        SheetStyle {
            columns: self.layout.columns,
            background: self.picture.style.background.srgb(),
            ..SheetStyle::default()
        }
    }

    /// Checks that the sheet fits into the memory budget with the longest possible captions.
    fn check_size(&self, n: usize) -> anyhow::Result<()> {
        let [width, height] = self.cell_size();
        let image = Image {
            width,
            height,
            pixels: Vec::new(),
        };
        let caption = "\n".repeat(MAX_LINES.iter().sum());
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

    /// Measures the extent of the final scene of a run, and keeps the scene if the memory budget for scenes is large
    /// enough. `bytes` is the estimated peak memory of the run.
    pub(super) fn collect(&self, scene: Scene, bytes: u64) -> CellScene {
        let check = check_names(&self.args.draw.on, &[&scene]);
        let extent = check.map_err(|e| e.to_string()).and_then(|()| {
            let extent = self.picture.extent(&scene, &mut self.context());
            extent.map_err(|error| error.to_string())
        });
        let max = kept_bytes(self.args.many.budget);
        let keep = |kept: u64| kept.checked_add(bytes).filter(|sum| *sum <= max);
        let order = Ordering::Relaxed;
        let is_kept = extent.is_ok() && self.kept.fetch_update(order, order, keep).is_ok();
        CellScene {
            extent,
            scene: is_kept.then_some(scene),
            bytes,
        }
    }

    fn context(&self) -> Context<'_> {
        let mut cx = Context::new(&INTERRUPT, &self.files);
        cx.budget = self.args.many.budget;
        let on = &self.args.draw.on;
        cx.on = (!on.is_empty()).then_some(on);
        cx
    }

    /// Draws the final scenes of all successful runs.
    pub(super) fn draw(
        &self,
        plan: &Plan,
        cells: &Cells,
        results: &[CellResult],
    ) -> anyhow::Result<DrawnSheet> {
        let extent_of = |result: &CellResult| result.scene.as_ref()?.extent.clone().ok();
        let mut extent = Extent::default();
        for one in results.iter().filter_map(extent_of) {
            extent.join(one);
        }
        let [width, height] = self.cell_size();
        let pixels = u64::from(width) * u64::from(height);
        let bytes = |i: usize| match &results[i].scene {
            Some(cell) if cell.scene.is_none() => cell.bytes.saturating_add(256 * pixels),
            Some(_) => 256 * pixels,
            None => 0,
        };
        let draw = |i: usize| self.image(cells, i, &results[i], &extent);
        let (mut errors, mut notes, mut images) = (Vec::new(), BTreeSet::new(), Vec::new());
        let mut stopped = false;
        let style = SheetStyle {
            text_color: RED,
            ..self.style()
        };
        let limits = self.args.many.limits();
        run_in_order(results.len(), limits, bytes, draw, |i, end| {
            let drawn = end.unwrap_or_else(|panicked| {
                stopped |= panicked.is_none();
                Err(error_message(panicked))
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
        let mut image = sheet_with_headings(&cells, self.layout.heads(), &self.style(), budget)?;
        if let Some(legend) = extent.legend() {
            image = with_legend(&image, &legend, self.style().background)?;
        }
        Ok(DrawnSheet {
            image,
            errors,
            notes,
        })
    }

    /// Draws the final scene of one run. Returns the image, and notes that say which parts of the scene are missing
    /// from the image.
    fn image(
        &self,
        cells: &Cells,
        i: usize,
        result: &CellResult,
        extent: &Extent,
    ) -> Result<(Image, Vec<String>), String> {
        let Some(cell) = &result.scene else {
            return Err(result.error.clone().unwrap_or_else(|| "not run".to_owned()));
        };
        cell.extent.as_ref().map_err(String::clone)?;
        let recomputed;
        let scene = if let Some(scene) = &cell.scene {
            scene
        } else {
            recomputed = cells.scene(i)?;
            &recomputed
        };
        let drawn = self
            .picture
            .draw(&[(scene, "")], Some(extent), &mut self.context());
        let (mut images, notes) = drawn.map_err(|error| error.to_string())?;
        Ok((images.remove(0), notes))
    }

    /// Returns the path of the sheet.
    pub(super) fn path(&self) -> &'a Path {
        self.args.sheet.as_deref().unwrap_or(Path::new("sheet.png"))
    }
}

/// Adds a legend to the right of the sheet.
fn with_legend(sheet: &Image, legend: &Legend, background: Color) -> Result<Image, PictureError> {
    /// Margin beside the legend, in pixels.
    const MARGIN: f64 = 20.0;
    let figure = legend_figure(legend);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the width and the height of a legend are positive, and far below the maximum of the type"
    )]
    let [width, height] = [figure.width, figure.height].map(|side| (side + MARGIN).ceil() as u32);
    let mut wide = Image::filled(
        sheet.width.saturating_add(width),
        sheet.height.max(height),
        background,
    )?;
    let rows = wide.pixels.chunks_exact_mut((sheet.width + width) as usize);
    for (to, from) in rows.zip(sheet.pixels.chunks_exact(sheet.width as usize)) {
        to[..from.len()].copy_from_slice(from);
    }
    draw_legend(&mut wide, legend, Corner::UpperRight, 1.0);
    Ok(wide)
}

/// Returns the part of the memory budget that is reserved for scenes until they are drawn. The runs of the sweep use
/// the rest of the budget.
pub(super) fn kept_bytes(budget: u64) -> u64 {
    budget / 4
}

/// The places of the scenes on a sheet, in order from left to right and from top to bottom.
struct Layout {
    columns: usize,
    /// The labels of the rows and the columns of the sheet. The labels exist only if exactly two axes (varying
    /// parameters) of the sweep have several values, and `--columns` is not given. Otherwise, the lists are empty.
    heads: [Vec<String>; 2],
}

/// If the rows and columns of a sheet have no labels, up to this number of scenes are placed in a single row.
const MAX_SINGLE_ROW: usize = 6;

impl Layout {
    fn of(plan: &Plan, columns: Option<u32>) -> Self {
        let grid = &plan.grid;
        let n = grid.cells.len();
        let changing: Vec<&Axis> = grid.axes.iter().filter(|axis| axis.len > 1).collect();
        let mut heads = <[Vec<String>; 2]>::default();
        let columns = match (columns, &changing[..]) {
            (Some(columns), _) => columns as usize,
            (None, [rows, columns]) => {
                // In the list of runs, the values of the last axis (varying parameter) change fastest.
                let row = |i: usize| values(plan, rows, i * columns.len).join(", ");
                let column = |i: usize| values(plan, columns, i).join(", ");
                heads[0].extend((0..rows.len).map(row));
                heads[1].extend((0..columns.len).map(column));
                columns.len
            }
            (None, [.., last]) if changing.len() > 2 && last.len <= 2 * MAX_SINGLE_ROW => last.len,
            _ => {
                // A large number of scenes is arranged as a nearly square grid, with rows of equal length.
                let widest = MAX_SINGLE_ROW.max(n.isqrt());
                n.div_ceil(n.div_ceil(widest).max(1))
            }
        };
        Self { columns, heads }
    }

    fn heads(&self) -> Headings<'_> {
        let [rows, columns] = &self.heads;
        Headings { columns, rows }
    }

    /// Returns the text below a scene on the sheet. The text has the parameter values, unless the labels of the rows
    /// and columns show them. If there is space, the text also has the measured values that `keep` lists. Measured
    /// times are left out, because they differ from run to run.
    fn caption(&self, plan: &Plan, cell: usize, result: &CellResult, width: u32) -> String {
        let style = SheetStyle::default();
        let (size, room) = (f64::from(style.font_size), f64::from(width + style.gap / 2));
        let fill = |parts: &[String], max_lines: usize| {
            let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
            let mut lines = wrapped(&parts, ", ", Font::Plain, size, room);
            lines.truncate(max_lines);
            lines
        };
        let mut lines = Vec::new();
        if self.heads[0].is_empty() {
            let changing = plan.grid.axes.iter().filter(|axis| axis.len > 1);
            let parts: Vec<String> = changing.flat_map(|a| values(plan, a, cell)).collect();
            lines = fill(&parts, MAX_LINES[0]);
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
        // Values that are too long for a line are left out, not shortened.
        let fits = |part: &&String| fill(&[(*part).clone()], 1) == [(*part).clone()];
        let parts: Vec<String> = parts.iter().filter(fits).cloned().collect();
        lines.extend(fill(&parts, MAX_LINES[1]));
        lines.join("\n")
    }
}

/// Formats the values that the parameters of an axis have in one run, such as `size = 0.5`.
fn values(plan: &Plan, axis: &Axis, cell: usize) -> Vec<String> {
    let grid = &plan.grid;
    let settings = &grid.cells[cell][axis.parameters.clone()];
    let names = &grid.parameters[axis.parameters.clone()];
    let value = |(name, setting)| format!("{name} = {}", short(&super::plain(setting)));
    names.iter().zip(settings).map(value).collect()
}
