//! The plan of a scene: what is known before anything runs, such as kinds of objects, counts, attributes and bytes.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use indexmap::IndexSet;
use mesh::{
    CORNER_NORMAL, CORNER_TANGENT, DVec3, Domain, Rule, TANGENT, VERTEX_NORMAL, is_morph_direction,
    joint_of, morph_of,
};
use scene::{Geometry, Graph, Scene};

use crate::{Files, Loss};

/// A range of possible counts, including both ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// The lowest possible count.
    pub min: u64,
    /// The highest possible count; `u64::MAX` if no limit is known.
    pub max: u64,
}

impl Range {
    /// The range that contains every count.
    pub const ANY: Self = Self {
        min: 0,
        max: u64::MAX,
    };

    /// Creates the range that contains only `n`.
    pub const fn exactly(n: u64) -> Self {
        Self { min: n, max: n }
    }

    /// Creates the range from 0 to `max`.
    pub const fn at_most(max: u64) -> Self {
        Self { min: 0, max }
    }

    /// Creates the range from `min` to `max`.
    pub const fn between(min: u64, max: u64) -> Self {
        Self { min, max }
    }

    /// Whether only one count is possible.
    pub const fn is_exact(self) -> bool {
        self.min == self.max
    }

    /// Whether the count can be `n`.
    pub const fn contains(self, n: u64) -> bool {
        self.min <= n && n <= self.max
    }

    /// Returns the range of the sum of two counts.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_add(other.min),
            max: self.max.saturating_add(other.max),
        }
    }

    /// Returns the range of the difference of two counts. An end that would be negative is 0.
    #[must_use]
    pub const fn minus(self, other: Self) -> Self {
        let max = if self.max == u64::MAX {
            u64::MAX
        } else {
            self.max.saturating_sub(other.min)
        };
        Self {
            min: self.min.saturating_sub(other.max),
            max,
        }
    }

    /// Returns the range of this count minus `n`. An end that would be negative is 0. `self.max` must be a known limit,
    /// not `u64::MAX`.
    #[must_use]
    pub const fn less(self, n: u64) -> Self {
        Self {
            min: self.min.saturating_sub(n),
            max: self.max.saturating_sub(n),
        }
    }

    /// Returns the range of the product of two counts.
    #[must_use]
    pub const fn times(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_mul(other.min),
            max: self.max.saturating_mul(other.max),
        }
    }

    /// Returns the range of `n` times this count.
    #[must_use]
    pub const fn by(self, n: u64) -> Self {
        self.times(Self::exactly(n))
    }

    /// Returns the range from 0 to the highest count. Use this method if a step can remove or omit any number of the
    /// elements.
    #[must_use]
    pub const fn or_less(self) -> Self {
        Self::at_most(self.max)
    }

    /// Returns the smallest range that contains both ranges.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Returns this range with both ends reduced to `cap` where they exceed it.
    #[must_use]
    pub fn capped(self, cap: u64) -> Self {
        Self {
            min: self.min.min(cap),
            max: self.max.min(cap),
        }
    }
}

/// What is known about an attribute before anything runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedAttribute {
    /// The domain of the attribute.
    pub domain: Domain,
    /// The name.
    pub name: String,
    /// Whether the attribute certainly exists.
    pub certain: bool,
}

/// The plan of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshPlan {
    /// The number of vertices.
    pub vertices: Range,
    /// The number of edges.
    pub edges: Range,
    /// The number of faces.
    pub faces: Range,
    /// The range of the degrees of the faces. The degree of a face is its number of corners.
    pub degrees: Range,
    /// The known attributes.
    pub attributes: Vec<PlannedAttribute>,
    /// Whether the mesh can have attributes that are not in `attributes`. A mesh from a file can have such attributes.
    pub has_unlisted_attributes: bool,
    /// The names of the materials; `None` if they are unknown.
    pub materials: Option<Vec<String>>,
}

/// The size of one attribute value, in bytes: from 1 (a tag) to 32 (a vector of four numbers).
const ATTRIBUTE_VALUE_BYTES: Range = Range { min: 1, max: 32 };

impl MeshPlan {
    /// Creates the plan of a mesh about which nothing is known.
    pub const fn unknown() -> Self {
        Self {
            vertices: Range::ANY,
            edges: Range::ANY,
            faces: Range::ANY,
            degrees: Range::between(3, u64::MAX),
            attributes: Vec::new(),
            has_unlisted_attributes: true,
            materials: None,
        }
    }

    /// Creates the plan of a mesh with known counts that has no attributes and no materials.
    pub const fn counted(vertices: u64, edges: u64, faces: u64, degrees: Range) -> Self {
        Self {
            vertices: Range::exactly(vertices),
            edges: Range::exactly(edges),
            faces: Range::exactly(faces),
            degrees,
            attributes: Vec::new(),
            has_unlisted_attributes: false,
            materials: Some(Vec::new()),
        }
    }

