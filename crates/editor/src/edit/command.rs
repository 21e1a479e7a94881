//! Commands: a command is an operation with its parameters and a selection. A command becomes one or two steps of the
//! recipe's text.

use op::ElementKind;
use ron_tree::{parse, string_literal};
use scene::Geometry;

use super::Editor;
use crate::keys::Action;
use crate::panel::{FieldKind, Panel, PanelField};
use crate::text::{self, TextError};

/// An operation that is to be inserted as a step at the step cursor, which is a position between two steps of the
/// recipe.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Command {
    /// The name of the operation.
    pub operation: String,
    /// The names of the parameters, and their values as RON.
    pub parameters: Vec<(String, String)>,
    /// The selection of the elements on which the operation works. If the command gives no value to the first parameter
    /// that selects elements, this selection becomes the value of that parameter.
    pub selection: Option<SelectionText>,
    /// The object that the step acts on. If `None`, the step usually acts on all objects. But if the scene has several
    /// meshes and the command has a selection, the step acts only on the object of the selection.
    pub on: Option<String>,
}

/// A selection for a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SelectionText {
    /// The kind of elements that the selection selects.
    pub kind: ElementKind,
    /// The selection as RON.
    pub text: String,
    /// If the selection uses a new tag, the step that gives this tag to the elements. This step must be inserted before
    /// the command's step.
    pub before: Option<String>,
    /// The name of the object.
    pub object: String,
}

/// Why a command cannot be applied.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CommandError {
    /// The registry does not have the operation.
    #[error("the operation `{0}` does not exist")]
    Unknown(String),
    /// The operation needs a selection, but no elements are picked.
    #[error("{operation} needs {kind}: pick some first")]
    NothingPicked {
        /// The operation.
        operation: String,
        /// The kind of elements.
        kind: &'static str,
    },
    /// A parameter of the operation is unknown or missing, or has an invalid value.
    #[error("{operation}: {message}")]
    Parameter {
        /// The operation.
        operation: String,
        /// The name of the parameter. Empty if the problem is not about one parameter.
        field: String,
        /// The problem.
        message: String,
    },
    /// The scene after the last step before the step cursor is not known, because the run has not ended or has failed.
    #[error(
        "the scene at the step cursor is not known: wait until the run ends or, if the run failed, correct the recipe"
    )]
    NoScene,
    /// The object does not exist, or is neither a curve nor a set of patches.
    #[error("the scene at the step cursor has no curve and no patches with the name \"{0}\"")]
    NoControlPoints(String),
    /// The text cannot be edited.
    #[error(transparent)]
    Text(#[from] TextError),
}

impl SelectionText {
    /// Returns the selection for a command with the operation `name`. If the step `before` has the same operation (for
    /// example, `TagFaces`), two steps would tag the same elements. In this case, the returned selection lists these
    /// elements and needs no step before it. For all other operations, returns a copy of `self`.
    fn without_tag(&self, name: &str) -> Self {
        let elements = self.before.as_deref().and_then(|before| {
            let step = parse(before).value;
            step.name().filter(|(operation, _)| *operation == name)?;
            let elements = step.fields().iter().find(|f| &*f.name.text != "name")?;
            Some(elements.value.span.of(before).to_owned())
        });
        elements.map_or_else(
            || self.clone(),
            |text| Self {
                text,
                before: None,
                ..self.clone()
            },
        )
    }
}

impl Command {
    /// Creates a command without parameters.
    pub fn new(operation: &str) -> Self {
        Self {
            operation: operation.to_owned(),
            ..Self::default()
        }
    }

    /// Adds a parameter to the command. `value` is the value of the parameter as RON.
    #[must_use]
    pub fn with(mut self, name: &str, value: &str) -> Self {
        self.parameters.push((name.to_owned(), value.to_owned()));
        self
    }
}

/// Operations that do not change the ids of the existing elements. After a command with one of these operations, the
/// picked elements stay picked.
const KEEPS_IDS: &[&str] = &[
    "FlipEdges",
    "SplitEdges",
    "PokeFaces",
    "ExtrudeFaces",
    "InsetFaces",
    "MoveVertices",
    "Smooth",
    "Displace",
    "Bend",
    "Twist",
    "Taper",
    "Lattice",
    "Project",
    "Transform",
    "Crease",
    "VertexNormals",
    "Tangents",
    "Unwrap",
    "PackUvs",
    "Transfer",
    "Measure",
    "TagVertices",
    "TagEdges",
    "TagFaces",
    "Save",
    "Picture",
    "UvPicture",
    "HalfEdgeFigure",
];

impl Editor {
    /// Returns the selection that describes the picked elements, for use in a command.
    pub fn selection(&mut self) -> Option<SelectionText> {
        let proposal = self.proposal()?.clone();
        let picked = self.picked.as_ref()?;
        Some(SelectionText {
            kind: picked.kind(),
            text: proposal.text,
            before: proposal.before,
            object: picked.object.clone(),
        })
    }

