//! The plan of a batch: the recipe, the input files, and the outputs for each input file.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf, absolute};

use anyhow::{bail, ensure};
use engine::Engine;
use recipe::{OtherMesh, Param, Parameter, Source, did_you_mean};

use super::inputs::{self, Input};
use super::row::Header;
use super::sets;
use crate::args::{BatchArgs, Shard, ValueArgs};
use crate::commands::run::report_errors;
use crate::file_kind::{FileKind, expect_kind};
use crate::loading::load_text;
use engine::Loaded;

/// A batch that can be run.
pub(super) struct Batch<'a> {
    pub(super) args: &'a BatchArgs,
    pub(super) path: &'a Path,
    /// The name of the recipe's parameter that receives the path of the input file, if there are input files.
    param: Option<String>,
    engine: &'a Engine<'a>,
    /// The text of the recipe, read once for all files.
    source: Source,
    /// The digest of the steps and expectations of the recipe.
    digest: String,
    /// The input files of all parts.
    inputs: Vec<Input>,
}

impl<'a> Batch<'a> {
    /// Reads the recipe, lists the input files, and checks that no run would overwrite an input file or an output of
    /// another run. If the text of the recipe has errors, prints them and returns `None`.
    pub(super) fn plan(
        args: &'a BatchArgs,
        engine: &'a Engine<'a>,
    ) -> anyhow::Result<Option<Self>> {
        let path = args.recipe.as_deref().unwrap_or(Path::new(""));
        expect_kind(path, FileKind::Recipe)?;
        let source = Source::open(path)?;
        // Loads the recipe with the default value of its path parameter. The file at this path can be missing.
        let loaded = load_text(
            &source,
            &args.values,
            &args.out,
            args.many.checking(),
            engine,
        )?;
        if !loaded.is_read {
            report_errors(&loaded, false)?;
            return Ok(None);
        }
        let mut inputs = inputs::list(&args.inputs)?;
        inputs.sort_by(|a, b| a.path.cmp(&b.path));
        let parameters = loaded.recipe.parameters();
        let param = if args.inputs.is_empty() {
            None
        } else {
            Some(parameter(args, parameters)?)
        };
        if let Some(path) = &args.sets {
            let set = &args.values.set;
            let is_given = |name: &str| {
                param.as_deref() == Some(name) || set.iter().any(|(given, _)| given == name)
            };
            let sets = sets::read(path, parameters, is_given)?;
            inputs = inputs::combined(inputs, &sets);
        }
        let batch = Self {
            args,
            path,
            param,
            engine,
            source,
            digest: digest(&loaded),
            inputs,
        };
        batch.check_outputs()?;
        Ok(Some(batch))
    }

