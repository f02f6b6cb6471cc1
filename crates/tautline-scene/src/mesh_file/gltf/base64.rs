//! Data in an address: `data:application/octet-stream;base64,…` (RFC 2397 and 4648).

/// The bytes in an address.
pub(super) fn of_uri(uri: &str) -> Result<Vec<u8>, String> {
    let (_, digits) = uri
        .split_once(";base64,")
        .ok_or("data that is not base64: `data:application/octet-stream;base64,` begins it")?;
    decode(digits.trim_end_matches('=').as_bytes()).ok_or_else(|| "data that is not base64".to_owned())
}

fn decode(digits: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    for group in digits.chunks(4) {
        let mut bits = 0;
        for &digit in group {
            bits = bits << 6 | value(digit)?;
        }
        // 2, 3 or 4 digits are 1, 2 or 3 bytes; a digit alone is none.
        let count = group.len() * 6 / 8;
        if count == 0 {
            return None;
        }
        let aligned: u32 = bits << (32 - 6 * group.len());
        bytes.extend_from_slice(&aligned.to_be_bytes()[..count]);
    }
    Some(bytes)
}

fn value(digit: u8) -> Option<u32> {
    let value = match digit {
        b'A'..=b'Z' => digit - b'A',
        b'a'..=b'z' => digit - b'a' + 26,
        b'0'..=b'9' => digit - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    };
    Some(value.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// RFC 4648, section 10.
    #[test]
    fn the_vectors_of_the_standard() {
        let cases = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
        ];
        for (plain, coded) in cases {
            assert_eq!(of_uri(&format!("data:;base64,{coded}")).unwrap(), plain.as_bytes());
        }
        for bad in ["data:;base64,A", "data:;base64,Zm9vA", "data:;base64,Zm 9v", "data:text/plain,abc"] {
            assert!(of_uri(bad).is_err(), "{bad}");
        }
    }
}
