//! Picture: draws the scene into an image file.
//!
//! ```text
//!   scene, selections, quantities --> view::Subject --view::Shot--> images --encode--> .png, .apng, .gif
//! ```

mod colors;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Component, Path};

use op::{
    Context, Count, Elements, Files, OpError, Operation, Plan, PlanContext, Problem, Progress,
    Report, Seconds, Selected, target_scene,
};
use render::animation::{Timing, to_apng, to_gif};
use render::{Camera, Color, Image, LARGEST_SIDE, Overlays, PictureError, Style};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use view::{ColorBy, Extent, HIGHLIGHT_COLOR, Shot, Subject, highlight};

/// Draws the scene into an image file.
///
/// The extension of the file determines the format. Without `turntable`, the picture is a single image, and the
/// extension must be `.png`. With `turntable`, the extension `.gif` gives an animated GIF, and `.apng` or `.png` gives
/// an animated PNG. The file is written only if the whole recipe succeeds. The scene does not change. Drawing needs no
/// GPU and gives the same bytes on every machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// The file. The path is relative to the output folder. If `name` is a recipe parameter whose value is a file,
    /// `{name.stem}` is replaced by the name of this file without its extension.
    pub path: String,
    /// The width and the height of each view in pixels.
    #[serde(default = "size")]
    pub size: [Count<1, LARGEST_SIDE>; 2],
    /// The camera.
    #[serde(default)]
    pub camera: Camera,
    /// Several cameras, which replace `camera`. The picture shows the views of all these cameras, side by side.
    #[serde(default)]
    pub views: Vec<Camera>,
    /// The number of views in each row of the picture. If omitted, up to 4 views share one row, and more views are
    /// placed in rows of 4.
    #[serde(default)]
    pub columns: Option<Count<1, 64>>,
    /// The style: shading, lines, background.
    #[serde(default)]
    pub style: Style,
    /// Elements to highlight in orange, as in `Edges(Sharp(above: 30))` or `Faces(Tagged("top"))`.
    #[serde(default)]
    pub highlight: Option<Elements>,
    /// The width of highlighted edges and the diameter of highlighted vertices, in pixels. The defaults grow with the
    /// shorter side of a view. For a side of 240 pixels, the width is 2.8 and the diameter is 7.5. The width and the
    /// diameter are 3.4 and 10 for 480 pixels, 4 and 13 for 960 pixels, and 8 and 26 for 1920 pixels. If there are many
    /// highlighted vertices, their default diameter is smaller. Edges behind a surface are drawn faintly, and vertices
    /// behind a surface are drawn as rings.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub highlight_width: Option<f64>,
    /// More selections of elements to highlight, each with its own color.
    #[serde(default)]
    pub marks: Vec<Mark>,
    /// The quantity to show as colors of the surface.
    #[serde(default)]
    pub color_by: Option<ColorBy>,
    /// If given, the picture is an animation in which the camera moves once around the scene.
    #[serde(default)]
    pub turntable: Option<Turntable>,
    /// The folder of texture images that are not stored next to their model. The path is relative to the folder of the
    /// recipe. If omitted, the folder of the recipe. Missing images are not drawn, and the report lists them.
    #[serde(default)]
    pub images: Option<String>,
}

/// Elements to highlight in a color.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// The elements.
    pub of: Elements,
    /// The color.
    #[serde(default = "highlight_color")]
    pub color: Color,
    /// The width of edges and the diameter of vertices, in pixels. The defaults are the same as for `highlight_width`.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub width: Option<f64>,
}

/// An animation of one turn around the scene.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Turntable {
    /// The number of images.
    #[serde(default = "frames")]
    pub frames: Count<2, 720>,
    /// The duration of the turn, in seconds.
    #[serde(default = "seconds")]
    pub seconds: Seconds,
}

fn size() -> [Count<1, LARGEST_SIDE>; 2] {
    [1280, 960].map(Count::literal)
}

fn highlight_color() -> Color {
    HIGHLIGHT_COLOR
}

fn frames() -> Count<2, 720> {
    Count::literal(36)
}

fn seconds() -> Seconds {
    Seconds::literal(4.0)
}

/// The formats of pictures.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Format {
    Png,
    Apng,
    Gif,
}

