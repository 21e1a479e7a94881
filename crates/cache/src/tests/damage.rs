//! Tests of damaged, full, blocked and missing caches. Such caches never cause an error or a different result.

use super::*;

/// Returns all files below a folder, sorted.
pub(super) fn all_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Damages a file. The second argument contains the contents of all files of the cache.
type Damage = fn(&Path, &[Vec<u8>]);

/// Returns a recipe whose scene is so large that its arrays are stored as blobs.
fn recipe() -> String {
    r#"(recipe: 1, steps: [
        Sheet(columns: 700), (id: "up", run: Lift(by: 1)), Write(path: "a.txt"), Lift(by: 2)],
        expect: [Faces(eq: 700), (after: "up", that: Not(Closed))])"#
        .to_owned()
}

#[test]
fn damage_to_any_file_is_noticed() {
    let place = Place::new();
    let text = recipe();
    place.run(&text);
    let n_files = all_files(&place.path("cache")).len();
    assert!(n_files > 10, "{n_files}");
    let damages: [Damage; 6] = [
        |path, _| {
            let mut bytes = fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            if let Some(byte) = bytes.get_mut(middle) {
                *byte ^= 4;
            }
            fs::write(path, bytes).unwrap();
        },
        |path, _| {
            let bytes = fs::read(path).unwrap();
            fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
        },
        |path, _| fs::write(path, "").unwrap(),
        |path, _| fs::remove_file(path).unwrap(),
        // Writes the intact content of another file of the cache to this file, so that the content does not match the
        // name.
        |path, others| fs::write(path, &others[0]).unwrap(),
        |path, others| fs::write(path, others.last().unwrap()).unwrap(),
    ];
    // If the last step of the recipe is edited, the run reads the files of the scene before this step. One of these
    // files can be damaged.
    let edited = text.replace("Lift(by: 2)", "Lift(by: 3)");
    let plain = [&text, &edited].map(|text| place.run_with(text, None, "plain"));
    for damage in damages {
        for i in 0..n_files {
            let files = all_files(&place.path("cache"));
            let contents: Vec<Vec<u8>> = files.iter().map(|p| fs::read(p).unwrap()).collect();
            let Some(path) = files.get(i) else { continue };
            damage(path, &contents);
            for (text, plain) in [&text, &edited].iter().zip(&plain) {
                assert_same(plain, &place.run_with(text, Some(place.caching()), "out"));
                assert_eq!(fs::read(place.path("out/a.txt")).unwrap(), b"sheet");
            }
        }
    }
    // The previous runs have stored all damaged files again.
    place.run(&text);
    place.runs_nothing(&text);
}

#[test]
fn an_edited_record_is_rejected_even_with_a_new_digest() {
    let place = Place::new();
    let text = recipe();
    place.run(&text);
    let records = all_files(&place.path("cache/steps"));
    let whole: Vec<Vec<u8>> = records.iter().map(|path| fs::read(path).unwrap()).collect();
    let plain = place.run_with(&text, None, "plain");
    let magic = b"meshwright cache\n".len();
    for (path, whole) in records.iter().zip(&whole) {
        let parts = path.iter().rev().take(2).map(|part| part.to_str().unwrap());
        let name: String = parts.collect::<Vec<_>>().into_iter().rev().collect();
        let id = blake3::Hash::from_hex(name).unwrap();
        let step = (whole.len() / 6).max(1);
        for at in (magic + 32..whole.len()).step_by(step) {
            let mut forged = whole.clone();
            forged[at] ^= 1;
            let digest = blake3::hash(&[id.as_bytes(), &forged[magic + 32..]].concat());
            forged[magic..magic + 32].copy_from_slice(digest.as_bytes());
            fs::write(path, &forged).unwrap();
            assert_same(&plain, &place.run_with(&text, Some(place.caching()), "out"));
        }
    }
}

/// Runs the recipe, removes each file of the cache and calls `replace` with its path. Then runs the recipe again.
fn run_with_replaced_files(replace: impl Fn(&Path)) -> Place {
    let place = Place::new();
    place.run(&recipe());
    for path in all_files(&place.path("cache")) {
        fs::remove_file(&path).unwrap();
        replace(&path);
    }
    place.run(&recipe());
    place
}

#[cfg(unix)]
#[test]
fn links_to_devices_are_not_read() {
    let place =
        run_with_replaced_files(|path| std::os::unix::fs::symlink("/dev/zero", path).unwrap());
    place.runs_nothing(&recipe());
}

#[test]
fn folders_in_place_of_files_are_ignored() {
    run_with_replaced_files(|path| fs::create_dir(path).unwrap());
}

#[test]
fn a_lost_scene_is_computed_again_and_reported() {
    let place = Place::new();
    let text = recipe();
    place.run(&text);
    for path in all_files(&place.path("cache/blobs")) {
        fs::remove_file(path).unwrap();
    }
    let outcome = place.run(&text.replace("Lift(by: 2)", "Lift(by: 3)"));
    let whys: Vec<_> = outcome.steps.iter().map(|step| step.ran.clone()).collect();
    assert_eq!(whys[0], Some(RerunReason::Gone));
    assert_eq!(whys[1], Some(RerunReason::Gone));
    assert!(
        outcome
            .cache_notes
            .iter()
            .any(|note| note.contains("no longer in the cache"))
    );
}

#[test]
fn a_cache_that_cannot_be_written_is_reported_and_the_run_continues() {
    let mut place = Place::new();
    place.write("file", "");
    place.cache = Cache::new(place.path("file/cache"), u64::MAX, "tests 1");
    let outcome = place.run(&recipe());
    assert!(outcome.succeeded());
    let problem = outcome.cache_problem.unwrap();
    let expected = format!(
        "cannot write to the cache folder {}",
        place.path("file/cache").display()
    );
    assert!(problem.starts_with(&expected), "{problem}");
    assert!(!problem.contains("cache/tmp"), "{problem}");
}

#[test]
fn a_cache_with_limit_0_is_emptied_after_each_run() {
    let mut place = Place::new();
    place.cache = Cache::new(place.path("cache"), 0, "tests 1");
    for _ in 0..2 {
        assert_eq!(place.numbers(&recipe()), [1, 2, 3, 4]);
        assert_eq!(place.cache.size().unwrap().bytes, 0);
    }
}

#[test]
fn a_cache_can_be_cleared() {
    let place = Place::new();
    assert_eq!(place.cache.clear().unwrap(), crate::CacheSize::default());
    place.run(&recipe());
    let size = place.cache.size().unwrap();
    assert!(
        size.steps == 4 && size.blobs > 0 && size.bytes > 10_000,
        "{size:?}"
    );
    assert_eq!(place.cache.clear().unwrap(), size);
    assert_eq!(place.numbers(&recipe()), [1, 2, 3, 4]);
}

#[test]
fn a_step_that_changes_one_array_stores_one_array() {
    let place = Place::new();
    place.run(&steps("Sheet(columns: 700)"));
    let before = place.cache.size().unwrap().blobs;
    place.run(&steps("Sheet(columns: 700), Lift(by: 1)"));
    // Of the arrays of the scene, only the array of positions was added to the cache.
    assert_eq!(place.cache.size().unwrap().blobs, before + 1);
}
