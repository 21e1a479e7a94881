//! Reads and writes `.bez` files, which contain bicubic Bezier patches, and `.bzc` files, which contain a Bezier curve
//! in the plane. Both kinds of files contain only numbers.
//!
//! ```text
//! 2                                   the number of patches
//! x y z   x y z   x y z   x y z       4 rows of 4 control points each
//! x y z   x y z   x y z   x y z
//! ...
//! ```
//!
//! A `.bzc` file contains the number of control points, followed by the coordinates `x y` of each point. Numbers are
//! separated by one or more blanks or line ends. Neither `.bez` nor `.bzc` files have comments.

use bezier::{Curve, Patch};
use glam::{DVec2, DVec3};
use scene::{Geometry, Scene};

use crate::error::Unwritable;
use crate::fault::Fault;
use crate::loss::Losses;
use crate::text::{Cursor, TextPosition, check_encoding, number, parsed, push_number};
use crate::{Format, SingleFile};

/// Reads the patches of a `.bez` file.
///
/// # Errors
///
/// Returns the first error in the file, with its position.
pub(crate) fn read_patches(bytes: &[u8]) -> Result<Geometry, Fault> {
    patches(bytes).map(Geometry::Patches)
}

fn patches(bytes: &[u8]) -> Result<Vec<Patch>, Fault> {
    check_encoding(bytes)?;
    let mut cursor = Cursor::new(bytes);
    let n = count(&mut cursor, "patches", 16 * 3)?;
    let mut patches = Vec::with_capacity(n);
    for i in 0..n {
        cursor.skip_white();
        let place = cursor.place();
        let mut points = [[DVec3::ZERO; 4]; 4];
        for (k, point) in points.as_flattened_mut().iter_mut().enumerate() {
            let (k, i) = (k + 1, i + 1);
            for (axis, x) in ['x', 'y', 'z'].into_iter().zip(point.as_mut()) {
                let what = || format!("{axis} of control point {k} (of 16) in patch {i} (of {n})");
                *x = coordinate(&mut cursor, what)?;
            }
        }
        let patch = Patch::new(points);
        patches.push(patch.map_err(|e| place.error(format!("patch {} (of {n}): {e}", i + 1)))?);
    }
    expect_end(&mut cursor, &format!("the last of {n} patches"))?;
    Ok(patches)
}

/// Reads the curve of a `.bzc` file.
///
/// # Errors
///
/// Returns the first error in the file, with its position.
pub(crate) fn read_curve(bytes: &[u8]) -> Result<Geometry, Fault> {
    curve(bytes).map(Geometry::Curve)
}

fn curve(bytes: &[u8]) -> Result<Curve<DVec2>, Fault> {
    check_encoding(bytes)?;
    let mut cursor = Cursor::new(bytes);
    cursor.skip_white();
    let place = cursor.place();
    let n = count(&mut cursor, "control points", 2)?;
    let mut points = Vec::with_capacity(n);
    for i in 0..n {
        let what = |axis| format!("{axis} of control point {} (of {n})", i + 1);
        let x = coordinate(&mut cursor, || what('x'))?;
        let y = coordinate(&mut cursor, || what('y'))?;
        points.push(DVec2::new(x, y));
    }
    expect_end(&mut cursor, &format!("the last of {n} control points"))?;
    Curve::new(points).map_err(|e| place.error(e.to_string()))
}

/// Writes the patches of `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if an object does not consist of patches.
pub(crate) fn write_bez(scene: &Scene) -> Result<SingleFile, Unwritable> {
    let mut all = Vec::new();
    let mut losses = Vec::new();
    for object in scene.objects() {
        let Geometry::Patches(patches) = &object.geometry else {
            return Err(Unwritable::kind(Format::Bez, object));
        };
        all.extend_from_slice(patches);
        let mut losses = Losses::of(&object.name, &mut losses);
        let reason = "a .bez file cannot store materials";
        losses.add(None, "materials", object.materials.len(), reason);
        let several = usize::from(scene.objects().len() > 1);
        let reason = "the patches of all objects are written as one list";
        losses.add(None, "name", several, reason);
    }
    Ok((write_patches(&all), losses))
}

