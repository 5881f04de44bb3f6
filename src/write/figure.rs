//! Numbers as files show them: rounded, short, and never "-0".

/// `x` rounded to so many digits after the point, as the shortest text of that value.
pub(super) fn figure(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let short = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if short == "-0" { "0".into() } else { short.into() }
}

/// `x` rounded to so many digits after the point, never -0.
pub(super) fn rounded(x: f64, digits: i32) -> f64 {
    let scale = 10_f64.powi(digits);
    // Division, not a product with 0.001: it gives the double next to the decimal.
    (x * scale).round() / scale + 0.0
}

/// The shortest text that reads back as the same number, never "-0".
pub(super) fn exact(x: f64) -> String {
    // Adding zero turns -0 into 0.
    (x + 0.0).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_short() {
        let texts = [0.0, -1e-9, 1.5, -100.0, 0.1 + 0.2, 1e9].map(|x| figure(x, 3));
        assert_eq!(texts, ["0", "0", "1.5", "-100", "0.3", "1000000000"]);
        assert_eq!(figure(1200.0, 0), "1200");
    }

    #[test]
    fn rounded_numbers_print_without_noise() {
        assert_eq!(rounded(0.1 + 0.2, 6).to_string(), "0.3");
        assert_eq!(rounded(112.500_000_000_4, 6).to_string(), "112.5");
        assert_eq!(rounded(-1e-9, 3).to_string(), "0");
    }
}
