//! The tiles of the window.

use eframe::egui::{self, Ui};
use egui_tiles::{Tile, TileId, Tiles, Tree, UiResponse};

use super::Parts;
use crate::{inspector, steps_pane, text_pane, theme};

/// A tile of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pane {
    /// The steps and expectations.
    Steps,
    /// The text of the recipe.
    Text,
    /// The view of the scene.
    View,
    /// The picked elements and the parameters of a step.
    Inspector,
}

/// Returns the tiles: steps and text at the left, the view in the middle, the inspector at the right.
pub(super) fn initial() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let [steps, text, view, inspector] =
        [Pane::Steps, Pane::Text, Pane::View, Pane::Inspector].map(|pane| tiles.insert_pane(pane));
    let left = linear(
        &mut tiles,
        egui_tiles::LinearDir::Vertical,
        &[(steps, 0.52), (text, 0.48)],
    );
    let root = linear(
        &mut tiles,
        egui_tiles::LinearDir::Horizontal,
        &[(left, 0.25), (view, 0.52), (inspector, 0.23)],
    );
    Tree::new(egui::Id::unique("tiles"), root, tiles)
}

fn linear(
    tiles: &mut Tiles<Pane>,
    direction: egui_tiles::LinearDir,
    children: &[(TileId, f32)],
) -> TileId {
    let mut linear =
        egui_tiles::Linear::new(direction, children.iter().map(|(id, _)| *id).collect());
    for &(id, share) in children {
        linear.shares.set_share(id, share);
    }
    tiles.insert_new(Tile::Container(egui_tiles::Container::Linear(linear)))
}

impl egui_tiles::Behavior<Pane> for Parts {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> UiResponse {
        let colors = theme::Colors::current(ui);
        ui.painter().rect_filled(ui.max_rect(), 0.0, colors.panel);
        match pane {
            Pane::View => self.view_ui(ui),
            Pane::Steps => steps_pane::ui(ui, self),
            Pane::Text => text_pane::ui(ui, self),
            Pane::Inspector => inspector::ui(ui, self),
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        match pane {
            Pane::Steps => "Steps",
            Pane::Text => "Recipe",
            Pane::View => "View",
            Pane::Inspector => "Inspector",
        }
        .into()
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions {
            all_panes_must_have_tabs: false,
            ..egui_tiles::SimplificationOptions::default()
        }
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        1.0
    }
}
