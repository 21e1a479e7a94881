//! The canonical form of a scene as bytes, and its digest.
//!
//! The canonical form writes every array with its length, numbers little-endian with all their bits,
//! and texts with their lengths. Two scenes have the same form exactly if they are the same objects
//! with the same arrays, in the same order.

use std::fmt;

use bytemuck::Pod;
use mesh::{Mesh, Rule, Values};

use crate::{Geometry, Object, Scene};

/// BLAKE3 over the canonical form of a scene, 16 bytes of it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest([u8; 16]);

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Scene {
    /// The digest of the scene: equal for equal scenes, on every machine.
    pub fn digest(&self) -> Digest {
        let mut hasher = blake3::Hasher::new();
        self.encode(&mut |bytes| {
            // Threads help with long arrays only.
            if bytes.len() < 1 << 17 {
                hasher.update(bytes);
            } else {
                hasher.update_rayon(bytes);
            }
        });
        let mut digest = [0; 16];
        digest.copy_from_slice(&hasher.finalize().as_bytes()[..16]);
        Digest(digest)
    }

    /// Hands the canonical form to `sink`, piece by piece.
    pub fn encode(&self, sink: &mut impl FnMut(&[u8])) {
        let mut encoder = Encoder { sink };
        encoder.text("meshwright scene 1");
        encoder.len(self.objects().len());
        for object in self.objects() {
            encoder.object(object);
        }
    }
}

struct Encoder<'a, S> {
    sink: &'a mut S,
}

impl<S: FnMut(&[u8])> Encoder<'_, S> {
    fn len(&mut self, n: usize) {
        (self.sink)(&(n as u64).to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.len(text.len());
        (self.sink)(text.as_bytes());
    }

    /// An array of numbers, or of structs of numbers of `width` bytes each.
    fn array<T: Pod>(&mut self, values: &[T], width: usize) {
        self.len(values.len());
        let bytes: &[u8] = bytemuck::cast_slice(values);
        if cfg!(target_endian = "little") {
            (self.sink)(bytes);
        } else {
            for number in bytes.chunks_exact(width) {
                let mut number = number.to_vec();
                number.reverse();
                (self.sink)(&number);
            }
        }
    }

    fn object(&mut self, object: &Object) {
        self.text(&object.name);
        self.len(object.materials.len());
        for m in &object.materials {
            self.text(&m.name);
            self.array(&m.base_color, 8);
            self.array(&[m.metallic, m.roughness], 8);
            self.text(m.base_color_texture.as_deref().unwrap_or(""));
        }
        self.text(object.geometry.kind());
        match &object.geometry {
            Geometry::Mesh(mesh) => self.mesh(mesh),
            Geometry::Patches(patches) => {
                self.len(patches.len());
                for patch in patches {
                    self.array(patch.points().as_flattened(), 8);
                }
            }
            Geometry::Curve(curve) => self.array(curve.points(), 8),
            Geometry::Polylines(lines) => {
                self.len(lines.len());
                for line in lines {
                    self.array(line, 8);
                }
            }
        }
    }

    fn mesh(&mut self, mesh: &Mesh) {
        let dense;
        let mesh = if mesh.is_dense() {
            mesh
        } else {
            let mut compacted = mesh.clone();
            compacted.compact();
            dense = compacted;
            &dense
        };
        let c = mesh.connectivity();
        self.array(&c.next, 4);
        self.array(&c.origin, 4);
        self.array(&c.face, 4);
        self.array(&c.vertex_half_edge, 4);
        self.array(&c.face_half_edge, 4);
        self.array(mesh.positions(), 8);
        self.len(mesh.attributes().iter().count());
        for (domain, column) in mesh.attributes().iter() {
            self.text(&format!("{domain} {}", column.name));
            self.text(match column.rule {
                Rule::Interpolate => "interpolate",
                Rule::Normal => "normal",
                Rule::Copy => "copy",
                Rule::Drop => "drop",
            });
            self.text(column.values.type_name());
            match &column.values {
                Values::Float(v) => self.array(v, 8),
                Values::Vec2(v) => self.array(v, 8),
                Values::Vec3(v) => self.array(v, 8),
                Values::Vec4(v) => self.array(v, 8),
                Values::Int(v) => self.array(v, 4),
                Values::Tag(v) => {
                    self.array(&v.iter().map(|&b| u8::from(b)).collect::<Vec<_>>(), 1);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::{DVec3, shapes};

    fn scene(mesh: Mesh) -> Scene {
        let mut scene = Scene::new();
        scene.insert(Object::mesh("a", mesh)).unwrap();
        scene
    }

    #[test]
    fn equal_scenes_have_equal_digests() {
        assert_eq!(
            scene(shapes::cube()).digest(),
            scene(shapes::cube()).digest()
        );
    }

    #[test]
    fn one_bit_of_a_position_changes_the_digest() {
        let mut moved = shapes::cube();
        moved.positions_mut()[3] += DVec3::new(f64::EPSILON, 0.0, 0.0);
        assert_ne!(scene(shapes::cube()).digest(), scene(moved).digest());
    }

    #[test]
    fn the_digest_of_a_known_scene_never_changes() {
        // The value that the first version of the canonical form gave. A change of it breaks every
        // digest that users have recorded, so it needs a new version in the form's first text.
        assert_eq!(
            scene(shapes::square()).digest().to_string(),
            "2387ae96ff730dac6ab311d51d5863e9"
        );
    }

    #[test]
    fn dead_elements_do_not_count() {
        let mut with_dead = shapes::grid(2, 1);
        with_dead.delete_face(mesh::FaceId::new(0)).unwrap();
        with_dead.delete_isolated_vertices();
        let mut compacted = with_dead.clone();
        compacted.compact();
        assert_eq!(scene(with_dead).digest(), scene(compacted).digest());
    }
}