    /// Creates the exact plan of an existing mesh. The materials are unknown.
    pub fn of(mesh: &mesh::Mesh) -> Self {
        let degrees = mesh.faces().map(|f| mesh.degree(f) as u64);
        let degrees = degrees
            .map(Range::exactly)
            .reduce(Range::or)
            .unwrap_or(Range::exactly(3));
        Self {
            vertices: Range::exactly(mesh.n_vertices() as u64),
            edges: Range::exactly(mesh.n_edges() as u64),
            faces: Range::exactly(mesh.n_faces() as u64),
            degrees,
            attributes: mesh
                .attributes()
                .iter()
                .map(|(domain, c)| PlannedAttribute {
                    domain,
                    name: c.name.clone(),
                    // Attributes with the rule `Drop` are lost in an edit that changes connectivity.
                    certain: c.rule != Rule::Drop,
                })
                .collect(),
            has_unlisted_attributes: false,
            materials: None,
        }
    }

    /// Whether all faces are certainly triangles.
    pub fn is_triangles(&self) -> bool {
        self.degrees == Range::exactly(3)
    }

    /// Returns how many corners some of the faces have together, as a range. `faces` is the number of these faces. The
    /// result is at most twice the number of edges of the mesh.
    pub fn corners_of(&self, faces: Range) -> Range {
        faces.times(self.degrees).capped(self.edges.by(2).max)
    }

    /// Adds these numbers of elements to the counts of the plan.
    pub fn grow(&mut self, vertices: Range, edges: Range, faces: Range) {
        self.vertices = self.vertices.plus(vertices);
        self.edges = self.edges.plus(edges);
        self.faces = self.faces.plus(faces);
    }

    /// Returns an error message if the mesh certainly has no vertex with this id.
    pub fn missing_vertex_message(&self, number: u32) -> Option<String> {
        missing_element_message(u64::from(number), self.vertices, "vertex")
    }

    /// Returns an error message if the mesh certainly has no face with this id.
    pub fn missing_face_message(&self, number: u32) -> Option<String> {
        missing_element_message(u64::from(number), self.faces, "face")
    }

    /// Adds an attribute that certainly exists.
    pub fn provide(&mut self, domain: Domain, name: &str) {
        self.drop_attribute(domain, name);
        self.attributes.push(PlannedAttribute {
            domain,
            name: name.to_owned(),
            certain: true,
        });
    }

    /// Removes an attribute.
    pub fn drop_attribute(&mut self, domain: Domain, name: &str) {
        self.attributes
            .retain(|a| a.domain != domain || a.name != name);
    }

    /// Removes the normals and tangents of vertices, corners and morph targets. Operations that change the shape of the
    /// mesh call this method.
    pub fn drop_normals(&mut self) {
        self.drop_attribute(Domain::Vertex, VERTEX_NORMAL.name);
        self.drop_attribute(Domain::Corner, CORNER_NORMAL.name);
        self.drop_attribute(Domain::Vertex, TANGENT.name);
        self.drop_attribute(Domain::Corner, CORNER_TANGENT.name);
        (self.attributes).retain(|attribute| !is_morph_direction(&attribute.name));
    }

    /// Whether one of the known attributes has weights of joints.
    pub fn has_joints(&self) -> bool {
        let is_joint = |a: &PlannedAttribute| joint_of(&a.name).is_some();
        (self.attributes.iter()).any(|a| a.domain == Domain::Vertex && is_joint(a))
    }

    /// Returns the number of morph targets among the known attributes.
    pub fn n_morphs(&self) -> usize {
        let is_morph = |a: &&PlannedAttribute| morph_of(&a.name).is_some();
        (self.attributes.iter())
            .filter(|a| a.domain == Domain::Vertex && is_morph(a))
            .count()
    }

    /// Returns the size of the mesh in bytes. Attributes that are not listed in the plan are not included.
    pub fn bytes(&self) -> Range {
        let count = |domain| match domain {
            Domain::Vertex => self.vertices,
            Domain::Corner => self.edges.by(2),
            Domain::Edge => self.edges,
            Domain::Face => self.faces,
        };
        let connectivity = self
            .vertices
            .by(28)
            .plus(self.edges.by(24))
            .plus(self.faces.by(4));
        self.attributes.iter().fold(connectivity, |sum, a| {
            sum.plus(count(a.domain).times(value_bytes(a)))
        })
    }
}

/// Returns an iterator over the names `name`, `name.2`, `name.3` and so on, each together with its number. `name`
/// without a suffix has the number 1. The iterator starts at the number `first`.
pub(crate) fn numbered(name: &str, first: u64) -> impl Iterator<Item = (u64, String)> {
    (first..).map(move |number| match number {
        1 => (1, name.to_owned()),
        _ => (number, format!("{name}.{number}")),
    })
}

fn missing_element_message(number: u64, count: Range, noun: &str) -> Option<String> {
    let limit = if count.is_exact() { "" } else { "at most " };
    let n = mesh::counted(count.max, noun);
    let message = || format!("{noun} {number} does not exist: the mesh has {limit}{n}");
    (number >= count.max).then(message)
}