impl Format {
    /// Returns the format for the extension of a path.
    fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Png),
            "apng" => Some(Self::Apng),
            "gif" => Some(Self::Gif),
            _ => None,
        }
    }
}

impl Picture {
    /// Creates the step with the file `path`, and defaults for all other parameters.
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            size: size(),
            camera: Camera::default(),
            views: Vec::new(),
            columns: None,
            style: Style::default(),
            highlight: None,
            highlight_width: None,
            marks: Vec::new(),
            color_by: None,
            turntable: None,
            images: None,
        }
    }

    /// Returns the problems with the parameters. Only problems that can be found without the scene are returned.
    fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        match Format::of(Path::new(&self.path)) {
            None => {
                let message = format!("unknown picture format of \"{}\"", self.path);
                let help = "use the extension .png, .apng or .gif";
                problems.push(Problem::error(message).at(["path"]).help(help));
            }
            Some(Format::Apng | Format::Gif) if self.turntable.is_none() => {
                let message = format!("the animation \"{}\" needs `turntable`", self.path);
                let help = "add `turntable: ()`, or use the extension .png";
                problems.push(Problem::error(message).at(["path"]).help(help));
            }
            Some(_) => {}
        }
        let style = self.style.check().err().map(|error| (error, "style"));
        let cameras = self.cameras().iter().filter_map(|c| c.check().err());
        for (error, field) in style.into_iter().chain(cameras.map(|e| (e, "camera"))) {
            problems.push(Problem::error(error.to_string()).at([field]));
        }
        problems
    }

    /// Returns the cameras of `views`, or `camera` if `views` is empty.
    fn cameras(&self) -> &[Camera] {
        if self.views.is_empty() {
            std::slice::from_ref(&self.camera)
        } else {
            &self.views
        }
    }

    /// Draws scenes side by side at the same scale. Each scene has a caption, which can be empty. Returns one image, or
    /// the images of a turntable, and notes about parts of the scene that are not drawn.
    ///
    /// If the [`Extent`] `within` is given, [`Camera::Fit`] shows the whole region of this extent, not only the drawn
    /// scenes. If `color_by` has no range, the color range of `within` is used. The images have no legend, because the
    /// caller draws one [common legend](Extent::legend) for all scenes.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Parameter`] or [`OpError::File`] if a parameter is invalid, and [`OpError::Budget`] if the
    /// images need more memory than the budget of `cx`. Also returns the errors of the selections, and
    /// [`OpError::Cancelled`].
    pub fn draw(
        &self,
        scenes: &[(&Scene, &str)],
        within: Option<&Extent>,
        cx: &mut Context,
    ) -> Result<(Vec<Image>, Vec<String>), OpError> {
        self.check()?;
        let mut color_by = self.color_by.clone();
        if let (Some(color_by), Some(extent)) = (&mut color_by, within) {
            color_by.range = color_by.range.or(extent.range());
            color_by.legend = false;
        }
        let shot = self.shot(cx.budget);
        shot.check_budget(scenes.len()).map_err(op_error)?;
        cx.advance("draw", 0, 1)?;
        let target_scenes: Vec<_> = (scenes.iter())
            .map(|(scene, caption)| (target_scene(scene, cx), *caption))
            .collect();
        let placed_scenes = target_scenes.iter().map(|(scene, _)| placed(scene, cx));
        let placed_scenes: Vec<_> = placed_scenes.collect::<Result<_, _>>()?;
        let (mut subjects, mut notes) = (Vec::new(), Vec::new());
        for ((scene, caption), placed) in target_scenes.iter().zip(&placed_scenes) {
            let (subject, scene_notes) =
                self.subject(scene, placed, caption, color_by.as_ref(), true, cx)?;
            subjects.push(subject);
            notes.extend(scene_notes);
        }
        notes.dedup();
        let images = shot.draw(&subjects, within, cx.progress());
        Ok((images.map_err(op_error)?, notes))
    }

    /// Returns the [`Extent`] of a scene: its view and its color range. If the extents of several scenes are joined,
    /// the scenes can be drawn one after the other in the same view, scale and colors. The scenes then need not be in
    /// memory at the same time.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`draw`](Self::draw).
    pub fn extent(&self, scene: &Scene, cx: &mut Context) -> Result<Extent, OpError> {
        self.check()?;
        let scene = target_scene(scene, cx);
        // The images of materials do not change the extent, so `extent` does not read them.
        let placed = placed(&scene, cx)?;
        let (subject, _) = self.subject(&scene, &placed, "", self.color_by.as_ref(), false, cx)?;
        self.shot(cx.budget).extent(subject).map_err(op_error)
    }

    fn shot(&self, budget: u64) -> Shot<'_> {
        Shot {
            size: self.size.map(Count::get),
            cameras: self.cameras(),
            columns: self.columns.map(Count::get),
            style: &self.style,
            frames: self.turntable.map_or(1, |turn| turn.frames.get()),
            budget,
        }
    }

    /// Prepares a scene for drawing, with its highlights and the colors of `color_by`. Also returns notes about parts
    /// of the scene that are not drawn. `placed` is the scene in which every instance is a separate object: an object
    /// that several nodes show becomes several objects. Selections of elements are evaluated in the local coordinates
    /// of each object.
    fn subject<'s>(
        &self,
        scene: &Scene,
        placed: &'s Scene,
        caption: &'s str,
        color_by: Option<&ColorBy>,
        has_images: bool,
        cx: &mut Context,
    ) -> Result<(Subject<'s>, Vec<String>), OpError> {
        let numbers = match color_by {
            Some(by) => {
                let targets = colors::distance_targets(by, cx)?;
                Some(by.numbers(placed, &targets).map_err(op_error)?)
            }
            None => None,
        };
        let mut overlays = Overlays::default();
        let instances = scene.instances();
        let mut instances_of: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for instance in &instances {
            let names = instances_of.entry(&instance.object.name).or_default();
            names.push(&instance.name);
        }
        let first = (self.highlight.iter()).map(|of| (of, HIGHLIGHT_COLOR, self.highlight_width));
        let marks = self.marks.iter().map(|m| (&m.of, m.color, m.width));
        for (of, color, width) in first.chain(marks) {
            for (object, mesh) in scene
                .objects()
                .iter()
                .filter_map(|o| Some((o, o.as_mesh()?)))
            {
                cx.set_object(scene, &object.name);
                let selected = of.resolve(mesh, cx);
                cx.clear_object();
                let elements = match selected? {
                    Selected::Vertices(list) => render::Elements::Vertices(list),
                    Selected::Edges(list) => render::Elements::Edges(list),
                    Selected::Faces(list) => render::Elements::Faces(list),
                };
                let size = self.size.map(Count::get);
                for name in &instances_of[object.name.as_str()] {
                    let elements = elements.clone();
                    let highlight = highlight(name, elements, color, width, size);
                    overlays.highlights.push(highlight);
                }
            }
        }
        let mut notes: Vec<String> = self.no_mesh_note(scene).into_iter().collect();
        let folder = self.images.as_deref();
        let read = |path: &str| read_image(cx.files(), folder, path);
        let mut images = |path: &str| if has_images { read(path) } else { None };
        let (style, budget) = (&self.style, cx.budget);
        let subject = Subject::new(
            placed,
            caption,
            style,
            overlays,
            numbers,
            budget,
            &mut images,
        );
        let (subject, missing) = subject.map_err(op_error)?;
        let note = |reason| format!("a texture is not drawn: {reason}");
        notes.extend(missing.into_iter().map(note));
        Ok((subject, notes))
    }

    /// Returns a note if there are highlights, but no mesh with elements to highlight.
    fn no_mesh_note(&self, scene: &Scene) -> Option<String> {
        let has_marks = self.highlight.is_some() || !self.marks.is_empty();
        let has_mesh = scene.objects().iter().any(|o| o.as_mesh().is_some());
        (has_marks && !has_mesh && !scene.objects().is_empty()).then(|| {
            "nothing is highlighted, because only elements of meshes can be highlighted and the scene has no mesh; use \
             `style: (points: 8)` to show the points of polylines, or `style: (control_nets: ())` to show \
             control points"
                .to_owned()
        })
    }

    /// Returns the first problem of the parameters as an error.
    fn check(&self) -> Result<(), OpError> {
        match self.problems().into_iter().next() {
            Some(problem) => Err(OpError::Parameter(problem.message)),
            None => Ok(()),
        }
    }

    /// Encodes images as a file in the format of the path. `stamp` is the provenance: a line of text about the origin
    /// of the file. This line is stored in the file.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Encode`] if the number of images is wrong, or if the images are too large for the
    /// format. Also returns [`PictureError::Cancelled`].
    pub fn encode(
        &self,
        images: &[Image],
        stamp: Option<&str>,
        progress: &dyn Progress,
    ) -> Result<Vec<u8>, PictureError> {
        let texts: Vec<(&str, &str)> = stamp.iter().map(|stamp| ("Software", *stamp)).collect();
        let Some(turn) = self.turntable else {
            return if let [image] = images {
                image.to_png_with_progress(&texts, progress)
            } else {
                let message = format!("expected 1 image, found {}", images.len());
                Err(PictureError::Encode(message))
            };
        };
        let delay = 1000.0 * turn.seconds.get() / f64::from(turn.frames.get());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the range of u16"
        )]
        let delay = delay.round().clamp(1.0, f64::from(u16::MAX)) as u16;
        let timing = Timing { delay, plays: 0 };
        match Format::of(Path::new(&self.path)) {
            Some(Format::Gif) => to_gif(images, timing, stamp, progress),
            _ => to_apng(images, timing, &texts, progress),
        }
    }
}

