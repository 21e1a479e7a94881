//! Sheets: images side by side, with captions.
//!
//! ```text
//!   +-------+  +-------+  +-------+
//!   | cow   |  | bunny |  | teapot|
//!   +-------+  +-------+  +-------+
//!    cow.obj   bunny.obj  teapot.bez
//!   +-------+  +-------+
//!   ...
//! ```
//!
//! With [`Headings`], a sheet is a table: column headings are at the top, row headings at the left.

use glam::DVec2;
use render::figure::label::{Label, draw_labels, shortened, text_width, wrapped};
use render::figure::{Anchor, Color, Font, Text};
use render::{Image, PictureError, checked_size};

/// One image on a sheet, and its caption.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// The image.
    pub image: &'a Image,
    /// The text below the image, which can be empty or have several lines.
    pub caption: &'a str,
}

/// The headings of the rows and the columns of a sheet.
#[derive(Clone, Copy, Debug, Default)]
pub struct Headings<'a> {
    /// The headings above the columns. If empty, there are none.
    pub columns: &'a [String],
    /// The headings to the left of the rows. If empty, there are none.
    pub rows: &'a [String],
}

/// The layout and the colors of a sheet.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct SheetStyle {
    /// The number of images in a row, at least 1.
    pub columns: usize,
    /// The gap between images, and the margin around the sheet, in pixels.
    pub gap: u32,
    /// The color between images and behind transparent images.
    pub background: Color,
    /// The color of captions and headings.
    pub text_color: Color,
    /// The font size of captions and headings, in pixels.
    pub font_size: u32,
}

impl Default for SheetStyle {
    fn default() -> Self {
        Self {
            columns: 4,
            gap: 12,
            background: [255; 4],
            text_color: [0x1f, 0x29, 0x37, 255],
            font_size: 14,
        }
    }
}

impl SheetStyle {
    /// Returns the style for images of this size. If the shorter side of an image is longer than 560 pixels, captions
    /// and gaps grow with this side. Captions therefore stay readable when a sheet of large images is scaled down.
    #[must_use]
    pub fn scaled_to(self, [width, height]: [u32; 2]) -> Self {
        let side = width.min(height);
        Self {
            gap: self.gap.max(side * 3 / 140),
            font_size: self.font_size.max(side / 40),
            ..self
        }
    }
}

/// The positions and sizes of the parts of a sheet, in pixels.
struct Layout {
    columns: usize,
    /// The height of column headings; 0 if there are none.
    heading_height: u64,
    /// The width of row headings; 0 if there are none.
    heading_width: u64,
    /// The width of every column.
    width: u64,
    /// The height of the images of each row, without captions.
    rows: Vec<u64>,
    /// The height of captions; 0 if no image has one.
    caption: u64,
    size: [u64; 2],
}

impl Layout {
    fn new(cells: &[Cell], headings: Headings, style: &SheetStyle) -> Self {
        let columns = style.columns.clamp(1, cells.len().max(1));
        let (gap, font_size) = (u64::from(style.gap), u64::from(style.font_size));
        let lines = |cell: &Cell| cell.caption.lines().count() as u64;
        let caption = match cells.iter().map(lines).max() {
            None | Some(0) => 0,
            Some(lines) => (3 * lines + 1) * font_size / 2,
        };
        let width = cells.iter().map(|c| u64::from(c.image.width)).max();
        let width = width.unwrap_or(0);
        let height = |row: &[Cell]| row.iter().map(|c| u64::from(c.image.height)).max();
        let rows = cells.chunks(columns).filter_map(height);
        let rows: Vec<u64> = rows.collect();
        let heading_height = u64::from(!headings.columns.is_empty()) * 2 * font_size;
        let widths = headings.rows.iter().map(|heading| {
            let size = f64::from(style.font_size);
            let text = Text::new(Font::Plain, &**heading, size, style.text_color);
            text_width(&text).min(width as f64)
        });
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the number is at most the width of an image"
        )]
        let heading_width = match headings.rows {
            [] => 0,
            _ => gap + widths.fold(0.0, f64::max).ceil() as u64,
        };
        let rows_height: u64 = rows.iter().map(|height| height + caption + gap).sum();
        Self {
            columns,
            heading_height,
            heading_width,
            width,
            rows,
            caption,
            size: [
                heading_width + columns as u64 * (width + gap) + gap,
                heading_height + rows_height + gap,
            ],
        }
    }
}

/// Returns the width and the height of a sheet in pixels.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side is longer than [`LARGEST_SIDE`](render::LARGEST_SIDE). Also returns this
/// error if the sheet has no pixels: it has no images, and its gap is 0.
pub fn sheet_size(
    cells: &[Cell],
    headings: Headings,
    style: &SheetStyle,
) -> Result<(u32, u32), PictureError> {
    let size = Layout::new(cells, headings, style).size;
    let [width, height] = size.map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    checked_size(width, height)?;
    Ok((width, height))
}

