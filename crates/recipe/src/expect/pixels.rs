//! Comparing pictures by their pixels.

use std::io::Cursor;
use std::path::Path;

use super::output::Difference;
use png::{ColorType, Decoder, Reader, Transformations};
use store::Store;

/// What differs between the pictures of two files by more than `tolerance` steps of 255.
pub(super) fn compare(
    store: &dyn Store,
    written: &Path,
    golden: &Path,
    tolerance: u8,
) -> Result<(), Difference> {
    let (mut now, mut then) = (
        Picture::open(store, written)?,
        Picture::open(store, golden)?,
    );
    let [width, height] = then.size();
    if now.size() != then.size() {
        let [w, h] = now.size();
        return Err(Difference::Told(format!(
            "expected {width} x {height} pixels, found {w} x {h}"
        )));
    }
    let n = then.n_frames();
    if now.n_frames() != n {
        return Err(Difference::Told(format!(
            "expected {n} images, found {}",
            now.n_frames()
        )));
    }
    let mut found = Found::default();
    for frame in 0..n {
        let (now, then) = (now.next()?, then.next()?);
        if now.control != then.control {
            let number = frame + 1;
            return Err(Difference::Told(format!(
                "image {number} is shown at another place or for another time"
            )));
        }
        let width = then.width.max(1);
        for (i, (a, b)) in now.pixels.iter().zip(&then.pixels).enumerate() {
            found.total += 1;
            let most = a
                .iter()
                .zip(b)
                .map(|(a, b)| a.abs_diff(*b))
                .max()
                .unwrap_or(0);
            if most > tolerance {
                found.n += 1;
                found.most = found.most.max(most);
                found
                    .first
                    .get_or_insert([frame as usize, i % width, i / width]);
            }
        }
    }
    found.told(n).map_err(Difference::Told)
}

#[derive(Default)]
struct Found {
    /// How many pixels differ, of how many.
    n: u64,
    total: u64,
    /// By how much at most.
    most: u8,
    /// Image, column and row.
    first: Option<[usize; 3]>,
}

impl Found {
    fn told(&self, n_frames: u32) -> Result<(), String> {
        let Some([frame, x, y]) = self.first else {
            return Ok(());
        };
        let (n, total, most) = (self.n, self.total, self.most);
        let image = if n_frames > 1 {
            format!(" of image {}", frame + 1)
        } else {
            String::new()
        };
        Err(if n == 1 {
            format!("1 of {total} pixels differs, by {most} of 255, at ({x}, {y}){image}")
        } else {
            format!(
                "{n} of {total} pixels differ, by at most {most} of 255; the first is at ({x}, {y}){image}"
            )
        })
    }
}

/// A PNG that is read image by image.
struct Picture<'p> {
    path: &'p Path,
    reader: Reader<Cursor<Vec<u8>>>,
}

/// One image.
struct Frame {
    /// Red, green, blue, alpha.
    pixels: Vec<[u8; 4]>,
    width: usize,
    /// Where, how long and how it is shown, in an animation.
    control: Option<([u32; 4], [u32; 2], [u32; 2])>,
}

impl<'p> Picture<'p> {
    fn open(store: &dyn Store, path: &'p Path) -> Result<Self, String> {
        let bytes = store.read(path).map_err(|error| error.to_string())?;
        let mut decoder = Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(Transformations::normalize_to_color8());
        let reader = decoder
            .read_info()
            .map_err(|e| no_picture(path, &e.to_string()))?;
        Ok(Self { path, reader })
    }

    fn size(&self) -> [u32; 2] {
        let info = self.reader.info();
        [info.width, info.height]
    }

    fn n_frames(&self) -> u32 {
        let animation = self.reader.info().animation_control();
        animation.map_or(1, |animation| animation.num_frames.max(1))
    }

    fn next(&mut self) -> Result<Frame, String> {
        let size = self.reader.output_buffer_size();
        let size = size.ok_or_else(|| no_picture(self.path, "it is too large"))?;
        let mut bytes = vec![0; size];
        let info = self.reader.next_frame(&mut bytes);
        let info = info.map_err(|e| no_picture(self.path, &e.to_string()))?;
        bytes.truncate(info.buffer_size());
        let gray = |p: &[u8]| [p[0], p[0], p[0], 255];
        let pixels = match info.color_type {
            ColorType::Rgba => bytes.as_chunks().0.to_vec(),
            ColorType::Rgb => bytes
                .as_chunks()
                .0
                .iter()
                .map(|&[r, g, b]| [r, g, b, 255])
                .collect(),
            ColorType::GrayscaleAlpha => bytes
                .as_chunks()
                .0
                .iter()
                .map(|&[g, a]| [g, g, g, a])
                .collect(),
            ColorType::Grayscale | ColorType::Indexed => bytes.chunks(1).map(gray).collect(),
        };
        let control = self.reader.info().frame_control.map(|c| {
            let place = [c.x_offset, c.y_offset, c.width, c.height];
            let time = [c.delay_num, c.delay_den].map(u32::from);
            let way = [c.dispose_op as u32, c.blend_op as u32];
            (place, time, way)
        });
        Ok(Frame {
            pixels,
            width: info.width as usize,
            control,
        })
    }
}

