//! Tests of the plans of meshes.

use super::*;

#[test]
fn attributes_that_may_not_exist_add_nothing_to_the_lowest_size() {
    let mesh = MeshPlan::counted(8, 12, 6, Range::exactly(4));
    let names = [
        (Domain::Vertex, "color"),
        (Domain::Corner, "uv"),
        (Domain::Edge, "crease"),
        (Domain::Face, "tag"),
    ];
    for (domain, name) in names {
        let mut certain = mesh.clone();
        certain.provide(domain, name);
        let mut possible = certain.clone();
        possible.attributes[0].certain = false;
        assert!(certain.bytes().min > mesh.bytes().min, "{name}");
        assert_eq!(possible.bytes().min, mesh.bytes().min, "{name}");
        assert_eq!(possible.bytes().max, certain.bytes().max, "{name}");
    }
}
