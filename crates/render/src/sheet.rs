//! Images side by side, with captions.
//!
//! ```text
//!   +-------+  +-------+  +-------+
//!   | cow   |  | bunny |  | teapot|
//!   +-------+  +-------+  +-------+
//!    cow.obj   bunny.obj  teapot.bez
//!   +-------+  +-------+
//!   ...
//! ```

use glam::DVec2;

use crate::blend::over;
use crate::figure::label::{Label, draw_labels, shortened};
use crate::figure::{Anchor, Color, Font, Text};
use crate::image::checked_size;
use crate::{Image, PictureError};

/// An image of a sheet.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// The image.
    pub image: &'a Image,
    /// What stands below it; nothing if empty.
    pub caption: &'a str,
}

/// How a sheet looks.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct SheetStyle {
    /// How many images stand in a row, at least 1.
    pub columns: usize,
    /// Pixels between images, and around all of them.
    pub gap: u32,
    /// What is seen between the images, and through them.
    pub background: Color,
    /// The color of captions.
    pub ink: Color,
    /// The height of the letters of captions, in pixels.
    pub letters: u32,
}

impl Default for SheetStyle {
    fn default() -> Self {
        Self {
            columns: 4,
            gap: 12,
            background: [255; 4],
            ink: [0x1f, 0x29, 0x37, 255],
            letters: 14,
        }
    }
}

/// Where everything stands.
struct Places {
    columns: usize,
    /// The width of every column, and the height of each row, without captions.
    width: u64,
    rows: Vec<u64>,
    /// The height of captions; 0 if no image has one.
    caption: u64,
    /// The size of all.
    size: [u64; 2],
}

impl Places {
    fn of(cells: &[Cell], style: &SheetStyle) -> Self {
        let columns = style.columns.clamp(1, cells.len().max(1));
        let gap = u64::from(style.gap);
        let has_captions = cells.iter().any(|cell| !cell.caption.is_empty());
        let caption = if has_captions {
            u64::from(style.letters) * 2
        } else {
            0
        };
        let width = cells.iter().map(|c| u64::from(c.image.width)).max();
        let width = width.unwrap_or(0);
        let rows: Vec<u64> = cells
            .chunks(columns)
            .map(|row| {
                let heights = row.iter().map(|c| u64::from(c.image.height));
                heights.max().unwrap_or(0)
            })
            .collect();
        let all: u64 = rows.iter().map(|height| height + caption + gap).sum();
        Self {
            columns,
            width,
            rows,
            caption,
            size: [columns as u64 * (width + gap) + gap, all + gap],
        }
    }
}

/// The width and the height of a sheet in pixels.
///
/// # Errors
///
/// [`PictureError::Size`] if a side is longer than [`LARGEST_SIDE`](crate::LARGEST_SIDE), or there are no images
/// and no gap.
pub fn sheet_size(cells: &[Cell], style: &SheetStyle) -> Result<(u32, u32), PictureError> {
    let [width, height] = Places::of(cells, style)
        .size
        .map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    checked_size(width, height)?;
    Ok((width, height))
}

/// Puts images into rows of columns, from left to right, each in the middle of its place, with its caption below:
/// a caption that is too long loses its middle. All columns are as wide as the widest image.
///
/// # Errors
///
/// [`PictureError::Size`] as [`sheet_size`]; [`PictureError::Budget`] if the sheet takes more than `budget` bytes.
/// Both are found before memory is taken.
pub fn sheet(cells: &[Cell], style: &SheetStyle, budget: u64) -> Result<Image, PictureError> {
    let (width, height) = sheet_size(cells, style)?;
    let needed = u64::from(width) * u64::from(height) * 4;
    if needed > budget {
        return Err(PictureError::Budget { needed, budget });
    }
    let mut sheet = Image::filled(width, height, style.background)?;
    let places = Places::of(cells, style);
    let gap = u64::from(style.gap);
    let mut labels = Vec::new();
    let mut top = gap;
    for (row, &high) in cells.chunks(places.columns).zip(&places.rows) {
        let mut left = gap;
        for cell in row {
            let x = left + (places.width - u64::from(cell.image.width)) / 2;
            let y = top + (high - u64::from(cell.image.height)) / 2;
            place(&mut sheet, cell.image, [x, y]);
            if !cell.caption.is_empty() {
                let middle = left as f64 + places.width as f64 / 2.0;
                let line = (top + high) as f64 + places.caption as f64 / 2.0;
                let room = (places.width + gap / 2) as f64;
                labels.extend(caption(cell.caption, style, DVec2::new(middle, line), room));
            }
            left += places.width + gap;
        }
        top += high + places.caption + gap;
    }
    draw_labels(&mut sheet, &labels)?;
    Ok(sheet)
}

