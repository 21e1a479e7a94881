//! Computes where the factor L has nonzero entries: the elimination tree, the supernodes and their rows.
//!
//! Source: Liu, "The Role of Elimination Trees in Sparse Factorization", 1990. A supernode is a range of columns that
//! have entries in the same rows below their diagonal block. Small supernodes are merged with their parents, although
//! the factor then stores some zeros (Ashcraft, Grimes, "The Influence of Relaxed Supernode Partitions on the
//! Multifrontal Method", 1989).
//!
//! ```text
//!     x                  a supernode of 3 columns
//!     x x                with 5 rows: 3 pivots
//!     x x x              and 2 more
//!     x x x
//!     x x x
//! ```

use std::ops::Range;

/// The pattern of the factor of a matrix.
pub(super) struct Symbolic {
    /// For each row of the factor, the row of the matrix that it comes from.
    pub(super) order: Vec<u32>,
    /// The supernodes. All descendants of a supernode come directly before it in this list.
    pub(super) supernodes: Vec<Supernode>,
}

/// A range of columns that have entries in the same rows below their diagonal block.
pub(super) struct Supernode {
    pub(super) columns: Range<usize>,
    /// All rows in ascending order. The list begins with the columns of the supernode.
    pub(super) rows: Vec<u32>,
    /// The parent in the elimination tree. Let r be the first row in `rows` that is not a column of this supernode. The
    /// parent is the supernode that has r as a column.
    pub(super) parent: Option<usize>,
    pub(super) n_children: usize,
}

impl Supernode {
    /// Returns the number of stored entries.
    pub(super) fn n_entries(&self) -> u64 {
        (self.columns.len() * self.rows.len()) as u64
    }

    /// Returns the approximate number of floating-point operations that the elimination of this supernode takes.
    pub(super) fn work(&self) -> u64 {
        let (m, k) = (self.rows.len() as u64, self.columns.len() as u64);
        (0..k).map(|c| (m - c) * (m - c)).sum::<u64>() + m
    }
}

/// Stands for a missing column, for example if a column has no parent in the elimination tree.
const NONE: u32 = u32::MAX;

impl Symbolic {
    /// Computes the pattern. `neighbors(i)` iterates over the columns of row i in any order. It does not matter whether
    /// the column i itself is among them.
    pub(super) fn new<I: Iterator<Item = u32>>(
        order: &[u32],
        neighbors: impl Fn(usize) -> I,
    ) -> Self {
        let tree = elimination_tree(order, &neighbors);
        let post = postorder(&tree);
        let order: Vec<u32> = post.iter().map(|&j| order[j as usize]).collect();
        let position = inverse(&post);
        let parent: Vec<u32> = post
            .iter()
            .map(|&j| match tree[j as usize] {
                NONE => NONE,
                parent => position[parent as usize],
            })
            .collect();
        let position = inverse(&order);
        let row = |j: usize| neighbors(order[j] as usize).map(|i| position[i as usize]);
        let counts = counts(&parent, row);
        let ranges = supernode_ranges(&parent, &counts);
        let supernodes = with_rows(ranges, order.len(), row);
        Self { order, supernodes }
    }

    /// Returns the number of stored entries of the factor.
    pub(super) fn n_entries(&self) -> u64 {
        self.supernodes.iter().map(Supernode::n_entries).sum()
    }
}

fn as_row(j: usize) -> u32 {
    u32::try_from(j).expect("rows fit 32 bits")
}

/// Returns, for each number, its position in the permutation `order`.
pub(super) fn inverse(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (at, &i) in (0..).zip(order) {
        position[i as usize] = at;
    }
    position
}

/// Returns the parent of each column of the permuted matrix. The parent is the row of the first entry below the
/// diagonal in the same column of the factor.
fn elimination_tree<I: Iterator<Item = u32>>(
    order: &[u32],
    neighbors: impl Fn(usize) -> I,
) -> Vec<u32> {
    let position = inverse(order);
    let mut parent = vec![NONE; order.len()];
    // For each column, the highest ancestor in the elimination tree that has been found so far. The loop jumps to these
    // ancestors, because this shortens the paths to the root.
    let mut ancestor = vec![NONE; order.len()];
    for (k, &row) in (0..).zip(order) {
        for i in neighbors(row as usize) {
            let mut j = position[i as usize];
            while j < k {
                let next = std::mem::replace(&mut ancestor[j as usize], k);
                if next == NONE {
                    parent[j as usize] = k;
                    break;
                }
                if next == k {
                    break;
                }
                j = next;
            }
        }
    }
    parent
}

