//! How benches measure.

use std::time::{Duration, Instant};

/// The least time of `runs` runs or of as many as fit into `budget`, and the last result.
pub fn least<T>(runs: usize, budget: Duration, mut work: impl FnMut() -> T) -> (Duration, T) {
    let began = Instant::now();
    let mut best = Duration::MAX;
    for run in 1.. {
        let start = Instant::now();
        let result = work();
        best = best.min(start.elapsed());
        if run >= runs || began.elapsed() > budget {
            return (best, result);
        }
    }
    unreachable!("the loop ends after the last run")
}

/// A time in milliseconds.
pub fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// The exponent by which a time grows with the number of rods, from the row before, each row's
/// rods and time: 1 is linear. Empty for the first row.
#[allow(dead_code, reason = "not every bench has rows of one kind")]
pub fn growth(before: Option<(f64, f64)>, (rods, time): (f64, f64)) -> String {
    let exponent = |(n, t): (f64, f64)| (time / t).ln() / (rods / n).ln();
    before.map_or_else(String::new, |before| format!("{:.2}", exponent(before)))
}

/// The process' peak memory, MB, where the system tells it; 0 elsewhere.
pub fn peak_memory() -> f64 {
    std::fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|s| s.lines().find_map(|l| l.strip_prefix("VmHWM:").map(str::to_string)))
        .and_then(|l| l.split_whitespace().next().and_then(|kb| kb.parse::<f64>().ok()))
        .map_or(0.0, |kb| kb / 1e3)
}

/// Lets the peak begin anew from what is in use now, where the system can.
#[allow(dead_code, reason = "not every bench measures memory by row")]
pub fn forget_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}
