//! Colour where it is wanted, and output that survives a closed pipe.

use super::Failure;
use clap::ColorChoice;
use std::io::{IsTerminal, Write, stderr, stdout};

/// How to write to the user.
pub struct Terminal {
    color_out: bool,
    color_err: bool,
}

impl Terminal {
    /// Colour as asked for; by default on terminals, unless `NO_COLOR` is set.
    pub fn new(choice: ColorChoice) -> Self {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
        let color = |terminal: bool| match choice {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => terminal && !plain,
        };
        Self { color_out: color(stdout().is_terminal()), color_err: color(stderr().is_terminal()) }
    }

    /// A text in bold on standard output.
    pub fn bold(&self, text: &str) -> String {
        if self.color_out { format!("\x1b[1m{text}\x1b[0m") } else { text.to_string() }
    }

    /// An error message on standard error.
    pub fn error(&self, message: &str) {
        self.message("31", "error", message);
    }

    /// A warning on standard error.
    pub fn warning(&self, message: &str) {
        self.message("33", "warning", message);
    }

    /// A remark on standard error.
    pub fn note(&self, message: &str) {
        self.message("36", "note", message);
    }

    fn message(&self, color: &str, kind: &str, message: &str) {
        let kind = if self.color_err {
            format!("\x1b[1;{color}m{kind}:\x1b[0m")
        } else {
            format!("{kind}:")
        };
        // With standard error gone there is no one left to tell.
        let _ = writeln!(stderr(), "{kind} {message}");
    }
}

/// Writes a result to standard output. A reader that stops early is no failure.
pub fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::file(format!("cannot write to standard output: {e}")))
        }
        _ => Ok(()),
    }
}
