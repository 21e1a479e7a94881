//! Scenes, and functions that run single steps on scenes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use engine::{Disk, Memory, Store};
use mesh::Domain;
use op::{ElementKind, Files, Report, Selected};
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use recipe::{Diagnostic, Source, Values, check_from, read_by, run_step};
use scene::{Geometry, Object, Scene as Kernel};

use crate::SCHEMAS;
use crate::array::Array;
use crate::errors::{error, problems, recipe_error};
use crate::interrupt::{Monitor, run};
use crate::mesh_views::{Mesh, domain, number};

/// The name of the output folder if the files of a step are kept in memory.
const OUT: &str = "out";

/// A scene, which never changes.
#[pyclass(frozen, module = "meshwright._core")]
pub(crate) struct Scene(pub(crate) Kernel);

/// Where a step reads and writes files: in folders on disk, or in memory.
enum Place {
    Disk { input: PathBuf, output: PathBuf },
    Memory(Arc<Memory>),
}

/// The result of a step that succeeded.
struct Done {
    scene: Kernel,
    reports: Vec<Report>,
    warnings: Vec<Diagnostic>,
    sources: Vec<Source>,
    written: Vec<(PathBuf, Vec<u8>)>,
}

/// The source texts and the diagnostics of a step that failed or could not run.
struct Failed(Vec<Source>, Vec<Diagnostic>);

fn step(
    scene: &Kernel,
    text: String,
    place: &Place,
    budget: u64,
    monitor: &Monitor,
) -> Result<Done, Failed> {
    let mut files = Files::default();
    match place {
        Place::Disk { input, output } => {
            input.clone_into(&mut files.input);
            output.clone_into(&mut files.output);
        }
        Place::Memory(memory) => {
            files.store = memory.clone();
            files.output = OUT.into();
        }
    }
    let source = Source::new("step", text);
    let reading = read_by(&SCHEMAS, &Disk, &source, Values::default());
    let (recipe, diagnostics) = (reading.recipe, reading.diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(Failed(recipe.sources, diagnostics));
    }
    let forecast = check_from(&recipe, scene, &files, budget);
    let warnings = [diagnostics, forecast.diagnostics].concat();
    if warnings.iter().any(Diagnostic::is_error) {
        return Err(Failed(recipe.sources, warnings));
    }
    let mut scene = scene.clone();
    let mut reports = Vec::new();
    for step in &recipe.steps {
        match run_step(step, &mut scene, &files, budget, monitor) {
            Ok((report, _)) => reports.push(report),
            Err(failed) => {
                let message = failed.map_or_else(|| "cancelled".to_owned(), |e| e.message);
                let failure = Diagnostic::error(step.span, message);
                return Err(Failed(recipe.sources, vec![failure]));
            }
        }
    }
    let mut written = Vec::new();
    if let Place::Memory(memory) = place {
        for path in store::files_below(&**memory, OUT.as_ref()).unwrap_or_default() {
            if let Ok(bytes) = memory.read(&path) {
                let path = path.strip_prefix(OUT).unwrap_or(&path).to_path_buf();
                written.push((path, bytes));
            }
        }
    }
    Ok(Done {
        scene,
        reports,
        warnings,
        sources: recipe.sources,
        written,
    })
}

fn element_kind(domain_name: &str) -> PyResult<ElementKind> {
    match domain(domain_name)? {
        Domain::Vertex => Ok(ElementKind::Vertices),
        Domain::Edge => Ok(ElementKind::Edges),
        Domain::Face => Ok(ElementKind::Faces),
        Domain::Corner => Err(PyValueError::new_err(
            "corners cannot be selected: expected \"vertex\", \"edge\" or \"face\"",
        )),
    }
}

impl Scene {
    fn object(&self, name: &str) -> PyResult<&Object> {
        let found = self.0.object(name);
        found.ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }
}

#[pymethods]
impl Scene {
    #[new]
    fn new() -> Self {
        Self(Kernel::new())
    }

    /// The names of the objects.
    fn names(&self) -> Vec<&str> {
        self.0.objects().iter().map(|o| o.name.as_str()).collect()
    }