/// Writes the curve of `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if the scene does not consist of a single curve.
pub(crate) fn write_bzc(scene: &Scene) -> Result<SingleFile, Unwritable> {
    let [object] = scene.objects() else {
        let message = Format::Bzc.refused_count(scene.objects().len());
        return Err(Unwritable::scene(message.unwrap_or_default()));
    };
    let Geometry::Curve(curve) = &object.geometry else {
        return Err(Unwritable::kind(Format::Bzc, object));
    };
    let mut losses = Vec::new();
    let reason = "a .bzc file cannot store materials";
    let mut of_object = Losses::of(&object.name, &mut losses);
    of_object.add(None, "materials", object.materials.len(), reason);
    Ok((write_curve(curve), losses))
}

/// The text of a `.bez` file with these patches.
fn write_patches(patches: &[Patch]) -> Vec<u8> {
    let mut out = format!("{}\n", patches.len()).into_bytes();
    for patch in patches {
        for row in patch.points() {
            let line: Vec<f64> = row.iter().flat_map(DVec3::to_array).collect();
            push_line(&mut out, &line);
        }
        out.push(b'\n');
    }
    out
}

/// The text of a `.bzc` file with this curve.
fn write_curve(curve: &Curve<DVec2>) -> Vec<u8> {
    let mut out = format!("{}\n", curve.points().len()).into_bytes();
    for point in curve.points() {
        push_line(&mut out, &point.to_array());
    }
    out
}

fn push_line(out: &mut Vec<u8>, numbers: &[f64]) {
    for (i, &x) in numbers.iter().enumerate() {
        if i > 0 {
            out.push(b' ');
        }
        push_number(out, x);
    }
    out.push(b'\n');
}

/// Reads the number of items (patches or control points) at the beginning of a file. Checks that the rest of the file
/// is long enough for these items.
fn count(cursor: &mut Cursor, what: &str, numbers_each: usize) -> Result<usize, Fault> {
    let (place, word) = cursor.next_word();
    let n = parsed(word)
        .ok_or_else(|| expected(place, format!("the number of {what} (an integer)"), word))?;
    if !cursor.has_room(n, numbers_each) {
        return Err(place.error(format!(
            "the rest of the file is too short for {n} {what} (bytes left: {})",
            cursor.remaining()
        )));
    }
    Ok(n)
}

fn coordinate(cursor: &mut Cursor, what: impl Fn() -> String) -> Result<f64, Fault> {
    let (place, word) = cursor.next_word();
    if word.is_empty() {
        return Err(place.error(format!("expected {}, found the end of the file", what())));
    }
    number(place, word).map_err(|Fault { message, .. }| {
        place.error(format!("{}: {message}{}", what(), comment_hint(word)))
    })
}

fn expect_end(cursor: &mut Cursor, last: &str) -> Result<(), Fault> {
    match cursor.next_word() {
        (_, b"") => Ok(()),
        (place, word) => Err(expected(
            place,
            format!("the end of the file after {last}"),
            word,
        )),
    }
}

fn expected(place: TextPosition, what: String, found: &[u8]) -> Fault {
    let mut fault = place.expected(what, found);
    fault.message += comment_hint(found);
    fault
}

