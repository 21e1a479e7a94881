//! The numbers of threads that results must not depend on.

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