impl Operation for Picture {
    const NAME: &'static str = "Picture";
    const SUMMARY: &'static str = "Draw the scene into an image file";
    const EXAMPLE: &'static str = r#"Picture(path: "a.png", size: (64, 48), highlight: Edges(Sharp(above: 30)), color_by: (of: Valence), style: (wireframe: ()))"#;
    const WORDS: &'static [&'static str] = &["render", "draw", "screenshot", "image", "color"];
    const TAKES_ON: bool = true;
    const ATOMIC: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = self.problems();
        problems.extend(plan.write(cx, &self.path, |_| None));
        if let Some(color_by) = &self.color_by {
            problems.extend(colors::plan(color_by, plan, cx));
        }
        let bytes = 4 * self.shot(cx.budget).n_pixels();
        if bytes > cx.budget {
            let message = format!(
                "the images take {}, which exceeds the memory budget of {}",
                op::readable_bytes(bytes),
                op::readable_bytes(cx.budget)
            );
            problems.push(Problem::error(message).at(["size"]));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let path = cx.files().to_write(&self.path);
        let path = path.map_err(|e| cx.files().output_error(e))?;
        let (images, notes) = self.draw(&[(scene, "")], None, cx)?;
        let files = cx.files();
        let stamp = files.provenance.as_deref();
        let bytes = self.encode(&images, stamp, cx.progress());
        let bytes = bytes.map_err(op_error)?;
        let written = files.store.write(&path, &bytes);
        written.map_err(|e| files.output_error(e))?;
        Ok(Report {
            notes,
            ..Report::default()
        })
    }
}

