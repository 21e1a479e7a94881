//! Reads the vectors of sources. A source consists of an array of numbers and an accessor. The accessor defines which
//! of these numbers form a vector.
//!
//! ```text
//! <source id="s">
//!   <float_array id="a" count="7">9  0 0 0  1 0 0</float_array>
//!   <technique_common>
//!     <accessor source="#a" offset="1" count="2" stride="3">     (0 0 0) (1 0 0)
//!       <param name="X"/> <param name="Y"/> <param name="Z"/>     parameters without a name are skipped
//! ```

use super::document::{Document, Node, below, error_at, named, natural, numbers, required};
use crate::fault::Fault;
use crate::text::quoted;

/// Vectors with 1 to 4 components.
#[derive(Debug)]
pub(super) struct Vectors {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

impl Vectors {
    pub(super) fn len(&self) -> usize {
        self.values.len() / self.width
    }

    /// The i-th vector. Missing components are taken from `defaults`.
    pub(super) fn get<const N: usize>(&self, i: usize, mut defaults: [f64; N]) -> [f64; N] {
        let vector = self.values[i * self.width..].iter().take(self.width);
        for (to, from) in defaults.iter_mut().zip(vector) {
            *to = *from;
        }
        defaults
    }
}

/// Reads the vectors of a source. If the accessor has a component for each of the given `names`, the components of the
/// vectors are in the order of `names`. Otherwise, the components are in the order of the accessor. Also returns the
/// length of the array of the source, because the whole array is read. The array can contain more numbers than the
/// vectors need, because several sources can share an array.
///
/// # Errors
///
/// Returns an error if the source is invalid or its vectors have fewer than `least` components.
pub(super) fn vectors(
    document: &Document,
    source: Node,
    names: &[&str],
    least: usize,
) -> Result<(Vectors, usize), Fault> {
    let accessor = below(source, &["technique_common", "accessor"])
        .ok_or_else(|| error_at(source, "expected an accessor in technique_common"))?;
    let components = components(accessor, names)?;
    if components.len() < least {
        let message = format!(
            "expected an accessor with at least {least} components, found {}",
            components.len()
        );
        return Err(error_at(accessor, message));
    }
    let count = natural(accessor, "count")?
        .ok_or_else(|| error_at(accessor, "expected an attribute `count`"))?;
    let offset = natural(accessor, "offset")?.unwrap_or(0);
    let stride = natural(accessor, "stride")?.unwrap_or(1);
    let Some(array) = document.follow(accessor, "source", &["float_array", "int_array"])? else {
        return Err(error_at(
            accessor,
            "arrays in other files are not supported",
        ));
    };
    let values = numbers(array)?;
    let n_numbers = values.len();
    if natural(array, "count")?.is_some_and(|count| count != values.len()) {
        let declared = required(array, "count")?;
        let message = format!(
            "expected {declared} numbers according to the attribute `count`, found {}",
            values.len()
        );
        return Err(error_at(array, message));
    }
    let last = components.iter().max().map_or(0, |last| last + 1);
    if last > stride {
        let message =
            format!("expected the stride of the accessor to be at least {last}, found {stride}");
        return Err(error_at(accessor, message));
    }
    let end = match count.checked_sub(1) {
        None => Some(0),
        Some(before) => {
            let start = before.checked_mul(stride);
            start.and_then(|start| start.checked_add(offset)?.checked_add(last))
        }
    };
    if end.is_none_or(|end| end > n_numbers) {
        let source = quoted(required(accessor, "source")?.as_bytes());
        let message = format!("{count} vectors need more than the {n_numbers} numbers of {source}");
        return Err(error_at(accessor, message));
    }
    let width = components.len();
    let starts = (0..count).map(|i| offset + i * stride);
    let picked = starts.flat_map(|start| components.iter().map(move |&c| start + c));
    let values = picked.map(|i| values[i]).collect();
    Ok((Vectors { width, values }, n_numbers))
}

/// Returns the offsets of the components of a vector. There are at most four.
fn components(accessor: Node, names: &[&str]) -> Result<Vec<usize>, Fault> {
    let params = named(accessor, "param").map(|param| param.attribute("name"));
    let params: Vec<&str> = params.map(Option::unwrap_or_default).collect();
    let place = |name: &&str| params.iter().position(|param| param == name);
    let ordered: Option<Vec<usize>> = names.iter().map(place).collect();
    let mut components: Vec<usize> = match ordered {
        _ if params.iter().all(|name| name.is_empty()) => {
            let stride = natural(accessor, "stride")?.unwrap_or(1);
            (0..stride.min(4)).collect()
        }
        Some(ordered) => {
            // Components with other names, such as the alpha of a color, come after the components in `names`.
            let further =
                (0..params.len()).filter(|i| !ordered.contains(i) && !params[*i].is_empty());
            ordered.iter().copied().chain(further).collect()
        }
        None => (0..params.len())
            .filter(|&i| !params[i].is_empty())
            .collect(),
    };
    components.truncate(4);
    Ok(components)
}
