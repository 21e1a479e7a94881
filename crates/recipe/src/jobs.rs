//! Many runs at once: jobs on the threads of one pool, within a memory budget.
//!
//! ```text
//! jobs in order --admit--> thread 1: job 4     ended, in any order --InOrder--> results in order
//!                          thread 2: job 5
//! ```
//!
//! Jobs run on the threads that their own parallel loops use. As long as every thread has a job of its
//! own, loops find no idle thread and stay where they are, which costs nothing; when jobs run out, the
//! threads that are free help the last ones. A thread never waits for memory to become free, as it could
//! not help then: it goes back to the pool, and whoever ends a job calls it again. A thread that waits
//! inside a job for a part of a loop never takes up another whole job meanwhile, so no job has to wait
//! for another, and none holds a lock that such a job could want.

use std::any::Any;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::{Scope, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::check::Forecast;

/// How many jobs run at once, and on what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JobLimits {
    /// The number of threads; 0 means one for each processor.
    pub threads: usize,
    /// Most jobs at once, at most one for each thread; 0 means as many as threads.
    pub jobs: usize,
    /// The bytes that the jobs that run at once may take together.
    pub budget: u64,
}

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JobEnd<T> {
    /// It gave a result.
    Done(T),
    /// It panicked, with this message.
    Panicked(String),
    /// It was not begun, because all were to stop.
    NotRun,
}

/// The threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("cannot start the threads: {0}")]
pub struct JobsError(#[from] ThreadPoolBuildError);

/// A list of jobs and what to do with each.
#[derive(Clone, Copy, Debug)]
pub struct Jobs<B, S, W> {
    /// The number of jobs.
    pub count: usize,
    /// The bytes that a job takes at its peak, as far as known.
    pub bytes: B,
    /// Whether no further job is to begin.
    pub stop: S,
    /// Does a job.
    pub work: W,
}

impl<B, S, W> Jobs<B, S, W> {
    /// Runs the jobs. `ended` is called on the calling thread with all jobs that ended since its last
    /// call, in the order in which they ended; every job comes exactly once.
    ///
    /// Jobs begin in their order. One begins when the sum of the bytes of those that run, and its own,
    /// is within the budget; one that is larger than the budget runs alone. A job that panics ends
    /// itself and no other.
    ///
    /// Must not be called from a thread of a rayon pool, because it blocks.
    ///
    /// # Errors
    ///
    /// [`JobsError`] if the threads cannot be started; then no job has begun.
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
        let at_once = match limits.jobs {
            0 => threads,
            jobs => jobs.min(threads),
        };
        let (sender, receiver) = mpsc::channel();
        let runner = Runner {
            jobs: self,
            at_once,
            budget: limits.budget,
            state: Mutex::new(State::default()),
            sender,
        };
        pool.in_place_scope(|scope| {
            scope.spawn_broadcast(|scope, _| runner.work(scope, true));
            hand_out(self.count, &receiver, &mut ended);
        });
        Ok(())
    }
}

/// A pool whose threads have the stack that the main thread has by custom.
fn pool(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .stack_size(8 << 20)
        .thread_name(|i| format!("job thread {}", i + 1))
        .build()
}

fn hand_out<T>(
    count: usize,
    receiver: &Receiver<(usize, JobEnd<T>)>,
    ended: &mut impl FnMut(Vec<(usize, JobEnd<T>)>),
) {
    let mut left = count;
    while left > 0 {
        let Ok(first) = receiver.recv() else { return };
        let mut together = vec![first];
        together.extend(receiver.try_iter());
        left -= together.len();
        ended(together);
    }
}

thread_local! {
    /// Whether this thread is at work on a job, perhaps waiting for a part of it.
    static AT_WORK: Cell<bool> = const { Cell::new(false) };
}

#[derive(Default)]
struct State {
    /// The next job to begin.
    next: usize,
    /// How many jobs run.
    running: usize,
    /// The bytes of those that run.
    used: u64,
}

struct Runner<'j, T, B, S, W> {
    jobs: &'j Jobs<B, S, W>,
    at_once: usize,
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
    /// Does jobs as long as there are any that may begin. One of several threads that begin together
    /// calls no others.
    fn work<'s>(&'s self, scope: &Scope<'s>, begin_together: bool) {
        // Taken up while a job on this thread waits for a part of its own: that job would have to wait
        // for a whole other one.
        if AT_WORK.get() {
            return;
        }
        let mut calls_others = !begin_together;
        while let Some(begun) = self.begin() {
            if calls_others && begun.is_room_for_more {
                scope.spawn(|scope| self.work(scope, false));
            }
            calls_others = true;
            AT_WORK.set(true);
            let end = match catch_unwind(AssertUnwindSafe(|| (self.jobs.work)(begun.job))) {
                Ok(result) => JobEnd::Done(result),
                Err(payload) => JobEnd::Panicked(message(payload.as_ref())),
            };
            AT_WORK.set(false);
            let mut state = self.state();
            state.running -= 1;
            state.used -= begun.bytes;
            drop(state);
            // Nobody receives if the calling thread panicked: then there is nobody to tell.
            let _ = self.sender.send((begun.job, end));
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins the next job, if it may begin now.
    fn begin(&self) -> Option<Begun> {
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
        Some(Begun {
            job,
            bytes,
            is_room_for_more,
        })
    }

    /// The bytes of the next job, if there is one and it may begin. What is more than the budget counts
    /// as all of it.
    fn admissible(&self, state: &State) -> Option<u64> {
        if state.next >= self.jobs.count || state.running >= self.at_once {
            return None;
        }
        let bytes = (self.jobs.bytes)(state.next).min(self.budget);
        let fits = bytes <= self.budget - state.used;
        (fits || state.running == 0).then_some(bytes)
    }
}

/// A job that began.
struct Begun {
    job: usize,
    bytes: u64,
    /// Whether another one could begin beside it.
    is_room_for_more: bool,
}

/// The message of a panic.
fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("it panicked without a message").to_owned()
}

/// Puts results into the order of their jobs.
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
    /// Takes the result of a job in.
    pub fn put(&mut self, job: usize, result: T) {
        self.waiting.insert(job, result);
    }

    /// The next result in the order of the jobs with its job, if it is there.
    pub fn take(&mut self) -> Option<(usize, T)> {
        let result = self.waiting.remove(&self.next)?;
        self.next += 1;
        Some((self.next - 1, result))
    }
}

/// How many times the bytes of its input files a run takes that says nothing of its memory: the file
/// itself, the mesh (one to three times the file for text and for binary files), and an edited copy.
const BYTES_FOR_EACH_BYTE_READ: u64 = 8;

impl Forecast {
    /// The bytes that the run takes at its peak, at most, as far as can be told: its input files and
    /// the largest its meshes can get; if a step says nothing of that, eight times its input files.
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

    /// Runs jobs of no bytes, and puts their ends in order.
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

    /// Work with loops inside loops, some of it slow.
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
    fn no_jobs_end_at_once() {
        assert_eq!(ends(0, limits(2, 0, 0), |i| i), []);
    }

    #[test]
    fn a_job_that_panics_ends_no_other() {
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
    fn jobs_that_run_at_once_stay_within_the_budget() {
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
    fn jobs_begin_in_their_order() {
        let begun = Mutex::new(Vec::new());
        ends(200, limits(1, 0, 0), |i| begun.lock().unwrap().push(i));
        assert_eq!(begun.into_inner().unwrap(), (0..200).collect::<Vec<_>>());
    }

    #[test]
    fn a_stop_lets_running_jobs_end_and_begins_no_other() {
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
