//! Reads the files that expectations refer to.

use std::path::Path;

use op::Files;
use recipe::{Reader, Violation};
use render::PictureError;
use scene::Scene;

/// Reads scenes of every supported format, and compares PNG files by their pixels.
#[derive(Clone, Copy, Debug)]
pub struct FileReader;

impl Reader for FileReader {
    fn scene(&self, path: &Path, files: &Files) -> Result<Scene, Violation> {
        let options = mesh_io::ReadOptions::default();
        let loaded =
            mesh_io::read(&*files.store, path, &options).map_err(|error| error.to_string())?;
        for file in loaded.files {
            files.has_used(file.path, file.is_read);
        }
        let mut scene = Scene::new();
        let appended = scene.append(loaded.objects, loaded.graph);
        appended.map_err(|error| error.to_string())?;
        Ok(scene)
    }

    fn compare_pictures(
        &self,
        found: (&Path, &[u8]),
        expected: (&Path, &[u8]),
        tolerance: u8,
    ) -> Result<Option<String>, Violation> {
        let message = |error| match error {
            PictureError::Unreadable { file, why } => {
                let path = [found.0, expected.0][file];
                format!("{} cannot be read as a picture: {why}", path.display())
            }
            error => error.to_string(),
        };
        Ok(render::compare(found.1, expected.1, tolerance).map_err(message)?)
    }
}
