//! The plan of a scene: the facts that are known before the run, such as the names and kinds of the objects.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use indexmap::IndexSet;
use scene::{Geometry, Graph, Scene};

use crate::{Files, Loss, MeshPlan, Problem, Range};

/// Returns an iterator over the names `name`, `name.2`, `name.3` and so on, each together with its number. `name`
/// without a suffix has the number 1. The iterator starts at the number `first`.
pub(crate) fn numbered(name: &str, first: u64) -> impl Iterator<Item = (u64, String)> {
    (first..).map(move |number| match number {
        1 => (1, name.to_owned()),
        _ => (number, format!("{name}.{number}")),
    })
}

/// The plan of the geometry of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlannedGeometry {
    /// A mesh.
    Mesh(MeshPlan),
    /// Bezier patches, with the number of patches.
    Patches(Range),
    /// A Bezier curve, with its number of control points.
    Curve(Range),
    /// Polylines.
    Polylines,
}

impl PlannedGeometry {
    /// Returns the name of this kind of geometry, such as `mesh`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Mesh(_) => "mesh",
            Self::Patches(_) => "patches",
            Self::Curve(_) => "curve",
            Self::Polylines => "polylines",
        }
    }
}

/// The plan of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedObject {
    /// The name.
    pub name: String,
    /// The geometry.
    pub geometry: PlannedGeometry,
    /// The number of root nodes that will reference this object, but are missing from the graph of the plan. The
    /// transforms of these nodes are not yet known.
    pub unplaced_nodes: u64,
}

/// The plan of a scene at one point of a recipe. A plan has counts instead of geometry. When a step is planned, the
/// step changes the plan in the same way as it will change the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    objects: Vec<PlannedObject>,
    /// Maps the name of each object to its index. [`objects_mut`](Self::objects_mut) empties the map, and the next
    /// [`insert`](Self::insert) or [`free_name`](Self::free_name) fills it again.
    index_by_name: HashMap<String, usize>,
    /// For each name that was passed to [`free_name`](Self::free_name), the last number that `free_name` chose for this
    /// name. Objects already use all lower numbers. Every method that clears `index_by_name` also clears
    /// `taken_numbers`.
    taken_numbers: HashMap<String, u64>,
    is_edited: bool,
    /// The files that are read by the steps planned so far.
    pub inputs: Vec<PathBuf>,
    /// The files that are written by the steps planned so far.
    outputs: IndexSet<PathBuf>,
    /// The data that the current step certainly loses. Lost attributes of changed meshes are not included: the crate
    /// `recipe` finds them by comparing the plans before and after the step.
    pub losses: Vec<Loss>,
    /// The data that the current step may lose. The loss is uncertain because it is unknown whether the data exist, or
    /// what their values are.
    pub possible_losses: Vec<Loss>,
    graph: Arc<Graph>,
    /// Whether an earlier step could not be read or planned. If true, some objects of the scene can be missing from the
    /// plan.
    pub incomplete: bool,
}

impl Plan {
    /// Creates the plan of an existing scene, with the exact numbers of elements.
    pub fn of(scene: &Scene) -> Self {
        let mut plan = Self {
            graph: Arc::new(scene.graph().clone()),
            ..Self::default()
        };
        for object in scene.objects() {
            let geometry = match &object.geometry {
                Geometry::Mesh(mesh) => PlannedGeometry::Mesh(MeshPlan {
                    materials: Some(object.materials.iter().map(|m| m.name.clone()).collect()),
                    ..MeshPlan::of(mesh)
                }),
                Geometry::Patches(patches) => {
                    PlannedGeometry::Patches(Range::exactly(patches.len() as u64))
                }
                Geometry::Curve(curve) => {
                    PlannedGeometry::Curve(Range::exactly(curve.points().len() as u64))
                }
                Geometry::Polylines(_) => PlannedGeometry::Polylines,
            };
            plan.insert(&object.name, geometry);
        }
        plan
    }

    /// Returns the objects in the order of the scene.
    pub fn objects(&self) -> &[PlannedObject] {
        &self.objects
    }

    /// Returns the objects for modification. To add objects, use [`insert`](Self::insert) instead, because the time of
    /// `insert` does not grow with the number of objects.
    pub fn objects_mut(&mut self) -> &mut Vec<PlannedObject> {
        self.is_edited = true;
        self.index_by_name.clear();
        self.taken_numbers.clear();
        &mut self.objects
    }

    /// Returns whether [`objects_mut`](Self::objects_mut) was called since the last call of `take_edited`. If the
    /// result is false, the list of objects has not changed since then, apart from new objects at its end.
    pub fn take_edited(&mut self) -> bool {
        std::mem::take(&mut self.is_edited)
    }

    /// Returns the object with this name.
    pub fn object(&self, name: &str) -> Option<&PlannedObject> {
        if self.index_by_name.len() < self.objects.len() {
            return self.objects.iter().find(|o| o.name == name);
        }
        self.index_by_name
            .get(name)
            .map(|&place| &self.objects[place])
    }

    /// Returns the first of the names `name`, `name.2`, `name.3` and so on that no object has.
    pub fn free_name(&mut self, name: &str) -> String {
        self.fill_index();
        // `taken_numbers` contains the last number that was chosen for this name. All lower numbers are still taken,
        // because the map is cleared whenever an object is removed.
        let first = self.taken_numbers.get(name).copied().unwrap_or(1);
        let is_free = |(_, name): &(u64, String)| !self.index_by_name.contains_key(name);
        let (number, free) = numbered(name, first)
            .find(is_free)
            .expect("fewer than 2^64 objects");
        self.taken_numbers.insert(name.to_owned(), number);
        free
    }

