//! Colors, sizes and fonts of the window, for dark and light surroundings.

use eframe::egui::{
    self, Color32, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, Style, TextStyle,
    Theme, Vec2, Visuals,
};

/// The colors that depend on the theme.
#[derive(Clone, Copy, Debug)]
pub struct Colors {
    /// The background behind everything.
    pub base: Color32,
    /// The background of panels.
    pub panel: Color32,
    /// The background of fields and code.
    pub field: Color32,
    /// Lines between panels.
    pub line: Color32,
    /// Text.
    pub text: Color32,
    /// Text of less importance.
    pub weak: Color32,
    /// Selected items, and the item that has the focus.
    pub accent: Color32,
    /// The background of selected items.
    pub accent_fill: Color32,
    /// Success.
    pub good: Color32,
    /// Warnings.
    pub warning: Color32,
    /// Errors.
    pub bad: Color32,
    /// Picked elements.
    pub picked: Color32,
    /// Names of operations in code.
    pub code_call: Color32,
    /// Names of fields in code.
    pub code_field: Color32,
    /// Numbers in code.
    pub code_number: Color32,
    /// Texts in code.
    pub code_text: Color32,
    /// Comments in code.
    pub code_comment: Color32,
}

impl Colors {
    /// Returns the colors of a theme.
    pub const fn of(is_dark: bool) -> Self {
        let rgb = Color32::from_rgb;
        if is_dark {
            Self {
                base: rgb(0x10, 0x13, 0x18),
                panel: rgb(0x18, 0x1c, 0x23),
                field: rgb(0x11, 0x14, 0x1a),
                line: rgb(0x2a, 0x31, 0x3c),
                text: rgb(0xdc, 0xe2, 0xec),
                weak: rgb(0x8b, 0x96, 0xa8),
                accent: rgb(0x5a, 0xa2, 0xf7),
                accent_fill: rgb(0x22, 0x3b, 0x5c),
                good: rgb(0x5f, 0xc9, 0x8a),
                warning: rgb(0xe8, 0xb4, 0x4c),
                bad: rgb(0xf0, 0x6e, 0x6e),
                picked: rgb(0xff, 0x8a, 0x2b),
                code_call: rgb(0x7d, 0xc4, 0xff),
                code_field: rgb(0xb9, 0xc6, 0xd8),
                code_number: rgb(0xe9, 0xb8, 0x72),
                code_text: rgb(0x9c, 0xd6, 0x9a),
                code_comment: rgb(0x6f, 0x7a, 0x8c),
            }
        } else {
            Self {
                base: rgb(0xe6, 0xea, 0xf0),
                panel: rgb(0xf6, 0xf8, 0xfa),
                field: rgb(0xff, 0xff, 0xff),
                line: rgb(0xd3, 0xd9, 0xe2),
                text: rgb(0x1f, 0x27, 0x33),
                weak: rgb(0x5c, 0x67, 0x78),
                accent: rgb(0x1c, 0x66, 0xc8),
                accent_fill: rgb(0xcf, 0xe2, 0xfa),
                good: rgb(0x1c, 0x84, 0x4a),
                warning: rgb(0x96, 0x62, 0x00),
                bad: rgb(0xc4, 0x2c, 0x2c),
                picked: rgb(0xd4, 0x58, 0x00),
                code_call: rgb(0x0b, 0x5c, 0xad),
                code_field: rgb(0x3d, 0x4a, 0x5e),
                code_number: rgb(0x9a, 0x55, 0x00),
                code_text: rgb(0x1d, 0x75, 0x33),
                code_comment: rgb(0x7b, 0x86, 0x96),
            }
        }
    }

    /// Returns the colors of the current theme.
    pub fn current(ui: &egui::Ui) -> Self {
        Self::of(ui.visuals().dark_mode)
    }
}

/// Sets the style of both themes.
pub fn apply(ctx: &egui::Context) {
    for theme in [Theme::Dark, Theme::Light] {
        ctx.style_mut_of(theme, |style| set(style, theme == Theme::Dark));
    }
}

