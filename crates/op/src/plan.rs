//! What is known of a scene before anything runs: kinds, counts, attributes and bytes.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use mesh::{CORNER_NORMAL, Domain, Rule, VERTEX_NORMAL};

use crate::Files;

/// A count that lies between two numbers, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// The lowest that it can be.
    pub min: u64,
    /// The highest that it can be; `u64::MAX` if nothing is known.
    pub max: u64,
}

impl Range {
    /// Any number.
    pub const ANY: Self = Self {
        min: 0,
        max: u64::MAX,
    };

    /// Exactly this number.
    pub const fn exactly(n: u64) -> Self {
        Self { min: n, max: n }
    }

    /// From 0 to this number.
    pub const fn at_most(max: u64) -> Self {
        Self { min: 0, max }
    }

    /// From one number to the other.
    pub const fn between(min: u64, max: u64) -> Self {
        Self { min, max }
    }

    /// Whether the number is known.
    pub const fn is_exact(self) -> bool {
        self.min == self.max
    }

    /// Whether the number can be `n`.
    pub const fn contains(self, n: u64) -> bool {
        self.min <= n && n <= self.max
    }

    /// The sum of two counts.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_add(other.min),
            max: self.max.saturating_add(other.max),
        }
    }

    /// This count without another one, not below 0.
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

    /// So much less, not below 0: for a number that is known to be finite.
    #[must_use]
    pub const fn less(self, n: u64) -> Self {
        Self {
            min: self.min.saturating_sub(n),
            max: self.max.saturating_sub(n),
        }
    }

    /// The product of two counts.
    #[must_use]
    pub const fn times(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_mul(other.min),
            max: self.max.saturating_mul(other.max),
        }
    }

    /// So many times this count.
    #[must_use]
    pub const fn by(self, n: u64) -> Self {
        self.times(Self::exactly(n))
    }

    /// From 0 to the highest that it can be: some of the elements are gone.
    #[must_use]
    pub const fn or_less(self) -> Self {
        Self::at_most(self.max)
    }

    /// One count or the other.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The same, but at most `cap`.
    #[must_use]
    pub fn capped(self, cap: u64) -> Self {
        Self {
            min: self.min.min(cap),
            max: self.max.min(cap),
        }
    }
}

/// What is known of an attribute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedAttribute {
    /// Its domain.
    pub domain: Domain,
    /// Its name.
    pub name: String,
    /// Whether it is there for certain.
    pub certain: bool,
}

/// What is known of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshPlan {
    /// How many vertices it has.
    pub vertices: Range,
    /// How many edges.
    pub edges: Range,
    /// How many faces.
    pub faces: Range,
    /// How many corners its faces have: the lowest and the highest degree.
    pub degrees: Range,
    /// Its attributes.
    pub attributes: Vec<PlannedAttribute>,
    /// Whether it may have other attributes, as a mesh from a file has.
    pub others: bool,
}

/// The bytes of a value of an attribute.
const VALUE: Range = Range { min: 1, max: 32 };

impl MeshPlan {
    /// A mesh of which nothing is known.
    pub const fn unknown() -> Self {
        Self {
            vertices: Range::ANY,
            edges: Range::ANY,
            faces: Range::ANY,
            degrees: Range::between(3, u64::MAX),
            attributes: Vec::new(),
            others: true,
        }
    }

    /// A mesh of known counts, without attributes.
    pub const fn counted(vertices: u64, edges: u64, faces: u64, degrees: Range) -> Self {
        Self {
            vertices: Range::exactly(vertices),
            edges: Range::exactly(edges),
            faces: Range::exactly(faces),
            degrees,
            attributes: Vec::new(),
            others: false,
        }
    }

    /// What is known of an existing mesh: everything.
    pub fn of(mesh: &mesh::Mesh) -> Self {
        let degrees = || mesh.faces().map(|f| mesh.degree(f) as u64);
        Self {
            vertices: Range::exactly(mesh.n_vertices() as u64),
            edges: Range::exactly(mesh.n_edges() as u64),
            faces: Range::exactly(mesh.n_faces() as u64),
            degrees: Range::between(degrees().min().unwrap_or(3), degrees().max().unwrap_or(3)),
            attributes: mesh
                .attributes()
                .iter()
                .map(|(domain, c)| PlannedAttribute {
                    domain,
                    name: c.name.clone(),
                    // An edit that changes connectivity drops such a column.
                    certain: c.rule != Rule::Drop,
                })
                .collect(),
            others: false,
        }
    }

    /// Whether all faces are triangles for certain.
    pub fn is_triangles(&self) -> bool {
        self.degrees == Range::exactly(3)
    }

    /// The number of corners of `faces` of the faces, at most two for each edge of the mesh.
    pub fn corners_of(&self, faces: Range) -> Range {
        faces.times(self.degrees).capped(self.edges.by(2).max)
    }

    /// Adds elements.
    pub fn grow(&mut self, vertices: Range, edges: Range, faces: Range) {
        self.vertices = self.vertices.plus(vertices);
        self.edges = self.edges.plus(edges);
        self.faces = self.faces.plus(faces);
    }

    /// The message about a vertex of this number, if the mesh cannot have one.
    pub fn no_vertex(&self, number: u32) -> Option<String> {
        let n = self.vertices.max;
        (u64::from(number) >= n).then(|| format!("there is no vertex {number}, only {n} vertices"))
    }