    /// Returns the command of an action, such as `FlipEdges` for [`Action::Flip`]. If the operation acts on elements,
    /// the command contains the selection of the picked elements. Returns `None` if the action does not start an
    /// operation.
    pub fn command_of(&mut self, action: Action) -> Option<Command> {
        let kind = self.picked.as_ref().map(crate::Picked::kind);
        let command = match action {
            Action::Flip => Command::new("FlipEdges"),
            Action::Split => Command::new("SplitEdges"),
            Action::Collapse => Command::new("CollapseEdges"),
            Action::Extrude => Command::new("ExtrudeFaces").with("by", &self.extrusion()),
            Action::Dissolve if kind == Some(ElementKind::Vertices) => {
                Command::new("DissolveVertices")
            }
            Action::Dissolve => Command::new("DissolveEdges"),
            Action::Loop => Command::new("LoopSubdivide").with("levels", "1"),
            Action::CatmullClark => Command::new("CatmullClark").with("levels", "1"),
            _ => return None,
        };
        let is_whole = matches!(action, Action::Loop | Action::CatmullClark);
        let selection = if is_whole { None } else { self.selection() };
        Some(Command {
            selection,
            ..command
        })
    }

    /// Returns the initial distance of a new extrusion: a fifth of the size of the object to which the picked elements
    /// belong. The user can then change the distance.
    fn extrusion(&self) -> String {
        let object = self
            .picked()
            .and_then(|picked| self.shown.object(&picked.object));
        let size = object
            .and_then(|object| object.as_mesh())
            .map_or(1.0, |mesh| {
                let (mut low, mut high) = (mesh::DVec3::INFINITY, mesh::DVec3::NEG_INFINITY);
                for &p in mesh.positions() {
                    (low, high) = (low.min(p), high.max(p));
                }
                (high - low).max_element()
            });
        let distance = if size.is_finite() && size > 0.0 {
            size / 5.0
        } else {
            0.2
        };
        let short: f64 = format!("{distance:.0e}").parse().unwrap_or(0.2);
        format!("Distance({})", crate::panel::number(short))
    }

    /// Returns the steps that a command inserts.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError`] if the operation does not exist, a parameter has a problem, or a selection is missing.
    pub fn steps_of(&self, command: &Command) -> Result<Vec<String>, CommandError> {
        let name = &command.operation;
        let entry = self
            .registry()
            .get(name)
            .ok_or_else(|| CommandError::Unknown(name.clone()))?;
        let mut panel = Panel::new(entry);
        for (field, value) in &command.parameters {
            if panel.field(field).is_none() {
                let known = panel.fields.iter().map(|field| field.name.as_str());
                let help = recipe::did_you_mean(field, known);
                return Err(CommandError::Parameter {
                    operation: name.clone(),
                    field: field.clone(),
                    message: format!("unknown parameter `{field}`; {help}"),
                });
            }
            panel.set(field, Some(value));
        }
        let mut before = None;
        let mut object = None;
        if let Some((field, kind)) = unset_selection(&panel) {
            let field = field.clone();
            match &command.selection {
                Some(selection) => {
                    let selection = &selection.without_tag(name);
                    let text =
                        converted(selection, kind).ok_or_else(|| CommandError::NothingPicked {
                            operation: name.clone(),
                            kind: kind.map_or("elements", ElementKind::word),
                        })?;
                    // The selection is written before all other parameters, as in recipes that people write.
                    let others: Vec<(String, String)> = command.parameters.clone();
                    for (other, _) in &others {
                        panel.set(other, None);
                    }
                    panel.set(&field.name, Some(&text));
                    for (other, value) in &others {
                        panel.set(other, Some(value));
                    }
                    before.clone_from(&selection.before);
                    object = Some(selection.object.clone());
                }
                None if field.is_missing() => {
                    return Err(CommandError::NothingPicked {
                        operation: name.clone(),
                        kind: kind.map_or("elements", ElementKind::word),
                    });
                }
                None => {}
            }
        }
        if let Some((field, problem)) = panel.problems().into_iter().next() {
            return Err(CommandError::Parameter {
                operation: name.clone(),
                field,
                message: problem.message,
            });
        }
        let meshes = self
            .shown
            .objects()
            .iter()
            .filter(|object| object.as_mesh().is_some())
            .count();
        let on = object.filter(|_| entry.takes_on && meshes > 1);
        let on = command.on.clone().or(on);
        let placed = |step: String| match &on {
            Some(object) => format!("(run: {step}, on: [{}])", string_literal(object)),
            None => step,
        };
        Ok(before
            .into_iter()
            .chain([panel.step_text()])
            .map(placed)
            .collect())
    }