fn comment_hint(word: &[u8]) -> &'static str {
    if word.starts_with(b"#") {
        " (the format has no comments)"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn patch_text() -> String {
        (0..16).fold(String::new(), |text, i| {
            text + &format!("{i} {}.5 -1e-3\n", i * 2)
        })
    }

    #[test]
    fn patches_are_read_as_rows_of_points() {
        let patches = patches(format!("\u{feff}1\r\n\r\n{}", patch_text()).as_bytes()).unwrap();

        assert_eq!(patches.len(), 1);
        assert_eq!(patches[0].points()[1][2], DVec3::new(6.0, 12.5, -1e-3));
    }

    #[test]
    fn a_curve_is_read_as_a_count_and_its_points() {
        let curve = curve(b"3\n0 0   0.5 1\n1 0").unwrap();
        assert_eq!(
            curve.points(),
            [DVec2::ZERO, DVec2::new(0.5, 1.0), DVec2::X]
        );
    }

    #[test]
    fn errors_in_patch_files_name_the_position() {
        let one = patch_text();
        let short = one.trim_end().rsplit_once(' ').unwrap().0;
        for (text, line, column, words) in [
            (String::new(), 1, 1, "expected the number of patches"),
            ("# teapot\n1\n".to_owned(), 1, 1, "no comments"),
            ("1.5\n".to_owned(), 1, 1, "(an integer), found `1.5`"),
            ("-1\n".to_owned(), 1, 1, "integer"),
            (
                "4000000000 0 0".to_owned(),
                1,
                1,
                "the rest of the file is too short",
            ),
            (
                "18446744073709551615 0".to_owned(),
                1,
                1,
                "the rest of the file is too short",
            ),
            (
                format!("1\n{short}"),
                17,
                8,
                "z of control point 16 (of 16) in patch 1 (of 1)",
            ),
            (format!("1\n{one}7\n"), 18, 1, "found `7`"),
            (format!("1\n{one}# end\n"), 18, 1, "no comments"),
            (
                format!("1\n{}", one.replacen("2.5", "x", 1)),
                3,
                3,
                "found `x`",
            ),
            (
                format!("1\n{}", one.replacen("0.5", "nan", 1)),
                2,
                3,
                "finite number, found `nan`",
            ),
            (
                format!("1\n{}", one.replacen("0.5", "1e999", 1)),
                2,
                3,
                "found `1e999`",
            ),
        ] {
            let error = patches(text.as_bytes()).unwrap_err();
            assert!(error.message.contains(words), "{text:?}: {error:?}");
            assert_eq!(error.place(), (line, column), "{text:?}: {error:?}");
        }
    }

    #[test]
    fn errors_in_curve_files_name_the_line() {
        for (text, line, words) in [
            ("", 1, "expected the number of control points"),
            ("\n0", 2, "at least one control point"),
            ("2\n0 0\n1", 1, "the rest of the file is too short"),
            ("2\n0 0\n1     ", 3, "y of control point 2 (of 2)"),
            ("1\n0 0\n1 1", 3, "expected the end of the file"),
            ("4000000000\n0 0", 1, "the rest of the file is too short"),
        ] {
            let error = curve(text.as_bytes()).unwrap_err();
            assert!(error.message.contains(words), "{text:?}: {error:?}");
            assert_eq!(error.place().0, line, "{text:?}: {error:?}");
        }
    }

    proptest! {
        #[test]
        fn written_patches_read_back_the_same(numbers in prop::array::uniform32(-1e9..1e9_f64)) {
            let points = std::array::from_fn(|i| std::array::from_fn(|j| {
                let k = 4 * i + j;
                DVec3::new(numbers[2 * k], numbers[2 * k + 1], -0.0)
            }));
            let patches = vec![Patch::new(points).unwrap(); 2];
            prop_assert_eq!(super::patches(&write_patches(&patches)), Ok(patches));
        }

        #[test]
        fn written_curves_read_back_the_same(numbers in prop::collection::vec(-1e9..1e9_f64, 1..20)) {
            let points = numbers.iter().map(|&x| DVec2::new(x, 1e-7 * x)).collect();
            let curve = Curve::new(points).unwrap();
            prop_assert_eq!(super::curve(&write_curve(&curve)), Ok(curve));
        }

        #[test]
        fn random_bytes_do_not_panic(bytes: Vec<u8>, text in "[0-9 #.\\-e\n]{0,300}") {
            for input in [&bytes[..], text.as_bytes()] {
                let _ = patches(input);
                let _ = curve(input);
            }
        }
    }
}
