//! Text and binary; the number of facets of a binary file is made to fit every other
//! time, which chance would hardly ever do.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    answer::check(bytes);
    if bytes.len() >= 84 {
        let facets = (bytes.len() - 84) / 50;
        let mut fitted = bytes[..84 + 50 * facets].to_vec();
        fitted[80..84].copy_from_slice(&(facets as u32).to_le_bytes());
        answer::check(&fitted);
    }
});
