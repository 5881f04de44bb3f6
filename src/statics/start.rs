//! Where the search for a mode starts.

/// A vector without any symmetry, of numbers between −½ and ½, the same every time.
pub fn start(size: usize) -> Vec<f64> {
    // Multiples of the golden ratio fill the interval evenly.
    let golden = 0.618_033_988_749_894_9;
    (1..=size).map(|i| (i as f64 * golden).fract() - 0.5).collect()
}
