//! Runs many jobs in parallel on one thread pool, within a memory budget.
//!
//! ```text
//! jobs in order --admit--> thread 1: job 4     results in any order --InOrder--> results in order
//!                          thread 2: job 5
//! ```
//!
//! A job and the parallel loops inside the job run on the same threads. While every thread has a job, each parallel
//! loop runs entirely on the thread of its job. This avoids the cost of distributing the work of the loop. When no more
//! jobs can start, idle threads help with the parallel loops of the last jobs. If there is not enough memory for the
//! next job, a thread without a job returns to the thread pool. If it waited for memory instead, it could not help with
//! the parallel loops of other jobs. When a thread has completed a job, it frees the memory of the job. If the limits
//! then allow the next job, the same thread starts it. If the limits still allow one more job, the thread also wakes
//! another thread. While a job waits for a part of its parallel loop, the thread of the job does not start another job.
//! Therefore, a job never has to wait until another job on the same thread has ended. There are also no deadlocks in
//! which a job waits for a lock of another job on the same thread.

use std::any::Any;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::{Scope, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::check::Forecast;

/// Limits for running jobs in parallel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JobLimits {
    /// The number of threads. 0 means one thread for each processor.
    pub threads: usize,
    /// The maximum number of jobs that run at the same time. At most one job runs on each thread. 0 means as many jobs
    /// as threads.
    pub jobs: usize,
    /// The memory budget, in bytes, that all running jobs share.
    pub budget: u64,
}

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JobEnd<T> {
    /// The job returned this result.
    Done(T),
    /// The job panicked with this message.
    Panicked(String),
    /// The job was not started, because [`Jobs::stop`] returned `true`.
    NotRun,
}

/// The threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("cannot start the threads: {0}")]
pub struct JobsError(#[from] ThreadPoolBuildError);

/// A list of jobs. Each job is identified by its index.
#[derive(Clone, Copy, Debug)]
pub struct Jobs<B, S, W> {
    /// The number of jobs.
    pub count: usize,
    /// The function that returns the estimated peak memory of a job, in bytes.
    pub bytes: B,
    /// If this function returns `true`, no more jobs are started.
    pub stop: S,
    /// The function that runs a job.
    pub work: W,
}

impl<B, S, W> Jobs<B, S, W> {
    /// Runs the jobs. Calls `ended` on the calling thread. Each call of `ended` receives the jobs that have ended since
    /// the previous call, in the order in which they ended. Each job is passed to `ended` exactly once.
    ///
    /// Jobs start in the order of their indices. A job starts if fewer jobs are running than the maximum. In addition,
    /// the memory of the job and of all running jobs together must be within the budget. If a job needs more memory
    /// than the budget, it counts as if it needed exactly the budget. If a job panics, the other jobs are not affected.
    ///
    /// This method blocks, so it must not be called from a thread of a rayon pool.
    ///
    /// # Errors
    ///
    /// Returns [`JobsError`] if the threads cannot be started. In this case, no job was started.
    pub fn run<T>(
        &self,
        limits: JobLimits,
        mut ended: impl FnMut(Vec<(usize, JobEnd<T>)>),
    ) -> Result<(), JobsError>
    where
        T: Send,
        B: Fn(usize) -> u64 + Sync,
        S: Fn() -> bool + Sync,
        W: Fn(usize) -> T + Sync,
    {
        let pool = pool(limits.threads)?;
        let threads = pool.current_num_threads();
        let max_running = match limits.jobs {
            0 => threads,
            jobs => jobs.min(threads),
        };
        let (sender, receiver) = mpsc::channel();
        let runner = Runner {
            jobs: self,
            max_running,
            budget: limits.budget,
            state: Mutex::new(State::default()),
            sender,
        };
        pool.in_place_scope(|scope| {
            scope.spawn_broadcast(|scope, _| runner.work(scope, true));
            deliver(self.count, &receiver, &mut ended);
        });
        Ok(())
    }
}

/// Returns a thread pool whose threads have stacks of 8 MiB, which is the usual stack size of a main thread.
fn pool(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .stack_size(8 << 20)
        .thread_name(|i| format!("job thread {}", i + 1))
        .build()
}

/// Passes the results of all jobs to `ended`.
fn deliver<T>(
    count: usize,
    receiver: &Receiver<(usize, JobEnd<T>)>,
    ended: &mut impl FnMut(Vec<(usize, JobEnd<T>)>),
) {
    let mut remaining = count;
    while remaining > 0 {
        let Ok(first) = receiver.recv() else { return };
        let mut results = vec![first];
        results.extend(receiver.try_iter());
        remaining -= results.len();
        ended(results);
    }
}

thread_local! {
    /// Whether a job on this thread has started and not yet ended. The job is possibly waiting for other threads that
    /// run parts of its parallel loop.
    static RUNS_JOB: Cell<bool> = const { Cell::new(false) };
}

#[derive(Default)]
struct State {
    /// The next job to start.
    next: usize,
    /// The number of running jobs.
    running: usize,
    /// The estimated memory of the running jobs, in bytes.
    used: u64,
}

struct Runner<'j, T, B, S, W> {
    jobs: &'j Jobs<B, S, W>,
    max_running: usize,
    budget: u64,
    state: Mutex<State>,
    sender: Sender<(usize, JobEnd<T>)>,
}

