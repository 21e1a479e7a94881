//! Shows pictures in a terminal as pixels, as half-block characters or as letters. Of these three forms, the first one
//! that the terminal supports is used.
//!
//! Environment variables tell which of these forms the terminal supports. The program does not send a query to the
//! terminal. Not every terminal answers queries, and the program could mistake typed keys for the answer.
//!
//! - Kitty, "Terminal graphics protocol": a PNG file in chunks, in base64.
//! - iTerm2, "Inline images protocol": a PNG file, in base64.
//! - Sixel: DEC, "VT330/VT340 Programmer Reference Manual", volume 2, 1988, chapter 14: bands of six rows;
//!   each character encodes six pixels of one color, one above the other.

use std::io::{self, IsTerminal, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE_64;
use render::palette::Palette;
use render::{Image, PictureError};

/// The encoding of a picture for a terminal.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Protocol {
    /// Pixels, in the protocol of the terminal kitty.
    Kitty,
    /// Pixels, in the protocol of the terminal iTerm2.
    Iterm,
    /// Pixels in 256 colors, in the protocol of DEC terminals.
    Sixel,
    /// Half-block characters in 24-bit colors.
    Blocks,
    /// Half-block characters in the 256 colors of xterm.
    FewColorBlocks,
    /// Characters that are denser where the picture is darker.
    Letters,
}

/// Maximum width of a picture made of characters.
const MAX_WIDTH: u32 = 100;

/// Prints a picture to standard output, in the best encoding that the terminal supports. If standard output is a file
/// or a pipe, prints letters.
///
/// # Errors
///
/// Returns an error if writing fails.
pub(crate) fn show(image: &Image) -> io::Result<()> {
    let is_terminal = io::stdout().is_terminal();
    let protocol = Protocol::of(is_terminal, |name| std::env::var(name).ok());
    let (_, columns) = console::Term::stdout().size();
    let bytes = written(image, protocol, u32::from(columns)).map_err(io::Error::other)?;
    let mut out = io::stdout().lock();
    out.write_all(&bytes)?;
    out.flush()
}

impl Protocol {
    /// Chooses the best encoding for a terminal, given the environment variables of the program.
    pub(crate) fn of(is_terminal: bool, variable: impl Fn(&str) -> Option<String>) -> Self {
        let text = |name: &str| variable(name).unwrap_or_default();
        let is_set = |name: &str| !text(name).is_empty();
        let (term, program) = (text("TERM"), text("TERM_PROGRAM"));
        if !is_terminal || term == "dumb" || is_set("NO_COLOR") {
            return Self::Letters;
        }
        // Terminal multiplexers do not pass pixels on to the terminal.
        let is_multiplexed =
            is_set("TMUX") || term.starts_with("screen") || term.starts_with("tmux");
        let konsole: u32 = text("KONSOLE_VERSION").parse().unwrap_or(0);
        let iterm = ["iTerm.app", "WezTerm", "mintty"].contains(&program.as_str());
        let sixel = ["foot", "mlterm", "yaft"]
            .iter()
            .any(|t| term.starts_with(t));
        if is_multiplexed {
        } else if is_set("KITTY_WINDOW_ID") || term.contains("kitty") || term.contains("ghostty") {
            return Self::Kitty;
        } else if iterm || text("LC_TERMINAL") == "iTerm2" || konsole >= 220_400 {
            return Self::Iterm;
        } else if sixel || term.contains("sixel") {
            return Self::Sixel;
        }
        match text("COLORTERM").as_str() {
            "truecolor" | "24bit" => Self::Blocks,
            _ => Self::FewColorBlocks,
        }
    }
}

