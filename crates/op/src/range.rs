//! Ranges of counts.

/// A range of possible counts, including both ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// The lowest possible count.
    pub min: u64,
    /// The highest possible count; `u64::MAX` if the highest count is unknown.
    pub max: u64,
}

impl Range {
    /// The range that contains every count.
    pub const ANY: Self = Self {
        min: 0,
        max: u64::MAX,
    };

    /// Creates the range that contains only `n`.
    pub const fn exactly(n: u64) -> Self {
        Self { min: n, max: n }
    }

    /// Creates the range from 0 to `max`.
    pub const fn at_most(max: u64) -> Self {
        Self { min: 0, max }
    }

    /// Creates the range from `min` to `max`.
    pub const fn between(min: u64, max: u64) -> Self {
        Self { min, max }
    }

    /// Whether only one count is possible.
    pub const fn is_exact(self) -> bool {
        self.min == self.max
    }

    /// Whether `n` is in the range.
    pub const fn contains(self, n: u64) -> bool {
        self.min <= n && n <= self.max
    }

    /// Adds two counts: returns the range of the sum.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_add(other.min),
            max: self.max.saturating_add(other.max),
        }
    }

    /// Returns the range of the difference of two counts. An end that would be negative is 0.
    #[must_use]
    pub const fn minus(self, other: Self) -> Self {
        let max = if self.max == u64::MAX {
            u64::MAX
        } else {
            self.max.saturating_sub(other.min)
        };
        Self {
            min: self.min.saturating_sub(other.max),
            max,
        }
    }

    /// Subtracts `n` from the count: returns the range of the difference. An end that would be negative is 0.
    /// `self.max` must be a known limit, not `u64::MAX`.
    #[must_use]
    pub const fn less(self, n: u64) -> Self {
        Self {
            min: self.min.saturating_sub(n),
            max: self.max.saturating_sub(n),
        }
    }

    /// Returns the range of the product of two counts.
    #[must_use]
    pub const fn times(self, other: Self) -> Self {
        Self {
            min: self.min.saturating_mul(other.min),
            max: self.max.saturating_mul(other.max),
        }
    }

    /// Multiplies the count by `n`: returns the range of the product.
    #[must_use]
    pub const fn by(self, n: u64) -> Self {
        self.times(Self::exactly(n))
    }

    /// Returns the range from 0 to the highest count of this range. Use this method if a step can remove or omit any
    /// number of the elements.
    #[must_use]
    pub const fn or_less(self) -> Self {
        Self::at_most(self.max)
    }

    /// Returns the smallest range that contains both ranges.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Returns this range with both ends limited to at most `cap`.
    #[must_use]
    pub fn capped(self, cap: u64) -> Self {
        Self {
            min: self.min.min(cap),
            max: self.max.min(cap),
        }
    }
}