impl<T, B, S, W> Runner<'_, T, B, S, W>
where
    T: Send,
    B: Fn(usize) -> u64 + Sync,
    S: Fn() -> bool + Sync,
    W: Fn(usize) -> T + Sync,
{
    /// Runs jobs until no job can start. After starting a job, wakes another thread if the limits allow one more job.
    /// If `is_broadcast` is set, all threads were started together, so this thread wakes no other thread when it starts
    /// its first job.
    fn work<'s>(&'s self, scope: &Scope<'s>, is_broadcast: bool) {
        // A thread that already has a job does not start another job. Otherwise the first job, which waits for other
        // threads, could not continue before the second job has ended.
        if RUNS_JOB.get() {
            return;
        }
        let mut wakes_others = !is_broadcast;
        while let Some(started) = self.start() {
            if wakes_others && started.is_room_for_more {
                scope.spawn(|scope| self.work(scope, false));
            }
            wakes_others = true;
            RUNS_JOB.set(true);
            let end = match catch_unwind(AssertUnwindSafe(|| (self.jobs.work)(started.job))) {
                Ok(result) => JobEnd::Done(result),
                Err(payload) => JobEnd::Panicked(message(payload.as_ref())),
            };
            RUNS_JOB.set(false);
            let mut state = self.state();
            state.running -= 1;
            state.used -= started.bytes;
            drop(state);
            // Sending fails only if the calling thread has panicked. In that case, the result is not needed.
            let _ = self.sender.send((started.job, end));
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts the next job, if the limits allow it now.
    fn start(&self) -> Option<StartedJob> {
        let mut state = self.state();
        if (self.jobs.stop)() {
            for i in state.next..self.jobs.count {
                let _ = self.sender.send((i, JobEnd::NotRun));
            }
            state.next = self.jobs.count;
        }
        let bytes = self.admissible(&state)?;
        let job = state.next;
        state.next += 1;
        state.running += 1;
        state.used += bytes;
        let is_room_for_more = self.admissible(&state).is_some();
        Some(StartedJob {
            job,
            bytes,
            is_room_for_more,
        })
    }

    /// Returns the memory of the next job, in bytes. Returns `None` if there is no next job, or if the limits do not
    /// allow the next job to start. If a job needs more memory than the budget, it counts as if it needed exactly the
    /// budget.
    fn admissible(&self, state: &State) -> Option<u64> {
        if state.next >= self.jobs.count || state.running >= self.max_running {
            return None;
        }
        let bytes = (self.jobs.bytes)(state.next).min(self.budget);
        let fits = bytes <= self.budget - state.used;
        (fits || state.running == 0).then_some(bytes)
    }
}

struct StartedJob {
    job: usize,
    bytes: u64,
    /// Whether the limits allow one more job to start.
    is_room_for_more: bool,
}

/// Returns the message of a panic.
fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("it panicked without a message").to_owned()
}