/// Encodes a picture for a terminal with the given number of columns.
///
/// # Errors
///
/// Returns [`PictureError::Encode`] if the image has no pixels.
pub(crate) fn written(
    image: &Image,
    protocol: Protocol,
    columns: u32,
) -> Result<Vec<u8>, PictureError> {
    match protocol {
        Protocol::Kitty => Ok(kitty(&image.to_png(&[])?)),
        Protocol::Iterm => {
            let png = image.to_png(&[])?;
            let (size, text) = (png.len(), BASE_64.encode(png));
            Ok(format!("\x1b]1337;File=inline=1;size={size}:{text}\x07\n").into_bytes())
        }
        Protocol::Sixel => Ok(sixel(image)),
        Protocol::Blocks => Ok(blocks(&reduced(image, columns), true)),
        Protocol::FewColorBlocks => Ok(blocks(&reduced(image, columns), false)),
        Protocol::Letters => Ok(letters(&reduced(image, columns))),
    }
}

/// Encodes a PNG file in chunks of at most 4096 characters. The parameter `q=2` tells the terminal not to answer.
fn kitty(png: &[u8]) -> Vec<u8> {
    let text = BASE_64.encode(png);
    let pieces: Vec<&[u8]> = text.as_bytes().chunks(4096).collect();
    let mut bytes = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        let first = if i == 0 { "a=T,f=100,q=2," } else { "" };
        let more = u8::from(i + 1 < pieces.len());
        bytes.extend_from_slice(format!("\x1b_G{first}m={more};").as_bytes());
        bytes.extend_from_slice(piece);
        bytes.extend_from_slice(b"\x1b\\");
    }
    bytes.push(b'\n');
    bytes
}

fn sixel(image: &Image) -> Vec<u8> {
    let mut palette = Palette::of(std::slice::from_ref(image));
    // With the parameter P2 = 1 of the Sixel protocol, pixels that the picture does not set keep their color.
    let mut text = format!("\x1bP0;1;0q\"1;1;{};{}", image.width, image.height);
    for (i, color) in palette.colors().iter().enumerate() {
        // The components of a Sixel color are in percent.
        let [r, g, b] = color.map(|c| (u32::from(c) * 100 + 127) / 255);
        text += &format!("#{i};2;{r};{g};{b}");
    }
    let width = image.width as usize;
    let indices: Vec<u8> = image.pixels.iter().map(|&p| palette.index(p)).collect();
    for band in indices.chunks(width * 6) {
        // Each color of the band is drawn in a separate pass over the same six rows.
        let mut is_used = [false; 256];
        for &index in band {
            is_used[usize::from(index)] = true;
        }
        let transparent = palette.transparent();
        let colors = (0..=255_u8).filter(|&c| is_used[usize::from(c)] && Some(c) != transparent);
        for color in colors {
            text += &format!("#{color}");
            let column = |x: usize| {
                let rows = band.chunks(width).enumerate();
                rows.fold(0_u8, |bits, (y, row)| bits | u8::from(row[x] == color) << y)
            };
            let columns: Vec<u8> = (0..width).map(column).collect();
            for run in columns.chunk_by(|p, q| p == q) {
                let character = char::from(b'?' + run[0]);
                match run.len() {
                    n @ 1..=3 => (0..n).for_each(|_| text.push(character)),
                    n => text += &format!("!{n}{character}"),
                }
            }
            text.push('$');
        }
        text.push('-');
    }
    (text + "\x1b\\\n").into_bytes()
}