    fn fill_index(&mut self) {
        if self.index_by_name.is_empty() {
            let names = self.objects.iter().map(|o| o.name.clone());
            self.index_by_name = names.zip(0..).collect();
        }
    }

    /// Adds an object, or returns a problem if another object has this name.
    pub fn insert(&mut self, name: &str, geometry: PlannedGeometry) -> Option<Problem> {
        self.fill_index();
        let taken = self.taken(name, "name");
        if taken.is_none() {
            self.index_by_name
                .insert(name.to_owned(), self.objects.len());
            self.objects.push(PlannedObject {
                name: name.to_owned(),
                geometry,
                unplaced_nodes: 0,
            });
        }
        taken
    }

    /// Adds an object with the name `to` and the geometry `geometry`. Each node that references the object `from` gets
    /// a sibling node that references the new object. Returns a problem if an object with the name `to` already exists.
    pub fn insert_copy(
        &mut self,
        from: &str,
        to: &str,
        geometry: PlannedGeometry,
    ) -> Option<Problem> {
        let unplaced_nodes = self.object(from).map_or(0, |o| o.unplaced_nodes);
        let taken = self.insert(to, geometry);
        if taken.is_none()
            && let Some(copy) = self.objects.last_mut()
        {
            copy.unplaced_nodes = unplaced_nodes;
            self.edit_graph(|graph| graph.copy_object(from, to));
        }
        taken
    }

    /// Removes an object from the plan. [`Scene::remove`] describes which nodes are also removed.
    pub fn remove(&mut self, name: &str) {
        self.objects_mut().retain(|o| o.name != name);
        self.edit_graph(|graph| graph.remove_object(name));
    }

    /// Returns the graph of the nodes that place the objects in the scene. The graph also contains the skins and
    /// animations. The scales, rotations and hierarchy of these nodes are exact. Translations that are computed from
    /// points can differ from the translations in the scene. [`Graph::arrays`] is incomplete.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Calls `change` to edit the graph of the nodes. Does nothing if the graph is empty.
    pub fn edit_graph(&mut self, change: impl FnOnce(&mut Graph)) {
        if !self.graph.is_empty() {
            change(Arc::make_mut(&mut self.graph));
        }
    }

    /// Adds the nodes of a file to the graph of the plan.
    pub fn append_graph(&mut self, graph: Graph) {
        if !graph.is_empty() {
            Arc::make_mut(&mut self.graph).append(graph);
        }
    }

    /// Returns the number of instances of an object. An object that no node references has one instance.
    pub fn instances(&self, name: &str) -> u64 {
        let unplaced = self.object(name).map_or(0, |o| o.unplaced_nodes);
        (unplaced.saturating_add(self.graph.nodes_of(name).len() as u64)).max(1)
    }

    /// Returns a problem if an object already has the name `name`. `field` is the parameter that contains this name.
    pub fn taken(&self, name: &str, field: &str) -> Option<Problem> {
        self.object(name)?;
        let message = scene::DuplicateName(name.to_owned()).to_string();
        Some(Problem::error(message).at([field]))
    }

    /// If no object has the name `name`, returns a problem that lists the names of all objects. Always returns `None`
    /// if the plan is incomplete. `path` is the path of the parameter that contains the object name.
    pub fn missing<const N: usize>(&self, name: &str, path: [&str; N]) -> Option<Problem> {
        if self.incomplete || self.object(name).is_some() {
            return None;
        }
        let known: Vec<_> = (self.objects.iter())
            .map(|o| format!("\"{}\"", o.name))
            .collect();
        let known = match &known[..] {
            [] => "none".to_owned(),
            known => known.join(", "),
        };
        let problem = Problem::error(format!("no object is named \"{name}\"")).at(path);
        Some(problem.help(format!("objects at this point: {known}")))
    }

    /// Returns the files that are written by the steps planned so far, in the order of the steps.
    pub fn outputs(&self) -> &IndexSet<PathBuf> {
        &self.outputs
    }

    /// Adds the output file at `path` to the plan, and returns the problems with this path. `check` must return a
    /// problem if the file name extension is not supported.
    pub fn write(
        &mut self,
        cx: &PlanContext,
        path: &str,
        check: impl FnOnce(&Path) -> Option<Problem>,
    ) -> Vec<Problem> {
        let full = match cx.files.to_write(path) {
            Ok(full) => full,
            Err(error) => return vec![Problem::error(error.to_string()).at(["path"])],
        };
        let mut problems = Vec::from_iter(check(&full));
        if !self.outputs.insert(full) {
            let message = format!("an earlier step writes \"{path}\" too");
            problems.push(Problem::error(message).at(["path"]));
        }
        problems
    }
}

/// The context in which a step is planned.
#[derive(Clone, Copy, Debug)]
pub struct PlanContext<'a> {
    /// The input and output files of the run.
    pub files: &'a Files,
    /// The names of the objects in the step's `on:`. All objects in `on` exist in the plan. `None` if the step has no
    /// `on:`.
    pub on: Option<&'a [String]>,
    /// The memory budget of meshes, in bytes.
    pub budget: u64,
}

impl<'a> PlanContext<'a> {
    /// Creates the context of a step without `on:`. The memory budget is unlimited.
    pub const fn new(files: &'a Files) -> Self {
        Self {
            files,
            on: None,
            budget: u64::MAX,
        }
    }
}
