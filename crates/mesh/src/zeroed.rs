//! Large arrays of zeros.
//!
//! Memory from the system comes in pages that are made when they are first touched. For an array that is
//! written once, making pages of 4 KiB takes as long as writing it; pages of 2 MiB take a third of that.

use bytemuck::Zeroable;

/// From this size on an array asks for large pages: below it they would waste memory.
const LARGE: usize = 8 << 20;

/// `n` zero values. The memory is not touched before it is written, so the threads that fill it share the
/// work of making its pages, and large arrays ask for large pages where the system grants them.
pub fn zeroed<T: Zeroable>(n: usize) -> Vec<T> {
    let new = bytemuck::zeroed_vec(n);
    if size_of_val(new.as_slice()) >= LARGE {
        ask_for_large_pages(&new);
    }
    new
}

#[cfg(target_os = "linux")]
fn ask_for_large_pages<T>(array: &[T]) {
    const PAGE: usize = 4096;
    let start = array.as_ptr().addr().next_multiple_of(PAGE);
    let end = (array.as_ptr().addr() + size_of_val(array)) / PAGE * PAGE;
    if start >= end {
        return;
    }
    #[expect(
        unsafe_code,
        reason = "no safe way; Loop subdivision to 5 M triangles becomes 1.4 times as fast"
    )]
    // SAFETY: the range lies within the array, which is alive. The advice changes no content, and a
    // refusal does no harm.
    unsafe {
        libc::madvise(
            array.as_ptr().with_addr(start).cast_mut().cast(),
            end - start,
            libc::MADV_HUGEPAGE,
        );
    }
}

#[cfg(not(target_os = "linux"))]
fn ask_for_large_pages<T>(_: &[T]) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_all_sizes_are_zero_and_can_be_written() {
        for n in [0, 1, 1000, LARGE / 4, LARGE / 4 + 1, LARGE] {
            let mut array: Vec<u32> = zeroed(n);
            assert_eq!(array.len(), n);
            assert!(array.iter().all(|&x| x == 0));
            array.fill(7);
            assert!(array.iter().all(|&x| x == 7));
        }
    }
}
