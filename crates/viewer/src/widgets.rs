//! Small widgets and texts that several panels use.

use eframe::egui::{self, Color32, Ui, Vec2};

/// Draws a round mark.
pub(crate) fn dot(ui: &mut Ui, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(Vec2::splat(10.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, color);
}

/// Returns the total numbers of vertices, edges and faces of the meshes of a scene.
pub(crate) fn counts(scene: &scene::Scene) -> [usize; 3] {
    let meshes = scene.objects().iter().filter_map(|object| object.as_mesh());
    meshes.fold([0; 3], |[v, e, f], mesh| {
        [
            v + mesh.n_vertices(),
            e + mesh.n_edges(),
            f + mesh.n_faces(),
        ]
    })
}

/// Returns the number of faces of a scene. If the scene has no meshes, returns the number of its patches, curves or
/// polylines.
pub(crate) fn size(scene: &scene::Scene) -> String {
    let of = |kind: &scene::Geometry| match kind {
        scene::Geometry::Mesh(mesh) => [mesh.n_faces(), 0, 0, 0],
        scene::Geometry::Patches(patches) => [0, patches.len(), 0, 0],
        scene::Geometry::Curve(_) => [0, 0, 1, 0],
        scene::Geometry::Polylines(lines) => [0, 0, 0, lines.len()],
    };
    let objects = scene.objects().iter().map(|object| of(&object.geometry));
    let sums = objects.fold([0; 4], |sums, of| std::array::from_fn(|i| sums[i] + of[i]));
    let kinds = ["face", "patch", "curve", "polyline"];
    let first = sums.iter().position(|&n| n > 0).unwrap_or(0);
    let (n, kind) = (sums[first], kinds[first]);
    let plural = match (n, kind) {
        (1, _) => "",
        (_, "patch") => "es",
        _ => "s",
    };
    format!("{} {kind}{plural}", grouped(n))
}

/// Writes a count with groups of three digits.
pub(crate) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Writes a duration with a fitting unit.
pub(crate) fn duration(time: std::time::Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 1e-3 {
        format!("{:.0} µs", seconds * 1e6)
    } else if seconds < 1.0 {
        format!("{:.0} ms", seconds * 1e3)
    } else {
        format!("{seconds:.1} s")
    }
}
