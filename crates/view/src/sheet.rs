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
//!
//! Or as a table with [`Heads`]: of its columns above, of its rows to the left.

use glam::DVec2;
use render::figure::label::{Label, draw_labels, filled, shortened, text_width};
use render::figure::{Anchor, Color, Font, Text};
use render::{Image, PictureError, checked_size};

/// An image of a sheet.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// The image.
    pub image: &'a Image,
    /// What stands below it, line by line; nothing if empty.
    pub caption: &'a str,
}

/// What stands beside the rows and the columns of a sheet.
#[derive(Clone, Copy, Debug, Default)]
pub struct Heads<'a> {
    /// Above each column; none if empty.
    pub columns: &'a [String],
    /// To the left of each row; none if empty.
    pub rows: &'a [String],
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
    /// The height of the heads of columns, and the width of those of rows; 0 if there are none.
    above: u64,
    beside: u64,
    /// The width of every column, and the height of each row, without captions.
    width: u64,
    rows: Vec<u64>,
    /// The height of captions; 0 if no image has one.
    caption: u64,
    /// The size of all.
    size: [u64; 2],
}

impl Places {
    fn of(cells: &[Cell], heads: Heads, style: &SheetStyle) -> Self {
        let columns = style.columns.clamp(1, cells.len().max(1));
        let (gap, letters) = (u64::from(style.gap), u64::from(style.letters));
        let lines = |cell: &Cell| cell.caption.lines().count() as u64;
        let caption = match cells.iter().map(lines).max() {
            None | Some(0) => 0,
            Some(lines) => (3 * lines + 1) * letters / 2,
        };
        let width = cells.iter().map(|c| u64::from(c.image.width)).max();
        let width = width.unwrap_or(0);
        let height = |row: &[Cell]| row.iter().map(|c| u64::from(c.image.height)).max();
        let rows = cells.chunks(columns).filter_map(height);
        let rows: Vec<u64> = rows.collect();
        let above = u64::from(!heads.columns.is_empty()) * 2 * letters;
        let widths = heads.rows.iter().map(|head| {
            let text = Text::new(Font::Plain, &**head, f64::from(style.letters), style.ink);
            text_width(&text).min(width as f64)
        });
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the width of an image"
        )]
        let beside = match heads.rows {
            [] => 0,
            _ => gap + widths.fold(0.0, f64::max).ceil() as u64,
        };
        let all: u64 = rows.iter().map(|height| height + caption + gap).sum();
        Self {
            columns,
            above,
            beside,
            width,
            rows,
            caption,
            size: [
                beside + columns as u64 * (width + gap) + gap,
                above + all + gap,
            ],
        }
    }
}

/// The width and the height of a sheet in pixels.
///
/// # Errors
///
/// [`PictureError::Size`] if a side is longer than [`LARGEST_SIDE`](render::LARGEST_SIDE), or there are no images
/// and no gap.
pub fn sheet_size(
    cells: &[Cell],
    heads: Heads,
    style: &SheetStyle,
) -> Result<(u32, u32), PictureError> {
    let size = Places::of(cells, heads, style).size;
    let [width, height] = size.map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    checked_size(width, height)?;
    Ok((width, height))
}

/// Puts images into rows of columns, from left to right, each in the middle of its place, with its caption below:
/// a line of it that is too long loses its middle. All columns are as wide as the widest image.
///
/// # Errors
///
/// [`PictureError::Size`] as [`sheet_size`]; [`PictureError::Budget`] if the sheet takes more than `budget` bytes.
/// Both are found before memory is taken.
pub fn sheet(cells: &[Cell], style: &SheetStyle, budget: u64) -> Result<Image, PictureError> {
    sheet_with_heads(cells, Heads::default(), style, budget)
}

/// The same with heads of rows and of columns, in the middle of what they stand beside: one that is too long loses
/// its middle.
///
/// # Errors
///
/// As [`sheet`].
pub fn sheet_with_heads(
    cells: &[Cell],
    heads: Heads,
    style: &SheetStyle,
    budget: u64,
) -> Result<Image, PictureError> {
    let (width, height) = sheet_size(cells, heads, style)?;
    let needed = u64::from(width) * u64::from(height) * 4;
    if needed > budget {
        return Err(PictureError::Budget { needed, budget });
    }
    let mut sheet = Image::filled(width, height, style.background)?;
    let places = Places::of(cells, heads, style);
    let gap = u64::from(style.gap);
    let letters = f64::from(style.letters);
    let mut labels = Vec::new();
    // The middle of the place of column `i`.
    let middle = |i: usize| {
        let left = places.beside + gap + i as u64 * (places.width + gap);
        left as f64 + places.width as f64 / 2.0
    };
    let room = (places.width + gap / 2) as f64;
    for (i, head) in heads.columns.iter().take(places.columns).enumerate() {
        let place = DVec2::new(middle(i), gap as f64 + letters);
        labels.extend(label(head, style, place, room));
    }
    let mut top = places.above + gap;
    for (row, (cells, &high)) in cells.chunks(places.columns).zip(&places.rows).enumerate() {
        if let Some(head) = heads.rows.get(row) {
            let place = DVec2::new(places.beside as f64 / 2.0, top as f64 + high as f64 / 2.0);
            let place = place + 0.5 * gap as f64 * DVec2::X;
            labels.extend(label(head, style, place, places.beside as f64));
        }
        let mut left = places.beside + gap;
        for (i, cell) in cells.iter().enumerate() {
            let x = left + (places.width - u64::from(cell.image.width)) / 2;
            let y = top + (high - u64::from(cell.image.height)) / 2;
            sheet.place(cell.image, [x, y]);
            for (k, line) in cell.caption.lines().enumerate() {
                let line_at = (top + high) as f64 + letters * (1.0 + 1.5 * k as f64);
                labels.extend(label(line, style, DVec2::new(middle(i), line_at), room));
            }
            left += places.width + gap;
        }
        top += high + places.caption + gap;
    }
    draw_labels(&mut sheet, &labels);
    Ok(sheet)
}

