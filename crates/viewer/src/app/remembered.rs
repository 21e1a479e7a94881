//! The layout of the window, which is stored in the file `window.ron` in the state folder.

use std::path::Path;

use eframe::egui::{self, Theme, ThemePreference};
use egui_tiles::{Container, Linear, Tile, TileId, Tree};
use serde::Deserialize;

use super::App;
use super::layout::Pane;

/// The name of the file in the state folder.
pub(super) const FILE: &str = "window.ron";

/// The layout of the window. If the file is missing or cannot be parsed, all values are the defaults.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(default)]
pub(crate) struct Remembered {
    /// The width and height of the window, in logical pixels.
    pub(crate) size: Option<[f32; 2]>,
    /// Whether the window fills the screen.
    pub(crate) is_maximized: bool,
    /// Whether the window has the dark theme. If omitted, the window has the theme of the system.
    is_dark: Option<bool>,
    /// The heights of the steps and of the text, as fractions of the height of the left side.
    left: Option<[f32; 2]>,
    /// The widths of the left side, the view and the inspector, as fractions of the width of the window.
    columns: Option<[f32; 3]>,
}

impl Remembered {
    /// Reads the layout from the state folder.
    pub(crate) fn read(state_folder: Option<&Path>) -> Self {
        let text = state_folder.and_then(|folder| std::fs::read_to_string(folder.join(FILE)).ok());
        let read = text.and_then(|text| ron_tree::from_str::<Self>(&text).ok());
        let mut read = read.unwrap_or_default();
        let is_good = |share: &f32| (0.02..=1.0).contains(share);
        read.left = read.left.filter(|all| all.iter().all(is_good));
        read.columns = read.columns.filter(|all| all.iter().all(is_good));
        read.size = read
            .size
            .filter(|size| size.iter().all(|side| (200.0..20_000.0).contains(side)));
        read
    }

    fn text(&self) -> String {
        let Self {
            size,
            is_maximized,
            is_dark,
            left,
            columns,
        } = self;
        let list = |numbers: Option<&[f32]>| match numbers {
            Some(numbers) => {
                let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.3}")).collect();
                format!("Some(({}))", numbers.join(", "))
            }
            None => "None".to_owned(),
        };
        format!(
            "(\n    size: {},\n    is_maximized: {is_maximized},\n    is_dark: {is_dark:?},\n    left: {},\n    columns: {},\n)\n",
            list(size.as_ref().map(|all| &all[..])),
            list(left.as_ref().map(|all| &all[..])),
            list(columns.as_ref().map(|all| &all[..])),
        )
    }

    /// Applies the layout to a new window.
    pub(super) fn apply(&self, ctx: &egui::Context, tree: &mut Tree<Pane>) {
        if let Some(is_dark) = self.is_dark {
            ctx.set_theme(if is_dark { Theme::Dark } else { Theme::Light });
        }
        if let (Some([left, columns]), Some(shares)) = (containers(tree), self.left) {
            set_shares(tree, left, &shares);
            if let Some(shares) = self.columns {
                set_shares(tree, columns, &shares);
            }
        }
    }

    /// Returns the layout of a window. Values that are not known are taken from `before`.
    fn of(ctx: &egui::Context, tree: &Tree<Pane>, before: &Self) -> Self {
        let (size, is_maximized) = ctx.input(|input| {
            let viewport = input.viewport();
            let size = viewport.inner_rect.map(|rect| rect.size().round().into());
            (size, viewport.maximized.unwrap_or(false))
        });
        let [left, columns] = match containers(tree) {
            Some(ids) => ids.map(|id| shares(tree, id)),
            None => [None, None],
        };
        Self {
            size: size.filter(|_| !is_maximized).or(before.size),
            is_maximized,
            is_dark: match ctx.options(|options| options.theme_preference) {
                ThemePreference::Dark => Some(true),
                ThemePreference::Light => Some(false),
                ThemePreference::System => None,
            },
            left: left.and_then(|shares| shares.try_into().ok()),
            columns: columns.and_then(|shares| shares.try_into().ok()),
        }
    }
}

impl App {
    /// Writes the layout of the window if it has changed.
    pub(super) fn remember(&mut self, ctx: &egui::Context) {
        if ctx.input(|input| input.pointer.any_down()) {
            return;
        }
        let now = Remembered::of(ctx, &self.tree, &self.remembered);
        if now != self.remembered {
            self.parts.files.write(FILE, &now.text());
            self.remembered = now;
        }
    }
}

/// Returns two containers of tiles: the left side with the steps and the text, and the row of all columns.
fn containers(tree: &Tree<Pane>) -> Option<[TileId; 2]> {
    let left = tree.tiles.parent_of(tree.tiles.find_pane(&Pane::Steps)?)?;
    let columns = tree.tiles.parent_of(tree.tiles.find_pane(&Pane::View)?)?;
    (left != columns).then_some([left, columns])
}

fn linear(tree: &Tree<Pane>, id: TileId) -> Option<&Linear> {
    match tree.tiles.get(id)? {
        Tile::Container(Container::Linear(linear)) => Some(linear),
        _ => None,
    }
}

/// Returns the size of each tile in a container, as a fraction of the size of the container, rounded to three decimals.
fn shares(tree: &Tree<Pane>, id: TileId) -> Option<Vec<f32>> {
    let linear = linear(tree, id)?;
    let all: Vec<f32> = linear
        .children
        .iter()
        .map(|&id| linear.shares[id])
        .collect();
    let sum: f32 = all.iter().sum();
    Some(all.iter().map(|x| (x / sum * 1e3).round() / 1e3).collect())
}

fn set_shares(tree: &mut Tree<Pane>, id: TileId, shares: &[f32]) {
    if let Some(Tile::Container(Container::Linear(linear))) = tree.tiles.get_mut(id) {
        let children = linear.children.clone();
        for (child, share) in children.into_iter().zip(shares) {
            linear.shares.set_share(child, *share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::layout;

    #[test]
    fn a_written_layout_reads_back_and_a_broken_file_is_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let all = Remembered {
            size: Some([1000.0, 700.0]),
            is_maximized: true,
            is_dark: Some(false),
            left: Some([0.3, 0.7]),
            columns: Some([0.2, 0.5, 0.3]),
        };
        for (layout, expected) in [
            (all.text(), all),
            (Remembered::default().text(), Remembered::default()),
            ("(size: 7".to_owned(), Remembered::default()),
            (
                "(size: Some((1e9, 3)), columns: Some((-1, 0, 9)))".to_owned(),
                Remembered::default(),
            ),
        ] {
            std::fs::write(folder.path().join(FILE), &layout).unwrap();
            let read = Remembered::read(Some(folder.path()));
            assert_eq!(read, expected, "{layout}");
        }
        let ctx = egui::Context::default();
        let mut tree = layout::initial();
        all.apply(&ctx, &mut tree);
        let now = Remembered::of(&ctx, &tree, &all);
        let expected = Remembered {
            is_maximized: false,
            ..all
        };
        assert_eq!(now, expected);
    }
}