/// Puts results that arrive in any order into the order of their jobs.
#[derive(Debug)]
pub struct InOrder<T> {
    next: usize,
    waiting: BTreeMap<usize, T>,
}

impl<T> Default for InOrder<T> {
    fn default() -> Self {
        Self {
            next: 0,
            waiting: BTreeMap::new(),
        }
    }
}

impl<T> InOrder<T> {
    /// Adds the result of a job.
    pub fn put(&mut self, job: usize, result: T) {
        self.waiting.insert(job, result);
    }

    /// Returns the next result in the order of jobs, with the index of its job. Returns `None` if this result has not
    /// been added yet.
    pub fn take(&mut self) -> Option<(usize, T)> {
        let result = self.waiting.remove(&self.next)?;
        self.next += 1;
        Some((self.next - 1, result))
    }
}

/// The estimated number of bytes of memory for each byte of the input files. This estimate is used if a forecast has no
/// upper limit for the memory of its meshes. This number covers the file itself, the mesh of the file, and an edited
/// copy of the mesh. The mesh of a text file is about as large as the file. The mesh of a binary file is up to three
/// times as large as the file.
const BYTES_FOR_EACH_BYTE_READ: u64 = 8;

impl Forecast {
    /// Returns the estimated peak memory of the run, in bytes. For each step, the forecast can have an upper limit for
    /// the memory that the meshes take after the step. If all steps have an upper limit, the estimate is the size of
    /// the input files plus the largest of these limits. Otherwise, the estimate is the larger of two numbers. One is
    /// eight times the size of the input files. The other is the largest amount of memory that the meshes certainly
    /// take after any step.
    pub fn peak_bytes(&self) -> u64 {
        let size = |path: &std::path::PathBuf| Path::metadata(path).map_or(0, |m| m.len());
        let read: u64 = self.inputs.iter().map(size).sum();
        let meshes = self.steps.iter().map(|s| s.bytes.max).max().unwrap_or(0);
        if meshes == u64::MAX {
            let least = self.steps.iter().map(|s| s.bytes.min).max().unwrap_or(0);
            least.max(read.saturating_mul(BYTES_FOR_EACH_BYTE_READ))
        } else {
            read.saturating_add(meshes)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
    use std::thread::sleep;
    use std::time::Duration;

    use rayon::prelude::*;

    use super::*;

    fn limits(threads: usize, jobs: usize, budget: u64) -> JobLimits {
        JobLimits {
            threads,
            jobs,
            budget,
        }
    }

    /// Runs jobs that need no memory. Returns how each job ended, in the order of the jobs.
    fn ends<T: Send>(
        count: usize,
        limits: JobLimits,
        work: impl Fn(usize) -> T + Sync,
    ) -> Vec<JobEnd<T>> {
        let jobs = Jobs {
            count,
            bytes: |_| 0,
            stop: || false,
            work,
        };
        let (mut order, mut all) = (InOrder::default(), Vec::new());
        jobs.run(limits, |ended| {
            for (i, end) in ended {
                order.put(i, end);
            }
            while let Some((i, end)) = order.take() {
                assert_eq!(i, all.len());
                all.push(end);
            }
        })
        .unwrap();
        assert_eq!(all.len(), count);
        all
    }

    /// Runs a parallel loop inside another parallel loop. For some values of `i`, the loops take much longer than for
    /// others.
    fn nested(i: usize) -> u64 {
        let sum = |n: u64| (0..n).into_par_iter().map(|x| x % 7).sum::<u64>();
        (0..40_u64)
            .into_par_iter()
            .map(|k| sum(k * 10 + (i as u64 % 5) * 1000))
            .sum()
    }

    #[test]
    fn results_are_the_same_for_any_number_of_threads_and_jobs() {
        let expected: Vec<_> = (0..60).map(|i| JobEnd::Done(nested(i))).collect();
        for (threads, jobs) in [(1, 0), (2, 0), (2, 1), (8, 0), (8, 3), (3, 99)] {
            assert_eq!(ends(60, limits(threads, jobs, 0), nested), expected);
        }
    }

    #[test]
    fn an_empty_list_of_jobs_ends_immediately() {
        assert_eq!(ends(0, limits(2, 0, 0), |i| i), []);
    }

    #[test]
    fn a_panic_ends_only_its_job() {
        let found = ends(9, limits(3, 0, 0), |i| {
            assert!(i != 4, "job {i} is broken");
            (0..100)
                .into_par_iter()
                .for_each(|k| assert!(i != 6 || k != 50, "a part"));
            i
        });
        for (i, end) in found.into_iter().enumerate() {
            let expected = match i {
                4 => JobEnd::Panicked("job 4 is broken".to_owned()),
                6 => JobEnd::Panicked("a part".to_owned()),
                _ => JobEnd::Done(i),
            };
            assert_eq!(end, expected);
        }
    }

    #[test]
    fn running_jobs_stay_within_the_budget() {
        let size = |i: usize| [10, 60, 30, 90, 500, 5, 5, 5, 50, 50][i % 10];
        let (used, most) = (AtomicU64::new(0), AtomicU64::new(0));
        let (running, at_once) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let jobs = Jobs {
            count: 100,
            bytes: size,
            stop: || false,
            work: |i| {
                let bytes = size(i).min(100);
                let now = used.fetch_add(bytes, Ordering::SeqCst) + bytes;
                most.fetch_max(now, Ordering::SeqCst);
                let n = running.fetch_add(1, Ordering::SeqCst) + 1;
                at_once.fetch_max(n, Ordering::SeqCst);
                nested(i);
                sleep(Duration::from_millis(1));
                running.fetch_sub(1, Ordering::SeqCst);
                used.fetch_sub(bytes, Ordering::SeqCst);
            },
        };
        let mut n = 0;
        jobs.run(limits(6, 4, 100), |ended| n += ended.len())
            .unwrap();
        assert_eq!(n, 100);
        assert!(most.into_inner() <= 100);
        let at_once = at_once.into_inner();
        assert!((2..=4).contains(&at_once), "{at_once}");
    }

    #[test]
    fn jobs_start_in_their_order() {
        let started = Mutex::new(Vec::new());
        ends(200, limits(1, 0, 0), |i| started.lock().unwrap().push(i));
        assert_eq!(started.into_inner().unwrap(), (0..200).collect::<Vec<_>>());
    }

    #[test]
    fn stop_lets_running_jobs_end_and_starts_no_more() {
        let stop = AtomicBool::new(false);
        let jobs = Jobs {
            count: 50,
            bytes: |_| 0,
            stop: || stop.load(Ordering::SeqCst),
            work: |i| {
                if i == 5 {
                    stop.store(true, Ordering::SeqCst);
                }
                i
            },
        };
        let mut all = Vec::new();
        jobs.run(limits(2, 0, 0), |ended| all.extend(ended))
            .unwrap();
        all.sort_by_key(|(i, _)| *i);
        assert_eq!(all.len(), 50);
        assert!(all[..=5].iter().all(|(i, end)| *end == JobEnd::Done(*i)));
        let first = all.iter().position(|(_, end)| *end == JobEnd::NotRun);
        let first = first.expect("some were not run");
        assert!(all[first..].iter().all(|(_, end)| *end == JobEnd::NotRun));
    }

    #[test]
    fn free_threads_help_the_last_job() {
        let used = Mutex::new(std::collections::BTreeSet::new());
        ends(1, limits(2, 0, 0), |_| {
            (0..64).into_par_iter().for_each(|_| {
                sleep(Duration::from_millis(1));
                used.lock().unwrap().insert(rayon::current_thread_index());
            });
        });
        assert_eq!(used.into_inner().unwrap().len(), 2);
    }
}