/// Returns the size of one value of an attribute, in bytes. The lower end of the range is 0 if it is not certain that
/// the attribute exists.
fn value_bytes(attribute: &PlannedAttribute) -> Range {
    let name = &attribute.name;
    let exactly = |bytes: usize| Range::exactly(bytes as u64);
    let size = match attribute.domain {
        Domain::Vertex if joint_of(name).is_some() => exactly(size_of::<f64>()),
        Domain::Vertex if morph_of(name).is_some() => exactly(size_of::<DVec3>()),
        _ => ATTRIBUTE_VALUE_BYTES,
    };
    if attribute.certain {
        size
    } else {
        size.or_less()
    }
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
    /// Returns the word for this kind of geometry.
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
    /// The number of root nodes that reference the object but are missing from the graph of the plan, because their
    /// transforms are not yet known.
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
    /// Maps each name that was passed to [`free_name`](Self::free_name) to the last number that `free_name` chose for
    /// it. All lower numbers are taken. This map and `index_by_name` are always cleared together.
    taken_numbers: HashMap<String, u64>,
    is_edited: bool,
    /// The files that are read by the steps planned so far.
    pub inputs: Vec<PathBuf>,
    /// The files that are written by the steps planned so far.
    outputs: IndexSet<PathBuf>,
    /// The data that the current step certainly loses. Lost attributes of changed meshes are not included: the crate
    /// `recipe` finds them by comparing the plans before and after the step.
    pub losses: Vec<Loss>,
    /// The data that the current step possibly loses. The loss is uncertain because it is unknown whether the data
    /// exist, or what their values are.
    pub possible_losses: Vec<Loss>,
    graph: Arc<Graph>,
    /// Whether an earlier step could not be read or planned. If so, the scene will possibly have objects that are
    /// missing from the plan.
    pub incomplete: bool,
}

impl Plan {
    /// Creates the exact plan of an existing scene.
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

    /// Returns the objects, in order.
    pub fn objects(&self) -> &[PlannedObject] {
        &self.objects
    }

    /// Returns the objects for modification. To add an object, use [`insert`](Self::insert) instead: its time does not
    /// grow with the number of objects.
    pub fn objects_mut(&mut self) -> &mut Vec<PlannedObject> {
        self.is_edited = true;
        self.index_by_name.clear();
        self.taken_numbers.clear();
        &mut self.objects
    }

    /// Returns whether [`objects_mut`](Self::objects_mut) was called since the last call of `take_edited`. If
    /// `objects_mut` was not called, the only possible change of the objects is that some were added at the end.
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
        // because removing an object clears this map.
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

    /// Adds an object `to` with the same nodes as the object `from` but with another geometry. Returns a problem if an
    /// object with the name `to` already exists.
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

    /// Removes an object from the plan. Its nodes are removed in the same way as by [`Scene::remove`].
    pub fn remove(&mut self, name: &str) {
        self.objects_mut().retain(|o| o.name != name);
        self.edit_graph(|graph| graph.remove_object(name));
    }

    /// Returns the nodes that place the objects, with their skins and animations. The scales, rotations and hierarchy
    /// of these nodes are exact. Translations that are computed from points can differ from those of the scene.
    /// [`Graph::arrays`] is incomplete.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Calls `change` with the graph of the nodes, unless the graph is empty.
    pub fn edit_graph(&mut self, change: impl FnOnce(&mut Graph)) {
        if !self.graph.is_empty() {
            change(Arc::make_mut(&mut self.graph));
        }
    }

    /// Adds the nodes of a file.
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

    /// Returns a problem if an object already has this name. `field` is the name of the parameter that contains the
    /// object name.
    pub fn taken(&self, name: &str, field: &str) -> Option<Problem> {
        self.object(name)?;
        let message = scene::DuplicateName(name.to_owned()).to_string();
        Some(Problem::error(message).at([field]))
    }

    /// If no object has this name, returns a problem that lists the known names. Always returns `None` if the plan is
    /// incomplete. `path` is the path of the parameter that contains the object name.
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

    /// Adds a file that the step writes. Returns the problems with its `path`. `check` is called with the path, and
    /// returns a problem if the file name extension is not supported.
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
    /// The names of the objects in the step's `on:`. All of these objects exist. `None` if the step has no `on:`.
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

/// A problem with a step that is found before any step runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The description of the problem, in lower case and without a full stop.
    pub message: String,
    /// How to solve the problem.
    pub help: Option<String>,
    /// The path of the parameter: names of fields and variants, and indices of list items, from the outermost to the
    /// innermost. The path is empty if the problem concerns the whole step.
    pub path: Vec<String>,
    /// Whether the problem is only a warning, which does not keep the recipe from running.
    pub is_warning: bool,
}

impl Problem {
    /// Creates an error that concerns the whole step.
    pub fn error(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: None,
            path: Vec::new(),
            is_warning: false,
        }
    }

    /// Creates a warning that concerns the whole step.
    pub fn warning(message: impl Into<String>) -> Self {
        Self {
            is_warning: true,
            ..Self::error(message)
        }
    }

    /// Sets the path of the parameter.
    #[must_use]
    pub fn at<const N: usize>(mut self, path: [&str; N]) -> Self {
        self.path = path.map(str::to_owned).to_vec();
        self
    }

    /// Sets the help text, which says how to solve the problem.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

#[cfg(test)]
mod tests;
