//! A fill-reducing ordering: approximate minimum degree.
//!
//! Source: Amestoy, Davis, Duff, "An Approximate Minimum Degree Ordering Algorithm", 1996. The graph of the remaining
//! matrix is stored as a quotient graph. In this graph, an eliminated vertex p becomes an element, which stands for the
//! clique (all pairs) of the neighbors of p:
//!
//! ```text
//!     a --- p --- b               a ..... b
//!           |            -->       '. p .'       p is an element with the members a, b and c
//!           c                        'c'
//! ```
//!
//! The vertices that are not eliminated are called variables. Variables with the same neighbors are merged into one
//! supervariable. If several variables have the lowest degree, the variable that was added last to the list of this
//! degree is eliminated first. The result therefore depends only on the graph.

use progress::{Cancelled, Progress};

/// Marks the end of a linked list.
const NONE: u32 = u32::MAX;

/// Returns the rows from 0 to n - 1 in a new order. In this order, Gaussian elimination creates few nonzero entries.
/// `neighbors[i]` has the columns of row i without i itself.
pub(super) fn minimum_degree(
    neighbors: Vec<Vec<u32>>,
    progress: &dyn Progress,
) -> Result<Vec<u32>, Cancelled> {
    let n = neighbors.len();
    let mut graph = Quotient::new(neighbors);
    let mut done = 0;
    let mut reported = 0;
    while done < n {
        if done >= reported {
            progress.report("order the unknowns", done as u64, n as u64)?;
            reported = done + 4096;
        }
        done += graph.eliminate(n - done);
    }
    Ok(graph.order())
}

struct Quotient {
    /// For each variable, its neighbors that share no element with it.
    variables: Vec<Vec<u32>>,
    /// The adjacent elements of each variable.
    elements: Vec<Vec<u32>>,
    /// For each element, its members: the variables that are its neighbors. The list is empty if the element was
    /// absorbed by another element.
    members: Vec<Vec<u32>>,
    /// For each element, the total weight of its members at the time when the element was created.
    size: Vec<u32>,
    /// For each variable, its weight: the number of matrix rows that it stands for. The weight is 0 if the variable was
    /// eliminated or merged into another variable.
    weight: Vec<u32>,
    /// The variables that were merged into each variable, as linked lists.
    first_merged: Vec<u32>,
    next_merged: Vec<u32>,
    degree: Vec<u32>,
    buckets: Buckets,
    /// The eliminated variables, in the order of their elimination.
    pivots: Vec<u32>,
    /// For each element, a sum: 2³² times `stamp`, plus the total weight of the members that are not also members of
    /// the newest element.
    outside: Vec<u64>,
    /// For each variable and each element, the value that `stamp` had when this entry was last set.
    mark: Vec<u64>,
    stamp: u64,
    /// The hash and the variable of each member of the new element.
    hashes: Vec<(u64, u32)>,
}

/// The variables of each degree, as doubly linked lists.
struct Buckets {
    first: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    lowest: usize,
}

impl Buckets {
    fn insert(&mut self, v: u32, degree: u32) {
        let first = &mut self.first[degree as usize];
        self.next[v as usize] = *first;
        self.previous[v as usize] = NONE;
        if *first != NONE {
            self.previous[*first as usize] = v;
        }
        *first = v;
        self.lowest = self.lowest.min(degree as usize);
    }

