//! Spatial indexes of meshes, built in the background once per mesh.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, Weak};

use geometry::surface_index::SurfaceIndex;
use mesh::Mesh;

use crate::run::Wake;

/// The spatial indexes of meshes. An index is built in the background, once for each mesh, when it is first needed.
///
/// Two meshes share an index only if they are the same object in memory. When a mesh no longer exists, its index is
/// removed.
#[derive(Clone, Default)]
pub struct Indexes {
    shared: Arc<Shared>,
}

#[derive(Default)]
struct Shared {
    entries: Mutex<Vec<Entry>>,
    built: Condvar,
    wake: Mutex<Option<Wake>>,
}

struct Entry {
    mesh: Weak<Mesh>,
    /// Whether the index was built.
    is_built: bool,
    /// `None` while the index is being built, and also if the mesh has no faces.
    index: Option<Arc<SurfaceIndex>>,
}

impl Indexes {
    /// Creates an empty set of spatial indexes.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets a function that is called when an index is ready.
    pub fn on_ready(&self, wake: Wake) {
        *self
            .shared
            .wake
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = Some(wake);
    }

    /// Returns the index of a mesh. If the index is not ready, returns `None` and builds the index in the background.
    /// Also returns `None` if the mesh has no faces.
    pub fn get(&self, mesh: &Arc<Mesh>) -> Option<Arc<SurfaceIndex>> {
        let weak = Arc::downgrade(mesh);
        {
            let mut entries = self.lock();
            entries.retain(|entry| entry.mesh.strong_count() > 0);
            if let Some(entry) = entries.iter().find(|entry| entry.mesh.ptr_eq(&weak)) {
                return entry.index.clone();
            }
            entries.push(Entry {
                mesh: weak.clone(),
                is_built: false,
                index: None,
            });
        }
        let (shared, mesh) = (self.shared.clone(), mesh.clone());
        let build = move || {
            // If the construction of the index panics, the elements of the mesh cannot be picked.
            let index =
                std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| SurfaceIndex::new(&mesh)));
            let index = index.ok().flatten().map(Arc::new);
            {
                let mut entries = shared
                    .entries
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner);
                if let Some(entry) = entries.iter_mut().find(|entry| entry.mesh.ptr_eq(&weak)) {
                    (entry.is_built, entry.index) = (true, index);
                }
            }
            drop(mesh);
            shared.built.notify_all();
            let wake = shared
                .wake
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .clone();
            if let Some(wake) = wake {
                wake();
            }
        };
        let thread = std::thread::Builder::new().name("meshwright index".to_owned());
        // If the thread cannot be started, the elements of the mesh cannot be picked.
        let _ = thread.spawn(build);
        None
    }

    /// Returns the index of a mesh, and waits until it is ready. Returns `None` if the mesh has no faces.
    pub fn wait_for(&self, mesh: &Arc<Mesh>) -> Option<Arc<SurfaceIndex>> {
        if let Some(index) = self.get(mesh) {
            return Some(index);
        }
        let weak = Arc::downgrade(mesh);
        let mut entries = self.lock();
        loop {
            let entry = entries.iter().find(|entry| entry.mesh.ptr_eq(&weak))?;
            if entry.is_built {
                return entry.index.clone();
            }
            entries = self
                .shared
                .built
                .wait(entries)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Entry>> {
        self.shared
            .entries
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}