fn no_picture(path: &Path, why: &str) -> String {
    format!("{} cannot be read as a picture: {why}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes a picture of 3 x 2 pixels, or several as an animation.
    fn write(path: &Path, images: &[[u8; 24]], color: ColorType) {
        let mut encoder = png::Encoder::new(std::fs::File::create(path).unwrap(), 3, 2);
        encoder.set_color(color);
        encoder
            .add_text_chunk("Software".to_owned(), path.display().to_string())
            .unwrap();
        if images.len() > 1 {
            encoder
                .set_animated(u32::try_from(images.len()).unwrap(), 0)
                .unwrap();
        }
        let mut writer = encoder.write_header().unwrap();
        for image in images {
            writer
                .write_image_data(&image[..6 * color.samples()])
                .unwrap();
        }
        writer.finish().unwrap();
    }

    fn compared(
        now: (&[[u8; 24]], ColorType),
        then: (&[[u8; 24]], ColorType),
        tolerance: u8,
    ) -> Result<(), String> {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a.png", "b.png"].map(|name| folder.path().join(name));
        write(&a, now.0, now.1);
        write(&b, then.0, then.1);
        compare(&store::Disk, &a, &b, tolerance).map_err(Difference::into_message)
    }

    #[test]
    fn one_pixel_that_differs_is_told_with_its_place() {
        let then = [100; 24];
        let mut now = then;
        now[4 * 4 + 1] = 103;
        let rgba = ColorType::Rgba;
        let held = |tolerance| compared((&[now], rgba), (&[then], rgba), tolerance);
        let told = "1 of 6 pixels differs, by 3 of 255, at (1, 1)";
        assert_eq!(held(0).unwrap_err(), told);
        assert!(held(2).is_err());
        assert_eq!(held(3), Ok(()));
        now[0] = 0;
        let held = compared((&[now], rgba), (&[then], rgba), 0);
        assert_eq!(
            held.unwrap_err(),
            "2 of 6 pixels differ, by at most 100 of 255; the first is at (0, 0)"
        );
    }

    #[test]
    fn colors_count_and_not_how_they_are_kept() {
        let gray = [7; 24];
        let mut rgba = [7; 24];
        rgba.iter_mut()
            .skip(3)
            .step_by(4)
            .for_each(|alpha| *alpha = 255);
        for (image, color) in [
            (gray, ColorType::Grayscale),
            (gray, ColorType::Rgb),
            (rgba, ColorType::Rgba),
        ] {
            let held = compared((&[image], color), (&[gray], ColorType::Rgb), 0);
            assert_eq!(held, Ok(()), "{color:?}");
        }
        let held = compared(
            (&[gray], ColorType::GrayscaleAlpha),
            (&[gray], ColorType::Rgb),
            0,
        );
        assert!(held.unwrap_err().contains("by at most 248"));
    }

    #[test]
    fn every_image_of_an_animation_counts() {
        let (a, b) = ([1; 24], [2; 24]);
        let color = ColorType::Rgba;
        let held = |now: &[[u8; 24]]| compared((now, color), (&[a, b, a], color), 0);
        assert_eq!(held(&[a, b, a]), Ok(()));
        assert_eq!(
            held(&[a, b, b]).unwrap_err(),
            "6 of 18 pixels differ, by at most 1 of 255; the first is at (0, 0) of image 3"
        );
        assert_eq!(held(&[a, b]).unwrap_err(), "expected 3 images, found 2");
    }

    #[test]
    fn what_is_no_picture_is_said_and_never_a_panic() {
        let folder = tempfile::tempdir().unwrap();
        let [good, bad] = ["good.png", "bad.png"].map(|name| folder.path().join(name));
        write(&good, &[[9; 24]; 2], ColorType::Rgba);
        let bytes = std::fs::read(&good).unwrap();
        for i in 0..bytes.len() {
            let mut broken = bytes.clone();
            broken[i] ^= 0x55;
            std::fs::write(&bad, &broken).unwrap();
            let _ = compare(&store::Disk, &good, &bad, 0);
            std::fs::write(&bad, &bytes[..i]).unwrap();
            assert!(
                compare(&store::Disk, &good, &bad, 0).is_err() || i + 12 >= bytes.len(),
                "{i}"
            );
        }
        std::fs::write(&bad, "no picture").unwrap();
        let error = compare(&store::Disk, &good, &bad, 0).unwrap_err();
        assert!(matches!(error, Difference::Unknown(_)));
        let error = error.into_message();
        assert!(
            error.contains("bad.png cannot be read as a picture: "),
            "{error}"
        );
        assert!(compare(&store::Disk, &good, &folder.path().join("none.png"), 0).is_err());
    }
}