/// Shrinks an image to at most the given number of columns. Each character shows two pixels of the shrunken image, one
/// above the other. Each pixel of the result is the mean of a rectangle of pixels.
fn reduced(image: &Image, columns: u32) -> Image {
    let width = columns.clamp(1, MAX_WIDTH).min(image.width.max(1));
    let height =
        (u64::from(image.height) * u64::from(width)).div_ceil(u64::from(image.width.max(1)));
    let height = u32::try_from(height).unwrap_or(u32::MAX).min(4 * MAX_WIDTH);
    let part = |i: u32, n: u32, side: u32| {
        let start = |i: u32| {
            let start = u64::from(i) * u64::from(side) / u64::from(n);
            usize::try_from(start).unwrap_or(usize::MAX)
        };
        start(i)..start(i + 1).max(start(i) + 1).min(side as usize)
    };
    let mean = |x: u32, y: u32| {
        let (mut sum, mut n) = ([0_u64; 4], 0);
        for row in part(y, height, image.height) {
            for column in part(x, width, image.width) {
                let [r, g, b, a] = image.pixels[row * image.width as usize + column];
                for (sum, c) in sum.iter_mut().zip([r, g, b]) {
                    *sum += u64::from(c) * u64::from(a);
                }
                sum[3] += u64::from(a);
                n += 1;
            }
        }
        let alpha = sum[3].max(1);
        let byte = |x: u64| u8::try_from(x).unwrap_or(u8::MAX);
        let [r, g, b] = [sum[0], sum[1], sum[2]].map(|c| byte((c + alpha / 2) / alpha));
        [r, g, b, byte(sum[3] / n.max(1))]
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Image {
        width,
        height,
        pixels: places.map(|(x, y)| mean(x, y)).collect(),
    }
}

/// Returns the rows of characters that show the image. Each character shows two pixels, one above the other. Pixels
/// with less than half opacity are `None`.
fn pairs(image: &Image) -> impl Iterator<Item = Vec<[Option<[u8; 3]>; 2]>> {
    let opaque = |[r, g, b, a]: [u8; 4]| (a >= 128).then_some([r, g, b]);
    let width = image.width as usize;
    image.pixels.chunks(2 * width).map(move |rows| {
        let below = |x: usize| rows.get(width + x).copied().and_then(opaque);
        (0..width).map(|x| [opaque(rows[x]), below(x)]).collect()
    })
}

fn blocks(image: &Image, is_true_color: bool) -> Vec<u8> {
    let color = |is_background: bool, color: Option<[u8; 3]>| {
        let code = if is_background { 48 } else { 38 };
        match color {
            None => format!("\x1b[{}m", code + 1),
            Some([r, g, b]) if is_true_color => format!("\x1b[{code};2;{r};{g};{b}m"),
            Some(color) => format!("\x1b[{code};5;{}m", nearest_xterm_color(color)),
        }
    };
    let mut text = String::new();
    for row in pairs(image) {
        let mut last = [String::new(), String::new()];
        for [above, below] in row {
            let (character, foreground, background) = match (above, below) {
                (None, None) => (' ', None, None),
                (None, below) => ('▄', below, None),
                (above, below) => ('▀', above, below),
            };
            let now = [color(false, foreground), color(true, background)];
            for (last, now) in last.iter_mut().zip(now) {
                if *last != now {
                    text += &now;
                    *last = now;
                }
            }
            text.push(character);
        }
        text += "\x1b[0m\n";
    }
    text.into_bytes()
}

/// Returns the index of the nearest xterm color. Only the colors from index 16 on are used: a cube of 6 x 6 x 6 colors,
/// and 24 grays.
fn nearest_xterm_color([r, g, b]: [u8; 3]) -> u32 {
    const STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |p: [u8; 3]| -> u32 {
        let pairs = p.into_iter().zip([r, g, b]);
        pairs.map(|(p, q)| u32::from(p.abs_diff(q)).pow(2)).sum()
    };
    let cube = (0..216_usize).map(|i| [STEPS[i / 36], STEPS[i / 6 % 6], STEPS[i % 6]]);
    let grays = (0..24_u8).map(|i| [8 + 10 * i; 3]);
    let nearest = (16..)
        .zip(cube.chain(grays))
        .min_by_key(|&(_, color)| distance(color));
    nearest.map_or(16, |(i, _)| i)
}

fn letters(image: &Image) -> Vec<u8> {
    const LIGHT_TO_DARK: &[u8] = b" .:-=+*#%@";
    let darkness = |color: Option<[u8; 3]>| {
        // The weights of red, green and blue in the luminance of Rec. ITU-R BT.709, in thousandths.
        color.map_or(0, |[r, g, b]| {
            let light = u32::from(r) * 213 + u32::from(g) * 715 + u32::from(b) * 72;
            255_000 - light
        })
    };
    let mut text = Vec::new();
    for row in pairs(image) {
        let line = row.into_iter().map(|[above, below]| {
            let mean = darkness(above).midpoint(darkness(below));
            let index = mean as usize * LIGHT_TO_DARK.len() / 255_001;
            LIGHT_TO_DARK[index.min(LIGHT_TO_DARK.len() - 1)]
        });
        let line: Vec<u8> = line.collect();
        text.extend_from_slice(line.trim_ascii_end());
        text.push(b'\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 4] = [200, 0, 0, 255];
    const NOTHING: [u8; 4] = [0; 4];

    fn image(width: u32, pixels: &[[u8; 4]]) -> Image {
        let height = u32::try_from(pixels.len()).unwrap() / width;
        Image {
            width,
            height,
            pixels: pixels.to_vec(),
        }
    }

    #[test]
    fn the_protocol_is_chosen_from_the_environment() {
        let of = |is_terminal, variables: &[(&str, &str)]| {
            Protocol::of(is_terminal, |name| {
                let found = variables.iter().find(|(known, _)| *known == name);
                found.map(|(_, value)| (*value).to_owned())
            })
        };
        let truecolor = ("COLORTERM", "truecolor");
        for (variables, protocol) in [
            (&[][..], Protocol::FewColorBlocks),
            (&[("TERM", "xterm-256color"), truecolor], Protocol::Blocks),
            (&[("TERM", "xterm-kitty"), truecolor], Protocol::Kitty),
            (
                &[("KITTY_WINDOW_ID", "1"), ("TMUX", "/tmp/x")],
                Protocol::FewColorBlocks,
            ),
            (&[("TERM_PROGRAM", "WezTerm")], Protocol::Iterm),
            (&[("KONSOLE_VERSION", "230805")], Protocol::Iterm),
            (&[("KONSOLE_VERSION", "none")], Protocol::FewColorBlocks),
            (&[("TERM", "foot")], Protocol::Sixel),
            (&[("TERM", "dumb"), truecolor], Protocol::Letters),
            (&[("TERM", "foot"), ("NO_COLOR", "1")], Protocol::Letters),
        ] {
            assert_eq!(of(true, variables), protocol, "{variables:?}");
            assert_eq!(of(false, variables), Protocol::Letters);
        }
    }

    #[test]
    fn a_block_character_shows_two_pixels() {
        let image = image(2, &[RED, NOTHING, [0, 0, 9, 255], RED, NOTHING, NOTHING]);
        let text = String::from_utf8(written(&image, Protocol::Blocks, 80).unwrap()).unwrap();
        assert_eq!(
            text,
            "\x1b[38;2;200;0;0m\x1b[48;2;0;0;9m▀\x1b[49m▄\x1b[0m\n\x1b[39m\x1b[49m  \x1b[0m\n"
        );
        let text = written(&image, Protocol::FewColorBlocks, 80).unwrap();
        assert!(
            String::from_utf8(text)
                .unwrap()
                .starts_with("\x1b[38;5;160m")
        );
    }

    #[test]
    fn letters_are_dense_where_the_picture_is_dark() {
        let black = [0, 0, 0, 255];
        let image = image(3, &[black, NOTHING, [255; 4], black, black, [255; 4]]);
        let text = written(&image, Protocol::Letters, 80).unwrap();
        assert_eq!(String::from_utf8(text).unwrap(), "@=\n");
    }

    #[test]
    fn a_picture_is_no_wider_than_the_terminal() {
        let wide = Image::filled(1000, 500, RED).unwrap();
        for (columns, width, lines) in [(40, 40, 10), (7, 7, 2), (0, 1, 1), (500, 100, 25)] {
            let text = written(&wide, Protocol::Letters, columns).unwrap();
            let text = String::from_utf8(text).unwrap();
            assert!(text.lines().all(|line| line.len() == width), "{columns}");
            assert_eq!(text.lines().count(), lines);
        }
        let tall = Image::filled(1, 16_384, RED).unwrap();
        let text = written(&tall, Protocol::Letters, 80).unwrap();
        assert_eq!(String::from_utf8(text).unwrap().lines().count(), 200);
    }

    #[test]
    fn a_reduced_pixel_is_the_mean_of_its_rectangle() {
        let image = image(4, &[RED, [100, 0, 0, 255], NOTHING, RED]);
        let small = reduced(&image, 2);
        assert_eq!(small.pixels, [[150, 0, 0, 255], [200, 0, 0, 127]]);
    }

    #[test]
    fn the_nearest_xterm_color_is_found() {
        for (color, index) in [
            ([0, 0, 0], 16),
            ([255, 255, 255], 231),
            ([95, 135, 175], 16 + 36 + 12 + 3),
            ([128, 128, 128], 244),
        ] {
            assert_eq!(nearest_xterm_color(color), index);
        }
    }

    /// Decodes a Sixel text. Returns the color index of each pixel, or `None` for a pixel that is not set.
    fn decoded_sixel(text: &str, width: usize, height: usize) -> Vec<Option<usize>> {
        let body = text
            .strip_prefix(&format!("\x1bP0;1;0q\"1;1;{width};{height}"))
            .unwrap();
        let body = body.strip_suffix("\x1b\\\n").unwrap().as_bytes();
        let mut pixels = vec![None; width * height];
        let (mut i, mut x, mut y, mut color) = (0, 0, 0, 0);
        let number = |i: &mut usize| {
            let from = *i;
            while body[*i].is_ascii_digit() {
                *i += 1;
            }
            std::str::from_utf8(&body[from..*i])
                .unwrap()
                .parse::<usize>()
                .unwrap()
        };
        while i < body.len() {
            i += 1;
            let mut n = 1;
            match body[i - 1] {
                b'#' => {
                    color = number(&mut i);
                    while body[i] == b';' {
                        i += 1;
                        number(&mut i);
                    }
                    continue;
                }
                b'$' => {
                    x = 0;
                    continue;
                }
                b'-' => {
                    (x, y) = (0, y + 6);
                    continue;
                }
                b'!' => {
                    n = number(&mut i);
                    i += 1;
                }
                _ => {}
            }
            let bits = body[i - 1] - b'?';
            for _ in 0..n {
                for row in 0..6 {
                    if bits >> row & 1 == 1 {
                        pixels[(y + row) * width + x] = Some(color);
                    }
                }
                x += 1;
            }
        }
        pixels
    }

    #[test]
    fn a_sixel_text_sets_every_pixel_to_its_color() {
        let colors = [RED, [0, 0, 200, 255], NOTHING, [9, 9, 9, 255]];
        let pixels: Vec<_> = (0..17 * 13).map(|i| colors[i * i / 7 % 4]).collect();
        let image = image(17, &pixels);
        let text = String::from_utf8(written(&image, Protocol::Sixel, 80).unwrap()).unwrap();
        let mut palette = Palette::of(std::slice::from_ref(&image));
        let expected: Vec<Option<usize>> = pixels
            .iter()
            .map(|&p| (p[3] > 0).then(|| usize::from(palette.index(p))))
            .collect();
        assert_eq!(decoded_sixel(&text, 17, 13), expected);
    }

    #[test]
    fn pixels_are_sent_as_png_files() {
        let noise = (0..200 * 200_u32).map(|i| {
            let [a, b, c, _] = i.wrapping_mul(2_654_435_761).to_be_bytes();
            [a, b, c, 255]
        });
        let image = image(200, &noise.collect::<Vec<_>>());
        let png = image.to_png(&[]).unwrap();
        let text = String::from_utf8(written(&image, Protocol::Iterm, 80).unwrap()).unwrap();
        let data = text
            .split(':')
            .nth(1)
            .unwrap()
            .trim_end_matches(['\x07', '\n']);
        assert_eq!(BASE_64.decode(data).unwrap(), png);

        let text = String::from_utf8(written(&image, Protocol::Kitty, 80).unwrap()).unwrap();
        assert!(text.starts_with("\x1b_Ga=T,f=100,q=2,m=1;"));
        let pieces: Vec<&str> = text.trim_end().split_terminator("\x1b\\").collect();
        let data: String = pieces
            .iter()
            .map(|p| p.split(';').nth(1).unwrap())
            .collect();
        assert_eq!(BASE_64.decode(data).unwrap(), png);
        assert!(pieces.iter().all(|p| p.len() < 4200) && pieces.len() > 1);
        assert!(pieces[pieces.len() - 1].starts_with("\x1b_Gm=0;"));
    }
}
