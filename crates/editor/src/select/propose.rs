//! Finds the selections of recipes that describe the picked elements.
//!
//! A selection describes the picked elements if it selects exactly these elements. Candidates are tried in this order:
//! `All`, tags, the boundary, selections that exist only for the kind of the picked elements (such as `EdgeLoop` for
//! edges), and lists of indices. If a single element is picked, its index is tried first. Each candidate is evaluated
//! on the mesh, and is kept if it selects exactly the picked elements.

use mesh::{Domain, EdgeId, FaceId, Id, MATERIAL, Mesh, Values, VertexId};
use op::{ElementKind, Selected};
use recipe::{read_selection, resolve};
use ron_tree::string_literal;
use scene::{Object, Scene};

use super::Picked;
use crate::panel::number;

/// A selection that lists indices is proposed only if at most this many elements are picked.
const MAX_LISTED: usize = 8;

/// A selection that selects exactly the picked elements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proposal {
    /// The selection as RON.
    pub text: String,
    /// A step that adds the tag that the selection uses. This step must be inserted before the selection is used.
    pub before: Option<String>,
}

/// Returns the selections that select exactly the picked elements of an object. The best selection is the first. The
/// selections are written as `Expect(count: .., of: ..)`, so that a later run fails if the number of elements has
/// changed. Lists of indices and `All` are written without `Expect`.
///
/// `stream` is the label of the step, which seeds random choices. The list is empty if nothing is picked, or if the
/// object is not a mesh.
pub fn propose(scene: &Scene, picked: &Picked, stream: &str) -> Vec<Proposal> {
    let Some(object) = scene.object(&picked.object) else {
        return Vec::new();
    };
    let Some(mesh) = object.as_mesh() else {
        return Vec::new();
    };
    if picked.is_empty() || picked.existing(mesh).len() != picked.len() {
        return Vec::new();
    }
    let mut proposals: Vec<Proposal> = Vec::new();
    for Candidate { text, is_closed } in candidates(object, mesh, &picked.elements) {
        let text = if is_closed {
            text
        } else {
            format!("Expect(count: {}, of: {text})", picked.len())
        };
        if proposals.iter().all(|known| known.text != text)
            && means(&text, scene, object, picked, stream)
        {
            proposals.push(Proposal { text, before: None });
        }
    }
    if proposals.is_empty() || picked.len() > MAX_LISTED {
        proposals.push(by_new_tag(mesh, picked));
    }
    proposals
}

/// If one element is picked, returns the first selection that [`propose`] would return. The other elements of the mesh
/// are not visited, because this would take a long time in a large mesh. Returns `None` if several elements are picked.
pub(crate) fn propose_one(scene: &Scene, picked: &Picked) -> Option<Proposal> {
    let object = scene.object(&picked.object)?;
    let mesh = object.as_mesh()?;
    if picked.len() != 1 || picked.existing(mesh).len() != 1 {
        return None;
    }
    let text = by_number(mesh, &picked.elements);
    means(&text, scene, object, picked, "").then_some(Proposal { text, before: None })
}

/// Whether a selection selects exactly the picked elements.
fn means(text: &str, scene: &Scene, object: &Object, picked: &Picked, stream: &str) -> bool {
    let (Ok(elements), Some(mesh)) = (read_selection(text, Some(picked.kind())), object.as_mesh())
    else {
        return false;
    };
    let found = resolve(&elements, scene, object, mesh, stream);
    found.is_ok_and(|found| found == picked.elements)
}

/// A candidate: a selection that must still be tested, because it may select other elements than the picked ones.
struct Candidate {
    text: String,
    /// Whether the selection is written without `Expect`. `All` needs no `Expect`. A list of indices needs no `Expect`
    /// either, because it fails if one of its elements does not exist.
    is_closed: bool,
}

