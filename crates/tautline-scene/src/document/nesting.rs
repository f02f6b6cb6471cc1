//! How deeply a JSON5 text nests, told without recursion: its parser recurses without a limit of its own, so
//! a text of brackets would overflow the stack. (The JSON and TOML parsers have limits.)

use super::limits;

/// Byte offset of the first bracket that opens more than [`limits::NESTING`] levels.
pub(super) fn too_deep(text: &str) -> Option<usize> {
    let mut depth = 0;
    let mut chars = text.char_indices().peekable();
    while let Some((offset, c)) = chars.next() {
        match c {
            '[' | '{' if depth == limits::NESTING => return Some(offset),
            '[' | '{' => depth += 1,
            // An unmatched bracket is left to the parser.
            ']' | '}' => depth = depth.saturating_sub(1),
            '"' | '\'' => skip_string(&mut chars, c),
            '/' => match chars.next() {
                Some((_, '/')) => {
                    skip_past(&mut chars, |c| matches!(c, '\n' | '\r' | '\u{2028}' | '\u{2029}'))
                }
                Some((_, '*')) => {
                    let mut previous = ' ';
                    skip_past(&mut chars, |c| std::mem::replace(&mut previous, c) == '*' && c == '/');
                }
                // Not a comment: the parser stops here.
                _ => return None,
            },
            _ => {}
        }
    }
    None
}

/// Moves past the closing quote.
fn skip_string(chars: &mut impl Iterator<Item = (usize, char)>, quote: char) {
    let mut escaped = false;
    skip_past(chars, |c| {
        let closes = c == quote && !escaped;
        escaped = c == '\\' && !escaped;
        closes
    });
}

/// Moves past the first character that `is_last` accepts.
fn skip_past(chars: &mut impl Iterator<Item = (usize, char)>, mut is_last: impl FnMut(char) -> bool) {
    for (_, c) in chars {
        if is_last(c) {
            break;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_that_of_brackets_outside_strings_and_comments() {
        let deep = "[".repeat(limits::NESTING);
        assert_eq!(too_deep(&deep), None);
        assert_eq!(too_deep(&format!("{deep}{{")), Some(limits::NESTING));
        assert_eq!(too_deep(&"[]".repeat(1000)), None);
        for (open, close) in
            [("\"", "\""), ("'", "'"), ("//", "\n"), ("/*", "*/"), ("'\\'", "'"), ("/**", "**/")]
        {
            let hidden = format!("{open}{deep}{deep}{close}");
            assert_eq!(too_deep(&hidden), None, "{open}");
            assert_eq!(too_deep(&format!("{hidden}{deep}[")), Some(hidden.len() + limits::NESTING), "{open}");
        }
    }

    #[test]
    fn every_line_terminator_ends_a_comment() {
        let deep = "[".repeat(limits::NESTING + 1);
        for end in ["\n", "\r", "\u{2028}", "\u{2029}"] {
            assert!(too_deep(&format!("//{end}{deep}")).is_some(), "{end:?}");
        }
    }
}