    /// Adds an attribute that is there for certain.
    pub fn provide(&mut self, domain: Domain, name: &str) {
        self.drop_attribute(domain, name);
        self.attributes.push(PlannedAttribute {
            domain,
            name: name.to_owned(),
            certain: true,
        });
    }

    /// Takes an attribute out.
    pub fn drop_attribute(&mut self, domain: Domain, name: &str) {
        self.attributes
            .retain(|a| a.domain != domain || a.name != name);
    }

    /// Takes the normals of vertices and corners out: for operations that change the shape.
    pub fn drop_normals(&mut self) {
        self.drop_attribute(Domain::Vertex, VERTEX_NORMAL.name);
        self.drop_attribute(Domain::Corner, CORNER_NORMAL.name);
    }

    /// The bytes that the mesh takes. A value of an attribute takes from 1 byte, a tag, to 32.
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
            sum.plus(count(a.domain).times(VALUE))
        })
    }
}

/// What is known of the shape of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlannedGeometry {
    /// A mesh.
    Mesh(MeshPlan),
    /// Bezier patches; how many.
    Patches(Range),
    /// A Bezier curve; how many control points.
    Curve(Range),
    /// Polylines.
    Polylines,
}

impl PlannedGeometry {
    /// The word for this kind of geometry.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Mesh(_) => "mesh",
            Self::Patches(_) => "patches",
            Self::Curve(_) => "curve",
            Self::Polylines => "polylines",
        }
    }
}

/// What is known of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedObject {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub geometry: PlannedGeometry,
}

/// What is known of a scene at one point of a recipe. Steps change it as they will change the scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    objects: Vec<PlannedObject>,
    /// The place of each name; empty since objects were changed.
    places: HashMap<String, usize>,
    is_edited: bool,
    /// Files that are read so far.
    pub inputs: Vec<PathBuf>,
    /// Files that are written so far.
    pub outputs: Vec<PathBuf>,
    /// Whether a step before this one could not be read or planned: objects may be missing here that
    /// will be there.
    pub incomplete: bool,
}

impl Plan {
    /// The objects, in order.
    pub fn objects(&self) -> &[PlannedObject] {
        &self.objects
    }

    /// The same, to be changed. A new object is added with [`insert`](Self::insert), which takes no time in
    /// proportion to the others.
    pub fn objects_mut(&mut self) -> &mut Vec<PlannedObject> {
        self.is_edited = true;
        self.places.clear();
        &mut self.objects
    }

    /// Whether there was a call of [`objects_mut`](Self::objects_mut) since the last one of this method. Otherwise
    /// objects were added at the end, and the others are as they were.
    pub fn take_edited(&mut self) -> bool {
        std::mem::take(&mut self.is_edited)
    }

    /// The object of this name.
    pub fn object(&self, name: &str) -> Option<&PlannedObject> {
        if self.places.len() < self.objects.len() {
            return self.objects.iter().find(|o| o.name == name);
        }
        self.places.get(name).map(|&place| &self.objects[place])
    }

    /// Adds an object; a problem if its name is taken.
    pub fn insert(&mut self, name: &str, geometry: PlannedGeometry) -> Option<Problem> {
        if self.places.is_empty() {
            let names = self.objects.iter().map(|o| o.name.clone());
            self.places = names.zip(0..).collect();
        }
        let taken = self.taken(name, "name");
        if taken.is_none() {
            self.places.insert(name.to_owned(), self.objects.len());
            self.objects.push(PlannedObject {
                name: name.to_owned(),
                geometry,
            });
        }
        taken
    }

    /// A problem if an object has this name, which `field` gives to another one.
    pub fn taken(&self, name: &str, field: &str) -> Option<Problem> {
        self.object(name)?;
        let message = scene::DuplicateName(name.to_owned()).to_string();
        Some(Problem::error(message).at([field]))
    }

    /// A problem if no object has the name, with the names there are. `path` is the parameter that names it.
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

    /// Notes a file that the step writes, and returns what is wrong with its `path`. `check` returns what is wrong
    /// with its ending.
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
        if self.outputs.contains(&full) {
            let message = format!("an earlier step writes \"{path}\" too");
            problems.push(Problem::error(message).at(["path"]));
        }
        self.outputs.push(full);
        problems
    }
}

/// What a step is planned in.
#[derive(Clone, Copy, Debug)]
pub struct PlanContext<'a> {
    /// Where files are read and written.
    pub files: &'a Files,
    /// The objects that the step was told to act on; `None` for all that it can. They exist.
    pub on: Option<&'a [String]>,
    /// How many bytes meshes may take.
    pub budget: u64,
}

/// Something wrong with a step, found before anything runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// What is wrong: lower case, no full stop.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// The parameter that it is about: names of fields and variants and numbers of items, from the
    /// outside in. Empty for the whole step.
    pub path: Vec<String>,
    /// Whether the recipe can run all the same.
    pub is_warning: bool,
}

impl Problem {
    /// An error about the whole step.
    pub fn error(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: None,
            path: Vec::new(),
            is_warning: false,
        }
    }

    /// A warning about the whole step.
    pub fn warning(message: impl Into<String>) -> Self {
        Self {
            is_warning: true,
            ..Self::error(message)
        }
    }

    /// The same, about this parameter.
    #[must_use]
    pub fn at<const N: usize>(mut self, path: [&str; N]) -> Self {
        self.path = path.map(str::to_owned).to_vec();
        self
    }

    /// The same, with a way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
