//! What a batch will do: the recipe, the files, and where each file's outputs go.

use std::collections::HashMap;
use std::path::{Path, PathBuf, absolute};

use anyhow::{bail, ensure};
use engine::Engine;
use recipe::{Other, Param, Parameter, Source, did_you_mean};

use super::inputs::{self, Input};
use super::row::Header;
use crate::args::BatchArgs;
use crate::commands::run::refuse;
use crate::loading::load_text;
use engine::Loaded;

/// A batch that can run.
pub(super) struct Batch<'a> {
    pub(super) args: &'a BatchArgs,
    pub(super) path: &'a Path,
    /// The parameter that gets the files.
    pub(super) param: String,
    engine: &'a Engine<'a>,
    /// The text of the recipe, read once: the same for all files.
    source: Source,
    /// The digest of what the recipe does and expects.
    digest: String,
    /// All files, of all parts.
    inputs: Vec<Input>,
}

impl<'a> Batch<'a> {
    /// Reads the recipe, lists the files, and finds outputs that two files would write. `None` if the recipe cannot
    /// run on any file, which was said.
    pub(super) fn plan(
        args: &'a BatchArgs,
        engine: &'a Engine<'a>,
    ) -> anyhow::Result<Option<Self>> {
        let path = args.recipe.as_deref().unwrap_or(Path::new(""));
        let source = Source::open(path).map_err(anyhow::Error::msg)?;
        // On the file that the recipe names itself, which may well be missing.
        let loaded = load_text(&source, &args.values, &args.out, args.many.budget, engine)?;
        if !loaded.is_read {
            refuse(&loaded, false)?;
            return Ok(None);
        }
        let param = parameter(args, loaded.recipe.parameters())?;
        let batch = Self {
            args,
            path,
            param,
            engine,
            source,
            digest: digest(&loaded),
            inputs: inputs::list(&args.inputs)?,
        };
        batch.check_outputs()?;
        Ok(Some(batch))
    }

    /// Finds outputs that two files would write, and those that would overwrite a file that is read.
    ///
    /// Where outputs go depends on a file only by what stands for placeholders, in this recipe and in
    /// those that it calls. So the recipe is planned once, on a name that no file has.
    fn check_outputs(&self) -> anyhow::Result<()> {
        let [stem, name] = ["\u{1}", "\u{1}.\u{2}"];
        let marked = self.load_at(name, &self.args.out)?;
        let below = |path: &PathBuf| path.strip_prefix(&self.args.out).unwrap_or(path).to_owned();
        let outputs: Vec<PathBuf> = marked.forecast.outputs.iter().map(below).collect();

        let place = |path: &Path| absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let places = self.inputs.iter().map(|file| place(Path::new(&file.path)));
        let read: HashMap<PathBuf, &Input> = places.zip(&self.inputs).collect();
        let mut writers: HashMap<PathBuf, &Input> = HashMap::new();
        for file in &self.inputs {
            let path = Path::new(&file.path);
            let parts = [path.file_stem(), path.file_name()];
            let [own_stem, own_name] = parts.map(|part| part.unwrap_or_default().to_string_lossy());
            for output in &outputs {
                let output = output.to_string_lossy();
                let output = output.replace(name, &own_name).replace(stem, &own_stem);
                let output = self.out(file).join(output);
                if let Some(other) = read.get(&place(&output)) {
                    bail!(
                        "{} would be overwritten with what {} becomes: choose another folder with --out",
                        other.path,
                        file.path
                    );
                }
                if let Some(other) = writers.insert(place(&output), file) {
                    bail!(
                        "{} and {} would both write {}: put `{{{}.stem}}` or `{{{}.name}}` into the output path, or give each file a folder with --folders",
                        other.path,
                        file.path,
                        output.display(),
                        self.param,
                        self.param
                    );
                }
            }
        }
        Ok(())
    }

    /// The output folder of a file.
    pub(super) fn out(&self, file: &Input) -> PathBuf {
        if self.args.folders {
            self.args.out.join(&file.relative)
        } else {
            self.args.out.clone()
        }
    }

    /// The files of this part.
    pub(super) fn mine(&self) -> Vec<&Input> {
        let is_mine = |file: &&Input| self.args.shard.is_none_or(|shard| file.is_in(shard));
        self.inputs.iter().filter(is_mine).collect()
    }

    /// Where its journal is kept.
    pub(super) fn journal(&self) -> PathBuf {
        self.args.out.join(match self.args.shard {
            None => "batch.jsonl".to_owned(),
            Some(shard) => format!("batch-{}-of-{}.jsonl", shard.index, shard.of),
        })
    }

    /// Reads and checks the recipe for a file.
    pub(super) fn load(&self, file: &Input) -> anyhow::Result<Loaded> {
        self.load_at(&file.path, &self.out(file))
    }

    fn load_at(&self, path: &str, out: &Path) -> anyhow::Result<Loaded> {
        let mut values = self.args.values.clone();
        values.set.push((self.param.clone(), path.to_owned()));
        let budget = self.args.many.budget;
        load_text(&self.source, &values, out, budget, self.engine)
    }

    /// The digest of everything that the row of a file depends on; `None` if a file that is read cannot
    /// be.
    pub(super) fn key(&self, file: &Input, loaded: &Loaded) -> Option<String> {
        let mut hasher = blake3::Hasher::new();
        // Each part with its length: no two lists of parts are the same text.
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
        for output in &loaded.forecast.outputs {
            part(output.as_os_str().as_encoded_bytes());
        }
        let folders = loaded.recipe.files(&loaded.files);
        let compared = loaded.recipe.expectations.iter().filter_map(|placed| {
            let path = match (placed.that.others(), placed.that.output()) {
                (Some(Other::File(path)), _) => path,
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

    /// Removes the folders in which outputs waited when an earlier process was killed.
    pub(super) fn remove_stale(&self, processes: &[u32]) {
        if processes.is_empty() {
            return;
        }
        let stale = processes.iter().map(|p| store::temporary_prefix(*p));
        let stale: Vec<String> = stale.collect();
        let mut folders = vec![self.args.out.clone()];
        if self.args.folders {
            folders.extend(self.mine().into_iter().map(|file| self.out(file)));
        }
        let lists = folders.iter().filter_map(|f| std::fs::read_dir(f).ok());
        for entry in lists.flatten().flatten() {
            let name = entry.file_name();
            if stale.iter().any(|p| name.to_string_lossy().starts_with(p)) {
                // What cannot be removed is in nobody's way.
                let _ = std::fs::remove_dir_all(entry.path());
            }
        }
    }

    /// What the report is about.
    pub(super) fn header(&self) -> Header {
        let mut listed = blake3::Hasher::new();
        for file in &self.inputs {
            listed.update(file.path.as_bytes());
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

/// The name of the parameter that gets the files.
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
            "the recipe has no parameter of type Path that could take the files: write `params: {{\"model\": Path(default: \"..\")}}` and `Load(path: arg(\"model\"))`"
        ),
        (None, several) => bail!(
            "the recipe has several parameters of type Path: choose one of {} with --param",
            several.join(", ")
        ),
    };
    let is_set = args.values.set.iter().any(|(set, _)| *set == name);
    ensure!(
        !is_set,
        "the parameter `{name}` takes the files, so it cannot be set with --set"
    );
    Ok(name)
}

/// The digest of what a recipe does and expects.
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
