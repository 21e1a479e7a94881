//! Provides thread pools of different sizes. With them, tests check that results do not depend on the number of
//! threads.

use std::sync::LazyLock;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Pools of 1, 2 and 8 threads.
pub(crate) static POOLS: LazyLock<[ThreadPool; 3]> = LazyLock::new(|| {
    [1, 2, 8].map(|n| {
        ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .expect("threads can be started")
    })
});