fn candidates(object: &Object, mesh: &Mesh, elements: &Selected) -> Vec<Candidate> {
    let mut open: Vec<String> = Vec::new();
    let domain = match elements {
        Selected::Vertices(_) => Domain::Vertex,
        Selected::Edges(_) => Domain::Edge,
        Selected::Faces(_) => Domain::Face,
    };
    for column in mesh.attributes().of(domain) {
        if matches!(column.values, Values::Tag(_)) {
            open.push(format!("Tagged({})", string_literal(&column.name)));
        }
    }
    open.push("Boundary".to_owned());
    let listed = listed(mesh, elements);
    match elements {
        Selected::Vertices(list) => of_vertices(mesh, list, &mut open),
        Selected::Edges(list) => of_edges(mesh, list, &mut open),
        Selected::Faces(list) => of_faces(object, mesh, list, &mut open),
    }
    let mut all = vec![Candidate {
        text: "All".to_owned(),
        is_closed: true,
    }];
    let open = open.into_iter().map(|text| Candidate {
        text,
        is_closed: false,
    });
    let listed = listed.map(|text| Candidate {
        text,
        is_closed: true,
    });
    // If a single element is picked, its index is tried first.
    if elements.len() == 1 {
        all.clear();
        all.extend(listed);
        all.extend(open);
    } else {
        all.extend(open);
        all.extend(listed);
    }
    all
}

fn of_vertices(mesh: &Mesh, list: &[VertexId], open: &mut Vec<String>) {
    let first = list[0];
    open.push("Isolated".to_owned());
    open.push(format!("Component(Vertices([{}]))", first.index()));
    let valence = mesh.valence(first);
    if list.iter().all(|&v| mesh.valence(v) == valence) {
        open.push(format!("Valence({valence})"));
    }
}

fn of_edges(mesh: &Mesh, list: &[EdgeId], open: &mut Vec<String>) {
    let first = between(mesh, list[0]);
    open.push(format!("EdgeLoop({first})"));
    open.push(format!("EdgeRing({first})"));
    if let Some((from, to)) = path_ends(mesh, list) {
        open.push(format!("Path(from: {from}, to: {to})"));
        open.push(format!("Path(from: {to}, to: {from})"));
    }
    open.push(format!("Component({first})"));
    let ends = ends(mesh, list);
    if ends.len() <= MAX_LISTED {
        open.push(format!("EdgesWithin(Vertices([{}]))", joined(&ends)));
    }
    let mut picked = vec![false; mesh.domain_len(Domain::Edge)];
    for e in list {
        picked[e.index()] = true;
    }
    let dihedral = mesh.dihedral_angles();
    let angle = |e: EdgeId| dihedral(e).map(f64::to_degrees);
    if let Some(limit) = threshold(
        mesh.edges()
            .filter_map(|e| Some((angle(e)?, picked[e.index()]))),
    ) {
        open.push(format!("Sharp(above: {limit})"));
    }
    let flat = mesh
        .edges()
        .filter_map(|e| Some((-angle(e)?, picked[e.index()])));
    if let Some(limit) = threshold(flat) {
        open.push(format!("Flat(below: {})", limit.trim_start_matches('-')));
    }
    let length = |e: EdgeId| mesh.length(e.half_edge());
    if let Some(limit) = threshold(mesh.edges().map(|e| (length(e), picked[e.index()]))) {
        open.push(format!("Longer(than: {limit})"));
    }
    if let Some(limit) = threshold(mesh.edges().map(|e| (-length(e), picked[e.index()]))) {
        open.push(format!("Shorter(than: {})", limit.trim_start_matches('-')));
    }
}

fn of_faces(object: &Object, mesh: &Mesh, list: &[FaceId], open: &mut Vec<String>) {
    let first = list[0];
    if let Some(materials) = mesh.get(MATERIAL)
        && let Some(material) = usize::try_from(materials[first.index()]).ok()
        && let Some(material) = object.materials.get(material)
    {
        open.push(format!("Material({})", string_literal(&material.name)));
    }
    let mut picked = vec![false; mesh.domain_len(Domain::Face)];
    for f in list {
        picked[f.index()] = true;
    }
    open.push(format!("Component(Faces([{}]))", first.index()));
    if let Some(angle) = spread_angle(mesh, &picked) {
        open.push(format!(
            "Expand(to_angle: {angle}, of: Faces([{}]))",
            first.index()
        ));
    }
    if let Some(text) = facing(mesh, &picked) {
        open.push(text);
    }
    let degree = mesh.degree(first);
    if list.iter().all(|&f| mesh.degree(f) == degree) {
        open.push(format!("Degree({degree})"));
    }
}