fn caption(text: &str, style: &SheetStyle, place: DVec2, room: f64) -> Option<Label> {
    let size = f64::from(style.letters);
    let text = shortened(text, Font::Plain, size, room);
    let text = Text::new(Font::Plain, text, size, style.ink).anchored(Anchor::Middle);
    (!text.runs[0].text.is_empty()).then_some(Label { place, text })
}

/// Lays an image over another one that has room for it at `corner`.
fn place(sheet: &mut Image, image: &Image, corner: [u64; 2]) {
    let [x, y] = corner.map(|c| usize::try_from(c).unwrap_or(usize::MAX));
    let width = sheet.width as usize;
    let rows = sheet.pixels.chunks_exact_mut(width).skip(y);
    for (to, from) in rows.zip(image.pixels.chunks_exact(image.width as usize)) {
        for (under, &color) in to[x..].iter_mut().zip(from) {
            *under = over(color, *under);
        }
    }
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

    const RED: Color = [200, 0, 0, 255];
    const WHITE: Color = [255; 4];

    #[test]
    fn every_image_stands_whole_in_its_place() {
        let (large, small) = (plain(20, 10, RED), plain(4, 6, [0, 0, 200, 255]));
        let cell = |image| Cell { image, caption: "" };
        let cells = [cell(&large), cell(&small), cell(&small)];
        let style = SheetStyle {
            columns: 2,
            gap: 3,
            ..SheetStyle::default()
        };
        let made = sheet(&cells, &style, u64::MAX).unwrap();
        assert_eq!(
            (made.width, made.height),
            (3 + 20 + 3 + 20 + 3, 3 + 10 + 3 + 6 + 3)
        );
        let count = |color| made.pixels.iter().filter(|&&p| p == color).count();
        assert_eq!(count(RED), 200);
        assert_eq!(count([0, 0, 200, 255]), 2 * 24);
        assert_eq!(count(WHITE), made.pixels.len() - 248);
        assert_eq!(at(&made, 3, 3), RED);
        // In the middle of 20 x 10 pixels at (26, 3).
        assert_eq!(at(&made, 26 + 8, 3 + 2), [0, 0, 200, 255]);
        assert_eq!(at(&made, 26 + 7, 3 + 2), WHITE);
    }

    #[test]
    fn the_background_is_seen_through_images() {
        let glass = plain(2, 2, [0, 0, 0, 128]);
        let cells = [Cell {
            image: &glass,
            caption: "",
        }];
        let made = |background| {
            let style = SheetStyle {
                background,
                ..SheetStyle::default()
            };
            at(&sheet(&cells, &style, u64::MAX).unwrap(), 12, 12)
        };
        assert_eq!(made(WHITE), [127, 127, 127, 255]);
        assert_eq!(made([0; 4]), [0, 0, 0, 128]);
    }

    #[test]
    fn captions_stand_below_and_stay_in_their_columns() {
        let image = plain(90, 20, RED);
        for text in crate::figure::ODD_TEXTS
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
            let made = sheet(&cells, &SheetStyle::default(), u64::MAX).unwrap();
            let is_ink = |x, y| ![RED, WHITE].contains(&at(&made, x, y));
            for y in 0..made.height {
                assert!((0..105).all(|x| !is_ink(x, y)), "{text:?}");
            }
            // Accents in a pile may reach the image.
            let is_plain = text.is_ascii();
            assert!(!is_plain || (0..made.width).all(|x| (0..33).all(|y| !is_ink(x, y))));
        }
    }

    #[test]
    fn sheets_that_are_too_large_are_refused_before_memory_is_taken() {
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
        assert!(sheet(&[], &style(2, 4), u64::MAX).is_ok());
        assert!(sheet(&[], &style(2, 0), u64::MAX).is_err());
    }
}
