//! Finds the geometries that the nodes of a scene instantiate, with their transforms, names and materials.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DAffine3, DMat3, DVec3};

use super::cost;
use super::document::{
    Document, Node, below, child, elements, error_at, exactly, is, line, named, number_of, required,
};
use crate::fault::Fault;
use crate::note::Notes;

/// A geometry with its transform.
pub(super) struct PlacedGeometry<'a> {
    /// The element that instantiates the geometry, for errors about the memory budget.
    pub(super) instance: Option<Node<'a>>,
    pub(super) geometry: Node<'a>,
    pub(super) to_scene: DAffine3,
    /// The name of the node; empty if the node has no name.
    node_name: &'a str,
    /// The `<material>` element that the node assigns to each material symbol of the geometry.
    pub(super) materials: BTreeMap<&'a str, Node<'a>>,
}

impl<'a> PlacedGeometry<'a> {
    pub(super) fn name(&self, otherwise: &'a str) -> &'a str {
        let names = [self.node_name, name(self.geometry)];
        let named = names.into_iter().find(|name| !name.is_empty());
        named.unwrap_or(otherwise)
    }
}

fn name(node: Node<'_>) -> &str {
    let given = node.attribute("name").filter(|name| !name.is_empty());
    given.or(node.attribute("id")).unwrap_or_default()
}

/// Returns the geometries that the nodes of the scene instantiate. The geometries of a node come before those of its
/// child nodes. If the file has no scene, returns all geometries of the file.
///
/// # Errors
///
/// Returns the first error in the nodes.
pub(super) fn placed<'a>(
    document: &Document<'a>,
    notes: &mut Notes,
) -> Result<Vec<PlacedGeometry<'a>>, Fault> {
    let geometries = || {
        let libraries = named(document.root, "library_geometries");
        libraries.flat_map(|library| named(library, "geometry"))
    };
    let scenes: Vec<Node> = named(document.root, "library_visual_scenes")
        .flat_map(|library| named(library, "visual_scene"))
        .collect();
    let instance = below(document.root, &["scene", "instance_visual_scene"]);
    let shown = match instance {
        Some(instance) => document.follow(instance, "url", &["visual_scene"])?,
        None => scenes.first().copied(),
    };
    let Some(scene) = shown else {
        let alone = geometries().map(|geometry| PlacedGeometry {
            instance: None,
            geometry,
            to_scene: DAffine3::IDENTITY,
            node_name: "",
            materials: BTreeMap::new(),
        });
        return Ok(alone.collect());
    };
    let other_scenes: Vec<&Node> = scenes.iter().filter(|other| **other != scene).collect();
    let first = other_scenes.first().map(|scene| line(**scene));
    notes.left_out("scenes", other_scenes.len(), first, "other scenes left out");
    let placed = Walk::of(document).run(scene)?;
    let used = placed.iter().map(|placed| number_of(placed.geometry));
    let used: BTreeSet<u32> = used.collect();
    let mut unused = geometries().filter(|geometry| !used.contains(&number_of(*geometry)));
    if let Some(first) = unused.next() {
        let what = "geometries left out: not used by any node of the scene";
        notes.left_out("meshes-unused", 1 + unused.count(), line(first), what);
    }
    Ok(placed)
}

/// Traverses the nodes of a scene with an explicit stack, because nodes can be nested very deeply.
struct Walk<'a, 'd> {
    document: &'d Document<'a>,
    /// The number of elements that can still be visited. This number is limited because nested instances in a small
    /// file can cause a huge number of visits.
    steps: usize,
    /// The nodes from the root to the current node.
    ancestors: BTreeSet<u32>,
    transforms: BTreeMap<u32, DAffine3>,
    placed: Vec<PlacedGeometry<'a>>,
}

enum Step<'a> {
    Enter(Node<'a>, DAffine3),
    Leave(u32),
}

