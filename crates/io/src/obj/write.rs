//! From a scene to the text of an OBJ file and its material library.

use std::path::Path;

use glam::DVec3;
use mesh::{CORNER_NORMAL, Domain, Mesh, UV, VERTEX_NORMAL, Values};
use scene::{Geometry, Scene};

use super::file::NO_MATERIAL;
use super::material::{push_values, write_library};
use super::states::{FaceStates, Library, State, fit_line, one_word};
use crate::corners::Numbering;
use crate::dense::dense;
use crate::error::Unwritable;
use crate::loss::Losses;
use crate::{WriteOptions, Written};

/// The files that hold `scene`, to be renamed in this order, and what they do not hold: the material
/// library, if there are materials, and the OBJ file.
///
/// # Errors
///
/// If an object is neither a mesh nor polylines.
pub(crate) fn write(
    path: &Path,
    scene: &Scene,
    options: &WriteOptions,
) -> Result<Written, Unwritable> {
    let mut losses = Vec::new();
    let mut library = Library::default();
    for object in scene.objects() {
        library.add(object, &mut Losses::of(&object.name, &mut losses));
    }
    let mut writer = Writer::default();
    if let Some(comment) = &options.provenance {
        push_comment(&mut writer.out, comment);
    }
    let library_path = path.with_extension("mtl");
    if let (false, Some(file_name)) = (library.materials.is_empty(), library_path.file_name()) {
        writer.push_name("mtllib", &file_name.to_string_lossy());
    }
    for (i, object) in scene.objects().iter().enumerate() {
        let mut losses = Losses::of(&object.name, &mut losses);
        let several = scene.objects().len() > 1;
        if several {
            let name = fit_line(&object.name);
            losses.add(
                None,
                "name",
                usize::from(*name != object.name),
                format!("written as `{name}`"),
            );
            writer.push_name("o", &name);
        }
        match &object.geometry {
            Geometry::Mesh(mesh) => {
                let dense = dense(mesh);
                writer.mesh(&dense, &library.places[i], &library, several, &mut losses);
            }
            Geometry::Polylines(lines) => writer.polylines(lines),
            Geometry::Patches(_) | Geometry::Curve(_) => {
                return Err(Unwritable::object(
                    &object.name,
                    format!(
                        "OBJ files hold meshes and polylines, found {}",
                        object.geometry.kind()
                    ),
                ));
            }
        }
    }
    let mut files = Vec::new();
    if !library.materials.is_empty() {
        files.push((
            library_path,
            write_library(&library.materials, options.provenance.as_deref()),
        ));
    }
    files.push((path.to_path_buf(), writer.out));
    Ok(Written { files, losses })
}

/// Appends a comment, each of its lines behind a `#`.
pub(super) fn push_comment(out: &mut Vec<u8>, comment: &str) {
    for line in comment.split(['\n', '\r']) {
        out.extend_from_slice(format!("# {line}\n").as_bytes());
    }
}

// ---- Statements --------------------------------------------------------------------------------

#[derive(Default)]
struct Writer {
    out: Vec<u8>,
    n_positions: usize,
    n_uvs: usize,
    n_normals: usize,
    /// What is in force at the end of the object before; groups are closed there.
    material: Option<usize>,
    smoothing: i32,
}

impl Writer {
    fn polylines(&mut self, lines: &[Vec<DVec3>]) {
        for line in lines {
            for &point in line {
                push_values(&mut self.out, "v", &point.to_array());
            }
        }
        for line in lines.iter().filter(|line| !line.is_empty()) {
            self.out.push(if line.len() < 2 { b'p' } else { b'l' });
            for _ in line {
                self.n_positions += 1;
                self.out.push(b' ');
                push_whole(&mut self.out, self.n_positions);
            }
            self.out.push(b'\n');
        }
    }

