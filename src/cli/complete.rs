//! `rodwright completions` and `rodwright man`.

use super::Failure;
use super::terminal::print;

#[derive(clap::Args)]
pub struct Args {
    /// The shell
    shell: clap_complete::Shell,
}

/// The completion script of a shell.
pub fn completions(args: &Args, mut command: clap::Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "rodwright", &mut script);
    print(&script)
}

/// One manual page with all subcommands, for `man -l`.
pub fn man(mut command: clap::Command) -> Result<(), Failure> {
    let mut page = Vec::new();
    command.build();
    let cannot = |e| Failure::file(format!("cannot make the manual page: {e}"));
    clap_mangen::Man::new(command.clone()).render(&mut page).map_err(cannot)?;
    for sub in command.get_subcommands() {
        let title = format!("RODWRIGHT {}", sub.get_name().to_uppercase());
        page.extend(format!(".SH \"{title}\"\n").into_bytes());
        let man = clap_mangen::Man::new(sub.clone());
        man.render_synopsis_section(&mut page).map_err(cannot)?;
        man.render_description_section(&mut page).map_err(cannot)?;
        man.render_options_section(&mut page).map_err(cannot)?;
    }
    print(&page)
}
