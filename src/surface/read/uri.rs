//! The addresses of glTF buffers: data inside the document, or a file in its folder.
//!
//! Anything else is refused by name before a file is touched: other schemes, absolute
//! paths, `..`, and links that lead out of the folder.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// Why a buffer's address is not followed.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum UriError {
    /// Another scheme, such as https.
    #[error("{uri:?} is outside this computer or not a file")]
    Remote {
        /// The address, shortened.
        uri: String,
    },
    /// An absolute path, `..`, or a link that leads out of the folder.
    #[error("{uri:?} lies outside the document's own folder")]
    Outside {
        /// The address, shortened.
        uri: String,
    },
    /// Embedded data that is not base64.
    #[error("the embedded data {uri:?} is not base64")]
    Embedded {
        /// The address, shortened.
        uri: String,
    },
    /// The file cannot be read.
    #[error("{uri:?} cannot be read: {reason}")]
    Unreadable {
        /// The address, shortened.
        uri: String,
        /// What the system says.
        reason: String,
    },
    /// The document has no folder, so it cannot name files.
    #[error("{uri:?} is a file, but the document is not in a folder")]
    NoFolder {
        /// The address, shortened.
        uri: String,
    },
}

/// What an address stands for.
#[derive(PartialEq, Debug)]
pub(super) enum Source {
    /// Bytes in the address itself.
    Embedded(Vec<u8>),
    /// A file in the document's folder.
    File(PathBuf),
}

/// Decodes embedded data, or finds the file.
pub(super) fn resolve(uri: &str, folder: Option<&Path>) -> Result<Source, UriError> {
    let name = || uri.chars().take(60).collect::<String>();
    if let Some(data) = uri.strip_prefix("data:") {
        let decoded = data.split_once(";base64,").and_then(|(_, text)| base64(text));
        return decoded.map(Source::Embedded).ok_or_else(|| UriError::Embedded { uri: name() });
    }
    let path = percent_decoded(uri).ok_or_else(|| UriError::Outside { uri: name() })?;
    if path.starts_with("//") || scheme(&path) {
        return Err(UriError::Remote { uri: name() });
    }
    // Backslashes separate folders on some systems: nowhere are they needed.
    let inside =
        |p: &Path| p.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    if path.is_empty() || path.contains(['\\', '\0']) || !inside(Path::new(&path)) {
        return Err(UriError::Outside { uri: name() });
    }
    let folder = folder.ok_or_else(|| UriError::NoFolder { uri: name() })?;
    let missing = |e| unreadable(uri, e);
    // An empty folder path means the current one.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let home: PathBuf = folder.canonicalize().map_err(missing)?;
    let file = home.join(&path).canonicalize().map_err(missing)?;
    if !file.starts_with(&home) {
        return Err(UriError::Outside { uri: name() });
    }
    if !file.is_file() {
        return Err(UriError::Unreadable { uri: name(), reason: "not a file".into() });
    }
    Ok(Source::File(file))
}

/// The content of a file that [`resolve`] found.
pub(super) fn load(uri: &str, file: &Path) -> Result<Vec<u8>, UriError> {
    fs::read(file).map_err(|e| unreadable(uri, e))
}

fn unreadable(uri: &str, e: std::io::Error) -> UriError {
    UriError::Unreadable { uri: uri.chars().take(60).collect(), reason: e.to_string() }
}

/// Whether a path starts with a scheme such as `https:`, or a drive letter.
fn scheme(path: &str) -> bool {
    let Some((start, _)) = path.split_once(':') else { return false };
    start.starts_with(|c: char| c.is_ascii_alphabetic())
        && start.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.bytes();
    while let Some(b) = rest.next() {
        if b == b'%' {
            let hex = [rest.next()?, rest.next()?];
            let digit = |h: u8| (h as char).to_digit(16);
            bytes.push((16 * digit(hex[0])? + digit(hex[1])?) as u8);
        } else {
            bytes.push(b);
        }
    }
    String::from_utf8(bytes).ok()
}

/// Decodes base64 (RFC 4648, section 4); padding may be missing.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.as_bytes().chunks(4) {
        let mut bits = 0_u32;
        for &c in group {
            let value = match c {
                b'A'..=b'Z' => c - b'A',
                b'a'..=b'z' => c - b'a' + 26,
                b'0'..=b'9' => c - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                _ => return None,
            };
            bits = bits << 6 | u32::from(value);
        }
        // 4 characters hold 3 bytes, 3 hold 2, 2 hold 1; a single one holds none.
        let count = group.len().checked_sub(1).filter(|n| *n > 0)?;
        let all = (bits << (6 * (4 - group.len()))).to_be_bytes();
        bytes.extend(&all[1..=count]);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_rfc() {
        // RFC 4648, section 10.
        let cases = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (n, text) in cases.iter().enumerate() {
            assert_eq!(base64(text).as_deref(), Some(&b"foobar"[..n]));
        }
        assert_eq!(base64("Zm9vYg").as_deref(), Some(&b"foob"[..]));
        for wrong in ["Z", "Zm9v!mFy", "Zm 9v", "Zm9vY"] {
            assert_eq!(base64(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn addresses_outside_the_folder_are_refused_by_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let inner = folder.path().join("inner");
        fs::create_dir(&inner).expect("a folder");
        fs::write(folder.path().join("secret.bin"), b"no").expect("a file");
        fs::write(inner.join("my data.bin"), b"yes").expect("a file");
        let load = |uri: &str| match resolve(uri, Some(&inner))? {
            Source::File(file) => super::load(uri, &file),
            Source::Embedded(data) => Ok(data),
        };
        assert_eq!(load("my%20data.bin"), Ok(b"yes".to_vec()));
        assert_eq!(load("./my data.bin"), Ok(b"yes".to_vec()));
        for outside in [
            "../secret.bin",
            "%2e%2e/secret.bin",
            "/etc/passwd",
            "..\\secret.bin",
            "a/../../secret.bin",
            "",
        ] {
            let error = load(outside).expect_err(outside);
            assert!(matches!(error, UriError::Outside { .. }), "{error}");
            assert!(error.to_string().contains(&format!("{outside:?}")), "{error}");
        }
        for remote in
            ["https://example.org/a.bin", "file:///etc/passwd", "C:/a.bin", "//host/a.bin"]
        {
            assert!(matches!(load(remote), Err(UriError::Remote { .. })), "{remote}");
        }
        assert!(matches!(load("none.bin"), Err(UriError::Unreadable { .. })));
        assert!(matches!(load("."), Err(UriError::Unreadable { .. })));
        assert!(matches!(resolve("a.bin", None), Err(UriError::NoFolder { .. })));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let inner = folder.path().join("inner");
        fs::create_dir(&inner).expect("a folder");
        fs::write(folder.path().join("secret.bin"), b"no").expect("a file");
        std::os::unix::fs::symlink("../secret.bin", inner.join("link.bin")).expect("a link");
        assert!(matches!(resolve("link.bin", Some(&inner)), Err(UriError::Outside { .. })));
    }
}
