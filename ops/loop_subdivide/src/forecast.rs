//! How large a mesh becomes, known before anything is computed.

use std::fmt;

use mesh::{Domain, Mesh};
use op::MeshPlan;

/// Ids end at 2^32 - 2, so this many elements of a kind can be numbered.
const IDS: u64 = u32::MAX as u64;

/// The size of a mesh of triangles. Numbers that do not fit into 64 bits stay at the highest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) vertices: u64,
    pub(crate) edges: u64,
    pub(crate) faces: u64,
    /// The bytes of all attributes of one vertex, corner, edge and face.
    attributes: [u64; 4],
}

impl Counts {
    /// The size of an existing mesh.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        let attributes = Domain::ALL.map(|domain| {
            let columns = mesh.attributes().of(domain).iter();
            columns
                .filter(|column| crate::attributes::is_carried(column))
                .map(|column| column.values.gather(1, |_| None).bytes() as u64)
                .sum()
        });
        Self {
            vertices: mesh.n_vertices() as u64,
            edges: mesh.n_edges() as u64,
            faces: mesh.n_faces() as u64,
            attributes,
        }
    }

    /// The least that a planned mesh can be: attributes count as in [`MeshPlan::bytes`].
    pub(crate) fn least_of(plan: &MeshPlan) -> Self {
        let attributes = Domain::ALL.map(|domain| {
            let columns = plan.attributes.iter().filter(|a| a.domain == domain);
            16 * columns.count() as u64
        });
        Self {
            vertices: plan.vertices.min,
            edges: plan.edges.min,
            faces: plan.faces.min,
            attributes,
        }
    }

    /// The size after so many levels.
    pub(crate) fn after(self, levels: u32) -> Self {
        (0..levels).fold(self, |c, _| Self {
            vertices: c.vertices.saturating_add(c.edges),
            edges: c
                .edges
                .saturating_mul(2)
                .saturating_add(c.faces.saturating_mul(3)),
            faces: c.faces.saturating_mul(4),
            ..c
        })
    }

    /// How much one level from here adds to the [`Meter`](crate::meter::Meter): one for each element
    /// whose connectivity or position is computed from.
    pub(crate) fn work(self) -> u64 {
        self.vertices
            .saturating_add(self.edges.saturating_mul(2))
            .saturating_add(self.faces)
    }

    /// The bytes that the mesh takes, as [`Mesh::bytes`] counts them.
    pub(crate) fn bytes(self) -> u64 {
        let [vertex, corner, edge, face] = self.attributes;
        [
            self.vertices.saturating_mul(28 + vertex),
            self.edges.saturating_mul(24 + 2 * corner + edge),
            self.faces.saturating_mul(4 + face),
        ]
        .into_iter()
        .fold(0, u64::saturating_add)
    }

    /// Whether the mesh after so many levels has ids for all elements and stays within the budget, in
    /// bytes.
    pub(crate) fn check(self, levels: u32, budget: u64) -> Result<(), TooLarge> {
        let fits = |levels: &u32| {
            let c = self.after(*levels);
            c.has_ids() && c.bytes() <= budget
        };
        if fits(&levels) {
            return Ok(());
        }
        Err(TooLarge {
            levels,
            result: self.after(levels),
            budget,
            fits: (0..levels).rev().find(fits),
        })
    }

    fn has_ids(self) -> bool {
        self.vertices <= IDS && self.edges.saturating_mul(2) <= IDS && self.faces <= IDS
    }
}

/// The mesh would be too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooLarge {
    levels: u32,
    result: Counts,
    budget: u64,
    /// The highest level that would do; `None` if the mesh itself is beyond the budget.
    pub(crate) fits: Option<u32>,
}

impl TooLarge {
    /// What is wrong.
    pub(crate) fn message(&self) -> String {
        let Self { levels, result, .. } = self;
        let many = format!("level {levels} has {} triangles", result.faces);
        if result.has_ids() {
            let (bytes, budget) = (result.bytes(), self.budget);
            format!("{many} and takes {bytes} bytes, but the budget is {budget}")
        } else {
            let half_edges = result.edges.saturating_mul(2);
            format!("{many} and {half_edges} half-edges, but ids end at 2^32 - 2")
        }
    }

    /// The way out.
    pub(crate) fn help(&self) -> String {
        match self.fits {
            Some(level) => format!("level {level} fits"),
            None => "no level fits".to_owned(),
        }
    }
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message(), self.help())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::shapes;

    fn icosahedron() -> Counts {
        Counts::of(&shapes::icosahedron())
    }

    #[test]
    fn a_level_has_four_times_the_triangles() {
        let c = icosahedron().after(2);
        assert_eq!((c.vertices, c.edges, c.faces), (162, 480, 320));
    }

    #[test]
    fn bytes_are_those_of_the_mesh() {
        let mut mesh = shapes::torus(5, 4, 2.0, 1.0);
        mesh.set(mesh::COLOR, vec![mesh::DVec4::ONE; mesh.n_vertices()]);
        mesh.set(mesh::MATERIAL, vec![0; mesh.n_faces()]);
        mesh.set(mesh::UV, vec![mesh::DVec2::ONE; mesh.n_half_edges()]);
        mesh.set(mesh::CREASE, vec![1.0; mesh.n_edges()]);
        assert_eq!(Counts::of(&mesh).bytes(), mesh.bytes() as u64);
    }

    #[test]
    fn ids_end_before_fourteen_levels_of_an_icosahedron() {
        // 60 * 4^13 half-edges are 4.03e9, which ids can number; 60 * 4^14 are not.
        assert_eq!(icosahedron().check(13, u64::MAX), Ok(()));
        let too_large = icosahedron().check(14, u64::MAX).unwrap_err();
        assert_eq!(too_large.fits, Some(13));
        assert_eq!(
            too_large.to_string(),
            "level 14 has 5368709120 triangles and 16106127360 half-edges, but ids end at 2^32 - 2; \
             level 13 fits"
        );
    }

    #[test]
    fn a_budget_of_the_exact_bytes_fits_and_one_byte_less_does_not() {
        let bytes = icosahedron().after(3).bytes();
        assert_eq!(icosahedron().check(3, bytes), Ok(()));
        let too_large = icosahedron().check(3, bytes - 1).unwrap_err();
        assert_eq!(too_large.fits, Some(2));
        assert!(too_large.message().contains("budget"), "{too_large}");
        assert_eq!(icosahedron().check(1, 100).unwrap_err().fits, None);
    }

    #[test]
    fn a_nearly_endless_mesh_is_too_large_without_overflow() {
        let endless = Counts {
            vertices: u64::MAX,
            edges: u64::MAX,
            faces: u64::MAX,
            attributes: [16; 4],
        };
        assert_eq!(endless.check(16, u64::MAX).unwrap_err().fits, None);
    }
}
