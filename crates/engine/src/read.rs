//! Files of objects.

use std::path::Path;

use op::Files;
use scene::Object;

/// Reads the objects of a file, for expectations that compare with one.
///
/// # Errors
///
/// Why the file cannot be read, with its path.
pub fn read_objects(path: &Path, files: &Files) -> Result<Vec<Object>, String> {
    let options = mesh_io::ReadOptions::default();
    let loaded = mesh_io::read(path, &options).map_err(|error| error.to_string())?;
    for file in loaded.files {
        if file.is_read {
            files.has_read(file.path);
        } else {
            files.has_looked_for(file.path);
        }
    }
    Ok(loaded.objects)
}
