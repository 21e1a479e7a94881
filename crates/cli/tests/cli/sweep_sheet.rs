//! `sweep --sheet`: the final scenes of all runs of a sweep in one image.

use crate::folder::{Ended, Folder};
use crate::pixels::{Pixels, pixels};

const RECIPE: &str = r#"(
    recipe: 1,
    params: {
        "around": Int(default: 8, min: 3, max: 64),
        "major": Float(default: 1, min: 0.1, max: 9),
        "minor": Float(default: 0.5, min: 0.1, max: 2),
    },
    steps: [Torus(name: "torus", around: arg("around"), across: 6, major: arg("major"), minor: arg("minor"))],
)"#;

fn folder(fields: &str) -> Folder {
    let sweep = format!("(sweep: 1, recipe: \"recipe.ron\", {fields})");
    Folder::with_recipe(RECIPE).with("a.sweep.ron", sweep)
}

/// Draws a sheet on which each scene has 90 x 40 pixels.
fn sheet(folder: &Folder, more: &str) -> Ended {
    folder.run(&format!(
        "sweep a.sweep.ron --sheet s.png --size 90x40 {more}"
    ))
}

/// Returns the pixels of the scene in column `i` and row `j` of a sheet. A scene has 90 x 40 pixels. A row is `row`
/// pixels high, including the caption. The grid of scenes starts at the pixel `start`.
fn cell(sheet: &Pixels, start: [u32; 2], row: u32, [i, j]: [u32; 2]) -> Pixels {
    let (left, top) = (start[0] + 12 + i * 102, start[1] + 12 + j * (row + 12));
    sheet.part([left, top], [90, 40])
}

/// Counts the pixels that are not white.
fn drawn(pixels: &Pixels) -> usize {
    pixels.count(|p| p != [255; 3])
}

#[test]
fn one_parameter_is_a_row_with_values_below() {
    let folder = folder("over: {\"around\": [3, 8, 16]}, keep: [Faces]");
    let ended = sheet(&folder, "").with_code(0);
    assert!(
        ended.stdout.contains("wrote s.png, 318 x 113 pixels\n"),
        "{ended:#?}"
    );
    let made = pixels(&folder, "s.png");
    // Each caption has one line for the parameter value and one line for the measure.
    assert_eq!(made.size, [12 + 3 * 102, 12 + 40 + 49 + 12]);
    for i in 0..3 {
        assert!(drawn(&cell(&made, [0, 0], 89, [i, 0])) > 200);
        let captions = made.part([12 + i * 102, 52], [90, 49]);
        assert!(drawn(&captions) > 50);
    }
    // Long rows are wrapped, and the number of columns can be set.
    let seven = self::folder("over: {\"around\": [3, 4, 5, 6, 7, 8, 9]}, keep: [Faces]");
    sheet(&seven, "").with_code(0);
    assert_eq!(pixels(&seven, "s.png").size[0], 12 + 4 * 102);
    sheet(&seven, "--columns 3").with_code(0);
    assert_eq!(pixels(&seven, "s.png").size[0], 12 + 3 * 102);
}

#[test]
fn two_parameters_label_rows_and_columns() {
    let folder = folder(
        "over: {\"minor\": [0.2, 0.4], \"around\": [4, 32, 8]}, set: {\"major\": 1}, keep: [Faces]",
    );
    sheet(&folder, "").with_code(0);
    let made = pixels(&folder, "s.png");
    // The labels of the columns are values of the last parameter, `around`. The labels of the rows are values of the
    // first parameter, `minor`. Below each scene are the measured values that `keep` lists.
    let [width, height] = made.size;
    let beside = width - (12 + 3 * 102);
    assert!((40..=102).contains(&beside), "{beside}");
    assert_eq!(height, 28 + 12 + 2 * (40 + 28 + 12));
    let start = [beside, 28];
    for i in 0..3 {
        assert!(drawn(&made.part([beside + 12 + i * 102, 0], [90, 40])) > 50);
    }
    for j in 0..2 {
        assert!(drawn(&made.part([0, 40 + j * 80], [beside, 40])) > 50);
        for i in 0..3 {
            assert!(drawn(&cell(&made, start, 68, [i, j])) > 100, "{i} {j}");
        }
    }
    // Scenes in the same column have the same number of faces. Therefore, they have the same caption.
    let caption = |i: u32, j: u32| made.part([beside + 12 + i * 102, 40 + 40 + j * 80], [90, 28]);
    assert_eq!(caption(0, 0), caption(0, 1));
    assert_ne!(caption(0, 0), caption(1, 0));
}

#[test]
fn zipped_values_are_one_label() {
    let folder = folder(
        "over: {\"around\": [4, 8]}, zip: {\"minor\": [0.2, 0.3, 0.4], \"major\": [1, 2, 3]}, keep: [Faces]",
    );
    sheet(&folder, "").with_code(0);
    let [_, height] = pixels(&folder, "s.png").size;
    assert_eq!(height, 28 + 12 + 2 * (40 + 28 + 12));
}

#[test]
fn all_cells_are_drawn_in_one_scale() {
    let folder = folder("over: {\"major\": [1, 4]}, set: {\"minor\": 0.5}, keep: [Seconds]");
    sheet(&folder, "--from Top --orthographic --shading Plain").with_code(0);
    let made = pixels(&folder, "s.png");
    // Times are not shown in captions.
    assert_eq!(made.size, [12 + 2 * 102, 12 + 40 + 28 + 12]);
    let widths = [0, 1].map(|i| {
        let cell = cell(&made, [0, 0], 68, [i, 0]);
        let columns: Vec<u32> = (0..90)
            .filter(|&x| drawn(&cell.part([x, 0], [1, 40])) > 0)
            .collect();
        columns[columns.len() - 1] - columns[0] + 1
    });
    // The tori have the outer radii 1.5 and 4.5, so the second image is three times as wide. Pixels that a torus covers
    // only partly cause small differences.
    assert!((3 * widths[0]).abs_diff(widths[1]) <= 5, "{widths:?}");
}

