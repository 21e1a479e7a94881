//! Suggests names that are similar to an unknown name.

use super::listed;

/// Returns the candidates that are most similar to `name`. The most similar candidate comes first. Returns at most
/// three candidates. If no candidate is similar, the result is empty.
///
/// Upper case and lower case count as equal, and underscores are ignored: `loop_subdivide` equals `LoopSubdivide`.
///
/// ```
/// let operations = ["LoopSubdivide", "Load", "FlipEdges"];
/// assert_eq!(recipe::schema_check::nearest("loop_subdivde", operations), ["LoopSubdivide"]);
/// assert!(recipe::schema_check::nearest("Extrude", operations).is_empty());
/// ```
pub fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Vec<&'c str> {
    // Only the start of a long name is compared, because the comparison is slow and known names are short.
    let sought = plain(name.get(..name.len().min(64)).unwrap_or(name));
    let mut near: Vec<(usize, &str)> = candidates
        .into_iter()
        .filter_map(|candidate| {
            let known = plain(candidate);
            let is_prefix =
                sought.len() >= 3 && (known.starts_with(&sought) || sought.starts_with(&known));
            let max_distance = known.chars().count().max(3) / 3;
            if !is_prefix && min_distance(&sought, &known) > max_distance {
                return None;
            }
            let distance = strsim::damerau_levenshtein(&sought, &known);
            (distance <= max_distance || is_prefix).then_some((distance, candidate))
        })
        .collect();
    near.sort_unstable();
    near.truncate(3);
    near.into_iter().map(|(_, candidate)| candidate).collect()
}

/// Returns a lower bound of the edit distance between two names. The bound is the larger of two numbers: the number of
/// letters that only the first name has, and the number of letters that only the second name has. The bound is fast to
/// compute and excludes most names from the slower comparison.
fn min_distance(a: &str, b: &str) -> usize {
    let mut surplus = [0_isize; 32];
    a.bytes()
        .for_each(|byte| surplus[usize::from(byte % 32)] += 1);
    b.bytes()
        .for_each(|byte| surplus[usize::from(byte % 32)] -= 1);
    let only = |sign: isize| {
        surplus
            .iter()
            .map(|n| (sign * n).max(0).unsigned_abs())
            .sum::<usize>()
    };
    let bytes = only(1).max(only(-1));
    // The letters were counted in bytes. A character has at most 4 bytes, so the distance in characters is at least a
    // quarter of the distance in bytes.
    if a.is_ascii() && b.is_ascii() {
        bytes
    } else {
        bytes / 4
    }
}

/// Returns a help text for an unknown name. The text lists the most similar known names or, if no name is similar, the
/// first 40 known names.
///
/// ```
/// let known = ["segments", "levels"];
/// assert_eq!(recipe::schema_check::did_you_mean("level", known), "did you mean `levels`?");
/// assert_eq!(recipe::schema_check::did_you_mean("x", known), "known: `segments`, `levels`");
/// ```
pub fn did_you_mean<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> String {
    /// The maximum number of names in the list.
    const MAX_NAMES: usize = 40;
    let known: Vec<&str> = known.into_iter().collect();
    let near = nearest(name, known.iter().copied());
    if !near.is_empty() {
        format!("did you mean {}?", listed(near))
    } else if known.is_empty() {
        "no names are defined".to_owned()
    } else {
        let rest = if known.len() > MAX_NAMES {
            " and others"
        } else {
            ""
        };
        format!("known: {}{rest}", listed(known.into_iter().take(MAX_NAMES)))
    }
}

fn plain(name: &str) -> String {
    name.chars()
        .filter(|&c| c != '_')
        .flat_map(char::to_lowercase)
        .take(64)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_comes_first() {
        assert_eq!(
            nearest("levl", ["label", "levels", "level"]),
            ["level", "levels"]
        );
    }

    #[test]
    fn two_swapped_letters_are_one_edit() {
        assert_eq!(nearest("egdes", ["edges", "faces"]), ["edges"]);
    }

    #[test]
    fn the_start_of_a_name_is_similar() {
        assert_eq!(
            nearest("LoopSub", ["LoopSubdivide", "Load"]),
            ["LoopSubdivide"]
        );
        assert_eq!(nearest("seg", ["segments"]), ["segments"]);
    }

    #[test]
    fn names_that_are_not_similar_are_not_suggested() {
        assert!(nearest("xyz", ["levels", "creases", "at"]).is_empty());
        assert!(nearest(&"x".repeat(100_000), ["levels"]).is_empty());
    }
}
