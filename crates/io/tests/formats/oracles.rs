//! Tests that compare this crate with other readers. In these tests, simple parsers check the bytes of PLY and OFF
//! files that this crate writes. The crate `mesh_loader` reads STL files that this crate writes, and the crate `tobj`
//! reads generated OBJ files of many dialects.

use geometry::shapes;
use glam::DVec3;
use mesh::{Mesh, VertexId};
use proptest::prelude::*;
use scene::Object;

use crate::{Folder, polygons, read, write};

fn samples() -> [Mesh; 5] {
    [
        shapes::cube(),
        shapes::fans(&shapes::grid(4, 3)),
        shapes::cylinder(7, true),
        shapes::uv_sphere(6, 4),
        Mesh::default(),
    ]
}

fn written(mesh: &Mesh, extension: &str) -> Vec<u8> {
    let folder = Folder::new();
    let path = folder.path(&format!("a.{extension}"));
    write(&path, [Object::mesh("a", mesh.clone())]);
    std::fs::read(path).unwrap()
}

#[test]
fn off_files_have_the_expected_words_in_order() {
    for mesh in samples() {
        let text = String::from_utf8(written(&mesh, "off")).unwrap();
        let mut words = text.split_whitespace();
        assert_eq!(words.next(), Some("OFF"));
        let mut numbers = words.map(|word| word.parse::<f64>().unwrap());
        let mut next = || numbers.next().unwrap();
        let counts = [next(), next(), next()];
        let expected = [mesh.n_vertices(), mesh.n_faces(), mesh.n_edges()];
        assert_eq!(counts, expected.map(|n| n as f64));
        for p in mesh.positions() {
            assert_eq!(DVec3::new(next(), next(), next()), *p);
        }
        for corners in polygons(&mesh) {
            assert_eq!(next(), corners.len() as f64);
            assert!(corners.iter().all(|&v| next() == v as f64));
        }
        assert_eq!(numbers.next(), None);
    }
}

#[test]
fn ply_files_without_attributes_are_doubles_and_lists() {
    for mesh in samples() {
        let bytes = written(&mesh, "ply");
        let head = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
             property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            mesh.n_vertices(),
            mesh.n_faces()
        );
        let mut rest = bytes.strip_prefix(head.as_bytes()).unwrap();
        let mut take = |n: usize| {
            let (taken, behind) = rest.split_at(n);
            rest = behind;
            taken.to_vec()
        };
        for p in mesh.positions() {
            for x in p.to_array() {
                assert_eq!(take(8), x.to_le_bytes());
            }
        }
        for corners in polygons(&mesh) {
            assert_eq!(usize::from(take(1)[0]), corners.len());
            for v in corners {
                assert_eq!(take(4), u32::try_from(v).unwrap().to_le_bytes());
            }
        }
        assert!(rest.is_empty());
    }
}

/// Positions are compared instead of indices, because the crate `mesh_loader` returns three separate vertices for each
/// facet.
#[test]
fn another_reader_finds_the_same_facets_in_stl_files() {
    for mesh in [
        shapes::tetrahedron(),
        shapes::fans(&shapes::uv_sphere(6, 4)),
    ] {
        let found = mesh_loader::stl::from_slice(&written(&mesh, "stl")).unwrap();
        let [found] = &found.meshes[..] else {
            panic!("expected one mesh, found {}", found.meshes.len())
        };
        let theirs = found
            .faces
            .iter()
            .map(|face| face.map(|v| found.vertices[v as usize]));
        let place = |v: VertexId| mesh.position(v).as_vec3().to_array();
        let ours = mesh
            .faces()
            .map(|f| mesh.face_vertices(f).map(place).collect::<Vec<_>>());
        assert_eq!(
            theirs.map(Vec::from).collect::<Vec<_>>(),
            ours.collect::<Vec<_>>()
        );
    }
}

/// How a corner is written in an OBJ file: whether it has a texture coordinate and a normal, and which of its indices
/// are negative.
#[derive(Clone, Copy, Debug)]
struct Spelling {
    has_uv: bool,
    has_normal: bool,
    negative: [bool; 3],
}

fn spelling() -> impl Strategy<Value = Spelling> {
    any::<(bool, bool, [bool; 3])>().prop_map(|(has_uv, has_normal, negative)| Spelling {
        has_uv,
        has_normal,
        negative,
    })
}

