use engine::{Engine, Options, Run, Silent, Source};
use ron_tree::parse;
use scene::{Object, Scene};

use crate::Play;

#[test]
fn playing_the_edits_gives_the_mesh_of_the_step_and_back() {
    let mut scene = Scene::new();
    scene
        .insert(Object::mesh("a", geometry::shapes::icosahedron()))
        .unwrap();
    let start = scene.objects()[0].as_mesh().unwrap().clone();
    for text in [
        "FlipEdges(edges: Random(count: 9, seed: 4), on_refusal: Skip)",
        "SplitEdges(edges: Between(0, 1), at: 0.25)",
        "CollapseEdges(edges: Random(count: 6, seed: 1), on_refusal: Skip)",
    ] {
        let run = parse(text).value;
        let name = run.name().unwrap().0;
        let mut play = Play::of_step(&scene, "a", &run, name).unwrap();
        assert_eq!((play.mesh(), play.position()), (&*start, 0), "{text}");
        assert!(
            play.edits()
                .iter()
                .all(|edit| edit.refused.is_some() || !edit.pointers.is_empty())
        );
        while play.forward() {
            assert_eq!(play.mesh().defects(), []);
        }
        let registry = ops_all::registry();
        let recipe = format!("(recipe: 1, steps: [Icosahedron(name: \"a\"), {text}])");
        let engine = Engine::new(&registry);
        let loaded = engine.load(&Source::new("a.ron", recipe), &Options::default());
        let after = loaded
            .run_from(1, scene.clone(), Run::default(), &Silent)
            .scene
            .unwrap();
        let mut played = play.mesh().clone();
        played.compact();
        assert_eq!(played, **after.objects()[0].as_mesh().unwrap(), "{text}");
        while play.back() {}
        assert_eq!(play.mesh(), &*start);
    }
    let other = parse("PokeFaces()").value;
    assert!(Play::of_step(&scene, "a", &other, "PokeFaces").is_none());
}

#[test]
fn splits_flips_and_moves_give_one_level_of_loop_subdivision() {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    for shape in [
        "Icosahedron(name: \"a\")",
        "Tetrahedron(name: \"a\")",
        "Cube(name: \"a\", triangles: true)",
        // This mesh has a boundary.
        "Grid(name: \"a\", columns: 3, rows: 2), Triangulate()",
    ] {
        let scene_of = |steps: &str| {
            let recipe = format!("(recipe: 1, steps: [{shape}, {steps}])");
            let loaded = engine.load(&Source::new("a.ron", recipe), &Options::default());
            loaded.run(Run::default(), &Silent).scene.unwrap()
        };
        let mesh = |scene: &Scene| scene.objects()[0].as_mesh().unwrap().clone();
        let before = mesh(&scene_of(""));
        let after = mesh(&scene_of("LoopSubdivide()"));
        let mut play = Play::of_loop_level(&before, &after).unwrap();
        assert_eq!((play.mesh(), play.position()), (&*before, 0), "{shape}");
        assert!(play.edits().iter().all(|edit| edit.refused.is_none()));
        while play.forward() {
            assert_eq!(play.mesh().defects(), [], "{shape}");
        }
        // The faces are compared as cycles of vertices, because their first corners and their indices may differ.
        let faces = |mesh: &mesh::Mesh| {
            let corners = |f| -> Vec<usize> {
                let mut corners: Vec<usize> =
                    mesh.face_vertices(f).map(mesh::VertexId::index).collect();
                let first = corners
                    .iter()
                    .enumerate()
                    .min_by_key(|(_, v)| **v)
                    .unwrap()
                    .0;
                corners.rotate_left(first);
                corners
            };
            mesh.faces()
                .map(corners)
                .collect::<std::collections::BTreeSet<_>>()
        };
        assert_eq!(faces(play.mesh()), faces(&after), "{shape}");
        assert_eq!(play.mesh().positions(), after.positions(), "{shape}");
        while play.back() {}
        assert_eq!(play.mesh(), &*before);
        let twice = mesh(&scene_of("LoopSubdivide(levels: 2)"));
        assert!(Play::of_loop_level(&before, &twice).is_none());
    }
}

#[test]
fn one_level_of_a_small_mesh_has_edits_and_several_levels_have_none() {
    for (levels, expected) in [(1, true), (2, false)] {
        let steps = format!("Icosahedron(), LoopSubdivide(levels: {levels}), PokeFaces()");
        let (editor, _) = super::opened(&format!("(recipe: 1, steps: [{steps}])"));
        let has = [0, 1, 2, 3].map(|step| editor.has_edits(step));
        assert_eq!(has, [false, expected, false, false], "{levels}");
        let played = editor
            .play(1)
            .map(|(object, play)| (object, play.edits().len()));
        // One level of Loop subdivision of an icosahedron has 51 edits: 30 splits, 20 flips and one movement of all
        // vertices.
        assert_eq!(played, expected.then(|| ("icosahedron".to_owned(), 51)));
    }
}
