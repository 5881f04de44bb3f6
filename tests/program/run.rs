//! Running the program and reading what it wrote.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// No run of these tests takes more than a few seconds; one that does hangs.
const LONG_SILENCE: Duration = Duration::from_secs(120);

/// The program, ready to run in a folder.
pub fn rodwright(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("rodwright").expect("the program is built for tests");
    command.current_dir(folder).env("NO_COLOR", "1").timeout(LONG_SILENCE);
    command
}

/// The path of a file in samples/.
pub fn sample(name: &str) -> String {
    format!("{}/samples/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// All files below a folder with their bytes.
pub fn snapshot(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut todo = vec![folder.to_path_buf()];
    while let Some(dir) = todo.pop() {
        for entry in std::fs::read_dir(&dir).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                todo.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_string_lossy().into_owned();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// The structure of a folder.
pub fn structure(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("structure.json")).unwrap()).unwrap()
}