/// The number of positions, which is also the number of texture coordinates and of normals.
const COUNT: usize = 12;

impl Spelling {
    fn text(self, v: usize) -> String {
        let number = |negative: bool| {
            if negative {
                format!("-{}", COUNT - v)
            } else {
                format!("{}", v + 1)
            }
        };
        let [p, uv, normal] = self.negative.map(number);
        match (self.has_uv, self.has_normal) {
            (false, false) => p,
            (true, false) => format!("{p}/{uv}"),
            (false, true) => format!("{p}//{normal}"),
            (true, true) => format!("{p}/{uv}/{normal}"),
        }
    }
}

proptest! {
    /// Texture coordinates and normals are compared only at corners that have them. At a corner without such values,
    /// the crate `tobj` returns the values of a different corner.
    #[test]
    fn tobj_reads_the_same_corners_of_any_dialect(
        points in prop::collection::vec((-1e3..1e3_f64, -10..10_i32, any::<i16>()), COUNT),
        faces in prop::collection::vec((prop::sample::subsequence((0..COUNT).collect::<Vec<_>>(), 3..6)
            .prop_shuffle(), prop::collection::vec(spelling(), 6)), 1..8),
        end in prop::sample::select(vec!["\n", "\r\n", " \n", "\t\r\n", "\n\n", "\n# f 1 2 3\n"]),
        blank in prop::sample::select(vec![" ", "  ", "\t", " \t "]),
    ) {
        let mut text = String::new();
        for (i, (x, y, z)) in points.iter().enumerate() {
            let numbers = [format!("v {x:e} {y} {z}.5"), format!("vt 0.{i} .5"), format!("vn {y}. {z}E-3 +1")];
            for line in numbers {
                text += &(line.replace(' ', blank) + end);
            }
        }
        for (corners, spellings) in &faces {
            let words = corners.iter().zip(spellings).map(|(&v, spelling)| blank.to_owned() + &spelling.text(v));
            text += &format!("f{}{end}", words.collect::<String>());
        }
        let options = tobj::LoadOptions::default();
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default())).unwrap();
        let [model] = &models[..] else { panic!("expected one model, found {}", models.len()) };
        let theirs = &model.mesh;

        let folder = Folder::new();
        let path = folder.with("a.obj", &text);
        let found = mesh_io::read_polygons(&store::Disk, &path, &mesh_io::ReadOptions::default()).unwrap();
        let ours = &found[0].1;
        prop_assert_eq!(ours.corners.len(), theirs.indices.len());
        let column = |name| ours.attributes.column(mesh::Domain::Corner, name).map(|c| &c.values);
        let spellings = faces.iter().flat_map(|(corners, spellings)| &spellings[..corners.len()]);
        for (c, spelling) in spellings.enumerate() {
            let p = theirs.indices[c] as usize;
            let position = DVec3::from_slice(&theirs.positions[3 * p..]);
            prop_assert_eq!(ours.positions[ours.corners[c] as usize], position);
            if spelling.has_uv {
                let t = theirs.texcoord_indices[c] as usize;
                let Some(mesh::Values::Vec2(uvs)) = column("uv") else { panic!("no texture coordinates") };
                prop_assert_eq!(&uvs[c].to_array()[..], &theirs.texcoords[2 * t..2 * t + 2]);
            }
            if spelling.has_normal {
                let n = theirs.normal_indices[c] as usize;
                let Some(mesh::Values::Vec3(normals)) = column("normal") else { panic!("no normals") };
                prop_assert_eq!(&normals[c].to_array()[..], &theirs.normals[3 * n..3 * n + 3]);
            }
        }
        // The result stays the same with other line ends, and with lines that continue after a backslash.
        for (from, to) in [("\n", "\r"), (" ", " \\\n")] {
            let other = text.replace("\r\n", "\n").replace(from, to);
            let other = folder.with("b.obj", other);
            if end.contains('#') { continue; }
            let again = mesh_io::read_polygons(&store::Disk, &other, &mesh_io::ReadOptions::default()).unwrap();
            prop_assert_eq!(&again[0].1, ours);
        }
        prop_assert!(read(&path).is_ok());
    }
}
