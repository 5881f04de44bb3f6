//! The document as text, with its buffers inside as data.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| answer::check(bytes));
