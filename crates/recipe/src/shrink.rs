//! Reduces a scene on which a step fails. Removes objects and faces as long as the step still fails with the same
//! message. Messages that differ only in their numbers count as the same message.
//!
//! Faces are removed in blocks. The size of the blocks is halved until each block is a single face, as in the algorithm
//! ddmin. Source: Zeller and Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", 2002. Vertices keep their
//! ids while faces are removed. At the end, isolated vertices are removed if the step still fails without them.

use std::sync::Arc;

use mesh::FaceId;
use op::{Files, OpError, Progress};
use scene::{Geometry, Scene};

use crate::check::forbidden;
use crate::recipe::RecipeStep;
use crate::run::run_step;

/// Runs a step on a copy of a scene, and returns the error message if the step fails. Returns `None` if the step does
/// not fail.
///
/// # Errors
///
/// Returns [`OpError::Cancelled`] if `progress` requests cancellation.
pub fn failure(
    step: &RecipeStep,
    scene: &Scene,
    files: &Files,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Option<String>, OpError> {
    match run_step(step, &mut scene.clone(), files, budget, progress) {
        Ok((report, _)) => {
            let lost = step.on_loss.forbidden(&report.losses);
            Ok(lost.map(|loss| forbidden(step, loss).message))
        }
        Err(Some(error)) => Ok(Some(error.message)),
        Err(None) => Err(OpError::Cancelled),
    }
}

/// Whether two failure messages differ only in the numbers that they contain.
pub fn is_alike(a: &str, b: &str) -> bool {
    let words = |text: &str| text.replace(|c: char| c.is_ascii_digit() || "+-.".contains(c), "");
    words(a) == words(b)
}

/// Searches for smaller scenes for which `fails` returns `true`, and returns the smallest one that was found. `fails`
/// must return `true` for `scene`. `fails` is called at most `tries` times.
///
/// # Errors
///
/// Returns the errors of `fails`.
pub fn shrink(
    scene: &Scene,
    tries: usize,
    fails: impl FnMut(&Scene) -> Result<bool, OpError>,
) -> Result<Scene, OpError> {
    let mut search = Search {
        best: scene.clone(),
        left: tries,
        fails,
    };
    for name in names(scene) {
        let mut without = search.best.clone();
        if without.remove(&name).is_some() {
            search.attempt(without)?;
        }
    }
    for name in names(&search.best) {
        search.faces(&name)?;
    }
    for name in names(&search.best) {
        search.vertices(&name)?;
    }
    Ok(search.best)
}

fn names(scene: &Scene) -> Vec<String> {
    scene.objects().iter().map(|o| o.name.clone()).collect()
}

struct Search<F> {
    best: Scene,
    left: usize,
    fails: F,
}

impl<F: FnMut(&Scene) -> Result<bool, OpError>> Search<F> {
    /// If the step also fails on `scene`, keeps `scene` as the smallest scene so far. Returns whether the step failed.
    fn attempt(&mut self, scene: Scene) -> Result<bool, OpError> {
        if self.left == 0 {
            return Ok(false);
        }
        self.left -= 1;
        let fails = (self.fails)(&scene)?;
        if fails {
            self.best = scene;
        }
        Ok(fails)
    }

    fn n_faces(&self, name: &str) -> usize {
        let mesh = self.best.object(name).and_then(|o| o.as_mesh());
        mesh.map_or(0, |mesh| mesh.n_faces())
    }

    fn faces(&mut self, name: &str) -> Result<(), OpError> {
        let mut block = self.n_faces(name).div_ceil(2);
        while block > 0 && self.left > 0 {
            let mut first = 0;
            let mut is_smaller = false;
            while first < self.n_faces(name) {
                let last = (first + block).min(self.n_faces(name));
                let faces: Vec<FaceId> = (first..last).map(FaceId::new).collect();
                let without = edited(&self.best, name, |mesh| mesh.delete_faces(&faces).is_ok());
                let is_done = match without {
                    Some(without) => self.attempt(without)?,
                    None => false,
                };
                is_smaller |= is_done;
                // A removal compacts the mesh: the next faces get the ids of the removed faces. Therefore, the block
                // after a removed block starts at the same id.
                first = if is_done { first } else { last };
            }
            // Single faces are tried again, because a face can become removable after other faces were removed.
            block = if block == 1 && is_smaller {
                1
            } else {
                block / 2
            };
        }
        Ok(())
    }

    fn vertices(&mut self, name: &str) -> Result<(), OpError> {
        let without = edited(&self.best, name, |mesh| mesh.delete_isolated_vertices() > 0);
        if let Some(without) = without {
            self.attempt(without)?;
        }
        Ok(())
    }
}

/// Returns a copy of the scene in which one mesh was edited. Returns `None` if the edit is not possible.
fn edited(scene: &Scene, name: &str, edit: impl FnOnce(&mut mesh::Mesh) -> bool) -> Option<Scene> {
    let mut scene = scene.clone();
    let (Geometry::Mesh(mesh), _) = scene.parts_mut(name)? else {
        return None;
    };
    let mesh = Arc::make_mut(mesh);
    let is_done = edit(mesh);
    mesh.compact();
    is_done.then_some(scene)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use scene::Object;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        scene
            .insert(Object::mesh("grid", shapes::grid(12, 9)))
            .unwrap();
        scene.insert(Object::mesh("cube", shapes::cube())).unwrap();
        scene
    }

    #[test]
    fn irrelevant_objects_and_faces_are_removed() {
        // The step fails only if a face has a corner near the middle of the grid.
        let corner = mesh::DVec3::ZERO;
        let matters = |scene: &Scene| {
            let near = |o: &Object| {
                let mesh = o.as_mesh().unwrap();
                mesh.faces().any(|f| {
                    mesh.face_vertices(f)
                        .any(|v| mesh.position(v).distance(corner) < 0.6)
                })
            };
            Ok(scene.object("grid").is_some_and(near))
        };
        assert!(matters(&scene()).unwrap());
        let small = shrink(&scene(), 1000, matters).unwrap();
        let [grid] = small.objects() else {
            panic!("the cube was not removed")
        };
        let mesh = grid.as_mesh().unwrap();
        assert_eq!((mesh.n_faces(), mesh.n_vertices()), (1, 4));
        assert_eq!(mesh.defects(), []);
    }

    #[test]
    fn the_number_of_tries_is_limited() {
        let whole = scene().digest();
        let mut n = 0;
        let same = shrink(&scene(), 50, |scene| {
            n += 1;
            Ok(scene.digest() == whole)
        });
        assert_eq!((same.unwrap().digest(), n), (whole, 50));
    }

    #[test]
    fn failures_are_alike_if_only_numbers_differ() {
        assert!(is_alike(
            "the edge v0-v1 is on the boundary",
            "the edge v17-v2 is on the boundary"
        ));
        assert!(!is_alike("v1 is isolated", "v1 is on the boundary"));
    }
}