/// Returns a scene in which every instance is a separate object in scene space. An instance is an object at the place
/// where one node shows it.
fn placed<'s>(scene: &'s Scene, cx: &Context) -> Result<Cow<'s, Scene>, OpError> {
    let bytes = scene.placed_bytes();
    if !scene.graph().is_empty() && bytes > cx.budget {
        let message = format!(
            "the instances of the objects need {} of memory, but the memory budget is {}",
            op::readable_bytes(bytes),
            op::readable_bytes(cx.budget)
        );
        return Err(OpError::Budget(message));
    }
    Ok(scene.placed())
}

/// Reads the image file of a material. Returns `None` if the file cannot be read, if `path` is a URL, or if `path`
/// leads out of `folder`.
fn read_image(files: &Files, folder: Option<&str>, path: &str) -> Option<Vec<u8>> {
    let is_inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if path.contains("://") || !Path::new(path).components().all(is_inside) {
        return None;
    }
    let full = match folder {
        Some(folder) => files.to_read(&format!("{folder}/{path}")),
        None => files.to_read(path),
    };
    if files.store.is_file(&full) {
        files.has_read(&full);
        files.store.read(&full).ok()
    } else {
        files.has_checked_existence(&full);
        None
    }
}

fn op_error(error: PictureError) -> OpError {
    match error {
        PictureError::Cancelled => OpError::Cancelled,
        PictureError::Budget { .. } => OpError::Budget(error.to_string()),
        error => OpError::Parameter(error.to_string()),
    }
}
