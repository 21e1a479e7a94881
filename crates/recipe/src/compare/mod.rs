//! Compares two scenes.
//!
//! Objects with the same name are compared. If each scene has exactly one object without a partner of the same name,
//! these two objects are compared, too. A mesh that is alone in its file often has the name of the file, so the same
//! mesh can have different names in two files.

mod attributes;
mod meshes;
mod order;

use scene::{Geometry, Object, Scene};

pub use attributes::{AttributeDifference, ColumnDifference};
pub use meshes::{Connectivity, Counts, MeshDifference, Moved};

/// The comparison of two scenes.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Whether both scenes have the same node graph, and the same objects in the same order. If two objects with
    /// different names are compared with each other, their names are ignored.
    pub identical: bool,
    /// The names of the objects that only the first scene has.
    pub only_first: Vec<String>,
    /// The names of the objects that only the second scene has.
    pub only_second: Vec<String>,
    /// The pairs of objects that are compared. The pairs with equal names come first, in the order of the first scene.
    pub objects: Vec<ObjectDifference>,
}

/// The comparison of two objects.
#[derive(Clone, Debug)]
pub struct ObjectDifference {
    /// The names of the two objects.
    pub names: [String; 2],
    /// The kinds of geometry of the two objects.
    pub kinds: [&'static str; 2],
    /// Whether the objects are identical bit for bit, except for their names.
    pub identical: bool,
    /// The comparison of the meshes, if both objects are meshes.
    pub mesh: Option<Box<MeshDifference>>,
    /// The names of the materials that only the first object has.
    pub materials_only_first: Vec<String>,
    /// The names of the materials that only the second object has.
    pub materials_only_second: Vec<String>,
    /// The names of materials that both objects have, but with different values.
    pub materials_differ: Vec<String>,
    /// Whether the materials of both objects have the same names, but in a different order.
    pub materials_reordered: bool,
}

impl Difference {
    /// Compares two scenes. For meshes that are not identical, measures the distance between their surfaces. If the
    /// nodes of the scenes differ, the instances of objects are compared in scene space.
    pub fn between(first: &Scene, second: &Scene) -> Self {
        if first.graph() == second.graph() {
            return Self::of_objects(first, second);
        }
        Self {
            identical: false,
            ..Self::of_objects(&first.placed(), &second.placed())
        }
    }

    fn of_objects(first: &Scene, second: &Scene) -> Self {
        let is_in = |scene: &Scene, o: &&Object| scene.object(&o.name).is_some();
        let mut pairs: Vec<(&Object, &Object)> = first
            .objects()
            .iter()
            .filter_map(|o| Some((o, second.object(&o.name)?)))
            .collect();
        let mut only_first: Vec<&Object> = first.objects().iter().collect();
        only_first.retain(|o| !is_in(second, o));
        let mut only_second: Vec<&Object> = second.objects().iter().collect();
        only_second.retain(|o| !is_in(first, o));
        if let ([one], [other]) = (&only_first[..], &only_second[..]) {
            pairs.push((one, other));
            only_first.clear();
            only_second.clear();
        }
        let objects: Vec<ObjectDifference> = pairs
            .into_iter()
            .map(|(a, b)| ObjectDifference::between(a, b))
            .collect();
        let names = |objects: Vec<&Object>| objects.iter().map(|o| o.name.clone()).collect();
        let order = |scene: &Scene| -> Vec<String> {
            let names = scene.objects().iter().map(|o| o.name.clone());
            names
                .filter(|name| {
                    objects
                        .iter()
                        .any(|o| o.names == [name.clone(), name.clone()])
                })
                .collect()
        };
        let identical = only_first.is_empty()
            && only_second.is_empty()
            && objects.iter().all(|o| o.identical)
            && order(first) == order(second);
        Self {
            identical,
            only_first: names(only_first),
            only_second: names(only_second),
            objects,
        }
    }

    /// Whether the scenes have the same objects, with the same elements in the same order. Positions and attribute
    /// values of meshes can differ by at most `tolerance`. Materials, and objects that are not meshes, must be equal.
    /// `tolerance` has the unit of the values that are compared.
    pub fn is_within(&self, tolerance: f64) -> bool {
        self.identical
            || (self.only_first.is_empty()
                && self.only_second.is_empty()
                && self.objects.iter().all(|o| o.is_within(tolerance)))
    }
}

impl ObjectDifference {
    fn between(a: &Object, b: &Object) -> Self {
        let identical = same_bits(a, b);
        let mesh = match (&a.geometry, &b.geometry) {
            (Geometry::Mesh(mesh), Geometry::Mesh(other)) => {
                Some(Box::new(MeshDifference::between(mesh, other, identical)))
            }
            _ => None,
        };
        let names =
            |o: &Object| -> Vec<String> { o.materials.iter().map(|m| m.name.clone()).collect() };
        let (first, second) = (names(a), names(b));
        let missing = |from: &[String], other: &[String]| -> Vec<String> {
            let names = from.iter().filter(|name| !other.contains(name));
            names.cloned().collect()
        };
        let (materials_only_first, materials_only_second) =
            (missing(&first, &second), missing(&second, &first));
        let differ = (a.materials.iter()).filter(|m| {
            second
                .iter()
                .position(|name| *name == m.name)
                .is_some_and(|i| b.materials[i] != **m)
        });
        Self {
            names: [a.name.clone(), b.name.clone()],
            kinds: [a.geometry.kind(), b.geometry.kind()],
            identical,
            mesh,
            materials_differ: differ.map(|m| m.name.clone()).collect(),
            materials_reordered: materials_only_first.is_empty()
                && materials_only_second.is_empty()
                && first != second,
            materials_only_first,
            materials_only_second,
        }
    }

    /// Whether the objects have equal materials, and their meshes differ by at most `tolerance`. See
    /// [`Difference::is_within`].
    pub fn is_within(&self, tolerance: f64) -> bool {
        let same_materials = self.materials_only_first.is_empty()
            && self.materials_only_second.is_empty()
            && self.materials_differ.is_empty()
            && !self.materials_reordered;
        let is_near = |mesh: &MeshDifference| mesh.is_within(tolerance);
        self.identical || (same_materials && self.mesh.as_deref().is_some_and(is_near))
    }
}

/// Whether two objects are identical bit for bit, except for their names.
fn same_bits(a: &Object, b: &Object) -> bool {
    let digest = |object: &Object| {
        let mut scene = Scene::new();
        let named = Object {
            name: String::new(),
            ..object.clone()
        };
        scene.insert(named).expect("the only object");
        scene.digest()
    };
    digest(a) == digest(b)
}

#[cfg(test)]
mod tests;