/// Arranges images in rows from left to right, with captions below.
///
/// All columns are as wide as the widest image. Images are centered in their cells. If a line of a caption is too long,
/// "…" replaces its middle.
///
/// # Errors
///
/// Returns [`PictureError::Size`] under the same conditions as [`sheet_size`]. Returns [`PictureError::Budget`] if the
/// sheet needs more than `budget` bytes. The sizes are checked before memory is allocated.
pub fn sheet(cells: &[Cell], style: &SheetStyle, budget: u64) -> Result<Image, PictureError> {
    sheet_with_headings(cells, Headings::default(), style, budget)
}

/// Arranges images like [`sheet`], with headings of rows and columns. If a heading is too long, "…" replaces its
/// middle.
///
/// # Errors
///
/// Returns the errors of [`sheet`].
pub fn sheet_with_headings(
    cells: &[Cell],
    headings: Headings,
    style: &SheetStyle,
    budget: u64,
) -> Result<Image, PictureError> {
    let (width, height) = sheet_size(cells, headings, style)?;
    let needed = u64::from(width) * u64::from(height) * 4;
    if needed > budget {
        return Err(PictureError::Budget { needed, budget });
    }
    let mut sheet = Image::filled(width, height, style.background)?;
    let layout = Layout::new(cells, headings, style);
    let gap = u64::from(style.gap);
    let font_size = f64::from(style.font_size);
    let mut labels = Vec::new();
    // The x coordinate of the middle of column `i`.
    let middle = |i: usize| {
        let left = layout.heading_width + gap + i as u64 * (layout.width + gap);
        left as f64 + layout.width as f64 / 2.0
    };
    let max_width = (layout.width + gap / 2) as f64;
    for (i, heading) in (headings.columns.iter().take(layout.columns)).enumerate() {
        let position = DVec2::new(middle(i), gap as f64 + font_size);
        labels.extend(label(heading, style, position, max_width));
    }
    let mut top = layout.heading_height + gap;
    for (row, (cells, &row_height)) in cells.chunks(layout.columns).zip(&layout.rows).enumerate() {
        if let Some(heading) = headings.rows.get(row) {
            let width = layout.heading_width as f64;
            let position = DVec2::new(width / 2.0, top as f64 + row_height as f64 / 2.0);
            let position = position + 0.5 * gap as f64 * DVec2::X;
            labels.extend(label(heading, style, position, width));
        }
        let mut left = layout.heading_width + gap;
        for (i, cell) in cells.iter().enumerate() {
            let x = left + (layout.width - u64::from(cell.image.width)) / 2;
            let y = top + (row_height - u64::from(cell.image.height)) / 2;
            sheet.place(cell.image, [x, y]);
            for (k, line) in cell.caption.lines().enumerate() {
                let line_y = (top + row_height) as f64 + font_size * (1.0 + 1.5 * k as f64);
                let position = DVec2::new(middle(i), line_y);
                labels.extend(label(line, style, position, max_width));
            }
            left += layout.width + gap;
        }
        top += row_height + layout.caption + gap;
    }
    draw_labels(&mut sheet, &labels);
    Ok(sheet)
}

/// Returns a centered label of at most this width, or `None` if the label is empty.
fn label(text: &str, style: &SheetStyle, position: DVec2, max_width: f64) -> Option<Label> {
    let size = f64::from(style.font_size);
    let text = shortened(text, Font::Plain, size, max_width);
    let text = Text::new(Font::Plain, text, size, style.text_color).anchored(Anchor::Middle);
    (!text.runs[0].text.is_empty()).then_some(Label { position, text })
}