    fn mesh(
        &mut self,
        mesh: &Mesh,
        places: &[usize],
        library: &Library,
        several: bool,
        losses: &mut Losses,
    ) {
        let uvs = mesh.get(UV);
        let corner_normals = mesh.get(CORNER_NORMAL);
        let vertex_normals = mesh.get(VERTEX_NORMAL).filter(|_| corner_normals.is_none());
        let colors = mesh.get(mesh::COLOR);
        losses.add_columns(mesh, "OBJ", |domain, column| {
            match (domain, column.name.as_str()) {
                (Domain::Corner, "uv") => uvs.is_some(),
                (Domain::Corner, "normal") => corner_normals.is_some(),
                (Domain::Vertex, "normal") => vertex_normals.is_some(),
                (Domain::Vertex, "color") => colors.is_some(),
                (Domain::Face, "material") => mesh.get(mesh::MATERIAL).is_some(),
                (Domain::Face, "smoothing") => mesh.get(mesh::SMOOTHING).is_some(),
                (Domain::Face, _) => matches!(column.values, Values::Tag(_)),
                _ => false,
            }
        });
        self.vertices(mesh, losses);
        let corners: Vec<_> = mesh.faces().flat_map(|f| mesh.face_half_edges(f)).collect();
        let uv_numbers = uvs.map(|uvs| {
            let values = corners
                .iter()
                .map(|&h| (mesh.origin(h).index(), uvs[h.index()].to_array()));
            let first = self.n_uvs;
            push_numbered(
                &mut self.out,
                "vt",
                mesh,
                values,
                (first, "uv"),
                &mut self.n_uvs,
                losses,
            )
        });
        let normal_numbers = (corner_normals.is_some() || vertex_normals.is_some()).then(|| {
            let values = corners.iter().map(|&h| {
                let v = mesh.origin(h).index();
                let normal = corner_normals.map(|n| n[h.index()]);
                let normal = normal.or(vertex_normals.map(|n| n[v])).unwrap_or_default();
                (v, normal.to_array())
            });
            let first = self.n_normals;
            push_numbered(
                &mut self.out,
                "vn",
                mesh,
                values,
                (first, "normal"),
                &mut self.n_normals,
                losses,
            )
        });
        if let Some(normals) = vertex_normals {
            let isolated = mesh.vertices().filter(|&v| {
                mesh.vertex_half_edge(v).is_none() && normals[v.index()] != DVec3::ZERO
            });
            losses.add(
                Domain::Vertex,
                "normal",
                isolated.count(),
                "OBJ gives normals to face corners, and isolated vertices have none",
            );
        }
        let faces = FaceStates::new(mesh, places, several, losses);
        let mut state = State {
            material: self.material,
            smoothing: self.smoothing,
            ..State::default()
        };
        let mut c = 0;
        for f in mesh.faces() {
            let next = faces.of(f);
            if next != state {
                self.change(&state, &next, library);
                state = next;
            }
            self.out.push(b'f');
            for h in mesh.face_half_edges(f) {
                self.out.push(b' ');
                push_whole(&mut self.out, self.n_positions + mesh.origin(h).index() + 1);
                if let Some(numbers) = &uv_numbers {
                    self.out.push(b'/');
                    push_whole(&mut self.out, numbers[c]);
                }
                if let Some(numbers) = &normal_numbers {
                    self.out
                        .extend_from_slice(if uv_numbers.is_some() { b"/" } else { b"//" });
                    push_whole(&mut self.out, numbers[c]);
                }
                c += 1;
            }
            self.out.push(b'\n');
        }
        if !state.groups.is_empty() {
            self.out.extend_from_slice(b"g\n");
        }
        self.material = state.material;
        self.smoothing = state.smoothing;
        self.n_positions += mesh.n_vertices();
    }

    fn vertices(&mut self, mesh: &Mesh, losses: &mut Losses) {
        let Some(colors) = mesh.get(mesh::COLOR) else {
            for position in mesh.positions() {
                push_values(&mut self.out, "v", &position.to_array());
            }
            return;
        };
        let (mut translucent, mut broken) = (0, 0);
        for (p, color) in mesh.positions().iter().zip(colors) {
            translucent += usize::from((color.w - 1.0).abs() > 0.0);
            let [r, g, b] = finite(color.truncate().to_array(), &mut broken);
            push_values(&mut self.out, "v", &[p.x, p.y, p.z, r, g, b]);
        }
        losses.add(
            Domain::Vertex,
            "color",
            translucent,
            "OBJ has no place for alpha",
        );
        losses.add(Domain::Vertex, "color", broken, "not finite: written as 0");
    }

    /// Writes the statements that lead from one state to another.
    fn change(&mut self, from: &State, to: &State, library: &Library) {
        if let (true, Some(object)) = (to.object != from.object, to.object) {
            self.push_name("o", object);
        }
        if to.groups != from.groups {
            self.out.push(b'g');
            for group in &to.groups {
                self.out.push(b' ');
                self.out.extend_from_slice(one_word(group).as_bytes());
            }
            self.out.push(b'\n');
        }
        if to.material != from.material {
            let name = to
                .material
                .map(|place| library.materials[place].name.as_bytes());
            self.out.extend_from_slice(b"usemtl ");
            self.out.extend_from_slice(name.unwrap_or(NO_MATERIAL));
            self.out.push(b'\n');
        }
        if to.smoothing != from.smoothing {
            self.out.extend_from_slice(b"s ");
            let group = usize::try_from(to.smoothing).unwrap_or(0);
            push_whole(&mut self.out, group);
            self.out.push(b'\n');
        }
    }

    fn push_name(&mut self, keyword: &str, name: &str) {
        self.out
            .extend_from_slice(format!("{keyword} {name}\n").as_bytes());
    }
}

/// Writes each different value of a vertex's corners once and returns the numbers of the values of
/// all corners, from `before + 1`.
fn push_numbered<const N: usize>(
    out: &mut Vec<u8>,
    keyword: &str,
    mesh: &Mesh,
    values: impl Iterator<Item = (usize, [f64; N])>,
    (before, attribute): (usize, &str),
    count: &mut usize,
    losses: &mut Losses,
) -> Vec<usize> {
    let mut numbering = Numbering::new(mesh.n_vertices());
    let mut broken = 0;
    let mut numbers = Vec::new();
    for (v, value) in values {
        let value = finite(value, &mut broken);
        let (number, new) = numbering.number(v, value.map(f64::to_bits));
        if new {
            push_values(out, keyword, &value);
            *count += 1;
        }
        numbers.push(before + number as usize + 1);
    }
    losses.add(
        Domain::Corner,
        attribute,
        broken,
        "not finite: written as 0",
    );
    numbers
}

/// The values, zero in place of all if one is not finite, which is counted.
fn finite<const N: usize>(values: [f64; N], broken: &mut usize) -> [f64; N] {
    if values.iter().all(|x| x.is_finite()) {
        values
    } else {
        *broken += 1;
        [0.0; N]
    }
}

fn push_whole(out: &mut Vec<u8>, value: usize) {
    let mut digits = [0; 20];
    let mut start = digits.len();
    let mut rest = value;
    loop {
        start -= 1;
        digits[start] = b"0123456789"[rest % 10];
        rest /= 10;
        if rest == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[start..]);
}