fn label(text: &str, style: &SheetStyle, place: DVec2, room: f64) -> Option<Label> {
    let size = f64::from(style.letters);
    let text = shortened(text, Font::Plain, size, room);
    let text = Text::new(Font::Plain, text, size, style.ink).anchored(Anchor::Middle);
    (!text.runs[0].text.is_empty()).then_some(Label { place, text })
}

/// An image of this size that is not there: nothing but why, in words, in its middle.
///
/// # Errors
///
/// [`PictureError::Size`] if a side is 0 or longer than [`LARGEST_SIDE`](render::LARGEST_SIDE).
pub fn notice(
    why: &str,
    [width, height]: [u32; 2],
    style: &SheetStyle,
) -> Result<Image, PictureError> {
    let mut image = Image::filled(width, height, style.background)?;
    let (size, room) = (f64::from(style.letters), f64::from(width) * 0.9);
    let words: Vec<&str> = why.split_whitespace().collect();
    let mut lines = filled(&words, " ", Font::Plain, size, room);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most as many as an image has pixels"
    )]
    let most = (f64::from(height) / (1.5 * size)).max(1.0) as usize;
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            last.push('…');
        }
    }
    let top = 0.5 * f64::from(height) - 0.75 * size * (lines.len().saturating_sub(1)) as f64;
    let labels: Vec<Label> = (lines.iter().enumerate())
        .filter_map(|(k, line)| {
            let place = DVec2::new(0.5 * f64::from(width), top + 1.5 * size * k as f64);
            label(line, style, place, f64::from(width))
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

    /// With `MESHWRIGHT_UPDATE` set in the environment, the file is written anew.
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
            letters: 11,
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
        let head = ["x".repeat(100)];
        let heads = Heads {
            rows: &head,
            columns: &head,
        };
        assert!(sheet_with_heads(&cells, heads, &style(1, 12), u64::MAX).is_err());
        assert!(sheet(&[], &style(2, 4), u64::MAX).is_ok());
        assert!(sheet(&[], &style(2, 0), u64::MAX).is_err());
    }

    #[test]
    fn heads_stand_above_columns_and_beside_rows() {
        let image = plain(60, 40, RED);
        let cells = [Cell {
            image: &image,
            caption: "",
        }; 4];
        let style = SheetStyle {
            columns: 2,
            ..SheetStyle::default()
        };
        let heads = ["a = 1", "b = 2"].map(str::to_owned);
        let bare = sheet(&cells, &style, u64::MAX).unwrap();
        let heads = Heads {
            columns: &heads,
            rows: &heads,
        };
        let made = sheet_with_heads(&cells, heads, &style, u64::MAX).unwrap();
        let (dx, dy) = (made.width - bare.width, made.height - bare.height);
        assert_eq!(dy, 2 * style.letters);
        assert!((20..70).contains(&dx), "{dx}");
        // The images are where they were, and ink is nowhere but beside them.
        let is_ink = |x, y| ![RED, WHITE].contains(&at(&made, x, y));
        for y in style.gap..bare.height {
            for x in style.gap..bare.width {
                assert_eq!(at(&made, x + dx, y + dy), at(&bare, x, y));
            }
        }
        let has_ink = |xs: std::ops::Range<u32>, ys: std::ops::Range<u32>| {
            xs.clone().any(|x| ys.clone().any(|y| is_ink(x, y)))
        };
        let (second_column, second_row) = (dx + 12 + 60, dy + 12 + 40);
        assert!(has_ink(dx..second_column, 0..dy + 12));
        assert!(has_ink(second_column..made.width, 0..dy + 12));
        assert!(has_ink(0..dx + 12, dy..second_row));
        assert!(has_ink(0..dx + 12, second_row..made.height));
        assert!(!has_ink(0..dx, 0..dy));
    }

    #[test]
    fn a_caption_of_several_lines_takes_their_height() {
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
    fn a_notice_says_why_within_its_place() {
        let style = SheetStyle::default();
        let made = notice("the mesh has a hole in it", [80, 60], &style).unwrap();
        assert_eq!((made.width, made.height), (80, 60));
        let ink = |y: u32| (0..80).filter(|&x| at(&made, x, y) != WHITE).count();
        // In several lines.
        let rows: Vec<bool> = (0..60).map(|y| ink(y) > 0).collect();
        let starts = rows.windows(2).filter(|w| !w[0] && w[1]).count();
        assert!(starts >= 2 && !rows[0] && !rows[59], "{rows:?}");
        for why in render::figure::testing::ODD_TEXTS.iter().copied().chain([
            "",
            &"long ".repeat(10_000),
            &"x".repeat(100_000),
        ]) {
            for size in [[1, 1], [30, 10], [40, 200]] {
                notice(why, size, &style).unwrap();
            }
        }
        assert!(notice("a", [0, 1], &style).is_err());
    }
}