    /// Fails if two runs of the batch would write to the same path, or if a run would overwrite an input file.
    ///
    /// An output path depends on the input file only if it contains a placeholder such as `{model.stem}`. So the recipe
    /// is checked only once for each parameter set, with a marker as the name of the input file. For each input file,
    /// the marker in the output paths is then replaced by the name of the file.
    fn check_outputs(&self) -> anyhow::Result<()> {
        let [stem, name] = ["\u{1}", "\u{1}.\u{2}"];
        let below = |path: &PathBuf| path.strip_prefix(&self.args.out).unwrap_or(path).to_owned();
        // The output paths for each parameter set. The keys are the numbers of the sets. In these paths, a marker
        // stands for the name of the input file.
        let mut marked: HashMap<usize, Vec<PathBuf>> = HashMap::new();

        let place = |path: &Path| absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let places = self.inputs.iter().map(|file| place(Path::new(&file.path)));
        let read: HashMap<PathBuf, &Input> = places.zip(&self.inputs).collect();
        let mut writers: HashMap<PathBuf, &Input> = HashMap::new();
        for file in &self.inputs {
            let outputs = match marked.entry(file.number()) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => {
                    let path = self.param.as_ref().map_or("", |_| name).to_owned();
                    let file = Input {
                        path,
                        ..file.clone()
                    };
                    let loaded = self.load_at(&file, &self.args.out)?;
                    new.insert(loaded.forecast.outputs.iter().map(below).collect())
                }
            };
            let path = Path::new(&file.path);
            let parts = [store::stem(path), path.file_name().unwrap_or_default()];
            let [own_stem, own_name] = parts.map(|part| part.to_string_lossy());
            for output in outputs.iter() {
                let output = output.to_string_lossy();
                let output = output.replace(name, &own_name).replace(stem, &own_stem);
                let output = self.out(file).join(output);
                if let Some(other) = read.get(&place(&output)) {
                    bail!(
                        "the input file {} would be overwritten by the output of {}: choose a different folder with --out",
                        other.path,
                        file.path
                    );
                }
                if let Some(other) = writers.insert(place(&output), file) {
                    bail!(
                        "{} and {} would both write {}: use `{{{param}.stem}}` or `{{{param}.name}}` in the output path, or write to separate folders with --folders",
                        other.label(),
                        file.label(),
                        output.display(),
                        param = self.param.as_deref().unwrap_or_default(),
                    );
                }
            }
        }
        Ok(())
    }

    /// Returns the output folder of an input file.
    pub(super) fn out(&self, file: &Input) -> PathBuf {
        let mut out = self.args.out.clone();
        if let Some(set) = &file.set {
            out.push(set.number.to_string());
        }
        if self.args.folders {
            out.push(&file.relative);
        }
        out
    }

    /// Returns the values of the recipe's parameters for a run on an input file.
    pub(super) fn values(&self, file: &Input) -> ValueArgs {
        let mut values = self.args.values.clone();
        let own = file.set.iter().flat_map(|set| set.values.clone());
        let input = self.param.clone().map(|name| (name, file.path.clone()));
        values.set.extend(own.chain(input));
        values
    }

    /// Returns the input files of this part.
    pub(super) fn files_of_part(&self) -> Vec<&Input> {
        let is_in = |file: &Input, shard: Shard| file.part(shard.of) == shard.index;
        let is_in_part = |file: &&Input| self.args.shard.is_none_or(|shard| is_in(file, shard));
        self.inputs.iter().filter(is_in_part).collect()
    }

    /// Returns the path of the journal.
    pub(super) fn journal(&self) -> PathBuf {
        self.args.out.join(match self.args.shard {
            None => "batch.jsonl".to_owned(),
            Some(shard) => format!("batch-{}-of-{}.jsonl", shard.index, shard.of),
        })
    }

    /// Loads and checks the recipe with the parameter values of the run on an input file.
    pub(super) fn load(&self, file: &Input) -> anyhow::Result<Loaded> {
        self.load_at(file, &self.out(file))
    }

    fn load_at(&self, file: &Input, out: &Path) -> anyhow::Result<Loaded> {
        let checking = self.args.many.checking();
        load_text(&self.source, &self.values(file), out, checking, self.engine)
    }

    /// Returns a digest of everything on which the row of an input file in the report depends. Returns `None` if a file
    /// that the recipe reads cannot be read.
    pub(super) fn key(&self, file: &Input, loaded: &Loaded) -> Option<String> {
        let mut hasher = blake3::Hasher::new();
        // Before each string, its length is hashed. Otherwise, the lists `["ab", "c"]` and `["a", "bc"]` would have the
        // same digest.
        let mut part = |bytes: &[u8]| {
            hasher.update(&(bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        part(env!("CARGO_PKG_VERSION").as_bytes());
        part(self.digest.as_bytes());
        let values = &self.args.values;
        part(values.preset.as_deref().unwrap_or_default().as_bytes());
        for (name, value) in &values.set {
            part(name.as_bytes());
            part(value.as_bytes());
        }
        part(file.path.as_bytes());
        for (name, value) in file.set.iter().flat_map(|set| &set.values) {
            part(name.as_bytes());
            part(value.as_bytes());
        }
        for output in &loaded.forecast.outputs {
            part(output.as_os_str().as_encoded_bytes());
        }
        let folders = loaded.recipe.files(&loaded.files);
        let compared = loaded.recipe.expectations.iter().filter_map(|placed| {
            let path = match (placed.that.other_mesh(), placed.that.output()) {
                (Some(OtherMesh::File(path)), _) => path,
                (_, Some((_, beside))) => beside,
                _ => return None,
            };
            Some(folders[placed.scope].to_read(path))
        });
        for path in loaded.forecast.inputs.iter().cloned().chain(compared) {
            part(path.as_os_str().as_encoded_bytes());
            let mut content = blake3::Hasher::new();
            let file = std::fs::File::open(&path).ok()?;
            content.update_reader(file).ok()?;
            part(content.finalize().as_bytes());
        }
        Some(hasher.finalize().to_hex()[..32].to_owned())
    }

    /// Removes the temporary output folders of this batch that killed processes have left.
    pub(super) fn remove_stale(&self, processes: &[u32]) {
        if processes.is_empty() {
            return;
        }
        let stale = processes.iter().map(|p| store::temporary_prefix(*p));
        let stale: Vec<String> = stale.collect();
        let mut folders = vec![self.args.out.clone()];
        if self.args.folders || self.args.sets.is_some() {
            folders.extend(self.files_of_part().into_iter().map(|file| self.out(file)));
        }
        let lists = folders.iter().filter_map(|f| std::fs::read_dir(f).ok());
        for entry in lists.flatten().flatten() {
            let name = entry.file_name();
            if stale.iter().any(|p| name.to_string_lossy().starts_with(p)) {
                // A folder that cannot be removed stays, and the error is ignored.
                let _ = std::fs::remove_dir_all(entry.path());
            }
        }
    }

    /// Returns the header of the report. The header does not count the rows yet.
    pub(super) fn header(&self) -> Header {
        let mut listed = blake3::Hasher::new();
        for file in &self.inputs {
            listed.update(file.label().as_bytes());
            listed.update(b"\0");
        }
        Header {
            batch: 1,
            meshwright: env!("CARGO_PKG_VERSION").to_owned(),
            recipe: self.path.display().to_string(),
            recipe_digest: self.digest.clone(),
            preset: self.args.values.preset.clone(),
            set: self.args.values.set.iter().cloned().collect(),
            shard: self.args.shard.filter(|shard| shard.of > 1),
            listed: self.inputs.len(),
            listed_digest: listed.finalize().to_hex()[..32].to_owned(),
            ..Header::default()
        }
    }
}

/// Returns the name of the recipe's parameter that receives the path of the input file.
fn parameter(args: &BatchArgs, parameters: &[Parameter]) -> anyhow::Result<String> {
    let is_path = |p: &&Parameter| matches!(p.param, Param::Path { .. });
    let paths = parameters.iter().filter(is_path);
    let paths: Vec<&str> = paths.map(|p| p.name.as_str()).collect();
    let name = match (&args.param, paths.as_slice()) {
        (Some(name), _) => {
            let Some(parameter) = parameters.iter().find(|p| p.name == *name) else {
                let known = parameters.iter().map(|p| p.name.as_str());
                bail!(
                    "the recipe has no parameter `{name}`: {}",
                    did_you_mean(name, known)
                );
            };
            ensure!(
                paths.contains(&name.as_str()),
                "the parameter `{name}` is of type {}, expected Path",
                parameter.param.type_name()
            );
            name.clone()
        }
        (None, [only]) => (*only).to_owned(),
        (None, []) => bail!(
            "the recipe has no parameter of type Path for the input file: add `params: {{\"model\": Path(default: \"..\")}}` and `Load(path: arg(\"model\"))`"
        ),
        (None, several) => bail!(
            "the recipe has several parameters of type Path: choose one of {} with --param",
            several.join(", ")
        ),
    };
    let is_set = args.values.set.iter().any(|(set, _)| *set == name);
    ensure!(
        !is_set,
        "the parameter `{name}` receives the input files, so it cannot be set with --set"
    );
    Ok(name)
}

/// Returns the digest of the steps and expectations of a recipe.
fn digest(loaded: &Loaded) -> String {
    let recipe = &loaded.recipe;
    let mut text = recipe.digest();
    for step in &recipe.steps {
        text += &format!("\n{:?} {:?}", step.refused, step.on_loss);
    }
    for placed in &recipe.expectations {
        text += &format!("\n{:?} {:?} {}", placed.after, placed.on, placed.that);
    }
    blake3::hash(text.as_bytes()).to_hex()[..32].to_owned()
}