    /// Inserts the steps of a command at the step cursor, moves the cursor to the position after these steps, and runs
    /// the recipe.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError`] if the command cannot be applied. The text is then unchanged. The selection of a
    /// command selects elements of the scene after the last step before the step cursor. If this scene is not known, a
    /// command with a selection cannot be applied.
    pub fn apply(&mut self, command: &Command) -> Result<(), CommandError> {
        if command.selection.is_some() && self.preview.is_none() && !self.view().is_current {
            return Err(CommandError::NoScene);
        }
        let steps = self.steps_of(command)?;
        let cursor = self.cursor() + steps.len();
        let edits = text::insert_steps(self.text(), &self.outline, self.cursor(), &steps)?;
        self.edit(edits, &command.operation, Some(cursor))?;
        let keeps_ids = KEEPS_IDS.contains(&command.operation.as_str());
        let picked = self.picked.take().filter(|_| keeps_ids);
        self.set_picked(picked);
        Ok(())
    }

    /// Returns the names of the objects in the viewed scene that consist of Bezier patches.
    pub fn patches(&self) -> Vec<&str> {
        let objects = self.shown.objects().iter();
        let patches = objects.filter(|object| matches!(object.geometry, Geometry::Patches(_)));
        patches.map(|object| object.name.as_str()).collect()
    }

    /// Inserts the steps `Tessellate` and `Weld` after the step cursor. These two steps turn all Bezier patches of the
    /// scene into meshes, whose elements can be picked.
    ///
    /// # Errors
    ///
    /// Returns [`CommandError::Text`] if the text cannot be edited.
    pub fn turn_into_mesh(&mut self) -> Result<(), CommandError> {
        let patches = self.patches();
        let is_all = patches.len() == self.shown.objects().len();
        let names: Vec<String> = patches.into_iter().map(string_literal).collect();
        let steps = ["Tessellate()", "Weld(distance: 0)"].map(|step| {
            if is_all {
                step.to_owned()
            } else {
                format!("(run: {step}, on: [{}])", names.join(", "))
            }
        });
        let cursor = self.cursor() + steps.len();
        let edits = text::insert_steps(self.text(), &self.outline, self.cursor(), &steps)?;
        self.edit(edits, "turn into a mesh", Some(cursor))
    }

    /// Runs a command as a live preview, without writing it to the text. [`end_preview`](Self::end_preview) ends the
    /// preview.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`apply`](Self::apply).
    pub fn preview(&mut self, command: &Command) -> Result<(), CommandError> {
        let steps = self.steps_of(command)?;
        let edits = text::insert_steps(self.text(), &self.outline, self.cursor(), &steps)?;
        self.preview_edits(edits)?;
        self.preview_steps = steps.len();
        Ok(())
    }
}

/// Returns the first parameter that selects elements, and the kind of elements that it selects. A command sets this
/// parameter to the selection of the picked elements. Returns `None` if no parameter selects elements, or if the first
/// parameter that selects elements already has a value.
fn unset_selection(panel: &Panel) -> Option<(&PanelField, Option<ElementKind>)> {
    let first = panel
        .fields
        .iter()
        .find_map(|field| match field.kind.inner() {
            FieldKind::Selection(kind) => Some((field, *kind)),
            _ => None,
        });
    first.filter(|(field, _)| field.value.is_none())
}

impl Panel {
    /// Whether the operation takes picked elements of this kind directly, without a conversion to another kind of
    /// elements.
    pub fn takes_picked(&self, kind: ElementKind) -> bool {
        unset_selection(self).is_some_and(|(_, wanted)| wanted.is_none_or(|wanted| wanted == kind))
    }

    /// Returns which parameter a command sets to this selection: the name of the parameter, and the selection as RON.
    /// Returns `None` if no parameter selects elements, or if the first parameter that selects elements already has a
    /// value. Also returns `None` if the picked elements cannot be converted to the kind of elements that this
    /// parameter selects.
    pub fn picked_value(&self, selection: &SelectionText) -> Option<(String, String)> {
        let (field, kind) = unset_selection(self)?;
        let selection = selection.without_tag(&self.operation);
        Some((field.name.clone(), converted(&selection, kind)?))
    }
}

/// Converts a selection to a selection of elements of the kind `wanted`. A selection that already selects elements of
/// this kind is returned unchanged. An example of a conversion is `EdgesWithin`, which turns a selection of vertices
/// into a selection of edges.
fn converted(selection: &SelectionText, wanted: Option<ElementKind>) -> Option<String> {
    let text = &selection.text;
    match wanted {
        None => Some(match selection.kind {
            ElementKind::Vertices => format!("Vertices({text})"),
            ElementKind::Edges => format!("Edges({text})"),
            ElementKind::Faces => format!("Faces({text})"),
        }),
        Some(kind) if kind == selection.kind => Some(text.clone()),
        Some(kind) => {
            // The narrowest conversion is the last in the list. For example, `EdgesWithin` is narrower than
            // `EdgesAround`.
            let outer = kind.conversions(selection.kind).last()?;
            Some(format!("{outer}({text})"))
        }
    }
}
