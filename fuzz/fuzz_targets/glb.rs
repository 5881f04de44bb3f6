//! The binary frame, as it is and with lengths that fit: the first half of the bytes as
//! the document, which chance would hardly ever keep whole.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    answer::check(bytes);
    // The document ends at the first zero byte.
    let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len());
    let (json, data) = bytes.split_at(end);
    let mut json = json.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], content: &[u8]| {
        [&(content.len() as u32).to_le_bytes(), &kind[..], content].concat()
    };
    let body = [chunk(b"JSON", &json), chunk(b"BIN\0", data)].concat();
    let length = (12 + body.len() as u32).to_le_bytes();
    answer::check(&[&b"glTF"[..], &2_u32.to_le_bytes(), &length, &body].concat());
});
