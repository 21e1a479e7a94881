//! Finds the elements of meshes in an area of the view, which is a box or a lasso.

use mesh::{DVec2, DVec3, Element, Mesh, VertexId};
use op::{ElementKind, Selected};
use scene::Scene;

use super::point::{Target, first_hit};
use super::{Indexes, Projection};
use crate::select::Picked;

/// An area of the view, in pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Area {
    /// A box, given by two opposite corners.
    Box(DVec2, DVec2),
    /// The inside of a polygon, by the even-odd rule.
    Lasso(Vec<DVec2>),
}

impl Area {
    /// Whether a pixel is in the area.
    pub fn contains(&self, p: DVec2) -> bool {
        match self {
            Self::Box(a, b) => {
                let (low, high) = (a.min(*b), a.max(*b));
                p.cmpge(low).all() && p.cmple(high).all()
            }
            Self::Lasso(points) => {
                let next = points.iter().cycle().skip(1);
                let crossings = points.iter().zip(next).filter(|(a, b)| {
                    (a.y > p.y) != (b.y > p.y)
                        && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
                });
                crossings.count() % 2 == 1
            }
        }
    }
}

/// Returns, for each mesh, the elements whose vertices all lie in the area. Elements that other faces hide are
/// included. Meshes that have no elements in the area are left out.
pub fn pick_area(scene: &Scene, view: &Projection, area: &Area, kind: ElementKind) -> Vec<Picked> {
    let mut all: Vec<Picked> = Vec::new();
    for placed in scene.instances() {
        let Some(mesh) = placed.object.as_mesh() else {
            continue;
        };
        let view = view.of_object(placed.to_scene);
        let elements = inside(mesh, &view, area, kind);
        if elements.is_empty() {
            continue;
        }
        let new = Picked::new(&placed.object.name, elements);
        match all
            .iter_mut()
            .find(|known| known.object == placed.object.name)
        {
            Some(known) => known.add(&new),
            None => all.push(new),
        }
    }
    all
}

/// Removes those picked elements that are hidden by faces of the scene. An edge counts as hidden if its midpoint is
/// hidden. A face counts as hidden if its center is hidden.
pub fn keep_visible(scene: &Scene, indexes: &Indexes, view: &Projection, picked: &mut Vec<Picked>) {
    let targets = Target::all(scene, indexes, view);
    for set in &mut *picked {
        let of_object = |(_, target): &(usize, &Target)| target.object == set.object;
        let instances: Vec<(usize, &Target)> =
            targets.iter().enumerate().filter(of_object).collect();
        let is_visible = |element: Element| {
            let mut instances = instances.iter();
            instances.any(|&(i, target)| sees(&targets, i, target, element))
        };
        match &mut set.elements {
            Selected::Vertices(list) => list.retain(|&v| is_visible(v.into())),
            Selected::Edges(list) => list.retain(|&e| is_visible(e.into())),
            Selected::Faces(list) => list.retain(|&f| is_visible(f.into())),
        }
    }
    picked.retain(|set| !set.is_empty());
}

/// Whether an element of an instance is visible: no face of the scene hides it.
fn sees(targets: &[Target], at: usize, target: &Target, element: Element) -> bool {
    let points = target.mesh.element_points(element);
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let Some((pixel, _)) = target.view.to_pixel(middle) else {
        return false;
    };
    let Some((i, hit)) = first_hit(targets, pixel) else {
        return true;
    };
    let triangle = target.index.triangle(hit.triangle);
    let is_at = i == at
        && match element {
            Element::Vertex(v) => triangle.vertices.contains(&v),
            Element::Face(f) => triangle.face == f,
            Element::Edge(e) => {
                let ends = target.mesh.edge_vertices(e);
                ends.iter().all(|v| triangle.vertices.contains(v))
            }
            Element::HalfEdge(_) => false,
        };
    let (origin, direction) = target.view.ray(pixel);
    let t = (middle - origin).dot(direction) / direction.length_squared();
    is_at || hit.t >= t * (1.0 - 1e-7)
}

fn inside(mesh: &Mesh, view: &Projection, area: &Area, kind: ElementKind) -> Selected {
    let mut is_inside = vec![false; mesh.domain_len(mesh::Domain::Vertex)];
    for v in mesh.vertices() {
        let pixel = view.to_pixel(mesh.position(v));
        is_inside[v.index()] = pixel.is_some_and(|(pixel, _)| area.contains(pixel));
    }
    let is_in = |v: VertexId| is_inside[v.index()];
    match kind {
        ElementKind::Vertices => {
            Selected::Vertices(mesh.vertices().filter(|&v| is_in(v)).collect())
        }
        ElementKind::Edges => {
            let edges = mesh
                .edges()
                .filter(|&e| mesh.edge_vertices(e).into_iter().all(is_in));
            Selected::Edges(edges.collect())
        }
        ElementKind::Faces => Selected::Faces(
            mesh.faces()
                .filter(|&f| mesh.face_vertices(f).all(is_in))
                .collect(),
        ),
    }
}
