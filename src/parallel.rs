//! Work on many elements on all cores. Results stand in the order of the elements, so that
//! the same comes out on every machine.

use std::num::NonZero;
use std::panic::resume_unwind;
use std::thread;

/// Fewer elements than this are not worth a thread.
const WORTH: usize = 1000;

/// What a function makes of each element, in their order.
pub fn in_parallel<T: Sync, R: Send>(of: &[T], make: impl Fn(&T) -> R + Sync) -> Vec<R> {
    in_parallel_with(of, || (), |(), element| make(element))
}

/// The same for a function that needs room to work in, which each thread makes once.
pub fn in_parallel_with<T: Sync, S, R: Send>(
    of: &[T],
    room: impl Fn() -> S + Sync,
    make: impl Fn(&mut S, &T) -> R + Sync,
) -> Vec<R> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let share = of.len().div_ceil(threads).max(WORTH);
    let run = |some: &[T]| {
        let mut room = room();
        some.iter().map(|element| make(&mut room, element)).collect::<Vec<R>>()
    };
    if of.len() <= share {
        return run(of);
    }
    let (first, rest) = of.split_at(share);
    thread::scope(|scope| {
        let run = &run;
        let running: Vec<_> =
            rest.chunks(share).map(|some| scope.spawn(move || run(some))).collect();
        let mut all = run(first);
        all.reserve_exact(rest.len());
        for thread in running {
            // A panic in a thread goes on in this one.
            all.extend(thread.join().unwrap_or_else(|e| resume_unwind(e)));
        }
        all
    })
}

/// Does two things at once.
pub fn both<A: Send, B>(one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B) -> (A, B) {
    thread::scope(|scope| {
        let one = scope.spawn(one);
        let other = other();
        // A panic in a thread goes on in this one.
        (one.join().unwrap_or_else(|e| resume_unwind(e)), other)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few elements, and so many that they are shared out.
    #[test]
    fn results_stand_in_the_order_of_the_elements() {
        for n in [0, 1, WORTH, WORTH + 1, 7 * WORTH + 3] {
            let of: Vec<usize> = (0..n).collect();
            assert_eq!(in_parallel(&of, |i| i * i), of.iter().map(|i| i * i).collect::<Vec<_>>());
        }
    }

    /// Each share counts in a room of its own.
    #[test]
    fn rooms_are_not_shared() {
        let of = vec![1; 5 * WORTH];
        let counted = in_parallel_with(
            &of,
            || 0,
            |sum, one| {
                *sum += one;
                *sum
            },
        );
        assert_eq!(counted[WORTH - 1], WORTH);
        let shares = counted.iter().filter(|&&sum| sum == 1).count();
        assert!(counted.iter().all(|&sum| sum <= of.len().div_ceil(shares)));
    }
}
