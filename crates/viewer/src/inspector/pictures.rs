//! The pictures of operations: an example before and after each operation.

use eframe::egui::{ColorImage, Context, Id, Image, TextureHandle, TextureOptions, Ui, Vec2};

/// The name of an operation, and two PNG files: an example mesh before the operation, and after it.
type Pictures = (&'static str, Option<&'static [u8]>, Option<&'static [u8]>);

const PICTURES: &[Pictures] = &include!(concat!(env!("OUT_DIR"), "/pictures.rs"));

/// Draws the pictures of an operation side by side. Draws nothing for an operation without pictures, such as an
/// operation that is not built in.
pub(super) fn ui(ui: &mut Ui, operation: &str) {
    let files = files(operation);
    if files.is_empty() {
        return;
    }
    let textures = textures(ui.ctx(), operation, &files);
    let width = (ui.available_width() - ui.spacing().item_spacing.x) / 2.0;
    ui.horizontal(|ui| {
        for (texture, (_, title)) in textures.iter().zip(files) {
            let image = Image::new(texture)
                .max_size(Vec2::splat(width))
                .corner_radius(4);
            let text = format!("An example {title} {operation}");
            ui.add(image.alt_text(&text)).on_hover_text(text);
        }
    });
}

/// Returns the PNG files of an operation, each with its title.
fn files(operation: &str) -> Vec<(&'static [u8], &'static str)> {
    let of = PICTURES.iter().find(|(name, ..)| *name == operation);
    let titled = |file: Option<&'static [u8]>, title| file.map(|file| (file, title));
    let files = of.map(|&(_, before, after)| [titled(before, "before"), titled(after, "after")]);
    files.into_iter().flatten().flatten().collect()
}

/// Returns the decoded pictures. The decoded pictures stay in memory while the window shows the same operation.
fn textures(ctx: &Context, operation: &str, files: &[(&[u8], &str)]) -> Vec<TextureHandle> {
    let id = Id::unique("pictures of an operation");
    let kept: Option<(String, Vec<TextureHandle>)> = ctx.data(|data| data.get_temp(id));
    if let Some((_, textures)) = kept.filter(|(of, _)| of == operation) {
        return textures;
    }
    let load = |&(file, title): &(&[u8], &str)| {
        let image = render::Image::from_png(file).ok()?;
        let size = [image.width as usize, image.height as usize];
        let image = ColorImage::from_rgba_unmultiplied(size, image.pixels.as_flattened());
        Some(ctx.load_texture(title, image, TextureOptions::LINEAR))
    };
    let textures: Vec<_> = files.iter().filter_map(load).collect();
    ctx.data_mut(|data| data.insert_temp(id, (operation.to_owned(), textures.clone())));
    textures
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_belongs_to_an_operation() {
        let registry = ops_all::registry();
        for (name, _, after) in PICTURES {
            assert!(
                registry.entries().iter().any(|entry| entry.name == *name),
                "{name}"
            );
            let after = after.unwrap_or_else(|| panic!("{name} has no picture after it"));
            assert!(render::Image::from_png(after).is_ok(), "{name}");
        }
        assert!(PICTURES.len() > 70);
    }
}