impl<'a, 'd> Walk<'a, 'd> {
    fn of(document: &'d Document<'a>) -> Self {
        Self {
            document,
            steps: 4 * document.size + 10_000,
            ancestors: BTreeSet::new(),
            transforms: BTreeMap::new(),
            placed: Vec::new(),
        }
    }

    fn run(mut self, scene: Node<'a>) -> Result<Vec<PlacedGeometry<'a>>, Fault> {
        let mut open = Vec::new();
        self.open_children(scene, DAffine3::IDENTITY, &mut open)?;
        while let Some(step) = open.pop() {
            let (node, parent_to_scene) = match step {
                Step::Leave(id) => {
                    self.ancestors.remove(&id);
                    continue;
                }
                Step::Enter(node, parent_to_scene) => (node, parent_to_scene),
            };
            if !self.ancestors.insert(number_of(node)) {
                return Err(error_at(node, "the node is its own descendant"));
            }
            open.push(Step::Leave(number_of(node)));
            let to_scene = parent_to_scene * self.transform(node)?;
            if !to_scene.is_finite() {
                return Err(error_at(node, "the transform of the node is not finite"));
            }
            self.place_geometries(node, to_scene)?;
            self.open_children(node, to_scene, &mut open)?;
        }
        Ok(self.placed)
    }

    fn step(&mut self, node: Node) -> Result<(), Fault> {
        let message = "the file repeats its nodes far more often than is usual for its size";
        let left = self.steps.checked_sub(1);
        self.steps = left.ok_or_else(|| error_at(node, message))?;
        Ok(())
    }

    /// Pushes the child nodes of `node`, including instances of other nodes, onto the stack `open`, with the first
    /// child on top.
    fn open_children(
        &mut self,
        node: Node<'a>,
        to_scene: DAffine3,
        open: &mut Vec<Step<'a>>,
    ) -> Result<(), Fault> {
        let start = open.len();
        for part in elements(node) {
            self.step(part)?;
            if is(part, "node") {
                open.push(Step::Enter(part, to_scene));
            } else if is(part, "instance_node") {
                match self.document.follow(part, "url", &["node"])? {
                    Some(node) => open.push(Step::Enter(node, to_scene)),
                    None => self.document.left_out(
                        1,
                        part,
                        ("other-files", "nodes in other files left out"),
                    ),
                }
            }
        }
        open[start..].reverse();
        Ok(())
    }

    fn place_geometries(&mut self, node: Node<'a>, to_scene: DAffine3) -> Result<(), Fault> {
        for instance in elements(node) {
            let geometry = match instance.tag_name().name() {
                "instance_geometry" => self.document.follow(instance, "url", &["geometry"])?,
                "instance_controller" => self.geometry_of_controller(instance)?,
                _ => continue,
            };
            let Some(geometry) = geometry else {
                self.document.left_out(
                    1,
                    instance,
                    ("other-files", "geometries in other files left out"),
                );
                continue;
            };
            // The cost includes the lengths of the names, because the name of an object is stored several times.
            let names = name(node).len() + name(geometry).len();
            self.document.take(instance, cost::OBJECT + 8 * names)?;
            let materials = self.bound_materials(instance)?;
            self.placed.push(PlacedGeometry {
                instance: Some(instance),
                geometry,
                to_scene,
                node_name: name(node),
                materials,
            });
        }
        Ok(())
    }

    /// Returns the geometry that a skin or a morph deforms. The deformation is ignored.
    fn geometry_of_controller(&self, instance: Node<'a>) -> Result<Option<Node<'a>>, Fault> {
        const MAX_DEPTH: usize = 16;
        let mut controller = self.document.follow(instance, "url", &["controller"])?;
        for _ in 0..MAX_DEPTH {
            let Some(node) = controller else {
                return Ok(None);
            };
            let modifier = child(node, "skin").or(child(node, "morph"));
            let modifier = modifier.ok_or_else(|| error_at(node, "expected <skin> or <morph>"))?;
            let kinds = ["geometry", "controller"];
            match self.document.follow(modifier, "source", &kinds)? {
                Some(source) if is(source, "controller") => controller = Some(source),
                geometry => return Ok(geometry),
            }
        }
        let message = format!(
            "expected a chain of at most {MAX_DEPTH} controllers, found a longer chain or a cycle"
        );
        Err(error_at(instance, message))
    }

    fn bound_materials(
        &mut self,
        instance: Node<'a>,
    ) -> Result<BTreeMap<&'a str, Node<'a>>, Fault> {
        let mut materials = BTreeMap::new();
        let Some(list) = below(instance, &["bind_material", "technique_common"]) else {
            return Ok(materials);
        };
        for bound in named(list, "instance_material") {
            self.step(bound)?;
            self.document.take(bound, cost::BOUND)?;
            let symbol = required(bound, "symbol")?;
            match self.document.follow(bound, "target", &["material"])? {
                Some(material) => {
                    materials.entry(symbol).or_insert(material);
                }
                None => self.document.left_out(
                    1,
                    bound,
                    ("other-files", "materials in other files left out"),
                ),
            }
        }
        Ok(materials)
    }

    /// Returns the transform of a node relative to its parent. The transform is the product of the transform elements
    /// of the node, in the order of the file from left to right.
    fn transform(&mut self, node: Node<'a>) -> Result<DAffine3, Fault> {
        if let Some(known) = self.transforms.get(&number_of(node)) {
            return Ok(*known);
        }
        let mut all = DAffine3::IDENTITY;
        for part in elements(node) {
            all *= match part.tag_name().name() {
                "matrix" => matrix(part)?,
                "translate" => DAffine3::from_translation(DVec3::from_array(exactly(part)?)),
                "scale" => DAffine3::from_scale(DVec3::from_array(exactly(part)?)),
                "rotate" => DAffine3::from_mat3(rotation(exactly(part)?)),
                "lookat" => look_at(part)?,
                "skew" => {
                    self.document
                        .left_out(1, part, ("skews", "skews of nodes left out"));
                    continue;
                }
                _ => continue,
            };
        }
        self.transforms.insert(number_of(node), all);
        Ok(all)
    }
}

fn matrix(node: Node) -> Result<DAffine3, Fault> {
    let rows: [f64; 16] = exactly(node)?;
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(error_at(
            node,
            "expected 0 0 0 1 as the last row of the matrix",
        ));
    }
    let column = |i: usize| DVec3::new(rows[i], rows[4 + i], rows[8 + i]);
    let [x, y, z, w] = [0, 1, 2, 3].map(column);
    Ok(DAffine3::from_cols(x, y, z, w))
}

/// Returns a rotation by Rodrigues' formula: R = c I + s \[n\] + (1 - c) n n^T. Here n is the unit axis, \[n\] is the
/// matrix of the cross product with n, and c and s are the cosine and the sine of the angle. The angle is in degrees.
/// If the axis is zero, the rotation is the identity.
fn rotation([x, y, z, degrees]: [f64; 4]) -> DMat3 {
    let axis = DVec3::new(x, y, z).normalize_or_zero();
    if axis == DVec3::ZERO {
        return DMat3::IDENTITY;
    }
    let (s, c) = geometry::sin_cos_degrees(degrees);
    let column = |unit: DVec3| c * unit + s * axis.cross(unit) + (1.0 - c) * axis.dot(unit) * axis;
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// Returns the transform that a `<lookat>` element describes. The transform places a camera that looks along its own -z
/// axis.
fn look_at(node: Node) -> Result<DAffine3, Fault> {
    let [a, b, c, d, e, f, g, h, i] = exactly(node)?;
    let eye = DVec3::new(a, b, c);
    let z = (eye - DVec3::new(d, e, f)).normalize_or_zero();
    let x = DVec3::new(g, h, i).cross(z).normalize_or_zero();
    if x == DVec3::ZERO {
        let message = "expected a view direction and an up direction that are not parallel";
        return Err(error_at(node, message));
    }
    Ok(DAffine3::from_cols(x, z.cross(x), z, eye))
}