    fn remove(&mut self, v: u32, degree: u32) {
        let (next, previous) = (self.next[v as usize], self.previous[v as usize]);
        if next != NONE {
            self.previous[next as usize] = previous;
        }
        if previous == NONE {
            self.first[degree as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
    }

    fn lowest(&mut self) -> u32 {
        while self.first[self.lowest] == NONE {
            self.lowest += 1;
        }
        self.first[self.lowest]
    }
}

impl Quotient {
    fn new(variables: Vec<Vec<u32>>) -> Self {
        let n = variables.len();
        let lists = || vec![NONE; n];
        let degree: Vec<u32> = variables
            .iter()
            .map(|list| u32::try_from(list.len()).expect("rows fit 32 bits"))
            .collect();
        let mut buckets = Buckets {
            first: lists(),
            next: lists(),
            previous: lists(),
            lowest: n,
        };
        let rows = u32::try_from(n).expect("rows fit 32 bits");
        for (v, &d) in (0..rows).zip(&degree).rev() {
            buckets.insert(v, d);
        }
        Self {
            variables,
            elements: vec![Vec::new(); n],
            members: vec![Vec::new(); n],
            size: vec![0; n],
            weight: vec![1; n],
            first_merged: lists(),
            next_merged: lists(),
            degree,
            buckets,
            pivots: Vec::new(),
            outside: vec![0; n],
            mark: vec![0; n],
            stamp: 1,
            hashes: Vec::new(),
        }
    }

    /// Eliminates a variable with the lowest degree. A new element (a clique) replaces the variable. Neighbors of the
    /// variable that then have no neighbors outside the new element are eliminated too. `remaining` is the number of
    /// rows that are not eliminated. Returns the number of eliminated rows.
    fn eliminate(&mut self, remaining: usize) -> usize {
        let p = self.buckets.lowest();
        self.buckets.remove(p, self.degree[p as usize]);
        let mut members = self.new_element(p);
        let mut eliminated = self.weight[p as usize];
        self.weight[p as usize] = 0;
        self.pivots.push(p);
        self.measure_elements(&members);
        self.hashes.clear();
        for &i in &members {
            let (d, hash) = self.update(i, p);
            if self.elements[i as usize].len() == 1 && self.variables[i as usize].is_empty() {
                // All neighbors of the variable i are members of the element p, so eliminating i directly after p
                // creates no new nonzero entries.
                eliminated += self.weight[i as usize];
                self.merge(i, p);
            } else {
                self.hashes.push((hash, i));
                self.degree[i as usize] = d;
            }
        }
        self.merge_equal();
        members.retain(|&i| self.weight[i as usize] > 0);
        let left = u32::try_from(remaining).expect("rows fit 32 bits") - eliminated;
        let size: u32 = members.iter().map(|&i| self.weight[i as usize]).sum();
        for &i in &members {
            let (degree, weight) = (&mut self.degree[i as usize], self.weight[i as usize]);
            *degree = (*degree + size - weight).min(left - weight);
            self.buckets.insert(i, *degree);
        }
        self.members[p as usize] = members;
        self.size[p as usize] = size;
        eliminated as usize
    }

    /// Returns the members of the new element p: the neighbors of p. The elements adjacent to p are absorbed. The
    /// members are removed from the lists in `buckets`, and marked with the current stamp.
    fn new_element(&mut self, p: u32) -> Vec<u32> {
        self.stamp += 1;
        self.mark[p as usize] = self.stamp;
        let mut members = Vec::new();
        let variables = std::mem::take(&mut self.variables[p as usize]);
        let elements = std::mem::take(&mut self.elements[p as usize]);
        let lists = elements
            .iter()
            .map(|&e| std::mem::take(&mut self.members[e as usize]));
        for i in lists.flatten().chain(variables) {
            if self.weight[i as usize] > 0 && self.mark[i as usize] != self.stamp {
                self.mark[i as usize] = self.stamp;
                self.buckets.remove(i, self.degree[i as usize]);
                members.push(i);
            }
        }
        members
    }

    /// Computes the entries of `outside` for all elements that are adjacent to at least one of the members.
    fn measure_elements(&mut self, members: &[u32]) {
        // The stamp grows with each step, so all new values in `outside` are above all earlier values. Therefore old
        // values do not have to be cleared.
        let base = self.stamp << 32;
        for &i in members {
            for &e in &self.elements[i as usize] {
                let outside = &mut self.outside[e as usize];
                if *outside < base {
                    *outside = base + u64::from(self.size[e as usize]);
                }
                *outside -= u64::from(self.weight[i as usize]);
            }
        }
    }

    /// Updates the lists of i, a member of the new element p. Variables that are members of p are removed, and so are
    /// elements without members outside of p. Then p is added. Returns two numbers: an upper bound of the degree of i,
    /// not counting the members of p, and a hash of the lists of i.
    fn update(&mut self, i: u32, p: u32) -> (u32, u64) {
        let base = self.stamp << 32;
        let (mut degree, mut hash) = (0_u64, u64::from(p));
        let (outside, list) = (&self.outside, &self.members);
        self.elements[i as usize].retain(|&e| {
            // An element whose list of members is empty was absorbed by another element. If `more` is 0, all members of
            // the element e are members of p.
            let more = outside[e as usize].saturating_sub(base);
            let keep = !list[e as usize].is_empty() && more > 0;
            if keep {
                degree += more;
                hash += u64::from(e);
            }
            keep
        });
        self.elements[i as usize].push(p);
        let (weight, mark, stamp) = (&self.weight, &self.mark, self.stamp);
        self.variables[i as usize].retain(|&j| {
            let keep = weight[j as usize] > 0 && mark[j as usize] != stamp;
            if keep {
                degree += u64::from(weight[j as usize]);
                hash += u64::from(j);
            }
            keep
        });
        let most = u64::from(u32::MAX / 2);
        (u32::try_from(degree.min(most)).expect("limited"), hash)
    }

    /// Compares the variables that are members of the new element, and merges variables that have the same neighbors.
    fn merge_equal(&mut self) {
        let mut hashes = std::mem::take(&mut self.hashes);
        hashes.sort_unstable();
        for same in hashes.chunk_by(|a, b| a.0 == b.0) {
            for (at, &(_, i)) in same.iter().enumerate() {
                if self.weight[i as usize] == 0 {
                    continue;
                }
                self.stamp += 1;
                for &j in self.variables[i as usize]
                    .iter()
                    .chain(&self.elements[i as usize])
                {
                    self.mark[j as usize] = self.stamp;
                }
                for &(_, j) in &same[at + 1..] {
                    if self.weight[j as usize] > 0 && self.has_marked_lists_like(j, i) {
                        self.merge(j, i);
                    }
                }
            }
        }
        self.hashes = hashes;
    }

    /// Whether the lists of `j` have the same lengths as the lists of `i`, and contain only entries that are marked
    /// with the current stamp. Variables and elements never have the same number, so one list of marks is enough for
    /// both.
    fn has_marked_lists_like(&self, j: u32, i: u32) -> bool {
        let [i, j] = [i as usize, j as usize];
        let lists = self.variables[j].iter().chain(&self.elements[j]);
        self.variables[i].len() == self.variables[j].len()
            && self.elements[i].len() == self.elements[j].len()
            && lists
                .into_iter()
                .all(|&k| self.mark[k as usize] == self.stamp)
    }

    fn merge(&mut self, i: u32, into: u32) {
        let weight = std::mem::take(&mut self.weight[i as usize]);
        if self.weight[into as usize] > 0 {
            self.weight[into as usize] += weight;
        }
        self.variables[i as usize] = Vec::new();
        self.elements[i as usize] = Vec::new();
        self.next_merged[i as usize] = self.first_merged[into as usize];
        self.first_merged[into as usize] = i;
    }

    /// Returns all rows in the order of their elimination: each pivot, followed by the variables that were merged into
    /// it.
    fn order(self) -> Vec<u32> {
        let mut order = Vec::with_capacity(self.weight.len());
        let mut stack = Vec::new();
        for p in self.pivots {
            stack.push(p);
            while let Some(i) = stack.pop() {
                order.push(i);
                let mut j = self.first_merged[i as usize];
                while j != NONE {
                    stack.push(j);
                    j = self.next_merged[j as usize];
                }
            }
        }
        order
    }
}