    /// The kind of an object: `mesh`, `patches`, `curve` or `polylines`.
    fn kind(&self, name: &str) -> PyResult<&'static str> {
        Ok(self.object(name)?.geometry.kind())
    }

    /// The mesh of an object.
    fn mesh(&self, name: &str) -> PyResult<Mesh> {
        let object = self.object(name)?;
        let kind = object.geometry.kind();
        let mesh = object.as_mesh().cloned();
        mesh.map(Mesh)
            .ok_or_else(|| PyTypeError::new_err(format!("{name:?} is {kind}, expected a mesh")))
    }

    /// Evaluates a selection on the mesh of an object. Returns the ids of the selected elements. If no domain (kind of
    /// elements) is given, the selection must be valid for exactly one domain.
    fn select(
        &self,
        py: Python<'_>,
        name: &str,
        selection: &str,
        domain_name: Option<&str>,
    ) -> PyResult<Array> {
        let kind = domain_name.map(element_kind).transpose()?;
        let elements = recipe::read_selection(selection, kind)
            .map_err(|wrong| recipe_error(py, &[Source::new("selection", selection)], &wrong))?;
        let (object, mesh) = (self.object(name)?, self.mesh(name)?);
        let found = run(py, None, |_| {
            recipe::resolve(&elements, &self.0, object, &mesh.0, "")
        })?;
        let selected = found.map_err(|why| error(py, &why.to_string()))?;
        Ok(Array::ids(match selected {
            Selected::Vertices(ids) => ids.into_iter().map(number).collect(),
            Selected::Edges(ids) => ids.into_iter().map(number).collect(),
            Selected::Faces(ids) => ids.into_iter().map(number).collect(),
        }))
    }

    /// The names of the materials of an object.
    fn materials(&self, name: &str) -> PyResult<Vec<&str>> {
        let materials = &self.object(name)?.materials;
        Ok(materials.iter().map(|m| m.name.as_str()).collect())
    }

    /// A copy of the scene with only these objects and the nodes that place them.
    #[expect(clippy::needless_pass_by_value, reason = "Python passes a new list")]
    fn only(&self, names: Vec<String>) -> Self {
        Self(self.0.only(|name| names.iter().any(|n| n == name)))
    }

    /// Whether `only` gives the same graph of nodes as a Delete step that deletes all other objects. The graphs differ
    /// if `only` leaves out nodes that Delete keeps, such as cameras and lights.
    fn only_is_delete(&self, names: Vec<String>) -> bool {
        let mut deleted = self.0.clone();
        for object in self.0.objects() {
            if !names.contains(&object.name) {
                deleted.remove(&object.name);
            }
        }
        self.only(names).0.graph() == deleted.graph()
    }

    /// Returns a copy of the scene in which the object `name` has this mesh as its geometry. If the object does not
    /// exist, it is added.
    fn with_mesh(&self, name: &str, mesh: &Mesh) -> PyResult<Self> {
        let mut scene = self.0.clone();
        if let Some((geometry, _)) = scene.parts_mut(name) {
            *geometry = Geometry::Mesh(mesh.0.clone());
        } else {
            let object = Object::new(name, Geometry::Mesh(mesh.0.clone()));
            let inserted = scene.insert(object);
            inserted.map_err(|error| PyValueError::new_err(error.to_string()))?;
        }
        Ok(Self(scene))
    }

    /// Returns a scene with the objects and the nodes of both scenes. The objects of `other` are renamed first: `names`
    /// maps old names to new names.
    fn joined(&self, other: &Self, names: BTreeMap<String, String>) -> PyResult<Self> {
        let message = |error: scene::DuplicateName| PyValueError::new_err(error.to_string());
        let (mut scene, mut other) = (self.0.clone(), other.0.clone());
        for (from, to) in names {
            other.rename(&from, &to).map_err(message)?;
        }
        let (objects, graph) = (other.objects().to_vec(), other.graph().clone());
        scene.append(objects, graph).map_err(message)?;
        Ok(Self(scene))
    }

    /// Returns a copy of the scene without nodes. The transforms of the nodes that place an object are applied to the
    /// points of this object.
    fn placed(&self) -> Self {
        Self(self.0.placed().into_owned())
    }

    /// Whether the scene has nodes or other parts of a graph, such as cameras.
    fn has_nodes(&self) -> bool {
        !self.0.graph().is_empty()
    }

    /// The digest of the scene.
    fn digest(&self, py: Python<'_>) -> PyResult<String> {
        run(py, None, |_| self.0.digest().to_string())
    }

    /// Runs the steps of a recipe on this scene. If `files` is given, it contains the input files, and output files are
    /// kept in memory. If `files` is `None`, files are read from disk and written to disk. Returns the new scene and a
    /// dictionary with the report of each step, the warnings, and the outputs that are kept in memory.
    #[pyo3(signature = (text, input, output, files, budget, progress))]
    #[expect(
        clippy::too_many_arguments,
        reason = "called from one place in Python, with positional arguments"
    )]
    fn run<'py>(
        &self,
        py: Python<'py>,
        text: String,
        input: PathBuf,
        output: PathBuf,
        files: Option<BTreeMap<String, Vec<u8>>>,
        budget: Option<u64>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Self, Bound<'py, PyDict>)> {
        let place = match files {
            None => Place::Disk { input, output },
            Some(files) => {
                let memory = Memory::default();
                for (path, bytes) in files {
                    let written = memory.write(Path::new(&path), &bytes);
                    written.map_err(|why| error(py, &why.to_string()))?;
                }
                Place::Memory(Arc::new(memory))
            }
        };
        let budget = budget.unwrap_or(engine::BUDGET);
        let result = run(py, progress, |monitor| {
            step(&self.0, text, &place, budget, monitor)
        })?;
        let done = result.map_err(|Failed(sources, why)| recipe_error(py, &sources, &why))?;
        let about = PyDict::new(py);
        let json = |report: &Report| serde_json::to_string(report).expect("a report is plain data");
        about.set_item("reports", PyList::new(py, done.reports.iter().map(json))?)?;
        about.set_item("warnings", problems(py, &done.sources, &done.warnings)?)?;
        let written = PyDict::new(py);
        for (path, bytes) in &done.written {
            written.set_item(path.display().to_string(), PyBytes::new(py, bytes))?;
        }
        about.set_item("written", written)?;
        Ok((Self(done.scene), about))
    }
}