/// Returns a selection that lists the indices of the elements, if there are only a few elements.
fn listed(mesh: &Mesh, elements: &Selected) -> Option<String> {
    (elements.len() <= MAX_LISTED).then(|| by_number(mesh, elements))
}

/// Returns a selection that lists the indices of the elements.
fn by_number(mesh: &Mesh, elements: &Selected) -> String {
    match elements {
        Selected::Vertices(list) => format!("Vertices([{}])", joined(list)),
        Selected::Faces(list) => format!("Faces([{}])", joined(list)),
        Selected::Edges(list) => edges_by_ends(mesh, list),
    }
}

fn joined<I: Id>(list: &[I]) -> String {
    let numbers: Vec<String> = list.iter().map(|id| id.index().to_string()).collect();
    numbers.join(", ")
}

/// Returns the end vertices of edges, in the order of the indices of the vertices.
fn ends(mesh: &Mesh, list: &[EdgeId]) -> Vec<VertexId> {
    let mut ends: Vec<VertexId> = list.iter().flat_map(|&e| mesh.edge_vertices(e)).collect();
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Whether the list contains every edge of the mesh that joins two of the vertices in `ends`.
fn are_all_within(mesh: &Mesh, list: &[EdgeId], ends: &[VertexId]) -> bool {
    let mut marks = vec![false; mesh.domain_len(Domain::Vertex)];
    for v in ends {
        marks[v.index()] = true;
    }
    let is_within = |e: &EdgeId| mesh.edge_vertices(*e).iter().all(|v| marks[v.index()]);
    mesh.edges().filter(is_within).count() == list.len()
}

/// Returns the text of a list of edges, in which each edge is given by its two ends.
fn edges_by_ends(mesh: &Mesh, list: &[EdgeId]) -> String {
    match list {
        [one] => between(mesh, *one),
        list => {
            let all: Vec<String> = list.iter().map(|&e| between(mesh, e)).collect();
            format!("Or([{}])", all.join(", "))
        }
    }
}

fn between(mesh: &Mesh, e: EdgeId) -> String {
    let [v, w] = mesh.edge_vertices(e).map(VertexId::index);
    format!("Between({}, {})", v.min(w), v.max(w))
}

/// Returns a selection that uses a new tag. Also returns the step that gives this tag to the elements. The step lists
/// the elements by their indices.
fn by_new_tag(mesh: &Mesh, picked: &Picked) -> Proposal {
    let (operation, field, domain) = match picked.kind() {
        ElementKind::Vertices => ("TagVertices", "vertices", Domain::Vertex),
        ElementKind::Edges => ("TagEdges", "edges", Domain::Edge),
        ElementKind::Faces => ("TagFaces", "faces", Domain::Face),
    };
    let is_used = |name: &String| mesh.attributes().column(domain, name).is_some();
    let mut names = (1..).map(|n| format!("picked {n}"));
    let name = names
        .find(|name| !is_used(name))
        .expect("a mesh has finitely many tags");
    let name = string_literal(&name);
    let numbers = match &picked.elements {
        // If there are many edges, the list of their end vertices is shorter than the list of the edges.
        Selected::Edges(list) => {
            let ends = ends(mesh, list);
            if are_all_within(mesh, list, &ends) {
                format!("EdgesWithin(Vertices([{}]))", joined(&ends))
            } else {
                by_number(mesh, &picked.elements)
            }
        }
        elements => by_number(mesh, elements),
    };
    Proposal {
        text: format!("Expect(count: {}, of: Tagged({name}))", picked.len()),
        before: Some(format!("{operation}(name: {name}, {field}: {numbers})")),
    }
}

/// Returns the two ends of a path of edges. A vertex is an end of the path if it belongs to exactly one of the edges.
/// Returns `None` if the number of ends is not 2, or if a vertex belongs to more than two of the edges.
fn path_ends(mesh: &Mesh, list: &[EdgeId]) -> Option<(usize, usize)> {
    let mut ends: Vec<usize> = list
        .iter()
        .flat_map(|&e| mesh.edge_vertices(e))
        .map(VertexId::index)
        .collect();
    ends.sort_unstable();
    let runs = ends.chunk_by(|a, b| a == b);
    let mut single = Vec::new();
    for run in runs {
        match run.len() {
            1 => single.push(run[0]),
            2 => {}
            _ => return None,
        }
    }
    match single[..] {
        [from, to] => Some((from, to)),
        _ => None,
    }
}

/// Returns a limit that is less than all values of picked elements and greater than all values of other elements. The
/// limit has few digits if the gap between these values allows it. Returns `None` if no limit separates the picked
/// elements from the other elements. Also returns `None` if the gap between their values is as small as a rounding
/// error.
fn threshold(values: impl Iterator<Item = (f64, bool)>) -> Option<String> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (value, is_picked) in values {
        if is_picked {
            high = high.min(value);
        } else {
            low = low.max(value);
        }
    }
    if !high.is_finite() {
        return None;
    }
    let scale = high
        .abs()
        .max(if low.is_finite() { low.abs() } else { 0.0 });
    if !low.is_finite() {
        // No element outside the picked elements has a value.
        return None;
    }
    (high - low > 1e-6 * scale).then(|| short_between(low, high))
}

