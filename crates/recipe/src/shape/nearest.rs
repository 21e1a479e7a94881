//! Guesses which name was meant.

use super::listed;

/// The candidates that resemble `name` most, the nearest first: three at most, often none.
///
/// Capitals and underscores do not count: `loop_subdivide` is `LoopSubdivide`.
///
/// ```
/// let operations = ["LoopSubdivide", "Load", "FlipEdges"];
/// assert_eq!(recipe::shape::nearest("loop_subdivde", operations), ["LoopSubdivide"]);
/// assert!(recipe::shape::nearest("Extrude", operations).is_empty());
/// ```
pub fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Vec<&'c str> {
    // Long names are no slips of known ones, and slow to compare.
    let sought = plain(name.get(..name.len().min(64)).unwrap_or(name));
    let mut near: Vec<(usize, &str)> = candidates
        .into_iter()
        .filter_map(|candidate| {
            let known = plain(candidate);
            let begins =
                sought.len() >= 3 && (known.starts_with(&sought) || sought.starts_with(&known));
            let allowed = known.chars().count().max(3) / 3;
            if !begins && least_slips(&sought, &known) > allowed {
                return None;
            }
            let slips = strsim::damerau_levenshtein(&sought, &known);
            (slips <= allowed || begins).then_some((slips, candidate))
        })
        .collect();
    near.sort_unstable();
    near.truncate(3);
    near.into_iter().map(|(_, candidate)| candidate).collect()
}

/// At least so many slips lie between two names: the letters that one has and the other lacks. Quick, as most
/// names are far from each other.
fn least_slips(a: &str, b: &str) -> usize {
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
    // One letter can have four bytes.
    if a.is_ascii() && b.is_ascii() {
        bytes
    } else {
        bytes / 4
    }
}

/// Advice on an unknown name: the nearest of the known ones, or all of them if none is near.
///
/// ```
/// let known = ["segments", "levels"];
/// assert_eq!(recipe::shape::did_you_mean("level", known), "did you mean `levels`?");
/// assert_eq!(recipe::shape::did_you_mean("x", known), "known: `segments`, `levels`");
/// ```
pub fn did_you_mean<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> String {
    /// More names than this are no advice.
    const MOST: usize = 40;
    let known: Vec<&str> = known.into_iter().collect();
    let near = nearest(name, known.iter().copied());
    if !near.is_empty() {
        format!("did you mean {}?", listed(near))
    } else if known.is_empty() {
        "there are none".to_owned()
    } else {
        let rest = if known.len() > MOST {
            " and others"
        } else {
            ""
        };
        format!("known: {}{rest}", listed(known.into_iter().take(MOST)))
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
    fn swapped_letters_are_one_slip() {
        assert_eq!(nearest("egdes", ["edges", "faces"]), ["edges"]);
    }

    #[test]
    fn the_start_of_a_name_is_near() {
        assert_eq!(
            nearest("LoopSub", ["LoopSubdivide", "Load"]),
            ["LoopSubdivide"]
        );
        assert_eq!(nearest("seg", ["segments"]), ["segments"]);
    }

    #[test]
    fn what_is_far_is_not_suggested() {
        assert!(nearest("xyz", ["levels", "creases", "at"]).is_empty());
        assert!(nearest(&"x".repeat(100_000), ["levels"]).is_empty());
    }
}