/// Returns the columns in an order in which all descendants of a column come directly before it.
fn postorder(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let (mut first, mut next, mut roots) = (vec![NONE; n], vec![NONE; n], Vec::new());
    for (j, &p) in (0..as_row(n)).zip(parent).rev() {
        if p == NONE {
            roots.push(j);
        } else {
            next[j as usize] = std::mem::replace(&mut first[p as usize], j);
        }
    }
    let mut post = Vec::with_capacity(n);
    while let Some(j) = roots.last().copied() {
        // A column is added to the result when its list of children is empty.
        let child = first[j as usize];
        if child == NONE {
            post.push(j);
            roots.pop();
        } else {
            first[j as usize] = next[child as usize];
            roots.push(child);
        }
    }
    post
}

/// Returns the number of entries of each column of the factor, including the diagonal.
fn counts<I: Iterator<Item = u32>>(parent: &[u32], row: impl Fn(usize) -> I) -> Vec<u32> {
    let n = parent.len();
    let (mut counts, mut mark) = (vec![1; n], vec![NONE; n]);
    for i in 0..n {
        let this = as_row(i);
        mark[i] = this;
        // Each column j < i with an entry in row i of the matrix starts a path that leads up through the elimination
        // tree to column i. Row i of the factor has an entry in every column on these paths.
        for mut j in row(i).filter(|&j| j < this) {
            while mark[j as usize] != this {
                mark[j as usize] = this;
                counts[j as usize] += 1;
                j = parent[j as usize];
            }
        }
    }
    counts
}

/// Returns, for each supernode, the range of its columns.
fn supernode_ranges(parent: &[u32], counts: &[u32]) -> Vec<Range<usize>> {
    /// A supernode, its number of rows, and the number of zeros among its entries.
    struct Part {
        columns: Range<usize>,
        rows: u64,
        zeros: u64,
    }
    let mut parts: Vec<Part> = Vec::new();
    for j in 0..parent.len() {
        let rows = u64::from(counts[j]);
        let mut part = Part {
            columns: j..j + 1,
            rows,
            zeros: 0,
        };
        let extends_last = j > 0 && parent[j - 1] as usize == j && counts[j - 1] == counts[j] + 1;
        if let Some(mut last) = parts.pop_if(|_| extends_last) {
            last.columns.end = j + 1;
            part = last;
        }
        // Merges the supernode with its last child, again and again, as long as the merged supernode has few zeros
        // among its entries.
        while let Some(last) = parts.last() {
            let end = last.columns.end;
            if end != part.columns.start || !part.columns.contains(&(parent[end - 1] as usize)) {
                break;
            }
            let k = last.columns.len() as u64;
            let rows = k + part.rows;
            let zeros = last.zeros + part.zeros + k * (rows - last.rows);
            let columns = k + part.columns.len() as u64;
            let entries = columns * rows;
            let is_cheap = match columns {
                0..=4 => true,
                5..=16 => zeros * 5 <= entries * 2,
                17..=48 => zeros * 10 <= entries,
                _ => zeros * 20 <= entries,
            };
            if !is_cheap {
                break;
            }
            part = Part {
                columns: last.columns.start..part.columns.end,
                rows,
                zeros,
            };
            parts.pop();
        }
        parts.push(part);
    }
    parts.into_iter().map(|part| part.columns).collect()
}

/// Computes the rows, the parent and the number of children of each supernode.
fn with_rows<I: Iterator<Item = u32>>(
    ranges: Vec<Range<usize>>,
    n: usize,
    row: impl Fn(usize) -> I,
) -> Vec<Supernode> {
    let mut of_column = vec![0; n];
    for (s, range) in ranges.iter().enumerate() {
        of_column[range.clone()].fill(s);
    }
    let mut children = vec![Vec::new(); ranges.len()];
    let mut mark = vec![usize::MAX; n];
    let mut supernodes: Vec<Supernode> = Vec::with_capacity(ranges.len());
    for (s, columns) in ranges.into_iter().enumerate() {
        let mut rows: Vec<u32> = columns.clone().map(as_row).collect();
        let mut add = |i: u32| {
            if i as usize >= columns.end && mark[i as usize] != s {
                mark[i as usize] = s;
                rows.push(i);
            }
        };
        columns.clone().flat_map(&row).for_each(&mut add);
        for &child in &children[s] {
            let child: &Supernode = &supernodes[child];
            child.rows[child.columns.len()..]
                .iter()
                .copied()
                .for_each(&mut add);
        }
        rows[columns.len()..].sort_unstable();
        rows.shrink_to_fit();
        let parent = rows.get(columns.len()).map(|&i| of_column[i as usize]);
        if let Some(parent) = parent {
            children[parent].push(s);
        }
        supernodes.push(Supernode {
            columns,
            rows,
            parent,
            n_children: std::mem::take(&mut children[s]).len(),
        });
    }
    supernodes
}
