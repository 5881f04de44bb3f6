//! Figures counted in bins.

use serde::Serialize;

/// Counts of absolute values in bins of equal width from zero; the last bin takes all
/// above, too.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Histogram {
    /// Width of a bin, in the unit of the figures.
    pub bin: f64,
    /// How many figures fall into each.
    pub counts: Vec<usize>,
}

/// The same figures before and after a step, in the same bins.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct BeforeAfter {
    pub before: Histogram,
    pub after: Histogram,
}

/// Number of bins.
pub const BINS: usize = 20;

/// The part of the figures that may lie in the last bin before bins are made wider. Larger,
/// and much of what is far off is told by one bar; smaller, and a few stray figures push
/// all others into the first bars.
const FAR: f64 = 0.05;

impl Histogram {
    /// Counts figures in bins of at least this width: that, or 2, 5, 10 … times as much.
    pub fn new(figures: &[f64], least_bin: f64) -> Self {
        Self::counted(figures, width(figures, least_bin))
    }

    fn counted(figures: &[f64], bin: f64) -> Self {
        let mut counts = vec![0; BINS];
        for figure in figures {
            counts[((figure.abs() / bin) as usize).min(BINS - 1)] += 1;
        }
        Self { bin, counts }
    }

    /// How many figures were counted.
    pub fn total(&self) -> usize {
        self.counts.iter().sum()
    }
}

impl BeforeAfter {
    /// Counts two sets of figures in bins of one width, that of the wider [`Histogram`].
    pub fn new(before: &[f64], after: &[f64], least_bin: f64) -> Self {
        let bin = width(before, least_bin).max(width(after, least_bin));
        Self { before: Histogram::counted(before, bin), after: Histogram::counted(after, bin) }
    }
}

/// The least width at which few enough figures are far.
fn width(figures: &[f64], least_bin: f64) -> f64 {
    let mut sizes: Vec<f64> = figures.iter().map(|x| x.abs()).filter(|x| x.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    let Some(reach) = sizes.get(((1.0 - FAR) * sizes.len() as f64) as usize) else {
        return least_bin;
    };
    let widths = (0..).flat_map(|k| [1.0, 2.0, 5.0].map(|step| step * 10f64.powi(k) * least_bin));
    let enough = |bin: &f64| reach / bin < (BINS - 1) as f64;
    // Of more than so many widths the numbers themselves come to an end.
    widths.take(1000).find(enough).unwrap_or(least_bin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_counted_and_the_far_ones_kept() {
        let h = Histogram::counted(&[0.1, -0.3, 1.7, 99.0], 1.0);
        assert_eq!((h.counts[0], h.counts[1], h.counts[BINS - 1]), (2, 1, 1));
        assert_eq!(h.total(), 4);
    }

    #[test]
    fn bins_grow_with_the_figures_but_not_for_a_few() {
        let few = |many: f64, far: f64| {
            let mut figures = vec![many; 99];
            figures.push(far);
            Histogram::new(&figures, 0.1)
        };
        assert_eq!((few(0.3, 0.4).bin, few(0.3, 50.0).bin), (0.1, 0.1));
        assert_eq!((few(-3.0, 0.0).bin, few(50.0, 0.0).bin), (0.2, 5.0));
        assert_eq!(few(0.3, 50.0).counts[BINS - 1], 1);
        assert_eq!(Histogram::new(&[], 0.1), Histogram::counted(&[], 0.1));
        assert_eq!(Histogram::new(&[f64::NAN, f64::INFINITY], 0.1).bin, 0.1);
    }

    #[test]
    fn before_and_after_share_their_bins() {
        let both = BeforeAfter::new(&[30.0; 10], &[0.5; 10], 1.0);
        assert_eq!((both.before.bin, both.after.bin), (2.0, 2.0));
        assert_eq!((both.before.counts[15], both.after.counts[0]), (10, 10));
    }
}
