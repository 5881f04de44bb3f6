//! Progress on a terminal: which step runs, and with -v how long each took.

use super::terminal::Terminal;
use crate::pipeline::Step;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};

/// Follows the steps of a run.
pub struct Progress {
    bar: ProgressBar,
    times: Vec<(Step, Instant)>,
}

/// Steps in the order in which they come.
const STEPS: u64 = 11;

impl Progress {
    /// Shows itself on a terminal unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target);
        let style = ProgressStyle::with_template("{bar:24} {msg} {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(100));
        Self { bar, times: Vec::new() }
    }

    /// Notes that a step begins.
    pub fn begin(&mut self, step: Step) {
        self.bar.set_position(self.times.len() as u64);
        self.bar.set_message(doing(step));
        self.times.push((step, Instant::now()));
    }

    /// Takes the bar away; tells the times if asked to.
    pub fn finish(self, tell: bool, terminal: &Terminal) {
        self.bar.finish_and_clear();
        if !tell {
            return;
        }
        let end = Instant::now();
        let ends = self.times.iter().skip(1).map(|t| t.1).chain([end]);
        for ((step, start), end) in self.times.iter().zip(ends) {
            let ms = (end - *start).as_secs_f64() * 1e3;
            terminal.note(&format!("{:<24} {ms:8.1} ms", doing(*step)));
        }
    }
}

fn doing(step: Step) -> &'static str {
    match step {
        Step::Read => "reading the surface",
        Step::Chart => "laying out the tiles",
        Step::Fit => "fitting the units",
        Step::Relax => "relaxing the pattern",
        Step::Form => "closing the frame",
        Step::AsBuilt => "solving again as built",
        Step::Measure => "measuring",
        Step::Tolerance => "trying errors of marks",
        Step::Saw => "planning the cuts",
        Step::Order => "ordering the steps",
        Step::Stiffen => "making it stiffer",
        Step::Statics => "finding stresses",
        Step::Jigs => "laying out jigs",
        Step::Draw => "drawing the papers",
        Step::Write => "writing the folder",
    }
}
