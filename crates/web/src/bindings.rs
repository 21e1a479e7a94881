//! The session for JavaScript. Objects are passed as JSON, and arrays as typed arrays.

use std::cell::RefCell;

use engine::Values;
use render::Up;
use serde_json::Value as Json;
use wasm_bindgen::prelude::*;

use crate::{Arrays, Colors, session};

#[wasm_bindgen]
extern "C" {
    /// An object with the method `event`.
    pub type Listener;

    /// Receives an event as JSON. Returns whether the run continues.
    #[wasm_bindgen(method, catch)]
    fn event(this: &Listener, json: &str) -> Result<bool, JsValue>;
}

thread_local! {
    /// The listener of the run. The listener is a JavaScript object of one thread, so other threads cannot call it.
    static LISTENER: RefCell<Option<Listener>> = const { RefCell::new(None) };
}

/// Files in memory, and the scene of the last run. `meshwright.d.ts` documents the methods.
#[wasm_bindgen]
#[derive(Default)]
pub struct Session(session::Session);

fn error(error: impl ToString) -> JsError {
    JsError::new(&error.to_string())
}

/// Reads a JSON object. Returns its names and values as strings.
fn strings(set: &str) -> Result<Vec<(String, String)>, JsError> {
    let object: serde_json::Map<String, Json> = serde_json::from_str(set)?;
    let pair = |(name, value): (String, Json)| match value {
        Json::String(text) => (name, text),
        other => (name, other.to_string()),
    };
    Ok(object.into_iter().map(pair).collect())
}

#[wasm_bindgen]
impl Session {
    /// Creates a session without files.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes a file.
    pub fn write(&mut self, path: &str, bytes: &[u8]) -> Result<(), JsError> {
        self.0.write(path, bytes).map_err(error)
    }

    /// Reads a file.
    pub fn read(&self, path: &str) -> Result<Vec<u8>, JsError> {
        self.0.read(path).map_err(error)
    }

    /// Removes a file or a folder.
    pub fn remove(&mut self, path: &str) {
        self.0.remove(path);
    }

    /// Checks a recipe.
    pub fn check(
        &self,
        path: &str,
        text: &str,
        preset: Option<String>,
        set: &str,
    ) -> Result<String, JsError> {
        let set = strings(set)?;
        let values = Values {
            preset: preset.as_deref(),
            set: &set,
            ..Values::default()
        };
        Ok(self.0.check(path, text, values).to_string())
    }

    /// Runs a recipe.
    pub fn run(
        &mut self,
        path: &str,
        text: &str,
        preset: Option<String>,
        set: &str,
        listener: Listener,
    ) -> Result<String, JsError> {
        let set = strings(set)?;
        let values = Values {
            preset: preset.as_deref(),
            set: &set,
            ..Values::default()
        };
        LISTENER.set(Some(listener));
        let result = self.0.run(path, text, values, &|event| {
            LISTENER.with_borrow(|listener| {
                // Only the thread that started the run has a listener. The other threads do not report progress.
                listener.as_ref().is_none_or(|listener| {
                    // If the listener throws an exception, the run ends too.
                    listener.event(&event.to_string()).unwrap_or(false)
                })
            })
        });
        LISTENER.set(None);
        Ok(result.to_string())
    }

    /// Renders a picture as a PNG file. `up` is `y`, `z` or `auto`.
    pub fn picture(
        &self,
        width: u32,
        height: u32,
        wireframe: bool,
        up: &str,
    ) -> Result<Vec<u8>, JsError> {
        let up = match up {
            "auto" => Up::Auto,
            "y" => Up::Y,
            "z" => Up::Z,
            _ => return Err(error(format!("the axis `{up}` is not y, z or auto"))),
        };
        self.0
            .picture([width, height], wireframe, up)
            .map_err(error)
    }

    /// Returns the arrays of a mesh.
    pub fn mesh(&self, object: &str) -> Option<View> {
        self.0.arrays(object).map(View)
    }

    /// Returns the placement of each instance of a mesh: the 16 numbers of the matrix that maps the mesh to the scene.
    pub fn placements(&self, object: &str) -> Vec<f64> {
        self.0.placements(object)
    }

    /// Returns the quantities that colors can show.
    pub fn quantities(&self) -> String {
        self.0.quantities().to_string()
    }

    /// Returns the colors of a quantity.
    pub fn colors(&self, quantity: &str) -> Result<Colored, JsError> {
        let quantity = serde_json::from_str(quantity)?;
        Ok(Colored(self.0.colors(quantity).map_err(error)?))
    }

    /// Returns the JSON schema of recipes.
    pub fn schema(&self) -> String {
        self.0.schema().to_string()
    }

    /// Returns the operations.
    pub fn operations(&self) -> String {
        self.0.operations().to_string()
    }
}

/// The arrays of a mesh. Each array can be taken only once.
#[wasm_bindgen]
pub struct View(Arrays);

#[wasm_bindgen]
impl View {
    /// The center of the bounding box.
    pub fn center(&self) -> Vec<f64> {
        self.0.center.to_vec()
    }

    /// The positions relative to the center.
    pub fn positions(&mut self) -> Vec<f32> {
        std::mem::take(&mut self.0.positions)
    }

    /// The vertices of the triangles.
    pub fn triangles(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.0.triangles)
    }

    /// The faces of the triangles.
    pub fn faces(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.0.faces)
    }

    /// The vertices of the edges.
    pub fn edges(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.0.edges)
    }
}

/// The colors of all meshes.
#[wasm_bindgen]
pub struct Colored(Colors);

#[wasm_bindgen]
impl Colored {
    /// Returns the legend and a list of the meshes as JSON. For each mesh, the list has the name, and the kind of
    /// elements that have colors.
    pub fn described(&self) -> String {
        let meshes = self.0.meshes.iter();
        let meshes = meshes.map(|m| serde_json::json!({ "name": m.object, "per": m.per }));
        let meshes: Json = meshes.collect();
        serde_json::json!({ "legend": self.0.legend, "meshes": meshes }).to_string()
    }

    /// The colors of the mesh with this index. A second call for the same mesh returns no colors.
    pub fn colors(&mut self, mesh: usize) -> Vec<u8> {
        let mesh = self.0.meshes.get_mut(mesh);
        mesh.map_or_else(Vec::new, |m| std::mem::take(&mut m.colors))
    }
}
