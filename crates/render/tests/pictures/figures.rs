//! Compares small figures and legends with golden files, pixel by pixel, to check that they are the same on every
//! machine.
//!
//! If the environment variable `MESHWRIGHT_UPDATE` is set, the files in `tests/goldens` are written instead. Look at
//! the files before you commit them.

use std::io::Cursor;
use std::path::Path;

use bezier::{Curve, DVec2};
use render::Image;
use render::figure::construction::{Layout, Panel, construction};
use render::figure::label::{Label, draw_labels};
use render::figure::legend::{Corner, Legend, Scale, covered_pixels, draw_legend};
use render::figure::pixels;

const WHITE: [u8; 4] = [255; 4];
const BLACK: [u8; 4] = [0, 0, 0, 255];

/// Compares an opaque image with its golden file.
#[track_caller]
fn golden(name: &str, image: &Image) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/goldens")
        .join(name)
        .with_extension("png");
    if std::env::var_os("MESHWRIGHT_UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, image.to_png(&[]).unwrap()).unwrap();
    }
    let bytes =
        std::fs::read(&path).expect("missing golden file: set MESHWRIGHT_UPDATE to write it");
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
    let mut expected = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut expected).unwrap();
    assert_eq!((info.width, info.height), (image.width, image.height));
    let found: Vec<u8> = image.pixels.iter().flat_map(|p| p[..3].to_vec()).collect();
    let differ = found.iter().zip(&expected).filter(|(p, q)| p != q).count();
    assert!(
        found == expected,
        "{name}: {differ} of {} bytes differ",
        found.len()
    );
}

fn curve(points: &[[f64; 2]]) -> Curve<DVec2> {
    Curve::new(points.iter().map(|&p| p.into()).collect()).unwrap()
}

#[test]
fn a_construction() {
    let after = curve(&[[0.0, 0.0], [1.0, 3.0], [4.0, 4.0], [6.0, 0.0], [7.0, 3.0]]);
    let before = after.with_point(2, DVec2::new(3.0, -2.0)).unwrap();
    let panel = |t, before| Panel {
        curve: &after,
        before,
        t,
        levels: None,
        title: Some("a < b"),
    };
    let layout = Layout {
        width: 320.0,
        columns: 2,
        ..Layout::default()
    };
    let panels = [panel(Some(0.5), None), panel(None, Some(&before))];
    let figure = construction(&panels, &layout).unwrap();
    golden("construction", &pixels(&figure, 1.0, WHITE).unwrap());
}

#[test]
fn a_legend_covers_its_corner_only() {
    let bar = Legend {
        title: "area".into(),
        scale: Scale::Discrete(vec![("a".to_owned(), BLACK)]),
    };
    let mut plain = Image::filled(300, 200, WHITE).unwrap();
    // The image has a model in the upper right corner.
    for y in 0..60 {
        plain.pixels[y * 300 + 240..(y + 1) * 300].fill(BLACK);
    }
    for corner in Corner::ALL {
        let covered = covered_pixels(&plain, &bar, corner, 1.0, WHITE);
        assert_eq!(covered > 0, corner == Corner::UpperRight, "{corner:?}");
        let mut image = plain.clone();
        draw_legend(&mut image, &bar, corner, 1.0);
        let changed = (0..image.pixels.len()).filter(|&i| image.pixels[i] != plain.pixels[i]);
        for (x, y) in changed.map(|i| (i % 300, i / 300)) {
            let is_right = matches!(corner, Corner::UpperRight | Corner::LowerRight);
            let is_low = matches!(corner, Corner::LowerLeft | Corner::LowerRight);
            assert_eq!((x >= 150, y >= 100), (is_right, is_low), "{corner:?}");
        }
    }
}

#[test]
fn legends_and_labels() {
    let mut image = Image::filled(240, 240, [180, 190, 200, 255]).unwrap();
    let bar = Legend {
        title: "distance".into(),
        scale: Scale::Continuous {
            low: 0.0,
            high: 0.25,
            colors: (0..=255).map(|i| [i, 128, 255 - i, 255]).collect(),
        },
    };
    draw_legend(&mut image, &bar, Corner::UpperRight, 1.0);
    let entry = |name: &str, red| (name.to_owned(), [red, 80, 60, 255]);
    let list = Legend {
        title: String::new(),
        scale: Scale::Discrete(vec![entry("Größe", 0), entry("нос", 250)]),
    };
    let mut below = Image::filled(140, 110, [180, 190, 200, 255]).unwrap();
    draw_legend(&mut below, &list, Corner::UpperRight, 1.5);
    image.place(&below, [0, 130]);
    let label = |x, text: &str| Label::new(DVec2::new(x, 40.0), text, 13.0, BLACK);
    draw_labels(&mut image, &[label(30.0, "17"), label(70.5, "f3")]);
    golden("legends", &image);
}
