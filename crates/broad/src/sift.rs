//! Filters a list in order, on several threads where it is long.

/// For fewer items, another thread costs more than it saves.
#[cfg(feature = "parallel")]
const MIN_PARALLEL: usize = 8192;

/// Most items that a thread filters in one go: another thread that was asleep joins late, and takes what is left.
#[cfg(feature = "parallel")]
const AT_ONCE: usize = 2048;

/// Writes the items of one list that pass to the front of another list of the same length; returns how many. The result
/// does not depend on the threads.
pub(crate) fn sift<T: Copy + Send + Sync>(
    from: &[T],
    into: &mut [T],
    passes: &(impl Fn(T) -> bool + Sync),
) -> usize {
    #[cfg(feature = "parallel")]
    if from.len() >= MIN_PARALLEL && rayon::current_num_threads() > 1 {
        return sift_by_halves(from, into, passes);
    }
    sift_at_once(from, into, passes)
}

/// The same, on several threads.
#[cfg(feature = "parallel")]
fn sift_by_halves<T: Copy + Send + Sync>(
    from: &[T],
    into: &mut [T],
    passes: &(impl Fn(T) -> bool + Sync),
) -> usize {
    if from.len() <= AT_ONCE {
        return sift_at_once(from, into, passes);
    }
    let middle = from.len() / 2;
    let (low, high) = from.split_at(middle);
    let (into_low, into_high) = into.split_at_mut(middle);
    let (before, behind) =
        rayon::join(|| sift_by_halves(low, into_low, passes), || sift_by_halves(high, into_high, passes));
    into.copy_within(middle..middle + behind, before);
    before + behind
}

fn sift_at_once<T: Copy>(from: &[T], into: &mut [T], passes: &impl Fn(T) -> bool) -> usize {
    let mut passed = 0;
    for &item in from {
        // Written unconditionally: the branch would be unpredictable.
        into[passed] = item;
        passed += usize::from(passes(item));
    }
    passed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_passes_stays_in_order() {
        for count in [0, 1, 100, 50_000] {
            let from: Vec<u32> = (0..count).map(|number: u32| number.wrapping_mul(2_654_435_761)).collect();
            for passes in [|_| true, |_| false, |item: u32| item >> 30 == 1] {
                let expected: Vec<u32> = from.iter().copied().filter(|&item| passes(item)).collect();
                let mut into = vec![7; from.len()];
                let mut check = |sift: &dyn Fn(&mut [u32]) -> usize| {
                    let passed = sift(&mut into);
                    assert!(into[..passed] == expected, "{passed} of {count}, not {}", expected.len());
                };
                check(&|into| sift_at_once(&from, into, &passes));
                #[cfg(feature = "parallel")]
                rayon::ThreadPoolBuilder::new()
                    .num_threads(3)
                    .build()
                    .unwrap()
                    .install(|| check(&|into| sift(&from, into, &passes)));
            }
        }
    }
}