#[test]
fn colors_mean_the_same_in_all_cells_and_are_explained_once() {
    let folder = folder("over: {\"minor\": [0.2, 0.4]}, keep: [Seconds]");
    let size = |more: &str| {
        sheet(&folder, more).with_code(0);
        pixels(&folder, "s.png").size
    };
    let [plain, _] = size("");
    let [colored, height] = size("--color-by Area");
    assert!((50..200).contains(&(colored - plain)), "{colored}");
    assert!(height > 150);
    let made = pixels(&folder, "s.png");
    assert!(drawn(&made.part([plain, 0], [colored - plain, height])) > 1000);
    // The torus in the second scene has larger faces. Only these faces are yellow, because yellow stands for the
    // largest area.
    let colors = |i: u32| {
        let cell = cell(&made, [0, 0], 68, [i, 0]);
        move |is: fn([u8; 3]) -> bool| cell.count(is)
    };
    let is_yellow = |[r, g, b]: [u8; 3]| r > 140 && g > 140 && b < 100;
    assert_eq!(colors(0)(is_yellow), 0);
    assert!(colors(1)(is_yellow) > 20);
    let legend = format!("{}, legend: false)", "color_by: (of: Area");
    let ended = folder.run_all(&[
        "sweep",
        "a.sweep.ron",
        "--sheet",
        "s.png",
        "--size",
        "90x40",
        "--with",
        &legend,
    ]);
    ended.with_code(0);
    assert_eq!(pixels(&folder, "s.png").size[0], plain);
}

#[test]
fn a_cell_that_fails_shows_its_error() {
    let folder = folder("over: {\"around\": [8, 16]}, expect: true, keep: [Faces]").with(
        "recipe.ron",
        RECIPE.replace("    steps", "    expect: [Faces(eq: 48)],\n    steps"),
    );
    sheet(&folder, "")
        .with_code(1)
        .complains(&["error: cell 2: expected 48 faces, found 96\n"]);
    let made = pixels(&folder, "s.png");
    let is_red = |[r, g, b]: [u8; 3]| r > g.saturating_add(40) && r > b.saturating_add(40);
    let (good, failed) = (
        cell(&made, [0, 0], 89, [0, 0]),
        cell(&made, [0, 0], 89, [1, 0]),
    );
    assert_eq!(good.count(is_red), 0);
    assert!(failed.count(is_red) > 50);
    // The image of the failed run contains only red text.
    assert_eq!(failed.count(|[r, g, _]| r < 180 && g < 180), 0);
}

#[test]
fn a_cell_that_cannot_be_drawn_keeps_its_row_and_is_an_error() {
    let folder = folder("over: {\"around\": [8, 16]}, keep: [Faces]");
    sheet(&folder, "--on torsu")
        .with_code(1)
        .prints(&["48", "96"])
        .complains(&[
            "error: cell 1 cannot be drawn: unknown object \"torsu\"",
            "error: cell 2 cannot be drawn",
        ]);
    assert!(folder.path("s.png").exists());
}

#[test]
fn the_bytes_do_not_depend_on_threads_budget_and_cache() {
    let folder = folder(
        "over: {\"around\": Range(from: 4, to: 32, steps: 8), \"minor\": [0.2, 0.4]}, keep: [Area]",
    )
    .with("recipe.ron", RECIPE.replace("across: 6", "across: 99"));
    let made = |more: &str| {
        sheet(
            &folder,
            &format!("--color-by MeanCurvature --wireframe {more}"),
        )
        .with_code(0);
        folder.read("s.png")
    };
    let one = made("--threads 1 --no-cache");
    // With a small memory budget, the scenes are not kept in memory. They are computed again before they are drawn.
    for more in [
        "--threads 8",
        "--threads 8",
        "--threads 3 --budget 16MiB",
        "--no-cache --budget 16MiB",
    ] {
        assert!(made(more) == one, "{more}");
    }
}

#[test]
fn invalid_options_of_the_sheet_are_refused_before_any_cell_runs() {
    let folder = folder("over: {\"around\": [8, 16]}, keep: [Faces]");
    for (arguments, complaint) in [
        (
            &["--sheet", "s.jpg"][..],
            "s.jpg: expected an image with the extension .png",
        ),
        (
            &["--sheet", "s.png", "--shading", "Flta"],
            "did you mean `Flat`?",
        ),
        (
            &["--sheet", "s.png", "--with", "turntable: ()"],
            "a sheet cannot have a turntable",
        ),
        (&["--wireframe"], "--sheet <FILE>"),
        (&["--columns", "3"], "--sheet <FILE>"),
    ] {
        let ended = folder
            .run_all(&[&["sweep", "a.sweep.ron"], arguments].concat())
            .with_code(2);
        assert_eq!(ended.stdout, "", "{arguments:?}");
        ended.complains(&[complaint]);
    }
    let ended = folder
        .run("sweep a.sweep.ron --sheet s.png --size 16000x16000")
        .with_code(1);
    assert_eq!(ended.stdout, "");
    ended.complains(&["expected an image of 1 to 16384 pixels per side"]);
    assert_eq!(folder.entries("."), ["a.sweep.ron", "recipe.ron"]);
}