/// Returns a placeholder of this size for a missing image. The placeholder shows a centered text with the reason.
///
/// # Errors
///
/// Returns [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`](render::LARGEST_SIDE).
pub fn notice(
    reason: &str,
    [width, height]: [u32; 2],
    style: &SheetStyle,
) -> Result<Image, PictureError> {
    let mut image = Image::filled(width, height, style.background)?;
    let (size, max_width) = (f64::from(style.font_size), f64::from(width) * 0.9);
    let words: Vec<&str> = reason.split_whitespace().collect();
    let mut lines = wrapped(&words, " ", Font::Plain, size, max_width);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number is at most the height of an image"
    )]
    let max_lines = (f64::from(height) / (1.5 * size)).max(1.0) as usize;
    if lines.len() > max_lines {
        lines.truncate(max_lines);
        if let Some(last) = lines.last_mut() {
            last.push('…');
        }
    }
    let top = 0.5 * f64::from(height) - 0.75 * size * (lines.len().saturating_sub(1)) as f64;
    let labels: Vec<Label> = (lines.iter().enumerate())
        .filter_map(|(k, line)| {
            let position = DVec2::new(0.5 * f64::from(width), top + 1.5 * size * k as f64);
            label(line, style, position, f64::from(width))
        })
        .collect();
    draw_labels(&mut image, &labels);
    Ok(image)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(width: u32, height: u32, color: Color) -> Image {
        Image::filled(width, height, color).unwrap()
    }

    fn at(image: &Image, x: u32, y: u32) -> Color {
        image.pixels[(y * image.width + x) as usize]
    }

    /// If the environment variable `MESHWRIGHT_UPDATE` is set, the test first writes the golden file, then compares the
    /// sheet with it.
    #[test]
    fn a_sheet_is_the_same_on_every_machine() {
        let image = |width, height| plain(width, height, [60, 120, 180, 128]);
        let images = [image(60, 40), image(30, 50), image(60, 20)];
        let captions = ["cow.obj", "a_long_name.obj", ""];
        let cells: Vec<Cell> = images
            .iter()
            .zip(captions)
            .map(|(image, caption)| Cell { image, caption })
            .collect();
        let style = SheetStyle {
            columns: 2,
            font_size: 11,
            ..SheetStyle::default()
        };
        let sheet = sheet(&cells, &style, 1 << 20).unwrap();
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/goldens/sheet.png");
        if std::env::var_os("MESHWRIGHT_UPDATE").is_some() {
            std::fs::write(path, sheet.to_png(&[]).unwrap()).unwrap();
        }
        let golden = Image::from_png(&std::fs::read(path).unwrap()).unwrap();
        assert!(sheet == golden);
    }

    #[test]
    fn captions_grow_with_large_images() {
        let style = SheetStyle::default();
        assert_eq!(style.scaled_to([400, 560]), style);
        let large = style.scaled_to([3000, 2000]);
        assert_eq!((large.font_size, large.gap), (50, 42));
    }

    const RED: Color = [200, 0, 0, 255];
    const WHITE: Color = [255; 4];

    #[test]
    fn images_are_centered_in_their_cells() {
        let (large, small) = (plain(20, 10, RED), plain(4, 6, [0, 0, 200, 255]));
        let cell = |image| Cell { image, caption: "" };
        let cells = [cell(&large), cell(&small), cell(&small)];
        let style = SheetStyle {
            columns: 2,
            gap: 3,
            ..SheetStyle::default()
        };
        let image = sheet(&cells, &style, u64::MAX).unwrap();
        assert_eq!(
            (image.width, image.height),
            (3 + 20 + 3 + 20 + 3, 3 + 10 + 3 + 6 + 3)
        );
        let count = |color| image.pixels.iter().filter(|&&p| p == color).count();
        assert_eq!(count(RED), 200);
        assert_eq!(count([0, 0, 200, 255]), 2 * 24);
        assert_eq!(count(WHITE), image.pixels.len() - 248);
        assert_eq!(at(&image, 3, 3), RED);
        // The second cell has 20 x 10 pixels, and its top left corner is at (26, 3).
        assert_eq!(at(&image, 26 + 8, 3 + 2), [0, 0, 200, 255]);
        assert_eq!(at(&image, 26 + 7, 3 + 2), WHITE);
    }

    #[test]
    fn transparent_images_are_composited_over_the_background() {
        let glass = plain(2, 2, [0, 0, 0, 128]);
        let cells = [Cell {
            image: &glass,
            caption: "",
        }];
        let pixel = |background| {
            let style = SheetStyle {
                background,
                ..SheetStyle::default()
            };
            at(&sheet(&cells, &style, u64::MAX).unwrap(), 12, 12)
        };
        assert_eq!(pixel(WHITE), [127, 127, 127, 255]);
        assert_eq!(pixel([0; 4]), [0, 0, 0, 128]);
    }

    #[test]
    fn captions_are_below_their_images_and_inside_their_columns() {
        let image = plain(90, 20, RED);
        for text in render::figure::testing::ODD_TEXTS
            .iter()
            .copied()
            .chain(["a_long_name_".repeat(50).as_str()])
        {
            let cells = [
                Cell {
                    image: &image,
                    caption: "",
                },
                Cell {
                    image: &image,
                    caption: text,
                },
            ];
            let image = sheet(&cells, &SheetStyle::default(), u64::MAX).unwrap();
            let is_text = |x, y| ![RED, WHITE].contains(&at(&image, x, y));
            for y in 0..image.height {
                assert!((0..105).all(|x| !is_text(x, y)), "{text:?}");
            }
            // A text with stacked accents can reach into the image above it.
            let is_plain = text.is_ascii();
            assert!(!is_plain || (0..image.width).all(|x| (0..33).all(|y| !is_text(x, y))));
        }
    }

    #[test]
    fn too_large_sheets_are_refused_before_memory_is_allocated() {
        let image = plain(1, 1, RED);
        let cells = vec![
            Cell {
                image: &image,
                caption: "a"
            };
            5000
        ];
        let style = |columns, gap| SheetStyle {
            columns,
            gap,
            ..SheetStyle::default()
        };
        for (columns, gap) in [(5000, 12), (1, 12), (0, 12), (usize::MAX, u32::MAX)] {
            let refused = sheet(&cells, &style(columns, gap), u64::MAX);
            assert!(matches!(refused, Err(PictureError::Size { .. })));
        }
        let refused = sheet(&cells[..4], &style(2, 4), 100);
        assert!(matches!(
            refused,
            Err(PictureError::Budget { budget: 100, .. })
        ));
        let heading = ["x".repeat(100)];
        let headings = Headings {
            rows: &heading,
            columns: &heading,
        };
        assert!(sheet_with_headings(&cells, headings, &style(1, 12), u64::MAX).is_err());
        assert!(sheet(&[], &style(2, 4), u64::MAX).is_ok());
        assert!(sheet(&[], &style(2, 0), u64::MAX).is_err());
    }

    #[test]
    fn headings_are_above_columns_and_to_the_left_of_rows() {
        let image = plain(60, 40, RED);
        let cells = [Cell {
            image: &image,
            caption: "",
        }; 4];
        let style = SheetStyle {
            columns: 2,
            ..SheetStyle::default()
        };
        let headings = ["a = 1", "b = 2"].map(str::to_owned);
        let without = sheet(&cells, &style, u64::MAX).unwrap();
        let headings = Headings {
            columns: &headings,
            rows: &headings,
        };
        let with = sheet_with_headings(&cells, headings, &style, u64::MAX).unwrap();
        let (dx, dy) = (with.width - without.width, with.height - without.height);
        assert_eq!(dy, 2 * style.font_size);
        assert!((20..70).contains(&dx), "{dx}");
        // A sheet with headings contains the same images as a sheet without headings, but moved to the right and down.
        // Column headings are above the images, and row headings are to the left of the images.
        let is_text = |x, y| ![RED, WHITE].contains(&at(&with, x, y));
        for y in style.gap..without.height {
            for x in style.gap..without.width {
                assert_eq!(at(&with, x + dx, y + dy), at(&without, x, y));
            }
        }
        let has_text = |xs: std::ops::Range<u32>, ys: std::ops::Range<u32>| {
            xs.clone().any(|x| ys.clone().any(|y| is_text(x, y)))
        };
        let (second_column, second_row) = (dx + 12 + 60, dy + 12 + 40);
        assert!(has_text(dx..second_column, 0..dy + 12));
        assert!(has_text(second_column..with.width, 0..dy + 12));
        assert!(has_text(0..dx + 12, dy..second_row));
        assert!(has_text(0..dx + 12, second_row..with.height));
        assert!(!has_text(0..dx, 0..dy));
    }

    #[test]
    fn each_line_of_a_caption_adds_to_the_height() {
        let image = plain(60, 20, RED);
        let height = |caption| {
            let cells = [Cell {
                image: &image,
                caption,
            }];
            let style = SheetStyle::default();
            sheet(&cells, &style, u64::MAX).unwrap().height
        };
        assert_eq!(height("a") - height(""), 28);
        assert_eq!(height("a\nb") - height("a"), 21);
    }

    #[test]
    fn a_notice_has_wrapped_lines_inside_of_the_image() {
        let style = SheetStyle::default();
        let image = notice("the mesh has a hole in it", [80, 60], &style).unwrap();
        assert_eq!((image.width, image.height), (80, 60));
        let has_text = |y: u32| (0..80).any(|x| at(&image, x, y) != WHITE);
        let rows: Vec<bool> = (0..60).map(has_text).collect();
        let n_lines = rows.windows(2).filter(|w| !w[0] && w[1]).count();
        assert!(n_lines >= 2 && !rows[0] && !rows[59], "{rows:?}");
        for reason in render::figure::testing::ODD_TEXTS.iter().copied().chain([
            "",
            &"long ".repeat(10_000),
            &"x".repeat(100_000),
        ]) {
            for size in [[1, 1], [30, 10], [40, 200]] {
                notice(reason, size, &style).unwrap();
            }
        }
        assert!(notice("a", [0, 1], &style).is_err());
    }
}
