//! What a step foresees is what it makes.

use mesh::{CREASE, Mesh, UV};
use op::{Context, Files, MeshPlan, NoProgress, PlanContext};

use super::SCHEMES;
use crate::fixtures;
use crate::forecast::Size;
use crate::{Rules, Scheme, Step, Until};

#[test]
fn counts_are_foreseen_exactly_for_every_scheme_on_every_fixture() {
    let files = Files::default();
    let cx = PlanContext {
        files: &files,
        on: None,
        budget: u64::MAX,
    };
    for (name, mut mesh) in fixtures::all() {
        mesh.set(UV, vec![mesh::DVec2::X; mesh.n_half_edges()]);
        mesh.set(CREASE, vec![1.5; mesh.n_edges()]);
        for scheme in SCHEMES {
            for levels in 0..3 {
                let step = Step {
                    levels: Some(levels),
                    ..Step::new("Test", Rules::of(scheme))
                };
                let mut plan = MeshPlan::of(&mesh);
                assert_eq!(step.plan(&mut plan, &cx), [], "{name} {scheme:?}");
                let mut new: Mesh = mesh.clone();
                let mut cx = Context::new(&NoProgress, &files);
                step.apply(&mut new, &mut cx).unwrap();
                if new.n_faces() == 0 {
                    plan.degrees = MeshPlan::of(&new).degrees;
                }
                let exactly = MeshPlan::of(&new);
                if scheme == Scheme::DooSabin && levels > 0 {
                    // A plan does not know how many vertices become no face.
                    for (planned, exactly) in [
                        (&mut plan.vertices, exactly.vertices),
                        (&mut plan.edges, exactly.edges),
                        (&mut plan.faces, exactly.faces),
                        (&mut plan.degrees, exactly.degrees),
                    ] {
                        assert!(planned.min <= exactly.min && exactly.max <= planned.max);
                        *planned = exactly;
                    }
                }
                assert_eq!(plan, exactly, "{name} {scheme:?} {levels}");
                assert_eq!(new.defects(), [], "{name} {scheme:?} {levels}");
            }
        }
    }
}

#[test]
fn a_budget_holds_for_every_level_until_a_condition_is_met() {
    // What an odd level of Sqrt3 makes of a boundary differs from what an even one makes.
    let mesh = fixtures::sheet(4, 3);
    let files = Files::default();
    for scheme in SCHEMES {
        let bytes = super::levels(scheme, 2, &mesh).bytes() as u64;
        let message = |budget| {
            let step = Step {
                levels: Some(2),
                until: Some(Until::EdgeLength { below: 1e-9 }),
                ..Step::new("Test", Rules::of(scheme))
            };
            let mut cx = Context::new(&NoProgress, &files);
            cx.budget = budget;
            step.apply(&mut mesh.clone(), &mut cx)
                .unwrap_err()
                .to_string()
        };
        let met = message(bytes);
        assert!(met.contains("after level 2 "), "{scheme:?} {met}");
        let short = message(bytes - 1);
        assert!(short.contains("after level 1 "), "{scheme:?} {short}");
        assert!(short.contains("level 2 has "), "{scheme:?} {short}");
    }
}
