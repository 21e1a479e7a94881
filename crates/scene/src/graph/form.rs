//! The canonical form of a graph.
//!
//! The first version of the form had no graphs. A scene with an empty graph is still written as in the first version.

use std::collections::BTreeMap;

use super::rig_form::RIG;
use super::{Graph, MeshLabel, Node, Placement};
use crate::decode::{DecodeError, Decoder};
use crate::digest::Encoder;
use crate::{Geometry, Scene};

impl Encoder<'_> {
    pub(crate) fn graph(&mut self, graph: &Graph) {
        for list in [&graph.cameras, &graph.lights] {
            self.len(list.len());
            for json in list {
                self.text(json);
            }
        }
        self.len(graph.nodes.len());
        for node in &graph.nodes {
            self.optional_text(node.name.as_deref());
            for index in [node.parent, node.camera, node.light] {
                self.optional_index(index);
            }
            match &node.placement {
                Placement::Matrix(matrix) => self.array(matrix, 8),
                Placement::Parts {
                    translation: [x, y, z],
                    rotation: [i, j, k, w],
                    scale: [u, v, s],
                } => self.array(&[*x, *y, *z, *i, *j, *k, *w, *u, *v, *s], 8),
            }
            self.optional_text(node.object.as_deref());
            self.optional_text(node.extras.as_deref());
        }
        self.len(graph.labels.len());
        for (object, label) in &graph.labels {
            self.text(object);
            self.optional_text(label.name.as_deref());
            self.optional_text(label.extras.as_deref());
        }
        self.len(graph.document.len());
        for (name, json) in &graph.document {
            self.text(name);
            self.text(json);
        }
        if graph.has_rig() {
            self.text(RIG);
            self.rig(graph);
        }
    }

    /// Writes the index plus 1, or 0 if there is no index.
    pub(super) fn optional_index(&mut self, index: Option<usize>) {
        self.len(index.map_or(0, |i| i + 1));
    }

    pub(crate) fn optional_text(&mut self, text: Option<&str>) {
        self.len(usize::from(text.is_some()));
        if let Some(text) = text {
            self.text(text);
        }
    }
}

impl Decoder<'_> {
    /// Reads the graph of a scene with these objects.
    pub(crate) fn graph(&mut self, scene: &Scene) -> Result<Graph, DecodeError> {
        let mut graph = Graph {
            cameras: self.list(|d| Ok(d.text()?.to_owned()))?,
            lights: self.list(|d| Ok(d.text()?.to_owned()))?,
            ..Graph::default()
        };
        let kinds: BTreeMap<&str, &Geometry> = (scene
            .objects()
            .iter()
            .map(|o| (o.name.as_str(), &o.geometry)))
        .collect();
        let n = self.len()?;
        for i in 0..n {
            let node = self.node(i, &graph)?;
            let shown = node.object.as_deref().map(|name| kinds.get(name));
            if shown.is_some_and(|kind| !matches!(kind, Some(Geometry::Mesh(_)))) {
                return Err(DecodeError::Expected(
                    "a node that references a mesh of the scene",
                ));
            }
            graph.nodes.push(node);
        }
        if !graph.to_scene().iter().all(glam::DAffine3::is_finite) {
            return Err(DecodeError::Expected("finite placements of nodes"));
        }
        for _ in 0..self.len()? {
            let object = self.text()?;
            if !kinds.contains_key(object) {
                return Err(DecodeError::Expected("a label of an object of the scene"));
            }
            let label = MeshLabel {
                name: self.optional_text()?,
                extras: self.optional_text()?,
                ..MeshLabel::default()
            };
            graph.labels.insert(object.to_owned(), label);
        }
        for _ in 0..self.len()? {
            let name = self.text()?.to_owned();
            graph.document.insert(name, self.text()?.to_owned());
        }
        if !self.is_at_end() {
            if self.text()? != RIG {
                return Err(DecodeError::TrailingData);
            }
            self.rig(&mut graph)?;
        }
        Ok(graph)
    }

    fn node(&mut self, index: u64, graph: &Graph) -> Result<Node, DecodeError> {
        let name = self.optional_text()?;
        let parent = self.index(index)?;
        let camera = self.index(graph.cameras.len() as u64)?;
        let light = self.index(graph.lights.len() as u64)?;
        let placement = match self.array::<f64>(8)?[..] {
            [x, y, z, i, j, k, w, u, v, s] => Placement::Parts {
                translation: [x, y, z],
                rotation: [i, j, k, w],
                scale: [u, v, s],
            },
            ref numbers => Placement::Matrix(
                (numbers.try_into())
                    .map_err(|_| DecodeError::Expected("the placement of a node"))?,
            ),
        };
        Ok(Node {
            name,
            parent,
            placement,
            object: self.optional_text()?,
            camera,
            light,
            extras: self.optional_text()?,
            ..Node::default()
        })
    }

    /// Reads an optional index, which must be less than `n`.
    pub(super) fn index(&mut self, n: u64) -> Result<Option<usize>, DecodeError> {
        let index = self.len()?;
        if index > n {
            return Err(DecodeError::Expected("a smaller index in the graph"));
        }
        let index = usize::try_from(index).map_err(|_| DecodeError::Truncated)?;
        Ok(index.checked_sub(1))
    }

    pub(crate) fn optional_text(&mut self) -> Result<Option<String>, DecodeError> {
        match self.len()? {
            0 => Ok(None),
            1 => Ok(Some(self.text()?.to_owned())),
            _ => Err(DecodeError::Expected("a flag of 0 or 1")),
        }
    }
}