/// Returns a number between `low` and `high` that has few digits and lies in the middle half of the interval.
fn short_between(low: f64, high: f64) -> String {
    let (a, b) = (low + (high - low) * 0.25, high - (high - low) * 0.25);
    let middle = f64::midpoint(low, high);
    for digits in 1..17 {
        let text = format!("{middle:.*e}", digits - 1);
        if let Ok(short) = text.parse::<f64>()
            && short >= a
            && short <= b
        {
            return number(short);
        }
    }
    number(middle)
}

/// The selection `Expand` can start at the first picked face, and spread over all edges whose angle is at most a limit.
/// Returns a suitable limit. The limit is greater than all angles between neighboring picked faces, and less than all
/// angles at the border of the picked faces.
fn spread_angle(mesh: &Mesh, picked: &[bool]) -> Option<String> {
    let angle = mesh.dihedral_angles();
    let (mut inside, mut border) = (0.0_f64, f64::INFINITY);
    for e in mesh.edges() {
        let [Some(f), Some(g)] = mesh.edge_faces(e) else {
            continue;
        };
        let Some(angle) = angle(e).map(f64::to_degrees) else {
            continue;
        };
        match (picked[f.index()], picked[g.index()]) {
            (true, true) => inside = inside.max(angle),
            (false, false) => {}
            _ => border = border.min(angle),
        }
    }
    (border.is_finite() && border - inside > 1e-3).then(|| short_between(inside, border))
}

/// Returns the selection `Facing` with the mean normal of the picked faces as its direction.
fn facing(mesh: &Mesh, picked: &[bool]) -> Option<String> {
    let mut mean = mesh::DVec3::ZERO;
    for f in mesh.faces().filter(|f| picked[f.index()]) {
        mean += mesh.area_vector(f);
    }
    let mut direction = mean.normalize_or_zero();
    if direction == mesh::DVec3::ZERO {
        return None;
    }
    // The direction is rounded to three decimals, because a short number is easier to read in a recipe.
    direction = (direction * 1000.0).round() / 1000.0;
    let angle = |f: FaceId| mesh::angle_between(mesh.face_normal(f), direction).to_degrees();
    let limit = threshold(mesh.faces().map(|f| (-angle(f), picked[f.index()])))?;
    let direction = direction
        .to_array()
        .map(|x| number(if x == 0.0 { 0.0 } else { x }));
    Some(format!(
        "Facing(direction: ({}), within: {})",
        direction.join(", "),
        limit.trim_start_matches('-')
    ))
}