fn set(style: &mut Style, is_dark: bool) {
    let colors = Colors::of(is_dark);
    let mut visuals = if is_dark {
        Visuals::dark()
    } else {
        Visuals::light()
    };
    let radius = CornerRadius::same(5);
    visuals.panel_fill = colors.panel;
    visuals.window_fill = colors.panel;
    visuals.extreme_bg_color = colors.field;
    visuals.text_edit_bg_color = Some(colors.field);
    visuals.code_bg_color = colors.field;
    visuals.faint_bg_color = if is_dark {
        Color32::from_rgb(0x1d, 0x22, 0x2a)
    } else {
        Color32::from_rgb(0xee, 0xf1, 0xf5)
    };
    visuals.weak_text_color = Some(colors.weak);
    visuals.hyperlink_color = colors.accent;
    visuals.warn_fg_color = colors.warning;
    visuals.error_fg_color = colors.bad;
    visuals.selection.bg_fill = colors.accent_fill;
    visuals.selection.stroke = Stroke::new(1.0, if is_dark { colors.text } else { colors.accent });
    visuals.window_stroke = Stroke::new(1.0, colors.line);
    visuals.window_corner_radius = CornerRadius::same(9);
    visuals.menu_corner_radius = CornerRadius::same(7);
    visuals.window_shadow = Shadow {
        offset: [0, 8],
        blur: 28,
        spread: 0,
        color: Color32::from_black_alpha(if is_dark { 130 } else { 50 }),
    };
    visuals.popup_shadow = Shadow {
        offset: [0, 4],
        blur: 14,
        spread: 0,
        color: Color32::from_black_alpha(if is_dark { 110 } else { 40 }),
    };
    visuals.slider_trailing_fill = true;
    visuals.indent_has_left_vline = false;
    let raised = if is_dark {
        Color32::from_rgb(0x26, 0x2c, 0x37)
    } else {
        Color32::from_rgb(0xe7, 0xeb, 0xf1)
    };
    let hovered = if is_dark {
        Color32::from_rgb(0x30, 0x38, 0x45)
    } else {
        Color32::from_rgb(0xdb, 0xe1, 0xea)
    };
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, colors.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, colors.text);
    widgets.inactive.fg_stroke = Stroke::new(1.0, colors.text);
    widgets.inactive.bg_fill = raised;
    widgets.inactive.weak_bg_fill = raised;
    widgets.hovered.fg_stroke = Stroke::new(1.0, colors.text);
    widgets.hovered.bg_fill = hovered;
    widgets.hovered.weak_bg_fill = hovered;
    widgets.hovered.bg_stroke = Stroke::NONE;
    widgets.hovered.expansion = 0.0;
    widgets.active.fg_stroke = Stroke::new(1.0, colors.text);
    widgets.active.bg_fill = colors.accent_fill;
    widgets.active.weak_bg_fill = colors.accent_fill;
    widgets.active.bg_stroke = Stroke::new(1.0, colors.accent);
    widgets.active.expansion = 0.0;
    widgets.open.weak_bg_fill = hovered;
    widgets.open.fg_stroke = Stroke::new(1.0, colors.text);
    for widget in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        widget.corner_radius = radius;
    }
    style.visuals = visuals;
    style.spacing.item_spacing = Vec2::new(7.0, 5.0);
    style.spacing.button_padding = Vec2::new(8.0, 3.0);
    style.spacing.interact_size.y = 22.0;
    style.spacing.window_margin = Margin::same(12);
    style.spacing.slider_width = 110.0;
    style.spacing.slider_rail_height = 4.0;
    style.spacing.combo_width = 90.0;
    let font = |size, family| FontId::new(size, family);
    style.text_styles = [
        (TextStyle::Small, font(11.0, FontFamily::Proportional)),
        (TextStyle::Body, font(13.0, FontFamily::Proportional)),
        (TextStyle::Button, font(13.0, FontFamily::Proportional)),
        (TextStyle::Heading, font(16.0, FontFamily::Proportional)),
        (TextStyle::Monospace, font(12.5, FontFamily::Monospace)),
    ]
    .into();
}
